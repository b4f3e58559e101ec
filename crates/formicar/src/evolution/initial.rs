//! The first population: at random, or a share of it about the shortest path over cells.

use super::config::{AstarSeeded, EvolutionConfig, InitialPopulation};
use super::fitness::obstruction;
use super::problem::EvolutionProblem;
use super::reachable::ReachableCells;
use crate::geometry::Point2;
use crate::map::Cell;
use crate::numeric::{RandomStream, Seed};
use crate::smoothing::remove_redundant_nodes;

/// The polylines of the first population; each has random numbers of its own, so that those made
/// at random are the same under both rules.
pub(super) fn first_population(
    problem: &EvolutionProblem,
    config: &EvolutionConfig,
    reachable: &ReachableCells,
    seed: Seed,
) -> Vec<Vec<Cell>> {
    let seeds = Seeds::new(problem, config);
    (0..config.n_individuals)
        .map(|i| {
            let mut random = seed.stream([0, u64::from(i)]);
            match &seeds {
                Some(seeds) if i < seeds.n_seeded => seeds.line(i, reachable, &mut random),
                _ => at_random(problem, config.n_via, reachable, &mut random),
            }
        })
        .collect()
}

fn at_random(
    problem: &EvolutionProblem,
    n_via: u32,
    reachable: &ReachableCells,
    random: &mut RandomStream,
) -> Vec<Cell> {
    let via = (0..n_via).map(|_| reachable.anywhere(random));
    let from_start = std::iter::once(problem.start).chain(via);
    from_start.chain([problem.goal]).collect()
}

/// The common data of seeded individuals.
struct Seeds {
    n_seeded: u32,
    nodes: Vec<Cell>,
    noise_cells: f64,
}

impl Seeds {
    fn new(problem: &EvolutionProblem, config: &EvolutionConfig) -> Option<Self> {
        let InitialPopulation::AstarSeeded(AstarSeeded { share, noise_m }) = config.initial else {
            return None;
        };
        let (blocked, rule) = (problem.blocked(), problem.rule());
        let mut nodes = remove_redundant_nodes(blocked, rule, &problem.shortest.path);
        if nodes.len() < 2 {
            nodes = vec![problem.start, problem.goal];
        }
        let [least, most] = [config.n_via_min, config.n_via_max].map(|n| n as usize + 2);
        while nodes.len() > most {
            nodes.remove(least_needed(problem, &nodes));
        }
        while nodes.len() < least {
            split_longest(&mut nodes);
        }
        Some(Self {
            n_seeded: (share * f64::from(config.n_individuals)).round() as u32,
            nodes,
            noise_cells: noise_m / problem.resolution_m,
        })
    }

    /// The nodes, those of all individuals but the first moved where there is room.
    fn line(
        &self,
        individual: u32,
        reachable: &ReachableCells,
        random: &mut RandomStream,
    ) -> Vec<Cell> {
        let mut line = self.nodes.clone();
        if individual == 0 {
            return line;
        }
        let last = line.len() - 1;
        for cell in &mut line[1..last] {
            let place = Point2::new(f64::from(cell.col), f64::from(cell.row));
            *cell = reachable
                .near(place, self.noise_cells, random)
                .unwrap_or(*cell);
        }
        line
    }
}

