//! A chart on the page: its size, and its lines, ribbons, dots and limits.

use super::plot::Plot;
use super::{Chart, DotFill, Dots, Limit, Ribbon, Series, Side, boxes};
use crate::geometry::Point2;
use crate::render::legend::{Legend, Swatch};
use crate::render::lettering::{Anchor, Lettering};
use crate::render::markup::Element;
use crate::render::palette;
use crate::render::style::{Dash, LEFT_PX};
use crate::render::svg::{PathData, Svg};

const RIGHT_AXIS_PX: f64 = 44.0;
const HEAD_PX: f64 = 24.0;
const BELOW_PX: f64 = 8.0;
const BELOW_WITH_NUMBERS_PX: f64 = 42.0;
const USUAL_HEIGHT_PX: f64 = 100.0;

const LIMITS: Lettering = Lettering::new(11.5, palette::LIMIT);

impl Chart {
    /// Height on the page at a width, with headings, axes and legend.
    pub(in crate::render) fn full_height_px(&self, width_px: f64) -> f64 {
        let legend_px = match self.legend() {
            legend if legend.is_empty() => 0.0,
            legend => legend.height_px(self.plot_width_px(width_px), 0.0),
        };
        self.height_without_legend_px() + legend_px
    }

    /// Draws the chart with its upper left corner at a point of the page.
    pub(in crate::render) fn draw(&self, svg: &mut Svg, at: Point2, width_px: f64) {
        self.draw_without_legend(svg, at, width_px);
        let legend = self.legend();
        if !legend.is_empty() {
            let below = Point2::new(self.left_px(), self.height_without_legend_px());
            legend.draw(svg, at + below, self.plot_width_px(width_px), 0.0);
        }
    }

    /// Height on the page, with headings and axes.
    pub(super) fn height_without_legend_px(&self) -> f64 {
        HEAD_PX + self.plot_height_px() + self.below_px()
    }

    /// Draws the chart but for its legend.
    pub(super) fn draw_without_legend(&self, svg: &mut Svg, at: Point2, width_px: f64) {
        let plot = Plot {
            chart: self,
            corner: at + Point2::new(self.left_px(), HEAD_PX),
            size: Point2::new(self.plot_width_px(width_px), self.plot_height_px()),
            x: self.x_scale(),
            left: self.y_scale(Side::Left),
            right: self.y_scale(Side::Right),
        };
        plot.draw_head(svg);
        plot.draw_grid(svg);
        plot.draw_boxes(svg);
        plot.draw_data(svg);
        plot.draw_limits(svg);
    }

    /// Room left of the plot area.
    pub(super) fn left_px(&self) -> f64 {
        if self.boxes.is_empty() {
            LEFT_PX
        } else {
            boxes::names_px(&self.boxes)
        }
    }

    fn plot_width_px(&self, width_px: f64) -> f64 {
        let right_px = self.y_right.as_ref().map_or(0.0, |_| RIGHT_AXIS_PX);
        (width_px - self.left_px() - right_px).max(40.0)
    }

    fn plot_height_px(&self) -> f64 {
        match self.boxes.len() {
            _ if self.height_px > 0.0 => self.height_px,
            0 => USUAL_HEIGHT_PX,
            n_rows => boxes::height_px(n_rows),
        }
    }

    fn below_px(&self) -> f64 {
        if self.x.label.is_empty() {
            BELOW_PX
        } else {
            BELOW_WITH_NUMBERS_PX
        }
    }

    fn legend(&self) -> Legend {
        let mut legend = Legend::default();
        self.name_series(&mut legend);
        legend
    }

    /// Adds the names of lines and ribbons to a legend.
    pub(super) fn name_series(&self, legend: &mut Legend) {
        for series in &self.series {
            legend.add(&series.label, Swatch::Line(series.color, series.dash));
        }
        for ribbon in &self.ribbons {
            legend.add(&ribbon.label, Swatch::Area(ribbon.color));
        }
    }
}

