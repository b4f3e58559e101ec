//! Short motions that lead from one heading of an absolute lattice to another.
//!
//! The lattice holds n headings, 2 pi / n apart, from 0. Every motion turns by a whole number of
//! lattice steps, so that a search over such motions never leaves the lattice and keeps headings
//! as whole numbers.

use super::{Gears, Motion, Vehicle, VehicleError};
use crate::geometry::{Arc, Point2, Pose2};
use crate::parameters::{OutOfRange, Range};
use std::f64::consts::{PI, TAU};

/// A line or arc that turns by whole lattice steps, the same from every heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Primitive {
    /// Curvature, positive where the wheels point left; 0 on a line.
    pub curvature_per_m: f64,
    /// Driven length in meters, above 0.
    pub length_m: f64,
    /// +1 forward, -1 in reverse.
    pub gear_sign: i8,
    /// Lattice steps turned, positive to the left.
    pub heading_change: i16,
}

impl Primitive {
    /// The motion as an arc of signed length.
    pub fn arc(&self) -> Arc {
        let signed_length_m = f64::from(self.gear_sign) * self.length_m;
        Arc::new(self.curvature_per_m, signed_length_m)
    }
}

/// An arc from a heading between two lattice headings onto one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// The arc; of length 0 where the heading is on the lattice.
    pub arc: Arc,
    /// The lattice heading at its end.
    pub heading_index: usize,
}

/// The motions of a vehicle on a lattice of headings, with their displacements.
///
/// ```
/// use formicar::vehicle::PrimitiveSet;
/// use formicar::{Gears, Vehicle};
///
/// let set = PrimitiveSet::new(&Vehicle::sedan(), 72, 0.5, Gears::Both)?;
/// assert_eq!(set.primitives().len(), 10);
/// assert_eq!(set.heading_after(0, &set.primitives()[0]), 0);
/// # Ok::<(), formicar::VehicleError>(())
/// ```
#[derive(Clone, Debug)]
pub struct PrimitiveSet {
    n_headings: usize,
    min_step_m: f64,
    max_curvature_per_m: f64,
    gears: Gears,
    primitives: Vec<Primitive>,
    /// Per heading, per primitive.
    displacements: Vec<Point2>,
    /// Per heading.
    units: Vec<Point2>,
}

impl PrimitiveSet {
    /// The lattice used unless there is a reason for another: 5 degrees apart.
    pub const DEFAULT_N_HEADINGS: usize = 72;

    /// Curvatures as shares of the largest: straight first, then by how hard they turn.
    const CURVATURE_SHARES: [f64; 5] = [0.0, 0.5, -0.5, 1.0, -1.0];

    /// Closer to a lattice heading than this, in lattice steps, is on it.
    const ON_LATTICE: f64 = 1e-9;

    /// A line and arcs at half and whole steering, per gear, each at least `min_step_m` long.
    ///
    /// Arcs at the limit have exactly the largest curvature and the fewest lattice steps that
    /// make them long enough; half arcs turn by the nearest whole number of steps, with the
    /// curvature lowered where that takes it.
    ///
    /// # Errors
    /// A vehicle that turns on the spot, fewer than 8 or more than 3600 headings, or a step that
    /// is not above 0 or longer than half the tightest circle.
    pub fn new(
        vehicle: &Vehicle,
        n_headings: usize,
        min_step_m: f64,
        gears: Gears,
    ) -> Result<Self, VehicleError> {
        let max_curvature_per_m = vehicle.max_curvature_per_m();
        if vehicle.motion() != Motion::Car {
            let (name, value) = ("max_curvature_per_m", max_curvature_per_m);
            return Err(VehicleError::TurnsOnTheSpot { name, value });
        }
        Range::of::<usize>(8..=3600).check("n_headings", &n_headings)?;
        if !(min_step_m > 0.0 && min_step_m * max_curvature_per_m <= PI) {
            return Err(VehicleError::OutOfRange(OutOfRange {
                key: "min_step_m".to_owned(),
                value: min_step_m,
                range: "above 0 and at most half the tightest circle".to_owned(),
            }));
        }
        let set = Self {
            n_headings,
            min_step_m,
            max_curvature_per_m,
            gears,
            primitives: Vec::new(),
            displacements: Vec::new(),
            units: Vec::new(),
        };
        Ok(set.filled())
    }

    fn filled(mut self) -> Self {
        for &gear_sign in self.gears.signs() {
            let of_gear = Self::CURVATURE_SHARES.map(|share| self.primitive(share, gear_sign));
            self.primitives.extend(of_gear);
        }
        self.displacements = (0..self.n_headings)
            .flat_map(|index| {
                let start = Pose2::new(0.0, 0.0, self.heading_rad(index));
                let end = move |p: &Primitive| p.arc().end_from(start).position();
                self.primitives.iter().map(end)
            })
            .collect();
        let headings = (0..self.n_headings).map(|index| self.heading_rad(index));
        self.units = headings.map(Point2::unit).collect();
        self
    }

