//! Speed of the judge, and of what a user waits for, on a real neighborhood.

mod support;

use divan::{Bencher, black_box};
use formicar::numeric::Seed;
use formicar::planner::{Outcome, Plan, Planner};
use formicar::scenario::Request;
use formicar::validation::judge;
use support::hood_queries;

fn main() {
    divan::main();
}

fn plans(planner: &mut Planner, requests: &[Request]) -> Vec<(Request, Plan)> {
    let plan = |request: &Request| match planner.plan(request, Seed(0), &mut ()) {
        Ok(Outcome::Found(plan)) => Some((request.clone(), *plan)),
        _ => None,
    };
    requests.iter().filter_map(plan).collect()
}

/// All paths found, one after the other; divan's rate is meters of path judged per second.
#[divan::bench]
fn judge_hood_800x500(bencher: Bencher) {
    let Some((mut planner, requests)) = hood_queries() else {
        return;
    };
    let plans = plans(&mut planner, &requests);
    let length_m: f64 = plans.iter().map(|(_, plan)| plan.metrics.length_m).sum();
    bencher
        .counter(divan::counter::ItemsCount::new(length_m as usize))
        .bench_local(|| {
            for (request, plan) in &plans {
                black_box(judge(
                    planner.obstacles(),
                    planner.vehicle(),
                    request,
                    &plan.path,
                ));
            }
        });
}

/// All ten queries with a warm planner of the default kind, improvement included.
#[divan::bench(sample_count = 20, sample_size = 1)]
fn plan_hood_800x500(bencher: Bencher) {
    let Some((mut planner, requests)) = hood_queries() else {
        return;
    };
    bencher.bench_local(|| plans(&mut planner, &requests).len());
}
