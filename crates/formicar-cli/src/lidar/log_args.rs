//! Flags that choose what is taken out of a log.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::values;
use clap::Args;
use formicar::Pose2;

/// Flags for logs; most of them for bags of ROS 2.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct LogArgs {
    /// Use the scans alone.
    #[arg(long)]
    pub(crate) no_odometry: bool,

    /// Topic of the scans (sensor_msgs/LaserScan), where a bag has several.
    #[arg(long, value_name = "TOPIC")]
    pub(crate) scan_topic: Option<String>,

    /// Topic of the odometry (nav_msgs/Odometry), where a bag has several; /tf takes it from the
    /// frame odom.
    #[arg(long, value_name = "TOPIC")]
    pub(crate) odom_topic: Option<String>,

    /// Pose of the laser on the robot, in place of the one in the bag's transforms.
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(crate) laser_pose: Option<Pose2>,
}

impl LogArgs {
    /// The first flag for bags that is given.
    pub(super) fn first_flag(&self) -> Option<&'static str> {
        let flags = [
            ("--scan-topic", self.scan_topic.is_some()),
            ("--odom-topic", self.odom_topic.is_some()),
            ("--laser-pose", self.laser_pose.is_some()),
        ];
        flags
            .iter()
            .find(|(_, given)| *given)
            .map(|(flag, _)| *flag)
    }

    #[cfg(feature = "record")]
    pub(super) fn options(&self) -> formicar_record::LogOptions {
        formicar_record::LogOptions {
            scan_topic: self.scan_topic.clone(),
            odometry_topic: self.odom_topic.clone(),
            laser_pose: self.laser_pose,
            no_odometry: self.no_odometry,
        }
    }
}
