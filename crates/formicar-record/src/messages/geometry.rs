//! `geometry_msgs` and `tf2_msgs`.

use super::common::Header;
use super::field::messages;
use formicar::Pose2;

messages! { "geometry_msgs":
    /// A point, meters.
    Point {
        /// Forward or east.
        x: f64,
        /// Left or north.
        y: f64,
        /// Up.
        z: f64,
    }

    /// A point, meters, in single precision.
    Point32 {
        /// Forward or east.
        x: f32,
        /// Left or north.
        y: f32,
        /// Up.
        z: f32,
    }

    /// A vector.
    Vector3 {
        /// Along x.
        x: f64,
        /// Along y.
        y: f64,
        /// Along z.
        z: f64,
    }

    /// A rotation as a unit quaternion.
    Quaternion {
        /// Sine of half the angle, times the axis along x.
        x: f64,
        /// The same along y.
        y: f64,
        /// The same along z.
        z: f64,
        /// Cosine of half the angle.
        w: f64,
    }

    /// A pose in space.
    Pose {
        /// Position, meters.
        position: Point,
        /// Orientation.
        orientation: Quaternion,
    }

    /// A pose with time and frame.
    PoseStamped {
        /// Time and frame.
        header: Header,
        /// The pose.
        pose: Pose,
    }

    /// A pose and its uncertainty.
    PoseWithCovariance {
        /// The pose.
        pose: Pose,
        /// Over x, y, z and rotations about them, row by row.
        covariance: [[f64; 6]; 6],
    }

    /// Velocities.
    Twist {
        /// Meters per second.
        linear: Vector3,
        /// Radians per second.
        angular: Vector3,
    }

    /// Velocities and their uncertainty.
    TwistWithCovariance {
        /// The velocities.
        twist: Twist,
        /// Over x, y, z and rotations about them, row by row.
        covariance: [[f64; 6]; 6],
    }

    /// A polygon by its corners.
    Polygon {
        /// Corners, meters, not closed.
        points: Vec<Point32>,
    }

    /// A polygon with time and frame.
    PolygonStamped {
        /// Time and frame.
        header: Header,
        /// The polygon.
        polygon: Polygon,
    }

    /// A rigid motion.
    Transform {
        /// Meters.
        translation: Vector3,
        /// Applied before the translation.
        rotation: Quaternion,
    }

    /// The pose of one frame in another.
    TransformStamped {
        /// Time, and the parent frame.
        header: Header,
        /// The frame whose pose this is.
        child_frame_id: String,
        /// Its pose in the parent frame.
        transform: Transform,
    }
}

messages! { "tf2_msgs":
    /// Poses of frames.
    TFMessage {
        /// The poses.
        transforms: Vec<TransformStamped>,
    }
}

impl Quaternion {
    /// A turn about the vertical, radians.
    pub fn of_heading(heading_rad: f64) -> Self {
        let (z, w) = (0.5 * heading_rad).sin_cos();
        Self {
            x: 0.0,
            y: 0.0,
            z,
            w,
        }
    }
}

impl From<Pose2> for Pose {
    fn from(pose: Pose2) -> Self {
        Self {
            position: Point {
                x: pose.x,
                y: pose.y,
                z: 0.0,
            },
            orientation: Quaternion::of_heading(pose.heading),
        }
    }
}

impl From<Pose2> for Transform {
    fn from(pose: Pose2) -> Self {
        Self {
            translation: Vector3 {
                x: pose.x,
                y: pose.y,
                z: 0.0,
            },
            rotation: Quaternion::of_heading(pose.heading),
        }
    }
}
