//! Growth of the proposed method's time with the map.

use super::drive::{Drive, Job};
use super::grounds::shortest_m;
use super::group::{Drives, SCALING, TIME, drives_of};
use super::methods::{Method, PROPOSED};
use crate::papers::experiment::{Ground, Scale, Variant};
use crate::papers::group::ratio;
use crate::report::{Column, Field, Table};
use anyhow::Result;
use formicar::map::generate::{NeighborhoodParameters, alley_neighborhood, free_pose_pairs};
use formicar::numeric::Seed;
use formicar::scenario::{GoalHeading, Request};
use formicar::vehicle::Vehicle;

/// Columns and rows, from a quarter of the paper's map to twenty-five times as many cells.
const SIZES: [[usize; 2]; 4] = [[400, 250], [800, 500], [1600, 1000], [4000, 2500]];
/// Sizes that a small setup uses.
const N_SMALL: usize = 2;
/// Seed of the maps and of the ends.
const SEED: Seed = Seed(15);
/// Requests on each map, and how many pairs of poses are tried for them.
const N_ROUTES: usize = 3;
const N_PAIRS: usize = 12;

/// Runs a method on maps of growing size, three seeds for each of three requests.
pub(super) fn run(
    method: Method,
    scale: Scale,
    report_progress: &mut dyn FnMut(&str),
) -> Result<(Vec<Drive>, Vec<Ground>)> {
    let n_sizes = if scale.is_small { N_SMALL } else { SIZES.len() };
    let variant = Variant::of(method.planner);
    let (mut drives, mut grounds) = (Vec::new(), Vec::new());
    for size in &SIZES[..n_sizes] {
        for (ground, route_m) in routes(*size)? {
            report_progress(&format!("{}: {}", ground.map, variant.name));
            let job = Job {
                part: SCALING,
                ground: &ground,
                variant: &variant,
                native: method.native,
                shortest_m: Some(route_m),
            };
            for seed in 0..scale.n_runs.min(3) {
                drives.push(job.run(seed)?.0);
            }
            grounds.push(ground);
        }
    }
    Ok((drives, grounds))
}

/// The first pairs of free poses, far apart, between which a way over cells exists, and its
/// length.
fn routes([n_cols, n_rows]: [usize; 2]) -> Result<Vec<(Ground, f64)>> {
    let parameters = NeighborhoodParameters {
        n_cols,
        n_rows,
        ..NeighborhoodParameters::default()
    };
    let grid = alley_neighborhood(&parameters, SEED)?;
    let vehicle = Vehicle::lei2020();
    let mut routes = Vec::new();
    for (start, goal) in free_pose_pairs(&grid, &vehicle, N_PAIRS, SEED)? {
        let ground = Ground {
            map: format!("{}, {}", name([n_cols, n_rows]), routes.len() + 1),
            grid: grid.clone(),
            vehicle: vehicle.clone(),
            request: Request {
                goal_heading: GoalHeading::Any,
                ..Request::new(start, goal)
            },
        };
        if let Some(route_m) = shortest_m(&ground) {
            routes.push((ground, route_m));
        }
        if routes.len() == N_ROUTES {
            break;
        }
    }
    Ok(routes)
}

fn name([n_cols, n_rows]: [usize; 2]) -> String {
    format!("{n_cols} x {n_rows}")
}

/// Times by size, and per cell.
pub(super) fn table(drives: &[Drive], method: &str) -> Table {
    let caption = format!(
        "`{method}` on neighborhoods from the same generator, on up to {N_ROUTES} routes each \
         across the whole map: medians with quartiles of map set-up and query, and the median per \
         cell of the map over that of the smallest map."
    );
    let of_size = |size: &[usize; 2]| {
        let group = drives_of(drives, SCALING, method);
        (
            *size,
            group.filter(|drive| drive.ground.starts_with(&name(*size))),
        )
    };
    let groups = SIZES
        .iter()
        .map(of_size)
        .filter(|(_, group)| group.len() > 0);
    let groups: Vec<_> = groups.collect();
    let per_cell_ns = |(size, group): &([usize; 2], Drives)| {
        let n_cells = (size[0] * size[1]) as f64;
        group.median(|drive| Some(1e6 * drive.total_ms / n_cells))
    };
    let smallest = groups.iter().find_map(per_cell_ns);
    let columns: [Column<&([usize; 2], Drives)>; 6] = [
        ("cells", &|(size, _)| Field::Words(name(*size))),
        ("certified", &|(_, group)| group.certified()),
        ("shortest m", &|(_, group)| {
            group.number(|drive| drive.shortest_m, 1)
        }),
        ("time ms", &|(_, group)| group.spread(TIME.of, 1)),
        ("per cell ns", &|at| Field::Number(per_cell_ns(at), 1)),
        ("per cell / smallest", &|at| {
            Field::Number(ratio(per_cell_ns(at), smallest), 2)
        }),
    ];
    Table::of(SCALING, &groups, &columns).captioned(&caption)
}

/// The method whose growth is measured, if this build knows it.
pub(super) fn subject(methods: &[Method]) -> Option<Method> {
    methods
        .iter()
        .copied()
        .find(|method| method.planner.name() == PROPOSED)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn routes_cross_the_map_and_are_passable() {
        let routes = routes(SIZES[0]).unwrap();
        assert_eq!(routes.len(), N_ROUTES);
        assert!(routes.iter().all(|(_, route_m)| *route_m > 20.0));
        assert_eq!(routes[1].0.map, "400 x 250, 2");
    }
}
