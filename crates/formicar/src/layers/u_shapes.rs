//! U-shapes are closed where no distance changes (Lei 2020, sec. II.C, convex polygon detection).

use super::closing::{Closing, OpenPocket};
use super::pocket_fate::PocketFate;
use super::pockets::Pockets;
use crate::map::{BitGrid, Cell, DiagonalRule};

/// The free cells between an obstacle and its convex hull, or a part of them, and their fate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pocket {
    /// Its first cell in row-major order.
    pub first: Cell,
    /// Number of its cells.
    pub n_cells: usize,
    /// Number of cells that were closed.
    pub n_closed: usize,
    /// Its fate, and the reason.
    pub fate: PocketFate,
}

/// Closes pockets, the largest first; returns the closed cells and all pockets.
///
/// No distance between cells outside of pockets changes. The ends are open cells. Every pocket
/// `goes_on` is asked whether to go on; where not, the result is of no use.
pub(super) fn close_u_shapes(
    blocked: &BitGrid,
    ends: &[Cell],
    rule: DiagonalRule,
    goes_on: &mut dyn FnMut() -> bool,
) -> (BitGrid, Vec<Pocket>) {
    let mut closing = Closing::new(blocked, rule);
    let mut closed = BitGrid::new(blocked.n_cols(), blocked.n_rows());
    let mut record = Vec::new();
    for runs in Pockets::find(blocked, goes_on).largest_first() {
        if !goes_on() {
            break;
        }
        // None if all of it was closed with larger ones.
        let Some(pocket) = OpenPocket::new(&runs, closing.blocked()) else {
            continue;
        };
        let holds = |&end: &Cell| runs.iter().any(|run| run.contains(end));
        let (fate, cells) = if ends.iter().any(holds) {
            (PocketFate::HoldsEnd, Vec::new())
        } else {
            closing.try_close(&pocket)
        };
        record.push(Pocket {
            first: pocket.cells[0],
            n_cells: pocket.cells.len(),
            n_closed: cells.len(),
            fate,
        });
        closed.extend(cells);
    }
    (closed, record)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layers::pockets::Run;
    use crate::map::{MoveMasks, OccupancyGrid, STEP_COSTS, set_bits};
    use proptest::prelude::*;

    const ALWAYS: DiagonalRule = DiagonalRule::Always;
    const ONE: DiagonalRule = DiagonalRule::AtMostOneObstacle;
    const NONE: DiagonalRule = DiagonalRule::NoObstacles;
    const RULES: [DiagonalRule; 3] = [ALWAYS, ONE, NONE];

    /// The fates of the pockets of a map, the largest first; checks that the closed cells are those
    /// drawn as `x`. The ends are drawn as `o`.
    fn fates(rows: &[&str], rule: DiagonalRule) -> Vec<PocketFate> {
        let map = OccupancyGrid::from_rows(rows, 1.0).unwrap();
        let drawn = |wanted: char| -> Vec<Cell> {
            let rows = rows.iter().rev().zip(0..);
            let cells = rows.flat_map(|(row, y)| row.chars().zip((0..).map(move |x| (x, y))));
            let cells = cells.filter(|(c, _)| *c == wanted);
            cells.map(|(_, (x, y))| Cell::new(x, y)).collect()
        };
        let (closed, pockets) =
            close_u_shapes(&map.lethal_cells(), &drawn('o'), rule, &mut || true);
        assert_eq!(closed.iter().collect::<Vec<_>>(), drawn('x'), "{rule:?}");
        pockets.iter().map(|pocket| pocket.fate).collect()
    }

    #[test]
    fn a_u_between_start_and_goal_is_closed() {
        for rule in RULES {
            let rows = [
                "...........",
                "..#xxxxx#..",
                "o.#xxxxx#.o",
                "..#xxxxx#..",
                "..#######..",
                "...........",
            ];
            assert_eq!(fates(&rows, rule), [PocketFate::Closed]);
        }
    }

    #[test]
    fn a_slanted_mouth_is_closed_but_for_what_diagonal_steps_need() {
        let rows = [
            "..........",
            ".#........",
            ".#xx......",
            ".#xxxx....",
            ".#xxxxxx#.",
            ".########.",
            "..........",
        ];
        assert_eq!(fates(&rows, ALWAYS), [PocketFate::Closed]);
        assert_eq!(fates(&rows, ONE), [PocketFate::Closed]);
        let rows = [
            "..........",
            ".#........",
            ".#x.......",
            ".#xxx.....",
            ".#xxxxxx#.",
            ".########.",
            "..........",
        ];
        assert_eq!(fates(&rows, NONE), [PocketFate::Closed]);
    }

    #[test]
    fn a_u_that_holds_the_goal_stays_open() {
        for rule in RULES {
            let rows = ["o......", ".#...#.", ".#.o.#.", ".#####.", "......."];
            assert_eq!(fates(&rows, rule), [PocketFate::HoldsEnd]);
        }
    }

    #[test]
    fn a_u_through_which_the_way_leads_stays_open() {
        for rule in RULES {
            // Without it one would have to go around below.
            let around = [
                "....#....",
                "....#....",
                ".#..#..#.",
                ".#.....#.",
                ".#.....#.",
                ".#######.",
                ".........",
            ];
            assert_eq!(fates(&around, rule), [PocketFate::WouldHarm]);
            // Or there would be no way at all.
            assert_eq!(fates(&around[..6], rule), [PocketFate::WouldHarm]);
        }
    }

    #[test]
    fn a_ring_stays_open_inside() {
        for rule in RULES {
            let rows = [
                ".......", ".#####.", ".#...#.", ".#...#.", ".#####.", ".......",
            ];
            assert_eq!(fates(&rows, rule), [PocketFate::NoMouth]);
        }
        // Where obstacles meet only in corners the rule says whether anything leads in.
        let diamond = ["..#..", ".#.#.", "..#.."];
        assert_eq!(fates(&diamond, ALWAYS), [PocketFate::WouldHarm]);
        assert_eq!(fates(&diamond, ONE), [PocketFate::NoMouth]);
        assert_eq!(fates(&diamond, NONE), [PocketFate::NoMouth]);
    }

    #[test]
    fn a_u_in_a_u_is_closed_with_it() {
        for rule in RULES {
            let rows = [
                "...........",
                ".#xxxxxxx#.",
                ".#xx#x#xx#.",
                ".#xx###xx#.",
                ".#xxxxxxx#.",
                ".#########.",
                "...........",
            ];
            assert_eq!(fates(&rows, rule), [PocketFate::Closed]);
        }
    }

    fn random_map(n_cols: usize, density: f64, draws: &[f64]) -> BitGrid {
        let mut map = BitGrid::new(n_cols, draws.len() / n_cols);
        let n_cells = n_cols * map.n_rows();
        for (i, _) in draws[..n_cells]
            .iter()
            .enumerate()
            .filter(|(_, draw)| **draw < density)
        {
            map.insert(Cell::new((i % n_cols) as u32, (i / n_cols) as u32));
        }
        map
    }

    /// Costs of the shortest ways from a cell, by relaxing all steps until nothing changes.
    fn costs_from(cell: Cell, blocked: &BitGrid, rule: DiagonalRule) -> Vec<u32> {
        let moves = MoveMasks::new(blocked, rule);
        let mut costs = vec![u32::MAX; moves.as_slice().len()];
        costs[moves.index(cell)] = 0;
        let mut before = Vec::new();
        while costs != before {
            before.clone_from(&costs);
            for (i, &mask) in moves.as_slice().iter().enumerate() {
                for step in set_bits(mask.into()).map(|step| step as usize) {
                    let next = i.wrapping_add_signed(moves.offsets()[step]);
                    costs[next] = costs[next].min(costs[i].saturating_add(STEP_COSTS[step]));
                }
            }
        }
        costs
    }

    proptest! {
        #[test]
        fn no_way_becomes_longer_or_is_cut(
            n_cols in 4_usize..20,
            density in 0.05_f64..0.6,
            draws in prop::collection::vec(0.0_f64..1.0, 20..300),
            ends in any::<[prop::sample::Index; 2]>(),
            rule in prop::sample::select(&RULES[..]),
        ) {
            let blocked = random_map(n_cols, density, &draws);
            let free: Vec<Cell> = blocked.complement().iter().collect();
            prop_assume!(!free.is_empty());
            let [start, goal] = ends.map(|end| free[end.index(free.len())]);
            let (closed, pockets) = close_u_shapes(&blocked, &[start, goal], rule, &mut || true);
            let n_closed: usize = pockets.iter().map(|pocket| pocket.n_closed).sum();
            prop_assert_eq!(closed.count(), n_closed);

            let mut after = blocked.clone();
            after.unite(&closed);
            prop_assert_eq!(after.count(), blocked.count() + n_closed);
            let (before, after) = (costs_from(start, &blocked, rule), costs_from(start, &after, rule));
            let mut in_pocket = BitGrid::new(n_cols, blocked.n_rows());
            let runs = Pockets::find(&blocked, &mut || true).largest_first().flatten();
            in_pocket.extend(runs.flat_map(Run::cells));
            in_pocket.remove(goal);
            for cell in in_pocket.complement().iter() {
                let i = cell.row as usize * n_cols + cell.col as usize;
                prop_assert_eq!(before[i], after[i], "{:?}", cell);
            }
        }
    }
}
