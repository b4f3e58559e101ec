//! Pictures and films of the ants of a colony.

use crate::picture::PNG_WIDTH_PX;
use crate::scene::Scene;
use anyhow::{Result, bail};
use formicar::numeric::counted;
use formicar::planner::{Answer, Outcome, PlannerName, Stages};
use formicar::progress::AntFrame;
use formicar::render::{ColonyPicture, colony_film, colony_picture, to_gif};
use formicar::smoothing::{CornerRecord, Rounding};

/// The formats of `--ants`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum AntsKind {
    Svg,
    Png,
    Gif,
}

/// File extensions and what they hold.
pub(crate) const KINDS: [(&str, AntsKind); 3] = [
    ("svg", AntsKind::Svg),
    ("png", AntsKind::Png),
    ("gif", AntsKind::Gif),
];

/// Width of a film, pixels.
const FILM_WIDTH_PX: u32 = 560;

/// Refuses a planner without ants.
pub(crate) fn check(planner: PlannerName) -> Result<()> {
    if !planner.has_ants() {
        bail!(
            "--ants: {} is not an ant colony; hint: --planner lei2020 (see `list planners`)",
            planner.name()
        );
    }
    Ok(())
}

/// The picture or film of an answer by a colony.
pub(crate) fn encode(
    scene: &Scene,
    answer: &Answer,
    outcome: &Outcome,
    frames: &[AntFrame],
    kind: AntsKind,
) -> Result<Vec<u8>> {
    let stages = outcome.stages();
    let [start, goal] = answer.ends();
    let colony = ColonyPicture {
        map: &scene.map,
        vehicle: &scene.vehicle.vehicle,
        start,
        goal,
        stages,
        frames,
        path: outcome.judged().map(|(path, _)| path),
        title: &answer.title(),
        caption: &caption(answer, stages),
    };
    Ok(match kind {
        AntsKind::Svg => colony_picture(&colony).to_svg().into_bytes(),
        AntsKind::Png => colony_picture(&colony).to_png(PNG_WIDTH_PX)?,
        AntsKind::Gif => to_gif(&colony_film(&colony), FILM_WIDTH_PX)?,
    })
}

/// Key numbers of a run, and the reason if there is no path.
fn caption(answer: &Answer, stages: &Stages) -> String {
    let mut parts = Vec::new();
    if let Some(run) = &stages.colony {
        let n_iterations = counted(run.history.iterations.len(), "iteration");
        parts.push(match run.history.converged_after() {
            Some(n) => format!("{n_iterations}, the best way after {n}"),
            None => n_iterations,
        });
    }
    if let Some(path) = &stages.grid_path {
        let (n_cells, n_nodes) = (path.cells.len(), stages.nodes.len());
        parts.push(format!("{n_cells} cells, {n_nodes} nodes"));
    }
    let is_turned = |corner: &&CornerRecord| matches!(corner.rounding, Rounding::TwoTurning(_));
    let n_turned = stages.corners.iter().filter(is_turned).count();
    if !stages.corners.is_empty() {
        let n_corners = stages.corners.len();
        parts.push(format!("{n_turned} of {n_corners} corners by arcs"));
    }
    if let Some(metrics) = &answer.metrics {
        parts.push(format!("{:.2} m", metrics.length_m));
    }
    let numbers = format!("{}: {}", answer.planner, parts.join(", "));
    match &answer.reason {
        Some(reason) => format!("{numbers}; {reason}"),
        None => numbers,
    }
}
