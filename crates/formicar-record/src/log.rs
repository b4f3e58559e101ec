//! The lidar log of a bag: scans, odometry at each of them, the laser's place on the robot.

use crate::bag::Bag;
use crate::beams::{Mount, scan_of, turned};
use crate::error::RecordError;
use crate::frames::{Frames, Pose3, PoseTrack, plain};
use crate::messages::{LaserScan as ScanMessage, Odometry, TFMessage};
use crate::ride::{Motion, Ride};
use formicar::Pose2;
use formicar_mapping::{LaserScan, Log};
use std::io::{Read, Seek};

/// What a log is made of, where a bag leaves a choice or a gap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogOptions {
    /// The topic of the scans.
    pub scan_topic: Option<String>,
    /// The topic of the odometry; one of transforms takes it from the frame `odom`.
    pub odometry_topic: Option<String>,
    /// The laser's pose on the robot, in place of the one of the transforms: meters, radians.
    pub laser_pose: Option<Pose2>,
    /// Leaves the odometry out, and with it the laser's place on the robot.
    pub no_odometry: bool,
}

/// The most ranges of a log: 4 GiB of them.
const MAX_RANGES: usize = 1 << 30;

/// The log of a bag: the same value that a log in CARMEN's format gives.
///
/// Scans are taken in the order of their recording, at the time in their header (of the recording,
/// where no header has one). Ranges out of the limits of their message become infinite (beyond) or 0
/// (below). Scans that run clockwise, and those of a laser that is mounted upside down, are turned
/// around. The odometry is interpolated to the time of each scan; scans taken over 0.2 s before its
/// begin or after its end are left out, and a warning says how many.
///
/// # Errors
/// No scans, several topics that would do, frames that are not connected, a laser that is tilted, and
/// whatever [`Log::checked`] refuses.
pub fn read_log<R: Read + Seek>(
    bag: &mut Bag<R>,
    options: &LogOptions,
) -> Result<Log, RecordError> {
    let scan_topic = bag.topic_of::<ScanMessage>(options.scan_topic.as_deref(), "--scan-topic")?;
    let odometry_topic = odometry_topic(bag, options)?;
    let contents = Contents::read(bag, &scan_topic, odometry_topic.as_deref())?;
    let (scans, frame) = contents.scans(&scan_topic)?;
    let mut log = Log {
        warnings: bag.warnings().to_vec(),
        ..Log::default()
    };
    if contents.is_unstamped() {
        let words = "the scans have no times in their headers: those of the recording are used";
        log.warnings.push(words.to_owned());
    }
    let ride = contents.ride(&frame, options);
    if let Some(ride) = ride.filter(|_| !options.no_odometry) {
        ride.fill(&mut log, scans, &frame)?;
    } else {
        if !options.no_odometry {
            let words = "the bag has no odometry: motion comes from the scans alone";
            log.warnings.push(words.to_owned());
        }
        let mount = contents.mount_without_odometry(&frame, options);
        let is_flipped = Mount::new(mount, &frame)?.is_flipped;
        let scans = scans.into_iter();
        log.scans = scans.map(|scan| turned(scan, is_flipped)).collect();
    }
    let n_scans = log.scans.len();
    Ok(log.checked(n_scans)?)
}

/// The topic of the odometry; none where transforms have to do.
fn odometry_topic<R: Read + Seek>(
    bag: &Bag<R>,
    options: &LogOptions,
) -> Result<Option<String>, RecordError> {
    let transforms = bag.topics_of::<TFMessage>();
    match options.odometry_topic.as_deref() {
        _ if options.no_odometry => Ok(None),
        Some(asked) if transforms.contains(&asked) => Ok(None),
        None if bag.topics_of::<Odometry>().is_empty() => Ok(None),
        asked => bag.topic_of::<Odometry>(asked, "--odom-topic").map(Some),
    }
}

/// A scan with the time of its recording, nanoseconds.
type RecordedScan = (u64, ScanMessage);

/// All that a log is made of.
#[derive(Default)]
struct Contents {
    scans: Vec<RecordedScan>,
    odometry: PoseTrack,
    /// The frame on the robot whose pose the odometry gives.
    odometry_child: Option<String>,
    frames: Frames,
}

