//! Maps of a bag, and maps as messages.

use crate::bag::Bag;
use crate::error::RecordError;
use crate::frames::Pose3;
use crate::messages::{Header, MapMetaData, OccupancyGrid as GridMessage, Time};
use crate::topic::RawMessage;
use formicar::map::{GridFrame, MapError, OccupancyGrid};
use std::io::{Read, Seek};

/// The map to take, of all maps on a topic.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum MapAt {
    /// The last one.
    #[default]
    Last,
    /// The newest one that was recorded by a time: seconds since the first message on the topic, or
    /// Unix time in seconds from 10⁹ on.
    Time(f64),
}

/// From this on a time is Unix time, seconds: September 2001.
const UNIX_FROM_S: f64 = 1e9;

/// The occupancy grid of a bag: of the topic that is named, else of the only one, else of `/map`.
/// The name of the topic comes with it.
///
/// # Errors
/// No such topic, several without `/map` among them, no map by the time, or a message that makes no
/// map.
pub fn read_map<R: Read + Seek>(
    bag: &mut Bag<R>,
    topic: Option<&str>,
    at: MapAt,
) -> Result<(OccupancyGrid, String), RecordError> {
    let has_usual = bag.topics_of::<GridMessage>().contains(&"/map");
    let asked = topic.or(has_usual.then_some("/map"));
    let topic = bag.topic_of::<GridMessage>(asked, "BAG.mcap:TOPIC")?;
    let mut first_ns = None;
    let mut found: Option<(u64, Vec<u8>)> = None;
    bag.visit(&[&topic], |message| {
        let time_ns = message.log_time_ns;
        let first_ns = *first_ns.get_or_insert(time_ns);
        let is_due = match at {
            MapAt::Last => true,
            MapAt::Time(time_s) if time_s >= UNIX_FROM_S => time_ns as f64 <= 1e9 * time_s,
            MapAt::Time(time_s) => time_ns.saturating_sub(first_ns) as f64 <= 1e9 * time_s,
        };
        if is_due && found.as_ref().is_none_or(|(newest, _)| *newest <= time_ns) {
            found = Some((time_ns, message.data.to_vec()));
        }
        Ok(())
    })?;
    let Some((log_time_ns, data)) = found else {
        let MapAt::Time(time_s) = at else {
            return Err(none_by(&topic, f64::INFINITY, first_ns));
        };
        return Err(none_by(&topic, time_s, first_ns));
    };
    let message = RawMessage {
        topic: &topic,
        log_time_ns,
        data: &data,
    };
    let map = from_message(&topic, &message.decode()?)?;
    Ok((map, topic))
}

fn none_by(topic: &str, time_s: f64, first_ns: Option<u64>) -> RecordError {
    let first_s = first_ns.map_or(0.0, |ns| 1e-9 * ns as f64);
    RecordError::Mismatch {
        thing: format!("the time {time_s} s"),
        value: format!("before the first map of {topic}"),
        limit: format!("which was recorded at {first_s:.3} s of Unix time"),
        hint: "@ takes seconds since that map, or Unix time".to_owned(),
    }
}

/// A map from a message. Its origin may be turned in the plane.
///
/// # Errors
/// A count of cells other than width times height, values outside -1..=100, a resolution or an
/// origin that no map has.
pub fn from_message(topic: &str, message: &GridMessage) -> Result<OccupancyGrid, RecordError> {
    let time_s = message.header.stamp.seconds();
    let refused = |what, value: String, limit| RecordError::Value {
        topic: topic.to_owned(),
        time_s,
        what,
        value,
        limit,
    };
    let info = &message.info;
    let Some(origin) = Pose3::of_pose(&info.origin) else {
        let limit = "the quaternion must be of length 1, everything finite";
        return Err(refused("the origin", format!("{:?}", info.origin), limit));
    };
    let made = |error: MapError| refused("no map:", error.to_string(), "no planner takes it");
    let frame = GridFrame::new(
        info.width as usize,
        info.height as usize,
        decimal(info.resolution),
        origin.in_plane(),
    );
    OccupancyGrid::new(frame.map_err(made)?, message.data.clone()).map_err(made)
}

