//! Scenario files: car scenarios and TPCAP cases.

use super::vehicle::NamedVehicle;
use crate::failure::note;
use anyhow::{Context, Result, bail};
use formicar::geometry::Pose2;
use formicar::map::OccupancyGrid;
use formicar::map::format::{CarScenario, MapFile, ReadOptions, TpcapCase, read_car_scenarios};
use formicar::vehicle::Vehicle;
use std::path::{Path, PathBuf};

/// A map as its file or definition has it, before flags change it, with the vehicle and the ends
/// that come with it.
pub(crate) struct Loaded {
    pub(crate) name: String,
    pub(crate) map: OccupancyGrid,
    /// Doubts about the file.
    pub(crate) warnings: Vec<String>,
    pub(crate) vehicle: Option<NamedVehicle>,
    /// Start and goal.
    pub(crate) ends: Option<[Pose2; 2]>,
}

impl Loaded {
    /// Tells the user the doubts about the file.
    pub(crate) fn note_warnings(&self) {
        for warning in &self.warnings {
            note(&format!("warning: {}: {warning}", self.name));
        }
    }
}

/// A scenario file.
pub(crate) enum ScenarioFile {
    /// A TPCAP case.
    Tpcap(TpcapFile),
    /// Car scenarios.
    Cars(CarFile),
}

impl ScenarioFile {
    /// Reads either kind; the extension tells which.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let extension = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default();
        if extension.eq_ignore_ascii_case("json") {
            let scenarios = read_car_scenarios(path)?;
            if scenarios.is_empty() {
                bail!("{}: it holds no scenarios", path.display());
            }
            Ok(Self::Cars(CarFile {
                path: path.to_owned(),
                scenarios,
            }))
        } else if extension.eq_ignore_ascii_case("csv") {
            Ok(Self::Tpcap(TpcapFile {
                path: path.to_owned(),
                case: TpcapCase::read(path)?,
            }))
        } else {
            bail!(
                "{}: a scenario file is .json (car scenarios) or .csv (a TPCAP case)",
                path.display()
            )
        }
    }
}

/// A TPCAP case.
pub(crate) struct TpcapFile {
    path: PathBuf,
    case: TpcapCase,
}

/// Default cell size of a TPCAP case, meters.
const TPCAP_RESOLUTION_M: f64 = 0.1;

impl TpcapFile {
    /// Its map, vehicle, start and goal.
    pub(crate) fn load(&self, options: &ReadOptions) -> Result<Loaded> {
        if options.unknown_grey.is_some() {
            bail!("--unknown-grey: a TPCAP case holds no grey values; hint: leave the flag out");
        }
        let resolution_m = options.resolution_m;
        Ok(Loaded {
            name: self.path.display().to_string(),
            warnings: Vec::new(),
            map: self
                .case
                .rasterize(resolution_m.unwrap_or(TPCAP_RESOLUTION_M))?,
            vehicle: Some(NamedVehicle {
                name: "tpcap".to_owned(),
                vehicle: Vehicle::tpcap(),
            }),
            ends: Some([self.case.start, self.case.goal]),
        })
    }

    /// Name and description.
    pub(crate) fn row(&self) -> (String, String) {
        let name = self.path.file_stem().unwrap_or_default();
        let about = format!("TPCAP case, {} obstacles", self.case.obstacles.len());
        (name.to_string_lossy().into_owned(), about)
    }
}

/// The scenarios of a file.
pub(crate) struct CarFile {
    path: PathBuf,
    scenarios: Vec<CarScenario>,
}

impl CarFile {
    /// Map, vehicle, start and goal of one of them; the only one needs no id.
    pub(crate) fn load(&self, id: Option<&str>, options: &ReadOptions) -> Result<Loaded> {
        let scenario = self.find(id)?;
        let MapFile { grid, warnings } = MapFile::read(&scenario.map, options)?;
        Ok(Loaded {
            name: scenario.map.display().to_string(),
            map: grid,
            warnings: warnings.iter().map(ToString::to_string).collect(),
            vehicle: Some(NamedVehicle {
                name: scenario.id.clone(),
                vehicle: Vehicle::new(scenario.vehicle.clone())?,
            }),
            ends: Some([scenario.start, scenario.goal]),
        })
    }

    fn find(&self, id: Option<&str>) -> Result<&CarScenario> {
        let ids = || -> Vec<_> { self.scenarios.iter().map(|s| s.id.as_str()).collect() };
        match (id, &self.scenarios[..]) {
            (None, [only]) => Ok(only),
            (None, _) => bail!(
                "{} holds {} scenarios; hint: choose with --id: {}",
                self.path.display(),
                self.scenarios.len(),
                ids().join(", ")
            ),
            (Some(id), all) => all.iter().find(|s| s.id == id).with_context(|| {
                let path = self.path.display();
                format!(
                    "{path} holds no scenario {id:?}; there are {}",
                    ids().join(", ")
                )
            }),
        }
    }

    /// Names and descriptions: map, start and goal.
    pub(crate) fn rows(&self) -> Vec<(String, String)> {
        let row = |s: &CarScenario| {
            let map = s.map.file_name().unwrap_or_default().to_string_lossy();
            let pose = |p: Pose2| format!("{},{},{}", p.x, p.y, p.heading);
            let about = format!("{map}  {} -> {}", pose(s.start), pose(s.goal));
            (s.id.clone(), about)
        };
        self.scenarios.iter().map(row).collect()
    }
}