/// The inner node whose removal obstructs the least of the polyline and, among equals, shortens it
/// the least.
fn least_needed(problem: &EvolutionProblem, nodes: &[Cell]) -> usize {
    let loss = |i: usize| {
        let (before, node, after) = (nodes[i - 1], nodes[i], nodes[i + 1]);
        let spared = distance(before, node) + distance(node, after) - distance(before, after);
        (obstruction(problem, before, after), spared)
    };
    let by_loss = |&a: &usize, &b: &usize| {
        let (a, b) = (loss(a), loss(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    (1..nodes.len() - 1).min_by(by_loss).unwrap_or(1)
}

/// Puts a node into the middle of the longest segment.
fn split_longest(nodes: &mut Vec<Cell>) {
    let length = |i: usize| distance(nodes[i - 1], nodes[i]);
    let by_length = |&a: &usize, &b: &usize| length(a).total_cmp(&length(b)).then(b.cmp(&a));
    let longest = (1..nodes.len()).max_by(by_length).unwrap_or(1);
    let (a, b) = (nodes[longest - 1], nodes[longest]);
    let middle = Cell::new(a.col.midpoint(b.col), a.row.midpoint(b.row));
    nodes.insert(longest, middle);
}

/// Distance between the centers of two cells, cells.
fn distance(a: Cell, b: Cell) -> f64 {
    let (dx, dy) = (a.col.abs_diff(b.col), a.row.abs_diff(b.row));
    (f64::from(dx) * f64::from(dx) + f64::from(dy) * f64::from(dy)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{BitGrid, DiagonalRule, MoveMasks};
    use crate::path::GridPath;
    use crate::search::GridSearch;

    /// Walls from alternating sides, and a way past their ends.
    fn slalom() -> (MoveMasks, GridSearch) {
        let mut walls = BitGrid::new(60, 20);
        for (i, col) in [10, 25, 40].into_iter().enumerate() {
            let rows = if i % 2 == 0 { 0..15 } else { 5..20 };
            walls.extend(rows.map(|row| Cell::new(col, row)));
        }
        let moves = MoveMasks::new(&walls, DiagonalRule::NoObstacles);
        let mut nobody = ();
        let mut limits = crate::progress::Limits::new(&mut nobody, None, None);
        let mut workspace = crate::search::AstarWorkspace::new();
        let ends = [Cell::new(0, 10), Cell::new(59, 10)];
        let found = crate::search::astar(&moves, ends[0], ends[1], &mut workspace, &mut limits);
        (moves, found.unwrap())
    }

    fn first(config: &EvolutionConfig, (moves, path): &(MoveMasks, GridSearch)) -> Vec<Vec<Cell>> {
        let problem = EvolutionProblem::new(moves, path, 0.2, [2.0, 0.7]).unwrap();
        let reachable = ReachableCells::new(
            problem.blocked(),
            problem.rule(),
            problem.start,
            &mut || true,
        );
        first_population(&problem, config, &reachable, Seed(1))
    }

    #[test]
    fn a_third_is_seeded_and_the_rest_is_that_of_ga() {
        let slalom = slalom();
        let [random, seeded] =
            [EvolutionConfig::ga(), EvolutionConfig::aga()].map(|config| first(&config, &slalom));
        assert_eq!(random.len(), 100);
        assert!(random.iter().all(|line| line.len() == 5));
        assert_eq!(random[33..], seeded[33..]);
        assert!((0..33).all(|i| random[i] != seeded[i]));
    }

    #[test]
    fn the_path_is_brought_to_the_number_of_via_points_allowed() {
        let slalom = slalom();
        let nodes = remove_redundant_nodes(slalom.0.blocked(), slalom.0.rule(), &slalom.1.path);
        let with = |n_via_min: u32, n_via_max: u32| {
            let config = EvolutionConfig {
                n_via: n_via_min,
                n_via_min,
                n_via_max,
                ..EvolutionConfig::aga()
            };
            first(&config, &slalom).swap_remove(0)
        };
        assert!((5..=8).contains(&(nodes.len() - 2)), "{nodes:?}");
        assert_eq!(with(1, 8), nodes);
        let three = with(1, 3);
        assert!(three.len() == 5 && three.iter().all(|cell| nodes.contains(cell)));
        let eight = with(8, 8);
        assert!(eight.len() == 10 && nodes.iter().all(|cell| eight.contains(cell)));
        let straight = GridSearch {
            path: GridPath {
                cells: vec![Cell::new(0, 0)],
            },
            ..GridSearch::default()
        };
        let standing = first(&EvolutionConfig::aga(), &(slalom.0, straight));
        assert_eq!(standing[0], [Cell::new(0, 0); 3]);
    }
}
