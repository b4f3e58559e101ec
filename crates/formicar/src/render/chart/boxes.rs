//! Rows of boxes over an x axis: quartiles, whiskers and every value as a dot.

use super::BoxRow;
use super::plot::Plot;
use crate::geometry::Point2;
use crate::render::lettering::{Anchor, Lettering};
use crate::render::markup::Element;
use crate::render::palette::{self, Color};
use crate::render::svg::Svg;

const ROW_PX: f64 = 27.0;
const HALF_BOX_PX: f64 = 8.0;
const HALF_CAP_PX: f64 = 4.0;
const BOX_FILL: Color = Color::rgb(0xdb, 0xe8, 0xf6);
/// Fonts of readers are up to so much wider than our letters.
const FONT_ROOM: f64 = 1.15;
const NAMES: Lettering = Lettering::new(12.5, palette::INK);
const NO_VALUE: Lettering = Lettering::new(12.5, palette::MUTED);

/// Height of a plot area with so many rows.
pub(super) fn height_px(n_rows: usize) -> f64 {
    ROW_PX * n_rows as f64 + 4.0
}

/// Width of the names of rows.
pub(super) fn names_px(rows: &[BoxRow]) -> f64 {
    let widths = rows.iter().map(|row| NAMES.width_px(&row.name));
    FONT_ROOM * widths.fold(30.0, f64::max) + 14.0
}

impl Plot<'_> {
    pub(super) fn draw_boxes(&self, svg: &mut Svg) {
        for (i, row) in self.chart.boxes.iter().enumerate() {
            let y_px = self.corner.y + ROW_PX * (i as f64 + 0.5);
            let name = Point2::new(self.corner.x - 8.0, y_px + 4.4);
            NAMES.anchored(Anchor::End).write(svg, name, &row.name);
            if let Some(quartiles) = row.quartiles {
                self.draw_box(svg, y_px, (row, quartiles));
            } else {
                let at = Point2::new(self.corner.x + 6.0, y_px + 4.4);
                NO_VALUE.write(svg, at, "no value");
            }
        }
    }

    fn draw_box(&self, svg: &mut Svg, y_px: f64, (row, [low, median, high]): (&BoxRow, [f64; 3])) {
        let at = |value: f64, down_px: f64| Point2::new(self.x_px(value), y_px + down_px);
        let line = |from, to| Element::line(from, to).pen(palette::FORWARD, 1.4);
        let [from, to] = row.whiskers;
        for (end, quartile) in [(from, low), (to, high)] {
            svg.add(&line(at(end, 0.0), at(quartile, 0.0)));
            svg.add(&line(at(end, -HALF_CAP_PX), at(end, HALF_CAP_PX)));
        }
        let corner = at(low, -HALF_BOX_PX);
        let area = Element::rectangle(corner, at(high, HALF_BOX_PX) - corner);
        svg.add(&area.fill(BOX_FILL).pen(palette::FORWARD, 1.4));
        for (i, &value) in row.values.iter().enumerate() {
            // Dots lie in five lines so that equal values are seen to be many.
            let down_px = 2.6 * ((i * 2 % 5) as f64 - 2.0);
            let dot = Element::circle(at(value, down_px), 1.9).fill(palette::INK);
            svg.add(&dot.text("fill-opacity", "0.55"));
        }
        let line = Element::line(at(median, -HALF_BOX_PX), at(median, HALF_BOX_PX));
        svg.add(&line.pen(palette::INK, 2.6).text("stroke-linecap", "butt"));
    }
}
