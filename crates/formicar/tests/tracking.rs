//! Simulated drives: exact where they can be, convergent where they should be, refused where they
//! cannot be.

use formicar::collision::ObstacleMap;
use formicar::geometry::{Point2, Pose2, angle_difference};
use formicar::map::{GridFrame, OCCUPIED, OccupancyGrid};
use formicar::path::{CurvePath, Direction};
use formicar::tracking::{
    Controller, PurePursuit, Stanley, StartOffset, TracePoint, Tracking, TrackingConfig,
    TrackingError, TrackingStatus, swept_area_m2, track,
};
use formicar::validation::{CURVATURE_TOLERANCE, ViolationKind, judge_path};
use formicar::vehicle::{Vehicle, VehicleParameters};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use Direction::{Forward, Reverse};

const PURE_PURSUIT: Controller = Controller::PurePursuit(PurePursuit { lookahead_m: None });
const STANLEY: Controller = Controller::Stanley(Stanley {
    gain_per_s: 1.0,
    softening_mps: 0.0,
});
const ALL: [Controller; 3] = [Controller::OpenLoop, PURE_PURSUIT, STANLEY];

/// Without limits of steering rate and speed, so that a test says what it means of them.
fn lei2020() -> Vehicle {
    let parameters = VehicleParameters {
        max_steer_rate_rad_per_s: None,
        speed_mps: None,
        max_acceleration_mps2: None,
        ..Vehicle::lei2020().parameters().clone()
    };
    Vehicle::new(parameters).expect("a vehicle")
}

fn by(controller: Controller) -> TrackingConfig {
    TrackingConfig {
        controller,
        ..TrackingConfig::default()
    }
}

fn beside(controller: Controller, lateral_m: f64, heading_rad: f64) -> TrackingConfig {
    let start_offset = StartOffset {
        along_m: 0.0,
        lateral_m,
        heading_rad,
    };
    TrackingConfig {
        start_offset,
        ..by(controller)
    }
}

fn path(pieces: &[(f64, f64, Direction)]) -> CurvePath {
    let mut path = CurvePath::new(Pose2::new(1.0, -2.0, 0.3));
    for &(curvature_per_m, length_m, direction) in pieces {
        path.push(curvature_per_m, length_m, direction);
    }
    path
}

fn drive(path: &CurvePath, config: &TrackingConfig) -> Tracking {
    track(path, &lei2020(), config).expect("a path and parameters that can be driven")
}

/// A three-point turn with lines between its arcs.
fn shunt() -> CurvePath {
    path(&[
        (0.0, 3.0, Forward),
        (0.4, 4.0, Forward),
        (-0.4, 3.0, Reverse),
        (0.0, 2.0, Reverse),
        (0.35, 5.0, Forward),
        (0.0, 4.0, Forward),
    ])
}

#[test]
fn open_loop_drives_lines_circles_and_cusps_exactly() {
    let radius_m = lei2020().min_turning_radius_m();
    for path in [
        path(&[(0.0, 40.0, Forward)]),
        path(&[(1.0 / radius_m, 3.0 * TAU * radius_m, Forward)]),
        path(&[(-0.2, 30.0, Reverse)]),
        shunt(),
    ] {
        let drive = drive(&path, &by(Controller::OpenLoop));
        let summary = drive.summary;
        assert_eq!(drive.status, TrackingStatus::Arrived);
        assert!(summary.max_cross_track_error_m < 1e-9, "{summary:?}");
        assert!(summary.max_heading_error_rad < 1e-9, "{summary:?}");
        assert!(summary.goal_error_m < 1e-9 && summary.goal_error_rad < 1e-9);
        assert!((summary.driven_m - path.length_m()).abs() < 1e-9);
        assert!((summary.duration_s - path.length_m() / 0.3).abs() < 1e-6);
        assert_eq!(summary.steering_saturated_share, 0.0);
    }
}

#[test]
fn open_loop_keeps_the_offset_it_starts_with() {
    let path = shunt();
    let offset = Pose2::new(0.2, -0.4, 0.1);
    let mut config = beside(Controller::OpenLoop, offset.y, offset.heading);
    config.start_offset.along_m = offset.x;
    let drive = drive(&path, &config);
    let exact = path
        .start()
        .compose(offset)
        .compose(path.start().relative(path.end()));
    let end = drive.driven.end();
    assert!(end.position().distance(exact.position()) < 1e-9);
    assert!(angle_difference(end.heading, exact.heading).abs() < 1e-9);
}

