//! Paths of stores on their maps, and strip charts along the first planner's path.

use crate::commands::bench::Files;
use formicar::geometry::Point2;
use formicar::path::CurvePath;
use formicar_lab::campaign::Stored;
use formicar_lab::report::{Block, Overlay, OverlayPath, Section, strips};
use formicar_lab::run::{Job, LoadedScenario, Run, Sources};
use std::collections::BTreeSet;

/// Scenarios that are drawn at most: the first ones.
const MOST_DRAWN: usize = 8;
/// Margin around the paths: a share of their extent, and meters.
const MARGIN: (f64, f64) = (0.06, 2.0);

/// Paths of one scenario: the job of the first, and every planner's with the least seed.
struct Scene<'a> {
    place: [&'a str; 3],
    job: &'a Job,
    paths: Vec<(&'a str, CurvePath)>,
}

/// The first scenarios with every planner's path; none where no store knows any. Scenarios whose
/// maps are no longer where they were are left out.
pub(super) fn section(stores: &[(String, Stored)]) -> Option<Section> {
    let scenes = scenes(stores);
    let drawn = scenes.iter().filter_map(|scene| {
        let job = scene.job;
        let scenario = Files.load(&job.task, job.vehicle_source());
        Some(draw(scene, &scenario.ok()?))
    });
    let blocks: Vec<Block> = drawn.take(MOST_DRAWN).flatten().collect();
    (!blocks.is_empty()).then(|| Section {
        heading: "Paths".to_owned(),
        blocks,
    })
}

fn scenes(stores: &[(String, Stored)]) -> Vec<Scene<'_>> {
    let mut scenes: Vec<Scene> = Vec::new();
    let mut known = BTreeSet::new();
    for (run, job) in stores.iter().flat_map(|(_, store)| with_jobs(store)) {
        let place = run.place();
        let planner = run.record.planner.as_str();
        let path = run
            .path
            .as_ref()
            .and_then(formicar::planner::PathDocument::curve_path);
        let Some(path) = path.filter(|_| known.insert((place, planner))) else {
            continue;
        };
        match scenes.iter_mut().find(|scene| scene.place == place) {
            Some(scene) => scene.paths.push((planner, path)),
            None => scenes.push(Scene {
                place,
                job,
                paths: vec![(planner, path)],
            }),
        }
    }
    scenes
}

fn with_jobs(store: &Stored) -> impl Iterator<Item = (&Run, &Job)> {
    let runs = store.runs.iter();
    runs.filter_map(|run| Some((run, store.jobs.get(&run.origin.run)?)))
}

fn draw(scene: &Scene, drawn: &LoadedScenario) -> Vec<Block> {
    let [scenario, vehicle, motion] = scene.place;
    let (planner, path) = &scene.paths[0];
    let vehicle_name = if vehicle.is_empty() { "own" } else { vehicle };
    let paths = scene.paths.iter();
    let paths: Vec<OverlayPath> = paths
        .map(|(name, path)| OverlayPath::along(name, path))
        .collect();
    let overlay = Overlay {
        caption: format!(
            "`{scenario}`, vehicle {vehicle_name}, {motion}: the first path of every planner."
        ),
        map: &drawn.map,
        window: window(&paths),
        vehicle: &drawn.vehicle,
        ends: [path.start(), path.end()],
        paths,
    };
    let caption = format!(
        "`{scenario}`: curvature, steering and clearance along the path of `{planner}`. Dashed \
         lines are the vehicle's limits."
    );
    let along = strips(&caption, &drawn.map, &drawn.vehicle, path);
    vec![Block::Figure(overlay.figure()), Block::Figure(along)]
}

/// The rectangle about all paths.
fn window(paths: &[OverlayPath]) -> Option<(Point2, Point2)> {
    let points = || paths.iter().flat_map(|path| &path.points).copied();
    let low = points().reduce(|a, b| Point2::new(a.x.min(b.x), a.y.min(b.y)))?;
    let high = points().reduce(|a, b| Point2::new(a.x.max(b.x), a.y.max(b.y)))?;
    let extent_m = (high.x - low.x).max(high.y - low.y);
    let margin_m = MARGIN.0 * extent_m + MARGIN.1;
    let margin = Point2::new(margin_m, margin_m);
    Some((low - margin, high + margin))
}
