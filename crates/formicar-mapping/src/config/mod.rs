//! Parameters of mapping: one set for all logs.

mod front_end;
mod loops;

pub use front_end::FrontEndRule;
pub use loops::{AgreementRule, DriftRule, LoopRule};

use crate::error::MappingError;
use crate::matching::AlignRule;
use crate::motion::OdometryNoise;
use crate::occupancy::OccupancyRule;
use crate::scan::RangePolicy;
use crate::sdf::{InsertionRule, Sweep};
use formicar::Point2;
use serde::{Deserialize, Serialize};

/// Parameters of a map's construction. The defaults serve any 2-D log, indoors first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MappingConfig {
    /// The ranges that are hits.
    pub ranges: RangePolicy,
    /// Side of a cell, meters, 0.01 to 1.
    pub resolution_m: f64,
    /// Signed distances are cut off here, in cells, 2 to 10. Beyond 4, the two sides of a thin wall
    /// disturb each other.
    pub truncation_cells: f64,
    /// Insertion of scans.
    pub insertion: InsertionRule,
    /// Hits closer to the one before are left out of matching, meters.
    pub hit_spacing_m: f64,
    /// Alignment of scans.
    pub align: AlignRule,
    /// Noise of odometry, before it is scaled to what the log shows.
    pub odometry: OdometryNoise,
    /// Matching scan after scan.
    pub front_end: FrontEndRule,
    /// Closing loops.
    pub loops: LoopRule,
    /// Rounds of refinement against one map of all scans.
    pub n_refinements: usize,
    /// The map for planning.
    pub occupancy: OccupancyRule,
}

impl Default for MappingConfig {
    fn default() -> Self {
        Self {
            ranges: RangePolicy::default(),
            resolution_m: 0.05,
            truncation_cells: 3.0,
            insertion: InsertionRule::default(),
            hit_spacing_m: 0.04,
            align: AlignRule::default(),
            odometry: OdometryNoise::default(),
            front_end: FrontEndRule::default(),
            loops: LoopRule::default(),
            n_refinements: 3,
            occupancy: OccupancyRule::default(),
        }
    }
}

impl MappingConfig {
    /// The map update of Fossel, Tuyls & Sturm (2015) in the place of ours, all else equal.
    pub fn fossel2015() -> Self {
        Self {
            truncation_cells: 5.0,
            insertion: InsertionRule::Fossel2015(crate::sdf::FosselRule::default()),
            ..Self::default()
        }
    }

    /// The truncation, meters.
    pub fn truncation_m(&self) -> f64 {
        self.truncation_cells * self.resolution_m
    }

    /// The hits of a scan that take part in matching, in the frame of the sensor.
    pub fn hits(&self, sweep: &Sweep) -> Vec<Point2> {
        sweep.thinned(self.hit_spacing_m, self.insertion.reach_m())
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), MappingError> {
        self.ranges.check()?;
        for (key, value, low, high) in self.map_numbers().into_iter().chain(self.search_numbers()) {
            in_range(key, value, low, high)?;
        }
        let windows = [
            ("front_end.window", &self.front_end.window),
            ("front_end.wide_window", &self.front_end.wide_window),
        ];
        for (name, window) in windows {
            in_range(&format!("{name}.reach_m"), window.reach_m, 0.0, 10.0)?;
            in_range(&format!("{name}.turn_rad"), window.turn_rad, 0.0, 3.2)?;
            in_range(
                &format!("{name}.turn_step_rad"),
                window.turn_step_rad,
                1e-3,
                1.0,
            )?;
        }
        Ok(())
    }