#[test]
fn feedback_comes_back_to_lines_and_circles_in_both_gears() {
    for controller in [PURE_PURSUIT, STANLEY] {
        for gear in [Forward, Reverse] {
            for curvature in [0.0, 0.25, -0.3] {
                let path = path(&[(curvature, 40.0, gear)]);
                let drive = drive(&path, &beside(controller, 0.6, -0.3));
                let last = drive.trace.last().expect("a trace");
                let name = (controller.name(), gear, curvature);
                assert_eq!(drive.status, TrackingStatus::Arrived, "{name:?}");
                assert!(last.cross_track_error_m.abs() < 2e-3, "{name:?} {last:?}");
                assert!(last.heading_error_rad.abs() < 2e-3, "{name:?} {last:?}");
                assert!(drive.summary.goal_error_m < 5e-3, "{name:?}");
            }
        }
    }
}

/// Near the path the error of pure pursuit is that of an oscillator whose damping is 1/sqrt(2),
/// whatever the lookahead: it overshoots by exp(-pi).
#[test]
fn pure_pursuit_overshoots_as_its_equation_says() {
    for lookahead_m in [0.8, 2.0, 5.0] {
        let law = PurePursuit {
            lookahead_m: Some(lookahead_m),
        };
        let config = beside(Controller::PurePursuit(law), 0.01, 0.0);
        let drive = drive(&path(&[(0.0, 60.0, Forward)]), &config);
        let errors = drive.trace.iter().map(|p| p.cross_track_error_m);
        let overshoot = -errors.fold(f64::INFINITY, f64::min) / 0.01;
        assert!(
            (overshoot - (-PI).exp()).abs() < 2e-3,
            "{lookahead_m}: {overshoot}"
        );
    }
}

/// The front axle's distance falls by 1/e in the time 1/k.
#[test]
fn the_front_axle_comes_back_at_the_rate_of_the_gain() {
    for gain_per_s in [0.05, 0.2] {
        let law = Stanley {
            gain_per_s,
            softening_mps: 0.0,
        };
        let path = path(&[(0.0, 30.0, Forward)]);
        let drive = drive(&path, &beside(Controller::Stanley(law), 0.01, 0.0));
        let ratio = |p: &TracePoint| {
            let front = p.cross_track_error_m + 2.0 * p.heading_error_rad.sin();
            front / 0.01 / (-gain_per_s * p.t_s).exp()
        };
        let looked_at = drive.trace.iter().take_while(|p| p.t_s * gain_per_s < 3.0);
        assert!(looked_at.map(ratio).all(|r| (r - 1.0).abs() < 0.02));
    }
}

#[test]
fn reverse_is_driven_as_forward_by_a_car_that_faces_the_other_way() {
    let pieces = [(0.0, 4.0), (0.3, 6.0), (-0.2, 5.0)];
    for controller in ALL {
        let forward = path(&pieces.map(|(k, length)| (k, length, Forward)));
        let there = drive(&forward, &beside(controller, 0.3, 0.1));
        let start = Pose2::at(forward.start().position(), forward.start().heading + PI);
        let mut backward = CurvePath::new(start);
        for (k, length) in pieces {
            backward.push(-k, length, Reverse);
        }
        let back = drive(&backward, &beside(controller, -0.3, 0.1));
        assert_eq!(there.trace.len(), back.trace.len());
        for (a, b) in there.trace.iter().zip(&back.trace) {
            assert!(a.pose.position().distance(b.pose.position()) < 1e-9);
            assert!((a.cross_track_error_m + b.cross_track_error_m).abs() < 1e-9);
            assert!((a.steer_rad + b.steer_rad).abs() < 1e-9);
        }
    }
}

#[test]
fn a_path_with_cusps_is_driven_gear_by_gear() {
    let path = shunt();
    for controller in [PURE_PURSUIT, STANLEY] {
        let drive = drive(&path, &beside(controller, 0.05, 0.05));
        assert_eq!(drive.status, TrackingStatus::Arrived);
        assert_eq!(drive.summary.n_gear_changes, 2);
        assert!(
            drive.summary.max_cross_track_error_m < 0.1,
            "{:?}",
            drive.summary
        );
        assert!(drive.summary.goal_error_m < 0.05, "{:?}", drive.summary);
        let cusps: Vec<f64> = drive
            .trace
            .windows(2)
            .filter(|w| w[0].direction != w[1].direction)
            .map(|w| w[0].s_m)
            .collect();
        assert_eq!(cusps.len(), 2);
        assert!((cusps[0] - 7.0).abs() < 0.01 && (cusps[1] - 12.0).abs() < 0.01);
    }
}

