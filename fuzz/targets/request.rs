//! Request documents, planned for in a small yard under a small budget.
#![no_main]

use formicar::numeric::Seed;
use formicar::planner::{Planner, PlannerConfig, RequestDocument};
use formicar::vehicle::Vehicle;
use libfuzzer_sys::fuzz_target;

const BUDGET_STEPS: u64 = 300;

fuzz_target!(|bytes: &[u8]| {
    let Ok(document) = serde_json::from_slice::<RequestDocument>(bytes) else {
        return;
    };
    let Ok(mut request) = document.onto(&RequestDocument::default()) else {
        return;
    };
    request.budget_steps = Some(request.budget_steps.unwrap_or(BUDGET_STEPS).min(BUDGET_STEPS));
    let map = formicar_fuzz::yard();
    let mut planner = Planner::new(&map, Vehicle::warehouse_amr(), PlannerConfig::default())
        .expect("the default configuration");
    let _ = planner.plan(&request, Seed(1), &mut ());
});
