//! Random scenes for the planner: a path that is found keeps its body off every obstacle.
#![no_main]

use arbitrary::Arbitrary;
use formicar::geometry::{Point2, Pose2};
use formicar::map::{Cell, OCCUPIED, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::planner::{Outcome, Plan, Planner, PlannerConfig, PlannerName};
use formicar::scenario::Request;
use formicar::vehicle::{Gears, Vehicle};
use libfuzzer_sys::fuzz_target;

const N_COLS: u8 = 60;
const N_ROWS: u8 = 40;
const RESOLUTION_M: f64 = 0.2;
const BUDGET_STEPS: u64 = 1000;
const PLANNERS: [PlannerName; 4] = [
    PlannerName::Formicar,
    PlannerName::HybridAstar,
    PlannerName::Astar,
    PlannerName::ImprovedAstar,
];

#[derive(Arbitrary, Debug)]
struct Scene {
    /// Corner and size of blocks, in cells.
    blocks: Vec<[u8; 4]>,
    /// Column, row and heading in 256ths of a turn.
    start: [u8; 3],
    goal: [u8; 3],
    forward_only: bool,
    planner: u8,
    seed: u8,
}

fuzz_target!(|scene: Scene| {
    let mut map = OccupancyGrid::from_rows(&[&".".repeat(60)[..]; 40], RESOLUTION_M).expect("rows");
    for &[col, row, width, height] in scene.blocks.iter().take(12) {
        for (u, v) in (0..width % 8).flat_map(|u| (0..height % 8).map(move |v| (u, v))) {
            let cell = (col % N_COLS + u, row % N_ROWS + v);
            if cell.0 < N_COLS && cell.1 < N_ROWS {
                map.set(Cell::new(cell.0.into(), cell.1.into()), OCCUPIED);
            }
        }
    }
    let vehicle = Vehicle::warehouse_amr();
    let name = PLANNERS[usize::from(scene.planner) % PLANNERS.len()];
    let request = Request {
        gears: match scene.forward_only {
            true => Gears::Forward,
            false => Gears::Both,
        },
        budget_steps: Some(BUDGET_STEPS),
        ..Request::new(pose(scene.start), pose(scene.goal))
    };
    let mut planner = Planner::new(&map, vehicle.clone(), PlannerConfig::of(name)).expect("a preset");
    if let Ok(Outcome::Found(plan)) = planner.plan(&request, Seed(scene.seed.into()), &mut ()) {
        assert_untouched(&map, &vehicle, &plan);
    }
});

fn pose([col, row, turn]: [u8; 3]) -> Pose2 {
    let at = |cell: u8, n: u8| (f64::from(cell % n) + 0.5) * RESOLUTION_M;
    Pose2::new(
        at(col, N_COLS),
        at(row, N_ROWS),
        f64::from(turn) / 256.0 * std::f64::consts::TAU,
    )
}

/// No body along the path covers the center of an occupied cell.
fn assert_untouched(map: &OccupancyGrid, vehicle: &Vehicle, plan: &Plan) {
    let lethal = map.lethal_cells();
    for sample in plan.path.sample(0.05) {
        let body = vehicle.footprint().placed(sample.pose);
        for cell in lethal.iter() {
            let center = Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5);
            assert!(
                !body.contains(center * RESOLUTION_M),
                "{:?} covers {cell:?}",
                sample.pose
            );
        }
    }
}
