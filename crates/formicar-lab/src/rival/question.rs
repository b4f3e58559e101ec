//! The question to a program, as JSON.

use anyhow::{Result, bail};
use formicar::collision::ObstacleMap;
use formicar::map::{BitGrid, Cell, GridFrame};
use formicar::numeric::Seed;
use formicar::scenario::{GoalTolerance, Request};
use formicar::vehicle::{Gears, Vehicle};
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// Name and version of the protocol.
pub const SCHEMA: &str = "formicar/rival/1";

/// The one document on the stdin of a program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Question {
    /// [`SCHEMA`].
    pub schema: String,
    /// The kind of question.
    #[serde(flatten)]
    pub ask: Ask,
}

/// The kind of a question.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
pub enum Ask {
    /// Name and version; asked once, before a campaign.
    Version,
    /// A path.
    Plan(Box<RivalRequest>),
}

/// All that a path is asked on.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RivalRequest {
    /// The map.
    pub map: RivalMap,
    /// The vehicle.
    pub vehicle: RivalVehicle,
    /// x, y, heading; meters and radians.
    pub start: [f64; 3],
    /// x, y, heading.
    pub goal: [f64; 3],
    /// The gears that may be used: `reverse` allows both.
    pub motion: Gears,
    /// Tolerance at the goal.
    pub goal_tolerance: GoalTolerance,
    /// Time after which to give up, milliseconds.
    pub deadline_ms: Option<f64>,
    /// Seed of the run.
    pub seed: u64,
}

/// The map as the judge sees it: what is unknown is decided, and beyond the border is no ground.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RivalMap {
    /// Columns.
    pub n_cols: usize,
    /// Rows.
    pub n_rows: usize,
    /// Side of a cell.
    pub resolution_m: f64,
    /// Pose of the outer corner of the first cell: x, y, heading.
    pub origin: [f64; 3],
    /// The occupied cells in hexadecimal digits, row after row from the origin; every row fills
    /// whole bytes, the first cell is the highest bit.
    pub lethal: String,
}

/// The vehicle, around the center of its rear axle.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RivalVehicle {
    /// `car`, or `point` for one that moves in any direction.
    pub motion: String,
    /// Corners of the convex body with its safety margin, counter-clockwise; x forward, y left.
    pub footprint: Vec<[f64; 2]>,
    /// Distance between the axles, where it is known.
    pub wheelbase_m: Option<f64>,
    /// Smallest turning radius; 0 of a point.
    pub min_turning_radius_m: f64,
}

impl Question {
    /// Asks for name and version.
    pub fn version() -> Self {
        Self {
            schema: SCHEMA.to_owned(),
            ask: Ask::Version,
        }
    }

    /// A path for a request, on a map, for a vehicle.
    pub fn plan(
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
        request: &Request,
        Seed(seed): Seed,
    ) -> Self {
        let list = |pose: formicar::geometry::Pose2| [pose.x, pose.y, pose.heading];
        Self {
            schema: SCHEMA.to_owned(),
            ask: Ask::Plan(Box::new(RivalRequest {
                map: RivalMap::new(obstacles),
                vehicle: RivalVehicle::new(vehicle),
                start: list(request.start),
                goal: list(request.goal),
                motion: request.gears,
                goal_tolerance: request.goal_tolerance,
                deadline_ms: request.deadline.map(|time| time.as_secs_f64() * 1e3),
                seed,
            })),
        }
    }
}

impl RivalVehicle {
    fn new(vehicle: &Vehicle) -> Self {
        let corners = vehicle.footprint().corners().iter();
        Self {
            motion: vehicle.motion().name().to_owned(),
            footprint: corners.map(|corner| [corner.x, corner.y]).collect(),
            wheelbase_m: vehicle.wheelbase_m(),
            min_turning_radius_m: vehicle.min_turning_radius_m(),
        }
    }
}

impl RivalMap {
    /// The description of a map.
    pub fn new(obstacles: &ObstacleMap) -> Self {
        let (frame, cells) = (obstacles.frame(), obstacles.lethal());
        let origin = frame.origin();
        Self {
            n_cols: frame.n_cols(),
            n_rows: frame.n_rows(),
            resolution_m: frame.resolution_m(),
            origin: [origin.x, origin.y, origin.heading],
            lethal: to_hex(cells),
        }
    }

