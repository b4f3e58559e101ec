//! Drives through a building: poses, scans with people in them, and odometry that errs.

use super::office::Office;
use crate::log::Log;
use crate::scan::LaserScan;
use formicar::numeric::RandomStream;
use formicar::{Point2, Pose2, Seed};
use std::f64::consts::{FRAC_PI_2, PI};

/// Sensor, odometry and people of a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveRule {
    /// Seed of noise, people and of the rooms that are visited.
    pub seed: Seed,
    /// People who walk in the corridor.
    pub n_people: usize,
    /// Rounds through the corridor.
    pub n_laps: usize,
    /// Rooms visited per round.
    pub n_visits: usize,
    /// Way between scans, meters.
    pub step_m: f64,
    /// Number of beams over half a turn.
    pub n_beams: usize,
    /// Noise of ranges: standard deviation at 0 m, and its growth per meter.
    pub range_noise: (f64, f64),
    /// Mean error of the odometry per step, meters and radians.
    pub odometry_error: (f64, f64),
    /// The sign with which the odometry reports driving in reverse.
    pub reverse: ReverseSign,
}

/// The odometry's sign in reverse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReverseSign {
    /// As it is.
    Right,
    /// Forward, a fault that real logs have.
    Wrong,
}

impl Default for DriveRule {
    fn default() -> Self {
        Self {
            seed: Seed(1),
            n_people: 0,
            n_laps: 2,
            n_visits: 11,
            step_m: 0.3,
            n_beams: 180,
            range_noise: (0.01, 0.002),
            odometry_error: (0.010, 1_f64.to_radians()),
            reverse: ReverseSign::Right,
        }
    }
}

/// A drive: a log whose reference poses are true, and the beams that ended on a person.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Scans, odometry, and the true poses as reference.
    pub log: Log,
    /// For each scan and beam, true where the beam ended on a person.
    pub on_person: Vec<Vec<bool>>,
}

/// The code for "no return", meters, as of a SICK LMS.
const NO_RETURN_M: f32 = 81.91;
/// Ranges beyond this are none, meters.
const SENSOR_REACH_M: f64 = 50.0;
/// Radius of a person, meters.
const PERSON_M: f64 = 0.2;
/// Speed of robot and people, meters per second.
const SPEEDS: (f64, f64) = (0.5, 1.1);
/// Largest turn between scans, radians.
const MAX_TURN: f64 = 0.26;

impl Drive {
    /// Drives through a building.
    pub fn new(office: &Office, rule: &DriveRule) -> Self {
        let poses = route(office, rule);
        let people = People::new(rule);
        let mut scans = Vec::with_capacity(poses.len());
        let mut on_person = Vec::with_capacity(poses.len());
        for (i, &pose) in poses.iter().enumerate() {
            let time_s = i as f64 * rule.step_m / SPEEDS.0;
            let discs = people.at(time_s, pose.position());
            let mut random = rule.seed.stream([2, i as u64]);
            let (scan, hits) = scan(office, &discs, (pose, time_s), rule, &mut random);
            scans.push(scan);
            on_person.push(hits);
        }
        let log = Log {
            scans,
            odometry: Some(odometry(&poses, rule)),
            reference: Some(poses),
            warnings: Vec::new(),
        };
        Self { log, on_person }
    }
}

/// The poses of a drive: rounds through the corridor with visits to rooms.
fn route(office: &Office, rule: &DriveRule) -> Vec<Pose2> {
    let ring = Office::ring();
    let mut random = rule.seed.stream([3, 0]);
    let mut points = vec![ring[0]];
    for _ in 0..rule.n_laps {
        let mut chosen: Vec<usize> = (0..office.rooms.len()).collect();
        // The first of a random order.
        for i in 0..rule.n_visits.min(chosen.len()) {
            let j = i + random.below(chosen.len() - i);
            chosen.swap(i, j);
        }
        chosen.truncate(rule.n_visits);
        for side in 0..4 {
            let (from, to) = (ring[side], ring[(side + 1) % 4]);
            let length = from.distance(to);
            let along = (to - from) * (1.0 / length);
            let mut stops: Vec<(f64, usize)> = chosen
                .iter()
                .map(|&room| (room, office.rooms[room].before_door - from))
                .filter(|(_, d)| along.cross(*d).abs() < 1e-6)
                .map(|(room, d)| (along.dot(d), room))
                .filter(|(at, _)| (0.0..=length).contains(at))
                .collect();
            stops.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (_, room) in stops {
                let room = &office.rooms[room];
                points.extend([room.before_door, room.inside, room.before_door]);
            }
            points.push(to);
        }
    }
    poses_along(&points, rule, &mut random)
}

