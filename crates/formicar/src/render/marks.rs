//! Marks of motion on a map: drivable paths, swept ground, poses, and the tightest place.

use super::Scene;
use super::legend::{Dot, Swatch};
use super::markup::Element;
use super::palette::{self, Color};
use super::style::{Dash, PoseMark, clearance_label};
use super::svg::PathData;
use super::view::View;
use crate::geometry::{Point2, Pose2};
use crate::path::{CurvePath, CurveSegment, Direction, PathPose};
use crate::vehicle::{Motion, Vehicle};

/// Most samples of a path, whatever its length.
const MAX_SAMPLES: f64 = 3000.0;
/// Outlines of vehicles shorter than this are not drawn along the path.
const MIN_OUTLINE_PX: f64 = 9.0;
/// Arrows of poses are at least this long, and so stand out ahead of small vehicles.
const MIN_ARROW_PX: f64 = 32.0;

/// Most that the end of an arc drawn for a part of a clothoid is off, pixels.
const CLOTHOID_GAP_PX: f64 = 0.1;

/// Radius of the ring around the tightest place.
const RING_PX: f64 = 12.0;

impl Scene {
    /// A drivable path as true arcs: solid forward, dashed in reverse, a dot at each change.
    /// Clothoids are drawn as arcs that end within a tenth of a pixel of them.
    pub fn curve(&mut self, path: &CurvePath) -> &mut Self {
        let path = &path.with_arcs(CLOTHOID_GAP_PX / self.view.px_per_m());
        let gears = || path.segments().chunk_by(|a, b| a.direction == b.direction);
        for gear in gears() {
            let casing = Element::path(self.arcs(gear)).pen(palette::PAGE, 5.0);
            self.body.add(&casing.text("stroke-opacity", "0.8"));
        }
        // Reverse on top: where a way is driven twice, the line below shows between the dashes.
        for (direction, label, dash) in [
            (Direction::Forward, "forward", Dash::Solid),
            (Direction::Reverse, "reverse", Dash::Dashed),
        ] {
            let color = gear_color(direction);
            for gear in gears().filter(|gear| gear[0].direction == direction) {
                let line = Element::path(self.arcs(gear)).pen(color, 2.6);
                self.body.add(&line.dashed(dash));
                self.legend.add(label, Swatch::Line(color, dash));
            }
        }
        for pair in path.segments().windows(2) {
            if pair[0].direction != pair[1].direction {
                let dot = Dot {
                    fill: palette::PAGE,
                    pen: palette::INK,
                    radius_px: 3.4,
                };
                let at = self.view.to_px(pair[1].start.position());
                self.body.add(&dot.at(at));
                self.legend.add("change of gear", Swatch::Dot(dot));
            }
        }
        for pose in self.samples(path, 6.0) {
            self.labels.keep_clear(self.view.to_px(pose.position()));
        }
        self
    }

    /// The ground that a vehicle sweeps along a path, with its outline every so often.
    pub fn swept(&mut self, path: &CurvePath, vehicle: &Vehicle) -> &mut Self {
        let (low, high) = vehicle.footprint().bounds();
        let length_px = (high.x - low.x) * self.view.px_per_m();
        if vehicle.motion() == Motion::Point || length_px < 1.0 {
            return self;
        }
        let ground = self.footprints(
            vehicle,
            &self.samples(path, (0.12 * length_px).clamp(1.0, 2.0)),
        );
        let ground = Element::path(ground).fill(palette::SWEPT);
        self.body.add(&ground.text("fill-opacity", "0.22"));
        if length_px >= MIN_OUTLINE_PX {
            let places = self.samples(path, (1.25 * length_px).max(24.0));
            let outlines = Element::path(self.footprints(vehicle, &places));
            let outlines = outlines.pen(palette::SWEPT.mix(palette::INK, 0.35), 0.8);
            self.body.add(&outlines.text("stroke-opacity", "0.7"));
        }
        self.legend
            .add("swept ground", Swatch::Area(palette::SWEPT));
        self
    }

    /// A vehicle at an end of the path, with an arrow along its heading.
    pub fn pose(&mut self, pose: Pose2, vehicle: &Vehicle, mark: PoseMark) -> &mut Self {
        let (color, name) = mark.look();
        let at = self.view.to_px(pose.position());
        let (_, high) = vehicle.footprint().bounds();
        let front_px = high.x * self.view.px_per_m();
        let width_px = if front_px < MIN_ARROW_PX { 1.0 } else { 2.0 };
        let body = Element::path(self.footprints(vehicle, &[pose])).fill(color);
        let body = body.text("fill-opacity", "0.2").pen(color, width_px);
        self.body.add(&body);
        let reach_px = front_px.max(MIN_ARROW_PX);
        if vehicle.motion() == Motion::Car {
            self.arrow(at, View::direction(pose.heading), reach_px, color);
        }
        self.end(pose.position(), mark);
        for (a, b) in vehicle.footprint().placed(pose).edges() {
            for i in 0..8 {
                let place = a.lerp(b, f64::from(i) / 8.0);
                self.labels.keep_clear(self.view.to_px(place));
            }
        }
        if self.view.shows(at) {
            self.labels.name(at, 12.0, name, color);
        }
        self
    }

