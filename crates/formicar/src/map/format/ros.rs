//! The YAML that describes a map of the ROS `map_server`.

use super::error::excerpt;
use super::{FormatError, FormatProblem, Place};
use crate::geometry::{MAX_STATED_HEADING_RAD, Pose2};
use crate::map::GridFrame;
use std::fmt;
use std::path::{Path, PathBuf};

/// Least occupancy of an occupied cell, where no description says otherwise.
pub(super) const DEFAULT_OCCUPIED_THRESHOLD: f64 = 0.65;
/// Largest occupancy of a free cell, where no description says otherwise.
pub(super) const DEFAULT_FREE_THRESHOLD: f64 = 0.196;

/// The conversion of grey values to cell values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RosMapMode {
    /// Occupied, free, or unknown in between.
    #[default]
    Trinary,
    /// Occupied, free, or graded from 0 to 100 in between.
    Scale,
    /// Values 0 to 100 as they are, others unknown; needs an image with 8 bits.
    Raw,
}

impl fmt::Display for RosMapMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Trinary => "trinary",
            Self::Scale => "scale",
            Self::Raw => "raw",
        })
    }
}

/// The YAML description of a ROS map.
///
/// With grey scaled to 0 (black) to 1 (white), a pixel's occupancy is p = 1 - grey, or grey where
/// `negate` is set. In the modes trinary and scale a cell is occupied from `occupied_threshold`
/// on and free up to `free_threshold`, both included, and unknown where the image is not fully
/// opaque.
///
/// ```
/// use formicar::map::format::RosMapDescription;
///
/// let yaml = "image: depot.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\n\
///             negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";
/// let description = RosMapDescription::from_yaml(yaml)?;
/// assert_eq!((description.resolution_m, description.origin.y), (0.05, 2.0));
/// # Ok::<(), formicar::map::format::FormatError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RosMapDescription {
    /// The image as written: absolute, in the home folder (`~/`), or relative to the description.
    pub image: String,
    /// Side of a cell, meters, above 0.
    pub resolution_m: f64,
    /// Pose of the lower left corner, meters and radians.
    pub origin: Pose2,
    /// True if white is occupied instead of black.
    pub negate: bool,
    /// In 0..=1.
    pub occupied_threshold: f64,
    /// In 0..=1, at most `occupied_threshold`.
    pub free_threshold: f64,
    /// The conversion of grey values to cell values.
    pub mode: RosMapMode,
}

/// The keys as users write them; keys that are not listed are ignored, as Nav2 does.
#[derive(serde::Deserialize)]
struct Keys {
    image: Option<String>,
    resolution: Option<f64>,
    origin: Option<Vec<f64>>,
    negate: Option<Negate>,
    occupied_thresh: Option<f64>,
    free_thresh: Option<f64>,
    mode: Option<RosMapMode>,
}

#[derive(serde::Deserialize)]
#[serde(untagged, expecting = "negate must be 0, 1, true or false")]
enum Negate {
    Flag(bool),
    Number(i64),
    Text(String),
}

impl RosMapDescription {
    /// Reads a description; everything but `mode` must be given.
    ///
    /// # Errors
    /// No YAML, a key that is missing, or a value that cannot be.
    pub fn from_yaml(yaml: &str) -> Result<Self, FormatError> {
        let keys: Keys = serde_saphyr::from_str(yaml).map_err(|e| yaml_error(&e, yaml))?;
        let image = needed("image", keys.image)?;
        if image.is_empty() {
            return Err(FormatProblem::bad_value("image", "", "a file name").into());
        }
        let negate = match needed("negate", keys.negate)? {
            Negate::Flag(negate) => negate,
            Negate::Number(number @ (0 | 1)) => number == 1,
            Negate::Text(text) => match text.as_str() {
                "0" | "false" => false,
                "1" | "true" => true,
                other => {
                    let expected = "0, 1, true or false";
                    return Err(FormatProblem::bad_value("negate", other, expected).into());
                }
            },
            Negate::Number(other) => {
                return Err(FormatProblem::bad_value("negate", other, "0 or 1").into());
            }
        };
        let description = Self {
            image,
            resolution_m: needed("resolution", keys.resolution)?,
            origin: origin(&needed("origin", keys.origin)?)?,
            negate,
            occupied_threshold: needed("occupied_thresh", keys.occupied_thresh)?,
            free_threshold: needed("free_thresh", keys.free_thresh)?,
            mode: keys.mode.unwrap_or_default(),
        };
        description.check()?;
        Ok(description)
    }