    fn primitive(&self, curvature_share: f64, gear_sign: i8) -> Primitive {
        let target = curvature_share.abs() * self.max_curvature_per_m;
        let wanted_steps = self.min_step_m * target / self.step_rad();
        let n_steps = if curvature_share == 0.0 {
            0.0
        } else if curvature_share.abs() == 1.0 {
            // Rounding must not cost a whole step more.
            (wanted_steps - Self::ON_LATTICE).ceil().max(1.0)
        } else {
            wanted_steps.round().max(1.0)
        };
        let turn = n_steps * self.step_rad();
        let long_enough = |length: f64| length >= self.min_step_m * (1.0 - Self::ON_LATTICE);
        let (curvature, length_m) = match turn / target {
            at_target if long_enough(at_target) => (target, at_target),
            _ => (turn / self.min_step_m, self.min_step_m),
        };
        Primitive {
            curvature_per_m: curvature.copysign(curvature_share) + 0.0,
            length_m,
            gear_sign,
            heading_change: (n_steps * curvature_share.signum()) as i16 * i16::from(gear_sign),
        }
    }

    /// The motions, the same from every heading: forward ones first, straight ones first.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// Number of lattice headings.
    pub fn n_headings(&self) -> usize {
        self.n_headings
    }

    /// The gears that motions may use.
    pub fn gears(&self) -> Gears {
        self.gears
    }

    /// Angle between neighboring lattice headings, radians.
    pub fn step_rad(&self) -> f64 {
        TAU / self.n_headings as f64
    }

    /// A lattice heading in `[0, 2 pi)`, radians.
    pub fn heading_rad(&self, heading_index: usize) -> f64 {
        heading_index as f64 * self.step_rad()
    }

    /// A lattice heading as a unit vector.
    pub fn unit(&self, heading_index: usize) -> Point2 {
        self.units[heading_index]
    }

    /// The lattice heading nearest to a finite heading.
    pub fn nearest_index(&self, heading_rad: f64) -> usize {
        let steps = (heading_rad / self.step_rad()).round();
        steps.rem_euclid(self.n_headings as f64) as usize % self.n_headings
    }

    /// The displacement of each motion from a lattice heading, meters along the axes of the map, in
    /// the order of [`Self::primitives`].
    pub fn displacements(&self, heading_index: usize) -> &[Point2] {
        let n = self.primitives.len();
        &self.displacements[heading_index * n..][..n]
    }

    /// The lattice heading after a motion.
    pub fn heading_after(&self, heading_index: usize, primitive: &Primitive) -> usize {
        let n = self.n_headings as isize;
        let turned = heading_index as isize + isize::from(primitive.heading_change);
        turned.rem_euclid(n) as usize
    }

    /// Arcs from any finite heading onto lattice headings, at least as long as a step: per gear
    /// onto the headings on both sides, and at half and whole steering onto the first heading far
    /// enough; where the heading is on the lattice, one arc of length 0.
    pub fn alignment_arcs(&self, heading_rad: f64) -> Vec<Alignment> {
        let steps = heading_rad / self.step_rad();
        if (steps - steps.round()).abs() < Self::ON_LATTICE {
            let (arc, heading_index) = (Arc::default(), self.nearest_index(heading_rad));
            return vec![Alignment { arc, heading_index }];
        }
        let onto = |lattice_steps: f64, arc| Alignment {
            arc,
            heading_index: lattice_steps.rem_euclid(self.n_headings as f64) as usize
                % self.n_headings,
        };
        let of_gear = |&gear_sign: &i8| {
            let beside = [steps.floor(), steps.ceil()].map(|lattice| {
                onto(
                    lattice,
                    self.turning_arc((lattice - steps) * self.step_rad(), gear_sign),
                )
            });
            let steered = Self::CURVATURE_SHARES[1..].iter().map(move |&share| {
                let curvature = share * self.max_curvature_per_m;
                let turned = f64::from(gear_sign) * curvature * self.min_step_m / self.step_rad();
                let lattice = if turned > 0.0 {
                    (steps + turned).ceil()
                } else {
                    (steps + turned).floor()
                };
                let length_m = ((lattice - steps) * self.step_rad() / curvature).abs();
                onto(
                    lattice,
                    Arc::new(curvature, f64::from(gear_sign) * length_m),
                )
            });
            beside.into_iter().chain(steered).collect::<Vec<_>>()
        };
        self.gears.signs().iter().flat_map(of_gear).collect()
    }

