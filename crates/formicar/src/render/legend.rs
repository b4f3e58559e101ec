//! The row under a scene: scale bar, then what each mark means.

use super::lettering::{Anchor, Lettering};
use super::markup::Element;
use super::palette::{self, Color};
use super::style::Dash;
use super::svg::Svg;
use super::ticks;
use crate::geometry::Point2;

const TEXT: Lettering = Lettering::new(13.0, palette::INK);
const LINE_PX: f64 = 24.0;
const SWATCH_PX: f64 = 26.0;
const GAP_PX: f64 = 20.0;
const HEAT_PX: f64 = 110.0;

/// The look of a mark in the legend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Swatch {
    Cell(Color),
    Area(Color),
    Line(Color, Dash),
    Heat { low: f64, high: f64 },
    Dot(Dot),
    Ring,
}

/// A small disc with an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dot {
    pub(super) fill: Color,
    pub(super) pen: Color,
    pub(super) radius_px: f64,
}

impl Dot {
    pub(super) fn at(self, center: Point2) -> Element {
        let disc = Element::circle(center, self.radius_px);
        disc.fill(self.fill).pen(self.pen, 1.6)
    }
}

/// Marks and their names, each once, in the order of their first use.
#[derive(Clone, Debug, Default)]
pub(super) struct Legend {
    entries: Vec<(String, Swatch)>,
}

impl Legend {
    pub(super) fn add(&mut self, label: &str, swatch: Swatch) {
        if !label.is_empty() && self.entries.iter().all(|(known, _)| known != label) {
            self.entries.push((label.to_owned(), swatch));
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The height it needs at a width, the first line starting `indent_px` further right.
    pub(super) fn height_px(&self, width_px: f64, indent_px: f64) -> f64 {
        let places = self.places(width_px, indent_px);
        places.last().map_or(LINE_PX, |last| last.y + LINE_PX)
    }

    /// Draws it with its upper left corner at a point.
    pub(super) fn draw(&self, svg: &mut Svg, at: Point2, width_px: f64, indent_px: f64) {
        let places = self.places(width_px, indent_px);
        for ((label, swatch), place) in self.entries.iter().zip(places) {
            let middle = at + place + Point2::new(0.0, 0.5 * LINE_PX);
            swatch.draw(svg, middle);
            let text = middle + Point2::new(swatch.width_px() + 7.0, 4.6);
            TEXT.write(svg, text, label);
        }
    }

    /// Upper left corners of the entries, flowing over lines.
    fn places(&self, width_px: f64, indent_px: f64) -> Vec<Point2> {
        let mut next = Point2::new(indent_px, 0.0);
        let mut places = Vec::new();
        for (label, swatch) in &self.entries {
            let entry_px = swatch.width_px() + 7.0 + TEXT.width_px(label);
            if next.x + entry_px > width_px && next.x > 0.0 {
                next = Point2::new(0.0, next.y + LINE_PX);
            }
            places.push(next);
            next.x += entry_px + GAP_PX;
        }
        places
    }
}

impl Swatch {
    fn width_px(self) -> f64 {
        match self {
            Self::Cell(_) | Self::Ring | Self::Dot(_) => 14.0,
            Self::Area(_) | Self::Line(..) => SWATCH_PX,
            Self::Heat { .. } => HEAT_PX,
        }
    }

    fn draw(self, svg: &mut Svg, left: Point2) {
        let center = left + Point2::new(7.0, 0.0);
        let upright = |width: f64, height: f64| {
            let low = left - Point2::new(0.0, 0.5 * height);
            Element::rectangle(low, Point2::new(width, height))
        };
        match self {
            Self::Cell(color) => svg.add(&upright(13.0, 13.0).fill(color).pen(palette::RULE, 0.8)),
            Self::Area(color) => {
                let area = upright(SWATCH_PX, 12.0).fill(color).pen(color, 0.8);
                svg.add(&area.text("fill-opacity", "0.25"));
            }
            Self::Line(color, dash) => {
                let line = Element::line(left, left + Point2::new(SWATCH_PX, 0.0)).pen(color, 2.6);
                svg.add(&line.dashed(dash));
            }
            Self::Dot(dot) => svg.add(&dot.at(center)),
            Self::Ring => svg.add(&Element::circle(center, 6.5).pen(palette::LIMIT, 2.2)),
            Self::Heat { low, high } => draw_heat(svg, left, (low, high)),
        }
    }
}

fn draw_heat(svg: &mut Svg, left: Point2, (low, high): (f64, f64)) {
    let n_steps = 22;
    let step_px = HEAT_PX / f64::from(n_steps);
    for i in 0..n_steps {
        let corner = left + Point2::new(f64::from(i) * step_px, -6.5);
        let step = Element::rectangle(corner, Point2::new(step_px + 0.3, 13.0));
        svg.add(&step.fill(palette::heat(f64::from(i) / f64::from(n_steps - 1))));
    }
    let base = left + Point2::new(4.0, 4.0);
    Lettering::new(11.0, palette::INK).write(svg, base, &short(low));
    let end = Lettering::new(11.0, palette::PAGE).anchored(Anchor::End);
    end.write(svg, base + Point2::new(HEAT_PX - 8.0, 0.0), &short(high));
}

/// A number with three digits.
fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    ticks::label(
        value,
        10_f64.powf(value.abs().log10().floor() - 2.0).min(1.0),
    )
}

/// Draws a bar of a round length, about a ninth of the panel, and returns the width it took.
pub(super) fn scale_bar(svg: &mut Svg, at: Point2, panel_px: f64, px_per_m: f64) -> f64 {
    let length_m = ticks::round_step(panel_px / px_per_m, 9.0);
    let length_px = length_m * px_per_m;
    if !(length_px.is_finite() && length_px < panel_px) {
        return 0.0;
    }
    let middle = at + Point2::new(0.5, 0.5 * LINE_PX);
    let end = middle + Point2::new(length_px, 0.0);
    svg.add(&Element::line(middle, end).pen(palette::INK, 2.0));
    for tick in [middle, end] {
        let half = Point2::new(0.0, 4.0);
        svg.add(&Element::line(tick - half, tick + half).pen(palette::INK, 2.0));
    }
    let label = ticks::length_label(length_m);
    TEXT.write(svg, end + Point2::new(8.0, 4.6), &label);
    length_px + 8.0 + TEXT.width_px(&label) + 28.0
}
