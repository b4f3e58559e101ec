//! The family of 2-turnings at a right angle, with the tangent points of the nearest one.
//!
//! `cargo run --release -p formicar --example 09_two_turning`

use formicar::geometry::{Point2, Pose2};
use formicar::map::{GridFrame, OccupancyGrid};
use formicar::path::{CurvePath, Direction, WaypointPath};
use formicar::render::{Dash, LineStyle, Picture, Scene, palette};
use formicar::smoothing::{TurnOrder, TwoTurning};
use formicar::vehicle::Vehicle;
use std::{error::Error, f64::consts::FRAC_PI_2, fs};

const CORNER: Point2 = Point2::new(7.0, 2.5);

fn main() -> Result<(), Box<dyn Error>> {
    let frame = GridFrame::new(100, 100, 0.1, Pose2::default())?;
    let mut scene = Scene::new(&OccupancyGrid::free(frame));
    let points = vec![Point2::new(0.5, 2.5), CORNER, Point2::new(7.0, 9.5)];
    scene.waypoint_path(&WaypointPath { points });

    let radius_m = Vehicle::lei2020().min_turning_radius_m();
    let family = TwoTurning::family(FRAC_PI_2, radius_m, 6);
    for member in family.iter().filter(|m| m.order == TurnOrder::AvoidFirst) {
        let poses = driven(member).sample(0.05);
        let points: Vec<Point2> = poses.iter().map(|p| p.pose.position()).collect();
        let style = LineStyle {
            label: String::new(),
            color: palette::heat(0.3 + 0.6 * member.beta_rad),
            width_px: 1.8,
            dash: Dash::Solid,
        };
        scene.polyline(&points, &style);
    }
    let path = driven(&family[0]);
    scene.curve(&path);
    for (segment, name) in path.segments().iter().zip(["S1", "S2"]) {
        scene.point(segment.start.position(), name);
    }
    scene.point(path.end().position(), "S3");
    for (center, name) in family[0].centers().into_iter().zip(["O1", "O2"]) {
        scene.point(CORNER + center, name);
    }
    let picture = Picture {
        title: "2-turning at a right angle".to_owned(),
        scene: Some(scene),
        ..Picture::default()
    };
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/09_two_turning.svg", picture.to_svg())?;
    Ok(())
}

fn driven(turning: &TwoTurning) -> CurvePath {
    let first = CORNER - Point2::new(turning.before_m, 0.0);
    let mut path = CurvePath::new(Pose2::at(first, 0.0));
    for arc in turning.arcs() {
        path.push(arc.curvature_per_m, arc.length_m(), Direction::Forward);
    }
    path
}
