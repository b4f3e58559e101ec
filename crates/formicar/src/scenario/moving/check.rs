//! Checks of moving obstacles by themselves.

use super::error::MovingError;
use super::obstacle::{MovingObstacle, ObstacleMotion, ObstacleShape, TimedWaypoint};
use crate::geometry::{ConvexPolygon, Point2};

/// Most way points of an obstacle.
const MAX_WAYPOINTS: usize = 10_000;
/// What is farther from the origin is on no map, meters.
const MAX_PLACE_M: f64 = 1e6;
/// Nothing on wheels or legs is faster, m/s.
const MAX_SPEED_MPS: f64 = 100.0;
/// Nor does it turn faster, rad/s.
const MAX_RATE_RAD_PER_S: f64 = 100.0;
/// The largest body, meters from its pose.
const MAX_REACH_M: f64 = 1000.0;

/// Checks an obstacle, and returns the corners of its body.
pub(super) fn check(
    obstacle: &MovingObstacle,
    name: &str,
) -> Result<(Vec<Point2>, f64), MovingError> {
    let check = Check { name };
    check.range(
        "growth_mps",
        obstacle.growth_mps,
        0.0..=MAX_SPEED_MPS,
        "0 to 100",
    )?;
    check.motion(&obstacle.motion)?;
    check.shape(&obstacle.shape)
}

struct Check<'a> {
    name: &'a str,
}

impl Check<'_> {
    fn motion(&self, motion: &ObstacleMotion) -> Result<(), MovingError> {
        let speed = |what, value: f64| {
            let range = -MAX_SPEED_MPS..=MAX_SPEED_MPS;
            self.range(what, value, range, "-100 to 100 m/s")
        };
        match motion {
            ObstacleMotion::Velocity { pose, velocity_mps } => {
                self.pose(pose)?;
                let [x, y] = *velocity_mps;
                speed("velocity_mps", x)?;
                speed("velocity_mps", y)
            }
            ObstacleMotion::Turn {
                pose,
                speed_mps,
                rate_rad_per_s,
            } => {
                self.pose(pose)?;
                speed("speed_mps", *speed_mps)?;
                let range = -MAX_RATE_RAD_PER_S..=MAX_RATE_RAD_PER_S;
                self.range("rate_rad_per_s", *rate_rad_per_s, range, "-100 to 100")
            }
            ObstacleMotion::Waypoints(points) => self.waypoints(points),
        }
    }

    fn waypoints(&self, points: &[TimedWaypoint]) -> Result<(), MovingError> {
        let obstacle = self.name.to_owned();
        if points.is_empty() {
            return Err(MovingError::NoWaypoints { obstacle });
        }
        if points.len() > MAX_WAYPOINTS {
            return Err(MovingError::TooMany {
                what: "way points",
                n: points.len(),
                limit: MAX_WAYPOINTS,
            });
        }
        for point in points {
            self.finite("t_s", &[point.t_s])?;
            self.pose(&point.pose)?;
        }
        for (i, pair) in points.windows(2).enumerate() {
            let [before_s, t_s] = [pair[0].t_s, pair[1].t_s];
            if t_s <= before_s {
                return Err(MovingError::TimesRunBack {
                    obstacle,
                    index: i + 2,
                    t_s,
                    before_s,
                });
            }
            let [a, b] = [pair[0].pose, pair[1].pose].map(|[x, y, _]| Point2::new(x, y));
            let speed_mps = a.distance(b) / (t_s - before_s);
            let range = 0.0..=MAX_SPEED_MPS;
            self.range("speed between way points", speed_mps, range, "0 to 100 m/s")?;
        }
        Ok(())
    }

    fn shape(&self, shape: &ObstacleShape) -> Result<(Vec<Point2>, f64), MovingError> {
        match shape {
            ObstacleShape::Disc { radius_m } => {
                let range = f64::MIN_POSITIVE..=MAX_REACH_M;
                self.range("radius_m", *radius_m, range, "above 0, at most 1000 m")?;
                Ok((vec![Point2::default()], *radius_m))
            }
            ObstacleShape::Polygon(corners) => {
                let corners: Vec<_> = corners.iter().map(|&[x, y]| Point2::new(x, y)).collect();
                let polygon = ConvexPolygon::new(&corners).map_err(|source| {
                    let obstacle = self.name.to_owned();
                    MovingError::Shape { obstacle, source }
                })?;
                let reach_m = polygon.circumradius();
                let range = 0.0..=MAX_REACH_M;
                self.range("reach of the polygon", reach_m, range, "at most 1000 m")?;
                Ok((polygon.corners().to_vec(), 0.0))
            }
        }
    }

    fn pose(&self, pose: &[f64; 3]) -> Result<(), MovingError> {
        self.finite("pose", pose)?;
        let range = -MAX_PLACE_M..=MAX_PLACE_M;
        pose.iter()
            .try_for_each(|&value| self.range("pose", value, range.clone(), "within 1e6"))
    }

    fn finite(&self, what: &'static str, values: &[f64]) -> Result<(), MovingError> {
        match values.iter().find(|value| !value.is_finite()) {
            None => Ok(()),
            Some(value) => Err(MovingError::NotFinite {
                obstacle: self.name.to_owned(),
                what,
                value: value.to_string(),
            }),
        }
    }

    fn range(
        &self,
        what: &'static str,
        value: f64,
        allowed: std::ops::RangeInclusive<f64>,
        range: &'static str,
    ) -> Result<(), MovingError> {
        self.finite(what, &[value])?;
        if allowed.contains(&value) {
            return Ok(());
        }
        Err(MovingError::OutOfRange {
            obstacle: self.name.to_owned(),
            what,
            value,
            range,
        })
    }
}
