//! Every built-in map keeps its word.

use super::entry::Source;
use super::*;
use crate::geometry::{ConvexPolygon, Point2};
use crate::map::{Cell, OccupancyGrid};
use crate::vehicle::Vehicle;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

#[test]
fn names_are_unique_and_found() {
    let unique: BTreeSet<&str> = names().into_iter().collect();
    assert_eq!(unique.len(), all().len());
    for map in all() {
        assert_eq!(BuiltinMap::by_name(map.name).unwrap().name, map.name);
        let ids: BTreeSet<&str> = map.requests.iter().map(|r| r.id).collect();
        assert!(
            !ids.is_empty() && ids.len() == map.requests.len(),
            "{}",
            map.name
        );
    }
    let message = BuiltinMap::by_name("atlantis").unwrap_err().to_string();
    assert!(message.contains("lei-map1, lei-map2"), "{message}");
    let message = all()[0].request("home").unwrap_err().to_string();
    assert!(message.contains("across"), "{message}");
}

#[test]
fn sizes_are_as_stated() {
    let sizes = [
        ("lei-map1", 21, 21, 0.5),
        ("lei-map2", 40, 40, 0.5),
        ("lei-map3", 40, 40, 0.5),
        ("wang-aisles", 20, 20, 1.0),
        ("wang-open", 20, 20, 1.0),
        ("aco20", 20, 20, 1.0),
        ("warehouse", 800, 500, 0.05),
        ("parking-lot", 600, 340, 0.1),
        ("neighborhood", 800, 500, 0.2),
        ("li-neighborhood", 800, 500, 0.2),
    ];
    for (name, n_cols, n_rows, resolution_m) in sizes {
        let grid = BuiltinMap::by_name(name).unwrap().grid();
        let frame = grid.frame();
        let size = (frame.n_cols(), frame.n_rows(), frame.resolution_m());
        assert_eq!(size, (n_cols, n_rows, resolution_m), "{name}");
    }
}

#[test]
fn starts_and_goals_stand_free_on_the_map() {
    for map in all() {
        let grid = map.grid();
        let vehicle = Vehicle::preset(map.vehicle).unwrap();
        for request in map.requests {
            for pose in [request.start, request.goal] {
                let body = vehicle.footprint().placed(pose);
                let (low, high) = body.bounds();
                let size = grid.frame().extent_m();
                let on_map = low.x >= 0.0 && low.y >= 0.0 && high.x <= size.x && high.y <= size.y;
                assert!(on_map, "{} {}: {pose:?}", map.name, request.id);
                let hit = grid
                    .lethal_cells()
                    .iter()
                    .find(|&c| touch(&body, &square(&grid, c)));
                assert_eq!(hit, None, "{} {}: {pose:?}", map.name, request.id);
            }
        }
    }
}

#[test]
fn grid_problems_are_solvable_and_marked_where_they_start_and_end() {
    for map in all().iter().filter(|m| m.kind == BuiltinKind::GridProblem) {
        let Source::Text(text, _) = map.source else {
            panic!("{} is no text", map.name)
        };
        let grid = map.grid();
        for request in map.requests {
            let [start, goal] = ends(&grid, request);
            let rows: Vec<&str> = text.lines().rev().collect();
            let letter = |c: Cell| rows[c.row as usize].as_bytes()[c.col as usize];
            assert_eq!([letter(start), letter(goal)], *b"SG", "{}", map.name);
            assert!(length(&grid, start, goal, 2).is_some(), "{}", map.name);
        }
    }
}

#[test]
fn lei_maps_have_u_shapes_and_bear_expansion() {
    for (name, n_shapes) in [("lei-map1", 2), ("lei-map2", 4), ("lei-map3", 4)] {
        let map = BuiltinMap::by_name(name).unwrap();
        let grid = map.grid();
        assert!(
            n_u_shapes(&grid) >= n_shapes,
            "{name}: {}",
            n_u_shapes(&grid)
        );
        let [start, goal] = ends(&grid, &map.requests[0]);
        let free = length(&grid, start, goal, 2).unwrap();
        let grown = length(&expanded(&grid), start, goal, 2).unwrap();
        assert!(free < grown && grown < 1.2 * free, "{name}: {free} {grown}");
    }
}

#[test]
fn wang_aisles_tempt_and_wang_open_does_not() {
    let lengths = |name| {
        let map = BuiltinMap::by_name(name).unwrap();
        let grid = map.grid();
        let [start, goal] = ends(&grid, &map.requests[0]);
        [0, 1, 2].map(|n_free| length(&grid, start, goal, n_free).unwrap())
    };
    let [squeezing, around, no_corners] = lengths("wang-aisles");
    assert!(squeezing + 3.0 < around && around < no_corners);
    let [squeezing, around, _] = lengths("wang-open");
    assert_eq!(squeezing, around);
    // Two places where only the corners of two blocks meet.
    let grid = BuiltinMap::by_name("wang-aisles").unwrap().grid();
    let lethal = |col, row| grid.is_lethal(Cell::new(col, row));
    let squares = (0..19).flat_map(|col| (0..19).map(move |row| (col, row)));
    let aisles = squares.filter(|&(c, r)| {
        let [a, b, c, d] = [
            lethal(c, r),
            lethal(c + 1, r + 1),
            lethal(c + 1, r),
            lethal(c, r + 1),
        ];
        a == b && c == d && a != c
    });
    assert_eq!(aisles.count(), 2);
}

