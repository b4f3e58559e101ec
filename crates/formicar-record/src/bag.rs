//! Bags to read: topics, and messages in the order of the file.

use crate::error::RecordError;
use crate::foreign::{N_MAGIC, check_kind};
use crate::messages::Message;
use crate::topic::{RawMessage, Topic};
use crate::walk::{Channels, Next, Visit, next_record, parsed};
use mcap::records::{ChunkIndex, Record, op};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufReader, Read, Seek, SeekFrom};

/// Bytes of the magic number at both ends of a file.
const N_MARK: u64 = 8;
/// Bytes of a footer with the magic number behind it.
const N_FOOTER: u64 = 9 + 20 + N_MARK;

/// A bag in MCAP.
///
/// Only the chunks with wanted topics are read where the file has an index; a file that was cut off,
/// by a robot that lost power for instance, is read from its begin to the cut. Memory is that of one
/// chunk, at most 256 MiB.
#[derive(Debug)]
pub struct Bag<R> {
    source: BufReader<R>,
    n_bytes: u64,
    topics: Vec<Topic>,
    index: Option<Index>,
    warnings: Vec<String>,
}

/// What stands at the end of a file about the chunks before it.
#[derive(Debug, Default)]
struct Index {
    channels: Channels,
    /// In the order of the file.
    chunks: Vec<ChunkIndex>,
    /// Messages on each channel.
    counts: Option<BTreeMap<u16, u64>>,
}

impl<R: Read + Seek> Bag<R> {
    /// Opens a bag; `name` appears in messages.
    ///
    /// # Errors
    /// A file of another kind, with the command that converts it; a damaged file.
    pub fn open(name: &str, mut source: R) -> Result<Self, RecordError> {
        let n_bytes = source.seek(SeekFrom::End(0))?;
        source.seek(SeekFrom::Start(0))?;
        let mut first_bytes = Vec::new();
        let magic = source.by_ref().take(N_MAGIC as u64);
        { magic }.read_to_end(&mut first_bytes)?;
        check_kind(name, &first_bytes)?;
        let mut source = BufReader::new(source);
        // A damaged index is no index: the messages are there all the same.
        let index = index(&mut source, n_bytes).unwrap_or_default();
        let mut bag = Self {
            source,
            n_bytes,
            topics: Vec::new(),
            index,
            warnings: Vec::new(),
        };
        bag.topics = bag.find_topics()?;
        Ok(bag)
    }

    /// The topics with messages, by name.
    pub fn topics(&self) -> &[Topic] {
        &self.topics
    }

    /// Curiosities of the file that do not make it useless, as sentences.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The names of all topics with messages of a type, sorted.
    pub fn topics_of<M: Message>(&self) -> Vec<&str> {
        let topics = self.topics.iter();
        let topics = topics.filter(|topic| topic.type_name == M::TYPE);
        topics.map(|topic| topic.name.as_str()).collect()
    }

    /// The topic with messages of a type: the one that was asked for, or the only one. `hint` names
    /// the flag that chooses.
    ///
    /// # Errors
    /// No such topic, or several of them.
    pub fn topic_of<M: Message>(
        &self,
        asked: Option<&str>,
        hint: &'static str,
    ) -> Result<String, RecordError> {
        let known = self.topics_of::<M>();
        if let Some(asked) = asked {
            return self.asked_topic::<M>(asked, &known);
        }
        match known[..] {
            [only] => Ok(only.to_owned()),
            [] => Err(RecordError::NoTopic {
                type_name: M::TYPE,
                topics: self.described(),
            }),
            _ => Err(RecordError::ManyTopics {
                type_name: M::TYPE,
                n: known.len(),
                topics: known.join(", "),
                hint,
            }),
        }
    }

    fn asked_topic<M: Message>(&self, asked: &str, known: &[&str]) -> Result<String, RecordError> {
        let slashed = format!("/{asked}");
        if let Some(found) = known
            .iter()
            .find(|name| **name == asked || **name == slashed)
        {
            return Ok((*found).to_owned());
        }
        let other = self.topics.iter().find(|topic| topic.name == asked);
        Err(RecordError::OtherTopic {
            topic: asked.to_owned(),
            problem: other.map_or("is not in the bag".to_owned(), |topic| {
                format!("has messages of type {}", topic.type_name)
            }),
            type_name: M::TYPE,
            topics: if known.is_empty() {
                "none".to_owned()
            } else {
                known.join(", ")
            },
        })
    }

