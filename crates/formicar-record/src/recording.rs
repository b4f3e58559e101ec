//! A plan as a bag: map, path, gears, and the vehicle that drives it.

use crate::error::RecordError;
use crate::grid::to_message;
use crate::messages::{
    ColorRGBA, Header, Marker, MarkerArray, OccupancyGrid as GridMessage, Path, Point, Point32,
    Polygon, PolygonStamped, Pose, PoseStamped, Quaternion, TFMessage, Time, TransformStamped,
    Vector3,
};
use crate::qos::Durability;
use crate::writer::BagWriter;
use formicar::path::{Direction, PathPose};
use formicar::{CurvePath, OccupancyGrid, Pose2, Vehicle};
use std::io::{Seek, Write};

/// A plan to record.
///
/// Topics: `/map` and `/plan` (latched), `/plan_gears` (latched: a line for each stretch in a gear),
/// `/plan_footprints` (latched: outlines of the body along the path), `/footprint` and `/tf` (the
/// body on its drive, at constant speed). The recording begins at time 0, so that the same plan gives
/// the same bytes.
#[derive(Clone, Copy, Debug)]
pub struct Recording<'a> {
    /// The map.
    pub map: &'a OccupancyGrid,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// The path, in the coordinates of the map.
    pub path: &'a CurvePath,
    /// Speed of the drive, meters per second.
    pub speed_mps: f64,
}

/// Frames of the recording.
const MAP: &str = "map";
const BASE: &str = "base_link";
/// Distance of two poses of the path, meters.
const POSE_EVERY_M: f64 = 0.05;
/// Distance of two outlines of the body, meters.
const OUTLINE_EVERY_M: f64 = 0.25;
/// Time of two poses of the drive, seconds.
const DRIVE_EVERY_S: f64 = 0.05;

const FORWARD: [f32; 3] = [0.0, 0.45, 0.70];
const REVERSE: [f32; 3] = [0.84, 0.37, 0.0];

impl Recording<'_> {
    /// Writes the recording.
    ///
    /// # Errors
    /// A sink that cannot be written.
    pub fn write<W: Write + Seek>(&self, sink: W) -> Result<W, RecordError> {
        let mut writer = BagWriter::new(sink)?;
        writer.advertise::<GridMessage>("/map", Durability::Latched)?;
        writer.write("/map", 0, &to_message(self.map, MAP, Time::default()))?;
        for topic in ["/plan_gears", "/plan_footprints"] {
            writer.advertise::<MarkerArray>(topic, Durability::Latched)?;
        }
        writer.advertise::<Path>("/plan", Durability::Latched)?;
        writer.write("/plan", 0, &path_message(self.path))?;
        writer.write("/plan_gears", 0, &gears(self.path))?;
        writer.write("/plan_footprints", 0, &self.outlines())?;
        self.write_drive(&mut writer)?;
        writer.finish()
    }

    /// The body along the path, over time.
    fn write_drive<W: Write + Seek>(&self, writer: &mut BagWriter<W>) -> Result<(), RecordError> {
        let spacing_m = self.speed_mps * DRIVE_EVERY_S;
        for pose in self.path.sample(spacing_m) {
            let time_ns = (1e9 * pose.s_m / self.speed_mps).round() as u64;
            let stamp = Time::of_nanoseconds(time_ns);
            let transform = TransformStamped {
                header: Header::new(MAP, stamp.clone()),
                child_frame_id: BASE.to_owned(),
                transform: pose.pose.into(),
            };
            let transforms = vec![transform];
            writer.write("/tf", time_ns, &TFMessage { transforms })?;
            let footprint = PolygonStamped {
                header: Header::new(MAP, stamp),
                polygon: self.body_at(pose.pose),
            };
            writer.write("/footprint", time_ns, &footprint)?;
        }
        Ok(())
    }

    fn body_at(&self, pose: Pose2) -> Polygon {
        let placed = self.vehicle.footprint().placed(pose);
        let corners = placed.corners().iter().map(|corner| Point32 {
            x: corner.x as f32,
            y: corner.y as f32,
            z: 0.0,
        });
        Polygon {
            points: corners.collect(),
        }
    }

    /// Outlines of the body along the path, a marker each.
    fn outlines(&self) -> MarkerArray {
        let poses = self.path.sample(OUTLINE_EVERY_M);
        let outlines = poses.iter().enumerate().map(|(i, pose)| {
            let corners = self.vehicle.footprint().placed(pose.pose);
            let corners = corners.corners();
            let closed = corners.iter().chain(corners.first());
            let points = closed.map(|corner| point(corner.x, corner.y)).collect();
            line("footprints", i, (0.01, [0.5, 0.5, 0.5]), points)
        });
        MarkerArray {
            markers: outlines.collect(),
        }
    }
}

