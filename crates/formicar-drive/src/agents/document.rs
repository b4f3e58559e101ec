//! Agents as users write them down.

use crate::error::{SetupError, in_range};
use formicar::scenario::{
    MovingObstacle, ObstacleMotion, ObstacleShape, Predicted, Predictions, TimedWaypoint,
};
use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};

/// Name and version of the document of agents.
pub const AGENTS_SCHEMA: &str = "formicar/agents/1";
/// Agents that heed nobody move for so long, seconds; then they stand.
const SCRIPT_S: f64 = 600.0;

/// Agents as a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AgentsDocument {
    /// Name and version of this document: `formicar/agents/1`; may be left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// The agents.
    pub agents: Vec<Agent>,
}

/// Something that moves in the world.
///
/// ```
/// use formicar_drive::Agent;
///
/// let text = r#"{"name": "ann", "shape": {"disc": {"radius_m": 0.25}},
///     "behavior": {"walker": {"position": [3, 2], "speed_mps": 1.2, "yields": true}}}"#;
/// let agent: Agent = serde_json::from_str(text).unwrap();
/// assert!(agent.check("1").is_ok());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Agent {
    /// Its name in messages and pictures; its number where left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its body.
    pub shape: ObstacleShape,
    /// What it does.
    pub behavior: AgentBehavior,
}

/// What an agent does; headings in radians.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum AgentBehavior {
    /// Poses at given times, evenly in between, for up to 600 s; it heeds nobody.
    Scripted(Vec<TimedWaypoint>),
    /// A constant velocity, for 600 s; it heeds nobody.
    Velocity {
        /// Pose at the beginning, `[x, y, heading]`.
        pose: [f64; 3],
        /// Meters per second along the axes of the map.
        velocity_mps: [f64; 2],
    },
    /// A person who walks from one random place in sight to the next, by social forces (Helbing and
    /// Molnar 1995).
    Walker {
        /// Place at the beginning, `[x, y]`.
        position: [f64; 2],
        /// Wished speed, meters per second.
        speed_mps: f64,
        /// True for one who makes way for the robot.
        yields: bool,
    },
    /// A cart that drives along a line to and fro.
    Cart {
        /// Its line, `[x, y]` each, at least two.
        waypoints: Vec<[f64; 2]>,
        /// Meters per second.
        speed_mps: f64,
        /// True for one that stops before the robot.
        yields: bool,
    },
}

impl Agent {
    /// A person of 0.25 m radius.
    pub fn walker(position: Point2, speed_mps: f64, yields: bool) -> Self {
        Self {
            name: None,
            shape: ObstacleShape::Disc { radius_m: 0.25 },
            behavior: AgentBehavior::Walker {
                position: [position.x, position.y],
                speed_mps,
                yields,
            },
        }
    }

    /// Checks its numbers; `name` is used in messages where it has none of its own.
    ///
    /// # Errors
    /// Numbers that are not finite or out of range, a body that is not convex, times that run back,
    /// a cart without a line.
    pub fn check(&self, name: &str) -> Result<(), SetupError> {
        self.predicted(name).map(|_| ())?;
        if let AgentBehavior::Walker { speed_mps, .. } | AgentBehavior::Cart { speed_mps, .. } =
            self.behavior
        {
            in_range("agent speed_mps", speed_mps, 0.0..=20.0, "0 to 20 m/s")?;
        }
        match &self.behavior {
            AgentBehavior::Cart { waypoints, .. } if waypoints.len() < 2 => {
                Err(SetupError::Contradiction {
                    what: "cart waypoints",
                    problem: format!("{} of them", waypoints.len()),
                    hint: "a cart drives between at least two; one that stands is a script of one pose",
                })
            }
            _ => Ok(()),
        }
    }

    /// Its beginning and, where it is scripted, its motion.
    pub(super) fn predicted(&self, name: &str) -> Result<Predicted, SetupError> {
        let standing = |pose: [f64; 3]| ObstacleMotion::Velocity {
            pose,
            velocity_mps: [0.0; 2],
        };
        let motion = match &self.behavior {
            AgentBehavior::Scripted(points) => ObstacleMotion::Waypoints(points.clone()),
            AgentBehavior::Velocity { pose, velocity_mps } => ObstacleMotion::Velocity {
                pose: *pose,
                velocity_mps: *velocity_mps,
            },
            AgentBehavior::Walker {
                position: [x, y], ..
            } => standing([*x, *y, 0.0]),
            AgentBehavior::Cart { waypoints, .. } => {
                for &[x, y] in waypoints {
                    self.obstacle(name, standing([x, y, 0.0]))?;
                }
                standing(cart_start(waypoints))
            }
        };
        self.obstacle(name, motion)
    }

    fn obstacle(&self, name: &str, motion: ObstacleMotion) -> Result<Predicted, SetupError> {
        let obstacle = MovingObstacle {
            name: Some(self.name.clone().unwrap_or_else(|| name.to_owned())),
            shape: self.shape.clone(),
            motion,
            growth_mps: 0.0,
        };
        let predictions = Predictions::new(vec![obstacle], SCRIPT_S)?;
        let first = predictions.obstacles().first().cloned();
        Ok(first.expect("one obstacle in, one out"))
    }
}

/// A cart at the first point of its line, facing the second.
fn cart_start(waypoints: &[[f64; 2]]) -> [f64; 3] {
    let at = |i: usize| {
        waypoints
            .get(i)
            .map_or(Point2::default(), |&[x, y]| Point2::new(x, y))
    };
    let (a, b) = (at(0), at(1));
    [a.x, a.y, (b - a).angle()]
}

/// A pose as three numbers.
pub(super) fn pose_of(position: Point2, heading: f64) -> Pose2 {
    Pose2::at(position, heading)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        let agent: Agent = serde_json::from_str(text).unwrap();
        agent.check("7").unwrap_err().to_string()
    }

    #[test]
    fn agents_that_make_no_sense_are_refused_by_name() {
        let disc = r#""shape": {"disc": {"radius_m": 0.2}}"#;
        let slow = fault(&format!(
            r#"{{{disc}, "behavior": {{"walker": {{"position": [1, 1], "speed_mps": -1, "yields": true}}}}}}"#
        ));
        assert!(slow.contains("speed_mps = -1"), "{slow}");
        let back = fault(&format!(
            r#"{{{disc}, "behavior": {{"scripted": [{{"t_s": 2, "pose": [0, 0, 0]}}, {{"t_s": 1, "pose": [1, 0, 0]}}]}}}}"#
        ));
        assert!(
            back.contains("obstacle 7") && back.contains("times must rise"),
            "{back}"
        );
        let cart = fault(&format!(
            r#"{{{disc}, "behavior": {{"cart": {{"waypoints": [[1, 1]], "speed_mps": 1, "yields": false}}}}}}"#
        ));
        assert!(cart.contains("at least two"), "{cart}");
        let flat = fault(
            r#"{"name": "bob", "shape": {"disc": {"radius_m": 0}}, "behavior": {"velocity": {"pose": [0, 0, 0], "velocity_mps": [1, 0]}}}"#,
        );
        assert!(flat.contains("bob") && flat.contains("radius_m"), "{flat}");
    }
}
