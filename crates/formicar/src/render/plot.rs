//! A chart on the page.

use super::chart::{Chart, Series, Side};
use super::legend::{Legend, Swatch};
use super::lettering::{Anchor, Lettering};
use super::palette;
use super::panel::LEFT_PX;
use super::svg::{Element, PathData, Svg};
use super::ticks;
use crate::geometry::Point2;

const RIGHT_AXIS_PX: f64 = 44.0;
const HEAD_PX: f64 = 24.0;
const BELOW_PX: f64 = 8.0;
const BELOW_WITH_NUMBERS_PX: f64 = 42.0;
const USUAL_HEIGHT_PX: f64 = 100.0;

const HEADING: Lettering = Lettering::new(13.0, palette::INK);
const NUMBERS: Lettering = Lettering::new(11.5, palette::MUTED);
const LIMITS: Lettering = Lettering::new(11.5, palette::LIMIT);

/// The plot area of a chart on the page, with its ranges.
struct Plot<'a> {
    chart: &'a Chart,
    corner: Point2,
    size: Point2,
    x: (f64, f64),
    left: (f64, f64),
    right: (f64, f64),
}

impl Chart {
    /// Height on the page at a width, with headings, axes and legend.
    pub(super) fn full_height_px(&self, width_px: f64) -> f64 {
        let legend_px = if self.legend_line() {
            self.legend().height_px(self.plot_width_px(width_px), 0.0)
        } else {
            0.0
        };
        HEAD_PX + self.plot_height_px() + self.below_px() + legend_px
    }

    /// Draws the chart with its upper left corner at a point of the page.
    pub(super) fn draw(&self, svg: &mut Svg, at: Point2, width_px: f64) {
        let plot = Plot {
            chart: self,
            corner: at + Point2::new(LEFT_PX, HEAD_PX),
            size: Point2::new(self.plot_width_px(width_px), self.plot_height_px()),
            x: self.x_range(),
            left: self.y_range(Side::Left),
            right: self.y_range(Side::Right),
        };
        plot.draw_head(svg);
        plot.draw_grid(svg);
        plot.draw_data(svg);
        plot.draw_limits(svg);
        if self.legend_line() {
            let below = plot.size.y + self.below_px();
            let place = plot.corner + Point2::new(0.0, below);
            self.legend().draw(svg, place, (plot.size.x, 0.0));
        }
    }

    fn plot_width_px(&self, width_px: f64) -> f64 {
        let right_px = self.y_right.as_ref().map_or(0.0, |_| RIGHT_AXIS_PX);
        (width_px - LEFT_PX - right_px).max(40.0)
    }

    fn plot_height_px(&self) -> f64 {
        if self.height_px > 0.0 {
            self.height_px
        } else {
            USUAL_HEIGHT_PX
        }
    }

    fn below_px(&self) -> f64 {
        if self.x.label.is_empty() {
            BELOW_PX
        } else {
            BELOW_WITH_NUMBERS_PX
        }
    }

    fn legend_line(&self) -> bool {
        let named = self.series.iter().any(|s| !s.label.is_empty());
        named || self.ribbons.iter().any(|r| !r.label.is_empty())
    }

    fn legend(&self) -> Legend {
        let mut legend = Legend::default();
        for series in &self.series {
            legend.add(&series.label, Swatch::Line(series.color, series.dash));
        }
        for ribbon in &self.ribbons {
            legend.add(&ribbon.label, Swatch::Area(ribbon.color));
        }
        legend
    }
}

