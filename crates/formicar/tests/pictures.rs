//! Pictures are well-formed, repeatable, of bounded size, and survive absurd values.

use formicar::geometry::{Point2, Pose2};
use formicar::map::{
    BitGrid, Cell, GridFrame, MAX_ORIGIN_M, MAX_RESOLUTION_M, MIN_RESOLUTION_M, OccupancyGrid,
};
use formicar::numeric::Seed;
use formicar::path::{CurvePath, CurveSegment, Direction, GridPath, WaypointPath};
use formicar::planner::{ColonyParameters, Planner, PlannerConfig, Stages};
use formicar::progress::{AntFrame, AntFrames, Traffic};
use formicar::render::{
    CellStyle, Chart, ColonyPicture, DrivePicture, Limit, Picture, PlanPicture, ProfilePoint,
    Ribbon, Scene, Series, colony_film, colony_picture, drive_picture, palette, plan_picture,
};
use formicar::scenario::Request;
use formicar::tracking::{StartOffset, TrackingConfig, track};
use formicar::vehicle::Vehicle;
use proptest::prelude::*;

fn room() -> OccupancyGrid {
    let rows = ["########", "#......#", "#..??..#", "#......#", "########"];
    OccupancyGrid::from_rows(&rows, 2.0).expect("a map")
}

fn path() -> CurvePath {
    let mut path = CurvePath::new(Pose2::new(3.0, 4.0, 0.0));
    path.push(0.0, 4.0, Direction::Forward);
    path.push(0.3, 2.0, Direction::Reverse);
    path.push(-0.2, 3.0, Direction::Forward);
    path
}

fn profile(path: &CurvePath) -> Vec<ProfilePoint> {
    let points = path.sample(0.1).into_iter().map(|p| ProfilePoint {
        s_m: p.s_m,
        curvature_per_m: p.curvature_per_m,
        steer_rad: Some(p.curvature_per_m),
        clearance_m: if p.s_m < 1.0 { f64::INFINITY } else { p.s_m },
        direction: p.direction,
    });
    points.collect()
}

fn plan(map: &OccupancyGrid, title: &str) -> Picture {
    let (vehicle, path) = (Vehicle::lei2020(), path());
    plan_picture(&PlanPicture {
        path: Some(&path),
        profile: &profile(&path),
        tightest: Some((Point2::new(5.0, 5.0), 0.12)),
        title,
        caption: "found",
        ..PlanPicture::new(map, &vehicle, path.start(), path.end())
    })
}

fn picture(scene: Scene) -> Picture {
    Picture {
        scene: Some(scene),
        ..Picture::default()
    }
}

fn check(svg: &str) {
    let document = roxmltree::Document::parse(svg).expect("well-formed");
    for attribute in document.descendants().flat_map(|n| n.attributes()) {
        let (name, value) = (attribute.name(), attribute.value());
        let words = ["aria-label", "href"].contains(&name);
        assert!(
            words || !value.contains("NaN") && !value.contains("inf"),
            "{name}={value}"
        );
    }
}

#[test]
fn a_plan_is_drawn_with_all_its_parts() {
    let svg = plan(&room(), "a plan").to_svg();
    check(&svg);
    for words in [
        "a plan",
        "found",
        "start",
        "goal",
        "0.12 m",
        "reverse",
        "curvature",
        "steering",
    ] {
        assert!(svg.contains(&format!("\"{words}\"")), "{words}");
    }
}

#[test]
fn a_drive_is_drawn_with_its_wheels_and_errors() {
    let (vehicle, planned) = (Vehicle::lei2020(), path());
    let start_offset = StartOffset {
        lateral_m: 0.3,
        ..StartOffset::default()
    };
    let config = TrackingConfig {
        start_offset,
        ..TrackingConfig::default()
    };
    let drive = track(&planned, &vehicle, &config).unwrap();
    let svg = drive_picture(&DrivePicture {
        map: &room(),
        vehicle: &vehicle,
        planned: &planned,
        drive: &drive,
        tightest: Some((Point2::new(5.0, 5.0), 0.0)),
        title: "a drive",
        caption: "collides",
    })
    .to_svg();
    check(&svg);
    for words in [
        "left wheel",
        "planned",
        "inner wheel 45.2°",
        "contact",
        "time, s",
    ] {
        assert!(svg.contains(&format!("\"{words}\"")), "{words}");
    }
    // Hundreds of short arcs are no reason for a large file.
    assert!(drive.driven.segments().len() > 300);
    assert!(svg.len() < 250_000, "{} bytes", svg.len());
}

