//! Speeds and times along paths.

use formicar::motion::fastest;
use formicar::path::{CurvePath, Direction, SpeedLimits};
use formicar::{Pose2, Seed, Vehicle, VehicleParameters};

/// A path of lines, arcs and clothoids in both gears.
fn path(seed: u64) -> CurvePath {
    let mut stream = Seed(seed).stream([18, 0]);
    let mut path = CurvePath::new(Pose2::new(1.0, 2.0, stream.range(-3.0, 3.0)));
    let mut curvature = 0.0;
    for _ in 0..3 + stream.below(6) {
        let gear = [Direction::Forward, Direction::Reverse][stream.below(4) / 3];
        let length_m = stream.range(0.05, 6.0);
        match stream.below(3) {
            0 => {
                let next = stream.range(-0.4, 0.4);
                path.push_clothoid([curvature, next], length_m, gear);
                curvature = next;
            }
            1 => path.push(curvature, length_m, gear),
            _ => {
                curvature = [0.0, stream.range(-0.4, 0.4)][stream.below(2)];
                path.push(curvature, length_m, gear);
            }
        }
    }
    path
}

fn limits(seed: u64) -> SpeedLimits {
    let mut stream = Seed(seed).stream([18, 1]);
    SpeedLimits {
        max_speed_mps: stream.range(0.2, 4.0),
        max_lateral_mps2: stream.range(0.2, 3.0),
        max_acceleration_mps2: stream.range(0.1, 2.0),
        max_steer_rate_rad_per_s: (!seed.is_multiple_of(3)).then(|| stream.range(0.1, 1.0)),
        ..SpeedLimits::default()
    }
}

/// Speed, time and standing time at each sample, and the time of the whole drive.
fn numbers(path: &CurvePath, vehicle: &Vehicle, limits: &SpeedLimits) -> (Vec<[f64; 3]>, f64) {
    let timed = fastest(path, vehicle, limits, 0.1);
    let poses = timed.timed_poses(0.1);
    let poses = poses.iter();
    let poses = poses.map(|p| [p.speed_mps, p.time_s, p.stands_s]).collect();
    (poses, timed.duration_s())
}