impl Plot<'_> {
    fn at(&self, point: Point2, side: Side) -> Point2 {
        let (low, high) = match side {
            Side::Left => self.left,
            Side::Right => self.right,
        };
        let across = (point.x - self.x.0) / (self.x.1 - self.x.0);
        let up = (point.y - low) / (high - low);
        self.corner + Point2::new(across * self.size.x, (1.0 - up) * self.size.y)
    }

    fn draw_head(&self, svg: &mut Svg) {
        let base = self.corner - Point2::new(0.0, 8.0);
        let title = &self.chart.title;
        HEADING.bold().write(svg, base, title);
        let after = if title.is_empty() {
            0.0
        } else {
            HEADING.bold().width_px(title) + 10.0
        };
        let unit = Lettering::new(12.0, palette::MUTED);
        unit.write(svg, base + Point2::new(after, 0.0), &self.chart.y.label);
        if let Some(right) = &self.chart.y_right {
            let end = base + Point2::new(self.size.x, 0.0);
            unit.anchored(Anchor::End).write(svg, end, &right.label);
        }
    }

    fn draw_grid(&self, svg: &mut Svg) {
        for band in &self.chart.bands {
            let edge = |x: f64| self.at(Point2::new(x, self.left.0), Side::Left).x;
            let (from, to) = (edge(band.from.max(self.x.0)), edge(band.to.min(self.x.1)));
            let low = Point2::new(from, self.corner.y);
            let area = Element::rectangle(low, Point2::new((to - from).max(0.0), self.size.y));
            svg.add(&area.fill(palette::REVERSE.mix(palette::PAGE, 0.8)));
            self.name_band(svg, &band.label, (from, to));
        }
        self.draw_x_axis(svg);
        self.draw_y_axis(svg, (self.left, Side::Left));
        if self.chart.y_right.is_some() {
            self.draw_y_axis(svg, (self.right, Side::Right));
        }
        svg.add(&Element::rectangle(self.corner, self.size).pen(palette::RULE, 1.0));
    }

    /// Above the frame, where no line runs, if it fits there beside the heading.
    fn name_band(&self, svg: &mut Svg, label: &str, (from, to): (f64, f64)) {
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
        let unit_px = Lettering::new(12.0, palette::MUTED).width_px(&self.chart.y.label);
        title_px + unit_px + 24.0
    }

    fn draw_x_axis(&self, svg: &mut Svg) {
        let (low, high) = self.x;
        let step = ticks::round_step(high - low, (self.size.x / 80.0).max(2.0));
        let foot = self.corner.y + self.size.y;
        let numbers = NUMBERS.anchored(Anchor::Middle);
        for x in ticks::multiples(low, high, step) {
            let px = self.at(Point2::new(x, self.left.0), Side::Left).x;
            let line = Element::line(Point2::new(px, self.corner.y), Point2::new(px, foot));
            svg.add(&line.pen(palette::HAIRLINE, 1.0));
            if !self.chart.x.label.is_empty() {
                numbers.write(svg, Point2::new(px, foot + 16.0), &ticks::label(x, step));
            }
        }
        let middle = Point2::new(self.corner.x + 0.5 * self.size.x, foot + 34.0);
        let label = Lettering::new(12.0, palette::MUTED).anchored(Anchor::Middle);
        label.write(svg, middle, &self.chart.x.label);
    }

    fn draw_y_axis(&self, svg: &mut Svg, ((low, high), side): ((f64, f64), Side)) {
        let step = ticks::round_step(high - low, (self.size.y / 16.0).clamp(2.0, 6.0));
        for y in ticks::multiples(low, high, step) {
            let px = self.at(Point2::new(self.x.0, y), side).y;
            let (left, right) = (self.corner.x, self.corner.x + self.size.x);
            let label = ticks::label(y, step);
            if side == Side::Left {
                let line = Element::line(Point2::new(left, px), Point2::new(right, px));
                let color = if y == 0.0 {
                    palette::RULE
                } else {
                    palette::HAIRLINE
                };
                svg.add(&line.pen(color, 1.0));
                let end = NUMBERS.anchored(Anchor::End);
                end.write(svg, Point2::new(left - 7.0, px + 4.0), &label);
            } else {
                NUMBERS.write(svg, Point2::new(right + 7.0, px + 4.0), &label);
            }
        }
    }

    fn draw_data(&self, svg: &mut Svg) {
        let mut inner = Svg::default();
        // The clipping document has its own origin.
        let local = Plot {
            corner: Point2::default(),
            ..*self
        };
        for ribbon in &self.chart.ribbons {
            let finite = ribbon
                .points
                .iter()
                .filter(|p| p.iter().all(|v| v.is_finite()));
            let low = finite.clone().map(|p| Point2::new(p[0], p[1]));
            let high = finite.rev().map(|p| Point2::new(p[0], p[2]));
            let mut outline = PathData::default();
            outline.polygon(low.chain(high).map(|p| local.at(p, Side::Left)));
            let area = Element::path(outline).fill(ribbon.color);
            inner.add(&area.text("fill-opacity", "0.22"));
        }
        for series in &self.chart.series {
            let line = Element::path(local.line(series)).pen(series.color, 1.8);
            inner.add(&match series.dash.pattern() {
                Some(p) => line
                    .text("stroke-dasharray", p)
                    .text("stroke-linecap", "butt"),
                None => line,
            });
        }
        svg.wrap(
            &Element::rectangle(self.corner, self.size).rename("svg"),
            &inner,
        );
        if let Some((point, text)) = &self.chart.ringed {
            let at = self.at(*point, Side::Left);
            svg.add(&Element::circle(at, 5.0).pen(palette::LIMIT, 2.0));
            let (anchor, x) = if at.x > self.corner.x + 0.8 * self.size.x {
                (Anchor::End, -10.0)
            } else {
                (Anchor::Start, 10.0)
            };
            let above = at.y > self.corner.y + 0.5 * self.size.y;
            let base = at + Point2::new(x, if above { -7.0 } else { 14.0 });
            LIMITS
                .bold()
                .anchored(anchor)
                .write_with_halo(svg, base, text);
        }
    }

    /// The line of a series; points that would fall on the last one drawn are passed over.
    fn line(&self, series: &Series) -> PathData {
        let mut path = PathData::default();
        let mut last: Option<Point2> = None;
        for (i, &point) in series.points.iter().enumerate() {
            let px = self.at(point, series.side);
            let same = last.is_some_and(|last| px.distance(last) < 0.3);
            if !same || i + 1 == series.points.len() {
                path.line_to(px);
                last = px.is_finite().then_some(px);
            }
        }
        path
    }

    fn draw_limits(&self, svg: &mut Svg) {
        for limit in &self.chart.limits {
            let right = self.at(Point2::new(self.x.1, limit.value), Side::Left);
            let inside =
                (self.corner.y - 0.5..=self.corner.y + self.size.y + 0.5).contains(&right.y);
            if !inside {
                continue;
            }
            let left = Point2::new(self.corner.x, right.y);
            let line = Element::line(left, right).pen(palette::LIMIT, 1.4);
            svg.add(
                &line
                    .text("stroke-dasharray", "5 3")
                    .text("stroke-linecap", "butt"),
            );
            let low = right.y > self.corner.y + 0.5 * self.size.y;
            let base = right + Point2::new(-6.0, if low { 12.0 } else { -4.0 });
            LIMITS
                .anchored(Anchor::End)
                .write_with_halo(svg, base, &limit.label);
        }
    }
}