#[test]
fn wheels_take_their_time_where_their_rate_is_limited() {
    let path = path(&[(0.3, 4.0, Forward), (-0.3, 4.0, Reverse)]);
    let config = TrackingConfig {
        max_steer_rate_rad_per_s: Some(0.2),
        ..by(Controller::OpenLoop)
    };
    let drive = drive(&path, &config);
    let steer_rad = 0.6_f64.atan();
    // From straight to one side, then while it stands at the cusp to the other.
    let standing_s = 3.0 * steer_rad / 0.2;
    assert!((drive.summary.duration_s - 8.0 / 0.3 - standing_s).abs() < 1e-6);
    assert!(drive.summary.max_cross_track_error_m < 1e-9);
}

#[test]
fn both_front_wheels_roll_about_one_center() {
    let limit = lei2020().max_curvature_per_m();
    let path = path(&[
        (limit, 5.0, Forward),
        (-0.2, 5.0, Forward),
        (0.1, 2.0, Reverse),
    ]);
    let drive = drive(&path, &by(STANLEY));
    for p in drive.trace.iter().filter(|p| p.steer_rad.abs() > 1e-3) {
        let (outer, inner) = if p.steer_rad > 0.0 {
            (p.right_wheel_rad, p.left_wheel_rad)
        } else {
            (-p.left_wheel_rad, -p.right_wheel_rad)
        };
        let difference = 1.0 / outer.tan() - 1.0 / inner.tan();
        assert!((difference - 0.4).abs() < 1e-9, "{p:?}");
    }
    // Lei & Zheng 2020: 40 degrees in the middle, about 45 at the inner wheel.
    assert!((drive.summary.max_steer_rad.to_degrees() - 40.0).abs() < 1e-9);
    assert!((drive.summary.max_wheel_rad.to_degrees() - 45.2).abs() < 0.1);
}

#[test]
fn a_vehicle_that_cannot_come_back_has_left_the_path_or_gives_up() {
    let bend = path(&[(0.0, 5.0, Forward), (0.4, 20.0, Forward)]);
    let slow = TrackingConfig {
        max_steer_rate_rad_per_s: Some(0.005),
        ..by(PURE_PURSUIT)
    };
    let drive_slow = drive(&bend, &slow);
    assert_eq!(drive_slow.status, TrackingStatus::LeftPath);
    let error_m = drive_slow.summary.max_cross_track_error_m;
    assert!((2.0..2.01).contains(&error_m), "{error_m}");

    let turned = TrackingConfig {
        give_up_error_m: 100.0,
        give_up_length_ratio: 1.0,
        ..beside(STANLEY, 0.0, 3.0)
    };
    let drive_turned = drive(&path(&[(0.0, 3.0, Forward)]), &turned);
    assert_eq!(drive_turned.status, TrackingStatus::GaveUp);
    let limit_m = 3.0 + lei2020().min_turning_radius_m();
    assert!((drive_turned.summary.driven_m - limit_m).abs() < 0.01);
}

#[test]
fn a_path_without_length_is_a_single_point() {
    let drive = drive(&path(&[]), &beside(STANLEY, 0.3, 0.1));
    assert_eq!(
        (drive.status, drive.trace.len()),
        (TrackingStatus::Arrived, 1)
    );
    assert_eq!(drive.summary.driven_m, 0.0);
    assert!((drive.summary.goal_error_m - 0.3).abs() < 1e-12);
    assert!((drive.summary.rms_cross_track_error_m - 0.3).abs() < 1e-12);
    assert!((drive.summary.swept_area_m2 - 3.0).abs() < 3e-3);
}

