//! The picture of a colony: pheromone, ants and nodes on the map, and how it converged.

use super::chart::{convergence_charts, costs_up_to};
use super::palette::{self, Color};
use super::style::{CellStyle, Dash, LineStyle};
use super::view::frame_bounds;
use super::{Layout, Picture, PoseMark, Scene};
use crate::geometry::{Point2, Pose2};
use crate::map::OccupancyGrid;
use crate::path::{CurvePath, GridPath};
use crate::planner::Stages;
use crate::progress::AntFrame;
use crate::vehicle::Vehicle;

/// Most iterations that are shown side by side.
const MAX_PANELS: usize = 6;
const PANELS_IN_ROW: usize = 3;

const ARRIVED: (&str, Color) = ("ants that arrived", palette::INK);
const LOST: (&str, Color) = ("ants that got lost", palette::SWEPT);

/// All that the pictures of a colony are made from.
#[derive(Clone, Copy, Debug)]
pub struct ColonyPicture<'a> {
    /// The ground.
    pub map: &'a OccupancyGrid,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// The start pose.
    pub start: Pose2,
    /// The goal pose.
    pub goal: Pose2,
    /// The stages before the path: layers, the run of the colony, nodes.
    pub stages: &'a Stages,
    /// Iterations that were kept, in their order; the ways of the last are on the map.
    pub frames: &'a [AntFrame],
    /// The path that came of it, if there is one.
    pub path: Option<&'a CurvePath>,
    /// Heading.
    pub title: &'a str,
    /// Key numbers, or the reason why there is no path.
    pub caption: &'a str,
}

/// The picture of a colony: the map with layers, pheromone at the end, the ways of the last
/// iteration, nodes and path; its convergence; some iterations side by side.
pub fn colony_picture(colony: &ColonyPicture) -> Picture {
    let mut scene = colony.ground(Scene::new(colony.map));
    if let Some(run) = &colony.stages.colony {
        scene.log_heat_map(&run.pheromone, "pheromone");
    }
    if let Some(last) = colony.frames.last() {
        draw_ants(&mut scene, last);
    }
    colony.draw_result(&mut scene);
    colony.draw_ends(&mut scene);
    let history = colony.stages.colony.as_ref().map(|run| &run.history);
    let mut picture = Picture {
        title: colony.title.to_owned(),
        caption: colony.caption.to_owned(),
        scene: Some(scene),
        charts: history.map(convergence_charts).unwrap_or_default(),
        ..Picture::default()
    };
    if colony.frames.len() > 1 {
        let side_px = picture.panel_side_px(PANELS_IN_ROW);
        let shown = spread(colony.frames.len(), |i| colony.frames[i].record.iteration);
        let panel = |i: usize| colony.panel(&colony.frames[i], side_px);
        picture.panels = shown.into_iter().map(panel).collect();
    }
    picture
}

/// The pictures of a film: each kept iteration, and at the end what came of it.
pub fn colony_film(colony: &ColonyPicture) -> Vec<Picture> {
    let iterations = colony.frames.iter().map(|frame| {
        let mut scene = colony.frame_scene(frame);
        draw_best(&mut scene, frame.best.as_ref());
        colony.film_picture(scene, frame)
    });
    let result = colony.frames.last().map(|frame| {
        let mut scene = colony.frame_scene(frame);
        colony.draw_result(&mut scene);
        colony.film_picture(scene, frame)
    });
    iterations.chain(result).collect()
}

