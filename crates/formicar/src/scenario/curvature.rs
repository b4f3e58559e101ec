//! Continuity of the curvature, and the limit of its rate of change.

use super::{Request, ScenarioError};
use crate::vehicle::{Motion, Vehicle};

/// Least and largest rate that may be asked for, 1/m^2: beyond them lie no vehicles, and numbers
/// lose their digits.
const RATES_PER_M2: [f64; 2] = [1e-4, 1e4];

/// The continuity that a path's curvature must have.
///
/// ```
/// use formicar::scenario::{CurvatureMode, CurvatureRate};
/// use formicar::{Pose2, Request};
///
/// let rate = CurvatureRate { max_rate_per_m2: Some(0.5) };
/// let request = Request {
///     curvature: CurvatureMode::Continuous(rate),
///     ..Request::new(Pose2::default(), Pose2::new(9.0, 0.0, 0.0))
/// };
/// assert_ne!(request.curvature, CurvatureMode::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum CurvatureMode {
    /// It may: the path is a chain of lines and arcs, at whose joints the wheels turn in no time.
    #[default]
    Arcs,
    /// It may not, but where the vehicle stands: it changes at a bounded rate along the way.
    Continuous(CurvatureRate),
}

/// The limit of the curvature's rate of change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct CurvatureRate {
    /// Fastest change of the curvature per driven meter, 1/m^2, 0.0001 to 10000. Where left out,
    /// what the vehicle's steering rate allows at its speed.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-4, max = 1e4)))]
    pub max_rate_per_m2: Option<f64>,
}

impl Request {
    /// The fastest change of curvature that the request allows, 1/m^2; none where it may jump.
    ///
    /// With the curvature k = tan(steer) / L the rate is
    /// `dk/ds = (steering rate) (1 + (L k)^2) / (L v)`, least at k = 0: `(steering rate) / (L v)`.
    ///
    /// # Errors
    /// A rate out of range, a vehicle whose rate is not known, or one that does not steer.
    pub fn max_curvature_rate_per_m2(
        &self,
        vehicle: &Vehicle,
    ) -> Result<Option<f64>, ScenarioError> {
        let CurvatureMode::Continuous(asked) = self.curvature else {
            return Ok(None);
        };
        if vehicle.motion() == Motion::Point {
            return Err(ScenarioError::NoCurvature);
        }
        let rate = match asked.max_rate_per_m2 {
            Some(rate) => rate,
            None => rate_of(vehicle)?,
        };
        let [low, high] = RATES_PER_M2;
        if (low..=high).contains(&rate) {
            return Ok(Some(rate));
        }
        Err(ScenarioError::OutOfRange {
            what: "curvature max_rate_per_m2",
            value: rate,
            range: "0.0001 to 10000 1/m^2; hint: it is the steering rate over wheelbase and speed, for instance 0.25 of a car",
        })
    }
}

fn rate_of(vehicle: &Vehicle) -> Result<f64, ScenarioError> {
    let p = vehicle.parameters();
    let known = |what: &'static str, value: Option<f64>| {
        value.ok_or(ScenarioError::UnknownCurvatureRate { missing: what })
    };
    let steer_rate = known("max_steer_rate_rad_per_s", p.max_steer_rate_rad_per_s)?;
    let speed_mps = known("speed_mps", p.speed_mps)?;
    let wheelbase_m = known("wheelbase_m", vehicle.wheelbase_m())?;
    Ok(steer_rate / (wheelbase_m * speed_mps))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;
    use crate::vehicle::VehicleParameters;

    fn asking(max_rate_per_m2: Option<f64>) -> Request {
        let curvature = CurvatureMode::Continuous(CurvatureRate { max_rate_per_m2 });
        Request {
            curvature,
            ..Request::new(Pose2::default(), Pose2::default())
        }
    }

    fn steered() -> Vehicle {
        Vehicle::new(VehicleParameters {
            max_steer_rate_rad_per_s: Some(0.5),
            speed_mps: Some(2.0),
            ..Vehicle::lei2020().parameters().clone()
        })
        .unwrap()
    }

    #[test]
    fn the_rate_is_asked_for_or_the_vehicles() {
        let rate = |request: &Request| request.max_curvature_rate_per_m2(&steered()).unwrap();
        assert_eq!(rate(&asking(Some(0.7))), Some(0.7));
        assert_eq!(rate(&asking(None)), Some(0.5 / (2.0 * 2.0)));
        let arcs = Request::new(Pose2::default(), Pose2::default());
        assert_eq!(rate(&arcs), None);
    }

    #[test]
    fn errors_name_what_is_wrong() {
        let error = |request: &Request, vehicle: &Vehicle| {
            let error = request.max_curvature_rate_per_m2(vehicle).unwrap_err();
            error.to_string()
        };
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e5] {
            let error = error(&asking(Some(bad)), &steered());
            assert!(
                error.contains("max_rate_per_m2") && error.contains("hint"),
                "{error}"
            );
        }
        let mut of_unknown_rate = steered().parameters().clone();
        of_unknown_rate.max_steer_rate_rad_per_s = None;
        let unknown = error(&asking(None), &Vehicle::new(of_unknown_rate).unwrap());
        assert!(unknown.contains("max_steer_rate_rad_per_s"), "{unknown}");
        let point = error(&asking(Some(1.0)), &Vehicle::point());
        assert!(point.contains("point"), "{point}");
    }

    #[test]
    fn the_mode_on_the_wire() {
        let json = |request: &Request| serde_json::to_string(&request.curvature).unwrap();
        assert_eq!(json(&asking(None)), r#"{"continuous":{}}"#);
        let known = r#"{"continuous":{"max_rate_per_m2":0.5}}"#;
        assert_eq!(json(&asking(Some(0.5))), known);
        let back: CurvatureMode = serde_json::from_str(known).unwrap();
        assert_eq!(back, asking(Some(0.5)).curvature);
        let arcs: CurvatureMode = serde_json::from_str(r#""arcs""#).unwrap();
        assert_eq!(arcs, CurvatureMode::Arcs);
    }
}
