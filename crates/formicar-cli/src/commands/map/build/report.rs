//! The folder of a report: page, pictures, JSON.

use crate::files;
use anyhow::{Context, Result};
use formicar_mapping::report::map_picture;
use formicar_mapping::{BuiltMap, MapReport};
use std::path::{Path, PathBuf};

/// Width of the picture as PNG, pixels.
const PNG_WIDTH_PX: u32 = 1800;

/// The folder of a report.
pub(super) struct ReportFolder(PathBuf);

impl ReportFolder {
    /// The folder, if one is named; it is made where it does not exist.
    pub(super) fn of(path: Option<&Path>) -> Result<Option<Self>> {
        let Some(path) = path else {
            return Ok(None);
        };
        files::make_folder(path).context("--report")?;
        Ok(Some(Self(path.to_owned())))
    }

    /// Writes `index.html`, `map.svg`, `map.png` and `report.json`.
    pub(super) fn write(&self, report: &MapReport, built: &BuiltMap) -> Result<()> {
        let picture = map_picture(built, &report.logs.join(", "));
        files::write(&self.0.join("map.svg"), picture.to_svg())?;
        files::write(&self.0.join("map.png"), picture.to_png(PNG_WIDTH_PX)?)?;
        files::write(
            &self.0.join("report.json"),
            serde_json::to_vec_pretty(report)?,
        )?;
        files::write(&self.0.join("index.html"), report.to_html(&picture))
    }
}
