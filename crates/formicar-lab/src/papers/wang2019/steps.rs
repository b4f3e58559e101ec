//! Allowed steps: figures 1 and 2.

use crate::report::{Block, Field, Section, Table};
use formicar::map::{BitGrid, Cell, DiagonalRule, MoveMasks, STEPS};

/// The distributions of figure 1: obstacles at the upper left (column 0, row 1) and at the lower
/// right (1, 0) of two by two cells, between which a step leads from the lower left to the upper
/// right.
const DISTRIBUTIONS: [(&str, &[(u32, u32)]); 4] = [
    ("A: none", &[]),
    ("B: one, above", &[(0, 1)]),
    ("C: one, beside", &[(1, 0)]),
    ("D: both, a narrow aisle", &[(0, 1), (1, 0)]),
];

const RULES: [(&str, DiagonalRule); 3] = [
    ("always", DiagonalRule::Always),
    (
        "at most one obstacle (paper)",
        DiagonalRule::AtMostOneObstacle,
    ),
    ("no obstacles", DiagonalRule::NoObstacles),
];

pub(super) fn section() -> Section {
    let blocks = vec![Block::Table(distributions()), Block::Table(positions())];
    Section::new("Steps past obstacles: figures 1 and 2", blocks)
}

fn distributions() -> Table {
    let caption = "Figure 1: whether a diagonal step is allowed between obstacles, by rule. The \
                   paper takes the step except in D.";
    let names = RULES.map(|(name, _)| name);
    let heading: Vec<&str> = ["obstacles"].into_iter().chain(names).collect();
    let mut table = Table::new("distributions", &heading).captioned(caption);
    for (name, obstacles) in DISTRIBUTIONS {
        let mut blocked = BitGrid::new(2, 2);
        for &(col, row) in obstacles {
            blocked.insert(Cell::new(col, row));
        }
        let word = |rule: DiagonalRule| {
            let is_allowed = neighbors(&blocked, rule, Cell::new(0, 0)).contains(&(1, 1));
            Field::words(if is_allowed { "allowed" } else { "refused" })
        };
        let words = RULES.map(|(_, rule)| word(rule));
        table.row([Field::words(name)].into_iter().chain(words).collect());
    }
    table
}

/// Neighbors on an empty map: three in a corner, five at an edge, eight within.
fn positions() -> Table {
    let caption = "Figure 2: neighbors of a cell in the nine positions on an empty map of 20 x 20.";
    let mut table = Table::new("positions", &["row", "left", "middle", "right"]).captioned(caption);
    let empty = BitGrid::new(20, 20);
    for (name, row) in [("upper", 19), ("middle", 10), ("lower", 0)] {
        let n = |col: u32| {
            let cells = neighbors(&empty, DiagonalRule::AtMostOneObstacle, Cell::new(col, row));
            Field::Number(Some(cells.len() as f64), 0)
        };
        table.row(vec![Field::words(name), n(0), n(10), n(19)]);
    }
    table
}

fn neighbors(blocked: &BitGrid, rule: DiagonalRule, cell: Cell) -> Vec<(i32, i32)> {
    let moves = MoveMasks::new(blocked, rule).moves(cell);
    let allowed = STEPS
        .iter()
        .enumerate()
        .filter(|(i, _)| moves >> i & 1 == 1);
    allowed.map(|(_, &step)| step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_differ_beside_obstacles_and_positions_in_neighbors() {
        let words = |words: [&str; 4]| words.map(Field::words).to_vec();
        let rows = distributions().rows;
        assert_eq!(rows[0], words(["A: none", "allowed", "allowed", "allowed"]));
        assert_eq!(
            rows[2][1..],
            words(["", "allowed", "allowed", "refused"])[1..]
        );
        assert_eq!(
            rows[3][1..],
            words(["", "allowed", "refused", "refused"])[1..]
        );
        let numbers = positions().rows;
        assert_eq!(numbers[0][1], Field::Number(Some(3.0), 0));
        assert_eq!(numbers[1][2], Field::Number(Some(8.0), 0));
        assert_eq!(numbers[2][2], Field::Number(Some(5.0), 0));
    }
}
