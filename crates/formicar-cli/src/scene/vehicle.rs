//! Vehicles by name: built-in, or read from a file.

use crate::files;
use anyhow::{Context, Result};
use formicar::vehicle::Vehicle;
use std::path::Path;

/// A vehicle and the name it goes by.
#[derive(Clone, Debug)]
pub(crate) struct NamedVehicle {
    pub(crate) name: String,
    pub(crate) vehicle: Vehicle,
}

/// A built-in vehicle, or one from a `.toml` or `.json` file.
pub(crate) fn by_name(name: &str) -> Result<NamedVehicle> {
    let path = Path::new(name);
    let extension = path.extension().and_then(|e| e.to_str());
    let vehicle = match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("toml") => {
            let text = files::read_text(path)?;
            let parameters = toml::from_str(&text)
                .map_err(|e| anyhow::anyhow!("{}", e.message().replace('\n', " ")));
            Vehicle::new(parameters.with_context(|| name.to_owned())?)
        }
        Some("json") => {
            let text = files::read_text(path)?;
            Vehicle::new(serde_json::from_str(&text).with_context(|| name.to_owned())?)
        }
        _ => return preset(name),
    };
    Ok(NamedVehicle {
        name: name.to_owned(),
        vehicle: vehicle.with_context(|| name.to_owned())?,
    })
}

fn preset(name: &str) -> Result<NamedVehicle> {
    let vehicle = Vehicle::preset(name);
    Ok(NamedVehicle {
        name: name.to_owned(),
        vehicle: vehicle.context("--vehicle: neither a preset nor a .toml or .json file")?,
    })
}
