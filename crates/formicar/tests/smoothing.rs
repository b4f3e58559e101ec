//! Smoothed grid paths before the judge, and 2-turning against brute force.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test suite: helpers outside of tests may fail and say that they skip"
)]

use formicar::collision::{Body, Drive, ObstacleMap};
use formicar::geometry::{Arc, Point2, Pose2};
use formicar::map::builtin::BuiltinMap;
use formicar::map::format::read_car_scenarios;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::map::{BitGrid, Cell, DiagonalRule, GridFrame, MoveMasks, OccupancyGrid, ring};
use formicar::numeric::Seed;
use formicar::path::Direction;
use formicar::progress::Limits;
use formicar::scenario::{GoalHeading, MotionMode, Request, StartHeading};
use formicar::search::{AstarWorkspace, astar};
use formicar::smoothing::{
    CornerProblem, Corners, Ground, RedundantNodes, Rounding, Smoothed, SmoothingConfig,
    SmoothingError, TwoTurning, smooth,
};
use formicar::validation::judge;
use formicar::vehicle::Vehicle;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

const RULE: DiagonalRule = DiagonalRule::NoObstacles;

/// A vehicle on a map whose obstacles are grown by half its width and a little more.
struct Place {
    obstacles: ObstacleMap,
    vehicle: Vehicle,
    blocked: BitGrid,
}

impl Place {
    fn new(map: &OccupancyGrid, vehicle: Vehicle) -> Self {
        let obstacles = ObstacleMap::new(map);
        let (low, high) = vehicle.footprint().bounds();
        let half_m = 0.5 * (high.y - low.y) + 0.1 * vehicle.min_turning_radius_m().max(0.0);
        let grown = half_m / obstacles.frame().resolution_m();
        let blocked = obstacles.distance().within(grown).unwrap();
        Self {
            obstacles,
            vehicle,
            blocked,
        }
    }

    fn ground(&self) -> Ground<'_> {
        Ground {
            obstacles: &self.obstacles,
            vehicle: &self.vehicle,
            blocked: &self.blocked,
            rule: RULE,
        }
    }

    /// The cell under a pose, or the nearest that is not blocked.
    fn cell(&self, pose: Pose2) -> Option<Cell> {
        let cell = self.obstacles.frame().cell_at(pose.position())?;
        let size = (self.blocked.n_cols(), self.blocked.n_rows());
        let is_free = |c: &Cell| !self.blocked.get(c.col as usize, c.row as usize);
        (0..12).find_map(|radius| ring(cell, radius, size.0, size.1).find(is_free))
    }

    /// The nodes of a shortest grid path that are not redundant.
    fn nodes(&self, request: &Request) -> Option<Vec<Cell>> {
        let (start, goal) = (self.cell(request.start)?, self.cell(request.goal)?);
        let moves = MoveMasks::new(&self.blocked, RULE);
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        let found = astar(&moves, start, goal, &mut AstarWorkspace::new(), &mut limits).ok()?;
        Some(RedundantNodes::Remove.apply(&self.blocked, RULE, &found.path))
    }

    /// A smoothed path, which the judge must certify.
    fn certified(
        &self,
        config: &SmoothingConfig,
        request: &Request,
    ) -> Option<Result<Smoothed, SmoothingError>> {
        let nodes = self.nodes(request)?;
        let smoothed = smooth(&self.ground(), config, request, &nodes);
        if let Ok(smoothed) = &smoothed {
            let report = judge(&self.obstacles, &self.vehicle, request, &smoothed.path);
            assert!(report.valid, "{request:?}: {:?}", report.violations);
            let again = smooth(&self.ground(), config, request, &nodes);
            assert_eq!(again.as_ref(), Ok(smoothed));
        }
        Some(smoothed)
    }
}