    /// All topics with their types.
    fn described(&self) -> String {
        let topics = self.topics.iter();
        let topics = topics.map(|topic| format!("{} ({})", topic.name, topic.type_name));
        let topics: Vec<String> = topics.collect();
        match topics.len() {
            0 => "no messages at all".to_owned(),
            _ => topics.join(", "),
        }
    }

    /// Visits the messages of some topics in the order of the file.
    ///
    /// # Errors
    /// A damaged file, messages that are not encoded as CDR, and whatever `visit` refuses.
    pub fn visit(
        &mut self,
        topics: &[&str],
        mut visit: impl FnMut(RawMessage<'_>) -> Result<(), RecordError>,
    ) -> Result<(), RecordError> {
        let other = self
            .topics
            .iter()
            .find(|topic| topics.contains(&topic.name.as_str()) && topic.encoding != "cdr");
        if let Some(topic) = other {
            return Err(RecordError::Mismatch {
                thing: format!("the messages of {}", topic.name),
                value: format!("encoded as {:?}", topic.encoding),
                limit: "only cdr is read".to_owned(),
                hint: "record with `ros2 bag record -s mcap`".to_owned(),
            });
        }
        let mut wanted = |topic: &Topic, message: RawMessage<'_>| {
            if topics.contains(&topic.name.as_str()) {
                visit(message)
            } else {
                Ok(())
            }
        };
        if let Some(index) = self.index.take() {
            let visited = self.visit_chunks(&index, topics, &mut wanted);
            self.index = Some(index);
            return visited;
        }
        self.visit_all(&mut wanted)
    }

    /// Visits the messages of the chunks that hold some topics.
    fn visit_chunks(
        &mut self,
        index: &Index,
        topics: &[&str],
        visit: &mut Visit<'_>,
    ) -> Result<(), RecordError> {
        let channels = index.channels.topics().iter();
        let channels = channels.filter(|(_, topic)| topics.contains(&topic.name.as_str()));
        let channels: BTreeSet<u16> = channels.map(|(id, _)| *id).collect();
        let mut known = index.channels.clone();
        let mut body = Vec::new();
        for chunk in &index.chunks {
            let mut ids = chunk.message_index_offsets.keys();
            // Without an index of its messages, a chunk may hold any.
            if ids.len() > 0 && !ids.any(|id| channels.contains(id)) {
                continue;
            }
            let mut at = chunk.chunk_start_offset;
            let next = next_record(&mut self.source, &mut at, self.n_bytes, &mut body)?;
            let Next::Record(op::CHUNK) = next else {
                return Err(RecordError::Damaged {
                    reason: format!(
                        "its index names a chunk at byte {}, where there is none",
                        chunk.chunk_start_offset
                    ),
                });
            };
            known.take(op::CHUNK, &body, visit)?;
        }
        Ok(())
    }

    /// Visits every message of a file, from its begin on.
    fn visit_all(&mut self, visit: &mut Visit<'_>) -> Result<(), RecordError> {
        let mut n_messages = 0_u64;
        let mut counted = |topic: &Topic, message: RawMessage<'_>| {
            n_messages += 1;
            visit(topic, message)
        };
        let mut known = Channels::default();
        let (mut at, mut body) = (N_MARK, Vec::new());
        let is_cut = loop {
            match next_record(&mut self.source, &mut at, self.n_bytes, &mut body)? {
                Next::Record(op::DATA_END) | Next::End => break false,
                Next::Record(kind) => known.take(kind, &body, &mut counted)?,
                Next::Passed => {}
                Next::Cut => break true,
            }
        };
        if is_cut && n_messages == 0 {
            return Err(RecordError::Damaged {
                reason: "it is cut off within a record, before its first message".to_owned(),
            });
        }
        // What stands before the cut is whole.
        let words = format!(
            "the bag is cut off within a record, after {n_messages} messages; they are used"
        );
        if is_cut && !self.warnings.contains(&words) {
            self.warnings.push(words);
        }
        Ok(())
    }

    /// The topics with messages, from the index or from the messages themselves.
    fn find_topics(&mut self) -> Result<Vec<Topic>, RecordError> {
        let mut found = BTreeSet::new();
        if let Some(index) = &self.index {
            let is_used = |id: &u16| {
                let counts = index.counts.as_ref();
                counts.is_none_or(|counts| counts.get(id).is_some_and(|n| *n > 0))
            };
            let topics = index.channels.topics().iter();
            found.extend(
                topics
                    .filter(|(id, _)| is_used(id))
                    .map(|(_, topic)| topic.clone()),
            );
        } else {
            self.visit_all(&mut |topic, _| {
                if !found.contains(topic) {
                    found.insert(topic.clone());
                }
                Ok(())
            })?;
        }
        Ok(found.into_iter().collect())
    }
}

