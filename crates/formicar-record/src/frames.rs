//! Coordinate frames and the transforms between them over time.

use crate::error::RecordError;
use crate::messages::{Pose, Quaternion, Transform, TransformStamped};
use formicar::Pose2;
use std::collections::BTreeMap;

/// A rigid motion in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose3 {
    /// Meters.
    position: [f64; 3],
    /// x, y, z, w; of length 1.
    turn: [f64; 4],
}

impl Pose3 {
    const IDENTITY: Self = Self {
        position: [0.0; 3],
        turn: [0.0, 0.0, 0.0, 1.0],
    };

    /// A pose in the plane.
    pub(crate) fn of_plane(pose: Pose2) -> Self {
        let (z, w) = (0.5 * pose.heading).sin_cos();
        Self {
            position: [pose.x, pose.y, 0.0],
            turn: [0.0, 0.0, z, w],
        }
    }

    /// From a message; none where numbers are not finite or the quaternion is none.
    pub(crate) fn new(position: [f64; 3], turn: &Quaternion) -> Option<Self> {
        const TOLERANCE: f64 = 0.01;
        let turn = [turn.x, turn.y, turn.z, turn.w];
        let norm = turn.iter().map(|v| v * v).sum::<f64>().sqrt();
        let is_sound = position.iter().all(|v| v.abs() < 1e9) && (norm - 1.0).abs() <= TOLERANCE;
        is_sound.then(|| Self {
            position,
            turn: turn.map(|v| v / norm),
        })
    }

    pub(crate) fn of_transform(transform: &Transform) -> Option<Self> {
        let p = &transform.translation;
        Self::new([p.x, p.y, p.z], &transform.rotation)
    }

    pub(crate) fn of_pose(pose: &Pose) -> Option<Self> {
        let p = &pose.position;
        Self::new([p.x, p.y, p.z], &pose.orientation)
    }

    /// This motion after another one in its frame.
    pub(crate) fn compose(self, next: Self) -> Self {
        let [x, y, z, w] = self.turn;
        let [a, b, c, d] = next.turn;
        let turned = self.turned(next.position);
        Self {
            position: [0, 1, 2].map(|i| self.position[i] + turned[i]),
            turn: [
                w * a + x * d + y * c - z * b,
                w * b - x * c + y * d + z * a,
                w * c + x * b - y * a + z * d,
                w * d - x * a - y * b - z * c,
            ],
        }
    }

    fn inverse(self) -> Self {
        let [x, y, z, w] = self.turn;
        let back = Self {
            position: [0.0; 3],
            turn: [-x, -y, -z, w],
        };
        Self {
            position: back.turned(self.position).map(|v| -v),
            ..back
        }
    }

    /// A vector in the frame around this one.
    pub(crate) fn turned(self, [vx, vy, vz]: [f64; 3]) -> [f64; 3] {
        let [x, y, z, w] = self.turn;
        // v + 2 w (q x v) + 2 q x (q x v).
        let t = [
            2.0 * (y * vz - z * vy),
            2.0 * (z * vx - x * vz),
            2.0 * (x * vy - y * vx),
        ];
        [
            vx + w * t[0] + y * t[2] - z * t[1],
            vy + w * t[1] + z * t[0] - x * t[2],
            vz + w * t[2] + x * t[1] - y * t[0],
        ]
    }

    /// Position and heading of the x axis in the plane.
    pub(crate) fn in_plane(self) -> Pose2 {
        let [x, y, _] = self.turned([1.0, 0.0, 0.0]);
        Pose2::new(self.position[0], self.position[1], y.atan2(x))
    }

    /// Between this pose (0) and another (1).
    fn between(self, to: Self, share: f64) -> Self {
        let dot: f64 = (0..4).map(|i| self.turn[i] * to.turn[i]).sum();
        let sign = if dot < 0.0 { -1.0 } else { 1.0 };
        let mix = |a: f64, b: f64| a + share * (b - a);
        let turn = [0, 1, 2, 3].map(|i| mix(self.turn[i], sign * to.turn[i]));
        let norm = turn.iter().map(|v| v * v).sum::<f64>().sqrt();
        Self {
            position: [0, 1, 2].map(|i| mix(self.position[i], to.position[i])),
            turn: turn.map(|v| v / norm.max(1e-9)),
        }
    }
}

/// Poses over time, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct PoseTrack(Vec<(f64, Pose3)>);

/// Beyond its first and last pose a track is believed for so long, seconds.
const HOLD_S: f64 = 0.2;