fn path_message(path: &CurvePath) -> Path {
    let header = Header::new(MAP, Time::default());
    let poses = path.sample(POSE_EVERY_M);
    let poses = poses.iter().map(|pose| PoseStamped {
        header: header.clone(),
        pose: pose.pose.into(),
    });
    Path {
        poses: poses.collect(),
        header,
    }
}

/// A line for each stretch in one gear.
fn gears(path: &CurvePath) -> MarkerArray {
    let poses = path.sample(POSE_EVERY_M);
    let Some(first) = poses.first() else {
        return MarkerArray::default();
    };
    let mut stretches: Vec<(Direction, Vec<Point>)> = Vec::new();
    let mut before = first;
    for pose in poses.iter().skip(1) {
        let place = |pose: &PathPose| point(pose.pose.x, pose.pose.y);
        match stretches.last_mut() {
            Some((gear, points)) if *gear == pose.direction => points.push(place(pose)),
            _ => stretches.push((pose.direction, vec![place(before), place(pose)])),
        }
        before = pose;
    }
    let markers = stretches
        .into_iter()
        .enumerate()
        .map(|(i, (gear, points))| {
            let (name, color) = match gear {
                Direction::Forward => ("forward", FORWARD),
                Direction::Reverse => ("reverse", REVERSE),
            };
            line(name, i, (0.04, color), points)
        });
    MarkerArray {
        markers: markers.collect(),
    }
}

fn point(x: f64, y: f64) -> Point {
    Point { x, y, z: 0.0 }
}

/// A line of a width and a color.
fn line(ns: &str, id: usize, (width_m, [r, g, b]): (f64, [f32; 3]), points: Vec<Point>) -> Marker {
    Marker {
        header: Header::new(MAP, Time::default()),
        ns: ns.to_owned(),
        id: id as i32,
        r#type: Marker::LINE_STRIP,
        pose: Pose {
            orientation: Quaternion::of_heading(0.0),
            ..Pose::default()
        },
        scale: Vector3 {
            x: width_m,
            ..Vector3::default()
        },
        color: ColorRGBA { r, g, b, a: 1.0 },
        points,
        ..Marker::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bag::Bag;
    use crate::grid::{MapAt, read_map};
    use std::io::Cursor;

    #[test]
    fn a_plan_is_recorded_with_its_gears() {
        let map = OccupancyGrid::from_rows(&["...", "..#"], 1.0).unwrap();
        let mut path = CurvePath::new(Pose2::new(0.5, 0.5, 0.0));
        path.push(0.0, 1.0, Direction::Forward);
        path.push(0.5, 0.5, Direction::Reverse);
        let recording = Recording {
            map: &map,
            vehicle: &Vehicle::warehouse_amr(),
            path: &path,
            speed_mps: 1.0,
        };
        let bytes = recording
            .write(Cursor::new(Vec::new()))
            .unwrap()
            .into_inner();
        let again = recording
            .write(Cursor::new(Vec::new()))
            .unwrap()
            .into_inner();
        assert!(bytes == again, "the same plan, the same bytes");
        let mut bag = Bag::open("plan.mcap", Cursor::new(bytes)).unwrap();
        assert_eq!(read_map(&mut bag, None, MapAt::Last).unwrap().0, map);
        let (mut namespaces, mut n_poses, mut last_s) = (Vec::new(), 0, 0.0);
        bag.visit(&["/plan_gears", "/plan", "/tf"], |message| {
            match message.topic {
                "/plan_gears" => {
                    let gears: MarkerArray = message.decode()?;
                    namespaces.extend(gears.markers.into_iter().map(|marker| marker.ns));
                }
                "/plan" => n_poses = message.decode::<Path>()?.poses.len(),
                _ => {
                    let moved: TFMessage = message.decode()?;
                    last_s = moved.transforms[0].header.stamp.seconds();
                }
            }
            Ok(())
        })
        .unwrap();
        assert_eq!(namespaces, ["forward", "reverse"]);
        assert!(n_poses >= 31, "{n_poses}");
        assert!((last_s - 1.5).abs() < 1e-6, "{last_s}");
    }
}
