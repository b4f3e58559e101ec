//! The base words of Reeds & Shepp 1990, sec. 8: which arcs lead to the goal, if any.
//!
//! Each function takes a view and its time flip, which share all lengths.

use super::view::{Link, View};
use crate::geometry::turning_circles::{
    SLACK, WordSink, arcs_around_line, inner_tangent, to_half_turn,
};
use std::f64::consts::{FRAC_PI_2, PI};

const LEFT: f64 = 1.0;
const STRAIGHT: f64 = 0.0;
const RIGHT: f64 = -1.0;

fn is_forward(length: f64) -> bool {
    length >= -SLACK
}

fn is_reverse(length: f64) -> bool {
    length <= SLACK
}

/// (8.1) L+ S+ L+.
pub(super) fn lsl(views: &[View; 2], sink: &mut impl WordSink) {
    let straight = views[0].same.distance;
    if straight + views[0].turn.abs() >= sink.bound() {
        return;
    }
    for view in views {
        let (first, last) = arcs_around_line(straight, view.same.direction, view.turn);
        if is_forward(first) && is_forward(last) {
            view.offer([(LEFT, first), (STRAIGHT, straight), (LEFT, last)], sink);
        }
    }
}

/// (8.2) L+ S+ R+.
pub(super) fn lsr(views: &[View; 2], sink: &mut impl WordSink) {
    let straight = inner_tangent(views[0].other.squared);
    if straight.is_nan() || straight + views[0].turn.abs() >= sink.bound() {
        return;
    }
    let tilt = 2_f64.atan2(straight);
    for view in views {
        let first = to_half_turn(view.other.direction + tilt);
        let last = to_half_turn(first - view.turn);
        if is_forward(first) && is_forward(last) {
            view.offer([(LEFT, first), (STRAIGHT, straight), (RIGHT, last)], sink);
        }
    }
}

/// (8.3) L+ R- L+ and (8.4) L+ R- L-; reversed the latter is L- R- L+.
pub(super) fn lrl(views: &[View; 2], sink: &mut impl WordSink) {
    let distance = views[0].same.distance;
    // On one and the same circle the middle arc vanishes and the word is (8.1) or a full circle.
    let meets = (SLACK..=4.0 + SLACK).contains(&distance);
    if !meets || 0.5 * distance >= sink.bound() {
        return;
    }
    let half_middle = (0.25 * distance).min(1.0).asin();
    let middle = 2.0 * half_middle;
    let ends = |view: &View| {
        let first = to_half_turn(view.same.direction - half_middle + PI);
        (first, to_half_turn(view.turn - first - middle))
    };
    for view in views {
        let (first, last) = ends(view);
        if is_forward(first) {
            view.offer([(LEFT, first), (RIGHT, -middle), (LEFT, last)], sink);
        }
        let (first, last) = ends(&view.reversed());
        if is_forward(first) && is_reverse(last) {
            view.offer_reversed([(LEFT, first), (RIGHT, -middle), (LEFT, last)], sink);
        }
    }
}

/// (8.7) L+ R+ L- R- and (8.8) L+ R- L- R+, with equal middle arcs.
pub(super) fn lrlr(views: &[View; 2], sink: &mut impl WordSink) {
    let Link {
        squared, distance, ..
    } = views[0].other;
    if distance <= 2.0 + SLACK {
        // The centers lie 2 (2 cos(middle) - 1) apart, in the direction first - middle - pi/2.
        let middle = (0.25 * (2.0 + distance)).min(1.0).acos();
        for view in views {
            let first = to_half_turn(view.other.direction + middle + FRAC_PI_2);
            let last = to_half_turn(first - 2.0 * middle - view.turn);
            if is_forward(first) && is_reverse(last) {
                let arcs = [(RIGHT, middle), (LEFT, -middle)];
                view.offer([(LEFT, first), arcs[0], arcs[1], (RIGHT, last)], sink);
            }
        }
    }
    let cos = (20.0 - squared) / 16.0;
    if (-SLACK..=1.0 + SLACK).contains(&cos) {
        // The vector between the centers is 2 (2 - e^(i middle)) turned by first - pi/2.
        let cos = cos.clamp(0.0, 1.0);
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        let (middle, lean) = (sin.atan2(cos), sin.atan2(2.0 - cos));
        if 2.0 * middle + views[0].turn.abs() >= sink.bound() {
            return;
        }
        for view in views {
            let first = to_half_turn(view.other.direction + FRAC_PI_2 + lean);
            let last = to_half_turn(first - view.turn);
            if is_forward(first) && is_forward(last) {
                let arcs = [(RIGHT, -middle), (LEFT, -middle)];
                view.offer([(LEFT, first), arcs[0], arcs[1], (RIGHT, last)], sink);
            }
        }
    }
}

