//! One run of one method, from the map to the judge.

use super::methods::Native;
use super::native;
use super::turns::Turns;
use crate::papers::drawn_run::DrawnRun;
use crate::papers::experiment::{Ground, Variant};
use crate::run::measure;
use anyhow::Result;
use formicar::geometry::Point2;
use formicar::metrics::SteeringShare;
use formicar::numeric::Seed;
use formicar::objective::{SteeredLine, SteeringCost};
use formicar::planner::Outcome;
use formicar::scenario::StartHeading;
use formicar::vehicle::SuspensionParameters;
use serde::Serialize;

/// Spacing of the coarser measure of turns, meters; the finer is the size of a cell.
const COARSE_M: f64 = 1.0;

/// A method on a ground, ready to run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Job<'a> {
    /// The part of the experiment.
    pub(super) part: &'static str,
    pub(super) ground: &'a Ground,
    pub(super) variant: &'a Variant,
    pub(super) native: Native,
    /// Length of the shortest way over cells.
    pub(super) shortest_m: Option<f64>,
}

/// A row of `results.csv`. `native` is the path before it was made drivable, `fine` and `coarse`
/// the certified curve over steps of one cell (0.2 m) and of 1 m.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(super) struct Drive {
    pub(super) part: String,
    pub(super) method: String,
    pub(super) ground: String,
    pub(super) seed: u64,
    pub(super) status: String,
    pub(super) certified: bool,
    pub(super) shortest_m: Option<f64>,
    pub(super) native_length_m: Option<f64>,
    pub(super) certified_length_m: Option<f64>,
    /// Map set-up and query.
    pub(super) total_ms: f64,
    pub(super) map_setup_ms: f64,
    pub(super) query_ms: f64,
    /// From the beginning of the map set-up to the first certified path.
    pub(super) first_feasible_ms: Option<f64>,
    pub(super) n_curvature_jumps: Option<usize>,
    pub(super) n_cusps: Option<usize>,
    /// Largest change of heading over a step of 1 m of the certified curve.
    pub(super) largest_step_deg: Option<f64>,
    pub(super) min_clearance_m: Option<f64>,
    pub(super) n_native_vertices: Option<usize>,
    pub(super) native_to_5_deg: Option<f64>,
    pub(super) native_from_5_to_10_deg: Option<f64>,
    pub(super) native_over_10_deg: Option<f64>,
    pub(super) n_pruned_vertices: Option<usize>,
    pub(super) pruned_to_5_deg: Option<f64>,
    pub(super) pruned_from_5_to_10_deg: Option<f64>,
    pub(super) pruned_over_10_deg: Option<f64>,
    pub(super) fine_to_5_deg: Option<f64>,
    pub(super) fine_from_5_to_10_deg: Option<f64>,
    pub(super) fine_over_10_deg: Option<f64>,
    pub(super) coarse_to_5_deg: Option<f64>,
    pub(super) coarse_from_5_to_10_deg: Option<f64>,
    pub(super) coarse_over_10_deg: Option<f64>,
    /// J of the native path.
    pub(super) cost: Option<f64>,
    /// Largest steering that a native step needs, over the steering it can have.
    pub(super) largest_steering_ratio: Option<f64>,
}

/// A run that is drawn, with its path before it was made drivable.
pub(super) struct Drawn {
    pub(super) run: DrawnRun,
    pub(super) native: Vec<Point2>,
}

