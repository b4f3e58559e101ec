//! The limits of the MAX-MIN Ant System (Stützle & Hoos 2000).

use crate::colony::cost::CellCost;
use crate::colony::generation::AntPath;
use crate::parameters::parameters;

parameters! {
    /// `tau_max` = Q / (rho F) with the cost F of the best path so far, and `tau_min` = `tau_max`
    /// (1 - p^(1/n)) / ((c - 1) p^(1/n)): with these limits a converged colony walks its best path
    /// of n steps again with probability p, where ants choose from c steps on average (Stützle &
    /// Hoos 2000, section 3.2).
    pub struct MaxMin {
        /// p: probability that a converged colony repeats its best path; 1 leaves no lower limit.
        #[range(1e-6..=1.0)]
        pub p_best: f64 = 0.05,
    }
}

impl MaxMin {
    pub(super) fn range(
        &self,
        n_choices: f64,
        lasting: f64,
        best: &AntPath<CellCost>,
    ) -> (f64, f64) {
        let high = lasting / best.cost.cost.max(f64::MIN_POSITIVE);
        let p = self.p_best.powf(1.0 / best.steps.len().max(1) as f64);
        let share = (1.0 - p) / ((n_choices - 1.0).max(1.0) * p);
        (high * share.min(1.0), high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_those_of_the_paper() {
        let best = AntPath {
            steps: vec![0; 50],
            cost: CellCost {
                cost: 50.0,
                length_cells: 50.0,
            },
        };
        let (low, high) = MaxMin::default().range(4.0, 1.0 / 0.02, &best);
        assert!((high - 1.0).abs() < 1e-12);
        let p = 0.05_f64.powf(0.02);
        assert!((low - (1.0 - p) / (3.0 * p)).abs() < 1e-12);
        let (none, _) = MaxMin { p_best: 1.0 }.range(4.0, 50.0, &best);
        assert_eq!(none, 0.0);
    }
}
