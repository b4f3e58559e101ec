//! Cases of the TPCAP parking benchmark: two poses among polygons.

use super::files::{MAX_TEXT_BYTES, read_bytes, text};
use super::matrix::values;
use super::{FormatError, FormatProblem, Place};
use crate::geometry::{Point2, Pose2};
use crate::map::{GridFrame, OCCUPIED, OccupancyGrid};
use std::path::Path;

/// Free ground around everything in a case, meters.
pub const TPCAP_MARGIN_M: f64 = 10.0;

/// A parking case, moved so that everything has positive coordinates near 0.
///
/// Some cases lie 10^9 m from their origin, where meters have few digits left.
#[derive(Clone, Debug, PartialEq)]
pub struct TpcapCase {
    /// Rear-axle pose at the beginning.
    pub start: Pose2,
    /// Rear-axle pose at the end.
    pub goal: Pose2,
    /// Corners of each obstacle, in order.
    pub obstacles: Vec<Vec<Point2>>,
    /// The offset that was subtracted: a point of the file is this plus the point here.
    pub shift: Point2,
}

impl TpcapCase {
    /// Reads a case from its file.
    ///
    /// # Errors
    /// A file that cannot be read, and whatever [`Self::parse`] refuses.
    pub fn read(path: &Path) -> Result<Self, FormatError> {
        let bytes = read_bytes(path, MAX_TEXT_BYTES)?;
        text(&bytes, EXPECTED)
            .and_then(Self::parse)
            .map_err(|e| e.in_file(path))
    }

    /// Reads a case from comma-separated values: start and goal (x, y, heading), the number of
    /// obstacles, the number of corners of each, and all corners (x, y).
    ///
    /// # Errors
    /// Words that are no finite numbers, counts that do not fit, or obstacles with fewer than
    /// three corners.
    pub fn parse(text: &str) -> Result<Self, FormatError> {
        let mut numbers = Numbers::of(text)?;
        let mut case = Self {
            start: numbers.pose()?,
            goal: numbers.pose()?,
            obstacles: Vec::new(),
            shift: Point2::default(),
        };
        let n_obstacles = numbers.count("the number of obstacles", 0)?;
        let n_corners = (0..n_obstacles)
            .map(|_| numbers.count("an obstacle's number of corners", 3))
            .collect::<Result<Vec<usize>, _>>()?;
        for n in n_corners {
            let corners = (0..n).map(|_| numbers.point());
            case.obstacles.push(corners.collect::<Result<_, _>>()?);
        }
        let n_extra = numbers.left.len();
        if n_extra > 0 {
            let unit = "numbers";
            return Err(FormatProblem::Trailing { unit, n_extra }.into());
        }
        case.move_to_origin();
        Ok(case)
    }

    /// The case as a map with origin (0, 0, 0): each cell that an obstacle touches is occupied,
    /// and [`TPCAP_MARGIN_M`] of ground lies around everything.
    ///
    /// # Errors
    /// A resolution that is not a positive finite number, or so fine that the map gets too large.
    pub fn rasterize(&self, resolution_m: f64) -> Result<OccupancyGrid, FormatError> {
        let extent = self.points().fold(Point2::default(), |e, p| {
            Point2::new(e.x.max(p.x), e.y.max(p.y))
        });
        let n_cells = |length_m: f64| ((length_m + TPCAP_MARGIN_M) / resolution_m).ceil() as usize;
        // A resolution of no use gives a size of no use; the resolution is what the user can change.
        GridFrame::new(1, 1, resolution_m, Pose2::default())?;
        let frame = GridFrame::new(
            n_cells(extent.x),
            n_cells(extent.y),
            resolution_m,
            Pose2::default(),
        )?;
        let mut grid = OccupancyGrid::free(frame);
        for corners in &self.obstacles {
            grid.fill_polygon(corners, OCCUPIED);
        }
        Ok(grid)
    }

    fn points(&self) -> impl Iterator<Item = Point2> + '_ {
        let poses = [self.start.position(), self.goal.position()];
        poses
            .into_iter()
            .chain(self.obstacles.iter().flatten().copied())
    }

    fn move_to_origin(&mut self) {
        let far = Point2::new(f64::INFINITY, f64::INFINITY);
        let low = self
            .points()
            .fold(far, |l, p| Point2::new(l.x.min(p.x), l.y.min(p.y)));
        let shift = low - Point2::new(TPCAP_MARGIN_M, TPCAP_MARGIN_M);
        let moved = |p: Point2| p - shift;
        self.start = Pose2::at(moved(self.start.position()), self.start.heading);
        self.goal = Pose2::at(moved(self.goal.position()), self.goal.heading);
        for corner in self.obstacles.iter_mut().flatten() {
            *corner = moved(*corner);
        }
        self.shift = shift;
    }
}

const EXPECTED: &str = "a TPCAP case: x0, y0, heading0, x1, y1, heading1, number of obstacles, ...";

