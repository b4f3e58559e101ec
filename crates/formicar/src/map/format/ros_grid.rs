//! The grid that a ROS map's description makes of its image.

use super::files::{MAX_MAP_BYTES, MAX_TEXT_BYTES, read_bytes, text};
use super::{FormatError, FormatProblem, GreyImage, MapFile, RosMapDescription, RosMapMode};
use crate::map::{FREE, GridFrame, OCCUPIED, OccupancyGrid, UNKNOWN};
use std::path::Path;

impl RosMapDescription {
    /// The map that this description makes of an image. The image's last row is row 0.
    ///
    /// # Errors
    /// An impossible resolution or origin, or the mode `raw` on an image that has not 8 bits.
    pub fn to_grid(&self, image: &GreyImage) -> Result<OccupancyGrid, FormatError> {
        Ok(self.to_map_file(image, None)?.grid)
    }

    /// The same with warnings, and with a grey value (of 0 to 255) that stands for unknown cells
    /// whatever the thresholds say.
    ///
    /// # Errors
    /// As [`Self::to_grid`].
    pub fn to_map_file(
        &self,
        image: &GreyImage,
        unknown_grey: Option<u8>,
    ) -> Result<MapFile, FormatError> {
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
        // A value for whatever 16 bits hold: no look is out of range.
        let table = vec![UNKNOWN; 1 << u16::BITS];
        let mut table: Box<[i8; 1 << u16::BITS]> = table.try_into().expect("as many");
        for grey in 0..=image.max_value {
            table[usize::from(grey)] = self.cell_value(grey, image.max_value);
        }
        if let Some(grey) = unknown_grey {
            table[usize::from(image.scaled(grey))] = UNKNOWN;
        }
        let mut values = vec![UNKNOWN; frame.n_cells()];
        let upwards = image.values.chunks_exact(image.n_cols).rev();
        for (values, greys) in values.chunks_exact_mut(image.n_cols).zip(upwards) {
            for (value, &grey) in values.iter_mut().zip(greys) {
                *value = table[usize::from(grey)];
            }
        }
        if let (Some(transparent), false) = (&image.transparent, self.mode == RosMapMode::Raw) {
            let upwards = transparent.chunks_exact(image.n_cols).rev().flatten();
            for (value, _) in values.iter_mut().zip(upwards).filter(|(_, t)| **t) {
                *value = UNKNOWN;
            }
        }
        Ok(MapFile {
            grid: OccupancyGrid::new(frame, values)?,
            warnings: self.warnings(image, unknown_grey),
        })
    }

    pub(super) fn cell_value(&self, grey: u16, max_value: u16) -> i8 {
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
        Ok(read_ros_map(path.as_ref(), None)?.grid)
    }
}

/// Reads a ROS map from its YAML description, and the image that it names.
pub(super) fn read_ros_map(path: &Path, unknown_grey: Option<u8>) -> Result<MapFile, FormatError> {
    let bytes = read_bytes(path, MAX_TEXT_BYTES)?;
    let description = text(&bytes, "the YAML description of a ROS map")
        .and_then(RosMapDescription::from_yaml)
        .map_err(|e| e.in_file(path))?;
    let image_path = description.image_path(path).map_err(|e| e.in_file(path))?;
    let bytes = read_bytes(&image_path, MAX_MAP_BYTES).map_err(|e| match e.problem() {
        FormatProblem::Read(error) if !image_path.is_file() => {
            missing_image(&description.image, path, error.to_string()).in_file(path)
        }
        _ => e,
    })?;
    GreyImage::from_bytes(&bytes)
        .and_then(|image| description.to_map_file(&image, unknown_grey))
        .map_err(|e| e.in_file(&image_path))
}

/// The error for an image that cannot be read, with the image that lies beside its description.
fn missing_image(image: &str, yaml: &Path, problem: String) -> FormatError {
    let folder = match yaml.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let is_image = |name: &String| {
        let extension = Path::new(name).extension().unwrap_or_default();
        let extension = extension.to_ascii_lowercase();
        ["pgm", "png", "bmp"]
            .iter()
            .any(|known| extension == *known)
    };
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut beside: Vec<String> = names.filter(is_image).collect();
    beside.sort();
    // The last part of a path of any system, or of an address.
    let last = image.rsplit(['/', '\\']).next().unwrap_or(image);
    let named = beside.iter().find(|name| name.eq_ignore_ascii_case(last));
    let same_stem = |name: &&String| Path::new(name).file_stem() == yaml.file_stem();
    let best = named.or_else(|| beside.iter().find(same_stem));
    let best = best.or_else(|| beside.first().filter(|_| beside.len() == 1));
    let hint = match best {
        Some(name) if image.contains("://") => {
            format!("{name:?} lies beside this file; write a path, not an address")
        }
        Some(name) => format!("{name:?} lies beside this file; names are relative to it"),
        None => "no such image lies beside this file; names are relative to it".to_owned(),
    };
    FormatProblem::Image {
        image: image.to_owned(),
        problem,
        hint,
    }
    .into()
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn a_missing_image_is_told_with_its_description_and_the_image_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("m.pgm"), "P5 1 1 255 a").unwrap();
        let yaml = folder.path().join("depot.yaml");
        let told = |image: &str| {
            let text = format!(
                "image: {image}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n\
                 occupied_thresh: 0.65\nfree_thresh: 0.196\n"
            );
            std::fs::write(&yaml, text).unwrap();
            let read = OccupancyGrid::read_ros_yaml(&yaml);
            read.map_or_else(|error| error.to_string(), |_| String::new())
        };
        for image in ["M.PGM", "C:\\maps\\m.pgm", "maps/m.pgm", "other.png"] {
            let told = told(image);
            assert!(
                told.contains("depot.yaml") && told.contains(image),
                "{told}"
            );
            assert!(told.contains("\"m.pgm\" lies beside"), "{told}");
        }
        let address = told("file:///maps/m.pgm");
        assert!(address.contains("not an address"), "{address}");
        assert_eq!(told("./m.pgm"), "");
        std::fs::write(folder.path().join("n.pgm"), "").unwrap();
        let none = told("other.png");
        assert!(none.contains("no such image lies beside"), "{none}");
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