/// The index at the end of a file; none where there is none, as in one that was cut off.
fn index<R: Read + Seek>(source: &mut R, n_bytes: u64) -> Result<Option<Index>, RecordError> {
    let mut at = n_bytes.saturating_sub(N_FOOTER);
    let mut body = Vec::new();
    let end = n_bytes.saturating_sub(N_MARK);
    let Next::Record(op::FOOTER) = next_record(source, &mut at, end, &mut body)? else {
        return Ok(None);
    };
    let Record::Footer(footer) = parsed(op::FOOTER, &body)? else {
        return Ok(None);
    };
    let mut index = Index::default();
    at = footer.summary_start;
    if at < N_MARK {
        return Ok(None);
    }
    loop {
        match next_record(source, &mut at, end, &mut body)? {
            Next::Record(op::CHUNK_INDEX) => {
                if let Record::ChunkIndex(chunk) = parsed(op::CHUNK_INDEX, &body)? {
                    index.chunks.push(chunk);
                }
            }
            Next::Record(op::STATISTICS) => {
                if let Record::Statistics(found) = parsed(op::STATISTICS, &body)? {
                    index.counts = Some(found.channel_message_counts);
                }
            }
            Next::Record(kind @ (op::SCHEMA | op::CHANNEL)) => {
                index.channels.take(kind, &body, &mut |_, _| Ok(()))?;
            }
            Next::Record(op::FOOTER) | Next::Cut | Next::End => break,
            Next::Record(_) | Next::Passed => {}
        }
    }
    index.chunks.sort_by_key(|chunk| chunk.chunk_start_offset);
    let is_whole = !index.chunks.is_empty() && !index.channels.topics().is_empty();
    Ok(is_whole.then_some(index))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdr;
    use crate::messages::{Header, Odometry, PoseStamped, Time};
    use crate::qos::Durability;
    use crate::writer::BagWriter;
    use mcap::{Compression, WriteOptions};
    use proptest::prelude::*;
    use std::io::Cursor;

    fn stamped(sec: i32) -> PoseStamped {
        PoseStamped {
            header: Header::new("map", Time { sec, nanosec: 0 }),
            ..PoseStamped::default()
        }
    }

    fn written(n_messages: i32) -> Vec<u8> {
        let mut writer = BagWriter::new(Cursor::new(Vec::new())).unwrap();
        writer
            .advertise::<PoseStamped>("/goal", Durability::Latched)
            .unwrap();
        for i in 0..n_messages {
            let time_ns = i as u64 * 1_000_000_000;
            writer.write("/goal", time_ns, &stamped(i)).unwrap();
            writer
                .write("/odom", time_ns, &Odometry::default())
                .unwrap();
        }
        writer.finish().unwrap().into_inner()
    }

    /// The same messages with other packing.
    fn packed(compression: Option<Compression>, use_chunks: bool) -> Vec<u8> {
        let options = WriteOptions::new()
            .compression(compression)
            .use_chunks(use_chunks)
            .chunk_size(Some(256));
        let mut writer = options.create(Cursor::new(Vec::new())).unwrap();
        let schema = writer
            .add_schema(PoseStamped::TYPE, "ros2idl", b"-")
            .unwrap();
        let metadata = BTreeMap::new();
        let channel = writer.add_channel(schema, "/goal", "cdr", &metadata);
        let channel_id = channel.unwrap();
        for i in 0..20 {
            let header = mcap::records::MessageHeader {
                channel_id,
                sequence: 0,
                log_time: i,
                publish_time: i,
            };
            let data = cdr::encode(&stamped(i as i32)).unwrap();
            writer.write_to_known_channel(&header, &data).unwrap();
        }
        writer.finish().unwrap();
        writer.into_inner().into_inner()
    }

    fn seconds(bytes: Vec<u8>) -> Result<Vec<i32>, RecordError> {
        let mut bag = Bag::open("a.mcap", Cursor::new(bytes))?;
        let mut found = Vec::new();
        bag.visit(&["/goal"], |message| {
            found.push(message.decode::<PoseStamped>()?.header.stamp.sec);
            Ok(())
        })?;
        Ok(found)
    }

    #[test]
    fn chunks_and_schemas_of_every_kind_are_read() {
        let all: Vec<i32> = (0..20).collect();
        for compression in [None, Some(Compression::Zstd), Some(Compression::Lz4)] {
            for use_chunks in [false, true] {
                let found = seconds(packed(compression, use_chunks)).unwrap();
                assert_eq!(found, all, "{compression:?} {use_chunks}");
            }
        }
        assert_eq!(seconds(written(3)).unwrap(), [0, 1, 2]);
    }

    #[test]
    fn a_bag_that_is_cut_off_is_read_up_to_the_cut() {
        let whole = packed(None, true);
        let cut = whole[..whole.len() / 2].to_vec();
        let mut bag = Bag::open("a.mcap", Cursor::new(cut.clone())).unwrap();
        assert!(
            bag.warnings()[0].contains("cut off"),
            "{:?}",
            bag.warnings()
        );
        let found = seconds(cut).unwrap();
        assert!(found.len() > 2 && found.len() < 20, "{found:?}");
        assert!(bag.visit(&["/goal"], |_| Ok(())).is_ok());
        assert_eq!(bag.warnings().len(), 1);
    }

    #[test]
    fn topics_are_chosen_or_listed() {
        let bag = Bag::open("a.mcap", Cursor::new(written(1))).unwrap();
        let of = |asked| bag.topic_of::<Odometry>(asked, "--odom-topic");
        assert_eq!(of(None).unwrap(), "/odom");
        assert_eq!(of(Some("odom")).unwrap(), "/odom");
        let error = of(Some("/goal")).unwrap_err().to_string();
        assert!(error.contains("geometry_msgs/msg/PoseStamped"), "{error}");
        let scans = bag.topic_of::<crate::messages::LaserScan>(None, "--scan-topic");
        let error = scans.unwrap_err().to_string();
        assert!(
            error.contains("/goal (geometry_msgs/msg/PoseStamped)"),
            "{error}"
        );
    }

    #[test]
    fn a_record_too_long_is_refused_before_it_is_read() {
        // A message that claims 2^60 bytes.
        let mut bytes = b"\x89MCAP0\r\n\x05".to_vec();
        bytes.extend((1_u64 << 60).to_le_bytes());
        let error = Bag::open("a.mcap", Cursor::new(bytes)).unwrap_err();
        assert!(
            error.to_string().contains("cut off within a record"),
            "{error}"
        );
    }

    #[test]
    fn a_record_longer_than_its_chunk_is_refused() {
        let mut bytes = packed(None, true);
        // The length of the first record in the first chunk, a schema, and no checksum.
        let chunk = bytes.iter().position(|&byte| byte == 6).unwrap();
        let (crc, first) = (chunk + 9 + 24, chunk + 9 + 28 + 4 + 8);
        assert_eq!(bytes[first], 3, "a schema");
        bytes[crc..crc + 4].fill(0);
        bytes[first + 1..first + 9].copy_from_slice(&(1_u64 << 20).to_le_bytes());
        let error = seconds(bytes).unwrap_err().to_string();
        assert!(error.contains("a chunk ends within a record"), "{error}");
    }

    #[test]
    fn a_damaged_chunk_is_noticed() {
        let mut bytes = packed(None, true);
        let frame = bytes.windows(4).position(|four| four == b"map\0").unwrap();
        bytes[frame] = b'n';
        let error = seconds(bytes).unwrap_err().to_string();
        assert!(error.contains("checksum"), "{error}");
    }

    proptest! {
        #[test]
        fn no_damage_makes_it_panic(
            places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
            cut in any::<prop::sample::Index>(),
            is_cut in any::<bool>(),
        ) {
            let mut bytes = written(4);
            for (place, byte) in places {
                let at = place.index(bytes.len());
                bytes[at] = byte;
            }
            if is_cut {
                bytes.truncate(cut.index(bytes.len()));
            }
            let _ = seconds(bytes);
        }
    }
}