impl Plot<'_> {
    fn at(&self, point: Point2, side: Side) -> Point2 {
        let y = match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        };
        Point2::new(self.x_px(point.x), self.y_px(point.y, y))
    }

    fn draw_data(&self, svg: &mut Svg) {
        let mut inner = Svg::default();
        // The clipping document has its own origin.
        let local = Plot {
            corner: Point2::default(),
            ..*self
        };
        for ribbon in &self.chart.ribbons {
            inner.add(&local.ribbon(ribbon));
        }
        for series in &self.chart.series {
            let line = Element::path(local.line(series)).pen(series.color, 1.8);
            inner.add(&line.dashed(series.dash));
        }
        svg.wrap(
            &Element::rectangle(self.corner, self.size).rename("svg"),
            &inner,
        );
        for dots in &self.chart.dots {
            self.draw_dots(svg, dots);
        }
        if let Some((point, words)) = &self.chart.ringed {
            self.draw_ringed(svg, *point, words);
        }
    }

    fn ribbon(&self, ribbon: &Ribbon) -> Element {
        let points = ribbon.points.iter();
        let finite = points.filter(|p| p.iter().all(|v| v.is_finite()));
        let low = finite.clone().map(|p| Point2::new(p[0], p[1]));
        let high = finite.rev().map(|p| Point2::new(p[0], p[2]));
        let mut outline = PathData::default();
        outline.polygon(low.chain(high).map(|p| self.at(p, Side::Left)));
        let area = Element::path(outline).fill(ribbon.color);
        area.text("fill-opacity", "0.22")
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

    /// Draws the dots whose centers are within the frame, whole.
    fn draw_dots(&self, svg: &mut Svg, dots: &Dots) {
        let fill = match dots.fill {
            DotFill::Solid => dots.color,
            DotFill::Hollow => palette::PAGE,
        };
        let end = self.corner + self.size;
        for &point in &dots.points {
            let center = self.at(point, Side::Left);
            let is_inside = (self.corner.x..=end.x).contains(&center.x)
                && (self.corner.y..=end.y).contains(&center.y);
            if !is_inside {
                continue;
            }
            if let Some(foot) = dots.stem_from {
                let foot = self.at(Point2::new(point.x, foot), Side::Left);
                svg.add(&Element::line(foot, center).pen(dots.color, 1.0));
            }
            let dot = Element::circle(center, dots.radius_px).fill(fill);
            svg.add(&dot.pen(dots.color, 1.2));
        }
    }

    fn draw_ringed(&self, svg: &mut Svg, point: Point2, words: &str) {
        let at = self.at(point, Side::Left);
        svg.add(&Element::circle(at, 5.0).pen(palette::LIMIT, 2.0));
        let (anchor, x) = if at.x > self.corner.x + 0.8 * self.size.x {
            (Anchor::End, -10.0)
        } else {
            (Anchor::Start, 10.0)
        };
        let above = at.y > self.corner.y + 0.5 * self.size.y;
        let base = at + Point2::new(x, if above { -7.0 } else { 14.0 });
        let style = LIMITS.bold().anchored(anchor);
        style.write_with_halo(svg, base, words);
    }

    fn draw_limits(&self, svg: &mut Svg) {
        for limit in &self.chart.limits {
            let right = Point2::new(
                self.corner.x + self.size.x,
                self.y_px(limit.value, &self.left),
            );
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
        if let Some(reference) = &self.chart.reference {
            self.draw_reference(svg, reference);
        }
    }

    /// A line over the whole height, named above the frame.
    fn draw_reference(&self, svg: &mut Svg, reference: &Limit) {
        let head = Point2::new(self.x_px(reference.value), self.corner.y);
        let line = Element::line(head, head + Point2::new(0.0, self.size.y));
        svg.add(&line.pen(palette::REVERSE, 1.3).dashed(Dash::Dashed));
        let anchor = if head.x > self.corner.x + 0.5 * self.size.x {
            Anchor::End
        } else {
            Anchor::Start
        };
        let style = Lettering::new(12.0, palette::REVERSE).anchored(anchor);
        style.write(svg, head - Point2::new(0.0, 6.0), &reference.label);
    }
}