/// The number that was meant: 0.05, not 0.05000000074505806.
fn decimal(single: f32) -> f64 {
    single.to_string().parse().unwrap_or(f64::from(single))
}

/// A map as a message in a frame.
pub fn to_message(map: &OccupancyGrid, frame_id: &str, stamp: Time) -> GridMessage {
    let frame = map.frame();
    GridMessage {
        header: Header::new(frame_id, stamp.clone()),
        info: MapMetaData {
            map_load_time: stamp,
            resolution: frame.resolution_m() as f32,
            width: frame.n_cols() as u32,
            height: frame.n_rows() as u32,
            origin: frame.origin().into(),
        },
        data: map.values().to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::qos::Durability;
    use crate::writer::BagWriter;
    use formicar::Pose2;
    use std::io::Cursor;

    fn map(rows: &[&str]) -> OccupancyGrid {
        OccupancyGrid::from_rows(rows, 0.05).unwrap()
    }

    fn bag(maps: &[(&str, u64, OccupancyGrid)]) -> Bag<Cursor<Vec<u8>>> {
        let mut writer = BagWriter::new(Cursor::new(Vec::new())).unwrap();
        for (topic, time_s, map) in maps {
            writer
                .advertise::<GridMessage>(topic, Durability::Latched)
                .unwrap();
            let message = to_message(map, "map", Time::default());
            writer
                .write(topic, time_s * 1_000_000_000, &message)
                .unwrap();
        }
        Bag::open("maps.mcap", writer.finish().unwrap()).unwrap()
    }

    #[test]
    fn a_map_comes_back_to_the_bit() {
        let frame = GridFrame::new(2, 2, 0.05, Pose2::new(-1.25, 3.5, 0.0)).unwrap();
        let map = OccupancyGrid::new(frame, vec![0, 100, -1, 42]).unwrap();
        let (found, topic) =
            read_map(&mut bag(&[("/map", 5, map.clone())]), None, MapAt::Last).unwrap();
        assert_eq!((found, topic.as_str()), (map, "/map"));
    }

    #[test]
    fn topic_and_time_choose_a_map() {
        let (a, b, c) = (map(&["#."]), map(&[".#"]), map(&["##"]));
        let mut bag = bag(&[
            ("/map", 10, a.clone()),
            ("/map", 20, b.clone()),
            ("/costmap", 10, c.clone()),
        ]);
        let mut at = |topic, at| read_map(&mut bag, topic, at).map(|(map, _)| map);
        assert_eq!(at(None, MapAt::Last).unwrap(), b);
        assert_eq!(at(None, MapAt::Time(9.0)).unwrap(), a);
        assert_eq!(at(None, MapAt::Time(10.0)).unwrap(), b);
        assert_eq!(at(Some("costmap"), MapAt::Last).unwrap(), c);
        let error = at(Some("/scan"), MapAt::Last).unwrap_err().to_string();
        assert!(
            error.contains("/scan is not in the bag") && error.contains("/costmap, /map"),
            "{error}"
        );
        let error = at(None, MapAt::Time(-1.0)).unwrap_err().to_string();
        assert!(error.contains("before the first map of /map"), "{error}");
    }

    #[test]
    fn messages_that_make_no_map_are_refused() {
        let good = to_message(&map(&["#."]), "map", Time::default());
        let message = |bad: GridMessage| from_message("/map", &bad).unwrap_err().to_string();
        let mut short = good.clone();
        short.data.pop();
        assert!(message(short).contains("/map"));
        let mut nan = good.clone();
        nan.info.origin.position.x = f64::NAN;
        assert!(message(nan).contains("the origin"));
        let mut huge = good.clone();
        huge.info.width = u32::MAX;
        huge.info.height = u32::MAX;
        assert!(message(huge).contains("4294967295"));
        let mut value = good;
        value.data[0] = 101;
        assert!(message(value).contains("101"));
    }
}
