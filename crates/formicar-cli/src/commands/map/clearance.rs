//! `map clearance`: the widest body that passes between two points.

use super::args::ClearanceArgs;
use super::files;
use crate::failure::{Ending, Failure};
use crate::output::print_json;
use anyhow::{Result, bail};
use formicar::collision::ObstacleMap;
use formicar::geometry::Point2;
use formicar::map::{BitGrid, Cell, DistanceField};
use formicar::path::CurvePath;
use formicar::search::widest_passage;
use formicar::validation::{CURVATURE_TOLERANCE, judge_path};
use formicar::vehicle::Vehicle;
use serde::Serialize;
use std::io::{self, Write};

/// The document of `map clearance --json`.
#[derive(Debug, Serialize)]
struct Clearance {
    schema: &'static str,
    /// Whether the two points are connected.
    connected: bool,
    /// A disc this wide passes: twice the clearance of a point along the way, exactly measured.
    width_m: Option<f64>,
    /// No disc wider than this passes anywhere.
    limit_m: Option<f64>,
    /// The narrowest point of the passage.
    narrowest: Option<[f64; 2]>,
}

/// Carries out `map clearance`.
pub(super) fn run(args: &ClearanceArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let grid = files::read(&args.source)?.with_unknown(args.unknown);
    let obstacles = ObstacleMap::new(&grid);
    let ends = [
        end(&obstacles, "start", args.start)?,
        end(&obstacles, "goal", args.goal)?,
    ];
    let clearance = measure(&obstacles, [args.start, args.goal], ends);
    if args.json {
        print_json(out, &clearance)?;
    } else {
        explain(&clearance, out)?;
    }
    Ok(if clearance.connected {
        Ending::Done
    } else {
        Ending::NoPath
    })
}

/// The cell of an end, which must be free.
fn end(obstacles: &ObstacleMap, what: &str, point: Point2) -> Result<Cell> {
    let Some(cell) = obstacles.frame().cell_at(point) else {
        let extent = obstacles.frame().extent_m();
        bail!(
            "{what} ({}, {}) m is off the map of {:.2} x {:.2} m; hint: `map info` prints its \
             extents",
            point.x,
            point.y,
            extent.x,
            extent.y
        );
    };
    if obstacles.lethal().get(cell.col as usize, cell.row as usize) {
        bail!(
            "{what} ({}, {}) m is in an occupied cell; hint: --unknown free, if it is unknown ground",
            point.x,
            point.y
        );
    }
    Ok(cell)
}

fn measure(obstacles: &ObstacleMap, [start, goal]: [Point2; 2], ends: [Cell; 2]) -> Clearance {
    let frame = obstacles.frame();
    // The border stops a body as a wall does, so the field sees one around the map.
    let field = DistanceField::new(
        &walled(obstacles.lethal()),
        DistanceField::MAX_TRUNCATION_CELLS,
    );
    let [from, to] = ends.map(|cell| Cell::new(cell.col + 1, cell.row + 1));
    let Some(passage) = widest_passage(&field, from, to) else {
        return Clearance::none();
    };
    let inside = |cell: Cell| frame.center(Cell::new(cell.col - 1, cell.row - 1));
    let narrowest = inside(passage.narrowest);
    let mut way: Vec<Point2> = std::iter::once(start)
        .chain(passage.cells.iter().copied().map(inside))
        .chain([goal])
        .collect();
    way.dedup();
    let report = judge_path(
        obstacles,
        &Vehicle::point(),
        &CurvePath::from_polyline(&way),
        CURVATURE_TOLERANCE,
    );
    Clearance {
        schema: SCHEMA,
        connected: true,
        width_m: Some(2.0 * report.min_clearance_m),
        limit_m: passage
            .widest_disc_cells(&field)
            .map(|cells| cells * frame.resolution_m()),
        narrowest: Some([narrowest.x, narrowest.y]),
    }
}

/// The cells with one more, lethal, on every side.
fn walled(lethal: &BitGrid) -> BitGrid {
    let (n_cols, n_rows) = (lethal.n_cols() + 2, lethal.n_rows() + 2);
    let mut walled = BitGrid::new(n_cols, n_rows);
    for cell in lethal.iter() {
        walled.insert(Cell::new(cell.col + 1, cell.row + 1));
    }
    for col in 0..n_cols as u32 {
        walled.insert(Cell::new(col, 0));
        walled.insert(Cell::new(col, n_rows as u32 - 1));
    }
    for row in 0..n_rows as u32 {
        walled.insert(Cell::new(0, row));
        walled.insert(Cell::new(n_cols as u32 - 1, row));
    }
    walled
}

const SCHEMA: &str = "formicar/map-clearance/1";

impl Clearance {
    fn none() -> Self {
        Self {
            schema: SCHEMA,
            connected: false,
            width_m: None,
            limit_m: None,
            narrowest: None,
        }
    }
}

fn explain(clearance: &Clearance, out: &mut impl Write) -> io::Result<()> {
    let (Some(width_m), Some([x, y])) = (clearance.width_m, clearance.narrowest) else {
        return writeln!(
            out,
            "separated  obstacles stand between start and goal on every way"
        );
    };
    let limit = clearance
        .limit_m
        .map_or(String::new(), |m| format!(", none wider than {m:.3} m"));
    writeln!(
        out,
        "width      a disc of {width_m:.3} m passes{limit}\nnarrowest  at ({x:.2}, {y:.2})"
    )
}
