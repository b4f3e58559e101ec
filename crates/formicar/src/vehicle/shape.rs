//! A checked vehicle: footprint, steering limit, and what both imply.

use super::{FootprintSpec, VehicleError, VehicleParameters};
use crate::geometry::{ConvexPolygon, Point2};
use crate::parameters::OutOfRange;
use std::f64::consts::FRAC_PI_2;
use xxhash_rust::xxh3::xxh3_128;

/// The kinds of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Motion {
    /// Rolls on a steered axle: bounded curvature, heading along the path.
    Car,
    /// A holonomic point: any direction at any time; only its center line must stay free.
    Point,
}

impl Motion {
    /// The word used in documents.
    pub fn name(self) -> &'static str {
        match self {
            Self::Car => "car",
            Self::Point => "point",
        }
    }
}

/// A vehicle whose measures have been checked.
///
/// ```
/// use formicar::{Vehicle, VehicleParameters};
///
/// let van = Vehicle::new(VehicleParameters {
///     wheelbase_m: Some(3.0),
///     width_m: Some(2.0),
///     front_overhang_m: Some(0.9),
///     rear_overhang_m: Some(1.1),
///     min_turning_radius_m: Some(6.0),
///     ..VehicleParameters::default()
/// })?;
/// assert_eq!(van.footprint().area(), 10.0);
/// # Ok::<(), formicar::VehicleError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Vehicle {
    parameters: VehicleParameters,
    motion: Motion,
    footprint: ConvexPolygon,
    /// The body itself: the footprint, or the parts whose hull that is.
    parts: Vec<ConvexPolygon>,
    max_curvature_per_m: f64,
}

impl Vehicle {
    /// A car from its measures.
    ///
    /// # Errors
    /// Measures that are missing, out of range or contradict each other.
    pub fn new(parameters: VehicleParameters) -> Result<Self, VehicleError> {
        check_turning(&parameters)?;
        parameters.check()?;
        let parts = parts(&parameters)?;
        check_track(&parameters, &hull(&parts)?)?;
        let margin_m = parameters.safety_margin_m.unwrap_or(0.0);
        let parts: Vec<_> = parts.iter().map(|part| part.grown(margin_m)).collect();
        let footprint = hull(&parts)?;
        let max_curvature_per_m = 1.0 / turning_radius(&parameters)?;
        Ok(Self {
            parameters,
            motion: Motion::Car,
            footprint,
            parts,
            max_curvature_per_m,
        })
    }

    /// A holonomic point, for bare grid problems.
    pub fn point() -> Self {
        let footprint = ConvexPolygon::rectangle(Point2::default(), Point2::default());
        Self {
            parameters: VehicleParameters::default(),
            motion: Motion::Point,
            parts: vec![footprint.clone()],
            footprint,
            max_curvature_per_m: f64::INFINITY,
        }
    }

    /// The same vehicle with another safety margin.
    ///
    /// # Errors
    /// A margin that is negative or not finite.
    pub fn with_safety_margin(&self, margin_m: f64) -> Result<Self, VehicleError> {
        let safety_margin_m = Some(margin_m);
        match self.motion {
            Motion::Point => Ok(self.clone()),
            Motion::Car => Self::new(VehicleParameters {
                safety_margin_m,
                ..self.parameters.clone()
            }),
        }
    }

    /// The measures as given.
    pub fn parameters(&self) -> &VehicleParameters {
        &self.parameters
    }

    /// The kind of motion.
    pub fn motion(&self) -> Motion {
        self.motion
    }

    /// The body with its safety margin, around the rear-axle center, x forward, y left, meters; of
    /// a body in parts, their convex hull.
    pub fn footprint(&self) -> &ConvexPolygon {
        &self.footprint
    }

