//! Why a polyline does not become a drivable curve.

use super::config::Corners;
use crate::numeric::OutOfRange;
use crate::scenario::Endpoint;
use thiserror::Error;

/// What keeps a polyline from becoming drivable, or what is wrong with the question.
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
        /// Which corner, counted from 1.
        number: usize,
        /// World coordinate, metres.
        x: f64,
        /// World coordinate, metres.
        y: f64,
        /// How far the polyline turns there, degrees, positive left.
        turn_deg: f64,
        /// Why no 2-turning fits.
        problem: CornerProblem,
        /// What was tried.
        corners: Corners,
    },
    /// A straight piece that the body cannot drive.
    #[error("on the straight way from ({x:.2}, {y:.2}) m on the body touches obstacles{}", no_curve(*corners))]
    Straight {
        /// World coordinate, metres.
        x: f64,
        /// World coordinate, metres.
        y: f64,
        /// What was tried.
        corners: Corners,
    },
    /// A heading that no free curve joins to the way.
    #[error(
        "no free curve joins the {which}'s heading to the way within {reach_m:.1} m of it; hint: leave the heading free, or raise reach_radii"
    )]
    Heading {
        /// Start or goal.
        which: Endpoint,
        /// How much of the way was tried, metres.
        reach_m: f64,
    },
    /// Start and goal are one place, where the body does not fit.
    #[error("the body does not fit at the start, which is the goal")]
    NoRoom,
}

/// Why no 2-turning rounds a corner.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CornerProblem {
    /// A segment is too short for every member.
    #[error(
        "2-turning needs at least {needs_m:.3} m of the segment {side} it, which has {has_m:.3} m"
    )]
    TooShort {
        /// What the member that comes nearest to fitting takes, metres.
        needs_m: f64,
        /// Length of the segment, metres.
        has_m: f64,
        /// "before" or "after".
        side: &'static str,
    },
    /// Every member that the segments have room for collides.
    #[error("every 2-turning touches obstacles, by {depth_m:.3} m where it nearly fits")]
    Touches {
        /// Deepest overlap of the member that seems freest, metres.
        depth_m: f64,
    },
    /// The turn at the corner before ends too late.
    #[error(
        "2-turning needs at least {needs_m:.3} m of the segment before it, of which the turn before leaves {has_m:.3} m"
    )]
    Crowded {
        /// What the shortest free member takes, metres.
        needs_m: f64,
        /// What is left of the segment, metres.
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