impl PoseTrack {
    pub(crate) fn push(&mut self, time_s: f64, pose: Pose3) {
        self.0.push((time_s, pose));
    }

    /// Sorts by time.
    pub(crate) fn sort(&mut self) {
        self.0.sort_by(|a, b| a.0.total_cmp(&b.0));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The pose at a time, between the two around it; none beyond both ends.
    pub(crate) fn at(&self, time_s: f64) -> Option<Pose3> {
        let after = self.0.partition_point(|(t, _)| *t <= time_s);
        let before = after.checked_sub(1).and_then(|i| self.0.get(i));
        match (before, self.0.get(after)) {
            (Some(&(t0, a)), Some(&(t1, b))) => {
                let share = if t1 > t0 {
                    (time_s - t0) / (t1 - t0)
                } else {
                    0.0
                };
                Some(a.between(b, share))
            }
            (Some(&(t, pose)), None) | (None, Some(&(t, pose))) => {
                ((t - time_s).abs() <= HOLD_S).then_some(pose)
            }
            (None, None) => None,
        }
    }
}

/// The frame above a frame, and where it is there.
#[derive(Clone, Debug)]
struct Link {
    parent: String,
    /// Static transforms hold at all times.
    fixed: Option<Pose3>,
    moving: PoseTrack,
}

/// The tree of frames of a bag.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frames(BTreeMap<String, Link>);

/// Names of frames without the slash of ROS 1.
pub(crate) fn plain(frame: &str) -> &str {
    frame.trim_start_matches('/')
}

/// Frames above each other; more are a circle.
const MAX_DEPTH: usize = 64;

impl Frames {
    /// Adds a transform; those of static topics hold at all times.
    ///
    /// # Errors
    /// Numbers that are no transform, a frame below itself or below two others.
    pub(crate) fn add(
        &mut self,
        topic: &str,
        transform: &TransformStamped,
        is_static: bool,
    ) -> Result<(), RecordError> {
        let time_s = transform.header.stamp.seconds();
        let (child, parent) = (
            plain(&transform.child_frame_id),
            plain(&transform.header.frame_id),
        );
        let refused = |what, value: String, limit| RecordError::Value {
            topic: topic.to_owned(),
            time_s,
            what,
            value,
            limit,
        };
        let Some(pose) = Pose3::of_transform(&transform.transform) else {
            let value = format!("of {child:?}: {:?}", transform.transform);
            let limit = "the quaternion must be of length 1, everything finite";
            return Err(refused("the transform", value, limit));
        };
        let link = self.0.entry(child.to_owned()).or_insert_with(|| Link {
            parent: parent.to_owned(),
            fixed: None,
            moving: PoseTrack::default(),
        });
        if link.parent != parent || child == parent {
            let value = format!("{child:?} below {parent:?} and {:?}", link.parent);
            let limit = "a frame has one parent, which is another frame";
            return Err(refused("the frame", value, limit));
        }
        if is_static {
            link.fixed = Some(pose);
        } else {
            link.moving.push(time_s, pose);
        }
        Ok(())
    }

    /// Sorts all transforms by time.
    pub(crate) fn sort(&mut self) {
        self.0.values_mut().for_each(|link| link.moving.sort());
    }

    /// The frames above a frame, itself first.
    fn above<'a>(&'a self, frame: &'a str) -> Vec<&'a str> {
        let mut chain = vec![frame];
        while let Some(link) = chain.last().and_then(|last| self.0.get(*last))
            && chain.len() < MAX_DEPTH
        {
            chain.push(&link.parent);
        }
        chain
    }

    /// The frame `odom` of odometry above a frame, and the one below it in the chain; without such a
    /// chain, the first frame right below an `odom`.
    pub(crate) fn odometry(&self, frame: &str) -> Option<(String, String)> {
        let is_odom = |name: &str| name == "odom" || name.ends_with("/odom");
        let chain = self.above(frame);
        let above = chain.windows(2).find(|pair| is_odom(pair[1]));
        if let Some(pair) = above {
            return Some((pair[1].to_owned(), pair[0].to_owned()));
        }
        let other = self.0.iter().find(|(_, link)| is_odom(&link.parent));
        other.map(|(child, link)| (link.parent.clone(), child.clone()))
    }

    /// The frame at the top of the chain above a frame.
    pub(crate) fn root(&self, frame: &str) -> String {
        self.above(frame)
            .last()
            .copied()
            .unwrap_or(frame)
            .to_owned()
    }

