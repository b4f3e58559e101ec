//! Lines of sight between the points of a polyline, and lower bounds of the cost to its end.

use crate::geometry::Point2;
use crate::map::{BitGrid, DiagonalRule, line_of_sight};
use std::ops::Range;

/// Points nearer to each other than this are the same, meters.
const SAME_PLACE_M: f64 = 1e-9;
/// Weight of the heuristic: above 1 the search skips paths that might be slightly better; the
/// result costs at most this many times the least.
const HASTE: f64 = 1.5;
/// Points looked at one by one from a point; those after them with growing gaps.
const N_NEAR: usize = 12;

/// A later point that is seen from a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    pub(super) to: usize,
    pub(super) distance_m: f64,
    pub(super) heading_rad: f64,
}

/// The map on which points see each other, and the lengths that count.
pub(super) struct View<'a> {
    /// The cells that block the line of sight.
    pub(super) lethal: &'a BitGrid,
    pub(super) resolution_m: f64,
    /// The longest distance over which points see each other.
    pub(super) reach_m: f64,
    /// Cost of a corner.
    pub(super) corner_m: f64,
    /// Whether to go on.
    pub(super) goes_on: &'a dyn Fn() -> bool,
}

/// The points of a polyline, after its first one some leads, with the points that each sees.
pub(super) struct Sights {
    pub(super) points: Vec<Point2>,
    n_leads: usize,
    all: Vec<Sight>,
    /// The part of `all` that belongs to each point.
    ranges: Vec<Range<usize>>,
    /// Least cost from each point to the last, meters.
    rest: Vec<f64>,
}

impl Sights {
    /// Finds all lines of sight; none if the polyline does not move, or the caller ends it. Leads are the places of the
    /// first corner if the start has a heading; the first point then sees nothing else.
    pub(super) fn new(polyline: &[Point2], leads: &[Point2], view: &View) -> Option<Self> {
        let View { lethal, .. } = *view;
        let mut points = polyline.to_vec();
        points.dedup_by(|a, b| a.distance(*b) < SAME_PLACE_M);
        if points.len() < 2 {
            return None;
        }
        points.splice(1..1, leads.iter().copied());
        let (n_leads, last) = (leads.len(), points.len() - 1);
        let scale = 1.0 / view.resolution_m;
        let sees = |a: Point2, b: Point2| {
            line_of_sight(lethal, DiagonalRule::NoObstacles, a * scale, b * scale)
        };
        let (mut all, mut ranges) = (Vec::new(), Vec::new());
        for (from, &at) in points.iter().enumerate() {
            if !(view.goes_on)() {
                return None;
            }
            let first = all.len();
            let all_leads = (1..=n_leads).take_while(|_| from == 0);
            let later = ahead(from.max(n_leads), last).take_while(|_| from > 0 || n_leads == 0);
            for to in all_leads.chain(later) {
                let step = points[to] - at;
                let distance_m = step.norm();
                if distance_m <= view.reach_m && distance_m > SAME_PLACE_M && sees(at, points[to]) {
                    all.push(Sight {
                        to,
                        distance_m,
                        heading_rad: step.angle(),
                    });
                }
            }
            ranges.push(first..all.len());
        }
        let mut sights = Self {
            rest: vec![f64::INFINITY; points.len()],
            n_leads,
            points,
            all,
            ranges,
        };
        sights.measure_rest(view.corner_m);
        Some(sights)
    }

    fn measure_rest(&mut self, corner_m: f64) {
        let last = self.last();
        self.rest[last] = 0.0;
        for from in (0..last).rev() {
            let through = self.from(from).iter().map(|sight| {
                let corner_m = if sight.to == last { 0.0 } else { corner_m };
                sight.distance_m + corner_m + self.rest[sight.to]
            });
            self.rest[from] = through.fold(f64::INFINITY, f64::min);
        }
    }

    /// The points of the polyline after the first.
    pub(super) fn after_start(&self) -> Range<usize> {
        self.n_leads + 1..self.points.len()
    }

    pub(super) fn last(&self) -> usize {
        self.points.len() - 1
    }

    /// The lines of sight from a point.
    pub(super) fn from(&self, point: usize) -> &[Sight] {
        &self.all[self.ranges[point].clone()]
    }

    /// Least cost from a point to the last, meters; corners on the way count, one at the point does
    /// not.
    pub(super) fn rest_m(&self, point: usize) -> f64 {
        HASTE * self.rest[point]
    }
}

/// The points after one: near ones one by one, then with growing gaps, the last one always.
fn ahead(from: usize, last: usize) -> impl Iterator<Item = usize> {
    let mut next = from + 1;
    std::iter::from_fn(move || {
        let here = next;
        let gap = 1 + (here - from) / N_NEAR;
        next = if here < last {
            (here + gap).min(last)
        } else {
            last + 1
        };
        (here <= last).then_some(here)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;

    #[test]
    fn every_point_has_its_neighbors_ahead_and_the_last() {
        let seen: Vec<usize> = ahead(3, 40).collect();
        assert_eq!(seen[..13], [(4..16).collect(), vec![17]].concat());
        assert!(seen[11..].windows(2).all(|w| w[1] > w[0]) && seen.last() == Some(&40));
        assert_eq!(ahead(5, 5).count(), 0);
    }

    #[test]
    fn walls_hide_points_and_lengthen_what_remains() {
        let map = OccupancyGrid::from_rows(&["....", ".##.", "...."], 1.0).unwrap();
        let points = [(0.5, 0.5), (0.5, 2.5), (3.5, 2.5)].map(|(x, y)| Point2::new(x, y));
        let view = View {
            lethal: &map.lethal_cells(),
            resolution_m: 1.0,
            reach_m: 100.0,
            corner_m: 0.5,
            goes_on: &|| true,
        };
        let sights = Sights::new(&points, &[], &view).unwrap();
        let seen = |from: usize| sights.from(from).iter().map(|s| s.to).collect::<Vec<_>>();
        assert_eq!((seen(0), seen(1)), (vec![1], vec![2]));
        assert_eq!([0, 1, 2].map(|i| sights.rest_m(i) / HASTE), [5.5, 3.0, 0.0]);
        let lead = Point2::new(0.5, 1.5);
        let led = Sights::new(&points, &[lead], &view).unwrap();
        let seen = |from: usize| led.from(from).iter().map(|s| s.to).collect::<Vec<_>>();
        assert_eq!(
            (seen(0), seen(1), led.after_start()),
            (vec![1], vec![2], 2..4)
        );
    }
}
