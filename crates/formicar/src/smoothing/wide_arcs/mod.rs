//! The way by the fewest and widest arcs along a polyline.
//!
//! Corners may be any of the polyline's points, each rounded by one arc. A* over legs, that is
//! pairs of points: a leg that turns into a next one costs its length, a share for the corner, and
//! more the tighter the arc. The widest arc that two legs have room for goes on the list first; it
//! is checked with the swept body when it comes up, and gives way to tighter ones. Dubins or
//! Reeds-Shepp curves lead from a given start heading onto a leg, and from a leg to a given goal
//! heading. What is found is then made better by moving its corners about.

mod ends;
mod fillet;
mod refine;
mod search;
mod sight;

pub(super) use search::{WidePath, widest};
