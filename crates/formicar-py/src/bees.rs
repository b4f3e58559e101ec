//! The bee colony, with an objective of Python's.

use crate::errors::{self, Outcome};
use crate::values;
use formicar::numeric::Seed;
use formicar::tuning::{BeeColony, BeeColonyConfig, Dimension, ParameterSpace};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Mutex;

/// A search for parameters of least cost.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct Bees(Mutex<BeeColony>);

#[pymethods]
impl Bees {
    /// A colony over dimensions, each `{"name": ..., "kind": {"kind": "real", ...}}`.
    #[new]
    fn new(
        dimensions: &Bound<'_, PyAny>,
        settings: &Bound<'_, PyDict>,
        seed: u64,
        known: Vec<Vec<f64>>,
    ) -> Outcome<Self> {
        let space = values::to_json(dimensions, "space", errors::config)?;
        let dimensions: Vec<Dimension> = values::document(space, "space", errors::config)?;
        let settings = values::to_json(settings, "tune", errors::config)?;
        let config: BeeColonyConfig = values::document(settings, "tune", errors::config)?;
        let mut colony = BeeColony::new(ParameterSpace::new(dimensions)?, config, Seed(seed))?;
        for values in known {
            colony = colony.with_known(&values)?;
        }
        Ok(Self(Mutex::new(colony)))
    }

    /// The next cycle: `evaluate` gets rows of values and gives a list of their costs.
    fn cycle(&self, evaluate: &Bound<'_, PyAny>) -> Outcome<()> {
        let mut raised = None;
        let mut ask = |candidates: &[Vec<f64>]| -> Vec<f64> {
            let costs = evaluate
                .call1((candidates.to_vec(),))
                .and_then(|costs| costs.extract());
            costs.unwrap_or_else(|error| {
                raised = Some(error);
                Vec::new()
            })
        };
        let done = self.lock().cycle(&mut ask);
        match raised {
            Some(error) => Err(error.into()),
            None => Ok(done?),
        }
    }

    #[getter]
    fn is_done(&self) -> bool {
        self.lock().is_done()
    }

    #[getter]
    fn n_evaluations(&self) -> u64 {
        self.lock().n_evaluations()
    }

    /// Values and cost of the best place.
    #[getter]
    fn best(&self) -> Option<(Vec<f64>, f64)> {
        let colony = self.lock();
        let cost = colony.best()?.cost;
        Some((colony.best_values()?, cost))
    }

    /// Evaluations, best and median cost, gains, and whether a bee scouted, after each cycle.
    #[getter]
    fn history(&self) -> Vec<(u64, f64, f64, u32, bool)> {
        let colony = self.lock();
        let cycles = colony.history().iter();
        let row = |c: &formicar::tuning::CycleRecord| {
            (
                c.n_evaluations,
                c.best_cost,
                c.median_cost,
                c.n_gains,
                c.scouted,
            )
        };
        cycles.map(row).collect()
    }
}

impl Bees {
    fn lock(&self) -> std::sync::MutexGuard<'_, BeeColony> {
        self.0
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}
