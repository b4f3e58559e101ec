//! An occupancy grid to any map file.

use super::files::Staged;
use super::ros::{DEFAULT_FREE_THRESHOLD, DEFAULT_OCCUPIED_THRESHOLD};
use super::{
    FormatError, FormatProblem, RosMapDescription, RosMapMode, pgm, png_file, to_csv_matrix,
    to_movingai_map, to_text_matrix, write_atomically,
};
use crate::geometry::MAX_STATED_HEADING_RAD;
use crate::map::{FREE, OCCUPIED, OccupancyGrid, UNKNOWN};
use std::path::Path;

/// Writes a map in the format that the file's extension names.
///
/// - `.yaml`, `.yml`: a ROS map, with its image beside it as `.pgm`.
/// - `.pgm`, `.png`: a ROS map, with its description beside it as `.yaml`.
/// - `.map`: `MovingAI`; `.txt`: a 0/1 matrix with blanks; `.csv`: one with commas. These three
///   keep neither resolution nor origin, and refuse unknown and graded cells.
///
/// ROS maps lose nothing: a map of free, occupied and unknown cells is written in the mode
/// trinary with the map saver's grey values (254, 0, 205) and thresholds (0.65, 0.196); a map
/// with graded cells in the mode raw, whose grey values are the cell values, 255 for unknown.
///
/// # Errors
/// An unknown extension, a map that the format cannot hold, or files that cannot be written; no
/// part of a file is left behind.
pub fn write_map(path: &Path, grid: &OccupancyGrid) -> Result<(), FormatError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let text = match extension.to_str() {
        Some("yaml" | "yml") => return write_ros(path, &path.with_extension("pgm"), grid),
        Some("pgm" | "png") => return write_ros(&path.with_extension("yaml"), path, grid),
        Some("map") => to_movingai_map(grid),
        Some("txt") => to_text_matrix(grid),
        Some("csv") => to_csv_matrix(grid),
        _ => Err(FormatProblem::UnknownExtension {
            extension: extension.to_string_lossy().into_owned(),
            known: "yaml, yml, pgm, png, map, txt, csv",
        }
        .into()),
    };
    text.map_err(|e| e.in_file(path))
        .and_then(|text| write_atomically(path, text.as_bytes()))
}

fn write_ros(yaml: &Path, image: &Path, grid: &OccupancyGrid) -> Result<(), FormatError> {
    let name = image.file_name().and_then(|name| name.to_str());
    let name = name.ok_or(FormatProblem::Missing {
        thing: "a name in UTF-8 for the image",
        hint: "its description must hold it",
    });
    let description =
        RosMapDescription::of_grid(name.map_err(|e| FormatError::from(e).in_file(image))?, grid);
    let bytes = if image
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("png"))
    {
        ros_png(grid)?
    } else {
        ros_pgm(grid)
    };
    // Both are complete before either takes its name.
    let image = Staged::write(image, &bytes)?;
    let yaml = Staged::write(yaml, description.to_yaml().as_bytes())?;
    image.publish()?;
    yaml.publish()
}

/// The image of a ROS map as PGM; [`RosMapDescription::of_grid`] describes it.
pub fn ros_pgm(grid: &OccupancyGrid) -> Vec<u8> {
    pgm::write(
        grid.frame().n_cols(),
        grid.frame().n_rows(),
        &grey_from_top(grid),
    )
}

/// The image of a ROS map as PNG; [`RosMapDescription::of_grid`] describes it.
///
/// # Errors
/// None that is known; the encoder's own are handed on.
pub fn ros_png(grid: &OccupancyGrid) -> Result<Vec<u8>, FormatError> {
    png_file::write(
        grid.frame().n_cols(),
        grid.frame().n_rows(),
        &grey_from_top(grid),
    )
}

impl RosMapDescription {
    /// The description of a map whose image is written by [`ros_pgm`] or [`ros_png`].
    pub fn of_grid(image: &str, grid: &OccupancyGrid) -> Self {
        Self {
            image: image.to_owned(),
            resolution_m: grid.frame().resolution_m(),
            // Readers take a yaw beyond a turn for one in degrees.
            origin: match grid.frame().origin() {
                origin if origin.heading.abs() > MAX_STATED_HEADING_RAD => origin.wrapped(),
                origin => origin,
            },
            negate: false,
            occupied_threshold: DEFAULT_OCCUPIED_THRESHOLD,
            free_threshold: DEFAULT_FREE_THRESHOLD,
            mode: mode_for(grid),
        }
    }