    /// The convex parts of which the body with its safety margin is the union; mostly one, the
    /// [footprint](Self::footprint).
    ///
    /// ```
    /// use formicar::vehicle::FootprintSpec;
    /// use formicar::{Vehicle, VehicleParameters};
    ///
    /// let mast = FootprintSpec::Points(vec![[0.8, -0.1], [1.4, -0.1], [1.4, 0.1], [0.8, 0.1]]);
    /// let body = FootprintSpec::Points(vec![[-0.2, -0.4], [0.8, -0.4], [0.8, 0.4], [-0.2, 0.4]]);
    /// let vehicle = Vehicle::new(VehicleParameters {
    ///     parts: Some(vec![body, mast]),
    ///     min_turning_radius_m: Some(1.0),
    ///     ..VehicleParameters::default()
    /// })?;
    /// assert_eq!(vehicle.parts().len(), 2);
    /// assert_eq!(vehicle.footprint().corners().len(), 6);
    /// # Ok::<(), formicar::VehicleError>(())
    /// ```
    pub fn parts(&self) -> &[ConvexPolygon] {
        &self.parts
    }

    /// The largest radius of a disc about the rear-axle center that stays inside a part of the
    /// body, meters; negative where the axle is outside of all.
    pub fn inradius_m(&self) -> f64 {
        let inside = self.parts.iter().map(ConvexPolygon::inradius);
        inside.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Width of the body with its safety margin, meters; 0 for a point.
    pub fn width_m(&self) -> f64 {
        let (low, high) = self.footprint.bounds();
        high.y - low.y
    }

    /// Largest curvature of the rear-axle center's path; infinite for a point.
    pub fn max_curvature_per_m(&self) -> f64 {
        self.max_curvature_per_m
    }

    /// Smallest turning radius of the rear-axle center, meters; 0 for a point.
    pub fn min_turning_radius_m(&self) -> f64 {
        1.0 / self.max_curvature_per_m
    }

    /// Distance between the axles, meters, where it is known.
    pub fn wheelbase_m(&self) -> Option<f64> {
        self.parameters.wheelbase_m
    }

    /// Distance between the wheels of an axle, meters; 0.8 of the width unless given.
    pub fn track_width_m(&self) -> f64 {
        let (low, high) = self.footprint.bounds();
        self.parameters
            .track_width_m
            .unwrap_or(0.8 * (high.y - low.y))
    }

    /// Steering angle of the virtual middle wheel at a curvature: atan(wheelbase * curvature).
    pub fn steer_rad(&self, curvature_per_m: f64) -> Option<f64> {
        self.wheelbase_m()
            .map(|wheelbase| (wheelbase * curvature_per_m).atan())
    }

    /// Wheelbase in meters and largest steering angle in radians.
    ///
    /// Where only a turning radius is known, those of a car with that radius whose largest
    /// steering is 45 degrees; of a point, those of a car with a turning radius of 1 m.
    pub fn steering_geometry(&self) -> [f64; 2] {
        let radius_m = match self.motion {
            Motion::Car => self.min_turning_radius_m(),
            Motion::Point => 1.0,
        };
        let wheelbase_m = self.wheelbase_m().unwrap_or(radius_m);
        [wheelbase_m, (wheelbase_m / radius_m).atan()]
    }

    /// A 128-bit hash of what the judge uses: motion, body and curvature limit.
    pub fn hash(&self) -> u128 {
        let mut bytes = vec![self.motion as u8];
        bytes.extend(self.max_curvature_per_m.to_le_bytes());
        for (i, part) in self.parts.iter().enumerate() {
            if i > 0 {
                bytes.push(b'+');
            }
            for corner in part.corners() {
                bytes.extend(corner.x.to_le_bytes());
                bytes.extend(corner.y.to_le_bytes());
            }
        }
        xxh3_128(&bytes)
    }
}

/// A vehicle without a turning radius is told apart from one with a wrong measure.
fn check_turning(p: &VehicleParameters) -> Result<(), VehicleError> {
    let steer_rad = p.max_steer_rad.or(p.max_steer_deg.map(f64::to_radians));
    let spin = steer_rad.filter(|&steer_rad| steer_rad.is_finite() && steer_rad >= FRAC_PI_2);
    let still = p.min_turning_radius_m.filter(|&radius_m| radius_m == 0.0);
    let spin = spin.map(|value| ("max_steer_rad", value));
    let still = still.map(|value| ("min_turning_radius_m", value));
    spin.or(still).map_or(Ok(()), |(name, value)| {
        Err(VehicleError::TurnsOnTheSpot { name, value })
    })
}

/// Wheels that stick out of the body would touch what nobody looks for.
fn check_track(p: &VehicleParameters, body: &ConvexPolygon) -> Result<(), VehicleError> {
    let (low, high) = body.bounds();
    match p.track_width_m {
        Some(value) if value > high.y - low.y => Err(VehicleError::OutOfRange(OutOfRange {
            key: "track_width_m".to_owned(),
            value,
            range: "at most the width of the body".to_owned(),
        })),
        _ => Ok(()),
    }
}

/// The most parts that a body may have; every distance is that of each.
const MAX_PARTS: usize = 64;

/// The convex parts of the body, without its safety margin.
fn parts(p: &VehicleParameters) -> Result<Vec<ConvexPolygon>, VehicleError> {
    match (&p.footprint, &p.parts) {
        (Some(_), Some(_)) => Err(VehicleError::FootprintAndParts),
        (Some(spec), None) => Ok(vec![polygon(spec)?]),
        (None, Some(specs)) if (1..=MAX_PARTS).contains(&specs.len()) => {
            let part = |(i, spec)| {
                polygon(spec).map_err(|error| VehicleError::Part {
                    number: i + 1,
                    error: Box::new(error),
                })
            };
            specs.iter().enumerate().map(part).collect()
        }
        (None, Some(specs)) => Err(VehicleError::OutOfRange(OutOfRange {
            key: "number of parts".to_owned(),
            value: specs.len() as f64,
            range: format!("1 to {MAX_PARTS}"),
        })),
        (None, None) => Ok(vec![rectangle(p)?]),
    }
}

/// The convex hull of parts; a single part as it stands.
fn hull(parts: &[ConvexPolygon]) -> Result<ConvexPolygon, VehicleError> {
    if let [only] = parts {
        return Ok(only.clone());
    }
    let corners = parts.iter().flat_map(ConvexPolygon::corners);
    let corners: Vec<_> = corners.copied().collect();
    Ok(ConvexPolygon::hull(&corners)?)
}

fn polygon(spec: &FootprintSpec) -> Result<ConvexPolygon, VehicleError> {
    let points = spec.points().map_err(VehicleError::FootprintText)?;
    if points.len() < 3 || points.iter().any(|p| !p.is_finite()) {
        return Ok(ConvexPolygon::new(&points)?);
    }
    Ok(ConvexPolygon::hull(&points)?)
}

fn rectangle(p: &VehicleParameters) -> Result<ConvexPolygon, VehicleError> {
    let needed = |name, value: Option<f64>| {
        let hint =
            "give wheelbase_m, width_m, front_overhang_m and rear_overhang_m, or a footprint";
        value.ok_or(VehicleError::Missing { name, hint })
    };
    let front =
        needed("wheelbase_m", p.wheelbase_m)? + needed("front_overhang_m", p.front_overhang_m)?;
    let rear = needed("rear_overhang_m", p.rear_overhang_m)?;
    if front + rear <= 0.0 {
        return Err(VehicleError::OutOfRange(OutOfRange {
            key: "rear_overhang_m".to_owned(),
            value: rear,
            range: format!("above {}, so that the body has a length", -front),
        }));
    }
    let half_width = 0.5 * needed("width_m", p.width_m)?;
    Ok(ConvexPolygon::rectangle(
        Point2::new(-rear, -half_width),
        Point2::new(front, half_width),
    ))
}

/// The largest turning radius, meters: as long as the longest segment that the judge drives. A
/// curve of a larger one would take unbounded time to follow.
const MAX_TURNING_RADIUS_M: f64 = 1e5;

fn turning_radius(p: &VehicleParameters) -> Result<f64, VehicleError> {
    let radius_m = stated_turning_radius(p)?;
    if radius_m > MAX_TURNING_RADIUS_M {
        return Err(VehicleError::OutOfRange(OutOfRange {
            key: "min_turning_radius_m".to_owned(),
            value: radius_m,
            range: "at most 1e5, stated or implied by max_steer".to_owned(),
        }));
    }
    Ok(radius_m)
}

fn stated_turning_radius(p: &VehicleParameters) -> Result<f64, VehicleError> {
    let from_degrees = p.max_steer_deg.map(f64::to_radians);
    let steer = p.max_steer_rad.or(from_degrees);
    let implied = match (steer, p.wheelbase_m) {
        (Some(steer_rad), Some(wheelbase)) => Some((steer_rad, wheelbase / steer_rad.tan())),
        (Some(_), None) if p.min_turning_radius_m.is_none() => {
            let hint = "max_steer needs it; or give min_turning_radius_m";
            return Err(VehicleError::Missing {
                name: "wheelbase_m",
                hint,
            });
        }
        _ => None,
    };
    match (p.min_turning_radius_m, implied) {
        (Some(radius_m), Some((steer_rad, implied_m)))
            if (radius_m / implied_m - 1.0).abs() > 0.01 =>
        {
            Err(VehicleError::LimitsDisagree {
                radius_m,
                steer_rad,
                implied_m,
            })
        }
        (Some(radius_m), _) => Ok(radius_m),
        (None, Some((_, implied_m))) => Ok(implied_m),
        (None, None) => Err(VehicleError::Missing {
            name: "max_steer_rad",
            hint: "give max_steer_rad, max_steer_deg or min_turning_radius_m",
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn car() -> VehicleParameters {
        Vehicle::sedan().parameters().clone()
    }

    #[test]
    fn steering_limit_and_turning_radius_are_one() {
        let lei = Vehicle::lei2020();
        assert!((lei.min_turning_radius_m() - 2.383_507).abs() < 1e-6);
        let steer = lei.steer_rad(lei.max_curvature_per_m()).unwrap();
        assert!((steer - 40_f64.to_radians()).abs() < 1e-12);
        let r_min = Some(2.0);
        let error = Vehicle::new(VehicleParameters {
            min_turning_radius_m: r_min,
            ..car()
        });
        assert!(matches!(error, Err(VehicleError::LimitsDisagree { .. })));
    }

    #[test]
    fn refuses_what_turns_on_the_spot() {
        let spin = VehicleParameters {
            max_steer_rad: Some(1.6),
            max_steer_deg: None,
            ..car()
        };
        assert!(matches!(
            Vehicle::new(spin),
            Err(VehicleError::TurnsOnTheSpot { .. })
        ));
        let still = VehicleParameters {
            max_steer_rad: None,
            max_steer_deg: None,
            min_turning_radius_m: Some(0.0),
            ..car()
        };
        assert!(matches!(
            Vehicle::new(still),
            Err(VehicleError::TurnsOnTheSpot { .. })
        ));
    }

    #[test]
    fn refuses_what_hardly_steers_and_would_be_followed_forever() {
        let straight = VehicleParameters {
            max_steer_rad: Some(1e-12),
            max_steer_deg: None,
            min_turning_radius_m: None,
            ..car()
        };
        assert!(matches!(
            Vehicle::new(straight),
            Err(VehicleError::OutOfRange { .. })
        ));
    }

    #[test]
    fn refuses_numbers_that_are_no_measures() {
        for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            let p = VehicleParameters {
                wheelbase_m: Some(bad),
                ..car()
            };
            assert!(
                matches!(Vehicle::new(p), Err(VehicleError::OutOfRange { .. })),
                "{bad}"
            );
        }
    }

    #[test]
    fn the_rear_axle_may_be_anywhere() {
        let with_rear = |rear_overhang_m| {
            Vehicle::new(VehicleParameters {
                wheelbase_m: Some(2.0),
                front_overhang_m: Some(-0.5),
                rear_overhang_m: Some(rear_overhang_m),
                ..car()
            })
        };
        let (low, high) = with_rear(-0.25).unwrap().footprint().bounds();
        assert_eq!((low.x, high.x), (0.25, 1.5));
        let error = with_rear(-1.5).unwrap_err().to_string();
        assert!(
            error.contains("rear_overhang_m") && error.contains("-1.5"),
            "{error}"
        );
    }

    #[test]
    fn a_body_in_parts_is_hashed_and_grown_part_by_part() {
        let with = |parts: &str| {
            let json = format!(r#"{{"parts": {parts}, "min_turning_radius_m": 1.0}}"#);
            Vehicle::new(serde_json::from_str(&json).unwrap())
        };
        let l = "[[[0, 0], [2, 0], [2, 1], [0, 1]], [[0, 0], [1, 0], [1, 2], [0, 2]]]";
        let l = with(l).unwrap();
        assert_eq!((l.parts().len(), l.footprint().area()), (2, 3.5));
        let grown = l.with_safety_margin(0.1).unwrap();
        assert!((grown.parts()[0].area() - 2.2 * 1.2).abs() < 1e-12);
        let square = with("[[[0, 0], [2, 0], [2, 2], [0, 2]]]").unwrap();
        let same =
            r#"{"footprint": [[0, 0], [2, 0], [2, 2], [0, 2]], "min_turning_radius_m": 1.0}"#;
        let same = Vehicle::new(serde_json::from_str(same).unwrap()).unwrap();
        assert_eq!(square.hash(), same.hash());
        assert_ne!(l.hash(), grown.hash());
        for (bad, told) in [
            ("[]", "number of parts"),
            ("[[[0, 0], [1, 0]]]", "part 1"),
            (
                "[[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 0], [2, 0]]]",
                "part 2",
            ),
        ] {
            let error = with(bad).unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
        let both = r#"{"footprint": [[0, 0], [2, 0], [2, 2]], "parts": [], "r_min": 1.0}"#;
        let both = Vehicle::new(serde_json::from_str(both).unwrap()).unwrap_err();
        assert!(both.to_string().contains("hint"), "{both}");
    }

    #[test]
    fn refuses_wheels_beside_the_body() {
        let wide = |track_width_m| {
            let track_width_m = Some(track_width_m);
            Vehicle::new(VehicleParameters {
                track_width_m,
                ..car()
            })
        };
        assert!(wide(1.8).is_ok());
        assert!(matches!(wide(1.9), Err(VehicleError::OutOfRange { .. })));
    }

    #[test]
    fn margin_grows_the_footprint_everywhere() {
        let grown = Vehicle::sedan().with_safety_margin(0.1).unwrap();
        let (low, high) = grown.footprint().bounds();
        assert!((low.x + 1.1).abs() < 1e-12 && (high.x - 3.8).abs() < 1e-12);
        assert!((high.y - 1.0).abs() < 1e-12);
        assert_ne!(grown.hash(), Vehicle::sedan().hash());
    }

    #[test]
    fn reads_users_words() {
        let json = r#"{"footprint": "[[1.2,0.3],[-0.2,0.3],[-0.2,-0.3],[1.2,-0.3]]", "min_turning_radius": 1.0}"#;
        let vehicle = Vehicle::new(serde_json::from_str(json).unwrap()).unwrap();
        assert!((vehicle.footprint().area() - 0.84).abs() < 1e-12);
        assert_eq!(vehicle.wheelbase_m(), None);
        assert!(serde_json::from_str::<VehicleParameters>(r#"{"wheelbse": 2}"#).is_err());
    }
}
