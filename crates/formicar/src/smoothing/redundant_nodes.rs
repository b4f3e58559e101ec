//! Removal of redundant nodes from a grid path (Lei & Zheng 2020, sec. III.A).

use crate::map::{BitGrid, Cell, DiagonalRule, cells_in_sight};
use crate::parameters::Parameters;
use crate::path::GridPath;

/// The nodes of a grid path that stay before its corners are rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum RedundantNodes {
    /// All of them.
    Keep,
    /// Those where the direction changes.
    Collinear,
    /// Those whose neighbors do not see each other (Lei 2020, sec. III.A).
    #[default]
    Remove,
}

impl Parameters for RedundantNodes {}

impl RedundantNodes {
    /// The nodes of a path that stay, its ends always among them.
    pub fn apply(self, blocked: &BitGrid, rule: DiagonalRule, path: &GridPath) -> Vec<Cell> {
        match self {
            Self::Keep => path.cells.clone(),
            Self::Collinear => thinned(&path.cells, goes_straight_on),
            Self::Remove => remove_redundant_nodes(blocked, rule, path),
        }
    }
}

/// The nodes of a path without those that are redundant.
///
/// A node is dropped where the path goes straight on, and where its two neighbors see each other:
/// the segment between their centers, Lei 2020 (4) and (5), touches no blocked cell, corner contact
/// judged by the diagonal rule. Passes from start to goal are repeated until nothing changes, so
/// that a second call changes nothing. The path never grows longer. Of a path whose steps the rule
/// allows, every segment of the result is in sight.
pub fn remove_redundant_nodes(blocked: &BitGrid, rule: DiagonalRule, path: &GridPath) -> Vec<Cell> {
    let mut nodes = thinned(&path.cells, goes_straight_on);
    loop {
        let fewer = thinned(&nodes, |before, node, after| {
            goes_straight_on(before, node, after) || cells_in_sight(blocked, rule, before, after)
        });
        if fewer.len() == nodes.len() {
            return nodes;
        }
        nodes = fewer;
    }
}

/// One pass from start to goal: drops nodes that are redundant between the last one kept and the
/// next one.
fn thinned(nodes: &[Cell], is_redundant: impl Fn(Cell, Cell, Cell) -> bool) -> Vec<Cell> {
    let mut kept: Vec<Cell> = nodes.first().copied().into_iter().collect();
    for pair in nodes.windows(2).skip(1) {
        let before = kept[kept.len() - 1];
        if !is_redundant(before, pair[0], pair[1]) {
            kept.push(pair[0]);
        }
    }
    if nodes.len() > 1 {
        kept.extend(nodes.last());
    }
    kept
}

/// Whether three nodes lie in this order on one line.
fn goes_straight_on(before: Cell, node: Cell, after: Cell) -> bool {
    let step = |from: Cell, to: Cell| {
        (
            i64::from(to.col) - i64::from(from.col),
            i64::from(to.row) - i64::from(from.row),
        )
    };
    let (arriving, leaving) = (step(before, node), step(node, after));
    arriving.0 * leaving.1 == arriving.1 * leaving.0
        && arriving.0 * leaving.0 + arriving.1 * leaving.1 >= 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{MoveMasks, OccupancyGrid, STEPS};
    use proptest::prelude::*;

    fn cells(pairs: &[(u32, u32)]) -> Vec<Cell> {
        pairs
            .iter()
            .map(|&(col, row)| Cell::new(col, row))
            .collect()
    }

    fn blocked(rows: &[&str]) -> BitGrid {
        OccupancyGrid::from_rows(rows, 1.0).unwrap().lethal_cells()
    }

    fn length(nodes: &[Cell]) -> f64 {
        let apart = |a: Cell, b: Cell| {
            f64::from(a.col.abs_diff(b.col)).hypot(f64::from(a.row.abs_diff(b.row)))
        };
        nodes.windows(2).map(|w| apart(w[0], w[1])).sum()
    }

    #[test]
    fn keeps_the_node_at_the_obstacle_alone() {
        let map = blocked(&[
            ".....", //
            "..##.", "..##.", ".....",
        ]);
        let path = GridPath {
            cells: cells(&[
                (0, 0),
                (1, 0),
                (2, 0),
                (3, 0),
                (4, 0),
                (4, 1),
                (4, 2),
                (4, 3),
            ]),
        };
        let apply = |which: RedundantNodes| which.apply(&map, DiagonalRule::NoObstacles, &path);
        assert_eq!(apply(RedundantNodes::Keep), path.cells);
        let bends = cells(&[(0, 0), (4, 0), (4, 3)]);
        assert_eq!(apply(RedundantNodes::Collinear), bends);
        assert_eq!(apply(RedundantNodes::Remove), bends);
        let free = BitGrid::new(5, 4);
        let straight = remove_redundant_nodes(&free, DiagonalRule::NoObstacles, &path);
        assert_eq!(straight, cells(&[(0, 0), (4, 3)]));
    }

    #[test]
    fn paths_of_few_cells_stay() {
        let map = BitGrid::new(3, 3);
        for n in 0..3 {
            let path = GridPath {
                cells: cells(&[(0, 0), (1, 1)])[..n].to_vec(),
            };
            let kept = remove_redundant_nodes(&map, DiagonalRule::Always, &path);
            assert_eq!(kept, path.cells);
        }
    }

    /// A walk over allowed steps, as an ant without any sense would take it.
    fn walk(moves: &MoveMasks, start: Cell, choices: &[usize]) -> GridPath {
        let mut walked = vec![start];
        for &choice in choices {
            let from = walked[walked.len() - 1];
            let steps: Vec<usize> = (0..8).filter(|i| moves.moves(from) >> i & 1 == 1).collect();
            if steps.is_empty() {
                break;
            }
            let (dx, dy) = STEPS[steps[choice % steps.len()]];
            walked.push(Cell::new(
                from.col.wrapping_add_signed(dx),
                from.row.wrapping_add_signed(dy),
            ));
        }
        GridPath { cells: walked }
    }

    proptest! {
        #[test]
        fn what_is_left_is_in_sight_no_longer_and_final(
            bits in prop::collection::vec(prop::bool::weighted(0.25), 144),
            start in 0_u32..144,
            choices in prop::collection::vec(0_usize..8, 1..60),
        ) {
            let mut map = BitGrid::new(12, 12);
            let set = (0..144).filter(|&i| bits[i as usize] && i != start);
            set.for_each(|i| map.insert(Cell::new(i % 12, i / 12)));
            for rule in [DiagonalRule::Always, DiagonalRule::AtMostOneObstacle, DiagonalRule::NoObstacles] {
                let moves = MoveMasks::new(&map, rule);
                let path = walk(&moves, Cell::new(start % 12, start / 12), &choices);
                let kept = remove_redundant_nodes(&map, rule, &path);
                prop_assert_eq!((kept.first(), kept.last()), (path.cells.first(), path.cells.last()));
                prop_assert!(kept.windows(2).all(|w| cells_in_sight(&map, rule, w[0], w[1])));
                prop_assert!(kept.windows(3).all(|w| !cells_in_sight(&map, rule, w[0], w[2])));
                prop_assert!(length(&kept) <= length(&path.cells) + 1e-9);
                let again = GridPath { cells: kept.clone() };
                prop_assert_eq!(remove_redundant_nodes(&map, rule, &again), kept);
            }
        }
    }
}
