//! One sweep of a planar laser: ranges, and which of them are hits.

use crate::error::MappingError;
use formicar::Point2;
use serde::{Deserialize, Serialize};

/// One sweep of a planar laser scanner.
///
/// Beam `i` points at `first_angle_rad + i * angle_step_rad`, counter-clockwise from the x axis of
/// the sensor. Ranges are meters, as the sensor gave them: NaN, infinity, 0 and codes for "no
/// return" are kept, and a [`RangePolicy`] says what they are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LaserScan {
    /// Time of the scan, seconds.
    pub time_s: f64,
    /// Direction of the first beam, radians.
    pub first_angle_rad: f64,
    /// Angle from beam to beam, radians, above 0.
    pub angle_step_rad: f64,
    /// Ranges, meters.
    pub ranges_m: Vec<f32>,
}

impl LaserScan {
    /// Most beams of a scan.
    pub const MAX_BEAMS: usize = 100_000;

    /// A scan whose geometry is checked.
    ///
    /// # Errors
    /// No beams, more than [`Self::MAX_BEAMS`], angles that are not finite, a step outside
    /// (0, π/4], or a field of view beyond a full turn.
    pub fn checked(self) -> Result<Self, MappingError> {
        let n_beams = self.ranges_m.len();
        if n_beams == 0 || n_beams > Self::MAX_BEAMS {
            return Err(MappingError::BeamCount { n_beams });
        }
        let step = self.angle_step_rad;
        let is_step = step > 0.0 && step <= std::f64::consts::FRAC_PI_4;
        let span_rad = step * (n_beams - 1) as f64;
        let is_turn = span_rad <= std::f64::consts::TAU + step;
        if is_step && is_turn && self.first_angle_rad.abs() <= 10.0 && self.time_s.is_finite() {
            return Ok(self);
        }
        Err(MappingError::ScanGeometry {
            first_angle_rad: self.first_angle_rad,
            angle_step_rad: step,
            n_beams,
        })
    }

    /// The direction of a beam, radians.
    pub fn angle_rad(&self, beam: usize) -> f64 {
        self.first_angle_rad + self.angle_step_rad * beam as f64
    }

    /// The point at a range along a beam, in the frame of the sensor.
    pub fn point(&self, beam: usize, range_m: f64) -> Point2 {
        Point2::unit(self.angle_rad(beam)) * range_m
    }
}

/// A sector in which the sensor sees the robot that carries it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SelfMask {
    /// Lower end of the sector, radians in the frame of the sensor.
    pub from_rad: f64,
    /// Upper end of the sector, radians.
    pub to_rad: f64,
    /// Ranges up to this one are the robot's own body, meters.
    pub up_to_m: f64,
}

/// The rule that tells hits from everything else that a sensor reports.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RangePolicy {
    /// Shorter ranges are dust, glass or the housing, meters.
    pub min_m: f64,
    /// Longer ranges are not used, meters.
    pub max_m: f64,
    /// Ranges from this one on mean "no return", meters; `None` finds the code in the log
    /// ([`RangePolicy::resolved`]).
    pub no_return_m: Option<f64>,
    /// Sectors with the robot's own body.
    pub self_masks: Vec<SelfMask>,
}

impl Default for RangePolicy {
    fn default() -> Self {
        Self {
            min_m: 0.1,
            max_m: 40.0,
            no_return_m: None,
            self_masks: Vec::new(),
        }
    }
}

/// The kind of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeKind {
    /// A surface.
    Hit,
    /// NaN, infinite, zero or negative.
    Invalid,
    /// Below the least range.
    TooNear,
    /// Above the greatest range in use.
    TooFar,
    /// The sensor's code for "nothing seen".
    NoReturn,
    /// The robot's own body.
    OwnBody,
}

impl RangePolicy {
    /// A share of beams this large, all within [`Self::CODE_WIDTH`] of the longest range, is a code.
    pub const CODE_SHARE: f64 = 0.004;
    /// Relative width of the band below the longest range that counts as the code.
    pub const CODE_WIDTH: f64 = 0.025;

    /// Checks the limits.
    ///
    /// # Errors
    /// Limits that are not finite or not in order.
    pub fn check(&self) -> Result<(), MappingError> {
        let code = self.no_return_m.unwrap_or(self.max_m);
        if self.min_m >= 0.0 && self.max_m > self.min_m && self.max_m <= 1e4 && code > self.min_m {
            return Ok(());
        }
        Err(MappingError::RangeLimits {
            min_m: self.min_m,
            max_m: self.max_m,
            no_return_m: code,
        })
    }