fn ends(grid: &OccupancyGrid, request: &BuiltinRequest) -> [Cell; 2] {
    [request.start, request.goal].map(|pose| grid.frame().cell_at(pose.position()).unwrap())
}

fn square(grid: &OccupancyGrid, cell: Cell) -> ConvexPolygon {
    let side = grid.frame().resolution_m();
    let low = Point2::new(f64::from(cell.col), f64::from(cell.row)) * side;
    ConvexPolygon::rectangle(low, low + Point2::new(side, side))
}

/// Separating-axis test of two convex polygons; touching counts.
fn touch(a: &ConvexPolygon, b: &ConvexPolygon) -> bool {
    let span = |p: &ConvexPolygon, axis: Point2| {
        let shadow = p.corners().iter().map(|c| c.dot(axis));
        shadow.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
            (low.min(s), high.max(s))
        })
    };
    let separated = |axis: Point2| {
        let ((a_low, a_high), (b_low, b_high)) = (span(a, axis), span(b, axis));
        a_high < b_low || b_high < a_low
    };
    !a.edges()
        .chain(b.edges())
        .any(|(p, q)| separated((q - p).perpendicular()))
}

/// Shortest octile length in cells; a diagonal step needs `n_free` free cells among the two that
/// it passes.
fn length(grid: &OccupancyGrid, start: Cell, goal: Cell, n_free: usize) -> Option<f64> {
    let frame = grid.frame();
    let lethal = grid.lethal_cells();
    let free = |(col, row): (i64, i64)| {
        let on_map =
            col >= 0 && row >= 0 && col < frame.n_cols() as i64 && row < frame.n_rows() as i64;
        on_map && !lethal.contains(col, row)
    };
    let place = |c: Cell| (i64::from(c.col), i64::from(c.row));
    let mut best = BTreeMap::from([(place(start), 0.0)]);
    let mut open = VecDeque::from([place(start)]);
    while let Some((col, row)) = open.pop_front() {
        let here = best[&(col, row)];
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let next = (col + dx, row + dy);
            let sides = [(col + dx, row), (col, row + dy)]
                .into_iter()
                .filter(|&c| free(c));
            let is_diagonal = dx != 0 && dy != 0;
            if !free(next) || is_diagonal && sides.count() < n_free {
                continue;
            }
            let there = here + (dx as f64).hypot(dy as f64);
            if best.get(&next).is_none_or(|&known| there < known - 1e-9) {
                best.insert(next, there);
                open.push_back(next);
            }
        }
    }
    best.get(&place(goal)).copied()
}

fn expanded(grid: &OccupancyGrid) -> OccupancyGrid {
    let lethal = grid.lethal_cells();
    let mut grown = grid.clone();
    for index in 0..grid.frame().n_cells() {
        let cell = grid.frame().cell(index);
        let (col, row) = (i64::from(cell.col), i64::from(cell.row));
        if (-1..=1).any(|dx| (-1..=1).any(|dy| lethal.contains(col + dx, row + dy))) {
            grown.set(cell, crate::map::OCCUPIED);
        }
    }
    grown
}

/// Obstacles (8-connected) with at least nine free cells that have the obstacle on exactly three
/// of their four sides.
fn n_u_shapes(grid: &OccupancyGrid) -> usize {
    let lethal = grid.lethal_cells();
    let mut label = BTreeMap::new();
    for first in lethal.iter() {
        let mut open = vec![(i64::from(first.col), i64::from(first.row))];
        let id = label.len();
        while let Some((col, row)) = open.pop() {
            if !lethal.contains(col, row) || label.contains_key(&(col, row)) {
                continue;
            }
            label.insert((col, row), id);
            open.extend((-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (col + dx, row + dy))));
        }
    }
    let mut n_inside = BTreeMap::<usize, usize>::new();
    for index in 0..grid.frame().n_cells() {
        let cell = grid.frame().cell(index);
        let (col, row) = (i64::from(cell.col), i64::from(cell.row));
        let seen = |dx: i64, dy: i64| {
            (1..40).find_map(|k| label.get(&(col + k * dx, row + k * dy)).copied())
        };
        let around = [seen(1, 0), seen(-1, 0), seen(0, 1), seen(0, -1)];
        for id in around.into_iter().flatten().collect::<BTreeSet<_>>() {
            let n_sides = around.iter().filter(|&&s| s == Some(id)).count();
            if !lethal.contains(col, row) && n_sides == 3 {
                *n_inside.entry(id).or_default() += 1;
            }
        }
    }
    n_inside.values().filter(|&&n| n >= 9).count()
}