/// The request with each mix of headings and gears.
fn variants(start: Pose2, goal: Pose2) -> Vec<Request> {
    let mut requests = Vec::new();
    for motion in [MotionMode::Forward, MotionMode::Reverse] {
        for (start_heading, goal_heading) in [
            (StartHeading::Any, GoalHeading::Any),
            (StartHeading::Exact, GoalHeading::Any),
            (StartHeading::Any, GoalHeading::Bidirectional),
            (StartHeading::Exact, GoalHeading::Exact),
        ] {
            requests.push(Request {
                motion,
                start_heading,
                goal_heading,
                ..Request::new(start, goal)
            });
        }
    }
    requests
}

fn either() -> [SmoothingConfig; 2] {
    [SmoothingConfig::lei2020(), SmoothingConfig::default()]
}

/// A map of free cells of 0.5 m.
fn open(n_cols: usize, n_rows: usize) -> OccupancyGrid {
    OccupancyGrid::free(GridFrame::new(n_cols, n_rows, 0.5, Pose2::default()).unwrap())
}

fn center(cell: Cell, resolution_m: f64) -> Point2 {
    Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5) * resolution_m
}

/// A request between the centers of two cells with free headings, forward.
fn free_request(place: &Place, start: Cell, goal: Cell) -> Request {
    let at = |cell| Pose2::at(place.obstacles.frame().center(cell), 0.0);
    Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        motion: MotionMode::Forward,
        ..Request::new(at(start), at(goal))
    }
}

#[test]
fn what_is_returned_on_random_maps_is_certified() {
    let vehicles = [
        (Vehicle::warehouse_amr(), 0.1),
        (Vehicle::f1tenth(), 0.1),
        (Vehicle::lei2020(), 0.25),
    ];
    // By configuration, then by forward and reverse.
    let mut n_found = [[0; 2]; 2];
    let mut n_asked = 0;
    for (vehicle, resolution_m) in vehicles {
        for seed in 0..6 {
            let parameters = ScatterParameters {
                n_cols: 150,
                n_rows: 120,
                resolution_m,
                density: 0.015,
                ..ScatterParameters::default()
            };
            let map = scattered_obstacles(&parameters, Seed(seed)).unwrap();
            let place = Place::new(&map, vehicle.clone());
            for (start, goal) in free_pose_pairs(&map, &vehicle, 3, Seed(seed)).unwrap() {
                for request in variants(start, goal) {
                    n_asked += 1;
                    for (i, config) in either().iter().enumerate() {
                        let found = place.certified(config, &request);
                        let in_reverse = usize::from(request.motion == MotionMode::Reverse);
                        n_found[i][in_reverse] += usize::from(matches!(found, Some(Ok(_))));
                    }
                }
            }
        }
    }
    println!("{n_found:?} of {} each", n_asked / 2);
    assert!(n_found[0][0] > 40 && n_found[1][1] > 150, "{n_found:?}");
    for i in 0..2 {
        assert!(n_found[i][1] >= n_found[i][0] && n_found[1][i] >= n_found[0][i]);
    }
}

#[test]
fn scenes_are_smoothed_as_before() {
    let mut solved = Vec::new();
    for name in [
        "lei-map1",
        "lei-map3",
        "warehouse",
        "parking-lot",
        "narrow-aisle",
    ] {
        let builtin = BuiltinMap::by_name(name).unwrap();
        let vehicle = Vehicle::preset(builtin.vehicle).unwrap();
        let place = Place::new(&builtin.grid(), vehicle);
        for ends in builtin.requests {
            let request = Request::new(ends.start, ends.goal);
            let found = place.certified(&SmoothingConfig::default(), &request);
            if matches!(found, Some(Ok(_))) {
                solved.push(format!("{name} {}", ends.id));
            }
        }
    }
    println!("{solved:?}");
    assert!(solved.len() >= 7, "{solved:?}");
}