    /// The frame of its cells.
    ///
    /// # Errors
    /// Sizes that no map has.
    pub fn frame(&self) -> Result<GridFrame> {
        let [x, y, heading] = self.origin;
        let origin = formicar::geometry::Pose2::new(x, y, heading);
        Ok(GridFrame::new(
            self.n_cols,
            self.n_rows,
            self.resolution_m,
            origin,
        )?)
    }

    /// The occupied cells.
    ///
    /// # Errors
    /// Digits that are none, or not as many as the map needs.
    pub fn cells(&self) -> Result<BitGrid> {
        let frame = self.frame()?;
        let (n_cols, n_rows) = (frame.n_cols(), frame.n_rows());
        let n_digits = 2 * n_cols.div_ceil(8);
        if self.lethal.len() != n_digits * n_rows {
            bail!(
                "map.lethal: {} digits; {n_cols} x {n_rows} cells are {}",
                self.lethal.len(),
                n_digits * n_rows
            );
        }
        let mut cells = BitGrid::new(n_cols, n_rows);
        for (i, digit) in self.lethal.chars().enumerate() {
            let Some(bits) = digit.to_digit(16) else {
                bail!("map.lethal: {digit:?} is no hexadecimal digit");
            };
            let (row, first) = (i / n_digits, 4 * (i % n_digits));
            for col in
                (first..(first + 4).min(n_cols)).filter(|c| bits >> (3 - (c - first)) & 1 == 1)
            {
                cells.insert(Cell::new(col as u32, row as u32));
            }
        }
        Ok(cells)
    }
}

fn to_hex(cells: &BitGrid) -> String {
    let n_bytes = cells.n_cols().div_ceil(8);
    let mut text = String::with_capacity(2 * n_bytes * cells.n_rows());
    for row in 0..cells.n_rows() {
        for byte in 0..n_bytes {
            // The first cell is the lowest bit of a word.
            let bits = (cells.row(row)[byte / 8] >> (8 * (byte % 8))) as u8;
            // Writing to a string does not fail.
            let _ = write!(text, "{:02x}", bits.reverse_bits());
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::geometry::Pose2;
    use formicar::map::OccupancyGrid;

    #[test]
    fn the_map_comes_out_as_it_went_in() {
        let rows = ["#.........#", "..#.....#..", "###......##"];
        let obstacles = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 0.5).unwrap());
        let map = RivalMap::new(&obstacles);
        // From the lowest row on, each in two bytes.
        assert_eq!(map.lethal, "e06020808020");
        assert_eq!(&map.cells().unwrap(), obstacles.lethal());
        let wrong = |lethal: &str| {
            let lethal = lethal.to_owned();
            let map = RivalMap {
                lethal,
                ..map.clone()
            };
            map.cells().unwrap_err().to_string()
        };
        assert!(wrong("e0").contains("2 digits; 11 x 3 cells are 12"));
        assert!(wrong("e0602080802x").contains("'x'"));
    }

    #[test]
    fn a_question_is_one_object() {
        let map = OccupancyGrid::from_rows(&["..."], 1.0).unwrap();
        let request = Request::new(Pose2::new(0.5, 0.5, 0.0), Pose2::new(2.5, 0.5, 1.0));
        let asked = Question::plan(
            &ObstacleMap::new(&map),
            &Vehicle::sedan(),
            &request,
            Seed(7),
        );
        let value = serde_json::to_value(&asked).unwrap();
        assert_eq!(value["ask"], "plan");
        assert_eq!(value["seed"], 7);
        assert_eq!(value["goal"], serde_json::json!([2.5, 0.5, 1.0]));
        assert_eq!(value["motion"], "reverse");
        assert_eq!(value["vehicle"]["motion"], "car");
        let back: Question = serde_json::from_value(value).unwrap();
        assert!(matches!(back.ask, Ask::Plan(_)));
        let version = serde_json::to_string(&Question::version()).unwrap();
        assert_eq!(version, r#"{"schema":"formicar/rival/1","ask":"version"}"#);
    }
}
