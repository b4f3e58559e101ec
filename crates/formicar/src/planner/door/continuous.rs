//! Continuous curvature, where the request asks for it: transitions in the path that was found, or
//! in one planned for a gentler vehicle, whose turns leave room for them.

use crate::objective::DriveCost;
use crate::planner::prepared::PreparedMap;
use crate::planner::{Ended, Found, Halt, PlanError, PlannerConfig, Task};
use crate::progress::{Limits, Status};
use crate::smoothing::{Continuity, NoTransition};
use crate::vehicle::{Vehicle, VehicleError, VehicleParameters};

/// A vehicle that is planned for in the place of the true one.
struct Gentler {
    /// Its turning radius by that of the true one.
    radii: f64,
    /// Its safety margin beyond that of the true one, by the width of the true one.
    margin_widths: f64,
}

/// Steps that each further search may take: so many, and a share of those of the first. A gentler
/// vehicle may have no way at all, and the proof of that takes long.
const STEPS_MORE: u64 = 5_000;
const SHARE_MORE: u64 = 2;

/// Tried in this order where transitions do not fit into the first path.
const GENTLER: [Gentler; 5] = [
    Gentler {
        radii: 1.25,
        margin_widths: 0.0,
    },
    Gentler {
        radii: 1.25,
        margin_widths: 0.1,
    },
    Gentler {
        radii: 1.6,
        margin_widths: 0.0,
    },
    Gentler {
        radii: 1.0,
        margin_widths: 0.15,
    },
    Gentler {
        radii: 2.2,
        margin_widths: 0.05,
    },
];

/// The path with continuous curvature, where the request asks for it. Further searches count
/// against the same limits.
pub(super) fn made_continuous(
    task: &Task,
    found: Found,
    limits: &mut Limits,
) -> Result<Found, Halt> {
    let rate = task.request().max_curvature_rate_per_m2(task.vehicle());
    let Some(max_rate_per_m2) = rate.map_err(PlanError::from)? else {
        return Ok(found);
    };
    let default_cost = DriveCost::default();
    let config = task.search.config();
    let continuity = Continuity {
        obstacles: task.obstacles(),
        vehicle: task.vehicle(),
        max_rate_per_m2,
        cost: config.map_or(&default_cost, PlannerConfig::cost),
    };
    let problem = match continuity.apply(&found.path) {
        Ok(path) => return Ok(Found { path, ..found }),
        Err(problem) => problem,
    };
    let n_more = STEPS_MORE + SHARE_MORE * limits.n_steps();
    for gentler in &GENTLER {
        let Some(mut map) = gentler.prepared(task) else {
            continue;
        };
        let mut gentle = task.on(&mut map);
        let searched = limits.within(n_more, |limits| super::find(&mut gentle, limits));
        let ended = match searched {
            Ok(other) => {
                if let Ok(path) = continuity.apply(&other.path) {
                    return Ok(Found { path, ..other });
                }
                continue;
            }
            Err(halt) => halt.ended()?,
        };
        if was_stopped(ended.status, limits) {
            let others = "the search for gentler turns was cut short";
            let status = ended.status;
            return Err(Halt::Ended(Ended {
                status,
                ..no_transition(task, &problem, others, found)
            }));
        }
    }
    let others = "paths for gentler turns did no better";
    Err(no_transition(task, &problem, others, found).into())
}

fn no_transition(task: &Task, problem: &NoTransition, others: &str, found: Found) -> Ended {
    let reason = format!(
        "{} found a path, but {problem}; {others}; hint: allow a larger rate or drive more slowly, or give the vehicle more room",
        task.planner()
    );
    Ended::because(Status::Infeasible, reason, found.stages)
}

/// True where a search was stopped from outside, and not by its own share of steps.
fn was_stopped(status: Status, limits: &Limits) -> bool {
    match status {
        Status::TimedOut | Status::Cancelled => true,
        Status::BudgetExhausted => limits.is_exhausted(),
        Status::Found | Status::NoPath | Status::Infeasible => false,
    }
}

impl Gentler {
    /// The map for the gentler vehicle; none where that does not fit at an end.
    fn prepared(&self, task: &Task) -> Option<PreparedMap> {
        let vehicle = self.of(task.vehicle()).ok()?;
        task.request().check(task.obstacles(), &vehicle).ok()?;
        Some(PreparedMap::new(task.obstacles().clone(), vehicle))
    }

    fn of(&self, vehicle: &Vehicle) -> Result<Vehicle, VehicleError> {
        let margin_m = vehicle.parameters().safety_margin_m.unwrap_or(0.0);
        Vehicle::new(VehicleParameters {
            min_turning_radius_m: Some(self.radii * vehicle.min_turning_radius_m()),
            max_steer_rad: None,
            max_steer_deg: None,
            safety_margin_m: Some(margin_m + self.margin_widths * vehicle.width_m()),
            ..vehicle.parameters().clone()
        })
    }
}
