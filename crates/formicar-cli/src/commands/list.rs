//! `list`: planners, built-in vehicles and maps, scenarios.

use crate::failure::{Ending, Failure};
use crate::scene::ScenarioFile;
use anyhow::{Result, anyhow};
use clap::{Args, ValueEnum, ValueHint};
use formicar::map::builtin;
use formicar::path::SpeedLimits;
use formicar::planner::PlannerName;
use formicar::vehicle::{Motion, PRESET_NAMES, Vehicle};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Flags of `list`.
#[derive(Args, Debug)]
pub(crate) struct ListArgs {
    /// The things to list.
    what: Listing,
    /// Scenario file, for `scenarios`; the requests of the built-in maps without one.
    #[arg(value_hint = ValueHint::FilePath)]
    file: Option<PathBuf>,
}

/// The things that can be listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Listing {
    /// Planners.
    Planners,
    /// Built-in vehicles.
    Vehicles,
    /// Built-in maps.
    Maps,
    /// Requests of the built-in maps, or the scenarios of a file.
    Scenarios,
}

/// Carries out `list`.
pub(crate) fn run(args: &ListArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let rows = match (&args.file, args.what) {
        (Some(path), Listing::Scenarios) => scenarios(path)?,
        (Some(path), _) => {
            let path = path.display();
            return Err(anyhow!("{path}: only `list scenarios` reads a file").into());
        }
        (None, Listing::Planners) => planners(),
        (None, Listing::Vehicles) => vehicles()?,
        (None, Listing::Maps) => maps(),
        (None, Listing::Scenarios) => requests(),
    };
    let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    for (name, about) in rows {
        writeln!(out, "{}", format!("{name:width$}  {about}").trim_end())?;
    }
    Ok(Ending::Done)
}

/// A name and its description.
type Row = (String, String);

fn planners() -> Vec<Row> {
    let row = |planner: PlannerName| (planner.name().to_owned(), planner.about().to_owned());
    PlannerName::ALL.map(row).to_vec()
}

fn vehicles() -> Result<Vec<Row>> {
    let row = |name: &str| Ok((name.to_owned(), measures(&Vehicle::preset(name)?)));
    PRESET_NAMES.into_iter().map(row).collect()
}

fn measures(vehicle: &Vehicle) -> String {
    if vehicle.motion() == Motion::Point {
        return "holonomic point: only its center line must stay free".to_owned();
    }
    let (low, high) = vehicle.footprint().bounds();
    let wheelbase = vehicle
        .wheelbase_m()
        .map_or(String::new(), |m| format!(", wheelbase {m} m"));
    let pace = SpeedLimits::of(vehicle).map_or(String::new(), |limits| {
        let steering = limits.max_steer_rate_rad_per_s;
        let steering = steering.map_or(String::new(), |rate| format!(", steers {rate} rad/s"));
        let (speed, acceleration) = (limits.max_speed_mps, limits.max_acceleration_mps2);
        format!("{steering}, {speed} m/s, {acceleration} m/s^2")
    });
    format!(
        "{:.2} x {:.2} m{wheelbase}, turning radius {:.2} m{pace}",
        high.x - low.x,
        high.y - low.y,
        vehicle.min_turning_radius_m()
    )
}

fn maps() -> Vec<Row> {
    let row = |map: &builtin::BuiltinMap| (map.name.to_owned(), map.about.to_owned());
    builtin::all().iter().map(row).collect()
}

fn requests() -> Vec<Row> {
    let row = |map: &builtin::BuiltinMap| {
        let ids: Vec<_> = map.requests.iter().map(|request| request.id).collect();
        (map.name.to_owned(), ids.join(" "))
    };
    builtin::all().iter().map(row).collect()
}

fn scenarios(path: &Path) -> Result<Vec<Row>> {
    Ok(match ScenarioFile::read(path)? {
        ScenarioFile::Cars(cars) => cars.rows(),
        ScenarioFile::Tpcap(case) => vec![case.row()],
    })
}
