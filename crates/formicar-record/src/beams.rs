//! The beams of a laser: in counter-clockwise order, of a laser that stands upright.

use crate::error::RecordError;
use crate::frames::Pose3;
use crate::messages::LaserScan as ScanMessage;
use formicar::Pose2;
use formicar_mapping::LaserScan;

/// The largest angle between a laser's axis and the vertical, degrees.
const MAX_TILT_DEG: f64 = 3.0;
/// A scan, with beams counter-clockwise.
pub(crate) fn scan_of(message: &ScanMessage, time_s: f64) -> LaserScan {
    let within = |&range: &f32| {
        if range < message.range_min {
            0.0
        } else if range > message.range_max {
            f32::INFINITY
        } else {
            range
        }
    };
    let scan = LaserScan {
        time_s,
        first_angle_rad: f64::from(message.angle_min),
        angle_step_rad: f64::from(message.angle_increment),
        ranges_m: message.ranges.iter().map(within).collect(),
    };
    if scan.angle_step_rad < 0.0 {
        backwards(scan)
    } else {
        scan
    }
}

/// The same beams in the other order.
fn backwards(mut scan: LaserScan) -> LaserScan {
    scan.first_angle_rad = scan.angle_rad(scan.ranges_m.len().saturating_sub(1));
    scan.angle_step_rad = -scan.angle_step_rad;
    scan.ranges_m.reverse();
    scan
}

/// The scan as a laser that stands upright would have taken it.
pub(crate) fn turned(mut scan: LaserScan, is_flipped: bool) -> LaserScan {
    if !is_flipped {
        return scan;
    }
    scan.first_angle_rad = -scan.first_angle_rad;
    scan.angle_step_rad = -scan.angle_step_rad;
    backwards(scan)
}

/// The laser on the robot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mount {
    pub(crate) pose: Pose2,
    pub(crate) is_flipped: bool,
}

impl Mount {
    pub(crate) fn new(pose: Pose3, frame: &str) -> Result<Self, RecordError> {
        let [_, _, up] = pose.turned([0.0, 0.0, 1.0]);
        let tilt_deg = up.abs().min(1.0).acos().to_degrees();
        if tilt_deg > MAX_TILT_DEG {
            return Err(RecordError::Tilted {
                frame: frame.to_owned(),
                tilt_deg,
                limit_deg: MAX_TILT_DEG,
            });
        }
        Ok(Self {
            pose: pose.in_plane(),
            is_flipped: up < 0.0,
        })
    }
}
