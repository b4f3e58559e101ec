//! The columns of a table of poses, by the names that tools give them.

use super::samples_error::{SamplesError, beginning};
use crate::geometry::{Point2, yaw_of_quaternion};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The columns of position and heading, and how many fields a header names.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Columns {
    pub(super) x: usize,
    pub(super) y: usize,
    pub(super) heading: Heading,
    names: Option<Vec<String>>,
}

/// The columns that tell the heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Heading {
    None,
    Radians(usize),
    Degrees(usize),
    /// Radians from the x axis or, as tools for race lines count them, from the y axis.
    Psi(usize),
    /// Of a quaternion x, y, z, w; x and y are 0 where they are left out.
    Quaternion([Option<usize>; 2], [usize; 2]),
}

const X: [&str; 8] = [
    "x", "x_m", "px", "p_x", "pos_x", "x_pos", "pose_x", "x_meters",
];
const Y: [&str; 8] = [
    "y", "y_m", "py", "p_y", "pos_y", "y_pos", "pose_y", "y_meters",
];
const HEADING: [&str; 6] = ["heading", "yaw", "theta", "th", "orientation", "psi"];
/// What stands before a letter of a quaternion.
const QUATERNION: [&str; 6] = ["q", "q_", "quat_", "orientation_", "rot_", "rotation_"];

/// A name of a header as it is looked up, and the unit that it states.
struct Name {
    bare: String,
    unit: Option<String>,
}

impl Name {
    fn of(field: &str) -> Self {
        let field = field.trim_matches(|c: char| c == '"' || c == '\'' || c.is_whitespace());
        let (name, unit) = match field.split_once(['[', '(']) {
            Some((name, unit)) => (name, Some(unit.trim_end_matches([']', ')']).trim())),
            None => (field, None),
        };
        let joined = name
            .trim()
            .to_ascii_lowercase()
            .replace(['.', '/', ' ', '-'], "_");
        let mut bare = joined.trim_matches('_');
        // As `ros2 topic echo --csv`, `rostopic echo -p` and PlotJuggler write the fields of a pose.
        if let Some(at) = bare.rfind("position_") {
            bare = &bare[at + "position_".len()..];
        } else if let Some(at) = bare.rfind("orientation_") {
            bare = &bare[at..];
        }
        Self {
            bare: bare.to_owned(),
            unit: unit.map(str::to_ascii_lowercase),
        }
    }

    fn is_length(&self, names: &[&str]) -> bool {
        names.contains(&self.bare.as_str())
    }

    /// The column at `at`, if it is named like a heading.
    fn heading(&self, at: usize) -> Option<Heading> {
        let degrees = ["_deg", "_degrees"]
            .iter()
            .find_map(|end| self.bare.strip_suffix(end));
        let radians = ["_rad", "_radians"]
            .iter()
            .find_map(|end| self.bare.strip_suffix(end));
        let base = degrees.or(radians).unwrap_or(&self.bare);
        let base = base.strip_suffix("_angle").unwrap_or(base);
        if !HEADING.contains(&base) {
            return None;
        }
        let unit = self.unit.as_deref();
        let is_degrees = degrees.is_some() || matches!(unit, Some("deg" | "degrees" | "\u{b0}"));
        Some(if is_degrees {
            Heading::Degrees(at)
        } else if base == "psi" {
            Heading::Psi(at)
        } else {
            Heading::Radians(at)
        })
    }

    fn is_of_quaternion(&self, letter: &str) -> bool {
        let before = self.bare.strip_suffix(letter);
        before.is_some_and(|before| QUATERNION.contains(&before))
    }
}

impl Columns {
    /// Without a header: the first three are x, y and heading.
    pub(super) fn first(n_fields: usize) -> Self {
        Self {
            x: 0,
            y: 1,
            heading: if n_fields > 2 {
                Heading::Radians(2)
            } else {
                Heading::None
            },
            names: None,
        }
    }

