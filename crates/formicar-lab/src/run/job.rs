//! The job of one run: scenario, vehicle, planner, seed and limits.

use formicar::planner::PlannerName;
use formicar::vehicle::Gears;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Scenario, planner and seed, which tell the runs of one table apart.
pub type RunKey = (String, String, u64);

/// A scenario to be planned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Task {
    /// Its name, unique in a campaign.
    pub scenario: String,
    /// The file or built-in map that it comes from.
    pub source: String,
    /// The place of map, start and goal.
    pub place: Place,
}

impl Task {
    /// The published optimum, cells; known of `MovingAI` scenarios.
    pub fn optimal_length_cells(&self) -> Option<f64> {
        match self.place {
            Place::Cells {
                optimal_length_cells,
                ..
            } => Some(optimal_length_cells),
            _ => None,
        }
    }

    /// The file of car scenarios or of a TPCAP case that holds it.
    pub fn file(&self) -> Option<&std::path::Path> {
        match &self.place {
            Place::File { path, .. } => Some(path),
            Place::Barn { .. } | Place::Builtin { .. } | Place::Cells { .. } => None,
        }
    }
}

/// The place of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// In a scenario file.
    File {
        /// The file: car scenarios (.json) or a TPCAP case (.csv).
        path: PathBuf,
        /// One of its scenarios; none where it holds but one.
        id: Option<String>,
        /// Side of a cell, where the file leaves that open, meters.
        resolution_m: Option<f64>,
    },
    /// A world of the BARN benchmark.
    Barn {
        /// The file of worlds.
        path: PathBuf,
        /// One of them.
        world: u32,
        /// Side of a cell, meters.
        resolution_m: f64,
    },
    /// In the library.
    Builtin {
        /// The map.
        map: String,
        /// One of its requests.
        request: String,
    },
    /// On a `MovingAI` map.
    Cells {
        /// The map.
        map: PathBuf,
        /// Column and row.
        start: [u32; 2],
        /// Column and row.
        goal: [u32; 2],
        /// The published optimum without corner cutting, cells.
        optimal_length_cells: f64,
    },
}

/// A planner with parameters of its own, and the name that it goes by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contender {
    /// The name in tables.
    pub name: String,
    /// The planner.
    pub planner: PlannerName,
    /// Parameters that are not the planner's defaults, as in a configuration file.
    pub config: toml::Table,
    /// The program that plans in the planner's place, which then stands for nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rival: Option<RivalCommand>,
    /// Keys of the parameters that a tuning has found, as its file holds them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tuned: Vec<String>,
    /// True if a planner of the caller plans, handed over to [`InProcess`](super::InProcess) under
    /// this name; `planner` then stands for nothing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_in_process: bool,
}

impl Contender {
    /// A built-in planner as it is.
    pub fn built_in(planner: PlannerName) -> Self {
        Self {
            name: planner.name().to_owned(),
            planner,
            config: toml::Table::new(),
            rival: None,
            tuned: Vec::new(),
            is_in_process: false,
        }
    }

    /// A planner of the caller under a name.
    pub fn in_process(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            is_in_process: true,
            ..Self::built_in(PlannerName::default())
        }
    }
}

/// A program that plans.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RivalCommand {
    /// The program and its arguments; `formicar` is the program that runs the campaign.
    pub words: Vec<String>,
    /// The folder in which it runs: that of the campaign file.
    pub folder: PathBuf,
}

/// The limits of a run, and how it is asked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// The gears that may be used.
    pub motion: Option<Gears>,
    /// Search steps after which a run gives up.
    pub budget_steps: Option<u64>,
    /// Time after which a run gives up, milliseconds.
    pub deadline_ms: Option<f64>,
    /// True where the first query of a planner counts rather than the second.
    pub is_cold: bool,
}

/// A vehicle other than the scenario's own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VehicleChoice {
    /// The name it goes by.
    pub name: String,
    /// A preset, or a file.
    pub source: String,
}

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// The scenario.
    pub task: Task,
    /// The vehicle; none for the scenario's own.
    pub vehicle: Option<VehicleChoice>,
    /// The planner.
    pub contender: Contender,
    /// The seed.
    pub seed: u64,
    /// The limits.
    pub limits: Limits,
    /// The file that takes the answer.
    pub answer: Option<PathBuf>,
}

impl Job {
    /// The key that tells it apart in a table of one vehicle and one motion mode.
    pub fn key(&self) -> RunKey {
        let (task, contender) = (&self.task, &self.contender);
        (task.scenario.clone(), contender.name.clone(), self.seed)
    }

    /// The vehicle's name: `own` for the scenario's.
    pub fn vehicle_name(&self) -> &str {
        let chosen = self.vehicle.as_ref();
        chosen.map_or(OWN_VEHICLE, |vehicle| &vehicle.name)
    }

    /// The preset or file of its vehicle; none for the scenario's own.
    pub fn vehicle_source(&self) -> Option<&str> {
        self.vehicle.as_ref().map(|vehicle| vehicle.source.as_str())
    }

    /// The motion mode's name.
    pub fn motion_name(&self) -> &'static str {
        self.limits.motion.unwrap_or_default().name()
    }
}

/// The word for the vehicle that a scenario names itself.
pub const OWN_VEHICLE: &str = "own";