/// FNV-1a over the bits of all numbers.
fn hash(numbers: impl IntoIterator<Item = f64>) -> u64 {
    let bytes = numbers.into_iter().flat_map(|x| x.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[test]
fn a_drive_without_obstacles_keeps_the_numbers_on_record() {
    let found: Vec<_> = (0..RECORD.len() as u64)
        .map(|seed| {
            let (poses, travel_time_s) = numbers(&path(seed), &Vehicle::lei2020(), &limits(seed));
            (travel_time_s.to_bits(), hash(poses.into_iter().flatten()))
        })
        .collect();
    assert_eq!(found, RECORD, "{found:#x?}");
}

#[test]
fn a_vehicle_without_a_wheelbase_turns_no_wheels() {
    let vehicle = Vehicle::new(VehicleParameters {
        wheelbase_m: None,
        max_steer_rad: None,
        max_steer_deg: None,
        track_width_m: None,
        min_turning_radius_m: Some(2.0),
        footprint: Some(formicar::vehicle::FootprintSpec::Points(vec![
            [0.0, 0.5],
            [2.0, 0.5],
            [2.0, -0.5],
            [0.0, -0.5],
        ])),
        ..Vehicle::lei2020().parameters().clone()
    })
    .unwrap();
    let (poses, _) = numbers(&path(1), &vehicle, &limits(1));
    assert!(poses.iter().all(|[_, _, stands_s]| *stands_s == 0.0));
}

/// Bits of the travel time, and the hash of all poses.
const RECORD: [(u64, u64); 16] = [
    (0x4040_0741_a53b_ecb9, 0xe83a_8b63_02d5_b2ed),
    (0x4031_13fb_4153_8c5b, 0xe5c0_288d_3c88_0fd9),
    (0x402d_cdf8_e699_2d65, 0x2718_61bc_5a29_b177),
    (0x401b_3b94_3e75_69f4, 0xac2e_c449_ffa1_159c),
    (0x4033_7417_fe83_ecce, 0x3dc5_159c_c282_0e91),
    (0x4031_17e4_9e14_093c, 0x8266_395f_3c87_7051),
    (0x403b_e0fc_b069_e22f, 0x75f8_5a35_96b8_89f9),
    (0x4021_afda_dec8_b851, 0x9186_f9ed_a157_7b45),
    (0x403a_24a2_c4d5_04d6, 0x90cc_b52f_4401_b5ca),
    (0x4028_789f_d61b_91ad, 0xf443_bf31_1b56_e1f2),
    (0x402c_067b_5a5e_c531, 0xb50d_8ed4_35ba_4ce0),
    (0x4031_cdae_bd79_0e25, 0x70f3_a43b_5493_f865),
    (0x4020_4846_c224_885a, 0xba6a_79fc_4387_5faf),
    (0x4049_7feb_bdc1_ec57, 0x2140_ce7d_ec10_f70d),
    (0x403f_6711_fd10_46a6, 0x1429_a8a3_05f4_dc5d),
    (0x3ff6_bae6_ff3a_13f4, 0x967a_06ad_71ee_ce1b),
];

/// Vehicles, paths and obstacles that cross.
mod crossings {
    use super::{limits, path};
    use crate::quick_or_full;
    use formicar::motion::{
        MotionConfig, MotionError, MotionPlan, MotionProblem, MotionStatus, ProfileSource,
        plan_motion,
    };
    use formicar::path::{CurvePath, Phase, SpeedLimits, TimedPath};
    use formicar::scenario::{
        MovingObstacle, ObstacleMotion, ObstacleShape, Predicted, Predictions, TimedWaypoint,
    };
    use formicar::validation::{DriveRules, TimedReport, TimedViolationKind, judge_in_time};
    use formicar::{Point2, Pose2, Seed, Vehicle};

    const HORIZON_S: f64 = 30.0;

    fn obstacle(seed: u64, i: u64, path: &CurvePath) -> MovingObstacle {
        let mut stream = Seed(seed).stream([19, i]);
        // It comes by some place of the path at some time.
        let at = path.pose_at(stream.range(0.3, 1.0) * path.length_m());
        let (angle, speed_mps) = (stream.range(-3.0, 3.0), stream.range(0.0, 1.6));
        let t_s = stream.range(0.0, 20.0);
        let velocity = Point2::unit(angle) * speed_mps;
        let beside = Point2::new(stream.range(-1.5, 1.5), stream.range(-1.5, 1.5));
        let begin = at.position() - velocity * t_s + beside;
        let pose = [begin.x, begin.y, angle];
        let motion = match stream.below(3) {
            0 => ObstacleMotion::Velocity {
                pose,
                velocity_mps: [velocity.x, velocity.y],
            },
            1 => ObstacleMotion::Turn {
                pose,
                speed_mps,
                rate_rad_per_s: stream.range(-0.5, 0.5),
            },
            _ => {
                let stop = at.position() + beside;
                let away = stop + Point2::unit(angle + 1.0) * stream.range(0.0, 8.0);
                ObstacleMotion::Waypoints(vec![
                    TimedWaypoint { t_s: 1.0, pose },
                    TimedWaypoint {
                        t_s: 2.0 + t_s,
                        pose: [stop.x, stop.y, angle + 0.5],
                    },
                    TimedWaypoint {
                        t_s: 12.0 + t_s,
                        pose: [away.x, away.y, angle - 1.0],
                    },
                ])
            }
        };
        let shape = match stream.below(2) {
            0 => ObstacleShape::Disc {
                radius_m: stream.range(0.2, 0.6),
            },
            _ => ObstacleShape::Polygon(vec![[-0.6, -0.3], [0.5, -0.4], [0.7, 0.2], [-0.5, 0.4]]),
        };
        MovingObstacle {
            name: None,
            shape,
            motion,
            growth_mps: [0.0, stream.range(0.0, 0.03)][stream.below(2)],
        }
    }

    /// Distance of the vehicle from an obstacle, by pairs of edges and corners.
    fn distance_m(vehicle: &Vehicle, pose: Pose2, obstacle: &Predicted, t_s: f64) -> f64 {
        let body = vehicle.footprint().placed(pose);
        let theirs = obstacle.corners_at(t_s);
        let ring = |corners: &[Point2]| {
            let n = corners.len();
            (0..n)
                .map(|i| (corners[i], corners[(i + 1) % n]))
                .collect::<Vec<_>>()
        };
        let to_segment = |p: Point2, (a, b): (Point2, Point2)| {
            let d = b - a;
            let share = if d.norm() > 0.0 {
                ((p - a).dot(d) / d.dot(d)).clamp(0.0, 1.0)
            } else {
                0.0
            };
            p.distance(a + d * share)
        };
        let mut least = f64::INFINITY;
        for &own in &ring(body.corners()) {
            for &other in &ring(&theirs) {
                least = least
                    .min(to_segment(own.0, other))
                    .min(to_segment(other.0, own));
            }
        }
        let inside = theirs.iter().any(|&p| body.contains(p));
        if inside {
            -1.0
        } else {
            least - obstacle.radius_at(t_s)
        }
    }

    /// The least distance of a drive, sampled, and where it ends.
    fn simulated_m(vehicle: &Vehicle, timed: &TimedPath, all: &Predictions, step_s: f64) -> f64 {
        let end_s = timed.duration_s().max(all.horizon_s());
        let n_steps = (end_s / step_s).ceil() as usize;
        let at_times = (0..=n_steps).map(|i| {
            let t_s = i as f64 * step_s;
            let pose = timed.pose_at(t_s);
            let distances = all.obstacles().iter();
            let distances = distances.map(|o| distance_m(vehicle, pose, o, t_s));
            distances.fold(f64::INFINITY, f64::min)
        });
        at_times.fold(f64::INFINITY, f64::min)
    }

    struct Crossing {
        path: CurvePath,
        vehicle: Vehicle,
        predictions: Predictions,
        config: MotionConfig,
    }

    fn crossing(seed: u64) -> Crossing {
        let path = path(seed);
        let mut stream = Seed(seed).stream([20, 0]);
        let obstacles = (0..=stream.below(4) as u64).map(|i| obstacle(seed, i, &path));
        let predictions = Predictions::new(obstacles.collect(), HORIZON_S).unwrap();
        let limits = SpeedLimits {
            max_braking_mps2: [None, Some(stream.range(0.5, 3.0))][stream.below(2)],
            ..limits(seed)
        };
        let max_jerk_mps3 = (seed % 6 == 5).then(|| stream.range(0.5, 3.0));
        let moving = stream.range(0.0, 0.5) * limits.max_speed_mps;
        let config = MotionConfig {
            distance_m: stream.range(0.0, 0.3),
            limits: SpeedLimits {
                max_jerk_mps3,
                ..limits
            },
            present_speed_mps: if seed % 5 == 4 { moving } else { 0.0 },
            ..MotionConfig::default()
        };
        Crossing {
            path,
            vehicle: Vehicle::lei2020(),
            predictions,
            config,
        }
    }

    impl Crossing {
        fn plan(&self) -> Result<MotionPlan, MotionError> {
            let problem = MotionProblem {
                path: &self.path,
                vehicle: &self.vehicle,
                predictions: &self.predictions,
                zones: None,
            };
            plan_motion(&problem, &self.config)
        }

        fn judge(&self, timed: &TimedPath) -> TimedReport {
            let rules = DriveRules {
                vehicle: &self.vehicle,
                limits: &self.config.limits,
                zones: None,
                present_speed_mps: self.config.present_speed_mps,
                predictions: &self.predictions,
                distance_m: self.config.distance_m,
            };
            judge_in_time(&rules, timed)
        }

        fn standing_m(&self) -> f64 {
            let standing = TimedPath::new(self.path.clone(), Vec::new());
            simulated_m(&self.vehicle, &standing, &self.predictions, 0.01)
        }
    }

    #[test]
    fn plans_keep_their_distance_and_the_judge_agrees_with_a_simulation() {
        let (mut n_fastest, mut n_lattice, mut n_waits, mut n_refused) = (0, 0, 0, 0);
        for seed in 0..quick_or_full(300, 10_000) {
            let crossing = crossing(seed);
            let plan = match crossing.plan() {
                Ok(plan) => plan,
                Err(MotionError::TooFast { .. } | MotionError::TooSlow { .. }) => continue,
                Err(MotionError::Unavoidable { .. }) if crossing.config.present_speed_mps > 0.0 => {
                    n_refused += 1;
                    continue;
                }
                Err(MotionError::Unavoidable { t_s, .. }) => {
                    // To stand is always allowed: then something must come to where it stands.
                    // Regions are closed up to a step and a piece too far.
                    let near_m = crossing.config.distance_m + 0.2 * 1.8 + 0.05;
                    assert!(crossing.standing_m() < near_m, "{seed} {t_s}");
                    n_refused += 1;
                    continue;
                }
                Err(error) => panic!("{seed}: {error}"),
            };
            let report = crossing.judge(&plan.timed);
            assert!(
                report.valid,
                "{seed} {:?}: {:#?}",
                plan.source, report.violations
            );
            let truth_m = simulated_m(&crossing.vehicle, &plan.timed, &crossing.predictions, 0.01);
            let proven_m = report.min_distance_m.unwrap();
            assert!(proven_m <= truth_m + 1e-9, "{seed}: {proven_m} {truth_m}");
            // Between two samples everything moves by at most 0.01 s of its speed.
            assert!(truth_m - proven_m < 0.1, "{seed}: {proven_m} {truth_m}");
            assert!(plan.timed.duration_s() >= plan.unhindered_s - 1e-9 || !plan.timed.arrives());
            match (plan.status, plan.source) {
                (MotionStatus::Waits, _) => n_waits += 1,
                (_, ProfileSource::Fastest) => n_fastest += 1,
                _ => n_lattice += 1,
            }
        }
        println!(
            "{n_fastest} undisturbed, {n_lattice} on the lattice, {n_waits} wait, {n_refused} refused"
        );
        assert!(n_fastest > 30 && n_lattice > 60 && n_waits > 10);
    }

    /// Seeds whose drives once broke a rule: one that begins in motion, one with bounded jerk where
    /// the whole path is closed for good, and one with both.
    #[test]
    fn drives_that_broke_a_rule_keep_it() {
        for seed in [394, 1631, 9569] {
            let crossing = crossing(seed);
            match crossing.plan() {
                Ok(plan) => assert!(crossing.judge(&plan.timed).valid, "{seed}"),
                Err(error) => assert!(matches!(error, MotionError::Unavoidable { .. }), "{seed}"),
            }
        }
    }

    #[test]
    fn no_delayed_start_is_faster() {
        let mut n_compared = 0;
        for seed in 0..quick_or_full(150, 2_000) {
            let crossing = crossing(seed);
            let Ok(plan) = crossing.plan() else { continue };
            let is_simple = crossing.config.present_speed_mps == 0.0
                && crossing.config.limits.max_jerk_mps3.is_none();
            if plan.source == ProfileSource::Fastest || !is_simple {
                continue;
            }
            let limits = &crossing.config.limits;
            let free = formicar::motion::fastest(&crossing.path, &crossing.vehicle, limits, 0.1);
            for i in 0..30 {
                let delay_s = f64::from(i);
                let standing = Phase {
                    duration_s: delay_s,
                    ..Phase::default()
                };
                let later = free.phases().iter().map(|phase| Phase {
                    t_s: phase.t_s + delay_s,
                    ..*phase
                });
                let phases = [standing].into_iter().chain(later).collect();
                let delayed = TimedPath::new(crossing.path.clone(), phases);
                let truth_m = simulated_m(&crossing.vehicle, &delayed, &crossing.predictions, 0.05);
                // With room for what the regions close too much.
                if truth_m > crossing.config.distance_m + 0.9 {
                    n_compared += 1;
                    let limit_s = delayed.duration_s() + 0.2 + 0.05 * free.duration_s();
                    let stops = 0.5 * plan.timed.stops().len() as f64;
                    assert!(
                        plan.timed.duration_s() < limit_s + stops,
                        "{seed} {delay_s}"
                    );
                    break;
                }
            }
        }
        println!("{n_compared} compared");
        assert!(n_compared > 3);
    }

    #[test]
    fn the_judge_refuses_drives_that_break_a_rule() {
        let mut n_hits = 0;
        for seed in 0..quick_or_full(100, 3_000) {
            let mut crossing = crossing(seed);
            crossing.config.present_speed_mps = 0.0;
            crossing.config.limits.max_jerk_mps3 = None;
            let limits = &crossing.config.limits;
            // Driven as if nothing moved.
            let free = formicar::motion::fastest(&crossing.path, &crossing.vehicle, limits, 0.1);
            let report = crossing.judge(&free);
            let truth_m = simulated_m(&crossing.vehicle, &free, &crossing.predictions, 0.002);
            let is_near = truth_m < crossing.config.distance_m;
            let kinds: Vec<_> = report.violations.iter().map(|v| v.kind).collect();
            assert!(
                kinds
                    .iter()
                    .all(|&kind| kind == TimedViolationKind::Distance),
                "{kinds:?}"
            );
            if is_near {
                n_hits += 1;
                assert!(!report.valid, "{seed}");
            }
            assert_eq!(report.valid, kinds.is_empty());
            // Twice as fast, it breaks others.
            let fast = free.phases().iter().map(|phase| Phase {
                t_s: 0.5 * phase.t_s,
                speed_mps: 2.0 * phase.speed_mps,
                acceleration_mps2: 4.0 * phase.acceleration_mps2,
                duration_s: 0.5 * phase.duration_s,
                ..*phase
            });
            let fast = TimedPath::new(crossing.path.clone(), fast.collect());
            let report = crossing.judge(&fast);
            let has = |kind| report.violations.iter().any(|v| v.kind == kind);
            assert!(has(TimedViolationKind::Acceleration), "{seed}");
        }
        assert!(n_hits > 20, "{n_hits}");
    }
}

/// Controllers that follow timed paths.
mod drives {
    use formicar::motion::fastest;
    use formicar::path::{CurvePath, Direction, SpeedLimits, TimedPath};
    use formicar::tracking::{
        Actuators, Controller, DriveCommand, DriveController, DriveMoment, PurePursuit,
        RegulatedPurePursuit, Stanley, StartOffset, TrackingConfig, TrackingError, TrackingStatus,
        track, track_by, track_in_time,
    };
    use formicar::{Pose2, Vehicle};

    const STEER_RATE: f64 = 0.6;

    /// Forward, a shunt, and forward again, with curvatures that change and one that jumps.
    fn timed() -> TimedPath {
        let mut path = CurvePath::new(Pose2::new(1.0, 2.0, 0.4));
        path.push(0.0, 3.0, Direction::Forward);
        path.push_clothoid([0.0, 0.35], 1.2, Direction::Forward);
        path.push(0.35, 1.5, Direction::Forward);
        path.push(-0.3, 2.0, Direction::Reverse);
        path.push_clothoid([-0.3, 0.1], 1.0, Direction::Reverse);
        path.push(0.2, 2.5, Direction::Forward);
        let limits = SpeedLimits {
            max_steer_rate_rad_per_s: Some(STEER_RATE),
            ..SpeedLimits::default()
        };
        fastest(&path, &Vehicle::lei2020(), &limits, 0.1)
    }

    fn config(controller: Controller, delay_s: f64) -> TrackingConfig {
        TrackingConfig {
            controller,
            max_steer_rate_rad_per_s: Some(1.05 * STEER_RATE),
            actuators: Actuators {
                delay_s,
                ..Actuators::default()
            },
            start_offset: StartOffset {
                lateral_m: 0.05,
                ..StartOffset::default()
            },
            ..TrackingConfig::default()
        }
    }

    fn laws() -> Vec<(Controller, f64)> {
        vec![
            (Controller::PurePursuit(PurePursuit::default()), 0.12),
            (Controller::Stanley(Stanley::default()), 0.25),
            (
                Controller::RegulatedPurePursuit(RegulatedPurePursuit::default()),
                0.25,
            ),
            #[cfg(feature = "mpc")]
            (
                Controller::Mpc(formicar::tracking::MpcParameters::default()),
                0.06,
            ),
        ]
    }

    #[test]
    fn every_controller_arrives_in_both_gears_at_about_its_time() {
        let (timed, vehicle) = (timed(), Vehicle::lei2020());
        for (law, most_m) in laws() {
            for delay_s in [0.0, 0.1] {
                let config = config(law, delay_s);
                let drive = track_in_time(&timed, None, &vehicle, &config).unwrap();
                let (name, summary) = (law.name(), &drive.summary);
                println!("{name} {delay_s}: {summary:?}");
                assert_eq!(drive.status, TrackingStatus::Arrived, "{name} {delay_s}");
                assert_eq!(summary.n_gear_changes, 2, "{name}");
                assert!(
                    summary.max_cross_track_error_m < most_m,
                    "{name} {summary:?}"
                );
                assert!(summary.goal_error_m < 0.2, "{name} {summary:?}");
                assert!(
                    (summary.duration_s - timed.duration_s()).abs() < 8.0,
                    "{name}"
                );
                assert_eq!(summary.n_controller_failures, 0, "{name}");
                let again = track_in_time(&timed, None, &vehicle, &config).unwrap();
                assert_eq!(drive, again, "{name}");
                // Wheels and speed keep the actuators' limits.
                for pair in drive.trace.windows(2) {
                    let dt = pair[1].t_s - pair[0].t_s;
                    let turn = (pair[1].steer_rad - pair[0].steer_rad).abs();
                    assert!(turn <= 1.05 * STEER_RATE * dt + 1e-9, "{name}");
                    let [a, b] = [pair[0].speed_mps.unwrap(), pair[1].speed_mps.unwrap()];
                    assert!((b - a).abs() <= 2.0 * dt + 1e-9, "{name}");
                }
            }
        }
    }

    #[test]
    fn a_controller_of_ones_own_drives() {
        struct Idle;
        impl DriveController for Idle {
            fn name(&self) -> &'static str {
                "idle"
            }
            fn command(&mut self, at: &DriveMoment) -> DriveCommand {
                at.drive(0.0, 0.0)
            }
        }
        let config = config(Controller::OpenLoop, 0.0);
        let drive = track_by(&timed(), None, &Vehicle::lei2020(), &config, &mut Idle).unwrap();
        assert_eq!(drive.status, TrackingStatus::GaveUp);
        assert_eq!(drive.summary.driven_m, 0.0);
    }

    #[test]
    fn laws_with_a_speed_of_their_own_need_a_timed_path() {
        let law = Controller::RegulatedPurePursuit(RegulatedPurePursuit::default());
        let refused = track(timed().path(), &Vehicle::lei2020(), &config(law, 0.0));
        assert!(matches!(refused, Err(TrackingError::NeedsTime { .. })));
        let bad = TrackingConfig {
            actuators: Actuators {
                delay_s: -1.0,
                ..Actuators::default()
            },
            ..config(law, 0.0)
        };
        let refused = track_in_time(&timed(), None, &Vehicle::lei2020(), &bad);
        assert!(
            refused
                .unwrap_err()
                .to_string()
                .contains("actuators.delay_s")
        );
    }
}
