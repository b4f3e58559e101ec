//! Contacts between the robot and the world: exact for squares, bounded steps for what moves.

use crate::solid::{Nearness, Solid};
use formicar::collision::Drive;
use formicar::geometry::angle_difference;
use formicar::scenario::ObstacleShape;
use formicar::vehicle::BicycleState;
use formicar::{Point2, Pose2, Vehicle};
use serde::{Deserialize, Serialize};

/// Gaps below this are contact, meters.
const TOUCH_M: f64 = 1e-6;
/// Most looks at a pair of bodies within a step.
const MAX_LOOKS: usize = 200;
/// Slower than this, the robot stands, m/s.
const STANDS_MPS: f64 = 0.01;

/// A contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Contact {
    /// Time, seconds.
    pub t_s: f64,
    /// The other body.
    pub with: Contacted,
    /// Who drove into whom.
    pub by: Culprit,
    /// The place that was touched.
    pub place: Point2,
    /// The robot's pose.
    pub pose: Pose2,
    /// The robot's speed, m/s, negative in reverse.
    pub robot_mps: f64,
    /// The speed with which the robot came toward the other at the place of contact, m/s.
    pub robot_closing_mps: f64,
    /// The speed with which the other came toward the robot, m/s.
    pub other_closing_mps: f64,
}

/// The body that the robot touched.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Contacted {
    /// An occupied square of the map, or its border.
    Square,
    /// A solid that stands.
    Solid,
    /// An agent, by name.
    Agent(String),
}

/// Who caused a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Culprit {
    /// The robot drove into the other, which stood or moved away.
    Robot,
    /// The other drove into the robot, which stood or moved away.
    Other,
    /// Each came toward the other.
    Both,
}

impl Culprit {
    /// True where the robot had a part in it.
    pub fn is_robot(self) -> bool {
        self != Self::Other
    }

    fn of(robot_mps: f64, [robot_closing_mps, other_closing_mps]: [f64; 2]) -> Self {
        if robot_mps.abs() < STANDS_MPS || robot_closing_mps <= 0.0 {
            Self::Other
        } else if other_closing_mps <= 0.0 {
            Self::Robot
        } else {
            Self::Both
        }
    }
}

/// A body that stands, or moves evenly from one pose to another.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Other<'a> {
    Standing(&'a Solid),
    Moving {
        shape: &'a ObstacleShape,
        from: Pose2,
        to: Pose2,
    },
}

impl Other<'_> {
    /// The longest way of any of its points.
    fn motion_m(&self) -> f64 {
        match self {
            Self::Standing(_) => 0.0,
            Self::Moving { shape, from, to } => {
                let turn_rad = angle_difference(to.heading, from.heading).abs();
                from.position().distance(to.position()) + turn_rad * shape_reach_m(shape)
            }
        }
    }

    fn at(&self, share: f64) -> Solid {
        match self {
            Self::Standing(solid) => (*solid).clone(),
            Self::Moving { shape, from, to } => {
                let turn_rad = angle_difference(to.heading, from.heading);
                let place = from.position().lerp(to.position(), share);
                Solid::placed(shape, Pose2::at(place, from.heading + share * turn_rad))
            }
        }
    }
}

/// The least gap found between two moving bodies, and the share of the step at which they touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Encounter {
    pub(crate) nearness: Nearness,
    pub(crate) touches_at: Option<f64>,
}

/// Follows the robot along a drive and another body along its motion over the same time. Between two
/// looks neither body can have closed the gap that was seen: contact is never passed over.
pub(crate) fn encounter(vehicle: &Vehicle, drive: &Drive, other: &Other) -> Encounter {
    let reach_m = vehicle.footprint().circumradius();
    let turn_rad = (drive.curvature_per_m * drive.signed_length_m).abs();
    let own_m = drive.signed_length_m.abs() + turn_rad * reach_m;
    let motion_m = own_m + other.motion_m();
    let mut best = near_at(vehicle, drive, other, 0.0);
    let (mut share, mut gap_m) = (0.0, best.gap_m);
    for _ in 0..MAX_LOOKS {
        if gap_m <= TOUCH_M {
            return Encounter {
                nearness: best,
                touches_at: Some(share),
            };
        }
        if share >= 1.0 {
            break;
        }
        let step = if motion_m > 0.0 {
            (gap_m + 0.5 * TOUCH_M) / motion_m
        } else {
            1.0
        };
        share = (share + step).min(1.0);
        let near = near_at(vehicle, drive, other, share);
        gap_m = near.gap_m;
        if near.gap_m < best.gap_m {
            best = near;
        }
    }
    let touches_at = (share < 1.0).then_some(share);
    Encounter {
        nearness: best,
        touches_at,
    }
}

