//! Moving obstacles that have been checked, and where they are at a time.

use super::check;
use super::error::MovingError;
use super::obstacle::{MovingObstacle, ObstacleMotion, TimedWaypoint};
use crate::geometry::{Point2, Pose2, angle_difference};
use crate::map::GridFrame;
use crate::vehicle::Vehicle;

/// Moving obstacles over a horizon.
///
/// Up to the horizon each obstacle is where its motion has it at that time, grown by its
/// uncertainty. From the horizon on it is taken to stand there: whoever plans farther ahead than
/// predictions reach must not drive through what was last seen in his way.
///
/// ```
/// use formicar::scenario::{MovingObstacle, ObstacleMotion, ObstacleShape, Predictions};
///
/// let walker = MovingObstacle {
///     name: None,
///     shape: ObstacleShape::Disc { radius_m: 0.3 },
///     motion: ObstacleMotion::Velocity { pose: [4.0, 0.0, 0.0], velocity_mps: [0.0, 1.5] },
///     growth_mps: 0.0,
/// };
/// let predictions = Predictions::new(vec![walker], 10.0)?;
/// assert_eq!(predictions.obstacles()[0].pose_at(2.0).y, 3.0);
/// assert_eq!(predictions.obstacles()[0].pose_at(60.0).y, 15.0);
/// # Ok::<(), formicar::scenario::MovingError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Predictions {
    obstacles: Vec<Predicted>,
    horizon_s: f64,
}

/// An obstacle that has been checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Predicted {
    name: String,
    source: MovingObstacle,
    horizon_s: f64,
    /// Corners in the frame of its pose, counter-clockwise; of a disc, its center.
    corners: Vec<Point2>,
    /// What is added to the corners on every side, meters.
    radius_m: f64,
    reach_m: f64,
}

/// Most obstacles.
const MAX_OBSTACLES: usize = 1000;
/// The longest horizon, seconds.
const MAX_HORIZON_S: f64 = 600.0;

impl Predictions {
    /// Obstacles and the time up to which they are predicted, seconds.
    ///
    /// # Errors
    /// Numbers that are not finite or out of range, corners that are not convex, times that run
    /// back, a horizon that is not above 0, or too many obstacles.
    pub fn new(obstacles: Vec<MovingObstacle>, horizon_s: f64) -> Result<Self, MovingError> {
        if !(horizon_s > 0.0 && horizon_s <= MAX_HORIZON_S) {
            return Err(MovingError::Horizon { value: horizon_s });
        }
        if obstacles.len() > MAX_OBSTACLES {
            return Err(MovingError::TooMany {
                what: "obstacles",
                n: obstacles.len(),
                limit: MAX_OBSTACLES,
            });
        }
        let obstacles = obstacles.into_iter().enumerate().map(|(i, source)| {
            let name = source.name.clone().unwrap_or_else(|| (i + 1).to_string());
            let (corners, radius_m) = check::check(&source, &name)?;
            let reach_m = corners.iter().fold(0.0, |r: f64, p| p.norm().max(r)) + radius_m;
            Ok(Predicted {
                name,
                source,
                horizon_s,
                corners,
                radius_m,
                reach_m,
            })
        });
        Ok(Self {
            obstacles: obstacles.collect::<Result<_, _>>()?,
            horizon_s,
        })
    }

    /// The obstacles, in the order given.
    pub fn obstacles(&self) -> &[Predicted] {
        &self.obstacles
    }

    /// The time up to which they are predicted, seconds.
    pub fn horizon_s(&self) -> f64 {
        self.horizon_s
    }

    /// Checks that every obstacle begins on a map and outside a vehicle.
    ///
    /// # Errors
    /// The first that does not.
    pub fn check_at(
        &self,
        frame: &GridFrame,
        vehicle: &Vehicle,
        start: Pose2,
    ) -> Result<(), MovingError> {
        for obstacle in &self.obstacles {
            let pose = obstacle.pose_at(0.0);
            let name = || obstacle.name.clone();
            if frame.cell_at(pose.position()).is_none() {
                let (obstacle, x, y) = (name(), pose.x, pose.y);
                return Err(MovingError::OffTheMap { obstacle, x, y });
            }
            let overlaps = vehicle.parts().iter().any(|part| {
                let body = part.placed(start);
                overlap(body.corners(), &obstacle.corners_at(0.0), obstacle.radius_m)
            });
            if overlaps {
                let (obstacle, x, y) = (name(), start.x, start.y);
                return Err(MovingError::InsideTheVehicle { obstacle, x, y });
            }
        }
        Ok(())
    }
}

