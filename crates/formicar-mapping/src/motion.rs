//! Motion between scans: how far odometry is believed, and what is expected without it.

use crate::matrix::Sym3;
use formicar::Pose2;
use serde::{Deserialize, Serialize};

/// Standard deviations of a motion by odometry, before they are scaled to what the log shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OdometryNoise {
    /// Translation of any step, meters.
    pub base_m: f64,
    /// Translation per meter driven.
    pub per_m: f64,
    /// Heading of any step, radians.
    pub base_rad: f64,
    /// Heading per radian turned.
    pub per_rad: f64,
    /// Heading per meter driven, radians.
    pub turn_per_m: f64,
}

impl Default for OdometryNoise {
    fn default() -> Self {
        Self {
            base_m: 0.01,
            per_m: 0.06,
            base_rad: 0.3_f64.to_radians(),
            per_rad: 0.1,
            turn_per_m: 1.5_f64.to_radians(),
        }
    }
}

impl OdometryNoise {
    /// Standard deviations of a motion: translation in meters, heading in radians.
    pub fn sigmas(&self, motion: Pose2) -> (f64, f64) {
        let length = motion.position().norm();
        let turn = motion.heading.abs();
        (
            self.base_m + self.per_m * length,
            self.base_rad + self.per_rad * turn + self.turn_per_m * length,
        )
    }
}

/// Scales of the noise, learned from how far matched scans lie from the odometry.
///
/// Robots differ by a factor of ten: a fixed noise either bends long corridors or holds scans at
/// wrong poses.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NoiseScale {
    translation: Recent,
    heading: Recent,
    sideways: Sideways,
}

/// The angle between the robot's driving direction, as odometry has it, and the sensor's x axis.
///
/// Half a degree is a centimeter per meter: an odometry that is believed to the centimeter then
/// pushes every scan to one side, and a long corridor bends.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Sideways {
    /// Sideways deviation from the odometry and length of the newest motions, meters.
    motions: Vec<(f64, f64)>,
    next: usize,
}

/// Number of motions that the angle is taken from, and the least for one.
const SIDEWAYS_WINDOW: usize = 200;
const MIN_SIDEWAYS: usize = 20;
/// Shorter motions tell nothing about the angle, meters.
const MIN_SIDEWAYS_M: f64 = 0.1;
/// The largest angle that is believed, radians.
const MAX_SIDEWAYS_RAD: f64 = 0.1;

impl Sideways {
    fn push(&mut self, deviation_m: f64, length_m: f64) {
        if self.motions.len() < SIDEWAYS_WINDOW {
            self.motions.push((deviation_m, length_m));
        } else {
            self.motions[self.next] = (deviation_m, length_m);
        }
        self.next = (self.next + 1) % SIDEWAYS_WINDOW;
    }

    fn angle_rad(&self) -> f64 {
        if self.motions.len() < MIN_SIDEWAYS {
            return 0.0;
        }
        // The median of the ratios: one bad match turns nothing.
        let mut ratios: Vec<f64> = self.motions.iter().map(|(d, l)| d / l).collect();
        ratios.sort_by(f64::total_cmp);
        ratios[ratios.len() / 2].clamp(-MAX_SIDEWAYS_RAD, MAX_SIDEWAYS_RAD)
    }
}

/// Deviations over their standard deviations, the newest `WINDOW`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Recent {
    ratios: Vec<f64>,
    next: usize,
}

/// Number of deviations that a scale is taken from.
const WINDOW: usize = 60;
/// Deviations before the first scale is taken.
const MIN_RATIOS: usize = 8;
/// The scale before that: rather too loose than too tight.
const FIRST_SCALE: f64 = 1.5;
/// Least and greatest scale.
const SCALES: (f64, f64) = (0.1, 4.0);
/// The median of the absolute value of a normal variable, inverted.
const MEDIAN_TO_SIGMA: f64 = 1.4826;

impl Recent {
    fn push(&mut self, ratio: f64) {
        if self.ratios.len() < WINDOW {
            self.ratios.push(ratio);
        } else {
            self.ratios[self.next] = ratio;
        }
        self.next = (self.next + 1) % WINDOW;
    }

