//! `map info`: a map in numbers.

use super::args::InfoArgs;
use super::files;
use crate::failure::{Ending, Failure};
use crate::output::print_json;
use crate::scene::Loaded;
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::{Point2, Pose2};
use formicar::map::UNKNOWN;
use formicar::map::{Cell, Components, Connectivity, DistanceField, FREE, GridFrame, OCCUPIED};
use formicar::vehicle::Vehicle;
use serde::Serialize;
use std::io::{self, Write};

/// The document of `map info --json`.
#[derive(Debug, Serialize)]
struct Info {
    schema: &'static str,
    map: String,
    n_cols: usize,
    n_rows: usize,
    resolution_m: f64,
    /// World pose of the lower left corner: x m, y m, yaw rad.
    origin: [f64; 3],
    /// Along the map's own axes.
    size_m: [f64; 2],
    /// The lowest and the highest world coordinates on the map.
    extents_m: [[f64; 2]; 2],
    n_free: usize,
    n_occupied: usize,
    n_unknown: usize,
    /// Cells between free and occupied; they do not block.
    n_graded: usize,
    /// Parts that hang together over the sides of cells that do not block.
    n_components: usize,
    largest_component_cells: u32,
    largest_component_m2: f64,
    /// The place farthest from obstacles and border, among cell centers.
    widest: Option<Widest>,
    /// Doubts about the file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

/// A place and its distance from everything.
#[derive(Debug, Serialize)]
struct Widest {
    x: f64,
    y: f64,
    clearance_m: f64,
}

/// Carries out `map info`.
pub(super) fn run(args: &InfoArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let loaded = files::load(&args.source)?;
    let info = describe(loaded, args);
    if args.json {
        print_json(out, &info)?;
    } else {
        explain(&info, out)?;
    }
    Ok(Ending::Done)
}

fn describe(loaded: Loaded, args: &InfoArgs) -> Info {
    let grid = loaded.map;
    let frame = *grid.frame();
    let count = |value: i8| grid.values().iter().filter(|v| **v == value).count();
    let [n_free, n_occupied, n_unknown] = [FREE, OCCUPIED, UNKNOWN].map(count);
    let obstacles = ObstacleMap::new(&grid.with_unknown(args.unknown));
    let components = Components::new(obstacles.lethal(), Connectivity::Four);
    let largest = components.largest();
    let largest_component_cells = largest.map_or(0, |i| components.sizes()[i as usize]);
    let (origin, extent) = (frame.origin(), frame.extent_m());
    Info {
        schema: "formicar/map-info/1",
        map: args.source.map.clone(),
        n_cols: frame.n_cols(),
        n_rows: frame.n_rows(),
        resolution_m: frame.resolution_m(),
        origin: [origin.x, origin.y, origin.heading],
        size_m: [extent.x, extent.y],
        extents_m: extents_m(&frame),
        n_free,
        n_occupied,
        n_unknown,
        n_graded: frame.n_cells() - n_free - n_occupied - n_unknown,
        n_components: components.n_components(),
        largest_component_cells,
        largest_component_m2: f64::from(largest_component_cells) * frame.resolution_m().powi(2),
        widest: widest(&obstacles),
        warnings: loaded.warnings,
    }
}

/// Bounds of the four corners, which a yaw turns.
fn extents_m(frame: &GridFrame) -> [[f64; 2]; 2] {
    let extent = frame.extent_m();
    let corners = [
        (0.0, 0.0),
        (extent.x, 0.0),
        (0.0, extent.y),
        (extent.x, extent.y),
    ];
    let corners = corners.map(|(x, y)| frame.to_world(Pose2::new(x, y, 0.0)));
    let bounds = |of: fn(&Pose2) -> f64| {
        let values = corners.iter().map(of);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
            [low.min(v), high.max(v)]
        })
    };
    let ([x_low, x_high], [y_low, y_high]) = (bounds(|p| p.x), bounds(|p| p.y));
    [[x_low, y_low], [x_high, y_high]]
}

/// The cell center with the most room, exactly measured.
fn widest(obstacles: &ObstacleMap) -> Option<Widest> {
    let frame = obstacles.frame();
    let field = DistanceField::new(obstacles.lethal(), DistanceField::MAX_TRUNCATION_CELLS);
    let room = |cell: &Cell| {
        let (col, row) = (cell.col as usize, cell.row as usize);
        let to_border = col
            .min(row)
            .min(frame.n_cols() - 1 - col)
            .min(frame.n_rows() - 1 - row);
        // The border is a line; of an obstacle cell the nearer side counts.
        field.distance_cells(*cell).min(to_border as f64 + 1.0)
    };
    let cells = (0..frame.n_cells()).map(|i| frame.cell(i));
    let free = cells.filter(|cell| field.distance_cells(*cell) > 0.0);
    let cell = free.max_by(|a, b| room(a).total_cmp(&room(b)))?;
    let center: Point2 = frame.center(cell);
    let pose = frame.to_grid(Pose2::at(center, 0.0));
    Some(Widest {
        x: center.x,
        y: center.y,
        clearance_m: obstacles.clearance_m(&Body::new(&Vehicle::point()), pose),
    })
}

fn explain(info: &Info, out: &mut impl Write) -> io::Result<()> {
    let n_cells = info.n_cols * info.n_rows;
    let share = |n: usize| format!("{n} ({:.1} %)", 100.0 * n as f64 / n_cells as f64);
    let [width_m, height_m] = info.size_m;
    let [x, y, yaw] = info.origin;
    let [[x_low, y_low], [x_high, y_high]] = info.extents_m;
    writeln!(
        out,
        "size        {} x {} cells of {} m: {width_m:.2} x {height_m:.2} m",
        info.n_cols, info.n_rows, info.resolution_m
    )?;
    writeln!(out, "origin      ({x}, {y}) m, yaw {yaw} rad")?;
    writeln!(
        out,
        "extents     x {x_low:.2} to {x_high:.2} m, y {y_low:.2} to {y_high:.2} m"
    )?;
    writeln!(
        out,
        "cells       free {}, occupied {}, unknown {}, graded {}",
        share(info.n_free),
        share(info.n_occupied),
        share(info.n_unknown),
        share(info.n_graded)
    )?;
    writeln!(
        out,
        "components  {}; the largest has {} cells, {:.1} m2",
        info.n_components, info.largest_component_cells, info.largest_component_m2
    )?;
    match &info.widest {
        Some(widest) => writeln!(
            out,
            "widest      {:.2} m from everything at ({:.2}, {:.2})",
            widest.clearance_m, widest.x, widest.y
        ),
        None => writeln!(out, "widest      nowhere: no cell is free"),
    }?;
    for warning in &info.warnings {
        writeln!(out, "warning     {warning}")?;
    }
    Ok(())
}