impl Contents {
    fn read<R: Read + Seek>(
        bag: &mut Bag<R>,
        scan_topic: &str,
        odometry_topic: Option<&str>,
    ) -> Result<Self, RecordError> {
        let transforms = bag.topics_of::<TFMessage>();
        let transforms: Vec<String> = transforms.into_iter().map(str::to_owned).collect();
        let mut topics: Vec<&str> = transforms.iter().map(String::as_str).collect();
        topics.push(scan_topic);
        topics.extend(odometry_topic);
        let mut contents = Self::default();
        let mut n_ranges = 0;
        bag.visit(&topics, |message| {
            if message.topic == scan_topic {
                let mut scan: ScanMessage = message.decode()?;
                scan.intensities = Vec::new();
                n_ranges += scan.ranges.len();
                contents.scans.push((message.log_time_ns, scan));
                return check_size(n_ranges);
            }
            if Some(message.topic) == odometry_topic {
                return contents.add_odometry(message.topic, &message.decode()?);
            }
            let is_static = message.topic.ends_with("static");
            let transforms: TFMessage = message.decode()?;
            let mut transforms = transforms.transforms.iter();
            transforms.try_for_each(|t| contents.frames.add(message.topic, t, is_static))
        })?;
        contents.scans.sort_by_key(|(time_ns, _)| *time_ns);
        contents.odometry.sort();
        contents.frames.sort();
        Ok(contents)
    }

    fn add_odometry(&mut self, topic: &str, message: &Odometry) -> Result<(), RecordError> {
        let time_s = message.header.stamp.seconds();
        let refused = |what, value: String, limit| RecordError::Value {
            topic: topic.to_owned(),
            time_s,
            what,
            value,
            limit,
        };
        let Some(pose) = Pose3::of_pose(&message.pose.pose) else {
            let limit = "the quaternion must be of length 1, everything finite";
            return Err(refused(
                "the pose",
                format!("{:?}", message.pose.pose),
                limit,
            ));
        };
        let child = plain(&message.child_frame_id);
        let known = self.odometry_child.get_or_insert_with(|| child.to_owned());
        if known != child {
            let limit = "all messages of a topic must give the pose of one frame";
            let value = format!("{child:?} after {known:?}");
            return Err(refused("child_frame_id", value, limit));
        }
        self.odometry.push(time_s, pose);
        Ok(())
    }

    /// True where no scan has a time of its own.
    fn is_unstamped(&self) -> bool {
        let mut stamps = self.scans.iter().map(|(_, scan)| &scan.header.stamp);
        stamps.all(|stamp| stamp.sec == 0 && stamp.nanosec == 0)
    }

    /// The scans as mapping takes them, and the frame of their sensor.
    fn scans(&self, topic: &str) -> Result<(Vec<LaserScan>, String), RecordError> {
        let frame = self
            .scans
            .first()
            .map_or("", |(_, scan)| plain(&scan.header.frame_id));
        let is_unstamped = self.is_unstamped();
        let mut scans = Vec::with_capacity(self.scans.len());
        for (log_time_ns, message) in &self.scans {
            let own_s = message.header.stamp.seconds();
            let time_s = if is_unstamped {
                1e-9 * *log_time_ns as f64
            } else {
                own_s
            };
            let own = plain(&message.header.frame_id);
            if own != frame {
                return Err(RecordError::Value {
                    topic: topic.to_owned(),
                    time_s,
                    what: "frame_id",
                    value: format!("{own:?} after {frame:?}"),
                    limit: "a log holds the scans of one laser",
                });
            }
            scans.push(scan_of(message, time_s));
        }
        Ok((scans, frame.to_owned()))
    }

    /// The motion of the robot, from odometry or transforms; none where there is neither.
    fn ride<'a>(&'a self, frame: &str, options: &LogOptions) -> Option<Ride<'a>> {
        let (source, base) = if self.odometry.is_empty() {
            let (odom, base) = self.frames.odometry(frame)?;
            (Motion::Frame(odom), base)
        } else {
            let child = self.odometry_child.clone().unwrap_or_default();
            let usual = || "base_link".to_owned();
            let base = Some(child)
                .filter(|child| !child.is_empty())
                .unwrap_or_else(usual);
            (Motion::Odometry(&self.odometry), base)
        };
        Some(Ride {
            source,
            base,
            frames: &self.frames,
            laser_pose: options.laser_pose.map(Pose3::of_plane),
        })
    }

    /// The laser on whatever carries it; without odometry only its flip matters.
    fn mount_without_odometry(&self, frame: &str, options: &LogOptions) -> Pose3 {
        let time_s = self
            .scans
            .first()
            .map_or(0.0, |(_, scan)| scan.header.stamp.seconds());
        let given = options.laser_pose.map(Pose3::of_plane);
        let found = || {
            self.frames
                .pose_in(frame, &self.frames.root(frame), time_s)
                .ok()
        };
        given
            .or_else(found)
            .unwrap_or_else(|| Pose3::of_plane(Pose2::default()))
    }
}

