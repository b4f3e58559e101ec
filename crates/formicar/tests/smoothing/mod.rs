//! Smoothed grid paths before the judge, 2-turning against brute force, and the reasons where
//! nothing fits.

mod brute_force;
mod certified;
mod headings;
mod reasons;
mod splines;
mod wide_arcs;

use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::{BitGrid, Cell, DiagonalRule, GridFrame, MoveMasks, OccupancyGrid, ring};
use formicar::progress::Limits;
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::search::{AstarWorkspace, astar};
use formicar::smoothing::{
    RedundantNodes, Smoothed, SmoothingConfig, SmoothingError, SmoothingProblem, smooth,
};
use formicar::validation::judge;
use formicar::vehicle::{Gears, Vehicle};

const RULE: DiagonalRule = DiagonalRule::NoObstacles;

/// A vehicle on a map whose obstacles are grown by half its width and a little more.
struct Place {
    obstacles: ObstacleMap,
    vehicle: Vehicle,
    blocked: BitGrid,
}

impl Place {
    fn new(map: &OccupancyGrid, vehicle: Vehicle) -> Self {
        let obstacles = ObstacleMap::new(map);
        let (low, high) = vehicle.footprint().bounds();
        let half_m = 0.5 * (high.y - low.y) + 0.1 * vehicle.min_turning_radius_m().max(0.0);
        let grown = half_m / obstacles.frame().resolution_m();
        let blocked = obstacles.distance().within(grown).unwrap();
        Self {
            obstacles,
            vehicle,
            blocked,
        }
    }

    fn ground(&self) -> SmoothingProblem<'_> {
        SmoothingProblem {
            obstacles: &self.obstacles,
            vehicle: &self.vehicle,
            blocked: &self.blocked,
            rule: RULE,
        }
    }

    /// The cell under a pose, or the nearest that is not blocked.
    fn cell(&self, pose: Pose2) -> Option<Cell> {
        let cell = self.obstacles.frame().cell_at(pose.position())?;
        let size = (self.blocked.n_cols(), self.blocked.n_rows());
        let is_free = |c: &Cell| !self.blocked.get(c.col as usize, c.row as usize);
        (0..12).find_map(|radius| ring(cell, radius, size.0, size.1).find(is_free))
    }

    /// The nodes of a shortest grid path that are not redundant.
    fn nodes(&self, request: &Request) -> Option<Vec<Cell>> {
        let (start, goal) = (self.cell(request.start)?, self.cell(request.goal)?);
        let moves = MoveMasks::new(&self.blocked, RULE);
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        let found = astar(&moves, start, goal, &mut AstarWorkspace::new(), &mut limits).ok()?;
        Some(RedundantNodes::Remove.apply(&self.blocked, RULE, &found.path))
    }

    /// A smoothed path, which the judge must certify.
    fn certified(
        &self,
        config: &SmoothingConfig,
        request: &Request,
    ) -> Option<Result<Smoothed, SmoothingError>> {
        let nodes = self.nodes(request)?;
        let smoothed = smooth(&self.ground(), config, request, &nodes);
        if let Ok(smoothed) = &smoothed {
            let report = judge(&self.obstacles, &self.vehicle, request, &smoothed.path);
            assert!(report.valid, "{request:?}: {:?}", report.violations);
            let again = smooth(&self.ground(), config, request, &nodes);
            assert_eq!(again.as_ref(), Ok(smoothed));
        }
        Some(smoothed)
    }
}

fn either() -> [SmoothingConfig; 2] {
    [SmoothingConfig::lei2020(), SmoothingConfig::default()]
}

/// A map of free cells of 0.5 m.
fn open(n_cols: usize, n_rows: usize) -> OccupancyGrid {
    OccupancyGrid::free(GridFrame::new(n_cols, n_rows, 0.5, Pose2::default()).unwrap())
}

/// A request between the centers of two cells with free headings, forward.
fn free_request(place: &Place, start: Cell, goal: Cell) -> Request {
    let at = |cell| Pose2::at(place.obstacles.frame().center(cell), 0.0);
    Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        gears: Gears::Forward,
        ..Request::new(at(start), at(goal))
    }
}
