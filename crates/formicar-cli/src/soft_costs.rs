//! Soft costs: where the vehicle should rather not drive.

use crate::args::PlanArgs;
use crate::ground::Ground;
use anyhow::{Context, Result, bail};
use formicar::layers::SoftCosts;
use formicar::map::format::{ReadOptions, read_map};
use formicar::planner::{PlannerName, SoftCostsRecord};
use std::path::Path;

/// What soft costs weigh where nothing else is asked for.
const DEFAULT_WEIGHT: f64 = 3.0;
/// The word for the map's own graded cells.
const OF_MAP: &str = "map";

/// The soft costs that the flags name, noted in the story of the map.
pub(crate) fn load(
    args: &PlanArgs,
    ground: &mut Ground,
    planner: PlannerName,
) -> Result<Option<SoftCosts>> {
    let Some(name) = &args.soft_costs else {
        return Ok(None);
    };
    if !planner.heeds_soft_costs() {
        bail!(
            "--soft-costs: {} does not weigh the ground; hint: --planner formicar",
            planner.name()
        );
    }
    let weight = args.soft_weight.unwrap_or(DEFAULT_WEIGHT);
    let costs = if name == OF_MAP {
        SoftCosts::from_graded(&ground.map, weight)
    } else {
        let options = ReadOptions {
            resolution_m: args.ground.resolution,
        };
        let map = read_map(Path::new(name), &options).context("--soft-costs")?;
        SoftCosts::from_graded(&map, weight)
    };
    let costs = costs.context("--soft-weight")?;
    ground.record.soft_costs = Some(SoftCostsRecord {
        name: name.clone(),
        weight,
    });
    Ok(Some(costs))
}
