//! Branch and bound: the best pose of a scan in a large window, with proof.
//!
//! As in Hess et al. (ICRA 2016): grids that hold the greatest score of a square of cells bound all
//! translations within it, so that most of the window is never tried.

use crate::sdf::PackedSdf;
use formicar::{Point2, Pose2};

/// Scores of a map at several widths: level k holds the greatest score of 2^k x 2^k cells.
#[derive(Clone, Debug)]
pub struct ScoreGrids {
    cell_m: f64,
    /// Lowest cell, and size; all levels share them.
    low: (i32, i32),
    n_cols: usize,
    n_rows: usize,
    levels: Vec<Vec<u8>>,
}

impl ScoreGrids {
    /// Grids of cells of about `cell_m`, a whole number of the map's own cells; none where the map
    /// shows no surface.
    pub fn new(field: &PackedSdf, cell_m: f64, n_levels: usize) -> Option<Self> {
        use crate::sdf::SignedDistances;
        let resolution = field.resolution_m();
        let factor = (cell_m / resolution).round().max(1.0) as i32;
        let truncation = field.truncation_m() as f32;
        let ((x0, y0), (x1, y1)) = field.bounds()?;
        // A margin as wide as the top level, whose squares reach to the left and below.
        let margin = 1 << n_levels;
        let low = (
            x0.div_euclid(factor) - margin,
            y0.div_euclid(factor) - margin,
        );
        let n_cols = (x1.div_euclid(factor) - low.0 + 2) as usize;
        let n_rows = (y1.div_euclid(factor) - low.1 + 2) as usize;
        let mut base = vec![0_u8; n_cols * n_rows];
        for ((x, y), distance) in field.near_cells() {
            let score = (255.0 * (1.0 - distance.abs() / truncation).max(0.0)) as u8;
            let col = (x.div_euclid(factor) - low.0) as usize;
            let row = (y.div_euclid(factor) - low.1) as usize;
            let slot = &mut base[row * n_cols + col];
            *slot = (*slot).max(score);
        }
        let mut levels = vec![base];
        for level in 1..n_levels {
            let half = 1_usize << (level - 1);
            let below = &levels[level - 1];
            levels.push(doubled(below, n_cols, half));
        }
        Some(Self {
            cell_m: resolution * f64::from(factor),
            low,
            n_cols,
            n_rows,
            levels,
        })
    }

    /// Sum of the scores of places shifted by (dx, dy) cells, at a level.
    fn sum(&self, level: usize, places: &[(i32, i32)], dx: i32, dy: i32) -> u32 {
        let grid = &self.levels[level];
        let mut sum = 0_u32;
        for &(x, y) in places {
            let (col, row) = (x + dx, y + dy);
            if (col as usize) < self.n_cols && (row as usize) < self.n_rows {
                sum += u32::from(grid[row as usize * self.n_cols + col as usize]);
            }
        }
        sum
    }
}

/// The greatest of each square of twice the side: square at (x, y) covers x..x + 2 half.
fn doubled(below: &[u8], n_cols: usize, half: usize) -> Vec<u8> {
    let mut wide = below.to_vec();
    for (row, out) in below
        .chunks_exact(n_cols)
        .zip(wide.chunks_exact_mut(n_cols))
    {
        for (value, &right) in out.iter_mut().zip(row.get(half..).unwrap_or_default()) {
            *value = (*value).max(right);
        }
    }
    let mut out = wide.clone();
    for (value, &up) in out
        .iter_mut()
        .zip(wide.get(half * n_cols..).unwrap_or_default())
    {
        *value = (*value).max(up);
    }
    out
}

/// A window to search and the score that a result must reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundSearch {
    /// Center of the window, in the frame of the map.
    pub center: Pose2,
    /// Half the width of the window, meters.
    pub reach_m: f64,
    /// Half the range of headings, radians; pi for all.
    pub turn_rad: f64,
    /// Step between headings, radians.
    pub turn_step_rad: f64,
    /// Least mean score, 0 to 1.
    pub min_score: f64,
}

/// A square of translations at one heading: level, index of the heading, lowest shift.
#[derive(Clone, Copy)]
struct Node {
    bound: u32,
    level: usize,
    turn: usize,
    shift: (i32, i32),
}

impl BoundSearch {
    /// The best pose for hits in the frame of the sensor, and its score; none where no pose of the
    /// window reaches the least score. Of equal scores, the first heading and shift wins.
    pub fn run(&self, grids: &ScoreGrids, hits: &[Point2]) -> Option<(Pose2, f64)> {
        if hits.is_empty() {
            return None;
        }
        let n_turns = (self.turn_rad / self.turn_step_rad).ceil() as i32;
        let headings: Vec<f64> = (-n_turns..=n_turns)
            .map(|turn| self.center.heading + f64::from(turn) * self.turn_step_rad)
            .collect();
        let places: Vec<Vec<(i32, i32)>> = headings
            .iter()
            .map(|&heading| self.places(grids, hits, heading))
            .collect();
        let full = 255.0 * hits.len() as f64;
        let reach = (self.reach_m / grids.cell_m).ceil() as i32;
        let mut floor = (self.min_score * full).ceil().max(1.0) as u32;
        let mut open = Vec::new();
        for (turn, places) in places.iter().enumerate() {
            open.extend(roots(grids, (turn, places), reach, floor));
        }
        // Depth first, best child first; the stack's top is the best root.
        open.sort_by_key(|node| node.bound);
        let mut best: Option<Node> = None;
        while let Some(node) = open.pop() {
            if node.bound < floor {
                continue;
            }
            if node.level == 0 {
                best = Some(node);
                floor = node.bound + 1;
                continue;
            }
            let mut children = children(grids, &places[node.turn], node, floor);
            children.retain(|child| child.shift.0 <= reach && child.shift.1 <= reach);
            open.extend(children);
        }
        best.map(|node| {
            let shift = Point2::new(f64::from(node.shift.0), f64::from(node.shift.1));
            let position = self.center.position() + shift * grids.cell_m;
            let pose = Pose2::at(position, headings[node.turn]).wrapped();
            (pose, f64::from(node.bound) / full)
        })
    }