impl Predicted {
    /// Its name, or its number counted from 1.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The obstacle as given.
    pub fn source(&self) -> &MovingObstacle {
        &self.source
    }

    /// Its pose at a time, which beyond the horizon is that at the horizon.
    pub fn pose_at(&self, t_s: f64) -> Pose2 {
        let t_s = t_s.clamp(0.0, self.horizon_s);
        match &self.source.motion {
            ObstacleMotion::Velocity { pose, velocity_mps } => {
                let [x, y, heading] = *pose;
                let [u, v] = *velocity_mps;
                Pose2::new(x + u * t_s, y + v * t_s, heading)
            }
            ObstacleMotion::Turn {
                pose: [x, y, heading],
                speed_mps,
                rate_rad_per_s,
            } => turned(
                Pose2::new(*x, *y, *heading),
                *speed_mps,
                *rate_rad_per_s,
                t_s,
            ),
            ObstacleMotion::Waypoints(points) => between(points, t_s),
        }
    }

    /// The corners of its body at a time, counter-clockwise; of a disc, its center.
    pub fn corners_at(&self, t_s: f64) -> Vec<Point2> {
        let pose = self.pose_at(t_s);
        self.corners.iter().map(|&p| pose.transform(p)).collect()
    }

    /// The radius by which the body exceeds its corners at a time, meters: that of a disc, and the
    /// growth of uncertainty up to then.
    pub fn radius_at(&self, t_s: f64) -> f64 {
        self.radius_m + self.source.growth_mps * t_s.clamp(0.0, self.horizon_s)
    }

    /// Times up to the horizon at which its motion changes, in order.
    pub fn knots(&self) -> Vec<f64> {
        let ObstacleMotion::Waypoints(points) = &self.source.motion else {
            return vec![self.horizon_s];
        };
        let times = points.iter().map(|point| point.t_s);
        let inside = times.filter(|&t_s| t_s > 0.0 && t_s < self.horizon_s);
        inside.chain([self.horizon_s]).collect()
    }

    /// A bound of the speed of its points between two times, growth included, m/s.
    pub fn point_speed_mps(&self, from_s: f64, to_s: f64) -> f64 {
        if from_s >= self.horizon_s {
            return 0.0;
        }
        let moving = match &self.source.motion {
            ObstacleMotion::Velocity {
                velocity_mps: [u, v],
                ..
            } => u.hypot(*v),
            ObstacleMotion::Turn {
                speed_mps,
                rate_rad_per_s,
                ..
            } => speed_mps.abs() + rate_rad_per_s.abs() * self.reach_m,
            ObstacleMotion::Waypoints(points) => legs(points)
                .filter(|leg| leg.begin_s < to_s && leg.end_s > from_s)
                .map(|leg| leg.speed_mps + leg.rate_rad_per_s.abs() * self.reach_m)
                .fold(0.0, f64::max),
        };
        moving + self.source.growth_mps
    }

    /// A bound of the acceleration of its points between [knots](Self::knots), m/s^2: by how much
    /// their tracks bend.
    pub fn point_acceleration_mps2(&self) -> f64 {
        match &self.source.motion {
            ObstacleMotion::Velocity { .. } => 0.0,
            ObstacleMotion::Turn {
                speed_mps,
                rate_rad_per_s,
                ..
            } => rate_rad_per_s.abs() * (speed_mps.abs() + rate_rad_per_s.abs() * self.reach_m),
            ObstacleMotion::Waypoints(points) => legs(points)
                .map(|leg| leg.rate_rad_per_s * leg.rate_rad_per_s * self.reach_m)
                .fold(0.0, f64::max),
        }
    }
}

/// The way between two way points.
struct Leg {
    begin_s: f64,
    end_s: f64,
    speed_mps: f64,
    rate_rad_per_s: f64,
}

fn legs(points: &[TimedWaypoint]) -> impl Iterator<Item = Leg> + '_ {
    points.windows(2).map(|pair| {
        let [a, b] = [pair[0].pose, pair[1].pose];
        let duration_s = pair[1].t_s - pair[0].t_s;
        Leg {
            begin_s: pair[0].t_s,
            end_s: pair[1].t_s,
            speed_mps: (b[0] - a[0]).hypot(b[1] - a[1]) / duration_s,
            rate_rad_per_s: angle_difference(b[2], a[2]) / duration_s,
        }
    })
}

