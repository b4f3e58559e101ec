//! Parameters of smoothing.

use super::redundant_nodes::RedundantNodes;
use crate::objective::{DriveCost, VehicleCost};
use crate::parameters::{Parameters, parameters};

/// The way in which corners of a polyline are made drivable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Corners {
    /// By 2-turning alone (Lei 2020, sec. III.B).
    TwoTurning,
    /// By the fewest and widest arcs that the body has room for, from some node of the path to a
    /// later one, driven forward; where there are none, as `two-turning-or-dubins`. Not in a paper.
    WideArcs,
    /// By 2-turning, and where no member of it fits, by a Dubins curve (Reeds-Shepp where reverse
    /// is allowed) between poses on earlier and later segments. Not in the paper.
    #[default]
    TwoTurningOrDubins,
    /// Not one by one, but by a B-spline of third order with the nodes as control points (Li 2024,
    /// ACOF): smooth, and not checked against obstacles or the steering limit.
    BSpline,
}

impl Parameters for Corners {}

parameters! {
    /// Parameters of smoothing; costs are in meters of forward driving.
    pub struct SmoothingConfig {
        /// The nodes of the grid path that stay before its corners are rounded.
        pub redundant_nodes: RedundantNodes = RedundantNodes::Remove,
        /// The way in which corners are made drivable.
        pub corners: Corners = Corners::TwoTurningOrDubins,
        /// Members of 2-turning tried per corner and order, besides the one nearest to the
        /// polyline.
        #[range(1..=256)]
        pub n_members: u32 = 12,
        /// Distance of poses on the polyline at which curves may begin and end, in turning radii.
        #[range(0.05..=10.0)]
        pub station_radii: f64 = 0.5,
        /// The most of the polyline that one curve replaces, in turning radii.
        #[range(0.0..=100.0)]
        pub reach_radii: f64 = 8.0,
        /// Cost of each corner that a curve passes instead of 2-turning, in turning radii.
        #[range(0.0..=1000.0)]
        pub passed_corner_radii: f64 = 4.0,
        /// Cost of a corner that is rounded by a wide arc, in turning radii.
        #[range(0.0..=1000.0)]
        pub corner_radii: f64 = 0.3,
        /// Cost of a wide arc for each radian, in turning radii at the least radius and inversely
        /// to the radius.
        #[range(0.0..=1000.0)]
        pub bend_weight: f64 = 3.0,
        /// The margin that ways by wide arcs keep where they can, meters.
        #[range(0.0..=100.0)]
        pub arc_margin_m: f64 = 0.1,
        /// Factor on the length driven in reverse.
        #[range(1.0..=100.0)]
        pub reverse_penalty: f64 = 2.0,
        /// Cost of a change of gear, meters.
        #[range(0.0..=1000.0)]
        pub direction_switching_cost: f64 = 1.0,
        /// Distance of control points that B-splines get on long legs, in turning radii; with 0 the
        /// nodes are all there are.
        #[range(0.0..=100.0)]
        pub spline_spacing_radii: f64 = 0.0,
    }
}

impl SmoothingConfig {
    /// The cost of driving for a least turning radius: gears alone.
    pub fn cost(&self, radius_m: f64) -> VehicleCost {
        VehicleCost {
            reverse_factor: self.reverse_penalty,
            gear_switch_m: self.direction_switching_cost,
            ..DriveCost::length_alone().in_meters(radius_m, 0.0)
        }
    }

    /// As Lei & Zheng 2020 smooth: redundant nodes removed, corners by 2-turning alone.
    pub fn lei2020() -> Self {
        Self {
            corners: Corners::TwoTurning,
            ..Self::default()
        }
    }
}