#[test]
fn car_scenarios_are_certified_or_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/car");
    let Ok(scenarios) = read_car_scenarios(&folder.join("hood_800x500.json")) else {
        println!("skipped: no car scenarios in {}", folder.display());
        return;
    };
    let map = OccupancyGrid::read_ros_yaml(&folder.join("hood_800x500.yaml")).unwrap();
    let vehicle = Vehicle::new(scenarios[0].vehicle.clone()).unwrap();
    let place = Place::new(&map, vehicle);
    let mut n_found = 0;
    for scenario in &scenarios {
        let request = Request::new(scenario.start, scenario.goal);
        let found = place.certified(&SmoothingConfig::default(), &request);
        n_found += usize::from(matches!(found, Some(Ok(_))));
    }
    println!("{n_found} of {}", scenarios.len());
    assert!(n_found >= 7, "{n_found} of {}", scenarios.len());
}

/// The least sum of deviations over members that leave each other room.
fn least_deviations(turns: &[f64], lengths: &[f64], radius_m: f64, n_members: u32) -> Option<f64> {
    fn from_corner(families: &[Vec<TwoTurning>], lengths: &[f64], taken_m: f64) -> Option<f64> {
        let Some((family, rest)) = families.split_first() else {
            return Some(0.0);
        };
        let fits = |t: &&TwoTurning| taken_m + t.before_m <= lengths[0] && t.after_m <= lengths[1];
        let sums = family.iter().filter(fits).filter_map(|t| {
            let others = from_corner(rest, &lengths[1..], t.after_m)?;
            Some(t.deviation_m() + others)
        });
        sums.min_by(f64::total_cmp)
    }
    let family = |&turn: &f64| TwoTurning::family(turn, radius_m, n_members);
    let families: Vec<_> = turns.iter().map(family).collect();
    from_corner(&families, lengths, 0.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// On open ground nothing but neighbors limits the turns: the choice is the best joint one.
    #[test]
    fn neighbors_share_segments_as_well_as_they_can(
        steps in prop::collection::vec((-7_i32..=7, -7_i32..=7), 2..5),
        n_members in 1_u32..5,
    ) {
        let mut cells = vec![Cell::new(60, 60)];
        for (dx, dy) in steps {
            let last = cells[cells.len() - 1];
            cells.push(Cell::new(last.col.saturating_add_signed(dx), last.row.saturating_add_signed(dy)));
        }
        let place = Place::new(&open(120, 120), Vehicle::warehouse_amr());
        let request = free_request(&place, cells[0], cells[cells.len() - 1]);
        let config = SmoothingConfig { n_members, ..SmoothingConfig::lei2020() };
        let points: Vec<Point2> = cells.iter().map(|&c| center(c, 0.5)).collect();
        prop_assume!(points.windows(2).all(|w| w[0] != w[1]));
        let heading = |w: &[Point2]| (w[1] - w[0]).angle();
        let turns: Vec<f64> = points
            .windows(3)
            .map(|w| formicar::geometry::angle_difference(heading(&w[1..]), heading(&w[..2])))
            .collect();
        let is_corner = |turn: &f64| (0.01..3.1).contains(&turn.abs());
        prop_assume!(turns.iter().all(is_corner));

        let lengths: Vec<f64> = points.windows(2).map(|w| w[0].distance(w[1])).collect();
        let radius_m = place.vehicle.min_turning_radius_m();
        let expected = least_deviations(&turns, &lengths, radius_m, n_members);
        match smooth(&place.ground(), &config, &request, &cells) {
            Ok(smoothed) => {
                let deviation_m = |rounding: Rounding| match rounding {
                    Rounding::TwoTurning(turning) => turning.deviation_m(),
                    _ => f64::NAN,
                };
                let sum: f64 = smoothed.corners.iter().map(|c| deviation_m(c.rounding)).sum();
                prop_assert!((sum - expected.unwrap()).abs() < 1e-9, "{sum} {expected:?}");
                let report = judge(&place.obstacles, &place.vehicle, &request, &smoothed.path);
                prop_assert!(report.valid);
            }
            Err(error) => prop_assert!(expected.is_none(), "{error}, but {expected:?}"),
        }
    }

    /// At one corner among obstacles the nearest member that can be driven is chosen.
    #[test]
    fn the_nearest_free_member_is_chosen(seed in 0_u64..1000, picks in prop::array::uniform3(0_usize..2500)) {
        let parameters = ScatterParameters {
            n_cols: 50,
            n_rows: 50,
            resolution_m: 0.1,
            density: 0.01,
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&parameters, Seed(seed)).unwrap();
        let place = Place::new(&map, Vehicle::f1tenth());
        let cells = picks.map(|i| Cell::new((i % 50) as u32, (i / 50) as u32));
        let [a, b, c] = cells.map(|cell| center(cell, 0.1));
        prop_assume!(a.distance(b) > 1.0 && b.distance(c) > 1.0);
        let request = free_request(&place, cells[0], cells[2]);
        let config = SmoothingConfig::lei2020();
        let expected = nearest_free(&place, [a, b, c], config.n_members);
        match smooth(&place.ground(), &config, &request, &cells) {
            Ok(Smoothed { corners, .. }) => {
                let Rounding::TwoTurning(turning) = corners[0].rounding else {
                    panic!("a straight polyline has no corner")
                };
                prop_assert!((turning.deviation_m() - expected.unwrap()).abs() < 1e-12);
            }
            Err(error) => prop_assert!(expected.is_none(), "{error}, but {expected:?}"),
        }
    }
}

/// The least deviation of a member at a corner that can be driven with the straight ways to and
/// from it, by trying all.
fn nearest_free(place: &Place, [a, b, c]: [Point2; 3], n_members: u32) -> Option<f64> {
    let body = Body::new(&place.vehicle);
    let is_free = |start: Pose2, arc: Arc| {
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        place.obstacles.is_free(&body, &drive)
    };
    let (before, after) = ((b - a).angle(), (c - b).angle());
    let turn = formicar::geometry::angle_difference(after, before);
    let family = TwoTurning::family(turn, place.vehicle.min_turning_radius_m(), n_members);
    let drivable = family.into_iter().filter(|t| {
        let (way_in, way_out) = (a.distance(b) - t.before_m, b.distance(c) - t.after_m);
        let mut pose = Pose2::at(a, before);
        let [first, last] = t.arcs();
        let pieces = [Arc::new(0.0, way_in), first, last, Arc::new(0.0, way_out)];
        way_in >= 0.0
            && way_out >= 0.0
            && pieces.into_iter().all(|arc| {
                let start = pose;
                pose = arc.end_from(pose);
                is_free(start, arc)
            })
    });
    drivable.map(|t| t.deviation_m()).min_by(f64::total_cmp)
}

/// A corridor of 1.2 m, too narrow to turn around in.
const CORRIDOR: [&str; 7] = [
    "##############################",
    "##############################",
    "..............................",
    "..............................",
    "..............................",
    "##############################",
    "##############################",
];

fn corridor(origin: Pose2) -> Place {
    let map = OccupancyGrid::from_rows(&CORRIDOR, 0.4).unwrap();
    let frame = GridFrame::new(30, 7, 0.4, origin).unwrap();
    let map = OccupancyGrid::new(frame, map.values().to_vec()).unwrap();
    Place::new(&map, Vehicle::lei2020())
}

/// From one part of the corridor to another, with headings along its axis.
fn along(place: &Place, start_rad: f64, goal_rad: f64) -> Request {
    let frame = place.obstacles.frame();
    Request::new(
        frame.to_world(Pose2::new(4.0, 1.4, start_rad)),
        frame.to_world(Pose2::new(9.0, 1.4, goal_rad)),
    )
}

#[test]
fn where_it_cannot_turn_the_way_is_driven_in_reverse() {
    for config in either() {
        let place = corridor(Pose2::new(-3.0, 7.0, 2.5));
        let request = along(&place, PI, PI);
        let smoothed = place.certified(&config, &request).unwrap().unwrap();
        let segments = smoothed.path.segments();
        assert!(segments.iter().all(|s| s.direction == Direction::Reverse));
        assert!((smoothed.path.length_m() - 5.0).abs() < 1e-6);

        let forward = Request {
            motion: MotionMode::Forward,
            ..request
        };
        let error = place.certified(&config, &forward).unwrap().unwrap_err();
        assert!(matches!(error, SmoothingError::Heading { .. }), "{error}");
    }
}

#[test]
fn a_bidirectional_goal_takes_either_heading() {
    let place = corridor(Pose2::default());
    let exact = Request {
        motion: MotionMode::Forward,
        ..along(&place, 0.0, PI)
    };
    let both = Request {
        goal_heading: GoalHeading::Bidirectional,
        ..exact.clone()
    };
    let config = SmoothingConfig::lei2020();
    assert!(place.certified(&config, &both).unwrap().is_ok());
    let error = place.certified(&config, &exact).unwrap().unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("no free curve joins the goal's heading"),
        "{error}"
    );
}

