//! CARMEN logs: lines of words, a message each.
//!
//! `FLASER`, `ROBOTLASER1` and `RAWLASER1` are scans, `ODOM` is odometry; anything else is skipped.
//!
//! Logs written by `GMapping`'s `gfs2log` hold corrected poses in both pose triples of a `FLASER`
//! line. The raw odometry is in them all the same: after each scan, an `ODOM` line
//! repeats the corrected pose G, and the `ODOM` lines that follow are the raw increments composed
//! onto it. With O the last of them before the next scan, the raw motion is G⁻¹ O.

use super::{Log, unpacked};
use crate::error::MappingError;
use crate::scan::LaserScan;
use formicar::Pose2;
use std::f64::consts::{FRAC_PI_2, PI};
use std::str::SplitAsciiWhitespace;

/// A log from the bytes of a CARMEN file, plain or compressed by gzip.
///
/// # Errors
/// A scan that cannot be read, with its line; a log that [`Log::checked`] refuses.
pub fn parse_carmen(bytes: &[u8]) -> Result<Log, MappingError> {
    let bytes = unpacked(bytes)?;
    let mut messages = Vec::new();
    let mut n_lines = 0;
    for (i, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        n_lines = i + 1;
        // Host names may be anything; a message that is no text is none of ours.
        let Ok(line) = std::str::from_utf8(line) else {
            continue;
        };
        let message = message(line).map_err(|problem| MappingError::Line {
            line: i + 1,
            problem,
        })?;
        messages.extend(message);
    }
    assemble(messages).checked(n_lines)
}

enum Message {
    Odometry {
        pose: Pose2,
        time_s: f64,
    },
    Scan {
        scan: LaserScan,
        pose: Option<Pose2>,
    },
}

/// The message of a line; none where the line holds another kind.
fn message(line: &str) -> Result<Option<Message>, String> {
    let mut words = line.split_ascii_whitespace();
    match words.next() {
        Some("ODOM") => odometry(&mut words).map(Some),
        Some("FLASER") => front_laser(&mut words).map(Some),
        Some("ROBOTLASER1") => raw_laser(&mut words, &HasPose::Yes).map(Some),
        Some("RAWLASER1") => raw_laser(&mut words, &HasPose::No).map(Some),
        _ => Ok(None),
    }
}

/// `ODOM x y theta tv rv accel time host time`.
fn odometry(words: &mut SplitAsciiWhitespace<'_>) -> Result<Message, String> {
    let pose = pose(words)?;
    for what in ["tv", "rv", "accel"] {
        number(words, what)?;
    }
    let time_s = number(words, "time")?;
    Ok(Message::Odometry { pose, time_s })
}

/// `FLASER n ranges x y theta odom_x odom_y odom_theta time host time`.
///
/// The first triple is the pose of the sensor. Half a turn is seen, from the right to the left.
fn front_laser(words: &mut SplitAsciiWhitespace<'_>) -> Result<Message, String> {
    let ranges_m = ranges(words)?;
    let pose_of_sensor = pose(words)?;
    pose(words)?;
    let time_s = number(words, "time")?;
    // 181 and 361 beams include both ends of the half turn.
    let n_steps = match ranges_m.len() {
        n if n % 2 == 1 && n > 1 => n - 1,
        n => n.max(1),
    };
    let scan = LaserScan {
        time_s,
        first_angle_rad: -FRAC_PI_2,
        angle_step_rad: if n_steps < 4 {
            0.1
        } else {
            PI / n_steps as f64
        },
        ranges_m,
    };
    Ok(Message::Scan {
        scan,
        pose: Some(pose_of_sensor),
    })
}

#[derive(PartialEq)]
enum HasPose {
    Yes,
    No,
}

