//! Goals that no vehicle of this kind can reach: refused before any search.

use super::explain::{gap_of, passable};
use super::legs::leg_name;
use crate::collision::ObstacleMap;
use crate::geometry::{Point2, Pose2};
use crate::map::{BitGrid, Cell, Components, Connectivity, GridFrame};
use crate::planner::{Disconnected, Ended, Explanation, Halt, Stages, Task};
use crate::progress::{Limits, Status};
use crate::search::widest_way_out;
use crate::vehicle::Vehicle;
use std::f64::consts::FRAC_1_SQRT_2;

/// Rounding of positions on the border of cells, cells.
const ROUNDING_CELLS: f64 = 1e-6;

/// The cells where the vehicle's rear axle may be, in connected parts.
#[derive(Clone, Debug)]
pub(in crate::planner) struct AxleGround {
    components: Components,
    /// The distance that the axle's center keeps from obstacles.
    disc_radius_m: f64,
}

impl AxleGround {
    /// Labels the parts for a vehicle.
    ///
    /// # Errors
    /// Deadline or cancel.
    pub(in crate::planner) fn new(
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
        limits: &mut Limits,
    ) -> Result<Self, Status> {
        let inradius_m = vehicle.inradius_m();
        let disc_radius_m = inradius_m.max(0.0);
        // Only what blocks a position wherever it lies in its cell: from the cell's center to the
        // position half a diagonal, from the obstacle's center to its side half a cell.
        let distance = obstacles.distance();
        let radius = disc_radius_m / obstacles.frame().resolution_m()
            - (FRAC_1_SQRT_2 - 0.5)
            - ROUNDING_CELLS;
        let limit = f64::from(distance.truncation_cells()) - 0.5;
        let blocked = if inradius_m < 0.0 {
            // An axle outside the body may pass over obstacles.
            BitGrid::new(distance.n_cols(), distance.n_rows())
        } else {
            let blocked = distance.within(radius.clamp(0.0, limit));
            blocked.unwrap_or_else(|| obstacles.lethal().clone())
        };
        limits.look()?;
        // A move from cell to cell may lead across a corner.
        let components =
            Components::new_while(&blocked, Connectivity::Eight, &mut || limits.look().is_ok());
        limits.look()?;
        Ok(Self {
            components,
            disc_radius_m,
        })
    }
}

/// A leg that leads to another part of the map.
struct DeadLeg {
    /// Its number among the legs, from 0.
    leg: usize,
    /// The place to which it leads.
    to: Point2,
}

/// Refuses a request whose start and via points or goals lie in different parts of the map.
/// Nothing that can be driven is refused.
///
/// # Errors
/// Why no path can exist; deadline or cancel.
pub(super) fn check(task: &mut Task, limits: &mut Limits) -> Result<(), Halt> {
    limits.look()?;
    let ground = task.map.axle_ground(limits)?;
    let ended = disconnected(task, &ground, limits);
    limits.look()?;
    ended.map_or(Ok(()), |ended| Err(ended.into()))
}

/// Why no path can exist; none where one may.
fn disconnected(task: &Task, ground: &AxleGround, limits: &mut Limits) -> Option<Ended> {
    let request = task.request();
    let frame = *task.obstacles().frame();
    let start = frame.cell_at(request.start.position())?;
    let home = ground.components.label(start)?;
    let is_reached = |place: Point2, tolerance_m: f64| {
        let mut near = cells_within(&frame, place, tolerance_m);
        near.any(|cell| ground.components.label(cell) == Some(home))
    };
    let mut via = request.via.iter();
    let missed = via.position(|via| !is_reached(via.position, via.tolerance.xy_m));
    if let Some(leg) = missed {
        let to = request.via[leg].position;
        return Some(explained(task, ground, &DeadLeg { leg, to }, limits));
    }
    let tolerance_m = request.goal_tolerance.xy_m;
    if request
        .goals()
        .any(|goal| is_reached(goal.position(), tolerance_m))
    {
        return None;
    }
    let distance_m = |goal: &Pose2| goal.position().distance(request.start.position());
    let nearest = request
        .goals()
        .min_by(|a, b| distance_m(a).total_cmp(&distance_m(b)))?;
    let (leg, to) = (request.via.len(), nearest.position());
    Some(explained(task, ground, &DeadLeg { leg, to }, limits))
}

/// The cells of the map that have a position within a distance of a place.
fn cells_within(
    frame: &GridFrame,
    place: Point2,
    distance_m: f64,
) -> impl Iterator<Item = Cell> + use<> {
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

/// The ending for a leg to another part of the map; of no use once a limit ends the query.
fn explained(task: &Task, ground: &AxleGround, dead: &DeadLeg, limits: &mut Limits) -> Ended {
    let request = task.request();
    let frame = task.obstacles().frame();
    let components = &ground.components;
    let ends = [request.start.position(), dead.to];
    let ends = ends.map(|p| frame.cell_at(p).unwrap_or_default());
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
    let passage = widest_way_out(
        task.obstacles().distance(),
        ends[from],
        is_there,
        &mut || limits.look().is_ok(),
    );
    let gap = passage.as_ref().map(|passage| gap_of(task, passage));
    let fallback = || {
        "start and goal lie in different parts of the ground where the rear axle can be".to_owned()
    };
    let blocked = passable(gap.as_ref()).err();
    let mut reason = blocked.unwrap_or_else(fallback);
    let has_legs = !request.via.is_empty();
    if has_legs {
        reason = format!("{}: {reason}", leg_name(request, dead.leg));
    }
    Ended {
        explanation: Some(Box::new(Explanation {
            leg: has_legs.then_some(dead.leg + 1),
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
