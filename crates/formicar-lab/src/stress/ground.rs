//! Random maps for a vehicle of a size: open, strewn, in corridors, rooms and mazes.

use crate::words::named;
use formicar::geometry::Pose2;
use formicar::map::generate::{ScatterParameters, scattered_obstacles};
use formicar::map::{Cell, FREE, GridFrame, OCCUPIED, OccupancyGrid, UNKNOWN};
use formicar::numeric::{RandomStream, Seed};
use std::f64::consts::PI;

/// Longest side of a map, cells.
const MAX_SIDE: usize = 200;
/// Shortest side of a map, cells.
const MIN_SIDE: usize = 24;

named! {
    /// The kind of a map.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(super) enum Kind {
        Open = "open",
        Strewn = "strewn",
        Corridors = "corridors",
        Rooms = "rooms",
        Maze = "maze",
    }
}

/// A map of a kind, at a resolution and with ways that suit a vehicle of that length and width.
pub(super) fn draw(
    kind: Kind,
    [length_m, width_m]: [f64; 2],
    random: &mut RandomStream,
) -> OccupancyGrid {
    // Coarse and fine beside the vehicle, and never so coarse that it is smaller than two cells.
    let resolution_m = length_m / random.range(4.0, 24.0);
    let mut side = || MIN_SIDE + random.below(MAX_SIDE + 1 - MIN_SIDE);
    let (n_cols, n_rows) = (side(), side());
    let frame = frame(n_cols, n_rows, resolution_m, random);
    let way_cells = (random.range(1.2, 4.5) * width_m / resolution_m).ceil() as usize;
    let mut map = OccupancyGrid::free(frame);
    match kind {
        Kind::Open => {}
        Kind::Strewn => map = strewn(frame, random),
        Kind::Corridors => corridors(&mut map, way_cells, random),
        Kind::Rooms => rooms(&mut map, way_cells, random),
        Kind::Maze => maze(&mut map, way_cells, random),
    }
    if random.below(4) == 0 {
        spots(&mut map, UNKNOWN, random);
    }
    if random.below(4) == 0 {
        spots(&mut map, OCCUPIED, random);
    }
    map
}

fn frame(n_cols: usize, n_rows: usize, resolution_m: f64, random: &mut RandomStream) -> GridFrame {
    let origin = match random.below(3) {
        0 => Pose2::new(0.0, 0.0, 0.0),
        1 => Pose2::new(random.range(-50.0, 50.0), random.range(-50.0, 50.0), 0.0),
        _ => Pose2::new(
            random.range(-9.0, 9.0),
            random.range(-9.0, 9.0),
            random.range(-PI, PI),
        ),
    };
    GridFrame::new(n_cols, n_rows, resolution_m, origin).expect("sizes and origin are in range")
}

/// Rectangles, from a few large ones to many small ones.
fn strewn(frame: GridFrame, random: &mut RandomStream) -> OccupancyGrid {
    let parameters = ScatterParameters {
        n_cols: frame.n_cols(),
        n_rows: frame.n_rows(),
        resolution_m: frame.resolution_m(),
        density: random.range(0.005, 0.3),
        max_obstacle_cells: 1 + random.below(30),
    };
    let strewn = scattered_obstacles(&parameters, Seed(random.next_u64()));
    let values = strewn.expect("parameters are in range").values().to_vec();
    OccupancyGrid::new(frame, values).expect("as many values as cells")
}

/// Walls across the map, each with a door or two.
fn corridors(map: &mut OccupancyGrid, way_cells: usize, random: &mut RandomStream) {
    let along_rows = random.below(2) == 0;
    let (n_across, n_along) = sides(map, along_rows);
    let spacing = way_cells + 1 + random.below(2 * way_cells + 1);
    for wall in (spacing..n_across).step_by(spacing + 1) {
        let doors: Vec<usize> = (0..=random.below(2))
            .map(|_| random.below(n_along))
            .collect();
        let is_door = |i: usize| {
            doors
                .iter()
                .any(|&door| (door..door + way_cells).contains(&i))
        };
        for i in (0..n_along).filter(|&i| !is_door(i)) {
            set(map, along_rows, (wall, i), OCCUPIED);
        }
    }
}