    /// Numbers of maps and matching, with their ranges.
    fn map_numbers(&self) -> Vec<Bounded> {
        let (align, odometry) = (&self.align, &self.odometry);
        let occupancy = &self.occupancy;
        vec![
            ("resolution_m", self.resolution_m, 0.01, 1.0),
            ("truncation_cells", self.truncation_cells, 2.0, 10.0),
            ("hit_spacing_m", self.hit_spacing_m, 0.0, 10.0),
            ("insertion.reach_m", self.insertion.reach_m(), 0.5, 200.0),
            ("align.tolerance", align.tolerance, 1e-12, 0.1),
            ("align.hit_variance_m2", align.hit_variance_m2, 1e-8, 10.0),
            ("align.prior_scale", align.prior_scale, 0.1, 1e6),
            (
                "align.max_iterations",
                align.max_iterations as f64,
                1.0,
                1000.0,
            ),
            ("odometry.base_m", odometry.base_m, 1e-6, 10.0),
            ("odometry.per_m", odometry.per_m, 0.0, 10.0),
            ("odometry.base_rad", odometry.base_rad, 1e-6, 3.0),
            ("odometry.per_rad", odometry.per_rad, 0.0, 10.0),
            ("odometry.turn_per_m", odometry.turn_per_m, 0.0, 3.0),
            ("occupancy.reach_m", occupancy.reach_m, 0.1, 200.0),
            ("occupancy.min_hit_share", occupancy.min_hit_share, 0.0, 1.0),
            ("occupancy.margin_m", occupancy.margin_m, 0.0, 100.0),
        ]
    }

    /// Numbers of the front end and of loops, with their ranges.
    fn search_numbers(&self) -> Vec<Bounded> {
        let (front, loops) = (&self.front_end, &self.loops);
        let widest_m = loops.reaches_m.iter().copied().fold(0.0, f64::max);
        let turn_step = loops.turn_step_rad;
        vec![
            ("front_end.key_distance_m", front.key_distance_m, 0.0, 100.0),
            ("front_end.key_turn_rad", front.key_turn_rad, 0.0, 7.0),
            (
                "front_end.n_submap_scans",
                front.n_submap_scans as f64,
                2.0,
                1000.0,
            ),
            ("front_end.far_reach_m", front.far_reach_m, 0.1, 20.0),
            ("front_end.far_turn_rad", front.far_turn_rad, 0.01, 3.2),
            ("front_end.min_score", front.min_score, 0.0, 1.0),
            ("front_end.min_seen_share", front.min_seen_share, 0.0, 1.0),
            ("front_end.min_hits", front.min_hits as f64, 1.0, 1e5),
            ("loops.min_score", loops.min_score, 0.0, 1.0),
            ("loops.min_seen_share", loops.min_seen_share, 0.0, 1.0),
            (
                "loops.n_joined_scans",
                loops.n_joined_scans as f64,
                1.0,
                100.0,
            ),
            ("loops.reaches_m", widest_m, 0.0, 50.0),
            ("loops.turn_step_rad", turn_step, 1e-3, 1.0),
            ("loops.drift.max_rad", loops.drift.max_rad, 0.0, 3.2),
            ("loops.dense_reach_m", loops.dense_reach_m, 0.0, 5.0),
            ("loops.dense_turn_rad", loops.dense_turn_rad, 0.0, 1.0),
            ("loops.sigma_m", loops.sigma_m, 1e-4, 10.0),
            ("loops.sigma_rad", loops.sigma_rad, 1e-5, 3.0),
            ("n_refinements", self.n_refinements as f64, 0.0, 100.0),
        ]
    }
}

/// Name, value, least and greatest.
type Bounded = (&'static str, f64, f64, f64);

fn in_range(key: &str, value: f64, low: f64, high: f64) -> Result<(), MappingError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(MappingError::Parameter {
        key: key.to_owned(),
        value,
        range: format!("{low} to {high}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_valid_and_bad_numbers_are_named() {
        MappingConfig::default().check().unwrap();
        MappingConfig::fossel2015().check().unwrap();
        let bad = MappingConfig {
            resolution_m: f64::NAN,
            ..MappingConfig::default()
        };
        let message = bad.check().unwrap_err().to_string();
        assert_eq!(message, "resolution_m = NaN; it must be 0.01 to 1");
    }
}
