//! Paths as ROS messages: `nav_msgs/Path` and `geometry_msgs/PoseArray`, in JSON, or in YAML as
//! `ros2 topic echo` prints them.

use super::samples::{ReadSamples, Samples};
use super::samples_error::{SamplesError, beginning};
use crate::geometry::{Point2, yaw_of_quaternion};
use serde::Deserialize;

#[derive(Deserialize)]
struct Message {
    poses: Vec<Stamped>,
}

/// A pose with a header around it, or bare.
#[derive(Deserialize)]
struct Stamped {
    pose: Option<Pose>,
    position: Option<Position>,
    orientation: Option<Quaternion>,
}

#[derive(Clone, Copy, Deserialize)]
struct Pose {
    position: Position,
    orientation: Quaternion,
}

#[derive(Clone, Copy, Deserialize)]
struct Position {
    x: f64,
    y: f64,
}

#[derive(Clone, Copy, Deserialize)]
struct Quaternion {
    #[serde(default)]
    x: f64,
    #[serde(default)]
    y: f64,
    z: f64,
    w: f64,
}

impl ReadSamples {
    /// Reads a path of any kind: a ROS message in JSON or YAML, or else a table.
    ///
    /// # Errors
    /// As [`Self::from_ros`] and [`Self::from_csv`].
    pub fn from_text(text: &str) -> Result<Self, SamplesError> {
        if is_message(text) {
            Self::from_ros(text)
        } else {
            Self::from_csv(text)
        }
    }

    /// Reads a `nav_msgs/Path` or `geometry_msgs/PoseArray`, in JSON or YAML.
    ///
    /// Where every orientation is 0 while the path turns, nobody has set them: the path is one of
    /// points.
    ///
    /// ```
    /// use formicar::validation::ReadSamples;
    ///
    /// let yaml = "poses:\n- pose:\n    position: {x: 1.0, y: 3.0, z: 0.0}\n    \
    ///             orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n---\n";
    /// assert_eq!(ReadSamples::from_ros(yaml)?.samples.points[0].y, 3.0);
    /// # Ok::<(), formicar::validation::SamplesError>(())
    /// ```
    ///
    /// # Errors
    /// Another document, several messages, no poses, or a pose that is none.
    pub fn from_ros(text: &str) -> Result<Self, SamplesError> {
        let message = message(text)?;
        let problem = SamplesError::Message;
        if message.poses.is_empty() {
            let none = "poses: none; hint: the planner has found no path";
            return Err(problem(none.to_owned()));
        }
        let mut points = Vec::new();
        let mut headings = Vec::new();
        let mut kind = "nav_msgs/Path";
        for (i, stamped) in message.poses.iter().enumerate() {
            let Pose {
                position: Position { x, y },
                orientation,
            } = stamped.pose(i)?;
            if stamped.pose.is_none() {
                kind = "geometry_msgs/PoseArray";
            }
            if ![x, y].iter().all(|number| number.abs() <= 1e9) {
                return Err(problem(format!(
                    "poses[{i}]: the position is ({x}, {y}); expected numbers between -1e9 and 1e9"
                )));
            }
            let Quaternion { x: a, y: b, z, w } = orientation;
            let heading = yaw_of_quaternion([a, b, z, w]).ok_or_else(|| {
                let part = "the orientation points nowhere; expected a unit quaternion";
                problem(format!("poses[{i}]: {part}"))
            })?;
            points.push(Point2::new(x, y));
            headings.push(heading);
        }
        let headings = Some(headings).filter(|headings| !are_unset(headings, &points));
        let what = match headings {
            Some(_) => "positions and orientations",
            None => "positions, the orientations are not set",
        };
        Ok(Self {
            reading: format!("{what} of a {kind}"),
            hint: None,
            samples: Samples {
                points,
                headings,
                rounding_m: 0.0,
            },
        })
    }
}

impl Stamped {
    fn pose(&self, i: usize) -> Result<Pose, SamplesError> {
        let bare = self.position.zip(self.orientation);
        let bare = bare.map(|(position, orientation)| Pose {
            position,
            orientation,
        });
        self.pose.or(bare).ok_or_else(|| {
            let expected = "expected a pose, or a position and an orientation";
            SamplesError::Message(format!("poses[{i}]: {expected}"))
        })
    }
}

/// True if a text begins like a message rather than like a table.
fn is_message(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim_end);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with(['#', '-']));
    let first = first.unwrap_or_default();
    text.trim_start().starts_with(['{', '[']) || first == "header:" || first.starts_with("poses:")
}

