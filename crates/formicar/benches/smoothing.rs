//! Speed of smoothing: redundant nodes, a path of 30 nodes, whole queries of a neighborhood.

mod support;

use divan::{Bencher, black_box};
use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::{BitGrid, Cell, DiagonalRule, GridFrame, MoveMasks, OCCUPIED, OccupancyGrid};
use formicar::path::GridPath;
use formicar::progress::Limits;
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::search::{AstarWorkspace, astar};
use formicar::smoothing::{
    SmoothingConfig, SmoothingProblem, TwoTurning, remove_redundant_nodes, smooth,
};
use formicar::vehicle::{Gears, Vehicle};
use support::{HOOD_RESOLUTION_M, hood};

const RULE: DiagonalRule = DiagonalRule::NoObstacles;

fn main() {
    divan::main();
}

/// The 25 members at a corner.
#[divan::bench]
fn family(bencher: Bencher) {
    bencher.bench(|| TwoTurning::family(black_box(1.3), 0.77, 12));
}

/// A map with its grown obstacles and a vehicle.
struct Place {
    obstacles: ObstacleMap,
    blocked: BitGrid,
    vehicle: Vehicle,
}

impl Place {
    fn new(map: &OccupancyGrid, vehicle: Vehicle, growth_m: f64) -> Option<Self> {
        let obstacles = ObstacleMap::new(map);
        let growth = growth_m / obstacles.frame().resolution_m();
        Some(Self {
            blocked: obstacles.distance().within(growth)?,
            obstacles,
            vehicle,
        })
    }

    fn ground(&self) -> SmoothingProblem<'_> {
        SmoothingProblem {
            obstacles: &self.obstacles,
            vehicle: &self.vehicle,
            blocked: &self.blocked,
            rule: RULE,
        }
    }
}

/// 30 nodes in zigzag, 4 m apart at 0.1 m, with a pole inside every corner.
fn zigzag() -> Option<(Place, Vec<Cell>)> {
    let frame = GridFrame::new(1000, 120, 0.1, Pose2::default()).ok()?;
    let mut map = OccupancyGrid::free(frame);
    let node = |i: u32| Cell::new(30 + 32 * i, 50 + 24 * (i % 2));
    let nodes: Vec<Cell> = (0..30).map(node).collect();
    for (i, node) in nodes.iter().enumerate() {
        let inside = if i % 2 == 0 { 12 } else { -12 };
        map.set(
            Cell::new(node.col, node.row.saturating_add_signed(inside)),
            OCCUPIED,
        );
    }
    let place = Place::new(&map, Vehicle::warehouse_amr(), 0.35)?;
    Some((place, nodes))
}

fn free_ends(request: &Request) -> Request {
    Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        gears: Gears::Forward,
        ..request.clone()
    }
}

fn smooth_zigzag(bencher: Bencher, config: &SmoothingConfig, ask: impl Fn(&Request) -> Request) {
    let Some((place, nodes)) = zigzag() else {
        return;
    };
    let at = |cell| Pose2::at(place.obstacles.frame().center(cell), 0.0);
    let request = ask(&Request::new(at(nodes[0]), at(nodes[29])));
    let run = || smooth(&place.ground(), config, &request, &nodes);
    assert!(run().is_ok(), "the corners have room: {:?}", run().err());
    bencher.bench_local(run);
}

#[divan::bench]
fn nodes_30_free_headings(bencher: Bencher) {
    smooth_zigzag(bencher, &SmoothingConfig::lei2020(), free_ends);
}

#[divan::bench]
fn nodes_30_exact_headings_reverse_allowed(bencher: Bencher) {
    smooth_zigzag(bencher, &SmoothingConfig::default(), Request::clone);
}

/// Ten queries on a neighborhood grown by half a car's width and 0.1 m.
mod hood_800x500 {
    use super::{
        AstarWorkspace, Bencher, Cell, GridFrame, GridPath, HOOD_RESOLUTION_M, Limits, MoveMasks,
        OCCUPIED, OccupancyGrid, Place, Pose2, RULE, Request, SmoothingConfig, Vehicle, astar,
        hood, remove_redundant_nodes, smooth,
    };

    fn paths() -> Option<(Place, Vec<GridPath>)> {
        let hood = hood()?;
        let (n_cols, n_rows) = (hood.lethal.n_cols(), hood.lethal.n_rows());
        let frame = GridFrame::new(n_cols, n_rows, HOOD_RESOLUTION_M, Pose2::default()).ok()?;
        let mut map = OccupancyGrid::free(frame);
        hood.lethal.iter().for_each(|cell| map.set(cell, OCCUPIED));
        let place = Place::new(&map, Vehicle::lei2020(), 0.6)?;
        let moves = MoveMasks::new(&place.blocked, RULE);
        let path = |&[start, goal]: &[Cell; 2]| {
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, None, None);
            let found = astar(&moves, start, goal, &mut AstarWorkspace::new(), &mut limits);
            Some(found.ok()?.path)
        };
        let paths = hood.queries.iter().filter_map(path).collect();
        Some((place, paths))
    }

    #[divan::bench]
    fn redundant_nodes_10_paths(bencher: Bencher) {
        let Some((place, paths)) = paths() else {
            return;
        };
        bencher.bench_local(|| {
            let nodes = paths
                .iter()
                .map(|p| remove_redundant_nodes(&place.blocked, RULE, p));
            nodes.map(|n| n.len()).sum::<usize>()
        });
    }

    #[divan::bench]
    fn smooth_10_paths(bencher: Bencher) {
        let Some((place, paths)) = paths() else {
            return;
        };
        let nodes: Vec<Vec<Cell>> = paths
            .iter()
            .map(|p| remove_redundant_nodes(&place.blocked, RULE, p))
            .collect();
        let request = |nodes: &[Cell]| {
            let at = |cell| Pose2::at(place.obstacles.frame().center(cell), 0.0);
            super::free_ends(&Request::new(at(nodes[0]), at(nodes[nodes.len() - 1])))
        };
        let config = SmoothingConfig::default();
        bencher.bench_local(|| {
            let smoothed = nodes
                .iter()
                .map(|n| smooth(&place.ground(), &config, &request(n), n));
            smoothed.flatten().count()
        });
    }
}