#[test]
fn a_failure_rings_its_gap_and_draws_colliding_cells() {
    use formicar::planner::{Collision, Explanation, Gap};
    let (map, vehicle) = (room(), Vehicle::sedan());
    let failure = Explanation {
        collision: Some(Collision {
            end: "goal".to_owned(),
            cells: vec![[3, 2], [4, 2], [u32::MAX, 0]],
        }),
        gap: Some(Gap {
            x: 5.0,
            y: 4.0,
            gap_m: 0.5,
            vehicle_width_m: 1.8,
        }),
        ..Explanation::default()
    };
    let [start, goal] = [3.0, 6.0].map(|x| Pose2::new(x, 4.0, 0.0));
    let picture = PlanPicture {
        failure: Some(&failure),
        title: "none",
        caption: "no_path",
        ..PlanPicture::new(&map, &vehicle, start, goal)
    };
    let svg = plan_picture(&picture).to_svg();
    check(&svg);
    for word in ["under the goal", "0.50 m wide", "narrowest place"] {
        assert!(svg.contains(word), "{word}");
    }
}

#[test]
fn a_failure_is_drawn_with_its_reason() {
    let (map, vehicle) = (room(), Vehicle::sedan());
    let nowhere = Pose2::new(1e9, f64::NAN, 0.0);
    let failure = PlanPicture {
        title: "none",
        caption: "no_path: the gap is closed",
        ..PlanPicture::new(&map, &vehicle, Pose2::new(3.0, 4.0, 0.0), nowhere)
    };
    let svg = plan_picture(&failure).to_svg();
    check(&svg);
    assert!(svg.contains("no_path: the gap is closed") && svg.contains("\"start\""));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    assert_eq!(plan(&room(), "x").to_svg(), plan(&room(), "x").to_svg());
}

#[test]
fn a_large_noisy_map_stays_small() {
    let frame = GridFrame::new(2000, 2000, 0.05, Pose2::new(-3.0, 1.0, 0.4)).unwrap();
    let noise = |i: usize| (i.wrapping_mul(2_654_435_761) >> 13).is_multiple_of(4);
    let values = (0..frame.n_cells()).map(|i| i8::from(noise(i)) * 100);
    let map = OccupancyGrid::new(frame, values.collect()).unwrap();
    let svg = plan(&map, "noise").to_svg();
    check(&svg);
    assert!(svg.len() < 2_000_000, "{} bytes", svg.len());
}

#[test]
fn layers_are_named_in_the_legend() {
    let mut scene = Scene::new(&room());
    let mut cells = BitGrid::new(8, 5);
    cells.insert(Cell::new(2, 2));
    let chain = GridPath {
        cells: vec![Cell::new(1, 1), Cell::new(2, 2)],
    };
    let way = WaypointPath {
        points: vec![Point2::new(3.0, 3.0), Point2::new(9.0, 5.0)],
    };
    scene
        .cells(&cells, &CellStyle::expanded())
        .heat_map(&[0.5, f32::NAN, 1.5], "pheromone")
        .grid_path(&chain)
        .waypoint_path(&way)
        .point(Point2::new(5.0, 3.0), "S1")
        .point(Point2::new(f64::NAN, 3.0), "nowhere");
    let svg = picture(scene).to_svg();
    check(&svg);
    for name in [
        "expanded",
        "pheromone",
        "grid path",
        "way points",
        "unknown",
        "S1",
    ] {
        assert!(svg.contains(&format!("\"{name}\"")), "{name}");
    }
    assert!(!svg.contains("nowhere"));
}

