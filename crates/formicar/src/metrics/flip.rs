//! Replans that pass an obstacle on another side, decided on the cells of a map.

use super::winding::flips;
use crate::collision::ObstacleMap;
use crate::geometry::{Point2, Pose2};
use crate::map::{Cell, CellRegion, Components, Connectivity};
use crate::path::CurvePath;

/// Heading differences, meters per radian, when looking for where the new path leaves the old one.
const METERS_PER_RAD: f64 = 1.0;
/// Paths are drawn in steps of at most so many cells.
const SPACING_CELLS: f64 = 0.5;

/// True if the new path passes some obstacle on another side than what is still ahead of the old
/// one, from the pose nearest to the start of the new one. Both in world coordinates.
///
/// Obstacles are the components of lethal cells, joined across sides and corners. One that reaches
/// out of the box about both paths, as whatever hangs together with the border does, cannot lie
/// between them; one that either path leads over is left out. Where cells have changed, give the
/// map on which both paths are free: that of the old path where obstacles have appeared. Cost is
/// proportional to the cells of the box.
pub fn flip(old: &CurvePath, new: &CurvePath, obstacles: &ObstacleMap) -> bool {
    let frame = obstacles.frame();
    let spacing_m = SPACING_CELLS * frame.resolution_m();
    let behind_m = old.nearest_m(new.start(), METERS_PER_RAD, spacing_m);
    let ahead = old.between_m(behind_m, old.length_m());
    let [old, new] = [&ahead, new].map(|path| in_cells(path, obstacles));
    let Some(region) = box_about(&[&old, &new], frame.n_cols(), frame.n_rows()) else {
        return false;
    };
    // Whole words of cells; more of them change nothing.
    let first_col = region.cols().start / 64 * 64;
    let low = Cell::new(first_col as u32, region.corner.row);
    let cells = obstacles
        .lethal()
        .window(first_col..region.cols().end, region.rows());
    let components = Components::new(&cells.complement(), Connectivity::Eight);
    let inner = inner_points(
        &components,
        (cells.n_cols(), cells.n_rows()),
        low,
        [&old, &new],
    );
    flips(&old, &new, &inner)
}

/// The positions of a path in steps, in cells from the corner of the map.
fn in_cells(path: &CurvePath, obstacles: &ObstacleMap) -> Vec<Point2> {
    let frame = obstacles.frame();
    let scale = 1.0 / frame.resolution_m();
    let samples = path.sample(SPACING_CELLS * frame.resolution_m());
    let position = |pose: Pose2| frame.to_grid(pose).position() * scale;
    samples.iter().map(|sample| position(sample.pose)).collect()
}

/// The cells about some points and those beside them, as far as a grid has them.
fn box_about(lines: &[&[Point2]], n_cols: usize, n_rows: usize) -> Option<CellRegion> {
    let points = lines.iter().copied().flatten().copied();
    let (low, high) = points.map(|p| (p, p)).reduce(|(low, high), (p, _)| {
        let low = Point2::new(low.x.min(p.x), low.y.min(p.y));
        (low, Point2::new(high.x.max(p.x), high.y.max(p.y)))
    })?;
    let range = |low: f64, high: f64, n: usize| {
        let end = (high + 2.0).clamp(0.0, n as f64) as usize;
        ((low - 1.0).max(0.0) as usize).min(end)..end
    };
    let (cols, rows) = (range(low.x, high.x, n_cols), range(low.y, high.y, n_rows));
    (!cols.is_empty() && !rows.is_empty()).then(|| CellRegion::of_ranges(&cols, &rows))
}

/// A point inside each component that neither reaches the rim of a window nor lies under a path.
fn inner_points(
    components: &Components,
    (n_cols, n_rows): (usize, usize),
    low: Cell,
    lines: [&[Point2]; 2],
) -> Vec<Point2> {
    let mut is_out = vec![false; components.n_components()];
    let mut leave_out = |col: usize, row: usize| {
        if let Some(label) = components.label(Cell::new(col as u32, row as u32)) {
            is_out[label as usize] = true;
        }
    };
    for col in 0..n_cols {
        leave_out(col, 0);
        leave_out(col, n_rows - 1);
    }
    for row in 0..n_rows {
        leave_out(0, row);
        leave_out(n_cols - 1, row);
    }
    for point in lines.into_iter().flatten() {
        let (col, row) = (point.x - f64::from(low.col), point.y - f64::from(low.row));
        let inside = (0.0..n_cols as f64).contains(&col) && (0.0..n_rows as f64).contains(&row);
        if inside {
            leave_out(col as usize, row as usize);
        }
    }
    let mut points = Vec::new();
    for cell in CellRegion::new(Cell::default(), n_cols, n_rows).cells() {
        let Some(label) = components.label(cell) else {
            continue;
        };
        if !std::mem::replace(&mut is_out[label as usize], true) {
            let middle = |i: u32, low: u32| f64::from(i + low) + 0.5;
            points.push(Point2::new(
                middle(cell.col, low.col),
                middle(cell.row, low.row),
            ));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;

    fn map() -> ObstacleMap {
        let rows = [
            "##############",
            "#............#",
            "#............#",
            "#...##.......#",
            "#...##...#...#",
            "#........##..#",
            "#............#",
            "#............#",
            "##############",
        ];
        ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 1.0).unwrap())
    }

    fn polyline(points: &[(f64, f64)]) -> CurvePath {
        let points: Vec<_> = points.iter().map(|&(x, y)| Point2::new(x, y)).collect();
        CurvePath::from_polyline(&points)
    }

    #[test]
    fn sides_of_drawn_obstacles_are_told_apart() {
        let map = map();
        let below = polyline(&[(1.5, 1.5), (12.5, 1.5)]);
        let bent = polyline(&[(1.5, 1.5), (4.0, 2.5), (12.5, 1.5)]);
        let above = polyline(&[(1.5, 1.5), (2.0, 7.5), (12.5, 7.5), (12.5, 1.5)]);
        let between = polyline(&[(1.5, 1.5), (3.0, 7.5), (7.5, 7.5), (7.5, 1.5), (12.5, 1.5)]);
        assert!(!flip(&below, &bent, &map));
        assert!(flip(&below, &above, &map));
        assert!(flip(&below, &between, &map));
        assert!(flip(&above, &between, &map));
    }

    #[test]
    fn what_was_driven_already_does_not_count() {
        let map = map();
        let old = polyline(&[(1.5, 1.5), (1.5, 7.5), (7.5, 7.5), (7.5, 1.5), (12.5, 1.5)]);
        let rest = polyline(&[(7.5, 4.0), (7.5, 2.0), (12.5, 1.5)]);
        assert!(!flip(&old, &rest, &map));
        let other = polyline(&[(7.5, 4.0), (7.5, 7.5), (12.5, 7.5), (12.5, 1.5)]);
        assert!(flip(&old, &other, &map));
    }

    #[test]
    fn an_obstacle_on_the_old_path_makes_no_flip_by_itself() {
        let rows = ["........", "........", "...#....", "........", "........"];
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 1.0).unwrap());
        let through = polyline(&[(0.5, 2.5), (7.5, 2.5)]);
        let around = polyline(&[(0.5, 2.5), (3.5, 4.5), (7.5, 2.5)]);
        assert!(!flip(&through, &around, &map));
    }
}