/// (8.9) L+ R-(pi/2) S- L-, and reversed.
pub(super) fn lrsl(views: &[View; 2], sink: &mut impl WordSink) {
    let tangent = inner_tangent(views[0].same.squared);
    let straight = 2.0 - tangent;
    if !is_reverse(straight) || cannot_beat(straight, views[0].turn, sink) {
        return;
    }
    let tilt = 2_f64.atan2(tangent);
    let ends = |view: &View| {
        let first = to_half_turn(view.same.direction + FRAC_PI_2 + tilt);
        (first, to_half_turn(view.turn - FRAC_PI_2 - first))
    };
    for view in views {
        let word = |(first, last)| quarter_word(first, straight, (LEFT, last));
        let forward = ends(view);
        if is_forward(forward.0) && is_reverse(forward.1) {
            view.offer(word(forward), sink);
        }
        let backward = ends(&view.reversed());
        if is_forward(backward.0) && is_reverse(backward.1) {
            view.offer_reversed(word(backward), sink);
        }
    }
}

/// (8.10) L+ R-(pi/2) S- R-, and reversed.
pub(super) fn lrsr(views: &[View; 2], sink: &mut impl WordSink) {
    let ends = |view: &View| {
        let first = to_half_turn(view.other.direction + FRAC_PI_2);
        (first, to_half_turn(first + FRAC_PI_2 - view.turn))
    };
    let straight = 2.0 - views[0].other.distance;
    if is_reverse(straight) && !cannot_beat(straight, views[0].turn, sink) {
        for view in views {
            let (first, last) = ends(view);
            if is_forward(first) && is_reverse(last) {
                view.offer(quarter_word(first, straight, (RIGHT, last)), sink);
            }
        }
    }
    let straight = 2.0 - views[0].back.distance;
    if is_reverse(straight) && !cannot_beat(straight, views[0].turn, sink) {
        for view in views {
            let (first, last) = ends(&view.reversed());
            if is_forward(first) && is_reverse(last) {
                view.offer_reversed(quarter_word(first, straight, (RIGHT, last)), sink);
            }
        }
    }
}

/// (8.11) L+ R-(pi/2) S- L-(pi/2) R+.
pub(super) fn lrslr(views: &[View; 2], sink: &mut impl WordSink) {
    let tangent = inner_tangent(views[0].other.squared);
    let straight = 4.0 - tangent;
    if !is_reverse(straight) || PI - straight + views[0].turn.abs() >= sink.bound() {
        return;
    }
    let tilt = 2_f64.atan2(tangent);
    for view in views {
        let first = to_half_turn(view.other.direction + FRAC_PI_2 + tilt);
        let last = to_half_turn(first - view.turn);
        if is_forward(first) && is_forward(last) {
            let [l, r, s, _] = quarter_word(first, straight, (LEFT, 0.0));
            view.offer([l, r, s, (LEFT, -FRAC_PI_2), (RIGHT, last)], sink);
        }
    }
}

fn quarter_word(first: f64, straight: f64, last: (f64, f64)) -> [(f64, f64); 4] {
    [
        (LEFT, first),
        (RIGHT, -FRAC_PI_2),
        (STRAIGHT, straight),
        last,
    ]
}

/// True if the quarter circle, the line and the least turn that remains are too long already.
fn cannot_beat(straight: f64, turn: f64, sink: &impl WordSink) -> bool {
    // In the two gears the rest of the turn is |turn| - pi/2 at the least.
    FRAC_PI_2 - straight + (turn.abs() - FRAC_PI_2).abs() >= sink.bound()
}
