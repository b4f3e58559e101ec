//! Paths on the map (Li 2024, figures 5 to 11).

use super::drive::Drawn;
use crate::papers::experiment::Ground;
use crate::report::Figure;
use formicar::geometry::{Point2, Pose2};
use formicar::render::{Dash, LineStyle, Picture, PoseMark, Scene, palette};
use formicar::validation::{Report, ViolationKind};

/// Half the size of a mark of a collision, meters.
const MARK_M: f64 = 1.2;
/// Marks closer than this are one, meters.
const APART_M: f64 = 1.0;

/// Ground around the paths that is shown, meters.
const MARGIN_M: f64 = 6.0;

/// The part of the map that holds the paths of all methods.
pub(super) fn surroundings(ground: &Ground, drawn_runs: &[Drawn]) -> (Point2, Point2) {
    let ends = [ground.request.start, ground.request.goal].map(Pose2::position);
    let natives = drawn_runs
        .iter()
        .flat_map(|drawn| drawn.native.iter().copied());
    let judged = drawn_runs
        .iter()
        .filter_map(|drawn| drawn.run.outcome.judged());
    let curves = judged.flat_map(|(path, _)| path.sample(1.0));
    let curves = curves.map(|sample| sample.pose.position());
    let points = ends.into_iter().chain(natives).chain(curves);
    let (low, high) = points.fold((ends[0], ends[0]), |(low, high), p| {
        let low = Point2::new(low.x.min(p.x), low.y.min(p.y));
        (low, Point2::new(high.x.max(p.x), high.y.max(p.y)))
    });
    let margin = Point2::new(MARGIN_M, MARGIN_M);
    (low - margin, high + margin)
}

/// A method's path in a part of the map: the polyline before corners are rounded, the curve that
/// was judged, and the places where the judge refused it.
pub(super) fn path_figure(ground: &Ground, drawn: &Drawn, part: (Point2, Point2)) -> Figure {
    let mut scene = Scene::window(&ground.grid, part.0, part.1);
    let judged = drawn.run.outcome.judged();
    let places = judged.map_or(Vec::new(), |(_, report)| refused_at(report));
    if let Some((path, _)) = judged {
        scene.curve(path);
    }
    if !drawn.native.is_empty() {
        scene.polyline(&drawn.native, &line("before rounding", 1.2));
    }
    scene.pose(ground.request.start, &ground.vehicle, PoseMark::Start);
    scene.pose(ground.request.goal, &ground.vehicle, PoseMark::Goal);
    for (i, &place) in places.iter().enumerate() {
        cross(&mut scene, place, if i == 0 { "refused here" } else { "" });
    }
    let verdict = verdict(drawn, places.len());
    let picture = Picture {
        title: drawn.run.variant.clone(),
        caption: verdict.clone(),
        scene: Some(scene),
        ..Picture::default()
    };
    let caption = format!(
        "`{}` on `{}`, seed 0: {verdict}.",
        drawn.run.variant, ground.map
    );
    Figure::new(&caption, &picture)
}

fn verdict(drawn: &Drawn, n_places: usize) -> String {
    match drawn.run.outcome.judged() {
        None => "no path".to_owned(),
        Some((path, report)) if report.valid => format!(
            "certified, {:.2} m, clearance {:.3} m",
            path.length_m(),
            report.min_clearance_m
        ),
        Some((path, report)) => {
            let first = report
                .violations
                .first()
                .map_or("", |first| first.message.as_str());
            format!(
                "{:.2} m, refused by the judge at {n_places} {}, first: {first}",
                path.length_m(),
                if n_places == 1 { "place" } else { "places" }
            )
        }
    }
}

/// Places where a path cannot be driven.
fn refused_at(report: &Report) -> Vec<Point2> {
    let mut places: Vec<Point2> = Vec::new();
    let is_seen = |kind| kind != ViolationKind::Malformed;
    for violation in report.violations.iter().filter(|v| is_seen(v.kind)) {
        let place = violation.pose.position();
        if places.iter().all(|other| other.distance(place) >= APART_M) {
            places.push(place);
        }
    }
    places
}

fn cross(scene: &mut Scene, place: Point2, label: &str) {
    for (side, label) in [(1.0, label), (-1.0, "")] {
        let arm = Point2::new(MARK_M, side * MARK_M);
        let style = LineStyle {
            label: label.to_owned(),
            color: palette::LIMIT,
            ..line("", 2.2)
        };
        scene.polyline(&[place - arm, place + arm], &style);
    }
}

fn line(label: &str, width_px: f64) -> LineStyle {
    LineStyle {
        label: label.to_owned(),
        color: palette::WAYPOINTS.mix(palette::PAGE, 0.4),
        width_px,
        dash: Dash::Solid,
    }
}
