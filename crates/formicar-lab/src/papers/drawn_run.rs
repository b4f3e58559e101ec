//! A run kept for its pictures.

use crate::papers::experiment::{Ground, Variant};
use crate::report::{Figure, Overlay, OverlayPath, strips};
use anyhow::Result;
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::Outcome;
use formicar::validation::Report;

/// A run with the seed 0.
pub(crate) struct DrawnRun {
    pub(crate) variant: String,
    pub(crate) outcome: Outcome,
}

/// The path of a run that is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Line {
    /// The ants' way from cell to cell.
    Cells,
    /// The curve that was judged, or the ants' way where there is none.
    Curve,
}

impl DrawnRun {
    pub(crate) fn new(ground: &Ground, variant: &Variant) -> Result<Self> {
        let mut planner = ground.planner(&variant.config)?;
        Ok(Self {
            variant: variant.name.clone(),
            outcome: planner.plan(&ground.request, Seed(0), &mut ())?,
        })
    }

    /// The line as a path to be drawn; none where the run has none.
    fn path(&self, ground: &Ground, line: Line) -> Option<OverlayPath> {
        let curve = match line {
            Line::Cells => None,
            Line::Curve => self.outcome.judged(),
        };
        if let Some((curve, _)) = curve {
            return Some(OverlayPath::along(&self.variant, curve));
        }
        let frame = ground.grid.frame();
        let cells = &self.outcome.stages().grid_path.as_ref()?.cells;
        Some(OverlayPath {
            name: self.variant.clone(),
            points: cells.iter().map(|&cell| frame.center(cell)).collect(),
        })
    }
}

/// The paths of several runs on their map.
pub(crate) fn overlay(
    ground: &Ground,
    drawn_runs: &[DrawnRun],
    line: Line,
    caption: &str,
) -> Figure {
    let paths = drawn_runs.iter();
    let paths = paths.filter_map(|drawn| drawn.path(ground, line));
    Overlay {
        caption: caption.to_owned(),
        map: &ground.grid,
        window: None,
        vehicle: &ground.vehicle,
        ends: [ground.request.start, ground.request.goal],
        paths: paths.collect(),
    }
    .figure()
}

/// Curvature, steering and clearance along the judged path of a method.
pub(crate) fn strips_of(
    ground: &Ground,
    method: &str,
    path: &CurvePath,
    report: &Report,
) -> Figure {
    let word = if report.valid {
        "certified"
    } else {
        "refused by the judge"
    };
    let caption = format!(
        "`{}` on `{}`, seed 0: curvature, steering and clearance along its path of {:.2} m, {word}, \
         least clearance {:.3} m. Dashed lines are the vehicle's limits.",
        method,
        ground.map,
        path.length_m(),
        report.min_clearance_m
    );
    strips(&caption, &ground.grid, &ground.vehicle, path)
}
