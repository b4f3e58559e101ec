//! Trajectories as text: CSV, and the format of the TUM benchmarks.

use crate::front_end::Quality;
use crate::localize::Located;
use crate::scan::LaserScan;
use formicar::Pose2;
use std::fmt::Write;

/// `scan,time_s,x_m,y_m,heading_rad`, a row per scan from 0.
pub fn to_csv(scans: &[LaserScan], poses: &[Pose2]) -> String {
    let mut text = "scan,time_s,x_m,y_m,heading_rad\n".to_owned();
    for (i, (scan, pose)) in scans.iter().zip(poses).enumerate() {
        let (x, y, heading) = (pose.x, pose.y, pose.heading);
        let _ = writeln!(text, "{i},{},{x:.6},{y:.6},{heading:.7}", scan.time_s);
    }
    text
}

/// `time x y z qx qy qz qw`, a line per scan.
pub fn to_tum(scans: &[LaserScan], poses: &[Pose2]) -> String {
    let mut text = String::new();
    for (scan, pose) in scans.iter().zip(poses) {
        let (sin, cos) = (0.5 * pose.heading).sin_cos();
        let (t, x, y) = (scan.time_s, pose.x, pose.y);
        let _ = writeln!(text, "{t} {x:.6} {y:.6} 0 0 0 {sin:.8} {cos:.8}");
    }
    text
}

/// The columns of [`to_csv`], then `quality,score,sigma_m,sigma_rad`: how a scan was found.
///
/// The rows of lost scans hold the expected pose; `sigma_m` is that of the worse direction.
pub fn located_to_csv(scans: &[LaserScan], found: &[Located]) -> String {
    let mut text = "scan,time_s,x_m,y_m,heading_rad,quality,score,sigma_m,sigma_rad\n".to_owned();
    for (i, (scan, located)) in scans.iter().zip(found).enumerate() {
        let Pose2 { x, y, heading } = located.pose;
        let c = located.covariance;
        let (mean, half) = (0.5 * (c.xx + c.yy), 0.5 * (c.xx - c.yy));
        let sigma_m = (mean + half.hypot(c.xy)).max(0.0).sqrt();
        let sigma_rad = c.hh.max(0.0).sqrt();
        let _ = writeln!(
            text,
            "{i},{},{x:.6},{y:.6},{heading:.7},{},{:.3},{sigma_m:.4},{sigma_rad:.5}",
            scan.time_s,
            quality_word(located.quality),
            located.score
        );
    }
    text
}

/// A quality as files spell it.
pub fn quality_word(quality: Quality) -> &'static str {
    match quality {
        Quality::First => "first",
        Quality::Ok => "ok",
        Quality::Widened => "widened",
        Quality::Lost => "lost",
        Quality::Degenerate => "degenerate",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_per_scan() {
        let scan = LaserScan {
            time_s: 1.5,
            ..LaserScan::default()
        };
        let pose = Pose2::new(1.0, -2.0, std::f64::consts::PI);
        assert_eq!(
            to_csv(std::slice::from_ref(&scan), &[pose]),
            "scan,time_s,x_m,y_m,heading_rad\n0,1.5,1.000000,-2.000000,3.1415927\n"
        );
        let tum = to_tum(&[scan], &[pose]);
        assert_eq!(tum, "1.5 1.000000 -2.000000 0 0 0 1.00000000 0.00000000\n");
    }
}