/// `type start fov resolution max accuracy mode n ranges m remissions`, then for `ROBOTLASER1`
/// `laser_pose robot_pose tv rv forward side axis`, then `time host time`.
fn raw_laser(words: &mut SplitAsciiWhitespace<'_>, has_pose: &HasPose) -> Result<Message, String> {
    number(words, "type")?;
    let first_angle_rad = number(words, "start angle")?;
    number(words, "field of view")?;
    let angle_step_rad = number(words, "angular resolution")?;
    for what in ["maximum range", "accuracy", "remission mode"] {
        number(words, what)?;
    }
    let ranges_m = ranges(words)?;
    let n_remissions = count(words, "number of remissions")?;
    for _ in 0..n_remissions {
        number(words, "remission")?;
    }
    let pose_of_sensor = match *has_pose {
        HasPose::No => None,
        HasPose::Yes => {
            let found = pose(words)?;
            pose(words)?;
            for what in ["tv", "rv", "forward", "side", "axis"] {
                number(words, what)?;
            }
            Some(found)
        }
    };
    let time_s = number(words, "time")?;
    let scan = LaserScan {
        time_s,
        first_angle_rad,
        angle_step_rad,
        ranges_m,
    };
    let scan = scan.checked().map_err(|error| error.to_string())?;
    Ok(Message::Scan {
        scan,
        pose: pose_of_sensor,
    })
}

fn ranges(words: &mut SplitAsciiWhitespace<'_>) -> Result<Vec<f32>, String> {
    let n_beams = count(words, "number of beams")?;
    if n_beams == 0 || n_beams > LaserScan::MAX_BEAMS {
        return Err(MappingError::BeamCount { n_beams }.to_string());
    }
    (0..n_beams).map(|beam| range(words, beam)).collect()
}

/// A range; NaN and infinity are codes of a sensor here.
fn range(words: &mut SplitAsciiWhitespace<'_>, beam: usize) -> Result<f32, String> {
    let word = words
        .next()
        .ok_or_else(|| format!("range {beam} is missing"))?;
    let range = word.parse::<f32>();
    range.map_err(|_| format!("range {beam}: {word:?} is not a number"))
}

fn count(words: &mut SplitAsciiWhitespace<'_>, what: &str) -> Result<usize, String> {
    let word = words.next().ok_or_else(|| format!("{what} is missing"))?;
    let count = word.parse();
    count.map_err(|_| format!("{what}: {word:?} is not a count"))
}

fn number(words: &mut SplitAsciiWhitespace<'_>, what: &str) -> Result<f64, String> {
    let word = words.next().ok_or_else(|| format!("{what} is missing"))?;
    let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| format!("{what}: {word:?} is not a finite number"))
}

fn pose(words: &mut SplitAsciiWhitespace<'_>) -> Result<Pose2, String> {
    let x = number(words, "x")?;
    let y = number(words, "y")?;
    let heading = number(words, "theta")?;
    let pose = Pose2::new(x, y, heading);
    if x.abs().max(y.abs()) <= 1e7 && heading.abs() <= 1e6 {
        return Ok(pose);
    }
    Err(format!(
        "pose ({x}, {y}) m, {heading} rad; at most 10000 km from the origin"
    ))
}

/// The log of messages in order.
fn assemble(messages: Vec<Message>) -> Log {
    if is_corrected(&messages) {
        return corrected(messages);
    }
    let raw_odometry = odometry_at_scans(&messages);
    let mut log = Log::default();
    let mut poses = Vec::new();
    for message in messages {
        if let Message::Scan { scan, pose } = message {
            log.scans.push(scan);
            poses.push(pose);
        }
    }
    let own: Option<Vec<Pose2>> = poses.into_iter().collect();
    log.odometry = own.or(raw_odometry);
    if log.odometry.is_none() {
        let words = "the log has no odometry: motion comes from the scans alone";
        log.warnings.push(words.to_owned());
    }
    log
}

