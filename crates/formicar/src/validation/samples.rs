//! Foreign paths as tables: CSV of `x, y[, heading]`, meters and radians, or with named columns.

use super::columns::{Columns, look_like_degrees};
use super::foreign::{deviation_m, path_through_points, path_through_poses};
use super::samples_error::SamplesError;
use crate::geometry::{Point2, Pose2};
use crate::path::{CurvePath, Direction};

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

/// The samples of a file, and how they were read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadSamples {
    /// The samples.
    pub samples: Samples,
    /// The columns or the kind of message that they were taken from, in words.
    pub reading: String,
    /// Advice for a reader who expected something else.
    pub hint: Option<&'static str>,
}

/// Decimals from which a position counts as rounded: a curve may pass it within that rounding.
/// At coarser ones the curve could pass it so far off that a collision stays unseen.
const N_DECIMALS_OF_ROUNDED: i32 = 3;

impl Samples {
    /// Reads a table; see [`ReadSamples::from_csv`].
    ///
    /// # Errors
    /// No rows, missing columns, or fields that are no numbers.
    pub fn from_csv(text: &str) -> Result<Self, SamplesError> {
        ReadSamples::from_csv(text).map(|read| read.samples)
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

impl ReadSamples {
    /// Reads a table. Fields are divided by commas, semicolons, tabs or blanks; `#` and `%` begin
    /// a comment.
    ///
    /// A header, if there is one, names the columns, also behind `#`, as `numpy.savetxt` writes it.
    /// Known are `x` and `y` (`x_m`, `pos_x`, `pose.position.x`), a heading in radians (`heading`,
    /// `yaw`, `theta`, `psi`, with `_rad` or without) or degrees (`heading_deg`, `yaw [deg]`), and
    /// the parts of a quaternion (`qz`, `qw`, `orientation.z`). The headings `psi` of tools for
    /// race lines are counted from the y axis; they are taken so where the steps between the points
    /// show it. Without a header the first three columns are x, y and heading.
    ///
    /// ```
    /// use formicar::validation::ReadSamples;
    ///
    /// let read = ReadSamples::from_csv("# s_m; x_m; y_m; psi_rad\n0; 1; 3; -1.5708\n1; 2; 3; -1.5708\n")?;
    /// assert_eq!(read.samples.points[1].x, 2.0);
    /// assert!(read.samples.headings.unwrap()[1].abs() < 1e-4);
    /// assert!(read.reading.contains("psi_rad"));
    /// # Ok::<(), formicar::validation::SamplesError>(())
    /// ```
    ///
    /// # Errors
    /// No rows, missing columns, or fields that are no numbers.
    pub fn from_csv(text: &str) -> Result<Self, SamplesError> {
        let Table { columns, rows } = Table::of(text)?;
        let mut points = Vec::new();
        let mut headings = Vec::new();
        let mut n_decimals = 0;
        for (line, fields) in rows {
            columns.check_length(line, &fields)?;
            let pose = columns.read(line, &fields)?;
            n_decimals = n_decimals.max(decimals(fields[columns.x]));
            n_decimals = n_decimals.max(decimals(fields[columns.y]));
            points.push(pose.point);
            headings.extend(pose.heading);
        }
        let origin = columns.orient(&points, &mut headings);
        let hint = look_like_degrees(&points, &headings).then_some(
            "the headings follow the steps as degrees; name their column heading_deg in a header",
        );
        let is_rounded = n_decimals >= N_DECIMALS_OF_ROUNDED;
        let samples = Samples {
            points,
            headings: Some(headings).filter(|headings| !headings.is_empty()),
            rounding_m: if is_rounded {
                0.5 * 10_f64.powi(-n_decimals)
            } else {
                0.0
            },
        };
        Ok(Self {
            samples,
            reading: columns.in_words(origin),
            hint,
        })
    }
}

/// The rows of a table, each with the number of its line, and what their columns hold.
struct Table<'a> {
    columns: Columns,
    rows: Vec<(usize, Vec<&'a str>)>,
}

impl<'a> Table<'a> {
    fn of(text: &'a str) -> Result<Self, SamplesError> {
        let text = text.trim_start_matches('\u{feff}');
        let mut commented = None;
        let mut rows = Vec::new();
        for (i, line) in text.lines().enumerate() {
            match comment(line) {
                Some(comment) if rows.is_empty() => {
                    // The last one that names x and y.
                    let names = fields(comment);
                    commented = Columns::named(&names)
                        .ok()
                        .map(|c| (c, names.len()))
                        .or(commented);
                }
                Some(_) => {}
                None => {
                    let line = line.split('#').next().unwrap_or_default();
                    rows.push((i + 1, fields(line)));
                    rows.pop_if(|(_, fields)| fields.is_empty());
                }
            }
        }
        let (_, first) = rows.first().ok_or(SamplesError::Empty)?;
        let columns = if first.iter().all(|field| field.parse::<f64>().is_err()) {
            let columns = Columns::named(first)?;
            rows.remove(0);
            columns
        } else {
            let n_fields = first.len();
            let header = commented.filter(|(_, n_names)| *n_names == n_fields);
            header.map_or_else(|| Columns::first(n_fields), |(columns, _)| columns)
        };
        if rows.is_empty() {
            return Err(SamplesError::Empty);
        }
        Ok(Self { columns, rows })
    }
}

/// The text of a line that is a comment; the `%time` of `rostopic echo -p` is a name.
fn comment(line: &str) -> Option<&str> {
    let line = line.trim();
    let percent = line
        .strip_prefix('%')
        .filter(|rest| !rest.starts_with("time,"));
    line.strip_prefix('#')
        .or(percent)
        .map(|rest| rest.trim_start_matches(['#', '%']))
}

/// The fields of a line; `x [m] y [m]` has two.
fn fields(line: &str) -> Vec<&str> {
    if line.contains([',', ';']) {
        return line.split([',', ';']).map(str::trim).collect();
    }
    let mut fields: Vec<std::ops::Range<usize>> = Vec::new();
    for word in line.split_whitespace() {
        let start = word.as_ptr() as usize - line.as_ptr() as usize;
        let end = start + word.len();
        match fields.last_mut() {
            Some(last) if word.starts_with(['[', '(']) => last.end = end,
            Some(_) | None => fields.push(start..end),
        }
    }
    fields.into_iter().map(|range| &line[range]).collect()
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

    #[test]
    fn headers_are_read_as_tools_write_them() {
        let read = |header: &str, row: &str| {
            let text = format!("{header}\n{row}\n{row}\n");
            let read = ReadSamples::from_csv(&text).unwrap();
            let headings = read.samples.headings.unwrap_or_default();
            (read.samples.points[0], headings.first().copied())
        };
        let at = Point2::new(1.0, 3.0);
        let half = std::f64::consts::FRAC_PI_2;
        for (header, row, heading) in [
            ("# s_m; x_m; y_m; kappa", "9; 1; 3; 7", None),
            (
                "# id 5\n# x_m, y_m, w_tr_right_m, w_tr_left_m",
                "1, 3, 1.1, 1.1",
                None,
            ),
            ("# x y theta", "1 3 0.5", Some(0.5)),
            ("# x,y,yaw", "1 3 0.5", Some(0.5)),
            ("#x [m] y [m] yaw [deg]", "1 3 90", Some(half)),
            ("% x, y, heading_deg", "1, 3, 90", Some(half)),
            ("pos_x,pos_y,yaw_rad", "1,3,0.5", Some(0.5)),
            ("\"x\",\"y\",\"psi_rad\"", "1,3,0.5", Some(0.5)),
            ("x,y,z,qx,qy,qz,qw", "1,3,0,0,0,1,1", Some(half)),
            (
                "%time,field.pose.position.x,field.pose.position.y,field.pose.orientation.z,field.pose.orientation.w",
                "7,1,3,1,1",
                Some(half),
            ),
            ("/odom/pose/position/x,/odom/pose/position/y", "1,3", None),
            ("x (m),y (m),v (m/s)", "1,3,2", None),
        ] {
            let (point, found) = read(header, row);
            assert_eq!(point, at, "{header}");
            assert_eq!(found.is_some(), heading.is_some(), "{header}");
            let off = found
                .zip(heading)
                .map_or(0.0, |(found, heading)| found - heading);
            assert!(off.abs() < 1e-12, "{header}: {found:?}");
        }
    }

    #[test]
    fn the_reading_is_told() {
        let told = |text: &str| ReadSamples::from_csv(text).unwrap();
        let bare = told("1,2,0\n2,2,0\n");
        assert!(
            bare.reading.contains("first three columns"),
            "{}",
            bare.reading
        );
        assert_eq!(bare.hint, None);
        let north = told("# x_m; y_m; psi_rad\n1; 3; -1.5708\n2; 3; -1.5708\n");
        assert!(
            north.reading.contains("from the y axis"),
            "{}",
            north.reading
        );
        assert!(north.samples.headings.unwrap()[0].abs() < 1e-4);
        let east = told("# x_m; y_m; psi_rad\n1; 3; 0.1\n2; 3; -0.1\n");
        assert!(!east.reading.contains("y axis"), "{}", east.reading);
        let degrees = told("1,2,90\n1,3,90\n1,4,90\n");
        assert!(degrees.hint.unwrap().contains("heading_deg"));
        // Unwrapped radians are no degrees.
        let unwrapped = told("1,2,7.854\n1,3,7.854\n");
        assert_eq!(unwrapped.hint, None);
    }

    #[test]
    fn a_header_that_leaves_open_which_is_which_is_refused() {
        let error = |text: &str| Samples::from_csv(text).unwrap_err().to_string();
        assert!(error("x,y,pose.position.x\n1,2,3\n").contains("twice"));
        assert!(error("x [mm],y [mm]\n1,2\n").contains("not in meters"));
        assert!(error("x,y\n0,1,2\n").contains("3 fields, the header names 2"));
        assert!(Samples::from_csv("x,y\n1,2,\n").is_ok());
        assert!(error("x,y,qz,qw\n1,2,0,0\n").contains("points nowhere"));
    }

    proptest! {
        #[test]
        fn no_text_makes_it_panic(text in "[-0-9.,;eE#% xyqzw_\\[\\]\n]{0,60}") {
            if let Ok(samples) = Samples::from_csv(&text) {
                prop_assert!(samples.path(Direction::Reverse).is_some());
            }
        }
    }
}