impl ColonyPicture<'_> {
    /// A map with what was laid over it.
    fn ground(&self, mut scene: Scene) -> Scene {
        if let Some(layers) = &self.stages.layers {
            for (cells, style) in [
                (&layers.expanded, CellStyle::expanded()),
                (&layers.closed, CellStyle::closed()),
            ] {
                if cells.count() > 0 {
                    scene.cells(cells, &style);
                }
            }
        }
        scene
    }

    /// The ants of an iteration, on a small page.
    fn frame_scene(&self, frame: &AntFrame) -> Scene {
        let bounds = frame_bounds(self.map.frame());
        let mut scene = self.ground(Scene::part(self.map, bounds, Layout::Phone));
        scene.log_heat_map(&frame.pheromone, "pheromone");
        draw_ants(&mut scene, frame);
        scene
    }

    fn film_picture(&self, mut scene: Scene, frame: &AntFrame) -> Picture {
        self.draw_ends(&mut scene);
        let number = frame.record.iteration as usize + 1;
        let run = self.stages.colony.as_ref();
        let n_iterations = run.map_or(number, |run| run.history.iterations.len());
        let costs = run.map(|run| costs_up_to(&run.history, number));
        Picture {
            title: self.title.to_owned(),
            caption: format!("iteration {number} of {n_iterations}: {}", numbers(frame)),
            scene: Some(scene),
            charts: costs.into_iter().collect(),
            layout: Layout::Phone,
            ..Picture::default()
        }
    }

    fn panel(&self, frame: &AntFrame, side_px: f64) -> (Scene, String) {
        let mut scene = self.ground(Scene::small(self.map, Point2::new(side_px, side_px)));
        scene.log_heat_map(&frame.pheromone, "");
        draw_ants(&mut scene, frame);
        draw_best(&mut scene, frame.best.as_ref());
        scene
            .end(self.start.position(), PoseMark::Start)
            .end(self.goal.position(), PoseMark::Goal);
        let heading = format!(
            "iteration {}: {}",
            frame.record.iteration + 1,
            numbers(frame)
        );
        (scene, heading)
    }

    /// The result of the ants: nodes, straight lines between those that stay, and the path.
    fn draw_result(&self, scene: &mut Scene) {
        let nodes = &self.stages.nodes;
        if !nodes.is_empty() {
            scene.cell_line(nodes, &line("over nodes", palette::INK, Dash::Dashed));
        }
        if let Some(path) = self.path {
            scene.curve(path).joints(path);
        }
        if let Some(path) = &self.stages.grid_path {
            scene.nodes(&path.cells, nodes);
        }
    }

    fn draw_ends(&self, scene: &mut Scene) {
        scene.pose(self.start, self.vehicle, PoseMark::Start);
        scene.pose(self.goal, self.vehicle, PoseMark::Goal);
    }
}

fn draw_ants(scene: &mut Scene, frame: &AntFrame) {
    let n_ants = frame.record.n_ants;
    scene
        .traffic(&frame.lost, n_ants, LOST)
        .traffic(&frame.arrived, n_ants, ARRIVED);
}

fn draw_best(scene: &mut Scene, best: Option<&GridPath>) {
    let Some(best) = best else {
        return;
    };
    let style = line("best of the iteration", palette::FORWARD, Dash::Solid);
    scene.cell_line(&best.cells, &style);
}

fn line(label: &str, color: Color, dash: Dash) -> LineStyle {
    LineStyle {
        label: label.to_owned(),
        color,
        width_px: 1.8,
        dash,
    }
}

/// The numbers of an iteration, in words.
fn numbers(frame: &AntFrame) -> String {
    let record = &frame.record;
    let arrived = format!("{} of {} arrived", record.n_arrived, record.n_ants);
    match record.best_cost {
        Some(cost) => format!("{arrived}, best {cost:.1}"),
        None => arrived,
    }
}

/// The frames to show side by side: the first, the last, and between them those nearest
/// to equal ratios of iterations, for a colony changes most in its first.
fn spread(n_frames: usize, iteration: impl Fn(usize) -> u32) -> Vec<usize> {
    let number = |i: usize| f64::from(iteration(i)) + 1.0;
    let n_shown = n_frames.min(MAX_PANELS);
    let ratio = number(n_frames - 1) / number(0);
    let mut shown: Vec<usize> = Vec::new();
    for panel in 0..n_shown {
        // Each after the one before, and so that enough are left for those that follow.
        let from = shown.last().map_or(0, |last| last + 1);
        let to = n_frames - (n_shown - panel);
        let wanted = number(0) * ratio.powf(panel as f64 / (n_shown - 1).max(1) as f64);
        let far = |i: &usize| (number(*i) / wanted).ln().abs();
        let nearest = (from..=to).min_by(|a, b| far(a).total_cmp(&far(b)));
        shown.extend(nearest);
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_are_spread_over_ratios() {
        let iterations: Vec<u32> = (0..150).collect();
        let shown = spread(150, |i| iterations[i]);
        assert_eq!(shown, [0, 2, 6, 19, 54, 149]);
        assert_eq!(spread(7, |i| i as u32), [0, 1, 2, 3, 4, 6]);
        assert_eq!(spread(3, |i| i as u32), [0, 1, 2]);
    }
}
