//! Mutations of children: a via point is moved, inserted, deleted, or smoothed.

use super::config::EvolutionConfig;
use super::reachable::ReachableCells;
use crate::geometry::Point2;
use crate::map::Cell;
use crate::numeric::RandomStream;

/// Applies each mutation to a polyline with its probability.
pub(super) fn mutate(
    line: &mut Vec<Cell>,
    config: &EvolutionConfig,
    reachable: &ReachableCells,
    random: &mut RandomStream,
) {
    let chances = &config.mutation;
    if random.unit() < chances.r#move {
        move_one(
            line,
            chances.move_reach * reachable.side_cells(),
            reachable,
            random,
        );
    }
    if random.unit() < chances.insert && n_via(line) < config.n_via_max as usize {
        insert(line, reachable, random);
    }
    if random.unit() < chances.delete && n_via(line) > config.n_via_min as usize {
        line.remove(any_via(line, random));
    }
    if random.unit() < chances.smooth {
        smooth(line, reachable, random);
    }
}

/// Moves a via point; it stays if a few draws find no free cell.
fn move_one(
    line: &mut [Cell],
    reach_cells: f64,
    reachable: &ReachableCells,
    random: &mut RandomStream,
) {
    let which = any_via(line, random);
    if let Some(cell) = reachable.near(place(line[which]), reach_cells, random) {
        line[which] = cell;
    }
}

/// Inserts a via point beside the middle of a segment, at most half its length off.
fn insert(line: &mut Vec<Cell>, reachable: &ReachableCells, random: &mut RandomStream) {
    let after = 1 + random.below(line.len() - 1);
    let (a, b) = (place(line[after - 1]), place(line[after]));
    let middle = (a + b) * 0.5;
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let reach_cells = 0.5 * (dx * dx + dy * dy).sqrt();
    if let Some(cell) = reachable.near(middle, reach_cells, random) {
        line.insert(after, cell);
    }
}

/// Moves a via point halfway to the middle between its neighbors, if that cell is reachable.
fn smooth(line: &mut [Cell], reachable: &ReachableCells, random: &mut RandomStream) {
    let which = any_via(line, random);
    let [before, here, after] = [which - 1, which, which + 1].map(|i| place(line[i]));
    let settled = before * 0.25 + here * 0.5 + after * 0.25;
    if let Some(cell) = reachable.at(settled) {
        line[which] = cell;
    }
}

fn n_via(line: &[Cell]) -> usize {
    line.len() - 2
}

/// A random via point; there is always one.
fn any_via(line: &[Cell], random: &mut RandomStream) -> usize {
    1 + random.below(n_via(line))
}

/// A cell in columns and rows.
fn place(cell: Cell) -> Point2 {
    Point2::new(f64::from(cell.col), f64::from(cell.row))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolution::Mutations;
    use crate::map::{BitGrid, DiagonalRule};
    use crate::numeric::Seed;

    fn mutated(line: &[Cell], mutation: Mutations, seed: u64) -> Vec<Cell> {
        let config = EvolutionConfig {
            n_via_max: 3,
            mutation,
            ..EvolutionConfig::ga()
        };
        let reachable = ReachableCells::new(
            &BitGrid::new(40, 20),
            DiagonalRule::NoObstacles,
            line[0],
            &mut || true,
        );
        let mut line = line.to_vec();
        mutate(
            &mut line,
            &config,
            &reachable,
            &mut Seed(seed).stream([0, 0]),
        );
        line
    }

    const NEVER: Mutations = Mutations {
        r#move: 0.0,
        insert: 0.0,
        delete: 0.0,
        smooth: 0.0,
        move_reach: 0.1,
    };

    fn line(via: &[(u32, u32)]) -> Vec<Cell> {
        let places = [&[(0, 0)], via, &[(39, 19)]].concat();
        places
            .iter()
            .map(|&(col, row)| Cell::new(col, row))
            .collect()
    }

    #[test]
    fn each_mutation_does_its_own() {
        let three = line(&[(5, 15), (20, 10), (30, 2)]);
        let differing = |a: &[Cell], b: &[Cell]| a.iter().zip(b).filter(|(a, b)| a != b).count();
        assert_eq!(mutated(&three, NEVER, 1), three);
        for seed in 0..20 {
            let moved = mutated(
                &three,
                Mutations {
                    r#move: 1.0,
                    ..NEVER
                },
                seed,
            );
            assert!(moved.len() == 5 && differing(&moved, &three) <= 1);
            let full = mutated(
                &three,
                Mutations {
                    insert: 1.0,
                    ..NEVER
                },
                seed,
            );
            assert_eq!(full, three, "three are the most");
            let fewer = mutated(
                &three,
                Mutations {
                    delete: 1.0,
                    ..NEVER
                },
                seed,
            );
            assert!(fewer.len() == 4 && fewer.iter().all(|cell| three.contains(cell)));
            let one = line(&[(5, 15)]);
            let least = mutated(
                &one,
                Mutations {
                    delete: 1.0,
                    ..NEVER
                },
                seed,
            );
            assert_eq!(least, one, "one is the least");
            let more = mutated(
                &one,
                Mutations {
                    insert: 1.0,
                    ..NEVER
                },
                seed,
            );
            assert!(more.len() == 4 && more.contains(&one[1]));
            let smooth = mutated(
                &one,
                Mutations {
                    smooth: 1.0,
                    ..NEVER
                },
                seed,
            );
            assert_eq!(smooth, line(&[(12, 12)]));
        }
    }
}
