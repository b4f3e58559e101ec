//! The frame of a chart: heading, bands, grid lines and numbers.

use super::AxisScale;
use super::plot::Plot;
use crate::geometry::Point2;
use crate::render::lettering::{Anchor, Lettering};
use crate::render::markup::Element;
use crate::render::palette;
use crate::render::svg::Svg;

const HEADING: Lettering = Lettering::new(13.0, palette::INK);
const NUMBERS: Lettering = Lettering::new(11.5, palette::MUTED);
const UNIT: Lettering = Lettering::new(12.0, palette::MUTED);

impl Plot<'_> {
    pub(super) fn draw_head(&self, svg: &mut Svg) {
        let base = self.corner - Point2::new(0.0, 8.0);
        let title = &self.chart.title;
        HEADING.bold().write(svg, base, title);
        let after = if title.is_empty() {
            0.0
        } else {
            HEADING.bold().width_px(title) + 10.0
        };
        UNIT.write(svg, base + Point2::new(after, 0.0), &self.chart.y.label);
        if let Some(right) = &self.chart.y_right {
            let end = base + Point2::new(self.size.x, 0.0);
            UNIT.anchored(Anchor::End).write(svg, end, &right.label);
        }
    }

    pub(super) fn draw_grid(&self, svg: &mut Svg) {
        for band in &self.chart.bands {
            let from = self.x_px(band.from.max(self.x.low));
            let to = self.x_px(band.to.min(self.x.high));
            let low = Point2::new(from, self.corner.y);
            let area = Element::rectangle(low, Point2::new((to - from).max(0.0), self.size.y));
            svg.add(&area.fill(palette::REVERSE.mix(palette::PAGE, 0.8)));
            self.name_band(svg, &band.label, from, to);
        }
        self.draw_x_axis(svg);
        if self.chart.boxes.is_empty() {
            self.draw_left_axis(svg);
        }
        if self.chart.y_right.is_some() {
            self.draw_right_axis(svg);
        }
        svg.add(&Element::rectangle(self.corner, self.size).pen(palette::RULE, 1.0));
    }

    /// Above the frame, where no line runs, if it fits there beside the heading.
    fn name_band(&self, svg: &mut Svg, label: &str, from: f64, to: f64) {
        let style = Lettering::new(12.0, palette::REVERSE.mix(palette::INK, 0.25));
        let half_px = 0.5 * style.width_px(label);
        let middle = 0.5 * (from + to);
        let free = self.corner.x + self.head_px()..self.corner.x + self.size.x;
        let wide_enough = to - from > 1.2 * half_px;
        if wide_enough && free.contains(&(middle - half_px)) && free.contains(&(middle + half_px)) {
            let base = Point2::new(middle, self.corner.y - 5.0);
            style.anchored(Anchor::Middle).write(svg, base, label);
        }
    }

    /// Width of title and unit above the frame.
    fn head_px(&self) -> f64 {
        let title_px = HEADING.bold().width_px(&self.chart.title);
        let unit_px = UNIT.width_px(&self.chart.y.label);
        title_px + unit_px + 24.0
    }

    fn draw_x_axis(&self, svg: &mut Svg) {
        let room_px = match self.x.kind {
            AxisScale::Linear => 80.0,
            AxisScale::Log => 56.0,
        };
        let foot = self.corner.y + self.size.y;
        let numbers = NUMBERS.anchored(Anchor::Middle);
        for tick in self.x.ticks((self.size.x / room_px).max(2.0)) {
            let px = self.x_px(tick.value);
            let line = Element::line(Point2::new(px, self.corner.y), Point2::new(px, foot));
            svg.add(&line.pen(palette::HAIRLINE, 1.0));
            if !self.chart.x.label.is_empty() {
                numbers.write(svg, Point2::new(px, foot + 16.0), &tick.label);
            }
        }
        let middle = Point2::new(self.corner.x + 0.5 * self.size.x, foot + 34.0);
        let label = UNIT.anchored(Anchor::Middle);
        label.write(svg, middle, &self.chart.x.label);
    }

    fn n_most_on_y(&self) -> f64 {
        (self.size.y / 16.0).clamp(2.0, 6.0)
    }

    fn draw_left_axis(&self, svg: &mut Svg) {
        let (left, right) = (self.corner.x, self.corner.x + self.size.x);
        let numbers = NUMBERS.anchored(Anchor::End);
        for tick in self.left.ticks(self.n_most_on_y()) {
            let px = self.y_px(tick.value, &self.left);
            let line = Element::line(Point2::new(left, px), Point2::new(right, px));
            let color = if tick.value == 0.0 {
                palette::RULE
            } else {
                palette::HAIRLINE
            };
            svg.add(&line.pen(color, 1.0));
            numbers.write(svg, Point2::new(left - 7.0, px + 4.0), &tick.label);
        }
    }

    fn draw_right_axis(&self, svg: &mut Svg) {
        let right = self.corner.x + self.size.x;
        for tick in self.right.ticks(self.n_most_on_y()) {
            let px = self.y_px(tick.value, &self.right);
            NUMBERS.write(svg, Point2::new(right + 7.0, px + 4.0), &tick.label);
        }
    }
}
