//! Maps for benchmarks.
#![allow(dead_code, reason = "each benchmark uses a part")]

use formicar::geometry::Pose2;
use formicar::map::format::read_car_scenarios;
use formicar::map::{BitGrid, Cell, GridFrame, OCCUPIED, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::planner::{Planner, PlannerConfig};
use formicar::scenario::Request;
use formicar::vehicle::Vehicle;
use std::path::Path;

/// A town of rectangular blocks of 20 to 60 cells between alleys of 10 to 20, most of them
/// courtyards: walls around open ground.
pub(crate) fn town(n_cols: usize, n_rows: usize) -> BitGrid {
    let mut lethal = BitGrid::new(n_cols, n_rows);
    let mut stream = Seed(1).stream([n_cols as u64, n_rows as u64]);
    let mut top = 8;
    while top + 60 < n_rows {
        let height = 20 + stream.below(40);
        let mut left = 8;
        while left + 60 < n_cols {
            let width = 20 + stream.below(40);
            let solid = stream.below(3) == 0;
            for row in top..top + height {
                let wall = solid || row == top;
                (left..left + width)
                    .filter(|&col| wall || col == left)
                    .for_each(|col| lethal.insert(Cell::new(col as u32, row as u32)));
            }
            left += width + 10 + stream.below(10);
        }
        top += height + 10 + stream.below(10);
    }
    lethal
}

/// The town as a map of cells of 0.2 m.
pub(crate) fn town_map(n_cols: usize, n_rows: usize) -> OccupancyGrid {
    let frame = GridFrame::new(n_cols, n_rows, 0.2, Pose2::default()).expect("a frame");
    let mut map = OccupancyGrid::free(frame);
    for cell in town(n_cols, n_rows).iter() {
        map.set(cell, OCCUPIED);
    }
    map
}

/// Grid sizes of the benchmarks.
pub(crate) const SIZES: [(usize, usize); 3] = [(800, 500), (2000, 2000), (5000, 5000)];

/// A real alley neighborhood of 800 x 500 cells of 0.2 m, with its start and goal cells.
pub(crate) struct Hood {
    pub(crate) lethal: BitGrid,
    pub(crate) queries: Vec<[Cell; 2]>,
}

/// Side of its cells, meters.
pub(crate) const HOOD_RESOLUTION_M: f64 = 0.2;

/// The neighborhood, if the shared data lies beside the workspace.
pub(crate) fn hood() -> Option<Hood> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/car");
    let image = std::fs::read(folder.join("hood_800x500.pgm")).ok()?;
    let json = std::fs::read(folder.join("hood_800x500.json")).ok()?;
    let json: serde_json::Value = serde_json::from_slice(&json).ok()?;
    let cell = |pose: &serde_json::Value| {
        let index = |i: usize| pose[i].as_f64().map(|m| (m / HOOD_RESOLUTION_M) as u32);
        Some(Cell::new(index(0)?, index(1)?))
    };
    let ends = |s: &serde_json::Value| Some([cell(&s["start"])?, cell(&s["goal"])?]);
    Some(Hood {
        lethal: read_p5(&image)?,
        queries: json["scenarios"]
            .as_array()?
            .iter()
            .filter_map(ends)
            .collect(),
    })
}

/// The dark pixels of a P5 image without comments; its last row is row 0.
fn read_p5(image: &[u8]) -> Option<BitGrid> {
    let mut header = image.splitn(4, |&byte| byte == b'\n');
    let (magic, size) = (header.next()?, std::str::from_utf8(header.next()?).ok()?);
    let (n_cols, n_rows) = size.split_once(' ')?;
    let (n_cols, n_rows): (usize, usize) = (n_cols.parse().ok()?, n_rows.parse().ok()?);
    let pixels = header.nth(1)?;
    if magic != b"P5" || n_cols == 0 || pixels.len() != n_cols * n_rows {
        return None;
    }
    let mut lethal = BitGrid::new(n_cols, n_rows);
    for (row, pixels) in pixels.rchunks_exact(n_cols).enumerate() {
        let dark = pixels.iter().enumerate().filter(|&(_, &grey)| grey < 200);
        dark.for_each(|(col, _)| lethal.insert(Cell::new(col as u32, row as u32)));
    }
    Some(lethal)
}

/// The car queries of that neighborhood, ready to plan.
pub(crate) fn hood_queries() -> Option<(Planner, Vec<Request>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/car");
    let map = OccupancyGrid::read_ros_yaml(folder.join("hood_800x500.yaml")).ok()?;
    let scenarios = read_car_scenarios(&folder.join("hood_800x500.json")).ok()?;
    let vehicle = Vehicle::new(scenarios.first()?.vehicle.clone()).ok()?;
    let planner = Planner::new(&map, vehicle, PlannerConfig::default()).ok()?;
    let requests = scenarios
        .iter()
        .map(|s| Request::new(s.start, s.goal))
        .collect();
    Some((planner, requests))
}