/// A lattice of walls, a door in most of their pieces.
fn rooms(map: &mut OccupancyGrid, way_cells: usize, random: &mut RandomStream) {
    let room = 2 * way_cells + random.below(3 * way_cells + 1);
    for along_rows in [true, false] {
        let (n_across, n_along) = sides(map, along_rows);
        for wall in (room..n_across).step_by(room + 1) {
            for piece in (0..n_along).step_by(room + 1) {
                let door = random.below(room + 1);
                let width = if random.below(5) == 0 { 0 } else { way_cells };
                for i in (0..=room).filter(|i| !(door..door + width).contains(i)) {
                    set(map, along_rows, (wall, piece + i), OCCUPIED);
                }
            }
        }
    }
}

/// Ways of one width, walls of one cell: a spanning tree grown depth first, then a few walls less.
fn maze(map: &mut OccupancyGrid, way_cells: usize, random: &mut RandomStream) {
    let pitch = way_cells + 1;
    let (n_x, n_y) = (map.frame().n_cols() / pitch, map.frame().n_rows() / pitch);
    for col in 0..map.frame().n_cols() {
        for row in 0..map.frame().n_rows() {
            if col % pitch == way_cells || row % pitch == way_cells {
                map.set(Cell::new(col as u32, row as u32), OCCUPIED);
            }
        }
    }
    if n_x == 0 || n_y == 0 {
        return;
    }
    let mut seen = vec![false; n_x * n_y];
    let mut trail = vec![(0, 0)];
    seen[0] = true;
    while let Some(&(x, y)) = trail.last() {
        let mut next = neighbors((x, y), (n_x, n_y));
        next.retain(|&(x, y)| !seen[y * n_x + x]);
        if next.is_empty() {
            trail.pop();
            continue;
        }
        let to = next[random.below(next.len())];
        seen[to.1 * n_x + to.0] = true;
        open_wall(map, way_cells, [(x, y), to]);
        trail.push(to);
    }
    for _ in 0..n_x * n_y / 8 {
        let at = (random.below(n_x), random.below(n_y));
        let next = neighbors(at, (n_x, n_y));
        if !next.is_empty() {
            open_wall(map, way_cells, [at, next[random.below(next.len())]]);
        }
    }
}

fn neighbors((x, y): (usize, usize), (n_x, n_y): (usize, usize)) -> Vec<(usize, usize)> {
    let mut next = Vec::new();
    if x > 0 {
        next.push((x - 1, y));
    }
    if x + 1 < n_x {
        next.push((x + 1, y));
    }
    if y > 0 {
        next.push((x, y - 1));
    }
    if y + 1 < n_y {
        next.push((x, y + 1));
    }
    next
}

/// Clears the wall between two places of a maze that are next to each other.
fn open_wall(map: &mut OccupancyGrid, way_cells: usize, [a, b]: [(usize, usize); 2]) {
    let pitch = way_cells + 1;
    let along_rows = a.0 == b.0;
    let (before, lane) = if along_rows {
        (a.1.min(b.1), a.0)
    } else {
        (a.0.min(b.0), a.1)
    };
    let wall = before * pitch + way_cells;
    for i in lane * pitch..lane * pitch + way_cells {
        set(map, along_rows, (wall, i), FREE);
    }
}

/// Cells here and there.
fn spots(map: &mut OccupancyGrid, value: i8, random: &mut RandomStream) {
    let (n_cols, n_rows) = (map.frame().n_cols(), map.frame().n_rows());
    for _ in 0..=random.below(12) {
        let cell = Cell::new(random.below(n_cols) as u32, random.below(n_rows) as u32);
        map.set(cell, value);
    }
}

/// The number of places for walls, and the length of a wall.
fn sides(map: &OccupancyGrid, along_rows: bool) -> (usize, usize) {
    let (n_cols, n_rows) = (map.frame().n_cols(), map.frame().n_rows());
    if along_rows {
        (n_rows, n_cols)
    } else {
        (n_cols, n_rows)
    }
}

/// Sets a cell of a wall; off the map, nothing.
fn set(map: &mut OccupancyGrid, along_rows: bool, (wall, i): (usize, usize), value: i8) {
    let (col, row) = if along_rows { (i, wall) } else { (wall, i) };
    if col < map.frame().n_cols() && row < map.frame().n_rows() {
        map.set(Cell::new(col as u32, row as u32), value);
    }
}