#[test]
fn one_row_of_cells_and_huge_frames_are_drawn() {
    let frames = [
        GridFrame::new(100_000, 1, 0.05, Pose2::default()),
        GridFrame::new(1, 3000, 1e6, Pose2::new(1e9, -1e9, 1.0)),
        GridFrame::new(3, 3, MAX_RESOLUTION_M, Pose2::new(MAX_ORIGIN_M, 0.0, 0.0)),
        GridFrame::new(200, 200, MIN_RESOLUTION_M, Pose2::new(5.0, 0.0, 0.0)),
    ];
    for frame in frames.map(Result::unwrap) {
        let map = OccupancyGrid::new(frame, vec![100; frame.n_cells()]).unwrap();
        let svg = plan(&map, "odd").to_svg();
        check(&svg);
        assert!(svg.len() < 1_000_000, "{} bytes", svg.len());
    }
}

/// A colony that found its way around a pocket, and what an observer kept of it.
fn colony(n_iterations: u32) -> (OccupancyGrid, Stages, AntFrames) {
    let rows = [
        "............",
        "...######...",
        "........#...",
        "........#...",
        "...######...",
        "............",
    ];
    let map = OccupancyGrid::from_rows(&rows, 1.0).expect("a map");
    let mut parameters = ColonyParameters::lei2020();
    parameters.colony.n_ants = 30;
    parameters.colony.n_iterations = n_iterations;
    let config = PlannerConfig::Lei2020(parameters);
    let mut ants = AntFrames::new(12, 6);
    let request = Request::new(Pose2::new(0.5, 3.0, 0.0), Pose2::new(11.5, 3.0, 0.0));
    let point = Vehicle::preset("point").expect("a vehicle");
    let mut planner = Planner::new(&map, point, config).expect("a planner");
    let outcome = planner.plan(&request, Seed(3), &mut ants);
    let plan = outcome.expect("a fair request").found().expect("a way");
    (map, plan.stages, ants)
}

fn colony_of<'a>(
    map: &'a OccupancyGrid,
    vehicle: &'a Vehicle,
    (stages, frames): (&'a Stages, &'a [AntFrame]),
) -> ColonyPicture<'a> {
    ColonyPicture {
        map,
        vehicle,
        start: Pose2::new(0.5, 3.0, 0.0),
        goal: Pose2::new(11.5, 3.0, 0.0),
        stages,
        frames,
        path: None,
        title: "ants",
        caption: "around a pocket",
    }
}

#[test]
fn a_colony_is_drawn_with_ants_nodes_and_convergence() {
    let (map, stages, ants) = colony(20);
    let vehicle = Vehicle::lei2020();
    let picture = || colony_picture(&colony_of(&map, &vehicle, (&stages, ants.frames())));
    let svg = picture().to_svg();
    check(&svg);
    for words in [
        "closed U-shape",
        "pheromone, log scale",
        "ants that arrived",
        "redundant node",
        "node",
        "best so far",
        "evaporation ρ",
    ] {
        assert!(svg.contains(&format!("\"{words}\"")), "{words}");
    }
    assert_eq!(svg.matches("\"iteration 1: ").count(), 1);
    assert_eq!(svg.matches("\"iteration 20: ").count(), 1);
    assert_eq!(picture().panels.len(), 6);
    assert_eq!(svg, picture().to_svg());
}

#[test]
fn a_colony_that_never_walked_shows_its_ground() {
    let (vehicle, stages) = (Vehicle::lei2020(), Stages::default());
    let map = room();
    let colony = colony_of(&map, &vehicle, (&stages, &[]));
    let picture = colony_picture(&colony);
    assert!(picture.charts.is_empty() && picture.panels.is_empty());
    check(&picture.to_svg());
    assert!(colony_film(&colony).is_empty());
}

#[test]
fn more_ants_are_darker_and_wider() {
    let line = |n_passed: u32| {
        let cells = [Cell::new(1, 1), Cell::new(2, 1)];
        let mut scene = Scene::new(&room());
        scene.traffic(&[Traffic { cells, n_passed }], 500, ("", palette::GOAL));
        let svg = picture(scene).to_svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let color = palette::GOAL.to_string();
        let drawn = document.descendants();
        let line = drawn.filter(|n| n.attribute("stroke") == Some(&color));
        let number = |name: &str| line.clone().next()?.attribute(name)?.parse::<f64>().ok();
        ["stroke-opacity", "stroke-width"].map(|name| number(name).unwrap())
    };
    let lines = [1, 5, 50, 500].map(line);
    for pair in lines.windows(2) {
        assert!(
            pair[0][0] < pair[1][0] && pair[0][1] < pair[1][1],
            "{lines:?}"
        );
    }
    assert_eq!(line(500), line(5000), "passages back and forth");
}

