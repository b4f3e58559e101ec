//! Pheromone of good paths, in coarse bins of position, heading and gear.

use crate::geometry::{Arc, Pose2};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Number of headings that bins distinguish.
const N_HEADINGS: f64 = 24.0;

/// Pheromone by bin. A bin takes memory when pheromone is first deposited in it.
#[derive(Clone, Debug)]
pub(super) struct Trails {
    bin_m: f64,
    pheromone: HashMap<(i32, i32, i8), f32>,
}

impl Trails {
    /// Trails in bins of a size.
    pub(super) fn new(bin_m: f64) -> Self {
        Self {
            bin_m,
            pheromone: HashMap::new(),
        }
    }

    /// Pheromone where a motion ends.
    pub(super) fn at(&self, pose: Pose2, arc: Arc) -> f64 {
        if self.pheromone.is_empty() {
            return 0.0;
        }
        let bin = self.pheromone.get(&self.bin(pose, arc));
        bin.map_or(0.0, |&tau| f64::from(tau))
    }

    /// Evaporates a share `rho` of all pheromone, and deposits some along a path; no bin holds more
    /// than 1.
    pub(super) fn renew(&mut self, rho: f64, deposit: f64, start: Pose2, arcs: &[Arc]) {
        for tau in self.pheromone.values_mut() {
            *tau *= (1.0 - rho) as f32;
        }
        let mut pose = start;
        let mut last = None;
        for &arc in arcs {
            let n_pieces = (2.0 * arc.length_m() / self.bin_m).ceil().max(1.0) as usize;
            for i in 1..=n_pieces {
                let driven = arc.signed_length_m * i as f64 / n_pieces as f64;
                let bin = self.bin(pose.advance(arc.curvature_per_m, driven), arc);
                if last != Some(bin) {
                    let tau = self.pheromone.entry(bin).or_insert(0.0);
                    *tau = (*tau + deposit as f32).min(1.0);
                    last = Some(bin);
                }
            }
            pose = arc.end_from(pose);
        }
    }

    fn bin(&self, pose: Pose2, arc: Arc) -> (i32, i32, i8) {
        let cell = |v: f64| (v / self.bin_m).floor() as i32;
        let turns = (pose.heading / TAU).rem_euclid(1.0);
        let heading = (turns * N_HEADINGS) as i8 % N_HEADINGS as i8;
        let gear = if arc.signed_length_m < 0.0 { -1 } else { 1 };
        (cell(pose.x), cell(pose.y), gear * (heading + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trail_is_told_by_place_heading_and_gear() {
        let mut trails = Trails::new(0.8);
        let (start, ahead) = (Pose2::default(), Arc::new(0.0, 8.0));
        trails.renew(0.1, 0.5, start, &[ahead]);
        let on = Pose2::new(4.1, 0.1, 0.01);
        assert_eq!(trails.at(on, ahead), 0.5);
        assert_eq!(trails.at(on, Arc::new(0.0, -1.0)), 0.0);
        assert_eq!(trails.at(Pose2::new(4.1, 0.1, 1.6), ahead), 0.0);
        assert_eq!(trails.at(Pose2::new(4.1, 2.1, 0.01), ahead), 0.0);
        for _ in 0..9 {
            trails.renew(0.1, 0.5, start, &[ahead]);
        }
        assert_eq!(trails.at(on, ahead), 1.0);
        trails.renew(0.5, 0.0, start, &[]);
        assert_eq!(trails.at(on, ahead), 0.5);
    }
}
