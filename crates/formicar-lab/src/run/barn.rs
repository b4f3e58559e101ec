//! Worlds of the BARN benchmark (Perille et al. 2020): fields of cylinders, each with the same start
//! and goal.

use anyhow::{Context, Result, bail};
use formicar::geometry::{Point2, Pose2};
use formicar::map::{Cell, GridFrame, OCCUPIED, OccupancyGrid};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Side of a cell where nothing else is said, meters: a third of a cylinder's width.
pub const BARN_RESOLUTION_M: f64 = 0.05;
/// Ground around all cylinders and both ends, meters.
const MARGIN_M: f64 = 2.0;
/// A cylinder that touches a cell within this has not reached it, meters.
const TOUCH_M: f64 = 1e-9;
/// The preset that drives where no other vehicle is named: about as long as BARN's robot.
pub const BARN_VEHICLE: &str = "f1tenth";

/// The worlds of a file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BarnWorlds {
    /// Radius of every cylinder.
    radius_m: f64,
    /// x, y, heading.
    start: [f64; 3],
    /// x, y, heading.
    goal: [f64; 3],
    /// Centers of the cylinders of each world.
    worlds: BTreeMap<u32, Vec<[f64; 2]>>,
}

impl BarnWorlds {
    /// Reads a file; none where it is JSON of another kind.
    ///
    /// # Errors
    /// A file that cannot be read, and worlds that are none.
    pub fn read(path: &Path) -> Result<Option<Self>> {
        let hint = "hint: BARN's worlds are not part of formicar";
        let name = || path.display().to_string();
        let read = fs::read_to_string(path);
        let text = read.with_context(|| format!("{} cannot be read; {hint}", path.display()))?;
        Self::parse(&text).with_context(name)
    }

    fn parse(text: &str) -> Result<Option<Self>> {
        let value: serde_json::Value = serde_json::from_str(text)?;
        if value.get("worlds").is_none() {
            return Ok(None);
        }
        let worlds: Self = serde_json::from_value(value).context("worlds of BARN")?;
        if !(worlds.radius_m > 0.0 && worlds.radius_m <= 10.0) {
            bail!(
                "radius_m: {}; expected meters above 0, at most 10",
                worlds.radius_m
            );
        }
        let is_near = |numbers: &[f64]| numbers.iter().all(|x| x.abs() <= 1e3);
        let mut cylinders = worlds.worlds.values().flatten();
        if !cylinders.all(|c| is_near(c)) || ![worlds.start, worlds.goal].iter().all(|p| is_near(p))
        {
            bail!("a place farther than 1000 m from the origin; expected meters");
        }
        Ok(Some(worlds))
    }

    /// The worlds' names, in order.
    pub fn ids(&self) -> impl Iterator<Item = u32> {
        self.worlds.keys().copied()
    }

    /// Start and goal.
    pub fn ends(&self) -> [Pose2; 2] {
        [self.start, self.goal].map(|[x, y, heading]| Pose2::new(x, y, heading))
    }

    /// A world as a map: occupied is each cell that a cylinder reaches into, all others are free,
    /// and there is no ground beyond a margin around cylinders and ends. Cells are aligned with
    /// the origin.
    ///
    /// # Errors
    /// A world that the file does not hold, and a resolution that gives no map.
    pub fn grid(&self, id: u32, resolution_m: f64) -> Result<OccupancyGrid> {
        let cylinders = self.worlds.get(&id).with_context(|| {
            let n = self.worlds.len();
            format!("no world {id} is there, but {n} others")
        })?;
        let ends = self.ends().map(Pose2::position);
        let points = cylinders
            .iter()
            .map(|&[x, y]| Point2::new(x, y))
            .chain(ends);
        let (low, high) = points.fold((ends[0], ends[0]), |(low, high), p| {
            let low = Point2::new(low.x.min(p.x), low.y.min(p.y));
            (low, Point2::new(high.x.max(p.x), high.y.max(p.y)))
        });
        let margin = Point2::new(MARGIN_M, MARGIN_M);
        let first = |meters: f64| (meters / resolution_m).floor() * resolution_m;
        let (low, high) = (low - margin, high + margin);
        let origin = Pose2::new(first(low.x), first(low.y), 0.0);
        let n_cells = |from: f64, to: f64| ((to - from) / resolution_m).ceil() as usize;
        let (n_cols, n_rows) = (n_cells(origin.x, high.x), n_cells(origin.y, high.y));
        let mut grid = OccupancyGrid::free(GridFrame::new(n_cols, n_rows, resolution_m, origin)?);
        for &[x, y] in cylinders {
            self.stand(&mut grid, Point2::new(x, y));
        }
        Ok(grid)
    }

