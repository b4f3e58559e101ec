//! What the targets share: a small yard with a car in it, and texts from bytes.

use formicar::collision::ObstacleMap;
use formicar::map::OccupancyGrid;
use formicar::path::CurvePath;
use formicar::validation::judge_path;
use formicar::vehicle::Vehicle;

/// Bytes as text; a target has nothing to do where they are no UTF-8.
pub fn text(bytes: &[u8]) -> Option<&str> {
    std::str::from_utf8(bytes).ok()
}

/// A yard of 12 m by 8 m with a block in it.
pub fn yard() -> OccupancyGrid {
    let row = |row: usize| match row {
        12..20 => "............................####............................",
        _ => "............................................................",
    };
    let rows: Vec<&str> = (0..40).map(row).collect();
    OccupancyGrid::from_rows(&rows, 0.2).expect("rows of one length")
}

/// The judge on a path that came from outside: it has findings or a certificate, and no panic.
pub fn judge_in_yard(path: &CurvePath) {
    let report = judge_path(&ObstacleMap::new(&yard()), &Vehicle::warehouse_amr(), path, 0.01);
    assert_eq!(report.valid, report.violations.is_empty());
}