fn check_size(n_ranges: usize) -> Result<(), RecordError> {
    if n_ranges <= MAX_RANGES {
        return Ok(());
    }
    Err(RecordError::Mismatch {
        thing: "the scans of the bag".to_owned(),
        value: format!("over {MAX_RANGES} ranges"),
        limit: format!("a log has at most {MAX_RANGES}"),
        hint: "split the bag, and build the map log after log with --session".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::{Header, Pose, Quaternion, Time, Transform, TransformStamped};
    use crate::qos::Durability;
    use crate::writer::BagWriter;
    use std::f64::consts::FRAC_PI_2;
    use std::io::Cursor;

    const SECOND: u64 = 1_000_000_000;

    type Writer = BagWriter<Cursor<Vec<u8>>>;

    fn scan(sec: i32) -> ScanMessage {
        ScanMessage {
            header: Header::new("laser", Time { sec, nanosec: 0 }),
            angle_min: -0.5,
            angle_max: 0.5,
            angle_increment: 0.5,
            range_min: 0.1,
            range_max: 10.0,
            ranges: vec![1.0, 2.0, 3.0],
            ..ScanMessage::default()
        }
    }

    fn link(parent: &str, child: &str, transform: Transform, sec: i32) -> TFMessage {
        TFMessage {
            transforms: vec![TransformStamped {
                header: Header::new(parent, Time { sec, nanosec: 0 }),
                child_frame_id: child.to_owned(),
                transform,
            }],
        }
    }

    fn mount(writer: &mut Writer, transform: Transform) {
        let durability = Durability::Latched;
        writer
            .advertise::<TFMessage>("/tf_static", durability)
            .unwrap();
        let message = link("base_link", "laser", transform, 0);
        writer.write("/tf_static", 0, &message).unwrap();
    }

    fn odometry(writer: &mut Writer, sec: i32, x: f64) {
        let mut message = Odometry {
            header: Header::new("odom", Time { sec, nanosec: 0 }),
            child_frame_id: "base_link".to_owned(),
            ..Odometry::default()
        };
        message.pose.pose = Pose::from(Pose2::new(x, 0.0, 0.0));
        writer
            .write("/odom", sec as u64 * SECOND, &message)
            .unwrap();
    }

    fn read(fill: impl FnOnce(&mut Writer), options: &LogOptions) -> Result<Log, RecordError> {
        let mut writer = BagWriter::new(Cursor::new(Vec::new())).unwrap();
        fill(&mut writer);
        read_log(
            &mut Bag::open("a.mcap", writer.finish().unwrap()).unwrap(),
            options,
        )
    }

    fn drive(writer: &mut Writer) {
        mount(writer, Pose2::new(0.2, 0.0, FRAC_PI_2).into());
        for sec in 0..3 {
            odometry(writer, 2 * sec, f64::from(sec));
        }
        for sec in 1..4 {
            writer
                .write("/scan", sec as u64 * SECOND, &scan(sec))
                .unwrap();
        }
    }

    #[test]
    fn the_laser_rides_on_the_odometry() {
        let log = read(drive, &LogOptions::default()).unwrap();
        let poses = log.odometry.unwrap();
        let xs: Vec<f64> = poses.iter().map(|pose| pose.x).collect();
        assert_eq!(xs, [0.7, 1.2, 1.7]);
        assert!((poses[0].heading - FRAC_PI_2).abs() < 1e-12);
        assert_eq!(log.scans[1].time_s, 2.0);
        assert_eq!(log.scans[1].first_angle_rad, -0.5);
        assert!(log.warnings.is_empty(), "{:?}", log.warnings);
        let given = LogOptions {
            laser_pose: Some(Pose2::default()),
            ..LogOptions::default()
        };
        assert_eq!(read(drive, &given).unwrap().odometry.unwrap()[0].x, 0.5);
    }

    #[test]
    fn ranges_out_of_their_limits_are_no_hits() {
        let fill = |writer: &mut Writer| {
            let mut scan = scan(1);
            scan.ranges = vec![0.05, 10.5, f32::NAN, 10.0];
            scan.angle_increment = -0.1;
            writer.write("/scan", SECOND, &scan).unwrap();
        };
        let log = read(fill, &LogOptions::default()).unwrap();
        let scan = &log.scans[0];
        assert!(
            (scan.first_angle_rad + 0.8).abs() < 1e-6,
            "clockwise: from the last beam"
        );
        assert_eq!(scan.ranges_m[0], 10.0);
        assert!(scan.ranges_m[1].is_nan());
        assert_eq!(scan.ranges_m[2..], [f32::INFINITY, 0.0]);
        assert!(log.odometry.is_none());
        assert!(log.warnings[0].contains("no odometry"));
    }

    /// Half a turn about the forward axis after a heading.
    fn upside_down(heading_rad: f64) -> Transform {
        let (sin, cos) = (0.5 * heading_rad).sin_cos();
        Transform {
            rotation: Quaternion {
                x: cos,
                y: sin,
                z: 0.0,
                w: 0.0,
            },
            ..Transform::default()
        }
    }

    #[test]
    fn a_laser_upside_down_is_turned_around() {
        let fill = |writer: &mut Writer| {
            mount(writer, upside_down(0.3));
            odometry(writer, 0, 0.0);
            odometry(writer, 2, 0.0);
            let mut scan = scan(1);
            scan.angle_min = 0.0;
            writer.write("/scan", SECOND, &scan).unwrap();
        };
        let log = read(fill, &LogOptions::default()).unwrap();
        let scan = &log.scans[0];
        assert_eq!((scan.first_angle_rad, scan.angle_step_rad), (-1.0, 0.5));
        assert_eq!(scan.ranges_m, [3.0, 2.0, 1.0]);
        assert!((log.odometry.unwrap()[0].heading - 0.3).abs() < 1e-12);
    }

    #[test]
    fn a_tilted_laser_and_a_gap_between_frames_are_refused() {
        let tilted = |writer: &mut Writer| {
            let (sin, cos) = 0.1_f64.sin_cos();
            let mut transform = Transform::default();
            (transform.rotation.y, transform.rotation.w) = (sin, cos);
            mount(writer, transform);
            odometry(writer, 1, 0.0);
            writer.write("/scan", SECOND, &scan(1)).unwrap();
        };
        let error = read(tilted, &LogOptions::default())
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("\"laser\" is tilted by 11.5 degrees"),
            "{error}"
        );
        let alone = |writer: &mut Writer| {
            odometry(writer, 1, 0.0);
            writer.write("/scan", SECOND, &scan(1)).unwrap();
        };
        let without = LogOptions {
            no_odometry: true,
            ..LogOptions::default()
        };
        let log = read(alone, &without).unwrap();
        assert!(log.odometry.is_none() && log.warnings.is_empty());
        let error = read(alone, &LogOptions::default()).unwrap_err().to_string();
        assert!(
            error.contains("--laser-pose") && error.contains("\"base_link\""),
            "{error}"
        );
    }

    #[test]
    fn transforms_serve_as_odometry() {
        let fill = |writer: &mut Writer| {
            mount(writer, Pose2::new(0.2, 0.0, 0.0).into());
            for (sec, x) in [(0, 0.0), (2, 1.0)] {
                let message = link("odom", "base_link", Pose2::new(x, 0.0, 0.0).into(), sec);
                writer.write("/tf", sec as u64 * SECOND, &message).unwrap();
            }
            for sec in [1, 9] {
                writer
                    .write("/scan", sec as u64 * SECOND, &scan(sec))
                    .unwrap();
            }
        };
        let log = read(fill, &LogOptions::default()).unwrap();
        assert_eq!(log.odometry.unwrap(), [Pose2::new(0.7, 0.0, 0.0)]);
        assert!(
            log.warnings[0].starts_with("1 of 2 scans are left out"),
            "{:?}",
            log.warnings
        );
        let named = LogOptions {
            odometry_topic: Some("/tf".to_owned()),
            ..LogOptions::default()
        };
        let both = |writer: &mut Writer| {
            fill(writer);
            odometry(writer, 1, 50.0);
        };
        assert_eq!(read(both, &named).unwrap().odometry.unwrap()[0].x, 0.7);
    }

    #[test]
    fn several_topics_must_be_told_apart() {
        let fill = |writer: &mut Writer| {
            drive(writer);
            writer.write("/rear/scan", SECOND, &scan(1)).unwrap();
        };
        let error = read(fill, &LogOptions::default()).unwrap_err().to_string();
        assert!(
            error.contains("/rear/scan, /scan; hint: --scan-topic"),
            "{error}"
        );
        let options = LogOptions {
            scan_topic: Some("/scan".to_owned()),
            ..LogOptions::default()
        };
        assert_eq!(read(fill, &options).unwrap().scans.len(), 3);
    }

    #[test]
    fn scans_without_times_take_those_of_the_recording() {
        let fill = |writer: &mut Writer| {
            for i in 1..3 {
                writer.write("/scan", i * SECOND, &scan(0)).unwrap();
            }
        };
        let log = read(fill, &LogOptions::default()).unwrap();
        assert_eq!((log.scans[0].time_s, log.scans[1].time_s), (1.0, 2.0));
        assert!(log.warnings[0].contains("no times"));
    }
}
