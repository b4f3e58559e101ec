//! Elitism, selection of parents, and crossover.

use super::fitness::Score;
use crate::map::Cell;
use crate::numeric::RandomStream;

/// The fittest individuals, best first, the earlier among equals.
pub(super) fn elite(scores: &[Score], n_elite: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|&a, &b| scores[a].fitness.total_cmp(&scores[b].fitness));
    order.truncate(n_elite);
    order
}

/// The fittest of a few individuals drawn at random, the earlier among equals.
pub(super) fn tournament(scores: &[Score], size: u32, random: &mut RandomStream) -> usize {
    let drawn = (0..size).map(|_| random.below(scores.len()));
    let by_fitness = |&a: &usize, &b: &usize| {
        let order = scores[a].fitness.total_cmp(&scores[b].fitness);
        order.then(a.cmp(&b))
    };
    drawn.min_by(by_fitness).unwrap_or_default()
}

/// One-point crossover: the first via points of one parent, the last of the other, as many in all
/// as the other has.
pub(super) fn crossover(first: &[Cell], second: &[Cell], random: &mut RandomStream) -> Vec<Cell> {
    let n_via = (first.len() - 2).min(second.len() - 2);
    // Where possible, the child is not a copy of one parent.
    let n_cuts = n_via - usize::from(first.len() == second.len() && n_via > 1);
    let n_first = 2 + random.below(n_cuts);
    first[..n_first]
        .iter()
        .chain(&second[n_first..])
        .copied()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Seed;

    fn line(via: &[u32]) -> Vec<Cell> {
        let ends = (Cell::new(0, 0), Cell::new(99, 0));
        let via = via.iter().map(|&col| Cell::new(col, 1));
        std::iter::once(ends.0).chain(via).chain([ends.1]).collect()
    }

    fn scores(fitness: &[f64]) -> Vec<Score> {
        let score = |&fitness: &f64| Score {
            fitness,
            ..Score::default()
        };
        fitness.iter().map(score).collect()
    }

    #[test]
    fn the_fittest_stay_and_win_tournaments() {
        let scores = scores(&[3.0, 1.0, 2.0, 1.0, 5.0]);
        assert_eq!(elite(&scores, 3), [1, 3, 2]);
        let mut random = Seed(1).stream([0, 0]);
        let mut n_wins = [0; 5];
        for _ in 0..10_000 {
            n_wins[tournament(&scores, 3, &mut random)] += 1;
        }
        // The worst wins where it is drawn three times, the best unless it is never drawn.
        assert!((50..120).contains(&n_wins[4]), "{n_wins:?}");
        assert!((4_600..5_200).contains(&n_wins[1]), "{n_wins:?}");
        assert!((2_700..3_300).contains(&n_wins[3]), "{n_wins:?}");
    }

    #[test]
    fn children_have_the_head_of_one_parent_and_the_tail_of_the_other() {
        let (first, second) = (line(&[10, 20, 30]), line(&[11, 21, 31]));
        let mut random = Seed(1).stream([0, 0]);
        let mut seen = [false; 2];
        for _ in 0..50 {
            let child = crossover(&first, &second, &mut random);
            let early = child == line(&[10, 21, 31]);
            assert!(early || child == line(&[10, 20, 31]), "{child:?}");
            seen[usize::from(early)] = true;
        }
        assert_eq!(seen, [true; 2]);
        let short = line(&[12]);
        assert_eq!(crossover(&short, &second, &mut random), line(&[12, 21, 31]));
        assert_eq!(crossover(&second, &short, &mut random), line(&[11]));
    }
}
