//! A via point in files.

use crate::geometry::Point2;
use crate::scenario::{GoalTolerance, ViaPoint};

/// A place that the path passes on its way.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ViaRecord {
    /// Position, `[x m, y m]`.
    pub at: [f64; 2],
    /// The heading there, radians; any where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading: Option<f64>,
    /// Tolerance; 0.1 m and 0.1 rad by default.
    #[serde(default = "default_tolerance")]
    pub tolerance: GoalTolerance,
}

fn default_tolerance() -> GoalTolerance {
    ViaPoint::DEFAULT_TOLERANCE
}

impl ViaRecord {
    /// The via point behind the record.
    pub fn point(&self) -> ViaPoint {
        let [x, y] = self.at;
        ViaPoint {
            position: Point2::new(x, y),
            heading_rad: self.heading,
            tolerance: self.tolerance,
        }
    }
}

impl From<&ViaPoint> for ViaRecord {
    fn from(via: &ViaPoint) -> Self {
        Self {
            at: [via.position.x, via.position.y],
            heading: via.heading_rad,
            tolerance: via.tolerance,
        }
    }
}
