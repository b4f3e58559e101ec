//! A built-in map: its description, requests and cells.

use crate::geometry::Pose2;
use crate::map::OccupancyGrid;
use thiserror::Error;

/// Errors of built-in maps: unknown names.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum BuiltinError {
    /// A name that no built-in map has.
    #[error("no built-in map is named {name:?}; there are {}", choices.join(", "))]
    UnknownMap {
        /// The name asked for.
        name: String,
        /// The names of all built-in maps.
        choices: Vec<&'static str>,
    },
    /// An id that no request of the map has.
    #[error("built-in map {map} has no request {id:?}; there are {}", choices.join(", "))]
    UnknownRequest {
        /// The map.
        map: &'static str,
        /// The id asked for.
        id: String,
        /// The ids that it has.
        choices: Vec<&'static str>,
    },
}

/// The purpose of a built-in map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum BuiltinKind {
    /// A small grid as papers on ant colonies use them.
    GridProblem,
    /// A place where robots and cars work.
    Scene,
    /// A tight place of measures that users report.
    Narrow,
}

/// A start and a goal on a built-in map, world poses of the rear axle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BuiltinRequest {
    /// Name within the map.
    pub id: &'static str,
    /// The start pose.
    pub start: Pose2,
    /// The goal pose.
    pub goal: Pose2,
}

/// A map of our own, with a vehicle and requests that suit it.
///
/// ```
/// use formicar::map::builtin::BuiltinMap;
///
/// let warehouse = BuiltinMap::by_name("warehouse")?;
/// let request = warehouse.request("dock-to-rack")?;
/// let cell = warehouse.grid().frame().cell_at(request.start.position());
/// assert!(cell.is_some());
/// # Ok::<(), formicar::map::builtin::BuiltinError>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BuiltinMap {
    /// Name, unique among built-in maps.
    pub name: &'static str,
    /// A description: the scene, its measures, the vehicle, and the difficulty.
    pub about: &'static str,
    /// Its purpose.
    pub kind: BuiltinKind,
    /// Preset name of the vehicle that it is made for.
    pub vehicle: &'static str,
    /// At least one start and goal; both stand free with the vehicle's whole body.
    pub requests: &'static [BuiltinRequest],
    pub(super) source: Source,
}

/// The source of the cells.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// Rows of text, first row on top, and the side of a cell in meters.
    Text(&'static str, f64),
    /// A drawing in meters.
    Drawing(fn() -> OccupancyGrid),
}

impl BuiltinMap {
    /// One of its requests by id.
    ///
    /// # Errors
    /// An id that none of its requests has; the message lists all ids.
    pub fn request(&self, id: &str) -> Result<&'static BuiltinRequest, BuiltinError> {
        let found = self.requests.iter().find(|request| request.id == id);
        found.ok_or_else(|| BuiltinError::UnknownRequest {
            map: self.name,
            id: id.to_owned(),
            choices: self.requests.iter().map(|request| request.id).collect(),
        })
    }

    /// The cells, drawn anew on each call.
    pub fn grid(&self) -> OccupancyGrid {
        match self.source {
            Source::Text(text, resolution_m) => {
                let rows: Vec<&str> = text.lines().collect();
                OccupancyGrid::from_rows(&rows, resolution_m)
                    .expect("the texts are rectangular, as the tests of this module see")
            }
            Source::Drawing(draw) => draw(),
        }
    }
}
