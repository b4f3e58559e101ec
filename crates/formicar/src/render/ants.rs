//! The traces of ants on a map: their traffic, and the nodes of the path found.

use super::Scene;
use super::legend::{Dot, Swatch};
use super::markup::Element;
use super::palette::{self, Color};
use super::style::{Dash, LineStyle};
use super::svg::PathData;
use super::view::View;
use crate::geometry::Point2;
use crate::map::Cell;
use crate::path::CurvePath;
use crate::progress::Traffic;

/// Shades of traffic, from a single ant to all of them.
const N_SHADES: usize = 12;
/// Opacity of the way of a single ant.
const LEAST_OPACITY: f64 = 0.13;
/// Width of the way of a single ant, and of that of all, pixels.
const WIDTH_PX: (f64, f64) = (0.9, 3.0);
/// Nodes are drawn on cells of at least this size.
const MIN_NODE_CELL_PX: f64 = 6.0;

impl Scene {
    /// The passages of ants: the more of them, the darker and wider, evenly over ratios up to
    /// `n_most`.
    pub fn traffic(&mut self, traffic: &[Traffic], n_most: u32, style: (&str, Color)) -> &mut Self {
        let (label, color) = style;
        let shade = |n_passed: u32| {
            let share = f64::from(n_passed).ln() / f64::from(n_most.max(2)).ln();
            (share.clamp(0.0, 1.0) * (N_SHADES - 1) as f64).round() as usize
        };
        let mut lines = vec![(PathData::default(), false); N_SHADES];
        for passed in traffic.iter().filter(|passed| passed.n_passed > 0) {
            let [from, to] = passed.cells.map(|cell| self.frame.center(cell));
            let (line, used) = &mut lines[shade(passed.n_passed)];
            line.move_to(self.view.to_px(from));
            line.line_to(self.view.to_px(to));
            *used = true;
        }
        let used = lines.into_iter().enumerate().filter(|(_, line)| line.1);
        for (shade, (line, _)) in used {
            let share = shade as f64 / (N_SHADES - 1) as f64;
            let opacity = LEAST_OPACITY + (0.9 - LEAST_OPACITY) * share;
            let width_px = WIDTH_PX.0 + (WIDTH_PX.1 - WIDTH_PX.0) * share;
            let line = Element::path(line).pen(color, width_px);
            self.body.add(&line.number("stroke-opacity", opacity));
        }
        if !traffic.is_empty() {
            self.legend.add(label, Swatch::Line(color, Dash::Solid));
        }
        self
    }

    /// The cells of a grid path, and those that stay when redundant nodes are removed. Nothing on
    /// cells too small to tell nodes apart.
    pub fn nodes(&mut self, all: &[Cell], kept: &[Cell]) -> &mut Self {
        let cell_px = self.frame.resolution_m() * self.px_per_m();
        if cell_px < MIN_NODE_CELL_PX {
            return self;
        }
        let dot = |fill, share_of_cell: f64, most_px: f64| Dot {
            fill,
            pen: palette::PAGE,
            radius_px: (share_of_cell * cell_px).min(most_px),
        };
        let redundant = all.iter().filter(|cell| !kept.contains(cell));
        self.dots(redundant, "redundant node", dot(palette::INK, 0.2, 2.8))
            .dots(kept.iter(), "node", dot(palette::WAYPOINTS, 0.42, 5.0))
    }

    fn dots<'a>(
        &mut self,
        cells: impl Iterator<Item = &'a Cell>,
        label: &str,
        dot: Dot,
    ) -> &mut Self {
        for &cell in cells {
            let at = self.view.to_px(self.frame.center(cell));
            self.body.add(&dot.at(at));
            self.legend.add(label, Swatch::Dot(dot));
        }
        self
    }

    /// Straight lines through cells, with the page shining around them.
    pub(super) fn cell_line(&mut self, cells: &[Cell], style: &LineStyle) -> &mut Self {
        let centers: Vec<Point2> = cells.iter().map(|&c| self.frame.center(c)).collect();
        let casing = PathData::polyline(centers.iter().map(|&p| self.view.to_px(p)));
        let casing = Element::path(casing).pen(palette::PAGE, style.width_px + 2.2);
        self.body.add(&casing.text("stroke-opacity", "0.8"));
        self.polyline(&centers, style)
    }

    /// Short strokes across a path where one of its arcs or lines ends and the next begins.
    pub fn joints(&mut self, path: &CurvePath) -> &mut Self {
        let mut strokes = PathData::default();
        for segment in path.segments().iter().skip(1) {
            let at = self.view.to_px(segment.start.position());
            let across = View::direction(segment.start.heading).perpendicular() * 5.0;
            strokes.move_to(at - across);
            strokes.line_to(at + across);
        }
        if path.segments().len() > 1 {
            self.body
                .add(&Element::path(strokes).pen(palette::FORWARD, 1.6));
        }
        self
    }
}