    /// Occupies the cells that a cylinder reaches into.
    fn stand(&self, grid: &mut OccupancyGrid, center: Point2) {
        let side_m = grid.frame().resolution_m();
        let origin = grid.frame().origin().position();
        let (col, row) = (
            (center.x - origin.x) / side_m,
            (center.y - origin.y) / side_m,
        );
        let reach = self.radius_m / side_m;
        let first = |at: f64| (at - reach).floor() as u32;
        for row_at in first(row)..=(row + reach) as u32 {
            for col_at in first(col)..=(col + reach) as u32 {
                let away =
                    |at: f64, cell: u32| at - at.clamp(f64::from(cell), f64::from(cell) + 1.0);
                let distance_m = side_m * away(col, col_at).hypot(away(row, row_at));
                if distance_m < self.radius_m - TOUCH_M {
                    grid.set(Cell::new(col_at, row_at), OCCUPIED);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"{
        "radius_m": 0.075, "start": [0, 0, 1.5], "goal": [0, 3, 1.5],
        "worlds": {"12": [[1.0, 1.0]], "3": [[0.075, 0.075], [0.075, 0.225]]}
    }"#;

    fn worlds() -> BarnWorlds {
        BarnWorlds::parse(TEXT).unwrap().unwrap()
    }

    #[test]
    fn a_cylinder_occupies_the_cells_that_it_reaches_into() {
        let grid = worlds().grid(3, 0.05).unwrap();
        let frame = grid.frame();
        assert_eq!((frame.origin().x, frame.origin().y), (-2.0, -2.0));
        let cells = (0..frame.n_rows() as u32)
            .flat_map(|row| (0..frame.n_cols() as u32).map(move |col| Cell::new(col, row)));
        let occupied: Vec<Cell> = cells.filter(|cell| grid.value(*cell) == OCCUPIED).collect();
        // Three by three cells each, stacked; what they touch at a point alone is free.
        assert_eq!(occupied.len(), 18);
        assert!(occupied.iter().all(|cell| (40..43).contains(&cell.col)));
        assert!(occupied.iter().all(|cell| (40..46).contains(&cell.row)));
        assert_eq!(worlds().grid(12, 0.05).unwrap().frame().n_rows(), 140);
    }

    #[test]
    fn worlds_are_in_order_and_a_missing_one_is_told() {
        assert_eq!(worlds().ids().collect::<Vec<_>>(), [3, 12]);
        let error = worlds().grid(4, 0.05).unwrap_err();
        assert!(error.to_string().contains("no world 4"), "{error}");
        assert!(worlds().grid(3, f64::NAN).is_err());
    }

    #[test]
    fn other_files_are_none_and_wrong_ones_are_told() {
        assert_eq!(BarnWorlds::parse(r#"{"version": 1}"#).unwrap(), None);
        let told = |text: &str| format!("{:#}", BarnWorlds::parse(text).unwrap_err());
        assert!(told(&TEXT.replace("0.075,", "-1,")).contains("radius_m: -1"));
        assert!(told(&TEXT.replace("\"12\"", "\"a\"")).contains("worlds of BARN"));
        assert!(told(&TEXT.replace("[1.0, 1.0]", "[1e9, 1.0]")).contains("1000 m"));
        let missing = BarnWorlds::read(Path::new("no-such/barn.json")).unwrap_err();
        assert!(
            missing.to_string().contains("not part of formicar"),
            "{missing}"
        );
    }
}
