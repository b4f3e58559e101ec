//! Goals that no vehicle of this kind can reach: told before any search.

use super::explain::passable;
use super::run::Ended;
use super::via::leg_name;
use super::{Disconnected, Explanation, Planner, Stages};
use crate::geometry::{Point2, Pose2};
use crate::map::{Cell, Components, Connectivity};
use crate::progress::Status;
use crate::scenario::Request;
use crate::search::widest_way_out;
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

/// Rounding of positions on the border of cells, cells.
const ROUNDING_CELLS: f64 = 1e-6;

/// The ground where the vehicle's rear axle may be, in parts that hang together.
#[derive(Clone, Debug)]
pub(super) struct AxleGround {
    components: Components,
    /// What the axle's center keeps from obstacles.
    disc_radius_m: f64,
}

impl Planner {
    /// Why no path can exist, where start and via points or goals lie in different parts of the
    /// map; none where they do not. Nothing that can be driven is refused.
    pub(super) fn sealed_off(&mut self, request: &Request) -> Option<Ended> {
        let ground = self.axle_ground();
        let start = self.obstacles.frame().cell_at(request.start.position())?;
        let home = ground.components.label(start)?;
        let is_reached = |place: Point2, tolerance_m: f64| {
            let mut near = self.cells_within(place, tolerance_m);
            near.any(|cell| ground.components.label(cell) == Some(home))
        };
        let mut via = request.via.iter();
        let missed = via.position(|via| !is_reached(via.position, via.tolerance.xy_m));
        if let Some(leg) = missed {
            return Some(self.sealed(&ground, request, (leg, request.via[leg].position)));
        }
        let tolerance_m = request.goal_tolerance.xy_m;
        if request
            .goals()
            .any(|goal| is_reached(goal.position(), tolerance_m))
        {
            return None;
        }
        let far_m = |goal: &Pose2| goal.position().distance(request.start.position());
        let nearest = request
            .goals()
            .min_by(|a, b| far_m(a).total_cmp(&far_m(b)))?;
        Some(self.sealed(&ground, request, (request.via.len(), nearest.position())))
    }

    /// Prepares the ground, once.
    fn axle_ground(&mut self) -> Arc<AxleGround> {
        if let Some(ground) = &self.axle_ground {
            return ground.clone();
        }
        let disc_radius_m = self.vehicle.footprint().inradius().max(0.0);
        // Only what blocks a position wherever it lies in its cell: from the cell's center to the
        // position half a diagonal, from the obstacle's center to its side half a cell.
        let distance = self.obstacles.distance();
        let radius = disc_radius_m / self.obstacles.frame().resolution_m()
            - (FRAC_1_SQRT_2 - 0.5)
            - ROUNDING_CELLS;
        let limit = f64::from(distance.truncation_cells()) - 0.5;
        let blocked = distance.within(radius.clamp(0.0, limit));
        let blocked = blocked.unwrap_or_else(|| self.obstacles.lethal().clone());
        // Who moves from cell to cell may do so across a corner.
        let components = Components::new(&blocked, Connectivity::Eight);
        let ground = Arc::new(AxleGround {
            components,
            disc_radius_m,
        });
        self.axle_ground = Some(ground.clone());
        ground
    }

    /// The cells of the map that have a position within a distance of a place.
    fn cells_within(&self, place: Point2, distance_m: f64) -> impl Iterator<Item = Cell> + use<> {
        let frame = *self.obstacles.frame();
        let resolution_m = frame.resolution_m();
        let at = frame.to_grid(Pose2::at(place, 0.0)).position();
        let reach_m = distance_m + resolution_m * (FRAC_1_SQRT_2 + ROUNDING_CELLS);
        let range = |x: f64, n: usize| {
            let low = ((x - reach_m) / resolution_m).max(0.0) as u32;
            let high = ((x + reach_m) / resolution_m + 1.0).clamp(0.0, n as f64) as u32;
            low..high
        };
        let (cols, rows) = (range(at.x, frame.n_cols()), range(at.y, frame.n_rows()));
        let cells = rows.flat_map(move |row| cols.clone().map(move |col| Cell::new(col, row)));
        cells.filter(move |cell| {
            let center = Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5);
            (center * resolution_m).distance(at) <= reach_m
        })
    }

    /// The ending for a leg to a place that lies apart.
    fn sealed(&self, ground: &AxleGround, request: &Request, (leg, to): (usize, Point2)) -> Ended {
        let frame = self.obstacles.frame();
        let components = &ground.components;
        let ends = [request.start.position(), to].map(|p| frame.cell_at(p).unwrap_or_default());
        let labels = ends.map(|cell| components.label(cell));
        let sizes = labels.map(|label| label.map_or(0, |l| components.sizes()[l as usize]));
        // From the smaller part out, until the other is met: within it no place is as narrow.
        let from = usize::from(labels[1].is_some() && sizes[1] < sizes[0]);
        let index = frame.index(ends[1 - from]);
        let other = labels[1 - from];
        let is_there = |i: usize| match other {
            Some(_) => components.label(frame.cell(i)) == other,
            None => i == index,
        };
        let passage = widest_way_out(self.obstacles.distance(), ends[from], is_there);
        let gap = passage.as_ref().map(|passage| self.gap(passage));
        let fallback = || {
            "start and goal lie in different parts of the ground where the rear axle can be"
                .to_owned()
        };
        let blocked = passable(gap.as_ref()).err();
        let mut reason = blocked.unwrap_or_else(fallback);
        let has_legs = !request.via.is_empty();
        if has_legs {
            reason = format!("{}: {reason}", leg_name(request, leg));
        }
        Ended {
            explanation: Some(Box::new(Explanation {
                leg: has_legs.then_some(leg + 1),
                disconnected: Some(Disconnected {
                    disc_radius_m: ground.disc_radius_m,
                    n_cells_at_start: sizes[0],
                    n_cells_at_goal: sizes[1],
                }),
                gap,
                ..Explanation::default()
            })),
            ..Ended::because(Status::NoPath, reason, Stages::default())
        }
    }
}