#[test]
fn near_ends_are_joined_by_one_curve() {
    let place = Place::new(&open(40, 40), Vehicle::lei2020());
    let start = Pose2::new(8.0, 8.0, 0.0);
    let radius_m = place.vehicle.min_turning_radius_m();
    for goal in [
        Pose2::new(12.0, 11.0, FRAC_PI_2),
        Pose2::new(8.0, 8.0, PI),
        start,
    ] {
        let request = Request {
            motion: MotionMode::Forward,
            ..Request::new(start, goal)
        };
        let smoothed = place
            .certified(&SmoothingConfig::lei2020(), &request)
            .unwrap()
            .unwrap();
        let shortest_m = formicar::geometry::dubins::distance(start, goal, radius_m).unwrap();
        assert!(
            (smoothed.path.length_m() - shortest_m).abs() < 1e-9,
            "{goal:?}"
        );
        let free = Request {
            goal_heading: GoalHeading::Any,
            ..request
        };
        let smoothed = place
            .certified(&SmoothingConfig::lei2020(), &free)
            .unwrap()
            .unwrap();
        assert!(smoothed.path.length_m() <= shortest_m + 1e-9);
    }
}

fn refusal(place: &Place, config: &SmoothingConfig, cells: &[(u32, u32)]) -> SmoothingError {
    let cells: Vec<Cell> = cells
        .iter()
        .map(|&(col, row)| Cell::new(col, row))
        .collect();
    let request = free_request(place, cells[0], cells[cells.len() - 1]);
    smooth(&place.ground(), config, &request, &cells).unwrap_err()
}