    /// What moves, at a moment: a polygon, or a disc about one point, with a label beside it.
    pub fn moving_obstacle(&mut self, corners: &[Point2], radius_m: f64, label: &str) -> &mut Self {
        let swatch = Swatch::Area(palette::LIMIT);
        self.legend.add("moving obstacle", swatch);
        self.ghost(corners, radius_m, palette::LIMIT, label)
    }

    /// The vehicle at a moment, with a label beside it.
    pub fn vehicle_at(&mut self, pose: Pose2, vehicle: &Vehicle, label: &str) -> &mut Self {
        let swatch = Swatch::Area(palette::FORWARD);
        self.legend.add("vehicle at a time", swatch);
        for part in vehicle.parts() {
            let corners = part.placed(pose);
            self.ghost(corners.corners(), 0.0, palette::FORWARD, label);
        }
        self
    }

    /// A shaded polygon, or a disc about one point, with a label beside it.
    pub fn ghost(
        &mut self,
        corners: &[Point2],
        radius_m: f64,
        color: Color,
        label: &str,
    ) -> &mut Self {
        let px: Vec<_> = corners.iter().map(|&p| self.view.to_px(p)).collect();
        let middle = px.iter().fold(Point2::default(), |sum, &p| sum + p);
        let middle = middle * (1.0 / px.len().max(1) as f64);
        if px.is_empty() || !self.view.shows(middle) {
            return self;
        }
        let radius_px = radius_m * self.view.px_per_m();
        let shape = if let [center] = px[..] {
            Element::circle(center, radius_px.max(1.0))
        } else {
            let mut outline = PathData::default();
            outline.polygon(px.iter().copied());
            Element::path(outline)
        };
        let shape = shape.fill(color).text("fill-opacity", "0.14");
        self.body
            .add(&shape.pen(color, 1.0).text("stroke-opacity", "0.75"));
        if !label.is_empty() {
            let reach_px = px
                .iter()
                .map(|p| p.distance(middle))
                .fold(radius_px, f64::max);
            self.labels.name(middle, 0.5 * reach_px, label, color);
        }
        self
    }

    /// A point with its name beside it.
    pub fn point(&mut self, place: Point2, name: &str) -> &mut Self {
        let at = self.view.to_px(place);
        if self.view.shows(at) {
            let dot = Element::circle(at, 4.0).fill(palette::PAGE);
            self.body.add(&dot.pen(palette::INK, 1.8));
            self.labels.name(at, 9.0, name, palette::INK);
        }
        self
    }

    /// Marks an end of the path by a dot alone: filled where the vehicle stands, a ring where it
    /// should go.
    pub(super) fn end(&mut self, place: Point2, mark: PoseMark) -> &mut Self {
        let (at, (color, _)) = (self.view.to_px(place), mark.look());
        self.body.add(&match mark {
            PoseMark::Start => Element::circle(at, 4.5).fill(color),
            PoseMark::Goal => {
                let ring = Element::circle(at, 4.0).fill(palette::PAGE);
                ring.pen(color, 2.4)
            }
        });
        self
    }

    /// Rings a place and writes its clearance.
    pub fn tightest(&mut self, place: Point2, clearance_m: f64) -> &mut Self {
        self.ring(place, &clearance_label(clearance_m), "tightest place")
    }

    /// Rings a gap and writes its width.
    pub fn gap(&mut self, place: Point2, gap_m: f64) -> &mut Self {
        self.ring(place, &format!("{gap_m:.2} m wide"), "narrowest place")
    }

    fn ring(&mut self, place: Point2, label: &str, name: &str) -> &mut Self {
        let at = self.view.to_px(place);
        if !self.view.shows(at) {
            return self;
        }
        // At the border of the panel the ring stays whole.
        let (panel, room) = (self.view.size_px(), RING_PX + 2.0);
        let at = Point2::new(
            at.x.clamp(room, panel.x - room),
            at.y.clamp(room, panel.y - room),
        );
        let casing = Element::circle(at, RING_PX).pen(palette::PAGE, 5.0);
        self.body.add(&casing.text("stroke-opacity", "0.85"));
        self.body
            .add(&Element::circle(at, RING_PX).pen(palette::LIMIT, 2.4));
        self.labels.name(at, RING_PX + 5.0, label, palette::LIMIT);
        self.legend.add(name, Swatch::Ring);
        self
    }

