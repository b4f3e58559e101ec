//! Soft costs: areas that the vehicle avoids where it can.

use super::args::PlanArgs;
use crate::scene::Scene;
use anyhow::{Context, Result, bail};
use formicar::layers::SoftCosts;
use formicar::map::format::{ReadOptions, read_map};
use formicar::planner::{PlannerName, SoftCostsRecord};
use std::path::Path;

/// Default of `--soft-weight`.
const DEFAULT_WEIGHT: f64 = 3.0;
/// The value of `--soft-costs` that means the map's own graded cells.
const OF_MAP: &str = "map";

/// The soft costs that the flags name; they are noted in the record of the map.
pub(crate) fn load(
    args: &PlanArgs,
    scene: &mut Scene,
    planner: PlannerName,
) -> Result<Option<SoftCosts>> {
    let Some(name) = &args.soft_costs else {
        return Ok(None);
    };
    if !planner.heeds_soft_costs() {
        bail!(
            "--soft-costs: {} does not use soft costs; hint: --planner formicar",
            planner.name()
        );
    }
    let weight = args.soft_weight.unwrap_or(DEFAULT_WEIGHT);
    let costs = if name == OF_MAP {
        SoftCosts::from_graded(&scene.map, weight)
    } else {
        let options = ReadOptions {
            resolution_m: args.scene.resolution,
            ..ReadOptions::default()
        };
        let map = read_map(Path::new(name), &options).context("--soft-costs")?;
        SoftCosts::from_graded(&map, weight)
    };
    let costs = costs.context("--soft-weight")?;
    scene.record.soft_costs = Some(SoftCostsRecord {
        name: name.clone(),
        weight,
    });
    Ok(Some(costs))
}