    fn turning_arc(&self, turn_rad: f64, gear_sign: i8) -> Arc {
        let at_limit = turn_rad.abs() / self.max_curvature_per_m;
        let signed_length_m = f64::from(gear_sign) * at_limit.max(self.min_step_m);
        if at_limit >= self.min_step_m {
            let side = turn_rad.signum() * f64::from(gear_sign);
            return Arc::new(side * self.max_curvature_per_m, signed_length_m);
        }
        Arc::new(turn_rad / signed_length_m, signed_length_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::angle_difference;

    fn sets() -> Vec<(Vehicle, PrimitiveSet)> {
        let vehicles = [
            Vehicle::sedan(),
            Vehicle::warehouse_amr(),
            Vehicle::f1tenth(),
        ];
        let set = |v: &Vehicle, n, step| PrimitiveSet::new(v, n, step, Gears::Both).unwrap();
        let mut sets = Vec::new();
        for vehicle in vehicles {
            for (n, step) in [(72, 0.1), (72, 0.6), (16, 0.3), (360, 1.1)] {
                sets.push((vehicle.clone(), set(&vehicle, n, step)));
            }
        }
        sets
    }

    #[test]
    fn every_motion_lands_on_the_lattice_within_the_limits() {
        for (vehicle, set) in sets() {
            for heading in 0..set.n_headings() {
                for (p, d) in set.primitives().iter().zip(set.displacements(heading)) {
                    let start = Pose2::new(0.0, 0.0, set.heading_rad(heading));
                    let end = p.arc().end_from(start);
                    let after = set.heading_rad(set.heading_after(heading, p));
                    assert!(angle_difference(end.heading, after).abs() < 1e-12, "{p:?}");
                    assert!(end.position().distance(*d) < 1e-12);
                    assert!(p.curvature_per_m.abs() <= vehicle.max_curvature_per_m());
                    assert!(p.length_m >= set.min_step_m * (1.0 - 1e-8), "{p:?}");
                }
            }
        }
    }

    #[test]
    fn the_tightest_arcs_take_the_fewest_steps() {
        for (vehicle, set) in sets() {
            let limit = vehicle.max_curvature_per_m();
            let tightest = |p: &&Primitive| p.curvature_per_m.abs() == limit;
            assert_eq!(set.primitives().iter().filter(tightest).count(), 4);
            for p in set.primitives().iter().filter(tightest) {
                let one_less = p.length_m - set.step_rad() / limit;
                assert!(p.heading_change.abs() == 1 || one_less < set.min_step_m);
            }
        }
    }

    #[test]
    fn forward_only_has_half_the_motions() {
        let car = Vehicle::sedan();
        let set = PrimitiveSet::new(&car, 72, 0.5, Gears::Forward).unwrap();
        assert_eq!(set.primitives().len(), 5);
        assert!(set.primitives().iter().all(|p| p.gear_sign == 1));
        assert!(
            set.alignment_arcs(0.01)
                .iter()
                .all(|a| a.arc.signed_length_m > 0.0)
        );
    }

    #[test]
    fn alignment_reaches_both_neighbours_and_steers_away() {
        for (vehicle, set) in sets() {
            let limit = vehicle.max_curvature_per_m();
            for heading in [-9.0, -0.01, 0.02, 1.0, 3.13, 6.27, 100.0] {
                let arcs = set.alignment_arcs(heading);
                assert_eq!(arcs.len(), 12);
                let mut n_beside = 0;
                for Alignment { arc, heading_index } in arcs {
                    let end = arc.end_from(Pose2::new(0.0, 0.0, heading)).heading;
                    let off = angle_difference(end, set.heading_rad(heading_index));
                    assert!(off.abs() < 1e-12, "{heading} {arc:?}: {off}");
                    assert!(arc.curvature_per_m.abs() <= limit);
                    assert!(arc.length_m() >= set.min_step_m * (1.0 - 1e-12));
                    n_beside += usize::from((heading - end).abs() <= set.step_rad());
                }
                assert!(n_beside >= 4);
                let hardest = |side: f64| {
                    set.alignment_arcs(heading)
                        .iter()
                        .any(|a| a.arc.curvature_per_m == side * limit)
                };
                assert!(hardest(1.0) && hardest(-1.0));
            }
            let on_lattice = set.alignment_arcs(set.heading_rad(3) - TAU);
            assert_eq!(on_lattice.len(), 1);
            assert_eq!(on_lattice[0].heading_index, 3);
        }
    }

    #[test]
    fn refuses_what_has_no_lattice() {
        let car = Vehicle::sedan();
        let new = |v: &Vehicle, n, step| PrimitiveSet::new(v, n, step, Gears::Both);
        assert!(new(&Vehicle::point(), 72, 0.1).is_err());
        assert!(new(&car, 7, 0.1).is_err());
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 40.0] {
            assert!(new(&car, 72, step).is_err(), "{step}");
        }
    }
}
