//! Maps of the ROS `map_server`: a YAML description and a PGM or PNG image.

use super::error::excerpt;
use super::files::{MAX_MAP_BYTES, MAX_TEXT_BYTES, read_bytes, text};
use super::{FormatError, FormatProblem, GreyImage, Place};
use crate::geometry::Pose2;
use crate::map::{FREE, GridFrame, OCCUPIED, OccupancyGrid, UNKNOWN};
use serde::Deserialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// Least occupancy of an occupied cell, where no description says otherwise.
pub(super) const DEFAULT_OCCUPIED_THRESHOLD: f64 = 0.65;
/// Largest occupancy of a free cell, where no description says otherwise.
pub(super) const DEFAULT_FREE_THRESHOLD: f64 = 0.196;

/// How grey values become cell values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
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
#[derive(Clone, Debug, PartialEq)]
pub struct RosMapDescription {
    /// The image as written: absolute, in the home folder (`~/`), or relative to the description.
    pub image: String,
    /// Side of a cell, metres, above 0.
    pub resolution_m: f64,
    /// Pose of the lower left corner, metres and radians.
    pub origin: Pose2,
    /// Whether white is occupied instead of black.
    pub negate: bool,
    /// In 0..=1.
    pub occupied_threshold: f64,
    /// In 0..=1, at most `occupied_threshold`.
    pub free_threshold: f64,
    /// How grey values become cell values.
    pub mode: RosMapMode,
}

/// The keys as users write them; keys that are not listed are ignored, as Nav2 does.
#[derive(Deserialize)]
struct Keys {
    image: Option<String>,
    resolution: Option<f64>,
    origin: Option<Vec<f64>>,
    negate: Option<Negate>,
    occupied_thresh: Option<f64>,
    free_thresh: Option<f64>,
    mode: Option<RosMapMode>,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "negate must be 0, 1, true or false")]
enum Negate {
    Flag(bool),
    Number(i64),
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