    /// The cells of the hits at a heading, at the center of the window.
    fn places(&self, grids: &ScoreGrids, hits: &[Point2], heading: f64) -> Vec<(i32, i32)> {
        let pose = Pose2::at(self.center.position(), heading);
        let (sin, cos) = heading.sin_cos();
        let scale = 1.0 / grids.cell_m;
        hits.iter()
            .map(|hit| {
                let x = (pose.x + cos * hit.x - sin * hit.y) * scale;
                let y = (pose.y + sin * hit.x + cos * hit.y) * scale;
                (
                    x.floor() as i32 - grids.low.0,
                    y.floor() as i32 - grids.low.1,
                )
            })
            .collect()
    }
}

/// The squares of the top level at a heading whose bound reaches the floor.
fn roots(
    grids: &ScoreGrids,
    (turn, places): (usize, &[(i32, i32)]),
    reach: i32,
    floor: u32,
) -> Vec<Node> {
    let level = grids.levels.len() - 1;
    let shifts = || (-reach..=reach).step_by(1 << level);
    let all = shifts().flat_map(|dy| shifts().map(move |dx| (dx, dy)));
    let nodes = all.map(|shift| Node {
        bound: grids.sum(level, places, shift.0, shift.1),
        level,
        turn,
        shift,
    });
    nodes.filter(|node| node.bound >= floor).collect()
}

fn children(grids: &ScoreGrids, places: &[(i32, i32)], node: Node, floor: u32) -> Vec<Node> {
    let level = node.level - 1;
    let half = 1 << level;
    let mut children = Vec::with_capacity(4);
    for (dx, dy) in [(half, half), (0, half), (half, 0), (0, 0)] {
        let shift = (node.shift.0 + dx, node.shift.1 + dy);
        let bound = grids.sum(level, places, shift.0, shift.1);
        if bound >= floor {
            children.push(Node {
                bound,
                level,
                shift,
                ..node
            });
        }
    }
    children.sort_by_key(|child| child.bound);
    children
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sdf::{SdfMap, Sweep, WedgeRule};
    use proptest::prelude::*;
    use std::f64::consts::PI;

    /// A scan in a room with a step in one wall.
    fn room() -> Sweep {
        let step = PI / 90.0;
        let range = |beam: usize| {
            let d = Point2::unit(-PI + step * beam as f64);
            let right = if d.y > 0.0 { 3.0 } else { 2.3 };
            let x = if d.x > 0.0 { right } else { 2.0 };
            (x / d.x.abs()).min(1.5 / d.y.abs()) as f32
        };
        Sweep {
            time_s: 0.0,
            first_angle_rad: -PI,
            angle_step_rad: step,
            ranges_m: (0..180).map(range).collect(),
        }
    }

    fn grids() -> ScoreGrids {
        let mut map = SdfMap::new(0.05, 0.15);
        let (sweep, rule) = (room(), WedgeRule::default());
        map.insert(&sweep, &sweep.lines(0.15), Pose2::new(1.0, 2.0, 0.3), &rule);
        ScoreGrids::new(&map.packed(), 0.1, 5).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20))]
        #[test]
        fn finds_what_trying_everything_finds(x in -0.9..0.9_f64, y in -0.9..0.9_f64, turn in -0.2..0.2_f64) {
            let grids = grids();
            let hits = room().thinned(0.3, 20.0);
            let search = BoundSearch {
                center: Pose2::new(1.0 + x, 2.0 + y, 0.3 + turn),
                reach_m: 1.0,
                turn_rad: 0.25,
                turn_step_rad: 0.03,
                min_score: 0.3,
            };
            let (pose, score) = search.run(&grids, &hits).unwrap();
            let mut best = 0;
            for turn in -9..=9 {
                let heading = search.center.heading + f64::from(turn) * 0.03;
                let places = search.places(&grids, &hits, heading);
                for dy in -10..=10 {
                    for dx in -10..=10 {
                        best = best.max(grids.sum(0, &places, dx, dy));
                    }
                }
            }
            prop_assert_eq!(f64::from(best) / (255.0 * hits.len() as f64), score);
            prop_assert!(pose.position().distance(Point2::new(1.0, 2.0)) < 0.2);
        }
    }

    #[test]
    fn a_window_without_a_good_pose_gives_none() {
        let search = BoundSearch {
            center: Pose2::new(30.0, 2.0, 0.3),
            reach_m: 2.0,
            turn_rad: 0.3,
            turn_step_rad: 0.03,
            min_score: 0.3,
        };
        assert_eq!(search.run(&grids(), &room().points()), None);
        assert_eq!(search.run(&grids(), &[]), None);
    }
}
