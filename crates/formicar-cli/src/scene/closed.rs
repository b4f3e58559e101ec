//! Ground that keep-out areas and maps close.

use super::args::KeepOut;
use crate::failure::note;
use anyhow::{Context, Result};
use formicar::map::format::{MapFile, ReadOptions};
use formicar::map::{GridFrame, OCCUPIED, OccupancyGrid};
use formicar::planner::KeepOutMapRecord;
use std::path::Path;

/// Closed ground, and what closes it.
#[derive(Default)]
pub(super) struct Closed {
    /// It as occupied cells of a map that is free otherwise; none where nothing closes any.
    pub(super) cells: Option<OccupancyGrid>,
    /// Corners of the areas.
    pub(super) areas: Vec<Vec<[f64; 2]>>,
    pub(super) maps: Vec<KeepOutMapRecord>,
}

impl Closed {
    pub(super) fn new(frame: &GridFrame, keep_out: &[KeepOut]) -> Result<Self> {
        let mut closed = Self::default();
        for keep_out in keep_out {
            let cells = closed
                .cells
                .get_or_insert_with(|| OccupancyGrid::free(*frame));
            match keep_out {
                KeepOut::Area(corners) => {
                    cells.fill_polygon(corners, OCCUPIED);
                    let corners = corners.iter().map(|p| [p.x, p.y]);
                    closed.areas.push(corners.collect());
                }
                KeepOut::Map(path) => closed.maps.push(close_under(cells, path)?),
            }
        }
        Ok(closed)
    }
}

fn close_under(cells: &mut OccupancyGrid, path: &Path) -> Result<KeepOutMapRecord> {
    let read = MapFile::read(path, &ReadOptions::default());
    let MapFile { grid, .. } = read.context("--keep-out")?;
    let name = path.display().to_string();
    let n_cells = cells.close_under(&grid);
    if n_cells == 0 {
        let n_occupied = grid.values().iter().filter(|value| **value == OCCUPIED);
        let hint = match n_occupied.count() {
            0 => {
                "only occupied cells (100) close ground, and it has none; graded ones are for --soft-costs"
            }
            _ => "its occupied cells lie beside the map; both origins must be in one frame",
        };
        note(&format!(
            "warning: {name}: it closes no ground; hint: {hint}"
        ));
    }
    Ok(KeepOutMapRecord { name, n_cells })
}
