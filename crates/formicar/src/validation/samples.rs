//! Foreign paths as tables: CSV of `x, y[, heading]`, meters and radians.

use super::foreign::{deviation_m, path_through_points, path_through_poses};
use crate::geometry::{Point2, Pose2};
use crate::path::{CurvePath, Direction};
use thiserror::Error;

/// The sampled positions of a path, with or without headings.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// Positions in order.
    pub points: Vec<Point2>,
    /// As many headings, where the file has them.
    pub headings: Option<Vec<f64>>,
    /// Half a unit of the last decimal of the positions, where they are written to the millimeter
    /// or finer; 0 for coarser ones, which are taken at their word.
    pub rounding_m: f64,
}

/// The reason why a table is no path.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum SamplesError {
    /// No rows.
    #[error("the table has no rows of numbers; expected lines of x,y or x,y,heading")]
    Empty,
    /// A header without the columns that are needed.
    #[error("line 1: the header {header:?} names no column {missing}; hint: call it {missing}")]
    NoColumn {
        /// The header.
        header: String,
        /// The column that is missing.
        missing: &'static str,
    },
    /// A row with too few fields.
    #[error("line {line}: {n_fields} fields, the path needs {n_needed}")]
    ShortRow {
        /// Counted from 1.
        line: usize,
        /// Fields found.
        n_fields: usize,
        /// Fields needed.
        n_needed: usize,
    },
    /// A field that is no number, or one beyond all maps.
    #[error("line {line}: {field:?} is not a number between -1e9 and 1e9")]
    BadNumber {
        /// Counted from 1.
        line: usize,
        /// The field.
        field: String,
    },
}

/// Decimals from which a position counts as rounded: a curve may pass it within that rounding.
/// At coarser ones the curve could pass it so far off that a collision stays unseen.
const N_DECIMALS_OF_ROUNDED: i32 = 3;

/// The columns of the coordinates.
struct Columns {
    x: usize,
    y: usize,
    heading: Option<usize>,
}

impl Samples {
    /// Reads a table. Fields are divided by commas, semicolons, tabs or blanks; `#` begins a
    /// comment. A header, if there is one, names the columns `x`, `y` and (maybe) `heading`,
    /// `yaw` or `theta`; without one they are the first three.
    ///
    /// # Errors
    /// No rows, missing columns, or fields that are no numbers.
    pub fn from_csv(text: &str) -> Result<Self, SamplesError> {
        let mut rows = text
            .lines()
            .enumerate()
            .map(|(i, line)| (i + 1, fields(line)))
            .filter(|(_, fields)| !fields.is_empty())
            .peekable();
        let (_, first) = rows.peek().ok_or(SamplesError::Empty)?;
        let has_header = first.iter().all(|field| field.parse::<f64>().is_err());
        let columns = if has_header {
            Columns::named(first)?
        } else {
            Columns::first(first.len())
        };
        let mut samples = Self {
            points: Vec::new(),
            headings: columns.heading.map(|_| Vec::new()),
            rounding_m: 0.0,
        };
        let mut n_decimals = 0;
        for (line, fields) in rows.skip(usize::from(has_header)) {
            let row = columns.read(line, &fields)?;
            n_decimals = n_decimals.max(decimals(fields[columns.x]));
            n_decimals = n_decimals.max(decimals(fields[columns.y]));
            samples.points.push(Point2::new(row[0], row[1]));
            if let Some(headings) = &mut samples.headings {
                headings.push(row[2]);
            }
        }
        if samples.points.is_empty() {
            return Err(SamplesError::Empty);
        }
        if n_decimals >= N_DECIMALS_OF_ROUNDED {
            samples.rounding_m = 0.5 * 10_f64.powi(-n_decimals);
        }
        Ok(samples)
    }

    /// The largest distance between the path and a sample, meters: both are rounded.
    pub fn deviation_m(&self) -> f64 {
        deviation_m(self.rounding_m)
    }

    /// The arcs and gears through the samples; headings tell the first gear, without them it is
    /// `first_gear`.
    pub fn path(&self, first_gear: Direction) -> Option<CurvePath> {
        let Some(headings) = &self.headings else {
            return path_through_points(&self.points, first_gear, self.rounding_m);
        };
        let poses: Vec<_> = self
            .points
            .iter()
            .zip(headings)
            .map(|(&point, &heading)| Pose2::at(point, heading))
            .collect();
        path_through_poses(&poses, self.rounding_m)
    }
}