    /// The policy with the no-return code of a log: the longest ranges, where at least
    /// [`Self::CODE_SHARE`] of all finite ranges crowd within [`Self::CODE_WIDTH`] of the longest,
    /// three times as many as in the double width below.
    #[must_use]
    pub fn resolved<'a>(&self, scans: impl Iterator<Item = &'a LaserScan> + Clone) -> Self {
        if self.no_return_m.is_some() {
            return self.clone();
        }
        let finite = scans.flat_map(|scan| scan.ranges_m.iter());
        let finite = finite.filter(|range| range.is_finite() && **range > 0.0);
        let longest = f64::from(finite.clone().fold(0.0_f32, |a, &b| a.max(b)));
        let from = longest * (1.0 - Self::CODE_WIDTH);
        let below = longest * (1.0 - 3.0 * Self::CODE_WIDTH);
        let (mut n_all, mut n_code, mut n_below) = (0_u64, 0_u64, 0_u64);
        for range in finite.map(|&range| f64::from(range)) {
            n_all += 1;
            n_code += u64::from(range >= from);
            n_below += u64::from((below..from).contains(&range));
        }
        let is_frequent = n_code as f64 >= Self::CODE_SHARE * n_all as f64;
        let is_code = n_all > 0 && is_frequent && n_code > 3 * n_below;
        Self {
            no_return_m: is_code.then_some(from),
            ..self.clone()
        }
    }

    /// The kind of a range along a direction of the sensor.
    pub fn kind(&self, range_m: f64, angle_rad: f64) -> RangeKind {
        if !range_m.is_finite() || range_m <= 0.0 {
            return RangeKind::Invalid;
        }
        if range_m < self.min_m {
            return RangeKind::TooNear;
        }
        if self.no_return_m.is_some_and(|code| range_m >= code) {
            return RangeKind::NoReturn;
        }
        if range_m >= self.max_m {
            return RangeKind::TooFar;
        }
        let is_own = |mask: &SelfMask| {
            (mask.from_rad..=mask.to_rad).contains(&angle_rad) && range_m <= mask.up_to_m
        };
        if self.self_masks.iter().any(is_own) {
            return RangeKind::OwnBody;
        }
        RangeKind::Hit
    }
}

/// How many ranges of each kind a log has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RangeCounts {
    /// Surfaces.
    pub n_hits: u64,
    /// NaN, infinite, zero or negative.
    pub n_invalid: u64,
    /// Below the least range.
    pub n_too_near: u64,
    /// Above the greatest range in use.
    pub n_too_far: u64,
    /// The sensor's code for "nothing seen".
    pub n_no_return: u64,
    /// The robot's own body.
    pub n_own_body: u64,
}

impl RangeCounts {
    /// Counts one more range.
    pub fn add(&mut self, kind: RangeKind) {
        *match kind {
            RangeKind::Hit => &mut self.n_hits,
            RangeKind::Invalid => &mut self.n_invalid,
            RangeKind::TooNear => &mut self.n_too_near,
            RangeKind::TooFar => &mut self.n_too_far,
            RangeKind::NoReturn => &mut self.n_no_return,
            RangeKind::OwnBody => &mut self.n_own_body,
        } += 1;
    }

    /// Adds the counts of another set.
    pub fn merge(&mut self, other: &Self) {
        self.n_hits += other.n_hits;
        self.n_invalid += other.n_invalid;
        self.n_too_near += other.n_too_near;
        self.n_too_far += other.n_too_far;
        self.n_no_return += other.n_no_return;
        self.n_own_body += other.n_own_body;
    }

    /// Number of ranges.
    pub fn n_all(&self) -> u64 {
        let rest = self.n_too_near + self.n_too_far + self.n_no_return + self.n_own_body;
        self.n_hits + self.n_invalid + rest
    }

    /// Names and numbers, for reports.
    pub fn named(&self) -> [(&'static str, u64); 6] {
        [
            ("hits", self.n_hits),
            ("no return", self.n_no_return),
            ("too far", self.n_too_far),
            ("too near", self.n_too_near),
            ("invalid", self.n_invalid),
            ("own body", self.n_own_body),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scan(ranges_m: Vec<f32>) -> LaserScan {
        LaserScan {
            time_s: 0.0,
            first_angle_rad: -1.0,
            angle_step_rad: 0.1,
            ranges_m,
        }
    }

    #[test]
    fn codes_and_broken_numbers_are_no_hits() {
        let mask = SelfMask {
            from_rad: -0.1,
            to_rad: 0.1,
            up_to_m: 0.4,
        };
        let policy = RangePolicy {
            no_return_m: Some(80.0),
            self_masks: vec![mask],
            ..RangePolicy::default()
        };
        for (range, kind) in [
            (f64::NAN, RangeKind::Invalid),
            (f64::INFINITY, RangeKind::Invalid),
            (0.0, RangeKind::Invalid),
            (-1.0, RangeKind::Invalid),
            (0.05, RangeKind::TooNear),
            (0.3, RangeKind::OwnBody),
            (0.5, RangeKind::Hit),
            (45.0, RangeKind::TooFar),
            (81.9, RangeKind::NoReturn),
        ] {
            assert_eq!(policy.kind(range, 0.0), kind, "{range}");
        }
    }

    #[test]
    fn the_code_of_a_log_is_where_its_longest_ranges_crowd() {
        let mut ranges: Vec<f32> = (0..500).map(|i| 1.0 + 0.01 * i as f32).collect();
        let policy = RangePolicy::default();
        assert_eq!(
            policy.resolved([scan(ranges.clone())].iter()).no_return_m,
            None
        );
        ranges.extend([81.91; 5]);
        let found = policy.resolved([scan(ranges)].iter()).no_return_m;
        assert!(
            found.is_some_and(|code| (79.0..81.91).contains(&code)),
            "{found:?}"
        );
    }

    #[test]
    fn impossible_geometry_is_refused() {
        assert!(scan(vec![1.0; 10]).checked().is_ok());
        assert!(scan(Vec::new()).checked().is_err());
        assert!(scan(vec![1.0; 100]).checked().is_err(), "more than a turn");
        let bad = LaserScan {
            angle_step_rad: f64::NAN,
            ..scan(vec![1.0])
        };
        assert!(bad.checked().is_err());
    }
}