impl Job<'_> {
    /// Runs with a seed: map set-up, query and judge.
    pub(super) fn run(&self, seed: u64) -> Result<(Drive, Outcome)> {
        let ground = self.ground;
        let setup = measure(&mut (), |_| ground.planner(&self.variant.config));
        let mut planner = setup.answer?;
        let query = measure(&mut (), |observer| {
            planner.plan(&ground.request, Seed(seed), observer)
        });
        let first_s = query.first_feasible_s();
        let outcome = query.answer?;
        let mut drive = Drive {
            part: self.part.to_owned(),
            method: self.variant.name.clone(),
            ground: ground.map.clone(),
            seed,
            status: outcome.status().name().to_owned(),
            certified: matches!(outcome, Outcome::Found(_)),
            shortest_m: self.shortest_m,
            total_ms: 1e3 * (setup.query_s + query.query_s),
            map_setup_ms: 1e3 * setup.query_s,
            query_ms: 1e3 * query.query_s,
            first_feasible_ms: first_s.map(|first_s| 1e3 * (setup.query_s + first_s)),
            ..Drive::default()
        };
        self.measure_native(&mut drive, &self.native(&outcome))?;
        let pruned = native::nodes(ground, outcome.stages());
        drive.n_pruned_vertices = (!pruned.is_empty()).then_some(pruned.len());
        [
            drive.pruned_to_5_deg,
            drive.pruned_from_5_to_10_deg,
            drive.pruned_over_10_deg,
        ] = shares(Turns::of_polyline(&pruned));
        measure_curve(&mut drive, &outcome);
        Ok((drive, outcome))
    }

    fn native(&self, outcome: &Outcome) -> Vec<Point2> {
        native::polyline(self.native, self.ground, outcome)
    }

    /// A run to be drawn.
    pub(super) fn drawn(&self, outcome: Outcome) -> Drawn {
        Drawn {
            native: self.native(&outcome),
            run: DrawnRun {
                variant: self.variant.name.clone(),
                outcome,
            },
        }
    }

    fn measure_native(&self, drive: &mut Drive, points: &[Point2]) -> Result<()> {
        if points.len() < 2 {
            return Ok(());
        }
        drive.n_native_vertices = Some(points.len());
        drive.native_length_m = Some(points.windows(2).map(|w| w[0].distance(w[1])).sum());
        [
            drive.native_to_5_deg,
            drive.native_from_5_to_10_deg,
            drive.native_over_10_deg,
        ] = shares(Turns::of_polyline(points));
        let Some(cost) = self.cost(points)? else {
            return Ok(());
        };
        drive.cost = Some(cost[0]);
        drive.largest_steering_ratio = Some(cost[1]);
        Ok(())
    }

    /// J of a polyline, and the largest steering that it needs.
    pub(super) fn cost(&self, points: &[Point2]) -> Result<Option<[f64; 2]>> {
        let (vehicle, request) = (&self.ground.vehicle, &self.ground.request);
        let (Some(reference_m), Some(wheelbase_m)) = (self.shortest_m, vehicle.wheelbase_m())
        else {
            return Ok(None);
        };
        let max_steer_rad = vehicle.steer_rad(vehicle.max_curvature_per_m());
        let is_exact = request.start_heading == StartHeading::Exact;
        let cost = SteeringCost::default().of(&SteeredLine {
            points,
            start_heading_rad: is_exact.then_some(request.start.heading),
            steering: [wheelbase_m, max_steer_rad.unwrap_or_default()],
            suspension: &SuspensionParameters::default(),
            reference_m,
        })?;
        Ok(Some([cost.cost, cost.max_steering_ratio]))
    }
}

fn measure_curve(drive: &mut Drive, outcome: &Outcome) {
    let Outcome::Found(plan) = outcome else {
        return;
    };
    let (path, metrics) = (&plan.path, &plan.metrics);
    drive.certified_length_m = Some(metrics.length_m);
    drive.n_curvature_jumps = Some(metrics.n_curvature_jumps);
    drive.n_cusps = Some(metrics.n_cusps);
    drive.min_clearance_m = Some(plan.certificate.min_clearance_m);
    let (fine, coarse) = (
        Turns::of_curve(path, SteeringShare::DEFAULT_SPACING_M),
        Turns::of_curve(path, COARSE_M),
    );
    drive.largest_step_deg = coarse.map(|turns| turns.largest_deg);
    [
        drive.fine_to_5_deg,
        drive.fine_from_5_to_10_deg,
        drive.fine_over_10_deg,
    ] = shares(fine);
    [
        drive.coarse_to_5_deg,
        drive.coarse_from_5_to_10_deg,
        drive.coarse_over_10_deg,
    ] = shares(coarse);
}

fn shares(turns: Option<Turns>) -> [Option<f64>; 3] {
    turns.map_or([None; 3], |turns| turns.shares.map(Some))
}
