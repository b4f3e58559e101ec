//! A map that a robot is searched in: a map file, or the session that made one.

use crate::files;
use crate::scene::{self, SceneArgs};
use anyhow::{Context, Result};
use formicar::map::OccupancyGrid;
use formicar_mapping::localize::{LocalizationMap, grid_distances};
use formicar_mapping::sdf::SdfMap;
use formicar_mapping::{Go, Mapper, MappingConfig};
use std::path::Path;

/// Cells and signed distances of a map.
pub(crate) struct MapToSearch {
    pub(crate) grid: OccupancyGrid,
    pub(crate) field: SdfMap,
    pub(crate) config: MappingConfig,
}

impl MapToSearch {
    /// Reads a map file of any format, or a session (`.session`), whose signed distances are exact
    /// to millimeters.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        if path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("session"))
        {
            let mapper = Mapper::from_session(&files::read_bytes(path)?)
                .with_context(|| path.display().to_string())?;
            let built = mapper.finish(|_| Go::On)?;
            return Ok(Self {
                grid: built.grid,
                field: built.field,
                config: mapper.config().clone(),
            });
        }
        let args = SceneArgs {
            map: Some(path.display().to_string()),
            ..SceneArgs::default()
        };
        let loaded = scene::find(&args)?;
        loaded.note_warnings();
        let config = MappingConfig::default();
        Ok(Self {
            field: grid_distances(&loaded.map, &config),
            grid: loaded.map,
            config,
        })
    }

    /// The map to localize in.
    pub(crate) fn to_localize(&self) -> LocalizationMap {
        LocalizationMap::new(&self.field)
    }
}
