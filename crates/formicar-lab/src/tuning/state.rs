//! The state of a tuning between two cycles.

use super::objective::{Objective, Reference};
use super::space::TuningSpace;
use anyhow::{Result, bail};
use formicar::tuning::BeeColony;
use serde::{Deserialize, Serialize};

/// Everything that a tuning needs to go on: written after a cycle and read again, it goes on as if
/// nothing had happened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TuningState {
    /// The subject of the tuning; a state of another one is refused.
    pub(super) subject: Subject,
    /// Per scenario what its runs are held against.
    pub(super) references: Vec<Reference>,
    /// Per scenario whether any run has ever found a path.
    #[serde(default)]
    pub(super) solved: Vec<bool>,
    /// Candidates whose values do not go together.
    pub(super) n_invalid: u64,
    /// The search.
    pub(super) colony: BeeColony,
}

/// The subject of a tuning: parameters, objective and scenarios.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Subject {
    /// Version of the program.
    pub(super) version: String,
    pub(super) space: TuningSpace,
    pub(super) objective: Objective,
    pub(super) n_seeds: u64,
    /// Names, hashes of map and vehicle, and requests of the scenarios tuned on.
    pub(super) scenarios: Vec<String>,
}

impl TuningState {
    /// Reads a state.
    ///
    /// # Errors
    /// A text that is none.
    pub fn read(text: &str) -> Result<Self> {
        let state: Self = serde_json::from_str(text)?;
        state.colony.check()?;
        if state.references.len() != state.subject.scenarios.len() {
            bail!("not one reference for each scenario");
        }
        Ok(state)
    }

    /// The state as JSON.
    ///
    /// # Errors
    /// No failure is known: all numbers are finite.
    pub fn text(&self) -> Result<String> {
        Ok(serde_json::to_string(self)? + "\n")
    }

    /// The search.
    pub fn colony(&self) -> &BeeColony {
        &self.colony
    }

    /// Checks that this is a later state of what began like `begun`.
    ///
    /// # Errors
    /// The difference.
    pub fn follows(&self, begun: &Self) -> Result<()> {
        let (ours, theirs) = (&self.subject, &begun.subject);
        let differs = [
            (ours.version != theirs.version, "version of formicar"),
            (ours.space != theirs.space, "planner, parameters or ranges"),
            (ours.objective != theirs.objective, "objective"),
            (ours.n_seeds != theirs.n_seeds, "number of seeds"),
            (ours.scenarios != theirs.scenarios, "scenarios"),
            (!self.colony.began_like(&begun.colony), "search or its seed"),
        ];
        match differs.iter().find(|(differs, _)| *differs) {
            Some((_, what)) => bail!("it is of another tuning: its {what} differs"),
            None => Ok(()),
        }
    }
}
