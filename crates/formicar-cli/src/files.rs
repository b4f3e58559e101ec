//! Input files: text of bounded size, maps by extension, scenarios.

use crate::ground::Found;
use anyhow::{Context, Result, bail};
use formicar::map::OccupancyGrid;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The largest text file that is read, bytes.
const MAX_TEXT: u64 = 1 << 28;

/// The text of a file.
pub(crate) fn read_text(path: &Path) -> Result<String> {
    let read = || -> Result<String> {
        let mut text = String::new();
        let n_bytes = File::open(path)?
            .take(MAX_TEXT + 1)
            .read_to_string(&mut text)?;
        if n_bytes as u64 > MAX_TEXT {
            bail!("more than {MAX_TEXT} bytes");
        }
        Ok(text)
    };
    read().with_context(|| format!("{} cannot be read", path.display()))
}

/// A map file.
pub(crate) fn read_map(path: &Path, resolution_m: Option<f64>) -> Result<OccupancyGrid> {
    let text = read_text(path)?;
    let rows: Vec<&str> = text.lines().collect();
    Ok(OccupancyGrid::from_rows(
        &rows,
        resolution_m.unwrap_or(1.0),
    )?)
}

/// A scenario file.
pub(crate) enum ScenarioFile {
    /// A TPCAP case.
    Tpcap(Box<Found>),
    /// Car scenarios.
    Cars(CarScenarios),
}

impl ScenarioFile {
    /// Reads either kind, told apart by extension.
    pub(crate) fn read(path: &Path, _resolution_m: Option<f64>) -> Result<Self> {
        let _ = read_text(path)?;
        bail!("{}: scenario files are to come", path.display())
    }
}

/// The scenarios of a file.
pub(crate) struct CarScenarios;

impl CarScenarios {
    /// One of them.
    pub(crate) fn load(&self, _id: Option<&str>) -> Result<Found> {
        bail!("to come")
    }

    /// Names, with map, start and goal.
    pub(crate) fn rows(&self) -> Vec<(String, String)> {
        Vec::new()
    }
}