/// True where nearly every scan is followed by an `ODOM` line that repeats its pose, and half of them
/// do not lie where the `ODOM` line before them says.
fn is_corrected(messages: &[Message]) -> bool {
    let (mut n_scans, mut n_repeats, mut n_moved) = (0, 0, 0);
    for (i, message) in messages.iter().enumerate() {
        let Message::Scan {
            pose: Some(own), ..
        } = message
        else {
            continue;
        };
        let is_at = |neighbor: Option<&Message>| match neighbor {
            Some(Message::Odometry { pose, .. }) => Some(pose == own),
            _ => None,
        };
        n_scans += 1;
        n_repeats += usize::from(is_at(messages.get(i + 1)) == Some(true));
        let before = i.checked_sub(1).and_then(|before| messages.get(before));
        n_moved += usize::from(is_at(before) == Some(false));
    }
    n_scans > 1 && 10 * n_repeats >= 9 * n_scans && 2 * n_moved >= n_scans
}

/// A log of `gfs2log`: corrected poses as reference, the raw increments between them as odometry.
fn corrected(messages: Vec<Message>) -> Log {
    let mut log = Log::default();
    let (mut odometry, mut reference): (Vec<Pose2>, Vec<Pose2>) = (Vec::new(), Vec::new());
    let mut last_odometry = None;
    for message in messages {
        match message {
            Message::Odometry { pose, .. } => last_odometry = Some(pose),
            Message::Scan { scan, pose } => {
                let pose = pose.unwrap_or_default();
                let raw = match (reference.last(), odometry.last(), last_odometry) {
                    (Some(before), Some(sum), Some(now)) => {
                        sum.compose(before.relative(now)).wrapped()
                    }
                    _ => Pose2::default(),
                };
                odometry.push(raw);
                reference.push(pose);
                log.scans.push(scan);
            }
        }
    }
    let runs_back = |pair: &[LaserScan]| pair[1].time_s < pair[0].time_s - Log::MAX_BACK_S;
    if log.scans.windows(2).any(runs_back) {
        // The tools that write such logs do not keep times; the order of the lines is that of the
        // scans.
        let words = "the times of this corrected log run back: scans are numbered instead";
        log.warnings.push(words.to_owned());
        for (i, scan) in log.scans.iter_mut().enumerate() {
            scan.time_s = i as f64;
        }
    }
    log.warnings.push(
        "both poses of the scans are corrected ones: the raw odometry between them is used, the \
         corrected poses serve as reference"
            .to_owned(),
    );
    log.odometry = Some(odometry);
    log.reference = Some(reference);
    log
}

/// Odometry at the time of each scan, between the messages before and after it.
fn odometry_at_scans(messages: &[Message]) -> Option<Vec<Pose2>> {
    let readings: Vec<(f64, Pose2)> = messages
        .iter()
        .filter_map(|message| match message {
            Message::Odometry { pose, time_s } => Some((*time_s, *pose)),
            Message::Scan { .. } => None,
        })
        .collect();
    if readings.is_empty() {
        return None;
    }
    let mut n_before = 0;
    let mut poses = Vec::new();
    for message in messages {
        match message {
            Message::Odometry { .. } => n_before += 1,
            Message::Scan { scan, .. } => poses.push(reading_at(&readings, n_before, scan.time_s)),
        }
    }
    Some(poses)
}