/// A pose after driving along its heading while that turns.
fn turned(pose: Pose2, speed_mps: f64, rate_rad_per_s: f64, t_s: f64) -> Pose2 {
    if speed_mps == 0.0 {
        return Pose2::at(pose.position(), pose.heading + rate_rad_per_s * t_s);
    }
    pose.advance(rate_rad_per_s / speed_mps, speed_mps * t_s)
}

fn between(points: &[TimedWaypoint], t_s: f64) -> Pose2 {
    let place = |[x, y, heading]: [f64; 3]| Pose2::new(x, y, heading);
    let next = points.partition_point(|point| point.t_s <= t_s);
    let (Some(before), Some(after)) = (next.checked_sub(1).map(|i| points[i]), points.get(next))
    else {
        let standing = if next == 0 {
            points.first()
        } else {
            points.last()
        };
        return standing.map_or_else(Pose2::default, |point| place(point.pose));
    };
    let share = (t_s - before.t_s) / (after.t_s - before.t_s);
    let (a, b) = (place(before.pose), place(after.pose));
    let heading = a.heading + share * angle_difference(b.heading, a.heading);
    Pose2::at(a.position().lerp(b.position(), share), heading)
}

/// True if a convex polygon and one that is grown by a radius overlap; in doubt, at corners, the
/// answer of the separating axes counts: no.
fn overlap(a: &[Point2], b: &[Point2], radius_m: f64) -> bool {
    let middle = |corners: &[Point2]| {
        let sum = corners.iter().fold(Point2::default(), |sum, &p| sum + p);
        sum * (1.0 / corners.len() as f64)
    };
    let edges = |corners: &[Point2]| {
        let n = corners.len();
        let edge = |i: usize| (corners[(i + 1) % n] - corners[i]).perpendicular();
        (0..n).map(edge).collect::<Vec<_>>()
    };
    let nearest = a
        .iter()
        .min_by(|p, q| p.distance(middle(b)).total_cmp(&q.distance(middle(b))));
    let across = nearest.map(|&corner| corner - middle(b));
    let axes = edges(a).into_iter().chain(edges(b)).chain(across);
    let mut axes = axes.filter(|axis| axis.norm() > 0.0);
    axes.all(|axis| {
        let unit = axis * (1.0 / axis.norm());
        let range = |corners: &[Point2]| {
            let ends = corners.iter().map(|p| p.dot(unit));
            ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let ((a_low, a_high), (b_low, b_high)) = (range(a), range(b));
        a_high >= b_low - radius_m && b_high + radius_m >= a_low
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::ObstacleShape;

    fn obstacle(motion: ObstacleMotion) -> MovingObstacle {
        MovingObstacle {
            name: Some("cart".to_owned()),
            shape: ObstacleShape::Polygon(vec![[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]]),
            motion,
            growth_mps: 0.1,
        }
    }

    fn at(t_s: f64, pose: [f64; 3]) -> TimedWaypoint {
        TimedWaypoint { t_s, pose }
    }

    fn predicted(motion: ObstacleMotion) -> Predicted {
        let all = Predictions::new(vec![obstacle(motion)], 10.0).unwrap();
        all.obstacles()[0].clone()
    }

    fn motions() -> [ObstacleMotion; 3] {
        let pose = [1.0, 2.0, 0.5];
        [
            ObstacleMotion::Velocity {
                pose,
                velocity_mps: [0.6, -0.8],
            },
            ObstacleMotion::Turn {
                pose,
                speed_mps: 1.0,
                rate_rad_per_s: -0.7,
            },
            ObstacleMotion::Waypoints(vec![
                at(1.0, pose),
                at(3.0, [2.0, 2.0, 3.0]),
                at(7.0, [2.0, 5.0, -3.0]),
            ]),
        ]
    }

    #[test]
    fn no_point_is_faster_or_bends_more_than_the_bounds() {
        for motion in motions() {
            let cart = predicted(motion);
            let h = 1e-3;
            for i in 1..1200 {
                let t_s = 0.01 * f64::from(i);
                let [a, b, c] = [t_s - h, t_s, t_s + h].map(|t| cart.corners_at(t));
                let on_knot = cart
                    .knots()
                    .iter()
                    .chain(&[1.0])
                    .any(|k| (k - t_s).abs() < 2.0 * h);
                for ((a, b), c) in a.iter().zip(&b).zip(&c) {
                    let speed = (*b - *a).norm() / h;
                    assert!(speed <= cart.point_speed_mps(t_s - h, t_s) + 1e-6);
                    let bend = (*a + *c - *b * 2.0).norm() / (h * h);
                    assert!(on_knot || bend <= cart.point_acceleration_mps2() + 1e-4);
                }
            }
        }
    }

    #[test]
    fn an_obstacle_stands_from_the_horizon_on() {
        for motion in motions() {
            let cart = predicted(motion);
            assert_eq!(cart.pose_at(10.0), cart.pose_at(99.0));
            assert_eq!(cart.radius_at(99.0), 1.0);
            assert_eq!(cart.point_speed_mps(10.0, 99.0), 0.0);
        }
    }

    #[test]
    fn bad_predictions_are_refused_with_value_and_limit() {
        let error = |motion| {
            let all = Predictions::new(vec![obstacle(motion)], 10.0);
            all.unwrap_err().to_string()
        };
        let back = ObstacleMotion::Waypoints(vec![at(1.0, [0.0; 3]), at(1.0, [1.0; 3])]);
        assert!(error(back).contains("times must rise"));
        let nan = ObstacleMotion::Velocity {
            pose: [0.0, f64::NAN, 0.0],
            velocity_mps: [0.0; 2],
        };
        assert!(error(nan).contains("not finite: NaN"));
        assert!(error(ObstacleMotion::Waypoints(Vec::new())).contains("no way points"));
        for horizon_s in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e5] {
            let refused = Predictions::new(Vec::new(), horizon_s);
            assert!(matches!(refused, Err(MovingError::Horizon { .. })));
        }
        let flat = MovingObstacle {
            shape: ObstacleShape::Polygon(vec![[0.0, 0.0], [1.0, 0.0]]),
            ..obstacle(ObstacleMotion::Waypoints(vec![at(0.0, [0.0; 3])]))
        };
        assert!(Predictions::new(vec![flat], 1.0).is_err());
    }

    #[test]
    fn obstacles_begin_on_the_map_and_outside_the_vehicle() {
        let frame = GridFrame::new(100, 100, 0.1, Pose2::default()).unwrap();
        let check = |x, y| {
            let motion = ObstacleMotion::Waypoints(vec![at(0.0, [x, y, 0.3])]);
            let all = Predictions::new(vec![obstacle(motion)], 1.0).unwrap();
            all.check_at(&frame, &Vehicle::f1tenth(), Pose2::new(5.0, 5.0, 0.0))
        };
        assert!(check(8.0, 5.0).is_ok());
        let off = check(-3.0, 5.0).unwrap_err();
        assert!(matches!(off, MovingError::OffTheMap { .. }));
        let inside = check(5.5, 5.2).unwrap_err();
        assert!(matches!(inside, MovingError::InsideTheVehicle { .. }));
    }

    #[cfg(feature = "serde")]
    #[test]
    fn obstacles_are_read_from_json() {
        let json = r#"[
            {"shape": {"disc": {"radius_m": 0.3}},
             "motion": {"turn": {"pose": [1, 2, 0], "speed_mps": 1, "rate_rad_per_s": 0.1}}},
            {"name": "door", "shape": {"polygon": [[0, 0], [1, 0], [1, 0.1], [0, 0.1]]},
             "motion": {"waypoints": [{"t_s": 2, "pose": [0, 0, 0]}, {"t_s": 4, "pose": [0, 0, 1.5]}]},
             "growth_mps": 0.02}
        ]"#;
        let obstacles: Vec<MovingObstacle> = serde_json::from_str(json).unwrap();
        let all = Predictions::new(obstacles, 5.0).unwrap();
        assert_eq!(all.obstacles()[1].name(), "door");
        assert!((all.obstacles()[1].pose_at(3.0).heading - 0.75).abs() < 1e-12);
        let unknown = r#"{"shape": {"disc": {"radius": 0.3}}, "motion": {"waypoints": []}}"#;
        assert!(serde_json::from_str::<MovingObstacle>(unknown).is_err());
    }
}
