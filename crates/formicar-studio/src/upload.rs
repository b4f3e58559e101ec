//! Maps from uploaded files.

use axum::body::Bytes;
use formicar::map::format::{GreyImage, MapFile, ReadOptions, RosMapDescription};
use std::path::Path;

/// An uploaded file.
pub(crate) struct Upload {
    pub(crate) name: String,
    pub(crate) bytes: Bytes,
}

impl Upload {
    fn has_extension(&self, extensions: &[&str]) -> bool {
        let extension = Path::new(&self.name).extension();
        let extension = extension.unwrap_or_default().to_ascii_lowercase();
        extensions.iter().any(|&known| extension == known)
    }
}

/// The name and the map in some files: a ROS YAML with its image, or a single file.
///
/// # Errors
/// No file or several that could be the map, a malformed file, or too many cells.
pub(crate) fn map(
    files: &[Upload],
    resolution_m: Option<f64>,
    max_cells: usize,
) -> Result<(String, MapFile), String> {
    let yaml = files
        .iter()
        .find(|file| file.has_extension(&["yaml", "yml"]));
    let (file, map) = match (yaml, files) {
        (Some(yaml), _) => (yaml, ros(yaml, files, max_cells)?),
        (None, [file]) => (file, alone(file, resolution_m, max_cells)?),
        (None, []) => return Err("no file was uploaded; hint: drop a map on the page".to_owned()),
        (None, _) => {
            let n = files.len();
            return Err(format!(
                "{n} files without a .yaml; hint: a ROS map's .yaml and image together, or one file"
            ));
        }
    };
    Ok((file.name.clone(), map))
}

fn ros(yaml: &Upload, files: &[Upload], max_cells: usize) -> Result<MapFile, String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", yaml.name);
    let text = std::str::from_utf8(&yaml.bytes).map_err(|error| failed(&error))?;
    let description = RosMapDescription::from_yaml(text).map_err(|error| failed(&error))?;
    let named = Path::new(&description.image)
        .file_name()
        .unwrap_or_default();
    let image = files.iter().find(|file| named == file.name.as_str());
    let image = image.ok_or_else(|| {
        let named = named.to_string_lossy();
        failed(&format!(
            "its image {named} was not uploaded; hint: drop both files together"
        ))
    })?;
    check_png(image, max_cells)?;
    let pixels = GreyImage::from_bytes(&image.bytes).map_err(|e| format!("{}: {e}", image.name))?;
    let map = description.to_map_file(&pixels, None);
    map.map_err(|error| failed(&error))
}

fn alone(file: &Upload, resolution_m: Option<f64>, max_cells: usize) -> Result<MapFile, String> {
    check_png(file, max_cells)?;
    let options = ReadOptions {
        resolution_m,
        ..ReadOptions::default()
    };
    MapFile::from_bytes(Path::new(&file.name), &file.bytes, &options).map_err(|e| e.to_string())
}

/// Refuses an image with too many pixels before it is decompressed.
fn check_png(file: &Upload, max_cells: usize) -> Result<(), String> {
    let number = |at: usize| {
        let bytes = file.bytes.get(at..at + 4)?;
        Some(u32::from_be_bytes(bytes.try_into().ok()?) as usize)
    };
    // The first chunk of a PNG begins with width and height.
    let size = file
        .bytes
        .starts_with(b"\x89PNG")
        .then(|| number(16).zip(number(20)));
    match size.flatten() {
        Some((n_cols, n_rows)) if n_cols.saturating_mul(n_rows) > max_cells => Err(format!(
            "{}: {n_cols} x {n_rows} pixels, at most {max_cells} cells here",
            file.name
        )),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::map::OccupancyGrid;
    use formicar::map::format::ros_png;

    const YAML: &str = "image: maps/yard.png\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

    fn file(name: &str, bytes: impl Into<Bytes>) -> Upload {
        Upload {
            name: name.to_owned(),
            bytes: bytes.into(),
        }
    }

    fn yard() -> Vec<u8> {
        ros_png(&OccupancyGrid::from_rows(&["..#", "..."], 0.5).unwrap()).unwrap()
    }

    #[test]
    fn a_ros_map_comes_as_two_files() {
        let both = [file("yard.png", yard()), file("yard.yaml", YAML)];
        let (name, read) = map(&both, None, 100).unwrap();
        let grid = read.grid;
        assert_eq!(
            (name.as_str(), grid.frame().resolution_m()),
            ("yard.yaml", 0.5)
        );
        assert_eq!(grid.values(), [0, 0, 0, 0, 0, 100]);
        let error = map(&both[1..], None, 100).unwrap_err();
        assert!(error.contains("yard.png"), "{error}");
    }

    #[test]
    fn doubts_about_a_file_are_told() {
        let yaml = YAML
            .replace("0.196", "0.25")
            .replace("yard.png", "yard.pgm");
        let both = [
            file("yard.pgm", "P5 2 1 255 \u{5d}a"),
            file("yard.yaml", yaml.clone()),
        ];
        assert_eq!(map(&both, None, 100).unwrap().1.warnings, []);
        let unknown = [b"P5 2 1 255 ".as_slice(), &[205, 254]].concat();
        let both = [file("yard.pgm", unknown), file("yard.yaml", yaml)];
        assert_eq!(map(&both, None, 100).unwrap().1.warnings.len(), 1);
    }

    #[test]
    fn images_need_a_resolution_and_must_not_be_too_large() {
        let image = [file("yard.png", yard())];
        assert!(map(&image, None, 100).unwrap_err().contains("resolution"));
        assert_eq!(
            map(&image, Some(0.1), 100).unwrap().1.grid.frame().n_cols(),
            3
        );
        assert!(map(&image, Some(0.1), 5).unwrap_err().contains("3 x 2"));
    }

    #[test]
    fn files_that_are_no_map_are_refused() {
        assert!(map(&[], None, 100).is_err());
        assert!(map(&[file("notes.txt", "hello")], None, 100).is_err());
        assert!(map(&[file("a.yaml", vec![0xff, 0xfe])], None, 100).is_err());
        assert!(map(&[file("a.map", "x"), file("b.map", "y")], None, 100).is_err());
    }
}