    /// Those that a header names.
    ///
    /// # Errors
    /// No name for x or y, several, or another unit than meters.
    pub(super) fn named(header: &[&str]) -> Result<Self, SamplesError> {
        let names: Vec<Name> = header.iter().map(|field| Name::of(field)).collect();
        let needed = |missing: &'static str, known: &[&str]| {
            let mut found = (0..names.len()).filter(|&i| names[i].is_length(known));
            let at = found.next().ok_or_else(|| SamplesError::NoColumn {
                header: beginning(&header.join(",")),
                missing,
            })?;
            if let Some(other) = found.next() {
                let two = [at, other].map(|i| beginning(header[i]));
                return Err(SamplesError::TwoColumns { name: missing, two });
            }
            match names[at].unit.as_deref() {
                None | Some("m" | "meter" | "meters" | "metres") => Ok(at),
                Some(_) => Err(SamplesError::NotMeters {
                    name: beginning(header[at]),
                }),
            }
        };
        let place = |letter: &str| names.iter().position(|name| name.is_of_quaternion(letter));
        let quaternion = || {
            let turn = [place("z")?, place("w")?];
            Some(Heading::Quaternion([place("x"), place("y")], turn))
        };
        let heading = names
            .iter()
            .enumerate()
            .find_map(|(i, name)| name.heading(i));
        Ok(Self {
            x: needed("x", &X)?,
            y: needed("y", &Y)?,
            heading: heading.or_else(quaternion).unwrap_or(Heading::None),
            names: Some(header.iter().map(|name| name.trim().to_owned()).collect()),
        })
    }

    /// Refuses a row that does not have the fields that the header names: which is which is open.
    pub(super) fn check_length(&self, line: usize, fields: &[&str]) -> Result<(), SamplesError> {
        let n_named = self.names.as_ref().map_or(usize::MAX, Vec::len);
        let n_fields = fields.len();
        match fields.get(n_named..) {
            Some(rest) if rest.iter().any(|field| !field.is_empty()) => {
                Err(SamplesError::LongRow {
                    line,
                    n_fields,
                    n_named,
                })
            }
            Some(_) | None => Ok(()),
        }
    }

    /// The position of a row, and its heading where the columns have one.
    pub(super) fn read(&self, line: usize, fields: &[&str]) -> Result<Pose, SamplesError> {
        let last = self.used().max().unwrap_or(0);
        if fields.len() <= last {
            return Err(SamplesError::ShortRow {
                line,
                n_fields: fields.len(),
                n_needed: last + 1,
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
        let heading = match self.heading {
            Heading::None => None,
            Heading::Radians(at) | Heading::Psi(at) => Some(number(at)?),
            Heading::Degrees(at) => Some(number(at)?.to_radians()),
            Heading::Quaternion(tilt, turn) => {
                let part = |at: Option<usize>| at.map_or(Ok(0.0), number);
                let [x, y] = [part(tilt[0])?, part(tilt[1])?];
                let [z, w] = [number(turn[0])?, number(turn[1])?];
                let yaw = yaw_of_quaternion([x, y, z, w]);
                Some(yaw.ok_or(SamplesError::BadQuaternion { line })?)
            }
        };
        let point = Point2::new(number(self.x)?, number(self.y)?);
        Ok(Pose { point, heading })
    }

    fn used(&self) -> impl Iterator<Item = usize> {
        let heading = match self.heading {
            Heading::None => [None; 4],
            Heading::Radians(at) | Heading::Degrees(at) | Heading::Psi(at) => {
                [Some(at), None, None, None]
            }
            Heading::Quaternion([x, y], [z, w]) => [x, y, Some(z), Some(w)],
        };
        heading.into_iter().flatten().chain([self.x, self.y])
    }

    /// Turns headings from the y axis to the x axis where a column may hold either and the steps
    /// between the points agree better with the former.
    pub(super) fn orient(&self, points: &[Point2], headings: &mut [f64]) -> HeadingOrigin {
        if !matches!(self.heading, Heading::Psi(_)) || !runs_across(points, headings) {
            return HeadingOrigin::XAxis;
        }
        for heading in headings {
            *heading += FRAC_PI_2;
        }
        HeadingOrigin::YAxis
    }

    /// How a table was read, in words.
    pub(super) fn in_words(&self, origin: HeadingOrigin) -> String {
        let Some(names) = &self.names else {
            return match self.heading {
                Heading::None => "x and y from two columns without a header".to_owned(),
                Heading::Radians(_)
                | Heading::Degrees(_)
                | Heading::Psi(_)
                | Heading::Quaternion(..) => {
                    "x, y and heading in radians from the first three columns, without a header"
                        .to_owned()
                }
            };
        };
        let [x, y] = [self.x, self.y].map(|at| names[at].as_str());
        let heading = match (self.heading, origin) {
            (Heading::None, _) => "no headings".to_owned(),
            (Heading::Radians(at) | Heading::Psi(at), HeadingOrigin::XAxis) => {
                format!("the heading from {}, in radians", names[at])
            }
            (Heading::Radians(at) | Heading::Psi(at), HeadingOrigin::YAxis) => format!(
                "the heading from {}, in radians from the y axis, as the steps show",
                names[at]
            ),
            (Heading::Degrees(at), _) => format!("the heading from {}, in degrees", names[at]),
            (Heading::Quaternion(_, [z, w]), _) => {
                format!(
                    "the heading from the quaternion {} and {}",
                    names[z], names[w]
                )
            }
        };
        format!("x and y from {x} and {y}, {heading}")
    }
}

/// A row.
pub(super) struct Pose {
    pub(super) point: Point2,
    pub(super) heading: Option<f64>,
}

/// The axis from which headings are counted, counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HeadingOrigin {
    XAxis,
    YAxis,
}

/// True if the steps run across the headings rather than along them, in either gear.
fn runs_across(points: &[Point2], headings: &[f64]) -> bool {
    let across = |(step, &heading): (&[Point2], &f64)| {
        let along = step[1] - step[0];
        let ahead = Point2::unit(heading);
        along.cross(ahead).powi(2) - along.dot(ahead).powi(2)
    };
    let steps = points.windows(2).zip(headings);
    steps.map(across).sum::<f64>() > 0.0
}

/// True if headings are beyond a turn and the steps between points follow them as degrees far
/// better than as radians.
pub(super) fn look_like_degrees(points: &[Point2], headings: &[f64]) -> bool {
    let is_beyond = headings.iter().any(|heading| heading.abs() > TAU);
    let misfit = |turn: fn(f64) -> f64| {
        let steps = points.windows(2).zip(headings);
        let across = steps.map(|(step, &heading)| {
            let ahead = Point2::unit(turn(heading));
            (step[1] - step[0]).cross(ahead).powi(2)
        });
        across.sum::<f64>()
    };
    is_beyond && misfit(f64::to_radians) < 0.1 * misfit(|radians| radians)
}