#[cfg(feature = "gif-pictures")]
#[test]
fn a_film_shows_every_kept_iteration_and_the_result() {
    use formicar::render::to_gif;
    let (map, stages, ants) = colony(8);
    let vehicle = Vehicle::lei2020();
    let film = colony_film(&colony_of(&map, &vehicle, (&stages, ants.frames())));
    let file = to_gif(&film, 300).unwrap();
    assert_eq!(file, to_gif(&film, 300).unwrap());
    assert!(to_gif(&[], 300).is_err() && to_gif(&film, 0).is_err());

    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&file[..]).unwrap();
    let page = usize::from(decoder.width()) * usize::from(decoder.height());
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        if delays.is_empty() {
            assert_eq!(
                (frame.buffer.len(), &frame.buffer[..3]),
                (4 * page, &[255; 3][..])
            );
            assert!(frame.buffer.chunks(4).all(|pixel| pixel[3] == 255));
        }
        delays.push(frame.delay);
    }
    assert_eq!(delays, [12, 12, 12, 12, 12, 12, 12, 12, 150]);
}

#[cfg(feature = "png-pictures")]
#[test]
fn a_png_has_the_width_asked_for() {
    let png = plan(&room(), "png").to_png(640).unwrap();
    assert_eq!(&png[1..4], b"PNG");
    assert_eq!(png[16..20], 640_u32.to_be_bytes());
    let error = plan(&room(), "png").to_png(0).unwrap_err();
    assert!(error.to_string().contains("width 0 px"));
    assert!(plan(&room(), "png").to_png(u32::MAX).is_err());
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -50.0..50.0,
        any::<f64>(),
        Just(f64::NAN),
        Just(f64::NEG_INFINITY)
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 5))]

    #[test]
    fn any_text_is_escaped(title in any::<String>()) {
        check(&plan(&room(), &title).to_svg());
    }

    #[test]
    fn any_path_is_drawn_or_left_out(numbers in prop::collection::vec(any_number(), 24)) {
        let segments = numbers.chunks(6).map(|n| CurveSegment {
            start: Pose2::new(n[0], n[1], n[2]),
            curvature_per_m: n[3],
            curvature_rate_per_m2: n[5],
            length_m: n[4],
            direction: if n[0] > 0.0 { Direction::Forward } else { Direction::Reverse },
        });
        let path = CurvePath::from_segments(Pose2::default(), segments.collect());
        let place = Point2::new(numbers[0], numbers[1]);
        let mut scene = Scene::new(&room());
        scene.swept(&path, &Vehicle::sedan()).curve(&path).tightest(place, numbers[2]);
        check(&picture(scene).to_svg());
    }

    #[test]
    fn any_pheromone_is_drawn_or_left_out(values in prop::collection::vec(any::<f32>(), 40)) {
        let mut scene = Scene::new(&room());
        scene.log_heat_map(&values, "tau").heat_map(&values, "also");
        check(&picture(scene).to_svg());
    }

    #[test]
    fn any_series_is_drawn_or_left_out(numbers in prop::collection::vec(any_number(), 30)) {
        let points = numbers.chunks(2).map(|n| Point2::new(n[0], n[1])).collect();
        let chart = Chart {
            series: vec![Series::new("a", points, palette::INK)],
            ribbons: vec![Ribbon {
                label: "b".to_owned(),
                points: numbers.chunks(3).map(|n| [n[0], n[1], n[2]]).collect(),
                color: palette::SWEPT,
            }],
            limits: vec![Limit { label: "c".to_owned(), value: numbers[3] }],
            ..Chart::default()
        };
        let charts = vec![chart];
        check(&Picture { charts, ..Picture::default() }.to_svg());
    }
}