/// The farthest point of a shape from its pose, meters.
fn shape_reach_m(shape: &ObstacleShape) -> f64 {
    match shape {
        ObstacleShape::Disc { radius_m } => *radius_m,
        ObstacleShape::Polygon(corners) => {
            let reach = corners.iter().map(|[x, y]| x.hypot(*y));
            reach.fold(0.0, f64::max)
        }
    }
}

fn near_at(vehicle: &Vehicle, drive: &Drive, other: &Other, share: f64) -> Nearness {
    nearness(vehicle, drive.pose_at(share), &other.at(share))
}

/// The nearest points of a vehicle and a solid.
pub(crate) fn nearness(vehicle: &Vehicle, pose: Pose2, solid: &Solid) -> Nearness {
    let parts = vehicle
        .parts()
        .iter()
        .map(|part| Solid::part(part, pose).nearness(solid));
    let nearest = parts.min_by(|a, b| a.gap_m.total_cmp(&b.gap_m));
    nearest.unwrap_or(Nearness {
        gap_m: f64::INFINITY,
        from: pose.position(),
        to: solid.center(),
        along: Point2::default(),
    })
}

/// The speeds with which a robot and another body come toward each other at their nearest points.
pub(crate) fn closing_mps(
    state: BicycleState,
    wheelbase_m: f64,
    near: &Nearness,
    other_mps: Point2,
) -> [f64; 2] {
    let along = near.along;
    let rate = state.speed_mps * state.steer_rad.tan() / wheelbase_m;
    let arm = near.from - state.pose.position();
    let own = Point2::unit(state.pose.heading) * state.speed_mps + arm.perpendicular() * rate;
    [own.dot(along), -other_mps.dot(along)]
}

/// The contact of a robot in a state with another body.
pub(crate) fn contact(
    (state, wheelbase_m): (BicycleState, f64),
    with: Contacted,
    near: &Nearness,
    (other_mps, t_s): (Point2, f64),
) -> Contact {
    let closing = closing_mps(state, wheelbase_m, near, other_mps);
    let by = match with {
        Contacted::Agent(_) => Culprit::of(state.speed_mps, closing),
        _ => Culprit::Robot,
    };
    Contact {
        t_s,
        with,
        by,
        place: near.to,
        pose: state.pose,
        robot_mps: state.speed_mps,
        robot_closing_mps: closing[0],
        other_closing_mps: closing[1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn contact_is_never_passed_over(
            x in -1.0..1.5_f64, y in -1.0..1.0_f64, heading in -3.1..3.1_f64,
            length_m in -0.6..0.6_f64, curvature in -1.3..1.3_f64, dx in -1.5..1.5_f64, dy in -1.5..1.5_f64,
        ) {
            let vehicle = Vehicle::f1tenth();
            let shape = ObstacleShape::Polygon(vec![[-0.2, -0.1], [0.2, -0.1], [0.2, 0.1], [-0.2, 0.1]]);
            let drive = Drive { start: Pose2::default(), curvature_per_m: curvature, signed_length_m: length_m };
            let (from, to) = (Pose2::new(x, y, heading), Pose2::new(x + dx, y + dy, heading + 0.3));
            let other = Other::Moving { shape: &shape, from, to };
            let found = encounter(&vehicle, &drive, &other);
            let shares = (0..=2000).map(|i| f64::from(i) / 2000.0);
            let first = shares.clone().find(|&s| near_at(&vehicle, &drive, &other, s).gap_m == 0.0);
            let least = shares.map(|s| near_at(&vehicle, &drive, &other, s).gap_m).fold(f64::INFINITY, f64::min);
            match (first, found.touches_at) {
                (Some(dense), Some(at)) => prop_assert!(at <= dense + 1e-3, "{at} {dense}"),
                (Some(dense), None) => prop_assert!(false, "contact at {dense} was passed over"),
                (None, at) => {
                    prop_assert!(at.is_none() || least < 2e-3, "{at:?} {least}");
                    prop_assert!(found.nearness.gap_m >= least - 2e-3);
                }
            }
        }
    }

    #[test]
    fn who_drove_into_whom_is_told_by_speeds_at_the_contact() {
        let near = Nearness {
            gap_m: 0.0,
            from: Point2::new(0.4, 0.0),
            to: Point2::new(0.4, 0.0),
            along: Point2::new(1.0, 0.0),
        };
        let state = |speed_mps| BicycleState {
            speed_mps,
            ..BicycleState::default()
        };
        let by = |robot, other: f64| {
            let other = (Point2::new(other, 0.0), 1.0);
            let with = Contacted::Agent("a".to_owned());
            contact((state(robot), 0.33), with, &near, other).by
        };
        assert_eq!(by(1.0, 0.0), Culprit::Robot);
        assert_eq!(by(1.0, 0.5), Culprit::Robot);
        assert_eq!(by(0.0, -1.0), Culprit::Other);
        assert_eq!(by(-0.5, -1.0), Culprit::Other);
        assert_eq!(by(1.0, -1.0), Culprit::Both);
    }
}
