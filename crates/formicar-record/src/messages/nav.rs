//! `nav_msgs`.

use super::common::{Header, Time};
use super::field::messages;
use super::geometry::{Pose, PoseStamped, PoseWithCovariance, TwistWithCovariance};

messages! { "nav_msgs":
    /// Pose and velocity by dead reckoning.
    Odometry {
        /// Time, and the frame of the pose.
        header: Header,
        /// The frame on the robot whose pose this is.
        child_frame_id: String,
        /// The pose.
        pose: PoseWithCovariance,
        /// Velocities in the child frame.
        twist: TwistWithCovariance,
    }

    /// A path by its poses.
    Path {
        /// Time and frame.
        header: Header,
        /// The poses in order.
        poses: Vec<PoseStamped>,
    }

    /// Size and place of a map.
    MapMetaData {
        /// Time at which the map was loaded.
        map_load_time: Time,
        /// Side of a cell, meters.
        resolution: f32,
        /// Number of columns.
        width: u32,
        /// Number of rows.
        height: u32,
        /// Pose of the lower left corner.
        origin: Pose,
    }

    /// A map of cells.
    OccupancyGrid {
        /// Time and frame.
        header: Header,
        /// Size and place.
        info: MapMetaData,
        /// Row by row from the lowest: 0 free to 100 occupied, -1 unknown.
        data: Vec<i8>,
    }
}
