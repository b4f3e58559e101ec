//! Pictures are well-formed, repeatable, of bounded size, and survive absurd values.

use formicar::geometry::{Point2, Pose2};
use formicar::map::{BitGrid, Cell, GridFrame, OccupancyGrid};
use formicar::path::{CurvePath, CurveSegment, Direction, GridPath, WaypointPath};
use formicar::render::{
    CellStyle, Chart, Limit, Picture, PlanPicture, ProfilePoint, Ribbon, Scene, Series, palette,
    plan_picture,
};
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
        map,
        vehicle: &vehicle,
        start: path.start(),
        goal: path.end(),
        path: Some(&path),
        profile: &profile(&path),
        tightest: Some((Point2::new(5.0, 5.0), 0.12)),
        title,
        caption: "found",
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
fn a_failure_is_drawn_with_its_reason() {
    let vehicle = Vehicle::sedan();
    let failure = PlanPicture {
        map: &room(),
        vehicle: &vehicle,
        start: Pose2::new(3.0, 4.0, 0.0),
        goal: Pose2::new(1e9, f64::NAN, 0.0),
        path: None,
        profile: &[],
        tightest: None,
        title: "none",
        caption: "no_path: the gap is closed",
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
        GridFrame::new(1, 3000, 1e12, Pose2::new(1e15, -1e15, 1.0)),
        GridFrame::new(3, 3, 1e308, Pose2::new(1e308, 0.0, 0.0)),
        GridFrame::new(200, 200, 1e-300, Pose2::new(5.0, 0.0, 0.0)),
    ];
    for frame in frames.map(Result::unwrap) {
        let map = OccupancyGrid::new(frame, vec![100; frame.n_cells()]).unwrap();
        let svg = plan(&map, "odd").to_svg();
        check(&svg);
        assert!(svg.len() < 1_000_000, "{} bytes", svg.len());
    }
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
    #[test]
    fn any_text_is_escaped(title in any::<String>()) {
        check(&plan(&room(), &title).to_svg());
    }

    #[test]
    fn any_path_is_drawn_or_left_out(numbers in prop::collection::vec(any_number(), 20)) {
        let segments = numbers.chunks(5).map(|n| CurveSegment {
            start: Pose2::new(n[0], n[1], n[2]),
            curvature_per_m: n[3],
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
