//! Speed of speed plans, and of the judge in time.

use divan::{Bencher, black_box};
use formicar::motion::{MotionConfig, MotionProblem, fastest, plan_motion};
use formicar::path::{CurvePath, Direction, SpeedLimits};
use formicar::scenario::{MovingObstacle, ObstacleMotion, ObstacleShape, Predictions};
use formicar::validation::{DriveRules, judge_in_time};
use formicar::{Point2, Pose2, Seed, Vehicle};

fn main() {
    divan::main();
}

/// 60 m of bends.
fn path() -> CurvePath {
    let mut path = CurvePath::new(Pose2::default());
    for i in 0..10 {
        let curvature = if i % 2 == 0 { 0.2 } else { -0.2 };
        path.push_clothoid([0.0, curvature], 2.0, Direction::Forward);
        path.push_clothoid([curvature, 0.0], 2.0, Direction::Forward);
        path.push(0.0, 2.0, Direction::Forward);
    }
    path
}

/// Walkers who cross the path within 30 s, none at its beginning.
fn walkers(n: u64, path: &CurvePath) -> Predictions {
    let walkers = (0..n).map(|i| {
        let mut stream = Seed(i).stream([18, 2]);
        let at = path.pose_at(stream.range(5.0, path.length_m())).position();
        let (t_s, speed_mps) = (stream.range(2.0, 30.0), stream.range(0.5, 1.5));
        let velocity = Point2::unit(stream.range(1.0, 2.0)) * speed_mps;
        let begin = at - velocity * t_s;
        MovingObstacle {
            name: None,
            shape: ObstacleShape::Disc { radius_m: 0.3 },
            motion: ObstacleMotion::Velocity {
                pose: [begin.x, begin.y, 0.0],
                velocity_mps: [velocity.x, velocity.y],
            },
            growth_mps: 0.0,
        }
    });
    Predictions::new(walkers.collect(), 30.0).expect("numbers within their ranges")
}

#[divan::bench]
fn fastest_60m(bencher: Bencher) {
    let (path, vehicle) = (path(), Vehicle::sedan());
    let limits = SpeedLimits::default();
    bencher.bench_local(|| fastest(black_box(&path), &vehicle, &limits, 0.1));
}

#[divan::bench(args = [3, 30])]
fn plan_60m(bencher: Bencher, n: u64) {
    let (path, vehicle) = (path(), Vehicle::warehouse_amr());
    let predictions = walkers(n, &path);
    let problem = MotionProblem {
        path: &path,
        vehicle: &vehicle,
        predictions: &predictions,
        zones: None,
    };
    let config = MotionConfig::default();
    bencher.bench_local(|| plan_motion(black_box(&problem), &config).is_ok());
}

#[divan::bench(args = [3, 30])]
fn judge_60m(bencher: Bencher, n: u64) {
    let (path, vehicle) = (path(), Vehicle::warehouse_amr());
    let predictions = walkers(n, &path);
    let limits = SpeedLimits::default();
    let timed = fastest(&path, &vehicle, &limits, 0.1);
    let rules = DriveRules {
        vehicle: &vehicle,
        limits: &limits,
        zones: None,
        present_speed_mps: 0.0,
        predictions: &predictions,
        distance_m: 0.1,
    };
    bencher.bench_local(|| judge_in_time(black_box(&rules), &timed).valid);
}
