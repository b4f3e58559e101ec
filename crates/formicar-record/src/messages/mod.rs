//! Messages of ROS 2, as far as formicar reads or writes them.
//!
//! Fields have the names, types, units and order of the ROS interfaces. A struct is the only place
//! where a message is written down: its definition as text ([`definition`]) follows from it.

mod common;
mod field;
mod geometry;
mod nav;
mod sensor;
mod visualization;

pub use common::{ColorRGBA, Duration, Header, Time};
pub use field::{Definitions, Field, Message, definition};
pub use geometry::{
    Point, Point32, Polygon, PolygonStamped, Pose, PoseStamped, PoseWithCovariance, Quaternion,
    TFMessage, Transform, TransformStamped, Twist, TwistWithCovariance, Vector3,
};
pub use nav::{MapMetaData, OccupancyGrid, Odometry, Path};
pub use sensor::{CompressedImage, LaserScan};
pub use visualization::{Marker, MarkerArray, MeshFile, UVCoordinate};
