//! Files of things that move, and of speed limits.

use crate::files;
use anyhow::{Context, Result, bail};
use formicar::map::format::{ReadOptions, read_map};
use formicar::planner::{MOVING_SCHEMA, MovingDocument};
use formicar::scenario::{Predictions, SpeedZones, ZoneUnit};
use std::path::Path;

/// Moving obstacles of a file, predicted up to its horizon or another one.
pub(crate) fn moving(path: &Path, horizon_s: Option<f64>) -> Result<Predictions> {
    let name = || path.display().to_string();
    let text = files::read_document(path)?;
    let read: Result<MovingDocument, _> = serde_json::from_str(&text);
    let document = read.with_context(|| {
        format!(
            "{}: no moving obstacles; hint: {{\"horizon_s\": 30, \"obstacles\": [...]}}, see `schema moving`",
            name()
        )
    })?;
    if let Some(found) = document.schema.as_ref().filter(|s| *s != MOVING_SCHEMA) {
        bail!(
            "{}: schema {found:?}; this version reads {MOVING_SCHEMA:?}",
            name()
        );
    }
    let document = MovingDocument {
        horizon_s: horizon_s.unwrap_or(document.horizon_s),
        ..document
    };
    document.predictions().with_context(name)
}

/// The speed limits of a mask, `F` or `F,BASE,MULTIPLIER`.
pub(crate) fn speed_zones(text: &str) -> Result<SpeedZones> {
    let parts: Vec<_> = text.rsplitn(3, ',').collect();
    let numbers = match parts[..] {
        [multiplier, base, name] => {
            let number = |text: &str| text.trim().parse::<f64>().ok();
            number(base)
                .zip(number(multiplier))
                .map(|pair| (name, pair))
        }
        _ => None,
    };
    let (name, unit, base, multiplier) = match numbers {
        Some((name, (base, multiplier))) => (name, ZoneUnit::MetersPerSecond, base, multiplier),
        None => (text, ZoneUnit::Percent, 0.0, 1.0),
    };
    let map = read_map(Path::new(name), &ReadOptions::default()).context("--speed-zones")?;
    SpeedZones::new(map, unit, base, multiplier).context("--speed-zones")
}
