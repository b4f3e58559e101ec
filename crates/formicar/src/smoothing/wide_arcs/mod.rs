//! The path by the fewest and widest arcs along a polyline.
//!
//! Any point of the polyline may become a corner, rounded by one arc. The search is A* over legs,
//! that is pairs of points: a leg costs its length, a constant for the corner at its end, and more
//! the tighter the arc. The widest arc that two legs have room for goes on the open list first; it
//! is checked with the swept body when it comes up, and is replaced by a tighter one if it
//! collides. Dubins or Reeds-Shepp curves lead from a given start heading onto a leg, and from a
//! leg to a given goal heading. Local search over the corners then improves the path.

mod ends;
mod fillet;
mod refine;
mod search;
mod sight;

pub(super) use search::{WidePath, widest};