#[test]
fn refusals_name_corner_and_reason() {
    let place = Place::new(&open(60, 60), Vehicle::lei2020());
    let config = SmoothingConfig::lei2020();
    let problem = |cells: &[(u32, u32)]| match refusal(&place, &config, cells) {
        SmoothingError::Corner {
            number, problem, ..
        } => (number, problem),
        other => panic!("{other}"),
    };
    let (number, short) = problem(&[(10, 10), (30, 10), (30, 30), (33, 30), (33, 33)]);
    assert!(matches!(short, CornerProblem::TooShort { has_m, .. } if has_m == 1.5));
    assert_eq!(number, 3);
    // Each turn alone would have room.
    let (number, crowded) = problem(&[(10, 10), (17, 10), (17, 16), (24, 16)]);
    let CornerProblem::Crowded { needs_m, has_m } = crowded else {
        panic!("{crowded}")
    };
    assert!(number == 2 && needs_m > has_m && has_m > 0.0);
    let (_, back) = problem(&[(10, 10), (30, 10), (12, 10)]);
    assert_eq!(back, CornerProblem::TurnsBack);
    let text = refusal(&place, &config, &[(10, 10), (13, 10), (13, 13)]).to_string();
    assert!(
        text.starts_with("corner 1 at (6.75, 5.25) m turns by 90 deg: 2-turning needs"),
        "{text}"
    );
    assert!(text.ends_with("which has 1.500 m"), "{text}");
}

