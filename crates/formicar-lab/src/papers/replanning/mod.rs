//! Replanning against planning anew, while obstacles appear before a vehicle and vanish again.

mod changes;
mod drive;
mod tables;

use crate::papers::experiment::{Ground, Setup, Variant};
use crate::papers::reproduction::{Reproduction, configs_of, csv, facts_of, seeds};
use crate::report::Fact;
use anyhow::{Context, Result};
use drive::{Method, Replanning, Step};
use formicar::map::builtin::BuiltinMap;
use formicar::map::generate::{NeighborhoodParameters, alley_neighborhood, free_pose_pairs};
use formicar::numeric::Seed;
use formicar::planner::{FormicarParameters, PlannerName};
use formicar::scenario::Request;
use formicar::vehicle::Vehicle;

/// Built-in maps on which a car drives.
const MAPS: [&str; 4] = [
    "warehouse",
    "parking-lot",
    "neighborhood",
    "li-neighborhood",
];
/// The name of generated neighborhoods, one for each seed.
const GENERATED: &str = "generated";

/// Drives vehicles through changing maps, once by planning anew after every change and once for
/// each consistency weight by replanning.
///
/// # Errors
/// No error is expected: maps and configurations are built in.
pub fn replanning(setup: &Setup, report_progress: &mut dyn FnMut(&str)) -> Result<Reproduction> {
    let n_seeds = setup.scale.n_seeds;
    let maps = if setup.scale.is_small { 1 } else { MAPS.len() };
    let builtin = MAPS[..maps].iter().map(|map| ground(map));
    let builtin = builtin.collect::<Result<Vec<_>>>()?;
    let methods = Method::all();
    let mut steps = Vec::new();
    for method in &methods {
        for ground in &builtin {
            report_progress(&format!("{}: {}", ground.map, method.variant.name));
            for seed in 0..n_seeds {
                steps.extend(drive::drive(ground, method, seed)?);
            }
        }
        report_progress(&format!("{GENERATED}: {}", method.variant.name));
        for seed in 0..n_seeds {
            steps.extend(drive::drive(&generated(seed)?, method, seed)?);
        }
    }
    reproduction(&steps, &builtin, &methods, n_seeds)
}

fn reproduction(
    steps: &[Step],
    grounds: &[Ground],
    methods: &[Method],
    n_seeds: u64,
) -> Result<Reproduction> {
    let mut facts = facts_of(grounds);
    facts.push(Fact::new("Seeds", seeds(n_seeds)));
    let variants: Vec<&Variant> = methods.iter().map(|method| &method.variant).collect();
    let pairs = variants.iter().map(|variant| (&grounds[0], *variant));
    Ok(Reproduction {
        report: tables::report(steps),
        csv: csv(steps)?,
        n_runs: steps.len(),
        facts,
        configs: configs_of(pairs)?,
        ..Reproduction::default()
    })
}

/// A built-in map with its first request, headings as given.
fn ground(map: &str) -> Result<Ground> {
    let ends = &BuiltinMap::by_name(map)?.requests[0];
    Ok(Ground {
        request: Request::new(ends.start, ends.goal),
        ..Ground::builtin(map)?
    })
}

/// A neighborhood and a drive through it.
fn generated(seed: u64) -> Result<Ground> {
    let parameters = NeighborhoodParameters {
        n_cols: 400,
        n_rows: 300,
        ..NeighborhoodParameters::default()
    };
    let vehicle = Vehicle::preset("lei2020").context("vehicle lei2020")?;
    let grid = alley_neighborhood(&parameters, Seed(seed))?;
    let pairs = free_pose_pairs(&grid, &vehicle, 1, Seed(seed))?;
    Ok(Ground {
        map: GENERATED.to_owned(),
        request: Request::new(pairs[0].0, pairs[0].1),
        grid,
        vehicle,
    })
}

impl Method {
    /// Planning anew, and replanning with several weights.
    fn all() -> Vec<Self> {
        let replan = |consistency: f64| Self {
            variant: Variant::changed(
                PlannerName::Formicar,
                &format!("replan, consistency {consistency}"),
                |config: &mut FormicarParameters| config.replan.consistency = consistency,
            ),
            replanning: Replanning::FromLast,
        };
        let anew = Self {
            variant: Variant::changed(
                PlannerName::Formicar,
                "anew",
                |_: &mut FormicarParameters| {},
            ),
            replanning: Replanning::Anew,
        };
        vec![anew, replan(0.0), replan(0.05), replan(0.2)]
    }
}