/// 40 x 10 m, with a wall across that leaves a gap of 4 m at the top.
fn walled() -> ObstacleMap {
    let frame = GridFrame::new(400, 100, 0.1, Pose2::default()).expect("a frame");
    let mut map = OccupancyGrid::free(frame);
    // Cells that a polygon touches are filled: up to x = 20 and y = 6 exactly.
    let wall = [(20.05, 0.0), (20.95, 0.0), (20.95, 5.95), (20.05, 5.95)];
    map.fill_polygon(&wall.map(|(x, y)| Point2::new(x, y)), OCCUPIED);
    ObstacleMap::new(&map)
}

#[test]
fn contact_and_clearance_are_where_geometry_puts_them() {
    let mut line = CurvePath::new(Pose2::new(2.0, 7.0, 0.0));
    line.push(0.0, 30.0, Forward);
    let driven = |lateral_m| {
        let drive = drive(&line, &beside(Controller::OpenLoop, lateral_m, 0.0));
        (drive.clearance(&walled(), &lei2020()), drive)
    };
    let (free, _) = driven(-0.3);
    assert_eq!(free.contact, None);
    // The body is 1 m wide: its side runs at 6.2, the wall ends at 6.
    assert!((free.min_clearance_m - 0.2).abs() < 1e-9, "{free:?}");
    let (hit, drive) = driven(-0.7);
    let contact = hit.contact.expect("its side runs at 5.8");
    // The front is 2.5 m ahead of the rear axle.
    assert!((contact.driven_m - 15.5).abs() < 1e-5, "{contact:?}");
    assert!((contact.t_s - 15.5 / 0.3).abs() < 1e-4, "{contact:?}");
    assert!((contact.s_m - 15.5).abs() < 1e-5);
    assert_eq!(
        (contact.kind, hit.min_clearance_m),
        (ViolationKind::Collision, 0.0)
    );
    assert_eq!(
        drive.status,
        TrackingStatus::Arrived,
        "contact does not stop it"
    );
}

#[test]
fn what_stands_in_a_wall_touches_at_once() {
    let stand = CurvePath::new(Pose2::new(19.0, 3.0, 0.0));
    let drive = drive(&stand, &by(STANLEY));
    let clearance = drive.clearance(&walled(), &lei2020());
    let contact = clearance.contact.expect("a contact");
    assert_eq!((contact.t_s, contact.driven_m), (0.0, 0.0));
}

#[test]
fn parameters_out_of_range_are_refused_with_value_and_range() {
    type Change = fn(&mut TrackingConfig);
    let cases: [(Change, &[&str]); 12] = [
        (
            |c| c.speed_mps = Some(0.0),
            &["speed_mps", "= 0;", "0.001 to 100"],
        ),
        (|c| c.speed_mps = Some(f64::NAN), &["speed_mps", "NaN"]),
        (
            |c| c.time_step_s = 2.0,
            &["time_step_s", "= 2;", "0.0001 to 1"],
        ),
        (
            |c| c.time_step_s = 0.9,
            &["time_step_s", "= 0.9;", "0.1 rad"],
        ),
        (|c| c.record_interval_s = -1.0, &["record_interval_s", "-1"]),
        (
            |c| c.max_steer_rate_rad_per_s = Some(0.0),
            &["max_steer_rate"],
        ),
        (|c| c.start_offset.heading_rad = 4.0, &["heading_rad", "4"]),
        (
            |c| c.start_offset.lateral_m = -2.0,
            &["lateral_m", "-2", "below give_up_error_m = 2"],
        ),
        (
            |c| c.start_offset.along_m = f64::INFINITY,
            &["along_m", "inf"],
        ),
        (
            |c| c.give_up_length_ratio = 0.5,
            &["give_up_length_ratio", "1 to 100"],
        ),
        (
            |c| {
                c.controller = Controller::PurePursuit(PurePursuit {
                    lookahead_m: Some(0.0),
                });
            },
            &["lookahead_m", "0.01 to 100"],
        ),
        (
            |c| {
                c.controller = Controller::Stanley(Stanley {
                    gain_per_s: -1.0,
                    softening_mps: 0.0,
                });
            },
            &["gain_per_s", "-1", "0.01 to 100"],
        ),
    ];
    for (change, words) in cases {
        let mut config = TrackingConfig::default();
        change(&mut config);
        let error = track(&shunt(), &lei2020(), &config).expect_err("out of range");
        let text = error.to_string();
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
    }
}

