//! The results of all scenarios.

use super::draw::Drawn;
use formicar::numeric::Fnv;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The result of one scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Its seed.
    pub seed: u64,
    /// Ground, vehicle, and what was asked, in words.
    pub about: String,
    /// Its ending: a status, `refused` or `panicked`.
    pub status: String,
    /// Search steps.
    pub n_steps: u64,
    /// Hash of the path, or the reason why there is none.
    pub told: String,
    /// Violations found.
    pub violations: Vec<String>,
}

impl Case {
    pub(super) fn begin(drawn: &Drawn) -> Self {
        let frame = drawn.map.frame();
        let request = &drawn.request;
        let about = format!(
            "{}{}, {} x {} cells of {:.3} m, {}, {}, start {:?}, goal {:?}, {} goals, {} via points",
            drawn.kind.name(),
            if drawn.is_sealed { " (sealed)" } else { "" },
            frame.n_cols(),
            frame.n_rows(),
            frame.resolution_m(),
            drawn.vehicle_name,
            request.gears.name(),
            request.start_heading,
            request.goal_heading,
            1 + request.other_goals.len(),
            request.via.len(),
        );
        Self {
            seed: drawn.seed,
            about: about.to_lowercase(),
            status: String::new(),
            n_steps: 0,
            told: String::new(),
            violations: Vec::new(),
        }
    }

    pub(super) fn panicked(seed: u64, text: &str) -> Self {
        Self {
            seed,
            about: String::new(),
            status: "panicked".to_owned(),
            n_steps: 0,
            told: text.to_owned(),
            violations: vec![format!("panicked: {text}")],
        }
    }

    pub(super) fn ends_as(&mut self, status: &str, n_steps: u64, told: &str) {
        status.clone_into(&mut self.status);
        self.n_steps = n_steps;
        told.clone_into(&mut self.told);
    }

    pub(super) fn violates(&mut self, what: String) {
        self.violations.push(what);
    }
}

/// All scenarios in the order of their seeds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StressReport {
    /// The result of each.
    pub cases: Vec<Case>,
}

impl StressReport {
    /// Scenarios with something that must not be.
    pub fn violations(&self) -> impl Iterator<Item = &Case> {
        self.cases.iter().filter(|case| !case.violations.is_empty())
    }

    /// The number of scenarios with violations.
    pub fn n_violations(&self) -> usize {
        self.violations().count()
    }

    /// The number of scenarios for each ending.
    pub fn counts(&self) -> BTreeMap<&str, usize> {
        let mut counts = BTreeMap::new();
        for case in &self.cases {
            *counts.entry(case.status.as_str()).or_insert(0) += 1;
        }
        counts
    }

    /// Search steps of all scenarios.
    pub fn n_steps(&self) -> u64 {
        self.cases.iter().map(|case| case.n_steps).sum()
    }

    /// A number that any difference in any outcome changes: two runs with the same one gave the
    /// same paths and reasons.
    pub fn digest(&self) -> u64 {
        let mut text = String::new();
        for case in &self.cases {
            let Case {
                seed,
                status,
                n_steps,
                told,
                violations,
                ..
            } = case;
            // Writing to a string does not fail.
            let _ = writeln!(text, "{seed} {status} {n_steps} {told} {violations:?}");
        }
        let mut hash = Fnv::default();
        hash.add(text.as_bytes());
        hash.value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panics_are_violations() {
        let report = StressReport {
            cases: vec![Case::panicked(7, "at the disco")],
        };
        assert_eq!(report.n_violations(), 1);
        assert_eq!(report.counts(), BTreeMap::from([("panicked", 1)]));
    }
}
