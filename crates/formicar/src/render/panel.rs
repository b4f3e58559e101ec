//! A scene on the page: its frame with coordinates, and the row of scale bar and legend below.

use super::Scene;
use super::legend::{self, scale_bar};
use super::lettering::{Anchor, Lettering};
use super::markup::Element;
use super::palette;
use super::style::LEFT_PX;
use super::svg::Svg;
use super::ticks;
use crate::geometry::Point2;

/// Room for coordinates below the panel.
const BELOW_PX: f64 = 22.0;
/// Room between the coordinates and the legend.
const LEGEND_GAP_PX: f64 = 6.0;
const COORDINATES: Lettering = Lettering::new(11.5, palette::MUTED);

impl Scene {
    /// Width and height on the page, with coordinates and legend.
    pub(super) fn size_px(&self) -> Point2 {
        let panel = self.panel_px();
        let indent_px = self.draw_scale_bar(&mut Svg::default(), Point2::default());
        let legend_px = self.legend.height_px(panel.x, indent_px);
        let height_px = panel.y + BELOW_PX + LEGEND_GAP_PX + legend_px;
        Point2::new(LEFT_PX + panel.x, height_px)
    }

    /// Draws everything with its upper left corner at a point of the page.
    pub(super) fn draw(&self, svg: &mut Svg, at: Point2) {
        let panel = self.panel_px();
        let corner = at + Point2::new(LEFT_PX, 0.0);
        self.draw_bare(svg, corner);
        self.draw_coordinates(svg, corner);

        let row = corner + Point2::new(0.0, panel.y + BELOW_PX + LEGEND_GAP_PX);
        let indent_px = self.draw_scale_bar(svg, row);
        self.legend.draw(svg, row, panel.x, indent_px);
    }

    /// Draws the panel alone, without coordinates and legend.
    pub(super) fn draw_bare(&self, svg: &mut Svg, corner: Point2) {
        let panel = self.panel_px();
        let mut inner = self.contents();
        self.labels.draw(&mut inner, panel);
        // A nested document clips what leaves the panel.
        svg.wrap(&Element::rectangle(corner, panel).rename("svg"), &inner);
        svg.add(&Element::rectangle(corner, panel).pen(palette::RULE, 1.0));
    }

    /// The legend alone is dropped, where another scene of the same picture shows it.
    pub(super) fn without_legend(mut self) -> Self {
        self.legend = legend::Legend::default();
        self
    }

    fn draw_scale_bar(&self, svg: &mut Svg, at: Point2) -> f64 {
        scale_bar(svg, at, self.panel_px().x, self.view.px_per_m())
    }

    fn draw_coordinates(&self, svg: &mut Svg, corner: Point2) {
        let (panel, px_per_m) = (self.panel_px(), self.view.px_per_m());
        let (low, high) = self.view.bounds();
        let step_m = ticks::round_step(90.0 / px_per_m, 1.0);
        let base = corner + Point2::new(0.0, panel.y);
        let below = COORDINATES.anchored(Anchor::Middle);
        for x in ticks::multiples(low.x, high.x, step_m) {
            let tick = base + Point2::new((x - low.x) * px_per_m, 0.0);
            svg.add(&Element::line(tick, tick + Point2::new(0.0, 4.0)).pen(palette::RULE, 1.0));
            let text = tick + Point2::new(0.0, 16.0);
            below.write(svg, text, &ticks::label(x, step_m));
        }
        let beside = COORDINATES.anchored(Anchor::End);
        for y in ticks::multiples(low.y, high.y, step_m) {
            let tick = base - Point2::new(0.0, (y - low.y) * px_per_m);
            svg.add(&Element::line(tick, tick - Point2::new(4.0, 0.0)).pen(palette::RULE, 1.0));
            let text = tick + Point2::new(-8.0, 4.0);
            beside.write(svg, text, &ticks::label(y, step_m));
        }
    }
}
