//! The scene of a command: a map, a vehicle, and the start and goal that come with them.

mod args;
mod blocked;
mod closed;
mod scenario_file;
mod vehicle;

pub(crate) use args::SceneArgs;
pub(crate) use blocked::Blocked;
pub(crate) use scenario_file::{Loaded, ScenarioFile};
pub(crate) use vehicle::by_name as vehicle;

use crate::bag::{self, MapAddress};
use anyhow::{Result, bail};
use closed::Closed;
use formicar::geometry::Pose2;
use formicar::map::builtin::BuiltinMap;
use formicar::map::format::{MapFile, ReadOptions};
use formicar::map::{OccupancyGrid, UnknownPolicy};
use formicar::planner::MapRecord;
use std::path::Path;
use vehicle::NamedVehicle;

/// The vehicle where neither the flags nor the scenario name one.
const DEFAULT_VEHICLE: &str = "warehouse_amr";

/// A map and the vehicle that drives on it.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    /// The map; unknown cells are decided and keep-out areas filled.
    pub(crate) map: OccupancyGrid,
    /// What of the map blocks besides obstacles.
    pub(crate) blocked: Blocked,
    /// Where the map comes from and what the flags changed on it.
    pub(crate) record: MapRecord,
    /// The vehicle, with its margin.
    pub(crate) vehicle: NamedVehicle,
    /// Start and goal of the scenario or of the built-in map.
    pub(crate) ends: Option<[Pose2; 2]>,
}

/// Loads the map and the vehicle that the flags name.
pub(crate) fn load(args: &SceneArgs) -> Result<Scene> {
    // The vehicle first: it is quick to refuse.
    let asked = args.vehicle.as_deref().map(vehicle::by_name).transpose()?;
    let loaded = find(args)?;
    loaded.note_warnings();
    let fallback = || vehicle::by_name(DEFAULT_VEHICLE);
    let mut vehicle = asked.or(loaded.vehicle).map_or_else(fallback, Ok)?;
    if let Some(margin_m) = args.margin {
        vehicle.vehicle = vehicle.vehicle.with_safety_margin(margin_m)?;
    }
    let closed = Closed::new(loaded.map.frame(), &args.keep_out)?;
    let (keep_out, keep_out_maps) = (closed.areas.clone(), closed.maps.clone());
    let blocked = Blocked::new(&loaded.map, args.unknown, closed);
    let mut map = loaded.map.with_unknown(args.unknown);
    blocked.close(&mut map);
    let record = MapRecord {
        name: loaded.name,
        unknown: match args.unknown {
            UnknownPolicy::Free => "free",
            UnknownPolicy::Occupied => "occupied",
        }
        .to_owned(),
        keep_out,
        keep_out_maps,
        warnings: loaded.warnings,
        ..MapRecord::default()
    };
    Ok(Scene {
        map,
        blocked,
        record,
        vehicle,
        ends: loaded.ends,
    })
}

/// The map that the flags name, unchanged.
pub(crate) fn find(args: &SceneArgs) -> Result<Loaded> {
    match (&args.map, &args.scenario) {
        (Some(name), None) if BuiltinMap::by_name(name).is_ok() => builtin(args, name),
        (Some(name), None) => file(args, name),
        (None, Some(path)) => match ScenarioFile::read(path)? {
            ScenarioFile::Cars(cars) => cars.load(args.id.as_deref(), &options(args)),
            ScenarioFile::Tpcap(case) if args.id.is_none() => case.load(&options(args)),
            ScenarioFile::Tpcap(_) => bail!(
                "--id: {} is one TPCAP case; hint: leave --id out",
                path.display()
            ),
        },
        _ => bail!("a map is needed; hint: --map F|NAME (see `list maps`) or --scenario F"),
    }
}

/// The settings of a map file that the flags give.
fn options(args: &SceneArgs) -> ReadOptions {
    ReadOptions {
        resolution_m: args.resolution,
        unknown_grey: args.unknown_grey,
    }
}

fn builtin(args: &SceneArgs, name: &str) -> Result<Loaded> {
    if args.unknown_grey.is_some() {
        bail!("--unknown-grey: the built-in map {name} has no grey values; hint: leave it out");
    }
    if args.resolution.is_some() {
        bail!("--resolution: the built-in map {name} has its own; hint: leave the flag out");
    }
    let builtin = BuiltinMap::by_name(name)?;
    let request = match &args.request {
        Some(id) => Some(builtin.request(id)?),
        None => builtin.requests.first(),
    };
    Ok(Loaded {
        name: name.to_owned(),
        map: builtin.grid(),
        warnings: Vec::new(),
        vehicle: Some(vehicle::by_name(builtin.vehicle)?),
        ends: request.map(|request| [request.start, request.goal]),
    })
}

fn file(args: &SceneArgs, name: &str) -> Result<Loaded> {
    if let Some(id) = &args.request {
        bail!("--request {id}: only built-in maps have requests; hint: --start and --goal");
    }
    if let Some(address) = MapAddress::parse(name)? {
        return of_bag(args, name, &address);
    }
    let path = Path::new(name);
    if !path.exists() && path.extension().is_none() {
        // A bare word: most likely a misspelled built-in.
        BuiltinMap::by_name(name)?;
    }
    let MapFile { grid, warnings } = MapFile::read(path, &options(args))?;
    Ok(Loaded {
        name: name.to_owned(),
        map: grid,
        warnings: warnings.iter().map(ToString::to_string).collect(),
        vehicle: None,
        ends: None,
    })
}

/// The map at an address in a bag.
fn of_bag(args: &SceneArgs, name: &str, address: &MapAddress) -> Result<Loaded> {
    if args.resolution.is_some() || args.unknown_grey.is_some() {
        bail!(
            "{name}: maps in bags have their own resolution and unknown cells; hint: leave \
             --resolution and --unknown-grey out"
        );
    }
    #[cfg(feature = "record")]
    {
        let (map, warnings) = bag::read_map(address)?;
        Ok(Loaded {
            name: name.to_owned(),
            map,
            warnings,
            vehicle: None,
            ends: None,
        })
    }
    #[cfg(not(feature = "record"))]
    bag::refuse(&address.bag)
}
