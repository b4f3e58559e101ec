//! From flags to a map, a vehicle, and what they suggest to ask.

use crate::args::GroundArgs;
use crate::files::{self, ScenarioFile};
use anyhow::{Context, Result, bail};
use formicar::geometry::Pose2;
use formicar::map::builtin::BuiltinMap;
use formicar::map::format::{ReadOptions, read_map};
use formicar::map::{OCCUPIED, OccupancyGrid, UnknownPolicy};
use formicar::planner::MapRecord;
use formicar::vehicle::Vehicle;
use std::path::Path;

/// The vehicle where neither flags nor scenario name one.
const DEFAULT_VEHICLE: &str = "warehouse_amr";

/// A vehicle and the name it goes by.
#[derive(Clone, Debug)]
pub(crate) struct NamedVehicle {
    pub(crate) name: String,
    pub(crate) vehicle: Vehicle,
}

/// A map with its story, and a vehicle on it.
#[derive(Clone, Debug)]
pub(crate) struct Ground {
    /// The map, unknown cells decided, closed areas filled.
    pub(crate) map: OccupancyGrid,
    /// Its story.
    pub(crate) record: MapRecord,
    /// The vehicle, with its margin.
    pub(crate) vehicle: NamedVehicle,
    /// Start and goal of the scenario or of the built-in map.
    pub(crate) ends: Option<[Pose2; 2]>,
}

/// A map as it was found, before flags change it.
pub(crate) struct Found {
    pub(crate) name: String,
    pub(crate) map: OccupancyGrid,
    pub(crate) vehicle: Option<NamedVehicle>,
    pub(crate) ends: Option<[Pose2; 2]>,
}

/// Reads what the flags name.
pub(crate) fn load(args: &GroundArgs) -> Result<Ground> {
    // The vehicle first: it is quick to refuse.
    let asked = args.vehicle.as_deref().map(vehicle).transpose()?;
    let found = find(args)?;
    let fallback = || vehicle(DEFAULT_VEHICLE);
    let mut vehicle = asked.or(found.vehicle).map_or_else(fallback, Ok)?;
    if let Some(margin_m) = args.margin {
        vehicle.vehicle = vehicle.vehicle.with_safety_margin(margin_m)?;
    }
    let mut map = found.map.with_unknown(args.unknown);
    for area in &args.keep_out {
        map.fill_polygon(&area.0, OCCUPIED);
    }
    let corners = |area: &crate::args::Polygon| area.0.iter().map(|p| [p.x, p.y]).collect();
    let record = MapRecord {
        name: found.name,
        unknown: match args.unknown {
            UnknownPolicy::Free => "free",
            UnknownPolicy::Occupied => "occupied",
        }
        .to_owned(),
        keep_out: args.keep_out.iter().map(corners).collect(),
        ..MapRecord::default()
    };
    Ok(Ground {
        map,
        record,
        vehicle,
        ends: found.ends,
    })
}

/// The map that the flags name, as it is.
pub(crate) fn find(args: &GroundArgs) -> Result<Found> {
    match (&args.map, &args.scenario) {
        (Some(name), None) if BuiltinMap::by_name(name).is_ok() => builtin(args, name),
        (Some(name), None) => file(args, name),
        (None, Some(path)) => match ScenarioFile::read(path)? {
            ScenarioFile::Cars(cars) => cars.load(args.id.as_deref(), args.resolution),
            ScenarioFile::Tpcap(case) if args.id.is_none() => case.load(args.resolution),
            ScenarioFile::Tpcap(_) => bail!(
                "--id: {} is one TPCAP case; hint: leave --id out",
                path.display()
            ),
        },
        _ => bail!("a map is needed; hint: --map F|NAME (see `list maps`) or --scenario F"),
    }
}

fn builtin(args: &GroundArgs, name: &str) -> Result<Found> {
    if args.resolution.is_some() {
        bail!("--resolution: the built-in map {name} has its own; hint: leave the flag out");
    }
    let builtin = BuiltinMap::by_name(name)?;
    let request = match &args.request {
        Some(id) => Some(builtin.request(id)?),
        None => builtin.requests.first(),
    };
    Ok(Found {
        name: name.to_owned(),
        map: builtin.grid(),
        vehicle: Some(vehicle(builtin.vehicle)?),
        ends: request.map(|request| [request.start, request.goal]),
    })
}

fn file(args: &GroundArgs, name: &str) -> Result<Found> {
    if let Some(id) = &args.request {
        bail!("--request {id}: only built-in maps have requests; hint: --start and --goal");
    }
    let path = Path::new(name);
    let options = ReadOptions {
        resolution_m: args.resolution,
    };
    if !path.exists() && path.extension().is_none() {
        // A bare word: most likely a misspelled built-in.
        BuiltinMap::by_name(name)?;
    }
    Ok(Found {
        name: name.to_owned(),
        map: read_map(path, &options)?,
        vehicle: None,
        ends: None,
    })
}

/// A vehicle by preset name, or from a `.toml` or `.json` file.
pub(crate) fn vehicle(name: &str) -> Result<NamedVehicle> {
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