/// Poses at most a step apart along a polyline; one turn in three into a way back is left out, and
/// the robot drives in reverse.
fn poses_along(points: &[Point2], rule: &DriveRule, random: &mut RandomStream) -> Vec<Pose2> {
    let mut pose = Pose2::at(points[0], 0.0);
    let mut poses = vec![pose];
    for &target in &points[1..] {
        let d = target - pose.position();
        if d.norm() < 1e-9 {
            continue;
        }
        let direction = d.angle();
        let turn_to = |heading: f64| formicar::geometry::wrap_angle(heading - pose.heading);
        let is_back = turn_to(direction).abs() > 3.0;
        let heading = if is_back && random.unit() < 0.33 {
            direction + PI
        } else {
            direction
        };
        let turn = turn_to(heading);
        let n_turns = (turn.abs() / MAX_TURN).ceil() as usize;
        for i in 1..=n_turns {
            let part = turn * i as f64 / n_turns as f64;
            poses.push(Pose2::at(pose.position(), pose.heading + part));
        }
        let n_steps = (d.norm() / rule.step_m).ceil().max(1.0) as usize;
        let start = pose.position();
        pose.heading += turn;
        for i in 1..=n_steps {
            let place = start.lerp(target, i as f64 / n_steps as f64);
            // No one drives on a ruler.
            let sway = 0.03 * (i as f64 * 0.9).sin();
            poses.push(Pose2::at(place, pose.heading + sway));
        }
        pose = Pose2::at(target, pose.heading);
    }
    poses.into_iter().map(Pose2::wrapped).collect()
}

fn scan(
    office: &Office,
    people: &[Point2],
    (pose, time_s): (Pose2, f64),
    rule: &DriveRule,
    random: &mut RandomStream,
) -> (LaserScan, Vec<bool>) {
    let angle_step_rad = PI / rule.n_beams as f64;
    let mut ranges_m = Vec::with_capacity(rule.n_beams);
    let mut on_person = Vec::with_capacity(rule.n_beams);
    for beam in 0..rule.n_beams {
        let along = Point2::unit(pose.heading - FRAC_PI_2 + angle_step_rad * beam as f64);
        let wall = office.world.range_m(pose.position(), along, SENSOR_REACH_M);
        let person = people
            .iter()
            .filter_map(|&center| disc_range(pose.position(), along, center))
            .fold(f64::INFINITY, f64::min);
        let is_person = person < wall.unwrap_or(f64::INFINITY);
        on_person.push(is_person);
        let range = if is_person { Some(person) } else { wall };
        let noise = random.normal();
        ranges_m.push(range.map_or(NO_RETURN_M, |range| {
            let (base, slope) = rule.range_noise;
            let measured = range + noise * (base + slope * range);
            // SICK scanners report centimeters.
            ((measured * 100.0).round() / 100.0).max(0.01) as f32
        }));
    }
    let scan = LaserScan {
        time_s,
        first_angle_rad: -FRAC_PI_2,
        angle_step_rad,
        ranges_m,
    };
    (scan, on_person)
}

/// The length of a ray up to a person's outline.
fn disc_range(from: Point2, along: Point2, center: Point2) -> Option<f64> {
    let d = center - from;
    let (ahead, aside) = (along.dot(d), along.cross(d));
    let depth = PERSON_M * PERSON_M - aside * aside;
    (depth > 0.0 && ahead > PERSON_M).then(|| ahead - depth.sqrt())
}

/// Dead reckoning: true motions with noise, and a bias that a drive keeps.
fn odometry(poses: &[Pose2], rule: &DriveRule) -> Vec<Pose2> {
    let mut bias = rule.seed.stream([4, 0]);
    let length_bias = bias.range(-0.01, 0.01);
    let turn_bias = bias.range(-0.1, 0.1) * rule.odometry_error.1;
    // The mean length of a normal vector in the plane is 1.253 sigma, the mean of its absolute
    // value on a line 0.798 sigma.
    let (sigma_m, sigma_rad) = (rule.odometry_error.0 / 1.253, rule.odometry_error.1 / 0.798);
    let mut sum = Pose2::default();
    let mut out = vec![sum];
    for (i, pair) in poses.windows(2).enumerate() {
        let mut random = rule.seed.stream([5, i as u64]);
        let motion = pair[0].relative(pair[1]).wrapped();
        let sign = match rule.reverse {
            ReverseSign::Wrong if motion.x < -0.05 => -1.0,
            _ => 1.0,
        };
        let noisy = Pose2::new(
            sign * motion.x * (1.0 + length_bias) + sigma_m * random.normal(),
            motion.y + sigma_m * random.normal(),
            motion.heading + turn_bias + sigma_rad * random.normal(),
        );
        sum = sum.compose(noisy).wrapped();
        out.push(sum);
    }
    out
}

