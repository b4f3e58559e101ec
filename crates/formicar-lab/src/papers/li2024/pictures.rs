//! All methods in one picture.

use super::drive::{Drive, Exhibit};
use super::group::Group;
use super::methods::PROPOSED;
use super::tables::COMPARISON;
use crate::papers::experiment::Ground;
use crate::report::{Block, BoxGroup, BoxPlot, Overlay, OverlayPath, ScaleKind, Section, strips};
use formicar::geometry::Point2;

/// The whole map, then all paths in the part that holds them, then what the proposed method's path
/// is like along its length.
pub(super) fn map(ground: &Ground, exhibits: &[Exhibit], part: (Point2, Point2)) -> Section {
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
    let path = |exhibit: &Exhibit| OverlayPath {
        name: exhibit.method.clone(),
        points: exhibit.native.clone(),
    };
    let paths = exhibits.iter().filter(|exhibit| !exhibit.native.is_empty());
    let all = overlay(
        "All methods, seed 0: paths before corners are rounded.".to_owned(),
        Some(part),
        paths.map(path).collect(),
    );
    let whole = overlay(caption, None, Vec::new());
    let own = exhibits.iter().find(|exhibit| exhibit.method == PROPOSED);
    let along = own.and_then(|exhibit| {
        let (path, report) = exhibit.judged.as_ref()?;
        let caption = format!(
            "`{PROPOSED}`, seed 0: curvature, steering and clearance along its path of {:.2} m, \
             least clearance {:.3} m. Dashed lines are the vehicle's limits.",
            path.length_m(),
            report.min_clearance_m
        );
        Some(strips(&caption, (&ground.grid, &ground.vehicle), path))
    });
    let figures = [whole.figure(), all.figure()].into_iter().chain(along);
    Section {
        heading: "Map: figure 4".to_owned(),
        blocks: figures.map(Block::Figure).collect(),
    }
}

/// A number of a run, its name, and whether its axis is logarithmic.
type Spread = (&'static str, ScaleKind, fn(&Drive) -> Option<f64>);

const SPREADS: [Spread; 4] = [
    ("path before rounding, m", ScaleKind::Linear, |drive| {
        drive.native_length_m
    }),
    ("certified curve, m", ScaleKind::Linear, |drive| {
        drive.certified_length_m
    }),
    ("map set-up and query, ms", ScaleKind::Log, |drive| {
        Some(drive.total_ms)
    }),
    (
        "largest turn over 1 m, degrees",
        ScaleKind::Linear,
        |drive| drive.largest_step_deg,
    ),
];

/// Box plots of all methods.
pub(super) fn spreads(drives: &[Drive], methods: &[&str], ground: &str) -> Section {
    let plot = |&(quantity, scale, of): &Spread| BoxPlot {
        caption: format!(
            "`{ground}`, {quantity}: boxes from quartile to quartile, whiskers to the farthest \
             value within 1.5 box lengths, dots are runs."
        ),
        quantity: quantity.to_owned(),
        scale,
        groups: methods
            .iter()
            .map(|method| BoxGroup {
                name: (*method).to_owned(),
                values: Group::new(drives, COMPARISON, method).on(ground).values(of),
            })
            .collect(),
        reference: None,
    };
    Section {
        heading: "How runs are spread".to_owned(),
        blocks: SPREADS.iter().map(plot).map(Block::BoxPlot).collect(),
    }
}