    /// The YAML that [`Self::from_yaml`] reads back without a difference.
    pub fn to_yaml(&self) -> String {
        let Self { origin, mode, .. } = self;
        format!(
            "image: {}\nmode: {mode}\nresolution: {:?}\norigin: [{:?}, {:?}, {:?}]\nnegate: {}\n\
             occupied_thresh: {:?}\nfree_thresh: {:?}\n",
            yaml_word(&self.image),
            self.resolution_m,
            origin.x,
            origin.y,
            origin.heading,
            u8::from(self.negate),
            self.occupied_threshold,
            self.free_threshold,
        )
    }
}

/// A file name as it is where YAML allows that, quoted otherwise.
fn yaml_word(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '/' | '-');
    let begins_plain = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '/');
    if begins_plain && name.contains('.') && name.chars().all(plain) {
        return name.to_owned();
    }
    // YAML reads the strings of JSON.
    serde_json::Value::from(name).to_string()
}

fn mode_for(grid: &OccupancyGrid) -> RosMapMode {
    if grid
        .values()
        .iter()
        .all(|v| matches!(*v, FREE | OCCUPIED | UNKNOWN))
    {
        RosMapMode::Trinary
    } else {
        RosMapMode::Raw
    }
}

fn grey_from_top(grid: &OccupancyGrid) -> Vec<u8> {
    let raw = mode_for(grid) == RosMapMode::Raw;
    let grey = |&value: &i8| match value {
        UNKNOWN if raw => 255,
        value if raw => value.unsigned_abs(),
        UNKNOWN => 205,
        OCCUPIED => 0,
        _ => 254,
    };
    let rows = grid.values().chunks_exact(grid.frame().n_cols()).rev();
    rows.flatten().map(grey).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::format::{GreyImage, ReadOptions, read_map};

    #[test]
    fn saves_as_the_map_saver_does() {
        let grid = OccupancyGrid::from_rows(&["#.", "?."], 0.05).unwrap();
        assert_eq!(ros_pgm(&grid), b"P5\n2 2\n255\n\x00\xfe\xcd\xfe");
        let yaml = RosMapDescription::of_grid("m.pgm", &grid).to_yaml();
        assert_eq!(
            yaml,
            "image: m.pgm\nmode: trinary\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\n\
             negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
        );
        let read = GreyImage::from_bytes(&ros_pgm(&grid)).unwrap();
        let description = RosMapDescription::from_yaml(&yaml).unwrap();
        assert_eq!(description.to_grid(&read).unwrap(), grid);
    }

    #[test]
    fn every_extension_reads_back() {
        let folder = tempfile::tempdir().unwrap();
        let grid = OccupancyGrid::from_rows(&["#..", "..#"], 1.0).unwrap();
        for name in [
            "a.yaml",
            "b.yml",
            "c: #1.pgm",
            "d.PNG",
            "e.map",
            "f.txt",
            "g.csv",
            "-h.png",
        ] {
            let path = folder.path().join(name);
            write_map(&path, &grid).unwrap();
            let resolution_m = Some(1.0);
            assert_eq!(
                read_map(
                    &path,
                    &ReadOptions {
                        resolution_m,
                        ..ReadOptions::default()
                    }
                )
                .unwrap(),
                grid,
                "{name}"
            );
            let yaml = path.with_extension("yaml");
            if name.ends_with('m') || name.ends_with('g') {
                assert_eq!(OccupancyGrid::read_ros_yaml(yaml).unwrap(), grid, "{name}");
            }
        }
        let mut graded = grid;
        graded.set(crate::map::Cell::new(1, 0), 37);
        for name in ["raw.yaml", "raw.png"] {
            write_map(&folder.path().join(name), &graded).unwrap();
            let read = OccupancyGrid::read_ros_yaml(folder.path().join("raw.yaml")).unwrap();
            assert_eq!(read, graded);
        }
        for name in ["h.map", "h.txt", "h.csv", "h.bmp", "h"] {
            let path = folder.path().join(name);
            let error = write_map(&path, &graded).unwrap_err().to_string();
            assert!(error.contains(name) && !path.exists(), "{error}");
        }
    }
}
