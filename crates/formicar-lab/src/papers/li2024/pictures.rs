//! All methods in one picture.

use super::drive::{Drawn, Drive};
use super::group::{COMPARISON, DRIVEN, LENGTH, STEP, TIME, drives_of};
use super::methods::PROPOSED;
use crate::papers::drawn_run::strips_of;
use crate::papers::experiment::Ground;
use crate::papers::group::Quantity;
use crate::report::{Block, BoxPlot, Overlay, OverlayPath, Section};
use formicar::geometry::Point2;
use formicar::render::AxisScale;

/// The whole map, then all paths in the part that holds them, then what the proposed method's path
/// is like along its length.
pub(super) fn map(ground: &Ground, drawn_runs: &[Drawn], part: (Point2, Point2)) -> Section {
    let frame = ground.grid.frame();
    let overlay = |caption: String, window, paths| Overlay {
        caption,
        map: &ground.grid,
        window,
        vehicle: &ground.vehicle,
        ends: [ground.request.start, ground.request.goal],
        paths,
    };
    let caption = format!(
        "Figure 4(b): `{}`, {} x {} cells of {} m, with start and goal.",
        ground.map,
        frame.n_cols(),
        frame.n_rows(),
        frame.resolution_m()
    );
    let path = |drawn: &Drawn| OverlayPath {
        name: drawn.run.variant.clone(),
        points: drawn.native.clone(),
    };
    let paths = drawn_runs.iter().filter(|drawn| !drawn.native.is_empty());
    let all = overlay(
        "All methods, seed 0: paths before corners are rounded.".to_owned(),
        Some(part),
        paths.map(path).collect(),
    );
    let whole = overlay(caption, None, Vec::new());
    let own = drawn_runs
        .iter()
        .find(|drawn| drawn.run.variant == PROPOSED);
    let along = own.and_then(|drawn| {
        let (path, report) = drawn.run.outcome.judged()?;
        Some(strips_of(ground, PROPOSED, path, report))
    });
    let figures = [whole.figure(), all.figure()].into_iter().chain(along);
    Section::new("Map: figure 4", figures.map(Block::Figure).collect())
}

/// Quantities with a logarithmic or linear axis.
const SPREADS: [(Quantity<Drive>, AxisScale); 4] = [
    (LENGTH, AxisScale::Linear),
    (DRIVEN, AxisScale::Linear),
    (TIME, AxisScale::Log),
    (STEP, AxisScale::Linear),
];

/// Box plots of all methods.
pub(super) fn spreads(drives: &[Drive], methods: &[&str], ground: &str) -> Section {
    let plot = |(quantity, scale): &(Quantity<Drive>, AxisScale)| {
        let group = |method: &&str| {
            let group = drives_of(drives, COMPARISON, method).on(ground);
            group.boxed(method, quantity.of)
        };
        BoxPlot {
            caption: format!(
                "`{ground}`, {}: boxes from quartile to quartile, whiskers to the farthest value \
                 within 1.5 box lengths, dots are runs.",
                quantity.name
            ),
            quantity: quantity.name.to_owned(),
            scale: *scale,
            groups: methods.iter().map(group).collect(),
            reference: None,
        }
    };
    let plots = SPREADS.iter().map(plot).map(Block::BoxPlot);
    Section::new("How runs are spread", plots.collect())
}
