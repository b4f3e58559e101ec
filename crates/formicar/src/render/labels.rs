//! Labels on a map, each put where it hides least.

use super::lettering::Lettering;
use super::markup::Element;
use super::palette::{Color, PAGE};
use super::svg::Svg;
use crate::geometry::Point2;

const SIZE_PX: f64 = 15.0;
/// Directions in which a label may stand from its place: across, along, down.
const SIDES: [(f64, f64); 8] = [
    (1.0, -0.6),
    (-1.0, -0.6),
    (1.0, 0.6),
    (-1.0, 0.6),
    (0.0, -1.0),
    (0.0, 1.0),
    (1.0, 0.0),
    (-1.0, 0.0),
];

/// Names to be placed once everything else is known.
#[derive(Clone, Debug, Default)]
pub(super) struct Labels {
    busy: Vec<Point2>,
    names: Vec<Name>,
}

#[derive(Clone, Debug)]
struct Name {
    at: Point2,
    clear_px: f64,
    text: String,
    color: Color,
}

/// An upright box by its center and half sides.
#[derive(Clone, Copy)]
struct Area {
    center: Point2,
    half: Point2,
}

impl Area {
    fn covers(&self, point: Point2) -> bool {
        let d = point - self.center;
        d.x.abs() <= self.half.x && d.y.abs() <= self.half.y
    }

    fn meets(&self, other: &Self) -> bool {
        let half = self.half + other.half;
        Self { half, ..*self }.covers(other.center)
    }

    fn leaves(&self, panel: Point2) -> bool {
        let (low, high) = (self.center - self.half, self.center + self.half);
        low.x < 0.0 || low.y < 0.0 || high.x > panel.x || high.y > panel.y
    }
}

impl Labels {
    /// A point that labels should not hide.
    pub(super) fn keep_clear(&mut self, point: Point2) {
        self.busy.push(point);
    }

    /// A text beside a place, at least `clear_px` off.
    pub(super) fn name(&mut self, at: Point2, clear_px: f64, text: &str, color: Color) {
        let text = text.to_owned();
        self.names.push(Name {
            at,
            clear_px,
            text,
            color,
        });
    }

    /// Writes all labels into a panel.
    pub(super) fn draw(&self, svg: &mut Svg, panel: Point2) {
        let rings = self.names.iter().map(|name| Area {
            center: name.at,
            half: Point2::new(name.clear_px, name.clear_px) * 0.8,
        });
        let mut taken: Vec<Area> = rings.collect();
        for name in &self.names {
            let style = Lettering::new(SIZE_PX, name.color).bold();
            let half = Point2::new(0.5 * style.width_px(&name.text) + 4.0, 0.5 * SIZE_PX + 2.0);
            let candidates = [1.0, 2.0, 3.5].into_iter().flat_map(|far| {
                SIDES.map(|(x, y)| {
                    let reach =
                        Point2::new(name.clear_px * far + half.x, name.clear_px * far + half.y);
                    let center = name.at + Point2::new(reach.x * x, reach.y * y);
                    (far, Area { center, half })
                })
            });
            let cost = |(far, area): &(f64, Area)| {
                let hidden = self.busy.iter().filter(|p| area.covers(**p)).count() as f64;
                let met = taken.iter().filter(|other| area.meets(other)).count() as f64;
                2.0 * hidden + 50.0 * met + 1000.0 * f64::from(area.leaves(panel)) + 3.0 * far
            };
            let best = candidates.min_by(|a, b| cost(a).total_cmp(&cost(b)));
            if let Some((_, area)) = best {
                // A plate, since ground may be as dark as the letters.
                let plate = Element::rectangle(area.center - half, half * 2.0)
                    .number("rx", 4.0)
                    .fill(PAGE)
                    .text("fill-opacity", "0.86");
                svg.add(&plate);
                let base =
                    Point2::new(area.center.x - half.x + 4.0, area.center.y + 0.35 * SIZE_PX);
                style.write(svg, base, &name.text);
                taken.push(area);
            }
        }
    }
}
