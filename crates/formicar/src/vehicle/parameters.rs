//! A vehicle as users write it down.

use crate::geometry::Point2;
use crate::parameters::{Parameters, parameters};
use std::f64::consts::FRAC_PI_2;
use std::ops::Bound::{self, Excluded, Included};

/// A measure above 0; what is larger than this is no vehicle.
const POSITIVE: (Bound<f64>, Bound<f64>) = (Excluded(0.0), Excluded(1e6));

parameters! {
    /// The measures of a vehicle, as in a vehicle file; [`super::Vehicle::new`] checks them.
    ///
    /// Either the five lengths give a rectangle, or `footprint` gives any convex polygon, or `parts`
    /// give a body of any shape. One of
    /// `max_steer_rad` (or `max_steer_deg`) and `min_turning_radius_m` sets the steering limit; where
    /// both stand they must agree to 1 %.
    #[derive(Default)]
    pub struct VehicleParameters {
        /// Distance between the axles, meters. May be left out where a footprint and a
        /// turning radius are given; steering angles are then unknown.
        #[range(POSITIVE)]
        #[serde(alias = "wheelbase", skip_serializing_if = "Option::is_none")]
        pub wheelbase_m: Option<f64>,
        /// Distance between the wheels of an axle, meters, at most the width of the body;
        /// default 0.8 of it.
        #[range(POSITIVE)]
        #[serde(alias = "track_width", skip_serializing_if = "Option::is_none")]
        pub track_width_m: Option<f64>,
        /// From the front axle to the front end, meters; negative where the body ends behind it.
        #[range(-1e6..1e6)]
        #[serde(alias = "front_overhang", skip_serializing_if = "Option::is_none")]
        pub front_overhang_m: Option<f64>,
        /// From the rear axle to the rear end, meters; negative where the body begins ahead of it.
        #[range(-1e6..1e6)]
        #[serde(alias = "rear_overhang", skip_serializing_if = "Option::is_none")]
        pub rear_overhang_m: Option<f64>,
        /// Width of the body, meters.
        #[range(POSITIVE)]
        #[serde(alias = "width", skip_serializing_if = "Option::is_none")]
        pub width_m: Option<f64>,
        /// The body as a polygon around the rear axle instead: a list of `[x, y]`, or a ROS string
        /// `"[[x1, y1], [x2, y2], ...]"`; at least 3 points, made convex.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub footprint: Option<FootprintSpec>,
        /// The body as the union of polygons around the rear axle instead, for shapes that are not
        /// convex, as L, U and T: lists of `[x, y]`, meters; each part is made convex, and parts may
        /// overlap.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub parts: Option<Vec<FootprintSpec>>,
        /// Largest steering angle of the virtual middle wheel, radians.
        #[range((Excluded(0.0), Excluded(FRAC_PI_2)))]
        #[serde(alias = "max_steer", skip_serializing_if = "Option::is_none")]
        pub max_steer_rad: Option<f64>,
        /// The same in degrees.
        #[range((Excluded(0.0), Excluded(90.0)))]
        #[serde(skip_serializing_if = "Option::is_none")]
        pub max_steer_deg: Option<f64>,
        /// Smallest turning radius of the rear-axle center, meters.
        #[range((Excluded(0.0), Included(1e5)))]
        #[serde(
            alias = "min_turning_radius",
            alias = "r_min",
            skip_serializing_if = "Option::is_none"
        )]
        pub min_turning_radius_m: Option<f64>,
        /// Grows the footprint on every side, meters; default 0.
        #[range(0.0..1e6)]
        #[serde(alias = "safety_margin", skip_serializing_if = "Option::is_none")]
        pub safety_margin_m: Option<f64>,
        /// Fastest change of the steering angle, radians per second.
        #[range(POSITIVE)]
        #[serde(alias = "max_steer_rate", skip_serializing_if = "Option::is_none")]
        pub max_steer_rate_rad_per_s: Option<f64>,
        /// Driving speed, meters per second.
        #[range(POSITIVE)]
        #[serde(alias = "speed", skip_serializing_if = "Option::is_none")]
        pub speed_mps: Option<f64>,
        /// Largest acceleration and deceleration, m/s^2; taken as 1 where it is left out.
        #[range(POSITIVE)]
        #[serde(alias = "max_acceleration", skip_serializing_if = "Option::is_none")]
        pub max_acceleration_mps2: Option<f64>,
    }
}

/// A footprint as a list of points or as the string that ROS configurations hold.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(untagged))]
pub enum FootprintSpec {
    /// Corner points `[x, y]`, meters.
    Points(Vec<[f64; 2]>),
    /// `"[[x1, y1], [x2, y2], ...]"`, meters.
    RosString(String),
}

impl Parameters for FootprintSpec {}

impl FootprintSpec {
    /// The points, or what is wrong with the string.
    ///
    /// # Errors
    /// The string is no JSON list of number pairs.
    pub fn points(&self) -> Result<Vec<Point2>, String> {
        let pairs = match self {
            Self::Points(pairs) => pairs.clone(),
            Self::RosString(text) => pairs(text)?,
        };
        Ok(pairs.into_iter().map(|[x, y]| Point2::new(x, y)).collect())
    }
}

#[cfg(feature = "serde")]
fn pairs(text: &str) -> Result<Vec<[f64; 2]>, String> {
    serde_json::from_str(text).map_err(|e| format!("{e}; expected [[x1, y1], [x2, y2], ...]"))
}

#[cfg(not(feature = "serde"))]
fn pairs(_text: &str) -> Result<Vec<[f64; 2]>, String> {
    Err("a string is read with the feature `serde` only; hint: give points".to_owned())
}
