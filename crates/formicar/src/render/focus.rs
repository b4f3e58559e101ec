//! The part of a map that a picture shows: all of it, or the surroundings of a short path.

use super::Layout;
use super::plan_parts::PlanPicture;
use super::view::frame_bounds;
use crate::geometry::Point2;

/// Room around the way, as a share of its longer side.
const AROUND: f64 = 0.12;
/// The least ratio of width to height.
const MIN_RATIO: f64 = 0.75;
/// Poses along the path that are looked at.
const N_SAMPLES: f64 = 400.0;

/// Lowest and highest world coordinates to show. Without a path the whole map: what is in the way
/// may be anywhere.
pub(super) fn bounds(plan: &PlanPicture, layout: Layout) -> (Point2, Point2) {
    let map = frame_bounds(plan.map.frame());
    let Some(way) = way_bounds(plan) else {
        return map;
    };
    // A small screen shows less of the map, and no wide strips of it.
    let (max_ratio, max_share) = match layout {
        Layout::Page => (2.0, 0.6),
        Layout::Phone => (1.25, 0.85),
    };
    let part = within(shaped(way, max_ratio), map);
    let area = |(low, high): (Point2, Point2)| (high.x - low.x) * (high.y - low.y);
    if area(part) <= max_share * area(map) {
        part
    } else {
        map
    }
}

/// The box around path, start, goal and the vehicle on them, with some room.
fn way_bounds(plan: &PlanPicture) -> Option<(Point2, Point2)> {
    let path = plan.path?;
    let spacing_m = path.length_m() / N_SAMPLES;
    if !(spacing_m.is_finite() && spacing_m > 0.0) {
        return None;
    }
    let ends = [plan.start.position(), plan.goal.position()];
    let on_path = path
        .sample(spacing_m)
        .into_iter()
        .map(|at| at.pose.position());
    let (low, high) = ends
        .into_iter()
        .chain(on_path)
        .fold((ends[0], ends[0]), |(low, high), p| {
            (
                Point2::new(low.x.min(p.x), low.y.min(p.y)),
                Point2::new(high.x.max(p.x), high.y.max(p.y)),
            )
        });
    let longer_m = (high.x - low.x).max(high.y - low.y);
    let room_m = 1.5 * plan.vehicle.footprint().circumradius() + AROUND * longer_m;
    let room = Point2::new(room_m, room_m);
    ((high - low).is_finite() && room.is_finite()).then(|| (low - room, high + room))
}

/// A box widened or heightened to a ratio of width to height that fills a page.
fn shaped((low, high): (Point2, Point2), max_ratio: f64) -> (Point2, Point2) {
    let size = high - low;
    let more = Point2::new(
        (MIN_RATIO * size.y - size.x).max(0.0),
        (size.x / max_ratio - size.y).max(0.0),
    );
    (low - more * 0.5, high + more * 0.5)
}

/// A box moved, and cut where it is larger, so that it lies in another.
pub(super) fn within(
    (low, high): (Point2, Point2),
    (least, most): (Point2, Point2),
) -> (Point2, Point2) {
    let along = |low: f64, high: f64, least: f64, most: f64| {
        let back = (least - low).max(0.0) - (high - most).max(0.0);
        ((low + back).max(least), (high + back).min(most))
    };
    let (left, right) = along(low.x, high.x, least.x, most.x);
    let (bottom, top) = along(low.y, high.y, least.y, most.y);
    (Point2::new(left, bottom), Point2::new(right, top))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_beyond_the_map_is_moved_back_or_cut() {
        let map = (Point2::new(0.0, 0.0), Point2::new(10.0, 5.0));
        let part = (Point2::new(-1.0, -1.0), Point2::new(2.0, 7.0));
        let inside = (Point2::new(0.0, 0.0), Point2::new(3.0, 5.0));
        assert_eq!(within(part, map), inside);
    }

    #[test]
    fn a_thin_box_gets_company() {
        let (low, high) = shaped((Point2::default(), Point2::new(8.0, 1.0)), 2.0);
        assert_eq!(high - low, Point2::new(8.0, 4.0));
    }
}
