//! `drive`: a robot that senses, plans and drives in a simulated world.

mod args;
mod words;

pub(crate) use args::DriveArgs;

use crate::failure::{Ending, Failure};
use crate::output::{Target, print_json};
use crate::picture::{self, PictureKind};
use crate::scene::{self, Scene};
use anyhow::{Context, Result};
use formicar::geometry::Pose2;
use formicar::progress::StdClock;
use formicar::render::to_gif;
use formicar_drive::{
    DriveRecord, DriveView, Driver, KnownMap, Simulation, World, drive, drive_film, drive_picture,
};
use std::io::Write;

/// Width of a film, pixels.
const FILM_WIDTH_PX: u32 = 720;

/// Carries out `drive`.
pub(crate) fn run(args: &DriveArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let document = Target::of(args.out.as_deref(), &[("json", ())])?;
    let image = Target::of(args.picture.as_deref(), &picture::KINDS)?;
    let film = Target::of(args.film.as_deref(), &[("gif", ())])?;
    let scene = scene::load(&args.scene)?;
    let record = driven(args, &scene)?;
    if let Some(target) = document {
        let mut text = serde_json::to_vec(&record).map_err(anyhow::Error::from)?;
        text.push(b'\n');
        target.write(&text)?;
    }
    if let Some(target) = image {
        write_picture(&scene, &record, &target)?;
    }
    if let Some(target) = film {
        write_film(&scene, &record, &target)?;
    }
    if args.json {
        print_json(out, &record)?;
    } else {
        words::explain(&record, out)?;
    }
    Ok(if record.succeeds() {
        Ending::Done
    } else {
        Ending::NoPath
    })
}

fn driven(args: &DriveArgs, scene: &Scene) -> Result<DriveRecord> {
    let [start, goal] = ends(args, scene)?;
    let vehicle = &scene.vehicle.vehicle;
    let simulation = args.simulation();
    let driver = args.driver(&simulation);
    let agents = args.agents(&scene.map, vehicle, start)?;
    let known = if args.unknown_map {
        KnownMap::unknown(*scene.map.frame())
    } else {
        KnownMap::prior(&scene.map)
    };
    let world = World::new(scene.map.clone(), Vec::new());
    let mut robot = Simulation::new(world, vehicle, start, &simulation)?.with_agents(agents)?;
    let mut driver = Driver::new(known, vehicle, goal, &driver)?;
    let mut clock = StdClock::start();
    Ok(drive(&mut robot, &mut driver, &args.ending(), &mut clock)?)
}

fn ends(args: &DriveArgs, scene: &Scene) -> Result<[Pose2; 2]> {
    let [start, goal] = scene.ends.map_or([None, None], |ends| ends.map(Some));
    let start = args.start.or(start);
    let goal = args.goal.or(goal);
    Ok([
        start.context("a start is needed; hint: --start X,Y,H")?,
        goal.context("a goal is needed; hint: --goal X,Y,H")?,
    ])
}

fn view<'a>(scene: &'a Scene, record: &'a DriveRecord, texts: &'a [String; 2]) -> DriveView<'a> {
    DriveView {
        map: &scene.map,
        solids: &[],
        vehicle: &scene.vehicle.vehicle,
        record,
        title: &texts[0],
        caption: &texts[1],
    }
}

fn texts(scene: &Scene, record: &DriveRecord) -> [String; 2] {
    let verdict = words::verdict(record);
    let title = format!("{}: {verdict}", scene.record.name);
    [title, words::caption(record)]
}

fn write_picture(scene: &Scene, record: &DriveRecord, target: &Target<PictureKind>) -> Result<()> {
    let texts = texts(scene, record);
    let image = drive_picture(&view(scene, record, &texts));
    target.write(&picture::encode(&image, target.kind)?)
}

fn write_film(scene: &Scene, record: &DriveRecord, target: &Target<()>) -> Result<()> {
    // How the drive ends, no frame but the last can know.
    let texts = [scene.record.name.clone(), String::new()];
    let frames = drive_film(&view(scene, record, &texts));
    target.write(&to_gif(&frames, FILM_WIDTH_PX)?)
}