impl Columns {
    fn first(n_fields: usize) -> Self {
        Self {
            x: 0,
            y: 1,
            heading: (n_fields > 2).then_some(2),
        }
    }

    fn named(header: &[&str]) -> Result<Self, SamplesError> {
        let place = |names: &[&str]| {
            header.iter().position(|field| {
                let bare = field.trim_matches('"');
                names.iter().any(|name| bare.eq_ignore_ascii_case(name))
            })
        };
        let needed = |missing: &'static str, names: &[&str]| {
            place(names).ok_or_else(|| SamplesError::NoColumn {
                header: beginning(&header.join(",")),
                missing,
            })
        };
        Ok(Self {
            x: needed("x", &["x", "x_m"])?,
            y: needed("y", &["y", "y_m"])?,
            heading: place(&["heading", "heading_rad", "yaw", "theta"]),
        })
    }

    /// x, y and heading (0 where there is none) of a row.
    fn read(&self, line: usize, fields: &[&str]) -> Result<[f64; 3], SamplesError> {
        let n_needed = 1 + self.x.max(self.y).max(self.heading.unwrap_or(0));
        if fields.len() < n_needed {
            return Err(SamplesError::ShortRow {
                line,
                n_fields: fields.len(),
                n_needed,
            });
        }
        let number = |column: usize| {
            let parsed = fields[column].parse::<f64>().ok();
            parsed
                .filter(|value| value.abs() <= 1e9)
                .ok_or_else(|| SamplesError::BadNumber {
                    line,
                    field: beginning(fields[column]),
                })
        };
        let heading = self.heading.map_or(Ok(0.0), number)?;
        Ok([number(self.x)?, number(self.y)?, heading])
    }
}

/// As much of a text as a message should repeat.
fn beginning(text: &str) -> String {
    text.chars().take(40).collect()
}

fn fields(line: &str) -> Vec<&str> {
    let line = line.split('#').next().unwrap_or_default();
    let line = line.trim_start_matches('\u{feff}');
    if line.contains([',', ';']) {
        let fields = line.split([',', ';']).map(str::trim);
        return fields.collect();
    }
    line.split_whitespace().collect()
}

/// Digits behind the point, up to 17 (more say nothing about a double).
fn decimals(field: &str) -> i32 {
    let (mantissa, exponent) = field.split_once(['e', 'E']).unwrap_or((field, "0"));
    let n_digits = mantissa
        .split_once('.')
        .map_or(0, |(_, digits)| digits.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    (n_digits.min(17) as i32)
        .saturating_sub(exponent)
        .clamp(0, 17)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn reads_with_and_without_header_and_heading() {
        let bare = Samples::from_csv("1.5,2\n2.25,2\n").unwrap();
        assert_eq!(bare.points[1], Point2::new(2.25, 2.0));
        assert_eq!(bare.headings, None);
        assert_eq!(bare.rounding_m, 0.0);
        let fine = Samples::from_csv("1.500,2").unwrap();
        assert!((fine.rounding_m - 0.0005).abs() < 1e-15);
        let named = Samples::from_csv("t;yaw;y;x\n0;0.5;2;1\n").unwrap();
        assert_eq!(named.points, [Point2::new(1.0, 2.0)]);
        assert_eq!(named.headings, Some(vec![0.5]));
        let blanks = Samples::from_csv("# a path\n1 2 3\n\n4 5 6 # end\n").unwrap();
        assert_eq!(blanks.headings, Some(vec![3.0, 6.0]));
    }

    #[test]
    fn says_what_is_wrong_and_where() {
        let error = |text: &str| Samples::from_csv(text).unwrap_err();
        assert_eq!(error(""), SamplesError::Empty);
        assert_eq!(error("x,y\n"), SamplesError::Empty);
        assert!(matches!(
            error("a,b\n1,2\n"),
            SamplesError::NoColumn { missing: "x", .. }
        ));
        assert!(matches!(
            error("1,2,3\n1,2\n"),
            SamplesError::ShortRow { line: 2, .. }
        ));
        for bad in ["nan", "inf", "1e10", "", "one"] {
            let text = format!("1,2\n3,{bad}\n");
            assert!(
                matches!(error(&text), SamplesError::BadNumber { line: 2, .. }),
                "{bad}"
            );
        }
    }

    proptest! {
        #[test]
        fn no_text_makes_it_panic(text in "[-0-9.,;eE# xy\n]{0,60}") {
            if let Ok(samples) = Samples::from_csv(&text) {
                prop_assert!(samples.path(Direction::Reverse).is_some());
            }
        }
    }
}