    /// A description of an image about which nothing else is known.
    pub(super) fn of_bare_image(resolution_m: f64) -> Self {
        Self {
            image: String::new(),
            resolution_m,
            origin: Pose2::default(),
            negate: false,
            occupied_threshold: DEFAULT_OCCUPIED_THRESHOLD,
            free_threshold: DEFAULT_FREE_THRESHOLD,
            mode: RosMapMode::Trinary,
        }
    }

    pub(super) fn check(&self) -> Result<(), FormatError> {
        let thresholds = [
            ("occupied_thresh", self.occupied_threshold),
            ("free_thresh", self.free_threshold),
        ];
        for (thing, value) in thresholds {
            if !(0.0..=1.0).contains(&value) {
                return Err(FormatProblem::bad_value(thing, value, "between 0 and 1").into());
            }
        }
        if self.free_threshold > self.occupied_threshold {
            let expected = format!("at most occupied_thresh ({})", self.occupied_threshold);
            return Err(
                FormatProblem::bad_value("free_thresh", self.free_threshold, expected).into(),
            );
        }
        GridFrame::new(1, 1, self.resolution_m, self.origin)?;
        Ok(())
    }

    /// The path of the image, for a description in a file at `yaml_path`.
    ///
    /// # Errors
    /// A `~/` without a home folder.
    pub fn image_path(&self, yaml_path: &Path) -> Result<PathBuf, FormatError> {
        let Some(in_home) = self.image.strip_prefix("~/") else {
            return Ok(yaml_path.with_file_name("").join(&self.image));
        };
        let home = std::env::var_os("HOME").ok_or(FormatProblem::Missing {
            thing: "the home folder",
            hint: "set HOME, or write the image's path in full",
        })?;
        Ok(Path::new(&home).join(in_home))
    }
}

/// The error with the line that it is about, if it knows one.
fn yaml_error(error: &serde_saphyr::Error, yaml: &str) -> FormatError {
    let mut message = error.without_snippet().to_string();
    // The reader's advice is for programs, not for those who write maps.
    if let Some(key) = message.strip_prefix("duplicate mapping key: ") {
        let key = key.split([',', ' ']).next().unwrap_or_default();
        message = format!("the key {key} stands twice; hint: remove one of the two");
    } else if message.starts_with("expected sequence start") {
        "expected a list; hint: [x, y, yaw] in meters and radians, without quotes"
            .clone_into(&mut message);
    } else if message.starts_with("invalid floating point") {
        "expected a number; hint: a map saver writes nan where it knew no pose; write 0"
            .clone_into(&mut message);
    }
    let line = error.location().map_or(0, |at| at.line() as usize);
    let source = line.checked_sub(1).and_then(|i| yaml.lines().nth(i));
    match source {
        Some(source) => FormatProblem::Yaml(format!("{:?}: {message}", excerpt(source.trim())))
            .at(Place::Line(line)),
        None => FormatProblem::Yaml(message).into(),
    }
}

fn needed<T>(thing: &'static str, value: Option<T>) -> Result<T, FormatProblem> {
    let hint = "a ROS map needs image, resolution, origin, negate, occupied_thresh and free_thresh";
    value.ok_or(FormatProblem::Missing { thing, hint })
}