#[test]
fn vehicles_and_paths_that_cannot_be_driven_are_refused() {
    let config = TrackingConfig::default();
    let of = |vehicle: &Vehicle, path: &CurvePath| track(path, vehicle, &config).unwrap_err();
    assert_eq!(of(&Vehicle::point(), &shunt()), TrackingError::NeedsACar);
    let lei = lei2020();
    let corners = lei.footprint().corners().iter().map(|p| [p.x, p.y]);
    let no_wheelbase = VehicleParameters {
        footprint: Some(formicar::vehicle::FootprintSpec::Points(corners.collect())),
        min_turning_radius_m: Some(3.0),
        ..VehicleParameters::default()
    };
    let vehicle = Vehicle::new(no_wheelbase).expect("a vehicle");
    assert_eq!(of(&vehicle, &shunt()), TrackingError::NeedsAWheelbase);
    let endless = path(&[(0.0, 1e5, Forward)]);
    assert!(matches!(of(&lei, &endless), TrackingError::TooLong { .. }));
}

#[test]
fn what_is_left_out_comes_from_the_vehicle() {
    let fast = VehicleParameters {
        speed_mps: Some(1.5),
        max_steer_rate_rad_per_s: Some(0.7),
        ..Vehicle::sedan().parameters().clone()
    };
    let vehicle = Vehicle::new(fast).expect("a vehicle");
    let complete = by(PURE_PURSUIT).for_vehicle(&vehicle).expect("in range");
    assert_eq!(complete.speed_mps, Some(1.5));
    assert_eq!(complete.max_steer_rate_rad_per_s, Some(0.7));
    let law = PurePursuit {
        lookahead_m: Some(1.4),
    };
    assert_eq!(complete.controller, Controller::PurePursuit(law));
    let text = serde_json::to_string(&complete).expect("JSON");
    assert_eq!(
        serde_json::from_str::<TrackingConfig>(&text).expect("read back"),
        complete
    );
    assert!(serde_json::from_str::<TrackingConfig>(r#"{"sped_mps": 1}"#).is_err());
    let unknown = r#"{"controller": {"law": "stanley", "lookahead_m": 1}}"#;
    assert!(serde_json::from_str::<TrackingConfig>(unknown).is_err());
}

#[test]
fn the_trace_as_csv_has_a_row_per_point() {
    let drive = drive(&shunt(), &by(STANLEY));
    let csv = drive.trace_csv();
    let columns = |line: &str| line.split(',').count();
    assert_eq!(csv.lines().count(), drive.trace.len() + 1);
    assert!(csv.lines().all(|line| columns(line) == 12));
}

fn any_path(max_curvature_per_m: f64) -> impl Strategy<Value = CurvePath> {
    let gear = prop_oneof![3 => Just(Forward), 1 => Just(Reverse)];
    let piece = (-max_curvature_per_m..max_curvature_per_m, 0.0..6.0, gear);
    prop::collection::vec(piece, 1..8).prop_map(|pieces| path(&pieces))
}

fn any_controller() -> impl Strategy<Value = Controller> {
    let pure_pursuit = (0.3..4.0).prop_map(|m| {
        Controller::PurePursuit(PurePursuit {
            lookahead_m: Some(m),
        })
    });
    let stanley = (0.1..5.0, 0.0..1.0).prop_map(|(gain_per_s, softening_mps)| {
        Controller::Stanley(Stanley {
            gain_per_s,
            softening_mps,
        })
    });
    prop_oneof![Just(Controller::OpenLoop), pure_pursuit, stanley]
}

prop_compose! {
    fn any_drive()(
        path in any_path(0.41),
        controller in any_controller(),
        (lateral_m, heading_rad) in (-1.0..1.0, -1.0..1.0),
        rate in prop::option::of(0.1..2.0),
    ) -> (CurvePath, TrackingConfig) {
        let config = TrackingConfig {
            max_steer_rate_rad_per_s: rate,
            ..beside(controller, lateral_m, heading_rad)
        };
        (path, config)
    }
}

fn mirrored(pose: Pose2) -> Pose2 {
    Pose2::new(pose.x, -pose.y, -pose.heading)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 5))]

    #[test]
    fn limits_are_kept_everywhere((path, config) in any_drive()) {
        let vehicle = lei2020();
        let drive = drive(&path, &config);
        let limit_rad = 40_f64.to_radians() + 1e-12;
        prop_assert!(drive.summary.max_steer_rad <= limit_rad);
        prop_assert!(drive.trace.iter().all(|p| p.steer_rad.abs() <= limit_rad));
        let steer = |i: usize| (2.0 * drive.driven.segments()[i].curvature_per_m).atan();
        if let Some(rate) = config.max_steer_rate_rad_per_s {
            for (i, pair) in drive.driven.segments().windows(2).enumerate() {
                let most = rate * config.time_step_s + 1e-9;
                let stands = pair[0].direction != pair[1].direction;
                prop_assert!(stands || (steer(i + 1) - steer(i)).abs() <= most);
            }
        }
        // The judge takes what was driven for a path like any other.
        let frame = GridFrame::new(200, 200, 1.0, Pose2::new(-100.0, -100.0, 0.0)).expect("a frame");
        let free = ObstacleMap::new(&OccupancyGrid::free(frame));
        let report = judge_path(&free, &vehicle, &drive.driven, CURVATURE_TOLERANCE);
        prop_assert!(report.valid, "{:?}", report.violations);
    }

    #[test]
    fn left_and_right_are_alike((path, config) in any_drive()) {
        let mut flipped = CurvePath::new(mirrored(path.start()));
        for s in path.segments() {
            flipped.push(-s.curvature_per_m, s.length_m, s.direction);
        }
        let mut other = config.clone();
        other.start_offset.lateral_m *= -1.0;
        other.start_offset.heading_rad *= -1.0;
        let (a, b) = (drive(&path, &config), drive(&flipped, &other));
        prop_assert_eq!((a.status, a.trace.len()), (b.status, b.trace.len()));
        for (p, q) in a.trace.iter().zip(&b.trace) {
            // Rounding may give one of them a last small step more, of a hundredth of a whole one.
            prop_assert!(p.pose.position().distance(mirrored(q.pose).position()) < 1e-3);
            prop_assert!((p.steer_rad + q.steer_rad).abs() < 1e-2);
        }
    }

    #[test]
    fn the_same_drive_twice((path, config) in any_drive()) {
        prop_assert_eq!(drive(&path, &config), drive(&path, &config));
    }

    #[test]
    fn a_little_beside_the_path_feedback_stays_there(
        // A quarter of the limit is left for corrections.
        path in any_path(0.31),
        lateral_m in -0.05..0.05,
    ) {
        for controller in [PURE_PURSUIT, STANLEY] {
            let drive = drive(&path, &beside(controller, lateral_m, 0.0));
            prop_assert_eq!(drive.status, TrackingStatus::Arrived);
            prop_assert!(drive.summary.max_cross_track_error_m < 0.25, "{:?}", drive.summary);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 12))]

    #[test]
    fn swept_area_is_that_of_a_raster(path in any_path(0.41)) {
        let vehicle = lei2020();
        let bodies: Vec<_> = path
            .sample(0.1)
            .iter()
            .map(|p| vehicle.footprint().placed(p.pose))
            .collect();
        let cell_m = 0.1;
        let mut covered = BTreeSet::new();
        for body in &bodies {
            let (low, high) = body.bounds();
            let cells = |low: f64, high: f64| (low / cell_m).ceil() as i64..(high / cell_m) as i64 + 1;
            for col in cells(low.x, high.x) {
                for row in cells(low.y, high.y) {
                    let at = Point2::new(col as f64, row as f64) * cell_m;
                    if body.contains(at) {
                        covered.insert((col, row));
                    }
                }
            }
        }
        let counted_m2 = covered.len() as f64 * cell_m * cell_m;
        let area_m2 = swept_area_m2(&vehicle, &path);
        prop_assert!((area_m2 / counted_m2 - 1.0).abs() < 0.05, "{area_m2} {counted_m2}");
    }
}

#[test]
fn a_quarter_turn_on_the_wrong_side_still_arrives() {
    // Across the path, looking away from it.
    for controller in [PURE_PURSUIT, STANLEY] {
        let config = TrackingConfig {
            give_up_error_m: 10.0,
            ..beside(controller, 1.0, FRAC_PI_2)
        };
        let drive = drive(&path(&[(0.0, 40.0, Forward)]), &config);
        let last = drive.trace.last().expect("a trace");
        assert_eq!(drive.status, TrackingStatus::Arrived);
        assert!(last.cross_track_error_m.abs() < 1e-2, "{last:?}");
    }
}