#[test]
fn refusals_tell_the_straight_from_the_turn() {
    let rows = [
        "##########",
        "##########",
        "######...#",
        "######...#",
        "######...#",
        "######...#",
        "######...#",
        ".........#",
        ".........#",
        ".........#",
        "##########",
    ];
    let map = OccupancyGrid::from_rows(&rows, 0.5).unwrap();
    let place = Place::new(&map, Vehicle::lei2020());
    let config = SmoothingConfig::lei2020();
    let error = refusal(&place, &config, &[(1, 2), (7, 2), (7, 8)]);
    let SmoothingError::Corner { problem, .. } = &error else {
        panic!("{error}")
    };
    assert!(
        matches!(problem, CornerProblem::Touches { depth_m } if *depth_m > 0.05),
        "{error}"
    );
    let error = refusal(&place, &SmoothingConfig::default(), &[(1, 2), (1, 9)]);
    let text = error.to_string();
    assert!(
        text.contains("straight") && text.ends_with("and no curve past it is free"),
        "{text}"
    );
}

#[test]
fn points_keep_the_polyline() {
    let builtin = BuiltinMap::by_name("wang-open").unwrap();
    let place = Place::new(&builtin.grid(), Vehicle::point());
    let ends = &builtin.requests[0];
    let request = Request::new(ends.start, ends.goal);
    let smoothed = place
        .certified(&SmoothingConfig::default(), &request)
        .unwrap()
        .unwrap();
    assert!((smoothed.path.length_m() - smoothed.waypoints.length_m()).abs() < 1e-9);
    assert_eq!(smoothed.corners.len() + 2, smoothed.waypoints.points.len());
    assert!(
        smoothed
            .corners
            .iter()
            .all(|c| c.rounding == Rounding::None)
    );
}

#[test]
fn bad_questions_are_refused_with_their_range() {
    let place = Place::new(&open(20, 20), Vehicle::warehouse_amr());
    let request = free_request(&place, Cell::new(3, 3), Cell::new(9, 3));
    let bad: [fn(&mut SmoothingConfig); 5] = [
        |c| c.n_members = 0,
        |c| c.station_radii = f64::NAN,
        |c| c.reach_radii = -1.0,
        |c| c.reverse_penalty = 0.5,
        |c| c.direction_switching_cost = f64::INFINITY,
    ];
    for spoil in bad {
        let mut config = SmoothingConfig::default();
        spoil(&mut config);
        let error = smooth(&place.ground(), &config, &request, &[Cell::new(3, 3)]).unwrap_err();
        assert!(error.to_string().contains("it must be in"), "{error}");
    }
    let none = smooth(&place.ground(), &SmoothingConfig::default(), &request, &[]);
    assert_eq!(none.unwrap_err(), SmoothingError::NoNodes);
}

#[test]
fn curves_pass_what_two_turns_cannot() {
    let place = Place::new(&open(60, 60), Vehicle::lei2020());
    let cells = [(10, 10), (17, 10), (17, 16), (24, 16)].map(|(c, r)| Cell::new(c, r));
    let request = free_request(&place, cells[0], cells[3]);
    let smoothed = smooth(
        &place.ground(),
        &SmoothingConfig::default(),
        &request,
        &cells,
    )
    .unwrap();
    assert!(judge(&place.obstacles, &place.vehicle, &request, &smoothed.path).valid);
    let by_curve = smoothed
        .corners
        .iter()
        .filter(|c| c.rounding == Rounding::Curve);
    assert!(by_curve.count() > 0);
    let plain = SmoothingConfig {
        corners: Corners::TwoTurning,
        ..SmoothingConfig::default()
    };
    assert!(smooth(&place.ground(), &plain, &request, &cells).is_err());
}
