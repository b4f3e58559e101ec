//! `map generate`: a map from a seed.

use super::args::{GenerateArgs, Kind};
use super::files;
use super::files::Frame;
use crate::failure::{Ending, Failure};
use anyhow::{Context, Result, anyhow, bail};
use formicar::map::OccupancyGrid;
use formicar::map::generate::{
    NeighborhoodParameters, ScatterParameters, alley_neighborhood, scattered_obstacles,
};
use formicar::numeric::Seed;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::io::Write;

/// Carries out `map generate`.
pub(super) fn run(args: &GenerateArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let grid = generate(args)?;
    let frame = if args.drop_frame {
        Frame::Drop
    } else {
        Frame::Keep
    };
    files::write(&args.out, &grid, frame)?;
    let n_blocked = grid.lethal_cells().count();
    writeln!(
        out,
        "{}: {} x {} cells of {} m, {:.1} % free",
        args.out.display(),
        grid.frame().n_cols(),
        grid.frame().n_rows(),
        grid.frame().resolution_m(),
        100.0 * (1.0 - n_blocked as f64 / grid.frame().n_cells() as f64)
    )?;
    Ok(Ending::Done)
}

fn generate(args: &GenerateArgs) -> Result<OccupancyGrid> {
    let seed = Seed(args.seed);
    Ok(match args.kind {
        Kind::Neighborhood => {
            alley_neighborhood(&parameters::<NeighborhoodParameters>(args)?, seed)?
        }
        Kind::Scatter => scattered_obstacles(&parameters::<ScatterParameters>(args)?, seed)?,
    })
}

/// The defaults, with what the flags say.
fn parameters<T: Default + Serialize + DeserializeOwned>(args: &GenerateArgs) -> Result<T> {
    let mut values = serde_json::to_value(T::default())?;
    let own = [
        ("n_cols", args.width_cells.map(|n| json!(n))),
        ("n_rows", args.height_cells.map(|n| json!(n))),
        ("resolution_m", args.resolution.map(|m| json!(m))),
    ];
    for (key, value) in own {
        if let Some(value) = value {
            values[key] = value;
        }
    }
    for set in &args.set {
        apply(&mut values, set).with_context(|| format!("--set {set:?}"))?;
    }
    serde_json::from_value(values).map_err(|e| anyhow!("the parameters: {e}"))
}

fn apply(values: &mut Value, set: &str) -> Result<()> {
    let Some((key, value)) = set.split_once('=') else {
        bail!("expected KEY=VALUE, for instance resolution_m=0.1");
    };
    let known = values.as_object_mut().context("no parameters")?;
    let Some(entry) = known.get_mut(key.trim()) else {
        let keys: Vec<_> = known.keys().map(String::as_str).collect();
        bail!(
            "there is no {:?}; there are {}",
            key.trim(),
            keys.join(", ")
        );
    };
    *entry = serde_json::from_str(value.trim())
        .ok()
        .filter(Value::is_number)
        .with_context(|| format!("{:?} is not a number", value.trim()))?;
    Ok(())
}