    fn scale(&self) -> f64 {
        if self.ratios.len() < MIN_RATIOS {
            return FIRST_SCALE;
        }
        let mut sorted = self.ratios.clone();
        sorted.sort_by(f64::total_cmp);
        (MEDIAN_TO_SIGMA * sorted[sorted.len() / 2]).clamp(SCALES.0, SCALES.1)
    }
}

impl NoiseScale {
    /// Notes a deviation of a matched scan from its prediction. The translation is that along the
    /// direction in which the scan tells most.
    pub fn note(&mut self, deviation: (f64, f64), sigmas: (f64, f64)) {
        self.translation.push((deviation.0 / sigmas.0).abs());
        self.heading.push((deviation.1 / sigmas.1).abs());
    }

    /// Notes a matched motion beside that of the odometry, both in the frame of the pose before.
    pub fn note_motion(&mut self, matched: Pose2, odometry: Pose2) {
        let length_m = odometry.x.abs();
        if length_m >= MIN_SIDEWAYS_M && odometry.heading.abs() < 0.2 {
            let sign = odometry.x.signum();
            self.sideways
                .push(sign * (matched.y - odometry.y), length_m);
        }
    }

    /// A motion of the odometry, turned by the angle between odometry and sensor.
    pub fn corrected(&self, motion: Pose2) -> Pose2 {
        let turned = Pose2::new(0.0, 0.0, self.sideways.angle_rad()).transform(motion.position());
        Pose2::at(turned, motion.heading)
    }

    /// The angle from the odometry's driving direction to the sensor's, radians.
    pub fn sideways_rad(&self) -> f64 {
        self.sideways.angle_rad()
    }

    /// The scales of translation and heading.
    pub fn scales(&self) -> (f64, f64) {
        (self.translation.scale(), self.heading.scale())
    }

    /// The information of a motion whose end has a heading: in the frame that the heading is in.
    pub fn information(&self, noise: &OdometryNoise, motion: Pose2, heading_rad: f64) -> Sym3 {
        let (sigma_m, sigma_rad) = noise.sigmas(motion);
        let (scale_m, scale_rad) = self.scales();
        let t = (sigma_m * scale_m).powi(-2);
        let h = (sigma_rad * scale_rad).powi(-2);
        Sym3::diagonal(t, t, h).turned(heading_rad)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_follows_the_log_and_forgets() {
        let mut scale = NoiseScale::default();
        assert_eq!(scale.scales(), (FIRST_SCALE, FIRST_SCALE));
        for i in 0..200 {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            scale.note((0.05 * sign, 0.001), (0.1, 0.1));
        }
        let (translation, heading) = scale.scales();
        assert!((translation - 0.5 * MEDIAN_TO_SIGMA).abs() < 1e-9);
        assert_eq!(heading, SCALES.0, "never below the least");
        for _ in 0..WINDOW {
            scale.note((0.2, 0.1), (0.1, 0.1));
        }
        assert!((scale.scales().0 - 2.0 * MEDIAN_TO_SIGMA).abs() < 1e-9);
    }

    #[test]
    fn a_sensor_that_is_mounted_askew_is_noticed() {
        let mut scale = NoiseScale::default();
        let odometry = Pose2::new(0.5, 0.0, 0.0);
        for i in 0..100 {
            let outlier = if i % 10 == 0 { 0.3 } else { 0.0 };
            scale.note_motion(Pose2::new(0.5, 0.01 + outlier, 0.0), odometry);
        }
        assert!((scale.sideways_rad() - 0.02).abs() < 1e-9);
        assert!((scale.corrected(odometry).y - 0.01).abs() < 1e-4);
    }

    #[test]
    fn noise_grows_with_the_motion() {
        let noise = OdometryNoise::default();
        let (a, b) = (
            noise.sigmas(Pose2::default()),
            noise.sigmas(Pose2::new(1.0, 0.0, 1.0)),
        );
        assert!(a.0 > 0.0 && a.1 > 0.0 && b.0 > a.0 && b.1 > a.1);
    }
}