fn origin(numbers: &[f64]) -> Result<Pose2, FormatProblem> {
    match *numbers {
        [_, _, yaw] if yaw.abs() > MAX_STATED_HEADING_RAD => Err(FormatProblem::bad_value(
            "the origin's yaw",
            yaw,
            format!(
                "in radians, within a turn; hint: {yaw} degrees are {:.4}",
                yaw.to_radians()
            ),
        )),
        [x, y, yaw] => Ok(Pose2::new(x, y, yaw)),
        _ => Err(FormatProblem::bad_value(
            "origin",
            format!("a list of {} numbers", numbers.len()),
            "[x, y, yaw] in meters and radians",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const YAML: &str = "image: m.pgm\nresolution: 0.05\norigin: [1, -2.5, 0.3]\nnegate: 0\n\
        occupied_thresh: 0.65\nfree_thresh: 0.196\n";

    fn parse(from: &str, to: &str) -> Result<RosMapDescription, FormatError> {
        assert!(YAML.contains(from));
        RosMapDescription::from_yaml(&YAML.replace(from, to))
    }

    fn message(from: &str, to: &str) -> String {
        parse(from, to).unwrap_err().to_string()
    }

    #[test]
    fn reads_what_users_write() {
        let description = RosMapDescription::from_yaml(YAML).unwrap();
        assert_eq!(description.origin, Pose2::new(1.0, -2.5, 0.3));
        assert_eq!(description.mode, RosMapMode::Trinary);
        assert!(!description.negate);
        for (text, negate) in [
            ("1", true),
            ("true", true),
            ("false", false),
            ("\"0\"", false),
            ("\"1\"", true),
        ] {
            let description = parse("negate: 0", &format!("negate: {text}")).unwrap();
            assert_eq!(description.negate, negate, "{text}");
        }
        let with_more = parse(
            "negate: 0",
            "negate: 0\nmode: scale\nauthor: [me, {you: 2}]",
        );
        assert_eq!(with_more.unwrap().mode, RosMapMode::Scale);
    }

    #[test]
    fn finds_the_image() {
        let at = |image: &str| {
            let description = parse("m.pgm", image).unwrap();
            description.image_path(Path::new("maps/m.yaml")).unwrap()
        };
        assert_eq!(at("m.pgm"), Path::new("maps/m.pgm"));
        assert_eq!(at("/abs/m.pgm"), Path::new("/abs/m.pgm"));
        if let Some(home) = std::env::var_os("HOME") {
            assert_eq!(at("~/m.pgm"), Path::new(&home).join("m.pgm"));
        }
    }

    #[test]
    fn names_what_is_missing_or_wrong() {
        for key in [
            "image",
            "resolution",
            "origin",
            "negate",
            "occupied_thresh",
            "free_thresh",
        ] {
            let message = message(&format!("{key}:"), "other:");
            assert!(message.contains(&format!("{key} is missing")), "{message}");
        }
        assert!(message("0.05", "0").contains("resolution 0 m"));
        assert!(message("0.05", "-1").contains("resolution -1 m"));
        assert!(message("0.05", ".nan").contains("resolution NaN m"));
        assert!(message("[1, -2.5, 0.3]", "[1, 2]").contains("a list of 2 numbers"));
        assert!(message("[1, -2.5, 0.3]", "[1, .inf, 0]").contains("origin (1, inf, 0)"));
        assert!(message("negate: 0", "negate: 2").contains("negate is 2; it must be 0 or 1"));
        assert!(message("0.65", "65").contains("occupied_thresh is 65"));
        assert!(message("0.65", "0.1").contains("free_thresh is 0.196; it must be at most"));
        let mode = message("negate: 0", "negate: 0\nmode: rough");
        assert!(mode.contains("rough") && mode.contains("trinary"), "{mode}");
        let broken = message("0.05", "wide");
        assert!(
            broken.contains("wide") && broken.contains("line 2"),
            "{broken}"
        );
        let twice = message("negate: 0", "negate: 0\nnegate: 0");
        assert!(
            twice.contains("negate stands twice") && !twice.contains("Policy"),
            "{twice}"
        );
        let text = message("[1, -2.5, 0.3]", "\"[1, -2.5, 0.3]\"");
        assert!(
            text.contains("expected a list; hint: [x, y, yaw]"),
            "{text}"
        );
        let nan = message("0.3]", "-nan]");
        assert!(nan.contains("-nan") && nan.contains("write 0"), "{nan}");
        let degrees = message("0.3]", "90]");
        assert!(degrees.contains("90 degrees are 1.5708"), "{degrees}");
        assert!(message("0.05", "1e300").contains("resolution 1"));
        assert!(message("-2.5", "1e300").contains("origin (1, 1"));
        assert!(message("negate: 0", "negate: maybe").contains("0, 1, true or false"));
        assert!(RosMapDescription::from_yaml("- a\n- b").is_err());
        assert!(RosMapDescription::from_yaml("image: [").is_err());
    }
}