fn message(text: &str) -> Result<Message, SamplesError> {
    let expected = "expected poses: a list, each with position and orientation";
    let problem = |error: String| SamplesError::Message(format!("{error}; {expected}"));
    if text.trim_start().starts_with(['{', '[']) {
        return serde_json::from_str(text).map_err(|error| problem(error.to_string()));
    }
    // Three dashes stand behind every message.
    let mut messages = vec![String::new()];
    for line in text.lines() {
        if line.trim_end() == "---" {
            messages.push(String::new());
        } else if let Some(message) = messages.last_mut() {
            message.push_str(line);
            message.push('\n');
        }
    }
    messages.retain(|message| !message.trim().is_empty());
    match &messages[..] {
        [only] => serde_saphyr::from_str(only)
            .map_err(|error| problem(beginning(&error.without_snippet().to_string()))),
        _ => Err(SamplesError::Message(format!(
            "{} messages; hint: keep one, or ros2 topic echo --once",
            messages.len()
        ))),
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
    use std::f64::consts::{FRAC_PI_2, PI};

    const PATH: &str = r#"{"header": {"frame_id": "map"}, "poses": [
        {"header": {}, "pose": {"position": {"x": 1.5, "y": 2, "z": 0},
            "orientation": {"x": 0, "y": 0, "z": 0.7071067811865476, "w": 0.7071067811865476}}},
        {"pose": {"position": {"x": 1.5, "y": 3}, "orientation": {"z": -2, "w": 0}}}]}"#;

    const ECHO: &str = "header:\n  stamp:\n    sec: 12\n    nanosec: 0\n  frame_id: map\nposes:\n\
        - header:\n    stamp:\n      sec: 0\n      nanosec: 0\n    frame_id: map\n  pose:\n    \
        position:\n      x: 1.0\n      y: 3.0\n      z: 0.0\n    orientation:\n      x: 0.0\n      \
        y: 0.0\n      z: 0.0\n      w: 1.0\n---\n";

    fn read(text: &str) -> Result<Samples, String> {
        let read = ReadSamples::from_text(text);
        read.map(|read| read.samples)
            .map_err(|error| error.to_string())
    }

    #[test]
    fn positions_and_headings_come_out() {
        let samples = read(PATH).unwrap();
        assert_eq!(samples.points[1], Point2::new(1.5, 3.0));
        let headings = samples.headings.unwrap();
        assert!((headings[0] - FRAC_PI_2).abs() < 1e-12);
        assert!((headings[1].abs() - PI).abs() < 1e-12);
        let unset = PATH
            .replace("0.7071067811865476, \"w\"", "0, \"w\"")
            .replace("-2, \"w\": 0", "0, \"w\": 1");
        assert_eq!(read(&unset).unwrap().headings, None);
    }

    #[test]
    fn what_ros2_topic_echo_prints_is_read() {
        let samples = read(ECHO).unwrap();
        assert_eq!(samples.points, [Point2::new(1.0, 3.0)]);
        assert_eq!(samples.headings, Some(vec![0.0]));
        let two = read(&format!("{ECHO}{ECHO}")).unwrap_err();
        assert!(
            two.contains("2 messages") && two.contains("--once"),
            "{two}"
        );
        assert_eq!(read(&format!("---\n{ECHO}")).unwrap(), samples);
        let none = read(&ECHO.replace("x: 1.0", "x: .nan")).unwrap_err();
        assert!(none.contains("the position is (NaN"), "{none}");
    }

    #[test]
    fn pose_arrays_are_read() {
        let array =
            r#"{"poses": [{"position": {"x": 1, "y": 3}, "orientation": {"z": 0, "w": 1}}]}"#;
        assert_eq!(read(array).unwrap().points[0], Point2::new(1.0, 3.0));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        for (from, to, told) in [
            ("\"y\": 3", "\"v\": 3", "missing field `y` at line 4"),
            ("\"y\": 2", "\"y\": \"up\"", "line 2 column"),
            ("\"z\": -2", "\"z\": 0", "poses[1]: the orientation"),
            (
                "\"x\": 1.5, \"y\": 3",
                "\"x\": 1e10, \"y\": 3",
                "poses[1]: the position",
            ),
            (
                "\"pose\": {\"position\": {\"x\": 1.5, \"y\": 3}",
                "\"pos\": {\"position\": {\"x\": 1.5, \"y\": 3}",
                "poses[1]: expected a pose",
            ),
            ("poses", "pose", "missing field `poses`"),
        ] {
            let error = read(&PATH.replace(from, to)).unwrap_err();
            assert!(error.contains(told), "{told}: {error}");
        }
        assert!(read("{\"poses\": []}").unwrap_err().contains("none"));
        assert!(read("poses: [\n").unwrap_err().contains("expected poses"));
    }

    #[test]
    fn no_text_makes_it_panic() {
        for text in [PATH, ECHO] {
            for end in text.char_indices().map(|(i, _)| i).step_by(3) {
                drop(read(&text[..end]));
                for odd in ["", "-", "9", "\"", "\n", ";", "nan", "\u{e9}"] {
                    drop(read(&format!("{}{odd}{}", &text[..end], &text[end + 1..])));
                }
            }
        }
    }
}