/// The pose at a time, interpolated between the two readings around a place in the file.
fn reading_at(readings: &[(f64, Pose2)], n_before: usize, time_s: f64) -> Pose2 {
    let before = readings[n_before.saturating_sub(1).min(readings.len() - 1)];
    let after = readings[n_before.min(readings.len() - 1)];
    let span_s = after.0 - before.0;
    let share = (time_s - before.0) / span_s;
    if span_s <= 0.0 || !(0.0..=1.0).contains(&share) {
        return before.1;
    }
    let motion = before.1.relative(after.1).wrapped();
    let part = Pose2::new(motion.x * share, motion.y * share, motion.heading * share);
    before.1.compose(part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn odom(x: f64, time: f64) -> String {
        format!("ODOM {x} 0 0 0 0 0 {time} host {time}\n")
    }

    fn flaser(x: f64, time: f64) -> String {
        format!("FLASER 4 1 2 3 4 {x} 0 0 {x} 0 0 {time} host {time}\n")
    }

    #[test]
    fn raw_odometry_is_recovered_from_corrected_logs() {
        let text = [
            flaser(1.0, 1.0),
            odom(1.0, 0.0),
            odom(1.5, 1.5),
            odom(1.9, 2.0),
            flaser(2.0, 2.0),
            odom(2.0, 0.0),
            odom(3.2, 3.0),
            flaser(3.0, 3.0),
            odom(3.0, 0.0),
        ];
        let log = parse_carmen(text.concat().as_bytes()).unwrap();
        let reference: Vec<f64> = log
            .reference
            .as_ref()
            .unwrap()
            .iter()
            .map(|p| p.x)
            .collect();
        assert_eq!(reference, [1.0, 2.0, 3.0]);
        assert!((log.motion(1).unwrap().x - 0.9).abs() < 1e-12);
        assert!((log.motion(2).unwrap().x - 1.2).abs() < 1e-12);
    }

    #[test]
    fn plain_logs_keep_their_odometry() {
        let text = [
            odom(0.0, 0.0),
            flaser(0.5, 1.0),
            odom(0.5, 2.0),
            flaser(1.5, 3.0),
        ]
        .concat();
        let log = parse_carmen(text.as_bytes()).unwrap();
        assert!(log.reference.is_none());
        assert_eq!(log.motion(1).unwrap().x, 1.0);
        assert_eq!(log.scans[0].first_angle_rad, -FRAC_PI_2);
        assert_eq!(log.scans[0].ranges_m, [1.0, 2.0, 3.0, 4.0]);
    }

    #[test]
    fn raw_scans_take_the_odometry_around_them() {
        let raw = "RAWLASER1 0 -1.5 3.0 1.0 81.9 0.01 0 3 1.5 2.5 nan 0 1.5 host 1.5\n";
        let text = [&odom(1.0, 1.0), raw, &odom(2.0, 2.0)].concat();
        assert!(parse_carmen(text.as_bytes()).is_err(), "a step of 1 rad");
        let text = text.replace("3.0 1.0 81.9", "3.0 0.5 81.9");
        let log = parse_carmen(text.as_bytes()).unwrap();
        assert_eq!(log.odometry.unwrap()[0].x, 1.5);
        assert!(log.scans[0].ranges_m[2].is_nan());
        let robot = "ROBOTLASER1 0 -1.5 3.0 0.5 81.9 0.01 0 2 1.5 2.5 1 9 1 2 0.5 1 2 0.5 0 0 0 0 0 \
                     7 host 7";
        let log = parse_carmen(robot.as_bytes()).unwrap();
        assert_eq!(log.odometry.unwrap(), [Pose2::new(1.0, 2.0, 0.5)]);
    }

    #[test]
    fn bad_lines_are_named() {
        let message = |text: &str| parse_carmen(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(message("# x\nFLASER 3 1 2\n"), "line 2: range 2 is missing");
        assert!(message("FLASER 99999999999 1").contains("99999999999 beams"));
        assert!(message("hello").contains("no laser scan"));
        assert!(message("ODOM a 0 0 0 0 0 1 h 1").contains("x: \"a\" is not a finite number"));
    }

    proptest! {
        #[test]
        fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = parse_carmen(&bytes);
        }

        #[test]
        fn no_words_make_it_panic(words in prop::collection::vec(
            prop_oneof![Just("FLASER"), Just("ODOM"), Just("\n"), Just("RAWLASER1"), Just("2"),
                        Just("ROBOTLASER1"), Just("1e300"), Just("-1"), Just("0.5"), Just("nan")],
            0..120,
        )) {
            let _ = parse_carmen(words.join(" ").as_bytes());
        }
    }
}
