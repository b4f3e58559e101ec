//! A map with what its file leaves open to doubt.

use super::{GreyImage, RosMapDescription, RosMapMode};
use crate::map::OccupancyGrid;
use std::fmt;

/// The grey that the map savers of ROS write for unknown cells.
pub const SAVER_UNKNOWN_GREY: u8 = 205;

/// A map, and warnings about the file that it was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct MapFile {
    /// The map.
    pub grid: OccupancyGrid,
    /// What of the file a reader may have meant otherwise.
    pub warnings: Vec<MapWarning>,
}

/// A doubt about a map file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum MapWarning {
    /// Cells that are free by the thresholds have the grey of unknown cells.
    UnknownGreyIsFree {
        /// The number of such cells.
        n_cells: usize,
        /// The file's `free_thresh`.
        free_threshold: f64,
    },
}

impl fmt::Display for MapWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownGreyIsFree {
                n_cells,
                free_threshold,
            } => write!(
                f,
                "{n_cells} cells are free by free_thresh {free_threshold} but have the grey {SAVER_UNKNOWN_GREY}, which map savers write for unknown cells; hint: take that grey as unknown (--unknown-grey {SAVER_UNKNOWN_GREY}), or set free_thresh to 0.196"
            ),
        }
    }
}

impl RosMapDescription {
    /// The warnings about an image that is read by this description.
    pub(super) fn warnings(&self, image: &GreyImage, unknown_grey: Option<u8>) -> Vec<MapWarning> {
        let is_free =
            self.cell_value(image.scaled(SAVER_UNKNOWN_GREY), image.max_value) == crate::map::FREE;
        let is_settled = self.mode == RosMapMode::Raw || unknown_grey == Some(SAVER_UNKNOWN_GREY);
        if is_settled || !is_free {
            return Vec::new();
        }
        let grey = image.scaled(SAVER_UNKNOWN_GREY);
        let transparent = image.transparent.as_deref();
        let is_opaque = |i: usize| transparent.is_none_or(|transparent| !transparent[i]);
        let doubtful = image.values.iter().enumerate();
        let doubtful = doubtful.filter(|&(i, &value)| value == grey && is_opaque(i));
        match doubtful.count() {
            0 => Vec::new(),
            n_cells => vec![MapWarning::UnknownGreyIsFree {
                n_cells,
                free_threshold: self.free_threshold,
            }],
        }
    }
}

impl GreyImage {
    /// A grey of 8 bits as this image writes it.
    pub(super) fn scaled(&self, grey: u8) -> u16 {
        ((u32::from(grey) * u32::from(self.max_value) + 127) / 255) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{FREE, UNKNOWN};

    fn image(max_value: u16, values: &[u16]) -> GreyImage {
        GreyImage {
            n_cols: values.len(),
            n_rows: 1,
            max_value,
            values: values.to_vec(),
            transparent: None,
        }
    }

    fn with_free_threshold(free_threshold: f64) -> RosMapDescription {
        RosMapDescription {
            free_threshold,
            ..RosMapDescription::of_bare_image(0.05)
        }
    }

    #[test]
    fn unknown_ground_that_a_threshold_frees_is_told() {
        for (max_value, values) in [(255, [254, 205, 205]), (65535, [65535, 52685, 52685])] {
            let image = image(max_value, &values);
            let read = |threshold, grey| {
                with_free_threshold(threshold)
                    .to_map_file(&image, grey)
                    .unwrap()
            };
            let map = read(0.25, None);
            assert_eq!(map.grid.values(), [FREE; 3]);
            let told = map.warnings[0].to_string();
            assert!(
                told.starts_with("2 cells are free by free_thresh 0.25"),
                "{told}"
            );
            assert_eq!(read(0.196, None).warnings, []);
            let map = read(0.25, Some(205));
            assert_eq!(map.grid.values(), [FREE, UNKNOWN, UNKNOWN]);
            assert_eq!(map.warnings, []);
        }
    }

    #[test]
    fn greys_that_are_not_free_or_transparent_are_no_doubt() {
        let mut description = with_free_threshold(0.25);
        let mut grey = image(255, &[205, 254]);
        description.negate = true;
        assert_eq!(description.to_map_file(&grey, None).unwrap().warnings, []);
        description.negate = false;
        grey.transparent = Some(vec![true, false]);
        assert_eq!(description.to_map_file(&grey, None).unwrap().warnings, []);
        assert_eq!(
            description
                .to_map_file(&image(255, &[254]), None)
                .unwrap()
                .warnings,
            []
        );
    }
}
