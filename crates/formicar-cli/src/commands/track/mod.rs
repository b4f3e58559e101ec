//! `track`: a vehicle driven along a path in simulation.

mod args;
mod words;

pub(crate) use args::TrackArgs;

use crate::failure::{Ending, Failure};
use crate::output::{Target, print_json};
use crate::path_file::{self, PathFile};
use crate::picture::{self, PictureKind};
use crate::scene;
use anyhow::{Context, Result};
use formicar::collision::ObstacleMap;
use formicar::motion::fastest;
use formicar::path::{CurvePath, Spacing, SpeedLimits, TimedPath};
use formicar::render::{DrivePicture, drive_picture};
use formicar::tracking::{TrackingConfig, track, track_in_time};
use formicar::vehicle::Vehicle;
use std::io::Write;
use words::Driven;

/// Carries out `track`.
pub(crate) fn run(args: &TrackArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let table = Target::of(args.csv.as_deref(), &[("csv", ())])?;
    let image = Target::of(args.picture.as_deref(), &picture::KINDS)?;
    let config = args.config()?;
    let scene = scene::load(&args.scene)?;
    let vehicle = &scene.vehicle.vehicle;
    let config = config.for_vehicle(vehicle).map_err(anyhow::Error::from)?;
    let file = path_file::read(&args.path, vehicle)?;
    let obstacles = ObstacleMap::new(&scene.map);
    let (planned, report) = file.judged(&obstacles, vehicle);
    let name = || args.path.display().to_string();
    let drive = if args.is_in_time(&config)? {
        let timed = timed(&file, planned, vehicle, &config);
        track_in_time(&timed, Some(&obstacles), vehicle, &config).with_context(name)?
    } else {
        track(planned, vehicle, &config).with_context(name)?
    };
    let driven = Driven {
        scene: &scene,
        obstacles: &obstacles,
        planned,
        report: &report,
        clearance: &drive.clearance(&obstacles, vehicle),
        drive: &drive,
    };
    if let Some(target) = table {
        target.write(drive.trace_csv().as_bytes())?;
    }
    if let Some(target) = image {
        write_picture(&driven, &target)?;
    }
    let document = drive.document(driven.clearance);
    let tracked = document.tracked;
    if args.json {
        print_json(out, &document)?;
    } else {
        words::explain(&driven, out)?;
    }
    Ok(if tracked {
        Ending::Done
    } else {
        Ending::NoPath
    })
}

/// The times to keep: those of the answer, or of the fastest drive at the speed of the simulation.
fn timed(
    file: &PathFile,
    planned: &CurvePath,
    vehicle: &Vehicle,
    config: &TrackingConfig,
) -> TimedPath {
    let recorded = file.motion.as_ref();
    let recorded = recorded.and_then(|motion| motion.timed(planned));
    recorded.unwrap_or_else(|| {
        let usual = SpeedLimits::default();
        let of_vehicle = SpeedLimits::of(vehicle).unwrap_or_else(|| usual.clone());
        let limits = SpeedLimits {
            max_speed_mps: config.speed_mps.unwrap_or(of_vehicle.max_speed_mps),
            max_acceleration_mps2: config
                .actuators
                .max_acceleration_mps2
                .unwrap_or(of_vehicle.max_acceleration_mps2),
            max_steer_rate_rad_per_s: config.max_steer_rate_rad_per_s,
            ..usual
        };
        fastest(planned, vehicle, &limits, Spacing::default())
    })
}

fn write_picture(driven: &Driven, target: &Target<PictureKind>) -> Result<()> {
    let (scene, clearance) = (driven.scene, driven.clearance);
    let vehicle = &scene.vehicle.vehicle;
    let nearest_at = clearance.contact.map_or(clearance.tightest, |c| c.pose);
    let place = driven.obstacles.contact(vehicle, nearest_at);
    let image = drive_picture(&DrivePicture {
        map: &scene.map,
        vehicle,
        planned: driven.planned,
        drive: driven.drive,
        tightest: Some((place, clearance.min_clearance_m)),
        title: &format!(
            "{}: {}",
            scene.record.name,
            words::verdict(driven).replace('_', " ")
        ),
        caption: &words::caption(driven),
    });
    target.write(&picture::encode(&image, target.kind)?)
}
