//! Classes of steps: an ant chooses among those of the first class while there are any.

mod class;
mod goal_directed;
mod oblique_first;

pub use goal_directed::GoalDirected;
pub use oblique_first::ObliqueFirst;

use crate::parameters::rules;

rules! {
    /// Classes of steps. Within a class the choice is by roulette, by pheromone and heuristic.
    #[derive(Default, Eq)]
    pub enum Transition {
        /// One class.
        #[default]
        Roulette,
        /// Steps towards the goal first.
        GoalDirected(GoalDirected),
        /// Oblique steps towards the goal first.
        ObliqueFirst(ObliqueFirst),
    }
}

impl Transition {
    /// The steps of the first class, a bit each, by columns and rows from the cell to the goal.
    pub(super) fn first_class(&self, to_goal: (i64, i64)) -> u8 {
        match self {
            Self::Roulette => u8::MAX,
            Self::GoalDirected(_) => GoalDirected::first_class(to_goal),
            Self::ObliqueFirst(_) => ObliqueFirst::first_class(to_goal),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_by_the_direction_of_the_goal() {
        // The goal lies east: east, both north and south of it, and straight north and south.
        let directed = Transition::GoalDirected(GoalDirected {});
        assert_eq!(directed.first_class((5, 0)), 0b1100_0111);
        let oblique = Transition::ObliqueFirst(ObliqueFirst {});
        assert_eq!(oblique.first_class((5, 0)), 0b1000_0010);
        assert_eq!(Transition::Roulette.first_class((5, 0)), u8::MAX);
    }
}