    /// The pose of `frame` in `target` at a time.
    ///
    /// # Errors
    /// Frames that are not connected at this time, as the reason.
    pub(crate) fn pose_in(&self, frame: &str, target: &str, time_s: f64) -> Result<Pose3, String> {
        let (up, down) = (self.above(frame), self.above(target));
        let Some(&joint) = up.iter().find(|name| down.contains(name)) else {
            let (a, b) = (up.last().unwrap_or(&frame), down.last().unwrap_or(&target));
            return Err(format!("the first ends at {a:?}, the second at {b:?}"));
        };
        let to_joint = |chain: &[&str]| {
            let links = chain.iter().take_while(|name| **name != joint);
            let mut pose = Pose3::IDENTITY;
            for name in links {
                let link = self.0.get(*name);
                let step = link.and_then(|link| link.fixed.or_else(|| link.moving.at(time_s)));
                let step =
                    step.ok_or_else(|| format!("{name:?} has no transform at {time_s} s"))?;
                pose = step.compose(pose);
            }
            Ok::<_, String>(pose)
        };
        Ok(to_joint(&down)?.inverse().compose(to_joint(&up)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::{Header, Time};
    use std::f64::consts::{FRAC_PI_2, PI};

    fn link(parent: &str, child: &str, pose: Pose2, time_s: i32) -> TransformStamped {
        TransformStamped {
            header: Header::new(
                parent,
                Time {
                    sec: time_s,
                    nanosec: 0,
                },
            ),
            child_frame_id: child.to_owned(),
            transform: pose.into(),
        }
    }

    fn robot() -> Frames {
        let mut frames = Frames::default();
        let mut add =
            |link: TransformStamped, is_static| frames.add("/tf", &link, is_static).unwrap();
        add(
            link("base_footprint", "base_link", Pose2::default(), 0),
            true,
        );
        add(
            link("base_link", "/laser", Pose2::new(0.2, 0.0, FRAC_PI_2), 0),
            true,
        );
        add(
            link("odom", "base_footprint", Pose2::new(0.0, 0.0, 0.0), 10),
            false,
        );
        add(
            link(
                "odom",
                "base_footprint",
                Pose2::new(2.0, 0.0, FRAC_PI_2),
                12,
            ),
            false,
        );
        frames.sort();
        frames
    }

    #[test]
    fn chains_are_followed_and_interpolated() {
        let frames = robot();
        let mount = frames
            .pose_in("laser", "base_footprint", 0.0)
            .unwrap()
            .in_plane();
        assert!((mount.x - 0.2).abs() < 1e-12 && (mount.heading - FRAC_PI_2).abs() < 1e-12);
        let pose = frames.pose_in("laser", "odom", 11.0).unwrap().in_plane();
        let half = 0.25 * PI;
        assert!((pose.x - (1.0 + 0.2 * half.cos())).abs() < 1e-9, "{pose:?}");
        assert!((pose.heading - (half + FRAC_PI_2)).abs() < 1e-9);
        let back = frames.pose_in("odom", "laser", 11.0).unwrap();
        let round = back.compose(frames.pose_in("laser", "odom", 11.0).unwrap());
        assert!(round.in_plane().position().norm() < 1e-12);
        assert_eq!(frames.odometry("laser").unwrap().1, "base_footprint");
        assert_eq!(frames.root("laser"), "odom");
    }

    #[test]
    fn gaps_are_named() {
        let frames = robot();
        let late = frames.pose_in("laser", "odom", 20.0).unwrap_err();
        assert!(
            late.contains("\"base_footprint\" has no transform at 20 s"),
            "{late}"
        );
        let alone = frames.pose_in("camera", "odom", 11.0).unwrap_err();
        assert!(alone.contains("ends at \"camera\""), "{alone}");
    }

    #[test]
    fn trees_only() {
        let mut frames = robot();
        let mut bad = |l: TransformStamped| frames.add("/tf", &l, true).unwrap_err().to_string();
        assert!(bad(link("map", "laser", Pose2::default(), 0)).contains("one parent"));
        let mut flat = link("a", "b", Pose2::default(), 0);
        flat.transform.rotation = Quaternion::default();
        assert!(bad(flat).contains("length 1"));
        let mut circle = Frames::default();
        for (parent, child) in [("a", "b"), ("b", "a")] {
            circle
                .add("/tf", &link(parent, child, Pose2::default(), 0), true)
                .unwrap();
        }
        assert!(circle.pose_in("a", "c", 0.0).is_err());
    }
}