    fn check(&self) -> Result<(), FormatError> {
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

    /// Where the image lies, for a description in a file at `yaml_path`.
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

    /// The map that this description makes of an image. The image's last row is row 0.
    ///
    /// # Errors
    /// An impossible resolution or origin, or the mode `raw` on an image that has not 8 bits.
    pub fn to_grid(&self, image: &GreyImage) -> Result<OccupancyGrid, FormatError> {
        self.check()?;
        if self.mode == RosMapMode::Raw && image.max_value != 255 {
            let expected = "255 in mode raw; hint: save the image with 8 bits";
            return Err(FormatProblem::bad_value(
                "the image's maximal grey value",
                image.max_value,
                expected,
            )
            .into());
        }
        let frame = GridFrame::new(image.n_cols, image.n_rows, self.resolution_m, self.origin)?;
        let table: Vec<i8> = (0..=image.max_value)
            .map(|grey| self.cell_value(grey, image.max_value))
            .collect();
        let mut values = Vec::with_capacity(frame.n_cells());
        for row in image.values.chunks_exact(image.n_cols).rev() {
            values.extend(row.iter().map(|&grey| table[usize::from(grey)]));
        }
        if let (Some(transparent), false) = (&image.transparent, self.mode == RosMapMode::Raw) {
            let upwards = transparent.chunks_exact(image.n_cols).rev().flatten();
            for (value, _) in values.iter_mut().zip(upwards).filter(|(_, t)| **t) {
                *value = UNKNOWN;
            }
        }
        Ok(OccupancyGrid::new(frame, values)?)
    }

    fn cell_value(&self, grey: u16, max_value: u16) -> i8 {
        if self.mode == RosMapMode::Raw {
            return i8::try_from(grey)
                .ok()
                .filter(|&v| v <= OCCUPIED)
                .unwrap_or(UNKNOWN);
        }
        let dark = if self.negate { grey } else { max_value - grey };
        let p = f64::from(dark) / f64::from(max_value);
        let (free, occupied) = (self.free_threshold, self.occupied_threshold);
        if p >= occupied {
            OCCUPIED
        } else if p <= free {
            FREE
        } else if self.mode == RosMapMode::Scale {
            (f64::from(OCCUPIED) * (p - free) / (occupied - free)).round() as i8
        } else {
            UNKNOWN
        }
    }
}

impl OccupancyGrid {
    /// Reads a ROS map from its YAML description, and the image that it names.
    ///
    /// # Errors
    /// Either file cannot be read or is wrong; the error names it.
    pub fn read_ros_yaml(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        let path = path.as_ref();
        let bytes = read_bytes(path, MAX_TEXT_BYTES)?;
        let description = text(&bytes, "the YAML description of a ROS map")
            .and_then(RosMapDescription::from_yaml)
            .map_err(|e| e.in_file(path))?;
        let image_path = description.image_path(path).map_err(|e| e.in_file(path))?;
        GreyImage::from_bytes(&read_bytes(&image_path, MAX_MAP_BYTES)?)
            .and_then(|image| description.to_grid(&image))
            .map_err(|e| e.in_file(&image_path))
    }
}

/// The error with the line that it is about, if it knows one.
fn yaml_error(error: &serde_saphyr::Error, yaml: &str) -> FormatError {
    let message = error.without_snippet().to_string();
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
        [x, y, yaw] => Ok(Pose2::new(x, y, yaw)),
        _ => Err(FormatProblem::bad_value(
            "origin",
            format!("a list of {} numbers", numbers.len()),
            "[x, y, yaw] in metres and radians",
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

    fn column(values: &[u16]) -> GreyImage {
        GreyImage {
            n_cols: 1,
            n_rows: values.len(),
            max_value: 255,
            values: values.to_vec(),
            transparent: None,
        }
    }

    #[test]
    fn reads_what_users_write() {
        let description = RosMapDescription::from_yaml(YAML).unwrap();
        assert_eq!(description.origin, Pose2::new(1.0, -2.5, 0.3));
        assert_eq!(description.mode, RosMapMode::Trinary);
        assert!(!description.negate);
        for (text, negate) in [("1", true), ("true", true), ("false", false)] {
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
        println!(
            "{broken}\n{mode}\n{}",
            message("negate: 0", "negate: maybe")
        );
        assert!(message("negate: 0", "negate: maybe").contains("0, 1, true or false"));
        assert!(RosMapDescription::from_yaml("- a\n- b").is_err());
        assert!(RosMapDescription::from_yaml("image: [").is_err());
    }

    #[test]
    fn trinary_includes_both_thresholds_and_counts_rows_from_below() {
        let mut description = RosMapDescription::of_bare_image(1.0);
        let image = column(&[0, 254, 205, 206]);
        assert_eq!(
            description.to_grid(&image).unwrap().values(),
            [0, -1, 0, 100]
        );
        (description.occupied_threshold, description.free_threshold) = (0.6, 0.2);
        let image = column(&[102, 103, 203, 204]);
        assert_eq!(
            description.to_grid(&image).unwrap().values(),
            [0, -1, -1, 100]
        );
        description.negate = true;
        let image = column(&[255, 153, 152, 51]);
        assert_eq!(
            description.to_grid(&image).unwrap().values(),
            [0, -1, 100, 100]
        );
    }

    #[test]
    fn scale_grades_between_the_thresholds() {
        let mut description = RosMapDescription::of_bare_image(1.0);
        description.mode = RosMapMode::Scale;
        (description.occupied_threshold, description.free_threshold) = (0.8, 0.2);
        let mut image = column(&[51, 102, 127, 204]);
        assert_eq!(
            description.to_grid(&image).unwrap().values(),
            [0, 50, 67, 100]
        );
        image.transparent = Some(vec![true, false, false, true]);
        assert_eq!(
            description.to_grid(&image).unwrap().values(),
            [-1, 50, 67, -1]
        );
    }

    #[test]
    fn raw_keeps_values() {
        let mut description = RosMapDescription::of_bare_image(1.0);
        description.mode = RosMapMode::Raw;
        let mut image = column(&[0, 42, 100, 101, 255]);
        let grid = description.to_grid(&image).unwrap();
        assert_eq!(grid.values(), [-1, -1, 100, 42, 0]);
        image.max_value = 1000;
        let error = description.to_grid(&image).unwrap_err().to_string();
        assert!(
            error.contains("1000") && error.contains("mode raw"),
            "{error}"
        );
    }

    #[test]
    fn other_maximal_values_scale() {
        let mut image = column(&[0, 3, 7]);
        image.max_value = 7;
        let grid = RosMapDescription::of_bare_image(1.0)
            .to_grid(&image)
            .unwrap();
        assert_eq!(grid.values(), [0, -1, 100]);
    }
}