/// People who walk around the corridor, in both directions, off its center line.
struct People {
    walkers: Vec<Walker>,
}

struct Walker {
    start_m: f64,
    speed_mps: f64,
    offset_m: f64,
}

impl People {
    fn new(rule: &DriveRule) -> Self {
        let mut random = rule.seed.stream([6, 0]);
        let walkers = (0..rule.n_people).map(|i| Walker {
            start_m: random.range(0.0, 130.0),
            speed_mps: SPEEDS.1 * random.range(0.6, 1.2) * if i % 2 == 0 { 1.0 } else { -1.0 },
            offset_m: random.range(0.45, 0.85) * if i % 2 == 0 { 1.0 } else { -1.0 },
        });
        Self {
            walkers: walkers.collect(),
        }
    }

    /// Their places, without those who would touch the robot: they step aside.
    fn at(&self, time_s: f64, robot: Point2) -> Vec<Point2> {
        let ring = Office::ring();
        let sides: [f64; 4] = std::array::from_fn(|i| ring[i].distance(ring[(i + 1) % 4]));
        let around: f64 = sides.iter().sum();
        let place = |walker: &Walker| {
            let mut at = (walker.start_m + walker.speed_mps * time_s).rem_euclid(around);
            let mut side = 0;
            while side < 3 && at > sides[side] {
                at -= sides[side];
                side += 1;
            }
            let along = (ring[(side + 1) % 4] - ring[side]) * (1.0 / sides[side]);
            ring[side] + along * at + along.perpendicular() * walker.offset_m
        };
        let places = self.walkers.iter().map(place);
        places.filter(|p| p.distance(robot) > 0.5).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drive_is_long_repeats_itself_and_errs_as_stated() {
        let office = Office::new(Seed(1));
        let rule = DriveRule::default();
        let poses = route(&office, &rule);
        let length: f64 = poses
            .windows(2)
            .map(|p| p[0].position().distance(p[1].position()))
            .sum();
        assert!(length > 380.0, "{length} m");
        let odometry = odometry(&poses, &rule);
        let errors = |of: fn(Pose2) -> f64| {
            let steps = poses.windows(2).zip(odometry.windows(2));
            let errors = steps.map(|(truth, odo)| {
                let truth = truth[0].relative(truth[1]).wrapped();
                of(truth.relative(odo[0].relative(odo[1])).wrapped())
            });
            errors.sum::<f64>() / (poses.len() - 1) as f64
        };
        let mean_m = errors(|e| e.position().norm());
        let mean_deg = errors(|e| e.heading.abs()).to_degrees();
        assert!((0.009..0.012).contains(&mean_m), "{mean_m}");
        assert!((0.9..1.1).contains(&mean_deg), "{mean_deg}");
        let way_off_walls = poses.iter().map(|p| office.world.distance_m(p.position()));
        assert!(way_off_walls.fold(f64::INFINITY, f64::min) > 0.35);
    }

    #[test]
    fn people_are_seen_and_marked() {
        let office = Office::new(Seed(2));
        let rule = DriveRule {
            n_people: 8,
            n_laps: 1,
            n_visits: 0,
            ..DriveRule::default()
        };
        let drive = Drive::new(&office, &rule);
        let n_marked: usize = drive.on_person.iter().flatten().filter(|hit| **hit).count();
        let share = n_marked as f64 / (180 * drive.log.scans.len()) as f64;
        assert!((0.002..0.1).contains(&share), "{share}");
        let same = Drive::new(&office, &rule);
        assert_eq!(drive.log, same.log);
        let alone = Drive::new(
            &office,
            &DriveRule {
                n_people: 0,
                ..rule
            },
        );
        let is_shorter = |i: usize, beam: usize| {
            drive.log.scans[i].ranges_m[beam] < alone.log.scans[i].ranges_m[beam] + 0.02
        };
        for (i, beams) in drive.on_person.iter().enumerate() {
            assert!(
                beams
                    .iter()
                    .enumerate()
                    .all(|(b, hit)| !hit || is_shorter(i, b))
            );
        }
    }
}
