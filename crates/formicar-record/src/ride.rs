//! A laser that rides on a robot: the odometry of its scans.

use crate::beams::{Mount, turned};
use crate::error::RecordError;
use crate::frames::{Frames, Pose3, PoseTrack};
use formicar::Pose2;
use formicar_mapping::{LaserScan, Log};

/// The source of a robot's motion.
pub(crate) enum Motion<'a> {
    Odometry(&'a PoseTrack),
    /// Its frame is that of transforms.
    Frame(String),
}

/// A laser on its robot over time.
pub(crate) struct Ride<'a> {
    pub(crate) source: Motion<'a>,
    /// The frame on the robot that the motion is that of.
    pub(crate) base: String,
    pub(crate) frames: &'a Frames,
    pub(crate) laser_pose: Option<Pose3>,
}

impl Ride<'_> {
    fn base_at(&self, time_s: f64) -> Option<Pose2> {
        let pose = match &self.source {
            Motion::Odometry(track) => track.at(time_s),
            Motion::Frame(odom) => self.frames.pose_in(&self.base, odom, time_s).ok(),
        };
        pose.map(Pose3::in_plane)
    }

    fn mount_at(&self, frame: &str, time_s: f64) -> Result<Mount, RecordError> {
        if let Some(pose) = self.laser_pose {
            return Mount::new(pose, frame);
        }
        let pose = self.frames.pose_in(frame, &self.base, time_s);
        let pose = pose.map_err(|reason| RecordError::Frames {
            from: frame.to_owned(),
            to: self.base.clone(),
            reason,
            hint: "--laser-pose X,Y,H says where the laser is on the robot, and --no-odometry \
                   needs no such place",
        })?;
        Mount::new(pose, frame)
    }

    /// Adds scans and odometry to a log.
    pub(crate) fn fill(
        &self,
        log: &mut Log,
        scans: Vec<LaserScan>,
        frame: &str,
    ) -> Result<(), RecordError> {
        let n_scans = scans.len();
        let mut odometry = Vec::with_capacity(n_scans);
        for scan in scans {
            let Some(base) = self.base_at(scan.time_s) else {
                continue;
            };
            let mount = self.mount_at(frame, scan.time_s)?;
            odometry.push(base.compose(mount.pose).wrapped());
            log.scans.push(turned(scan, mount.is_flipped));
        }
        let n_left_out = n_scans - odometry.len();
        if odometry.is_empty() {
            return Err(RecordError::Mismatch {
                thing: "the odometry".to_owned(),
                value: format!("at the time of no scan, of {n_scans}"),
                limit: "it must cover the scans to 0.2 s".to_owned(),
                hint: "--no-odometry takes the motion from the scans, or --odom-topic names \
                       another source"
                    .to_owned(),
            });
        }
        if n_left_out > 0 {
            log.warnings.push(format!(
                "{n_left_out} of {n_scans} scans are left out: the odometry does not cover them"
            ));
        }
        log.odometry = Some(odometry);
        Ok(())
    }
}
