//! Errors of smoothing.

use super::config::Corners;
use crate::parameters::OutOfRange;
use crate::scenario::Endpoint;
use thiserror::Error;

/// The reason why a polyline cannot be made drivable, or an invalid request.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SmoothingError {
    /// A parameter outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// A path without nodes.
    #[error("the path has no nodes; at least 1 is needed")]
    NoNodes,
    /// A corner that cannot be rounded.
    #[error("corner {number} at ({x:.2}, {y:.2}) m turns by {turn_deg:.0} deg: {problem}{}", no_curve(*corners))]
    Corner {
        /// Number of the corner, from 1.
        number: usize,
        /// World coordinate, meters.
        x: f64,
        /// World coordinate, meters.
        y: f64,
        /// Turn of the polyline there, degrees, positive left.
        turn_deg: f64,
        /// The reason why no 2-turning fits.
        problem: CornerProblem,
        /// The kinds of curves that were tried.
        corners: Corners,
    },
    /// A straight piece that the body cannot drive.
    #[error("on the straight way from ({x:.2}, {y:.2}) m on the body touches obstacles{}", no_curve(*corners))]
    Straight {
        /// World coordinate, meters.
        x: f64,
        /// World coordinate, meters.
        y: f64,
        /// The kinds of curves that were tried.
        corners: Corners,
    },
    /// A heading that no free curve joins to the polyline.
    #[error(
        "no free curve joins the {which}'s heading to the way within {reach_m:.1} m of it; hint: leave the heading free, or raise reach_radii"
    )]
    Heading {
        /// Start or goal.
        which: Endpoint,
        /// Length of the polyline that was tried, meters.
        reach_m: f64,
    },
    /// Start and goal are the same place, where the body does not fit.
    #[error("the body does not fit at the start, which is the goal")]
    NoRoom,
    /// The caller ended it: deadline or cancel.
    #[error("smoothing was stopped")]
    Stopped,
}

/// The reason why no 2-turning rounds a corner.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CornerProblem {
    /// A segment is too short for every member.
    #[error(
        "2-turning needs at least {needs_m:.3} m of the segment {side} it, which has {has_m:.3} m"
    )]
    TooShort {
        /// Length that the member nearest to fitting takes, meters.
        needs_m: f64,
        /// Length of the segment, meters.
        has_m: f64,
        /// "before" or "after".
        side: &'static str,
    },
    /// Every member that fits the segments collides.
    #[error("every 2-turning touches obstacles, by {depth_m:.3} m where it nearly fits")]
    Touches {
        /// Deepest overlap of the member that looks freest, meters.
        depth_m: f64,
    },
    /// The turn at the corner before ends too late.
    #[error(
        "2-turning needs at least {needs_m:.3} m of the segment before it, of which the turn before leaves {has_m:.3} m"
    )]
    Crowded {
        /// Length that the shortest free member takes, meters.
        needs_m: f64,
        /// Length that is left of the segment, meters.
        has_m: f64,
    },
    /// The path goes back the way it came.
    #[error("no forward turn of finite length does that")]
    TurnsBack,
}

fn no_curve(corners: Corners) -> &'static str {
    match corners {
        Corners::TwoTurning | Corners::BSpline => "",
        Corners::TwoTurningOrDubins | Corners::WideArcs => ", and no curve past it is free",
    }
}
