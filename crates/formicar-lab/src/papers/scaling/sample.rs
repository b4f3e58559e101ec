//! One query under one value of a quantity, measured.

use super::axes::{Point, Quantity};
use crate::analysis::statistics::quartiles;
use crate::papers::experiment::{Scale, Variant};
use crate::run::measure;
use anyhow::Result;
use formicar::numeric::Seed;
use formicar::planner::Outcome;
use serde::Serialize;

/// The result of a query; times are medians over its repetitions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Sample {
    pub(super) quantity: &'static str,
    pub(super) x: f64,
    pub(super) planner: String,
    pub(super) seed: u64,
    pub(super) is_solved: bool,
    /// Map and vehicle made ready.
    pub(super) setup_ms: f64,
    /// The query of a warm planner.
    pub(super) query_ms: f64,
    pub(super) steps: u64,
}

impl Sample {
    /// Runs a planner at a point: once to warm it up, then as often as the scale says, slow queries
    /// less often.
    pub(super) fn run(
        quantity: Quantity,
        point: &Point,
        variant: &Variant,
        seed: u64,
        scale: Scale,
    ) -> Result<Self> {
        let ground = &point.ground;
        let setup = measure(&mut (), |_| ground.planner(&variant.config));
        let mut planner = setup.answer?.with_threads(point.n_threads);
        let mut outcome = planner.plan(&ground.request, Seed(seed), &mut ())?;
        let mut times_ms = Vec::new();
        let n_timings = scale.n_timings.min(MAX_TIMINGS);
        while times_ms.len() < n_timings && times_ms.iter().sum::<f64>() < ENOUGH_MS {
            let query = measure(&mut (), |observer| {
                planner.plan(&ground.request, Seed(seed), observer)
            });
            outcome = query.answer?;
            times_ms.push(1e3 * query.query_s);
        }
        let [_, query_ms, _] = quartiles(&times_ms).unwrap_or_default();
        Ok(Self {
            quantity: quantity.name(),
            x: point.x,
            planner: variant.name.clone(),
            seed,
            is_solved: matches!(outcome, Outcome::Found(_)),
            setup_ms: 1e3 * setup.query_s,
            query_ms,
            steps: outcome.n_steps(),
        })
    }
}

/// Repetitions at most.
const MAX_TIMINGS: usize = 3;
/// Time after which a query is not repeated.
const ENOUGH_MS: f64 = 3000.0;
