//! Random scenarios through a planner and past its judge: nothing may panic, no success may be
//! uncertified, and every failure states its reason.
//!
//! A scenario is drawn from its own seed alone, so that a single one can be repeated, and nothing
//! depends on how many run at once.

mod draw;
mod examine;
mod ground;
mod report;
mod request;
mod vehicle;

pub use report::{Case, StressReport};

use crate::run::pool;
use formicar::planner::PlannerConfig;
use std::convert::Infallible;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A planner under test, and the scenarios that are drawn for it.
#[derive(Clone, Debug)]
pub struct Stress {
    /// Number of scenarios.
    pub n_scenarios: u64,
    /// Seed of the first scenario; the others follow it one by one.
    pub seed: u64,
    /// Search steps after which a scenario gives up.
    pub budget_steps: u64,
    /// Scenarios at once; at least 1.
    pub n_jobs: usize,
    /// The planner and its parameters.
    pub config: PlannerConfig,
}

impl Stress {
    /// Runs all scenarios; `on_done` hears how many are over.
    pub fn run(&self, on_done: &mut dyn FnMut(usize)) -> StressReport {
        let examine = |i: usize| self.examine(self.seed.wrapping_add(i as u64));
        let mut cases = Vec::new();
        let Ok(()) = pool::in_order(self.n_jobs, self.n_scenarios as usize, examine, |case| {
            cases.push(case);
            on_done(cases.len());
            Ok::<_, Infallible>(())
        });
        StressReport { cases }
    }

    /// Draws one scenario, plans it and examines the result.
    fn examine(&self, seed: u64) -> Case {
        let examined = AssertUnwindSafe(|| {
            let drawn = draw::Drawn::of(seed, self.budget_steps);
            examine::examine(&drawn, &self.config)
        });
        catch_unwind(examined).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
            Case::panicked(seed, text.unwrap_or("a panic without a message"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stress(n_scenarios: u64, seed: u64, n_jobs: usize) -> StressReport {
        let stress = Stress {
            n_scenarios,
            seed,
            budget_steps: 2_000,
            n_jobs,
            config: PlannerConfig::default(),
        };
        stress.run(&mut |_| ())
    }

    #[test]
    fn the_number_of_jobs_changes_nothing() {
        let (one, two) = (stress(6, 40, 1), stress(6, 40, 2));
        assert_eq!(one, two);
        assert_eq!(one.n_violations(), 0, "{:?}", one.cases);
        assert_eq!(one.cases[5], stress(1, 45, 1).cases[0]);
        assert_ne!(one.digest(), stress(6, 41, 1).digest());
    }

    #[test]
    fn scenarios_differ_in_ground_vehicle_and_request() {
        let drawn: Vec<_> = (0..60).map(|seed| draw::Drawn::of(seed, 1)).collect();
        let count = |is: &dyn Fn(&draw::Drawn) -> bool| drawn.iter().filter(|d| is(d)).count();
        for kind in ground::Kind::ALL {
            assert!(count(&|d| d.kind == kind) > 0, "{kind:?}");
        }
        assert!(count(&|d| !d.request.via.is_empty()) > 3);
        assert!(count(&|d| !d.request.other_goals.is_empty()) > 3);
        assert!(
            count(&|d| d.stands_free) > 35,
            "most scenarios can be asked"
        );
        assert!(count(&|d| d.is_sealed) > 0);
        let cells = |d: &draw::Drawn| d.map.frame().n_cells();
        assert!(drawn.iter().all(|d| cells(d) <= 200 * 200));
    }
}