/// True if a text looks like a case rather than a matrix: seven or more values in its first line,
/// not all of them 0 or 1.
pub(super) fn is_tpcap(text: &str) -> bool {
    let first = text.trim_start().lines().next().unwrap_or("");
    let words: Vec<&str> = values(first).collect();
    let cell = |word: &str| matches!(word.parse::<f64>(), Ok(0.0 | 1.0));
    words.len() >= 7 && !words.iter().all(|word| cell(word))
}

/// The numbers that are still to be read.
struct Numbers {
    left: std::vec::IntoIter<f64>,
    n_all: usize,
}

/// Larger coordinates than any place on earth; sums and squares of them stay finite.
const MAX_COORDINATE: f64 = 1e12;

impl Numbers {
    fn of(text: &str) -> Result<Self, FormatError> {
        let words = text.lines().map(str::trim).filter(|line| !line.is_empty());
        let all = words
            .flat_map(values)
            .enumerate()
            .map(|(i, word)| number(word).map_err(|problem| problem.at(Place::Value(i + 1))))
            .collect::<Result<Vec<f64>, _>>()?;
        if all.is_empty() {
            return Err(FormatProblem::Empty { expected: EXPECTED }.into());
        }
        let n_all = all.len();
        Ok(Self {
            left: all.into_iter(),
            n_all,
        })
    }

    fn next(&mut self) -> Result<f64, FormatError> {
        let truncated = FormatProblem::Truncated {
            unit: "numbers",
            found: self.n_all,
            needed: self.n_all + 1,
        };
        self.left.next().ok_or(truncated.into())
    }

    fn point(&mut self) -> Result<Point2, FormatError> {
        Ok(Point2::new(self.next()?, self.next()?))
    }

    fn pose(&mut self) -> Result<Pose2, FormatError> {
        Ok(Pose2::at(self.point()?, self.next()?))
    }

    /// A count, which cannot exceed the numbers that are left.
    fn count(&mut self, thing: &'static str, least: usize) -> Result<usize, FormatError> {
        let number = self.next()?;
        let n_left = self.left.len();
        let place = Place::Value(self.n_all - n_left);
        let fits = number.fract() == 0.0 && (least as f64..=n_left as f64).contains(&number);
        if !fits {
            let expected = format!(
                "a whole number of at least {least} and at most {n_left}, the numbers that follow"
            );
            return Err(FormatProblem::bad_value(thing, number, expected).at(place));
        }
        Ok(number as usize)
    }
}

fn number(word: &str) -> Result<f64, FormatProblem> {
    let number = word.parse().ok();
    number
        .filter(|n: &f64| n.abs() <= MAX_COORDINATE)
        .ok_or_else(|| FormatProblem::bad_value("a number", word, "between -1e12 and 1e12"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASE: &str = "1000000001,5,0.5,1000000004,7,1,1,3,\
        1000000000,5,1000000002,5,1000000000,8\n";

    #[test]
    fn moves_far_cases_to_the_origin() {
        let case = TpcapCase::parse(CASE).unwrap();
        assert_eq!(case.start, Pose2::new(11.0, 10.0, 0.5));
        assert_eq!(case.goal, Pose2::new(14.0, 12.0, 1.0));
        assert_eq!(case.shift, Point2::new(999_999_990.0, -5.0));
        let grid = case.rasterize(1.0).unwrap();
        assert_eq!((grid.frame().n_cols(), grid.frame().n_rows()), (24, 23));
        let occupied: Vec<(u32, u32)> = grid
            .lethal_cells()
            .iter()
            .map(|c| (c.col, c.row))
            .filter(|&(_, row)| row >= 12)
            .collect();
        assert_eq!(occupied, [(9, 12), (10, 12), (9, 13), (10, 13)]);
    }

    #[test]
    fn says_what_is_wrong() {
        let message = |from: &str, to: &str| {
            let text = CASE.replacen(from, to, 1);
            assert_ne!(text, CASE);
            TpcapCase::parse(&text).unwrap_err().to_string()
        };
        assert!(message("0.5", "nan").contains("value 3: a number is nan"));
        assert!(message("0.5", "x").contains("value 3: a number is x"));
        assert!(
            message(",1,3,", ",1e9,3,").contains("value 7: the number of obstacles is 1000000000")
        );
        assert!(message(",1,3,", ",1,2,").contains("value 8"));
        assert!(message(",1,3,", ",1,4,").contains("numbers, but"));
        assert!(message(",8\n", ",8,9\n").contains("1 numbers too many"));
        let case = TpcapCase::parse(CASE).unwrap();
        for (resolution_m, word) in [
            (0.0, "resolution 0 m"),
            (f64::NAN, "NaN"),
            (1e-9, "the limit"),
        ] {
            let error = case.rasterize(resolution_m).unwrap_err().to_string();
            assert!(error.contains(word), "{error}");
        }
    }

    #[test]
    fn tells_cases_from_matrices() {
        assert!(is_tpcap(CASE));
        assert!(!is_tpcap("0,1,0,0,0,0,0,1\n1,1,0,0,0,0,0,0"));
        assert!(!is_tpcap("0,1,2"));
    }
}
