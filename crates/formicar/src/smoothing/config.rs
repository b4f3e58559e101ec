//! Parameters of smoothing.

use super::redundant_nodes::RedundantNodes;
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How corners of a polyline become drivable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
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

/// Parameters of smoothing; costs are in metres of forward driving.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SmoothingConfig {
    /// Which nodes of the grid path stay before its corners are rounded.
    pub redundant_nodes: RedundantNodes,
    /// How corners become drivable.
    pub corners: Corners,
    /// Members of 2-turning tried per corner and order, besides the one nearest to the polyline,
    /// 1 to 256.
    #[schemars(range(min = 1, max = 256))]
    pub n_members: u32,
    /// Distance of poses on the polyline at which curves may begin and end, in turning radii, 0.05
    /// to 10.
    #[schemars(range(min = 0.05, max = 10.0))]
    pub station_radii: f64,
    /// The most of the polyline that one curve replaces, in turning radii, 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub reach_radii: f64,
    /// Cost of each corner that a curve passes instead of 2-turning, in turning radii, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub passed_corner_radii: f64,
    /// Cost of a corner that is rounded by a wide arc, in turning radii, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub corner_radii: f64,
    /// Cost of a wide arc for each radian, in turning radii at the least radius and inversely to
    /// the radius, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub bend_weight: f64,
    /// The margin that ways by wide arcs keep where they can, metres, 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub arc_margin_m: f64,
    /// Factor on the length driven in reverse, 1 to 100.
    #[schemars(range(min = 1.0, max = 100.0))]
    pub reverse_penalty: f64,
    /// Cost of a change of gear, metres, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub direction_switching_cost: f64,
    /// Distance of control points that B-splines get on long legs, in turning radii, 0 to 100; with
    /// 0 the nodes are all there are.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub spline_spacing_radii: f64,
}

impl Default for SmoothingConfig {
    fn default() -> Self {
        Self {
            redundant_nodes: RedundantNodes::Remove,
            corners: Corners::TwoTurningOrDubins,
            n_members: 12,
            station_radii: 0.5,
            reach_radii: 8.0,
            passed_corner_radii: 4.0,
            corner_radii: 0.3,
            bend_weight: 3.0,
            arc_margin_m: 0.1,
            reverse_penalty: 2.0,
            direction_switching_cost: 1.0,
            spline_spacing_radii: 0.0,
        }
    }
}

impl SmoothingConfig {
    /// As Lei & Zheng 2020 smooth: redundant nodes removed, corners by 2-turning alone.
    pub fn lei2020() -> Self {
        Self {
            corners: Corners::TwoTurning,
            ..Self::default()
        }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let n_members = f64::from(self.n_members);
        check_range("smoothing.n_members", n_members, 1.0..=256.0)?;
        check_range("smoothing.station_radii", self.station_radii, 0.05..=10.0)?;
        check_range("smoothing.reach_radii", self.reach_radii, 0.0..=100.0)?;
        let passed = self.passed_corner_radii;
        check_range("smoothing.passed_corner_radii", passed, 0.0..=1000.0)?;
        check_range("smoothing.corner_radii", self.corner_radii, 0.0..=1000.0)?;
        check_range("smoothing.bend_weight", self.bend_weight, 0.0..=1000.0)?;
        check_range("smoothing.arc_margin_m", self.arc_margin_m, 0.0..=100.0)?;
        check_range(
            "smoothing.reverse_penalty",
            self.reverse_penalty,
            1.0..=100.0,
        )?;
        let switching = self.direction_switching_cost;
        check_range(
            "smoothing.direction_switching_cost",
            switching,
            0.0..=1000.0,
        )?;
        check_range(
            "smoothing.spline_spacing_radii",
            self.spline_spacing_radii,
            0.0..=100.0,
        )
    }
}
