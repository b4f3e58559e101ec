//! A `nav_msgs/Path` message of ROS as JSON: what Nav2 and `move_base` publish.

use anyhow::{Result, anyhow, bail};
use formicar::geometry::Point2;
use formicar::validation::Samples;
use serde::Deserialize;

/// Norm of a quaternion below which it points nowhere.
const MIN_NORM: f64 = 1e-6;

#[derive(Deserialize)]
struct Message {
    poses: Vec<Stamped>,
}

#[derive(Deserialize)]
struct Stamped {
    pose: Pose,
}

#[derive(Deserialize)]
struct Pose {
    position: Position,
    orientation: Quaternion,
}

#[derive(Deserialize)]
struct Position {
    x: f64,
    y: f64,
}

#[derive(Deserialize)]
struct Quaternion {
    #[serde(default)]
    x: f64,
    #[serde(default)]
    y: f64,
    z: f64,
    w: f64,
}

/// The path; where every orientation is the same while the path turns, nobody has set them, and
/// the path is one of points.
pub(super) fn read(text: &str) -> Result<Samples> {
    let message: Message = serde_json::from_str(text)
        .map_err(|error| anyhow!("{error}; expected {{\"poses\": [{{\"pose\": ...}}]}}"))?;
    if message.poses.is_empty() {
        bail!("poses: none; hint: the planner has found no path");
    }
    let mut samples = Samples {
        points: Vec::new(),
        headings: None,
        rounding_m: 0.0,
    };
    let mut headings = Vec::new();
    for (i, stamped) in message.poses.iter().enumerate() {
        let Pose {
            position,
            orientation,
        } = &stamped.pose;
        if position.x.abs().max(position.y.abs()) > 1e9 {
            bail!("poses[{i}].pose.position: expected numbers between -1e9 and 1e9");
        }
        let heading = orientation.heading_rad().ok_or_else(|| {
            anyhow!("poses[{i}].pose.orientation: it points nowhere; expected a unit quaternion")
        })?;
        samples.points.push(Point2::new(position.x, position.y));
        headings.push(heading);
    }
    samples.headings = Some(headings).filter(|headings| !are_unset(headings, &samples.points));
    Ok(samples)
}

impl Quaternion {
    /// The turn around the z axis; none where there is no direction.
    fn heading_rad(&self) -> Option<f64> {
        let Self { x, y, z, w } = *self;
        let norm = (x * x + y * y + z * z + w * w).sqrt();
        if !(MIN_NORM..=1.0 / MIN_NORM).contains(&norm) {
            return None;
        }
        let [x, y, z, w] = [x, y, z, w].map(|part| part / norm);
        Some((2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z)))
    }
}

/// True if all headings are 0 though the path does not run along the x axis.
fn are_unset(headings: &[f64], points: &[Point2]) -> bool {
    let is_along = |pair: &[Point2]| (pair[1].y - pair[0].y).abs() < 1e-9;
    headings.iter().all(|heading| *heading == 0.0) && !points.windows(2).all(is_along)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATH: &str = r#"{"header": {"frame_id": "map"}, "poses": [
        {"header": {}, "pose": {"position": {"x": 1.5, "y": 2, "z": 0},
            "orientation": {"x": 0, "y": 0, "z": 0.7071067811865476, "w": 0.7071067811865476}}},
        {"pose": {"position": {"x": 1.5, "y": 3}, "orientation": {"z": -2, "w": 0}}}]}"#;

    #[test]
    fn positions_and_headings_come_out() {
        let samples = read(PATH).unwrap();
        assert_eq!(samples.points[1], Point2::new(1.5, 3.0));
        let headings = samples.headings.unwrap();
        assert!((headings[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert!((headings[1].abs() - std::f64::consts::PI).abs() < 1e-12);
        let unset = PATH
            .replace("0.7071067811865476, \"w\"", "0, \"w\"")
            .replace("-2, \"w\": 0", "0, \"w\": 1");
        assert_eq!(read(&unset).unwrap().headings, None);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        for (from, to, told) in [
            ("\"y\": 3", "\"v\": 3", "missing field `y` at line 4"),
            ("\"y\": 2", "\"y\": \"up\"", "line 2 column"),
            ("\"z\": -2", "\"z\": 0", "poses[1].pose.orientation"),
            (
                "\"x\": 1.5, \"y\": 3",
                "\"x\": 1e10, \"y\": 3",
                "poses[1].pose.position",
            ),
            ("poses", "pose", "missing field `poses`"),
        ] {
            let error = read(&PATH.replace(from, to)).unwrap_err().to_string();
            assert!(error.contains(told), "{told}: {error}");
        }
        assert!(
            read("{\"poses\": []}")
                .unwrap_err()
                .to_string()
                .contains("none")
        );
    }

    #[test]
    fn no_text_makes_it_panic() {
        crate::rival::import::tests::assert_no_text_panics(PATH, |text| drop(read(text)));
    }
}
