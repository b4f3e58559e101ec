//! Logs: scans in order, the odometry between them, and reference poses where a log has them.

pub mod carmen;
mod relations;
mod unpack;

pub use relations::{Relation, parse_relations};
pub use unpack::unpacked;

use crate::error::MappingError;
use crate::scan::LaserScan;
use formicar::Pose2;
use formicar::numeric::Fnv;

/// A log of one laser scanner on one robot.
///
/// All poses are those of the sensor. `odometry` is dead reckoning in a frame of its own: only the
/// motion from one scan to the next means something.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// The scans in the order in which they were taken.
    pub scans: Vec<LaserScan>,
    /// The sensor's pose by dead reckoning at each scan.
    pub odometry: Option<Vec<Pose2>>,
    /// The sensor's pose at each scan as another program, or a simulator, gives it.
    pub reference: Option<Vec<Pose2>>,
    /// Curiosities of the log that do not make it useless, as sentences.
    pub warnings: Vec<String>,
}

impl Log {
    /// The longest step of odometry between two scans that is believed, meters.
    pub const MAX_STEP_M: f64 = 20.0;
    /// Scans that are earlier than their predecessor by more than this are refused, seconds.
    pub const MAX_BACK_S: f64 = 10.0;

    /// Checks that the log can be mapped.
    ///
    /// # Errors
    /// No scans, beams that change number, scans with impossible geometry, times that run back,
    /// and odometry that jumps.
    pub fn checked(self, n_lines: usize) -> Result<Self, MappingError> {
        let Some(first) = self.scans.first() else {
            return Err(MappingError::NoScans { n_lines });
        };
        let expected = first.ranges_m.len();
        for (scan, s) in self.scans.iter().enumerate() {
            let n_beams = s.ranges_m.len();
            if n_beams != expected {
                return Err(MappingError::BeamsChange {
                    scan,
                    n_beams,
                    expected,
                });
            }
        }
        self.check_times()?;
        self.check_odometry()?;
        let scans = self.scans.into_iter().map(LaserScan::checked);
        let scans = scans.collect::<Result<_, _>>()?;
        Ok(Self { scans, ..self })
    }

    fn check_times(&self) -> Result<(), MappingError> {
        for (i, pair) in self.scans.windows(2).enumerate() {
            let back_s = pair[0].time_s - pair[1].time_s;
            if back_s > Self::MAX_BACK_S {
                return Err(MappingError::TimeRunsBack {
                    scan: i + 1,
                    time_s: pair[1].time_s,
                    back_s,
                });
            }
        }
        Ok(())
    }

    fn check_odometry(&self) -> Result<(), MappingError> {
        let Some(odometry) = &self.odometry else {
            return Ok(());
        };
        for (i, pair) in odometry.windows(2).enumerate() {
            let jump_m = pair[0].position().distance(pair[1].position());
            if jump_m.is_nan() || jump_m > Self::MAX_STEP_M {
                return Err(MappingError::OdometryJumps {
                    scan: i + 1,
                    jump_m,
                    limit_m: Self::MAX_STEP_M,
                });
            }
        }
        Ok(())
    }

    /// The motion by dead reckoning from scan `i - 1` to scan `i`, in the frame of the former.
    pub fn motion(&self, i: usize) -> Option<Pose2> {
        let odometry = self.odometry.as_ref()?;
        let before = odometry.get(i.checked_sub(1)?)?;
        Some(before.relative(*odometry.get(i)?).wrapped())
    }

    /// A hash of the scans (FNV-1a, 64 bits), to tell logs apart.
    pub fn fingerprint(&self) -> u64 {
        let mut hash = Fnv::default();
        for scan in &self.scans {
            hash.add(&scan.time_s.to_bits().to_le_bytes());
            for range in &scan.ranges_m {
                hash.add(&range.to_bits().to_le_bytes());
            }
        }
        hash.value()
    }

    /// The log without its odometry.
    #[must_use]
    pub fn without_odometry(self) -> Self {
        Self {
            odometry: None,
            ..self
        }
    }

    /// This log and one that follows it, whose odometry goes on from another place.
    ///
    /// # Errors
    /// Another number of beams.
    pub fn followed_by(mut self, next: Self) -> Result<Self, MappingError> {
        if let (Some(a), Some(b)) = (self.scans.first(), next.scans.first())
            && a.ranges_m.len() != b.ranges_m.len()
        {
            return Err(MappingError::BeamsChange {
                scan: self.scans.len(),
                n_beams: b.ranges_m.len(),
                expected: a.ranges_m.len(),
            });
        }
        self.odometry = match (self.odometry, next.odometry) {
            (Some(mut a), Some(b)) => {
                let joint = a.last().copied().unwrap_or_default();
                let first = b.first().copied().unwrap_or_default();
                a.extend(b.iter().map(|&pose| joint.compose(first.relative(pose))));
                Some(a)
            }
            _ => None,
        };
        self.reference = match (self.reference, next.reference) {
            (Some(mut a), Some(b)) => {
                a.extend(b);
                Some(a)
            }
            _ => None,
        };
        self.scans.extend(next.scans);
        self.warnings.extend(next.warnings);
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log(times: &[f64], odometry: &[f64]) -> Log {
        let scan = |&time_s: &f64| LaserScan {
            time_s,
            first_angle_rad: 0.0,
            angle_step_rad: 0.1,
            ranges_m: vec![1.0; 4],
        };
        Log {
            scans: times.iter().map(scan).collect(),
            odometry: Some(odometry.iter().map(|&x| Pose2::new(x, 0.0, 0.0)).collect()),
            ..Log::default()
        }
    }

    #[test]
    fn bad_logs_are_refused_with_the_scan() {
        let message = |log: Log| log.checked(7).unwrap_err().to_string();
        assert!(message(Log::default()).contains("7 lines and no laser scan"));
        assert!(message(log(&[0.0, -20.0], &[0.0, 1.0])).contains("20 s earlier"));
        assert!(message(log(&[0.0, 1.0], &[0.0, 50.0])).contains("jumps 50.0 m before scan 1"));
        let mut uneven = log(&[0.0, 1.0], &[0.0, 1.0]);
        uneven.scans[1].ranges_m.pop();
        assert!(message(uneven).contains("scan 1 has 3 beams, the scans before it have 4"));
        assert!(log(&[0.0, 1.0], &[0.0, 1.0]).checked(2).is_ok());
    }

    #[test]
    fn a_second_log_goes_on_where_the_first_ends() {
        let joined = log(&[0.0, 1.0], &[0.0, 2.0]).followed_by(log(&[2.0, 3.0], &[5.0, 6.0]));
        let joined = joined.unwrap();
        assert_eq!(joined.scans.len(), 4);
        assert_eq!(joined.motion(2), Some(Pose2::default()));
        assert_eq!(joined.motion(3).unwrap().x, 1.0);
        assert_eq!(joined.motion(0), None);
    }
}
