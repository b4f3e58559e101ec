//! A path of another program, as its samples tell it.

use super::{Report, Samples};
use crate::path::{CurvePath, Direction};
use crate::vehicle::Motion;

/// A path and, where it may have been driven in the other gear, its second reading.
///
/// ```
/// use formicar::collision::ObstacleMap;
/// use formicar::geometry::Point2;
/// use formicar::validation::{FOREIGN_CURVATURE_SLACK, ForeignPath, Samples, judge_path};
/// use formicar::vehicle::Motion;
/// use formicar::{OccupancyGrid, Vehicle};
///
/// let map = OccupancyGrid::from_rows(&["..............."; 10], 1.0)?;
/// let (obstacles, vehicle) = (ObstacleMap::new(&map), Vehicle::warehouse_amr());
/// let samples = Samples {
///     points: vec![Point2::new(3.0, 5.0), Point2::new(9.0, 5.0)],
///     headings: None,
///     rounding_m: 0.0,
/// };
/// let path = ForeignPath::new(&samples, Motion::Car).expect("two points");
/// let (driven, report) =
///     path.judged_by(|path| judge_path(&obstacles, &vehicle, path, FOREIGN_CURVATURE_SLACK));
/// assert!(report.valid && driven.length_m() == 6.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ForeignPath {
    path: CurvePath,
    /// The same points driven with the gears exchanged.
    exchanged: Option<CurvePath>,
}

impl ForeignPath {
    /// The path through samples; none where there are none. Points without headings do not tell
    /// the gears of a car.
    pub fn new(samples: &Samples, motion: Motion) -> Option<Self> {
        if samples.points.is_empty() {
            return None;
        }
        if motion == Motion::Point {
            return Some(CurvePath::from_polyline(&samples.points).into());
        }
        let is_open = samples.headings.is_none();
        Some(Self {
            path: samples.path(Direction::Forward)?,
            exchanged: is_open.then(|| samples.path(Direction::Reverse)).flatten(),
        })
    }

    /// The path; of two readings, the one that begins forward.
    pub fn path(&self) -> &CurvePath {
        &self.path
    }

    /// The path with a judge's findings: of two readings the second where it alone is valid.
    pub fn judged_by(&self, judge: impl Fn(&CurvePath) -> Report) -> (&CurvePath, Report) {
        let report = judge(&self.path);
        if let (false, Some(exchanged)) = (report.valid, &self.exchanged) {
            let other = judge(exchanged);
            if other.valid {
                return (exchanged, other);
            }
        }
        (&self.path, report)
    }
}

/// A path whose gears are known.
impl From<CurvePath> for ForeignPath {
    fn from(path: CurvePath) -> Self {
        Self {
            path,
            exchanged: None,
        }
    }
}
