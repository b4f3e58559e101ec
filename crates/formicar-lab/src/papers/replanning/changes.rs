//! Changes of a map while a vehicle drives: the same for every method.

use formicar::collision::{Body, Drive, ObstacleMap};
use formicar::geometry::Pose2;
use formicar::map::{Cell, CellRegion, FREE, GridFrame, OCCUPIED};
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::vehicle::Vehicle;

/// Changes of the map in a drive.
pub(super) const N_CHANGES: usize = 5;
/// Place of the first block on the first path, and the distance to each next one, as shares of its
/// length.
const FIRST_SHARE: f64 = 0.3;
const NEXT_SHARE: f64 = 0.14;
/// Largest distance of a block's center from the path, vehicle widths.
const ASIDE_WIDTHS: f64 = 1.0;
/// Sides of a block, vehicle widths.
const SIDES_WIDTHS: (f64, f64) = (0.3, 0.8);

/// A block that appears: its region, and the values of its cells before.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) region: CellRegion,
    pub(super) before: Vec<i8>,
}

impl Block {
    /// A block that is to appear on a map.
    pub(super) fn of(obstacles: &ObstacleMap, region: CellRegion) -> Self {
        let lethal = obstacles.lethal();
        let is_lethal = |cell: Cell| lethal.get(cell.col as usize, cell.row as usize);
        let before = region.cells();
        let before = before.map(|cell| if is_lethal(cell) { OCCUPIED } else { FREE });
        Self {
            region,
            before: before.collect(),
        }
    }

    /// The values of its cells while it stands.
    pub(super) fn values(&self) -> Vec<i8> {
        vec![OCCUPIED; self.before.len()]
    }
}

/// The blocks about a first path, drawn from a seed.
pub(super) fn regions(
    frame: &GridFrame,
    vehicle: &Vehicle,
    first: &CurvePath,
    seed: u64,
) -> Vec<CellRegion> {
    let place = |i: usize| {
        let mut stream = Seed(seed).stream([i as u64, 1]);
        let share = FIRST_SHARE + NEXT_SHARE * i as f64;
        let pose = first.pose_at(share * first.length_m());
        let aside_m = ASIDE_WIDTHS * vehicle.width_m() * stream.range(-1.0, 1.0);
        let side_m = vehicle.width_m() * stream.range(SIDES_WIDTHS.0, SIDES_WIDTHS.1);
        region(frame, pose.compose(Pose2::new(0.0, aside_m, 0.0)), side_m)
    };
    (0..N_CHANGES).map(place).collect()
}

/// The square of cells about a pose, as far as it lies on the map.
fn region(frame: &GridFrame, middle: Pose2, side_m: f64) -> CellRegion {
    let middle = frame.to_grid(middle);
    let n = (side_m / frame.resolution_m()).round().max(1.0);
    let range = |x: f64, n_cells: usize| {
        let low = (x / frame.resolution_m() - 0.5 * n).round();
        let clamp = |x: f64| x.clamp(0.0, n_cells as f64) as usize;
        clamp(low)..clamp(low + n)
    };
    let (cols, rows) = (
        range(middle.x, frame.n_cols()),
        range(middle.y, frame.n_rows()),
    );
    let corner = Cell::new(cols.start as u32, rows.start as u32);
    CellRegion::new(corner, cols.len(), rows.len())
}

/// A block can appear in a region that holds neither the vehicle nor its goal.
pub(super) fn can_stand(
    obstacles: &ObstacleMap,
    vehicle: &Vehicle,
    region: CellRegion,
    ends: [Pose2; 2],
) -> bool {
    let mut changed = obstacles.clone();
    let values = Block::of(obstacles, region).values();
    let body = Body::new(vehicle);
    changed.update(&region, &values).is_ok()
        && ends.into_iter().all(|pose| {
            let pose = changed.frame().to_grid(pose);
            changed.is_free(&body, &Drive::at(pose))
        })
}