    /// The outlines of the vehicle at those poses where the panel may show it.
    fn footprints(&self, vehicle: &Vehicle, poses: &[Pose2]) -> PathData {
        let mut path = PathData::default();
        let (low, high) = self.view.bounds();
        let reach = vehicle.footprint().circumradius();
        let seen = |p: &&Pose2| {
            let (x, y) = (
                low.x - reach..=high.x + reach,
                low.y - reach..=high.y + reach,
            );
            x.contains(&p.x) && y.contains(&p.y) && p.heading.is_finite()
        };
        for &pose in poses.iter().filter(seen) {
            for part in vehicle.parts() {
                let placed = part.placed(pose);
                path.polygon(placed.corners().iter().map(|&p| self.view.to_px(p)));
            }
        }
        path
    }

    /// Poses along a path, about as many pixels apart, and its last one.
    fn samples(&self, path: &CurvePath, spacing_px: f64) -> Vec<Pose2> {
        // Nobody has checked the lengths: taken by size, they bound the samples of each segment.
        let length_m: f64 = path.segments().iter().map(|s| s.length_m.abs()).sum();
        if !length_m.is_finite() {
            return Vec::new();
        }
        let spacing_m = (spacing_px / self.view.px_per_m()).max(length_m / MAX_SAMPLES);
        let path = path.with_arcs(CLOTHOID_GAP_PX / self.view.px_per_m());
        thinned(&path.sample(spacing_m), spacing_m)
    }

    fn arcs(&self, segments: &[CurveSegment]) -> PathData {
        let mut path = PathData::default();
        let mut passed_px = 0.0;
        for (i, segment) in segments.iter().enumerate() {
            let start = self.view.to_px(segment.start.position());
            // Of arcs shorter than a pixel chords are drawn, a pixel long.
            let length_px = self.view.px_per_m() * segment.length_m;
            if i > 0 && i + 1 < segments.len() && length_px < 1.0 {
                passed_px += length_px;
                if passed_px >= 1.0 {
                    path.line_to(start);
                    passed_px = 0.0;
                }
                continue;
            }
            path.line_to(start);
            let turn = segment.curvature_per_m * segment.length_m;
            let radius_px = self.view.px_per_m() / segment.curvature_per_m.abs();
            // SVG arcs of less than half a turn are unambiguous; beyond 32 of them all is black.
            let n_arcs = (turn.abs() / 2.0).ceil().clamp(1.0, 32.0);
            for i in 1..=n_arcs as u32 {
                let driven_m = segment.length_m * f64::from(i) / n_arcs;
                let end = self.view.to_px(segment.pose_at(driven_m).position());
                if radius_px > 1e5 {
                    path.line_to(end);
                } else {
                    path.arc_to(radius_px, -turn * segment.direction.sign(), end);
                }
            }
        }
        path
    }

    fn arrow(&mut self, from: Point2, along: Point2, length_px: f64, color: Color) {
        let tip = from + along * length_px;
        let side = along.perpendicular() * 4.5;
        let neck = tip - along * 10.0;
        self.body.add(&Element::line(from, neck).pen(color, 2.4));
        let mut head = PathData::default();
        head.polygon([tip, neck + side, neck - side]);
        let head = Element::path(head).fill(color);
        self.body.add(&head.pen(palette::PAGE, 0.8));
        for i in 0..=4 {
            self.labels.keep_clear(from.lerp(tip, f64::from(i) / 4.0));
        }
    }
}

/// The poses without those whose neighbors are within a spacing: segments may be short.
fn thinned(samples: &[PathPose], spacing_m: f64) -> Vec<Pose2> {
    let mut kept_m = f64::NEG_INFINITY;
    let mut poses = Vec::new();
    for (i, sample) in samples.iter().enumerate() {
        let next_m = samples.get(i + 1).map_or(f64::INFINITY, |next| next.s_m);
        if next_m - kept_m > spacing_m * (1.0 + 1e-9) {
            poses.push(sample.pose);
            kept_m = sample.s_m;
        }
    }
    poses
}

impl PoseMark {
    /// Color and name.
    fn look(self) -> (Color, &'static str) {
        match self {
            Self::Start => (palette::START, "start"),
            Self::Goal => (palette::GOAL, "goal"),
        }
    }
}

pub(super) fn gear_color(direction: Direction) -> Color {
    match direction {
        Direction::Forward => palette::FORWARD,
        Direction::Reverse => palette::REVERSE,
    }
}
