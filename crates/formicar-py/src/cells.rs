//! `NumPy` arrays as the cells of a map.

use crate::errors;
use formicar::map::format::{GreyImage, RosMapDescription};
use formicar::map::{Cell, FREE, GridFrame, OCCUPIED, OccupancyGrid};
use numpy::ndarray::ArrayView2;
use numpy::{
    Element, PyArrayDescrMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// How the values of an array are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// As in `nav_msgs/OccupancyGrid`; booleans are occupied where true.
    Occupancy,
    /// Costs of Nav2's costmaps, 0 to 255.
    Costs,
    /// Shades of gray, black occupied.
    Grey,
}

/// The cells of an array in the order of the library.
pub(crate) fn cells_of(
    data: &Bound<'_, PyUntypedArray>,
    meaning: Meaning,
    image_order: bool,
    frame: &GridFrame,
) -> PyResult<Vec<i8>> {
    let kind = data.dtype();
    let (letter, n_bytes) = (kind.kind(), kind.itemsize());
    let take = Take { data, image_order };
    match (meaning, letter, n_bytes) {
        (Meaning::Occupancy, b'b', _) => {
            Ok(take.cells(|is_occupied: bool| if is_occupied { OCCUPIED } else { FREE })?)
        }
        (Meaning::Occupancy, b'i' | b'u', _) => occupancy(&take, letter, n_bytes, frame),
        (Meaning::Costs, b'u', 1) => {
            let costs = take.cells(|cost: u8| cost)?;
            let grid = OccupancyGrid::from_costmap_values(*frame, &costs);
            Ok(grid.map_err(errors::map)?.values().to_vec())
        }
        (Meaning::Grey, b'u', 1) => grey(&take.cells(|v: u8| u16::from(v))?, 255, frame),
        (Meaning::Grey, b'u', 2) => grey(&take.cells(|v: u16| v)?, u16::MAX, frame),
        _ => Err(wrong_type(&kind.to_string(), meaning)),
    }
}

fn wrong_type(kind: &str, meaning: Meaning) -> PyErr {
    let expected = match meaning {
        Meaning::Occupancy => {
            "bool (True is occupied) or integers as in nav_msgs (-1 unknown, 0 free, to 100 occupied); hint: for probabilities, (100 * p).round().astype(\"int8\"); for an image, values=\"grey\""
        }
        Meaning::Costs => "uint8, 0 free to 254 lethal, 255 unknown",
        Meaning::Grey => "uint8 or uint16, black occupied, white free",
    };
    PyTypeError::new_err(format!(
        "the map's array is of dtype {kind}; expected {expected}"
    ))
}

/// An array to take values out of.
struct Take<'a, 'py> {
    data: &'a Bound<'py, PyUntypedArray>,
    image_order: bool,
}

impl Take<'_, '_> {
    /// The values row by row, the lowest first.
    fn cells<T: Element + Copy, U>(&self, convert: impl Fn(T) -> U) -> PyResult<Vec<U>> {
        let array: PyReadonlyArray2<'_, T> = self.data.extract()?;
        let array: ArrayView2<'_, T> = array.as_array();
        let n_rows = array.nrows();
        let row = |row: usize| {
            if self.image_order {
                n_rows - 1 - row
            } else {
                row
            }
        };
        let mut cells = Vec::with_capacity(array.len());
        for i in 0..n_rows {
            cells.extend(array.row(row(i)).iter().map(|&value| convert(value)));
        }
        Ok(cells)
    }
}

/// Values as in `nav_msgs`.
fn occupancy(
    take: &Take<'_, '_>,
    letter: u8,
    n_bytes: usize,
    frame: &GridFrame,
) -> PyResult<Vec<i8>> {
    // The lowest byte is no occupancy either: it marks values that do not fit.
    let stray = std::cell::Cell::new(None);
    let narrow = |value: i64| match i8::try_from(value) {
        Ok(byte) if byte != i8::MIN => byte,
        _ => {
            stray.set(stray.get().or(Some(value)));
            i8::MIN
        }
    };
    let cells = match (letter, n_bytes) {
        (b'i', 1) => take.cells(|v: i8| narrow(v.into()))?,
        (b'i', 2) => take.cells(|v: i16| narrow(v.into()))?,
        (b'i', 4) => take.cells(|v: i32| narrow(v.into()))?,
        (b'i', _) => take.cells(|v: i64| narrow(v))?,
        (_, 1) => take.cells(|v: u8| narrow(v.into()))?,
        (_, 2) => take.cells(|v: u16| narrow(v.into()))?,
        (_, 4) => take.cells(|v: u32| narrow(v.into()))?,
        _ => take.cells(|v: u64| narrow(i64::try_from(v).unwrap_or(i64::MAX)))?,
    };
    let first = cells.iter().position(|&cell| cell == i8::MIN);
    if let (Some(i), Some(value)) = (first, stray.get()) {
        let Cell { col, row } = frame.cell(i);
        return Err(errors::map(format!(
            "cell ({col}, {row}) has value {value}; allowed are -1 (unknown) and 0 (free) to 100 (occupied)"
        )));
    }
    if cells.contains(&1) && cells.iter().all(|value| (0..=1).contains(value)) {
        return Err(errors::map(
            "the map's integers are 0 and 1 alone, and 1 of 100 is as good as free; hint: .astype(bool) where 1 is an obstacle, 100 * data where it is meant as a percentage",
        ));
    }
    Ok(cells)
}

/// Shades as an image whose thresholds are those of ROS map savers.
fn grey(values: &[u16], max_value: u16, frame: &GridFrame) -> PyResult<Vec<i8>> {
    let yaml = format!(
        "image: array\nresolution: {}\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        frame.resolution_m()
    );
    let description = RosMapDescription::from_yaml(&yaml).map_err(errors::map)?;
    let n_cols = frame.n_cols();
    // An image has its rows from the top.
    let rows = values.chunks(n_cols).rev();
    let image = GreyImage {
        n_cols,
        n_rows: frame.n_rows(),
        max_value,
        values: rows.flatten().copied().collect(),
        transparent: None,
    };
    let grid = description.to_grid(&image).map_err(errors::map)?;
    Ok(grid.values().to_vec())
}
