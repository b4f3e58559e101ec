//! The goal as the base words see it under each symmetry.

use crate::geometry::turning_circles::{WordSink, to_half_turn};
use crate::geometry::{Curve, Point2};
use std::f64::consts::PI;

/// The vector between the centers of two turning circles.
#[derive(Clone, Copy)]
pub(super) struct Link {
    pub(super) squared: f64,
    pub(super) distance: f64,
    pub(super) direction: f64,
}

impl Link {
    pub(super) fn between(vector: Point2) -> Self {
        let squared = vector.dot(vector);
        Self {
            squared,
            distance: squared.sqrt(),
            direction: vector.angle(),
        }
    }

    /// Seen with left and right swapped.
    pub(super) fn mirrored(self) -> Self {
        self.towards(-self.direction)
    }

    fn towards(self, direction: f64) -> Self {
        let direction = to_half_turn(direction);
        Self { direction, ..self }
    }
}

/// The goal seen so that the word begins with a left arc driven forward.
#[derive(Clone, Copy)]
pub(super) struct View {
    pub(super) radius_m: f64,
    /// +1 as it is, -1 with left and right swapped.
    pub(super) side: f64,
    /// +1 as it is, -1 with the gears swapped.
    pub(super) gear: f64,
    pub(super) turn: f64,
    /// From the first left to the last left circle.
    pub(super) same: Link,
    /// From the first left to the last right circle.
    pub(super) other: Link,
    /// From the first right to the last left circle: `other` of the reversed word.
    pub(super) back: Link,
}

impl View {
    /// With forward and reverse swapped, which mirrors the plane at the start's axle.
    pub(super) fn time_flipped(self) -> Self {
        let flipped = |link: Link| link.towards(PI - link.direction);
        Self {
            gear: -self.gear,
            turn: to_half_turn(-self.turn),
            same: flipped(self.same),
            other: flipped(self.other),
            back: flipped(self.back),
            ..self
        }
    }

    /// The start seen from the goal with the gears swapped: its words, read from the end, are
    /// words of this view. It has no reversal of its own.
    pub(super) fn reversed(&self) -> Self {
        Self {
            same: self.same.towards(self.turn - self.same.direction),
            other: self.back.towards(self.turn - self.back.direction),
            ..*self
        }
    }

    pub(super) fn offer<const N: usize>(&self, word: [(f64, f64); N], sink: &mut impl WordSink) {
        let length = word.iter().map(|step| step.1.abs()).sum();
        sink.offer(length, || {
            Curve::of_word(self.radius_m, self.steps(word).into_iter())
        });
    }

    pub(super) fn offer_reversed<const N: usize>(
        &self,
        word: [(f64, f64); N],
        sink: &mut impl WordSink,
    ) {
        let length = word.iter().map(|step| step.1.abs()).sum();
        sink.offer(length, || {
            Curve::of_word(self.radius_m, self.steps(word).into_iter().rev())
        });
    }

    fn steps<const N: usize>(&self, word: [(f64, f64); N]) -> [(f64, f64); N] {
        word.map(|(side, length)| (side * self.side, length * self.gear))
    }
}
