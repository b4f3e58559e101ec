//! Maps that come with the library: grid problems, scenes, and narrow places.

mod catalog;
mod narrow;
mod scenes;

use super::OccupancyGrid;
use crate::geometry::Pose2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What can go wrong with built-in maps.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum BuiltinError {
    /// A name that no built-in map has.
    #[error("no built-in map is named {name:?}; there are {}", names().join(", "))]
    UnknownMap {
        /// The name asked for.
        name: String,
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

/// What a built-in map is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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
pub struct BuiltinRequest {
    /// Name within the map.
    pub id: &'static str,
    /// Where the vehicle stands.
    pub start: Pose2,
    /// Where it should stand.
    pub goal: Pose2,
}

/// A map of our own, with a vehicle and requests that suit it.
#[derive(Clone, Debug)]
pub struct BuiltinMap {
    /// Name, unique among built-in maps.
    pub name: &'static str,
    /// What it shows, for which vehicle, of which measures, and what makes it hard.
    pub about: &'static str,
    /// What it is for.
    pub kind: BuiltinKind,
    /// Preset name of the vehicle that it is made for.
    pub vehicle: &'static str,
    /// At least one start and goal; both stand free with the vehicle's whole body.
    pub requests: &'static [BuiltinRequest],
    source: Source,
}

/// Where the cells come from.
#[derive(Clone, Debug)]
enum Source {
    /// Rows of text, first row on top, and the side of a cell in metres.
    Text(&'static str, f64),
    /// A drawing in metres.
    Drawing(fn() -> OccupancyGrid),
}

impl BuiltinMap {
    /// A built-in map by name.
    ///
    /// # Errors
    /// A name that no built-in map has; the message lists all names.
    pub fn by_name(name: &str) -> Result<&'static Self, BuiltinError> {
        let name_matches = |map: &&Self| map.name == name;
        all()
            .iter()
            .find(name_matches)
            .ok_or_else(|| BuiltinError::UnknownMap {
                name: name.to_owned(),
            })
    }

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

/// All built-in maps: grid problems, scenes, then the narrow set.
pub fn all() -> &'static [BuiltinMap] {
    &catalog::MAPS
}

fn names() -> Vec<&'static str> {
    all().iter().map(|map| map.name).collect()
}

#[cfg(test)]
mod tests;
