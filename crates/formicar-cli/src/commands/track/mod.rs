//! `track`: a vehicle driven along a path in simulation.

mod args;
mod words;

pub(crate) use args::TrackArgs;

use crate::failure::{Ending, Failure};
use crate::output::{Target, print_json};
use crate::path_file;
use crate::picture::{self, PictureKind};
use crate::scene;
use anyhow::{Context, Result};
use formicar::collision::ObstacleMap;
use formicar::render::{DrivePicture, drive_picture};
use formicar::tracking::track;
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
    let drive =
        track(planned, vehicle, &config).with_context(|| args.path.display().to_string())?;
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
