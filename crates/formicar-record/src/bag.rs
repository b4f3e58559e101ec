//! Bags to read: topics, and messages in the order of the file.

use crate::cdr;
use crate::error::RecordError;
use crate::foreign::{N_MAGIC, check_kind};
use crate::messages::Message;
use mcap::sans_io::indexed_reader::{
    IndexedReadEvent, IndexedReader, IndexedReaderOptions, ReadOrder,
};
use mcap::sans_io::linear_reader::LinearReaderOptions;
use mcap::sans_io::summary_reader::{SummaryReadEvent, SummaryReader, SummaryReaderOptions};
use mcap::{McapError, Summary};
use std::collections::BTreeSet;
use std::io::{BufReader, Read, Seek, SeekFrom};

/// The longest record, packed or not, bytes: what a hostile file can make a reader allocate.
const MAX_RECORD: usize = 1 << 28;

/// A topic of a bag.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Topic {
    /// Its name.
    pub name: String,
    /// The type of its messages, for instance `sensor_msgs/msg/LaserScan`.
    pub type_name: String,
    /// The encoding of its messages; `cdr` is read.
    pub encoding: String,
}

/// A message as it stands in the file.
#[derive(Clone, Copy, Debug)]
pub struct RawMessage<'a> {
    /// Its topic.
    pub topic: &'a str,
    /// Time at which it was recorded, nanoseconds.
    pub log_time_ns: u64,
    /// Its bytes, with encapsulation.
    pub data: &'a [u8],
}

impl RawMessage<'_> {
    /// The message as a value.
    ///
    /// # Errors
    /// Bytes that do not have the form of the type.
    pub fn decode<M: Message>(&self) -> Result<M, RecordError> {
        cdr::decode(self.data).map_err(|source| RecordError::Message {
            topic: self.topic.to_owned(),
            time_s: 1e-9 * self.log_time_ns as f64,
            type_name: M::TYPE,
            source,
        })
    }
}

/// A bag in MCAP.
///
/// Only the chunks with wanted topics are read where the file has an index; a file that was cut off,
/// by a robot that lost power for instance, is read from its begin to the cut. Memory is that of one
/// chunk, at most 256 MiB.
#[derive(Debug)]
pub struct Bag<R> {
    source: R,
    n_bytes: u64,
    topics: Vec<Topic>,
    index: Option<Summary>,
    warnings: Vec<String>,
}

impl<R: Read + Seek> Bag<R> {
    /// Opens a bag; `name` appears in messages.
    ///
    /// # Errors
    /// A file of another kind, with the command that converts it; a damaged file.
    pub fn open(name: &str, mut source: R) -> Result<Self, RecordError> {
        let io = |error: std::io::Error| RecordError::damaged(&error);
        let n_bytes = source.seek(SeekFrom::End(0)).map_err(io)?;
        source.seek(SeekFrom::Start(0)).map_err(io)?;
        let mut first_bytes = Vec::new();
        let magic = source.by_ref().take(N_MAGIC as u64);
        { magic }.read_to_end(&mut first_bytes).map_err(io)?;
        check_kind(name, &first_bytes)?;
        let index = summary(&mut source, n_bytes).unwrap_or_default();
        let mut bag = Self {
            source,
            n_bytes,
            topics: Vec::new(),
            index: index.filter(|i| !i.chunk_indexes.is_empty() && !i.channels.is_empty()),
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
        if self.index.is_some() {
            self.visit_indexed(topics, &mut visit)
        } else {
            self.visit_all(|topic, message| {
                if topics.contains(&topic.name.as_str()) {
                    visit(message)
                } else {
                    Ok(())
                }
            })
        }
    }

    fn visit_indexed(
        &mut self,
        topics: &[&str],
        visit: &mut dyn FnMut(RawMessage<'_>) -> Result<(), RecordError>,
    ) -> Result<(), RecordError> {
        let Some(index) = &self.index else {
            return Ok(());
        };
        let has_one = index.channels.values();
        if !{ has_one }.any(|channel| topics.contains(&channel.topic.as_str())) {
            return Ok(());
        }
        let options = IndexedReaderOptions::new()
            .with_order(ReadOrder::File)
            .with_record_length_limit(MAX_RECORD)
            .include_topics(topics.iter().copied());
        let damaged = |error: McapError| RecordError::damaged(&error);
        let mut reader = IndexedReader::new_with_options(index, options).map_err(damaged)?;
        let mut chunk = Vec::new();
        while let Some(event) = reader.next_event() {
            match event.map_err(damaged)? {
                IndexedReadEvent::ReadChunkRequest { offset, length } => {
                    read_at(&mut self.source, self.n_bytes, (offset, length), &mut chunk)?;
                    let inserted = reader.insert_chunk_record_data(offset, &chunk);
                    inserted.map_err(damaged)?;
                }
                IndexedReadEvent::Message { header, data } => {
                    let Some(channel) = index.channels.get(&header.channel_id) else {
                        continue;
                    };
                    visit(RawMessage {
                        topic: &channel.topic,
                        log_time_ns: header.log_time,
                        data,
                    })?;
                }
            }
        }
        Ok(())
    }

    /// Visits every message of a file, from its begin on.
    fn visit_all(
        &mut self,
        mut visit: impl FnMut(&Topic, RawMessage<'_>) -> Result<(), RecordError>,
    ) -> Result<(), RecordError> {
        let start = self.source.seek(SeekFrom::Start(0));
        start.map_err(|error| RecordError::damaged(&error))?;
        let options = LinearReaderOptions::default().with_record_length_limit(MAX_RECORD);
        let source = BufReader::new(&mut self.source);
        let messages = mcap::io::MessageReader::new_with_options(source, options);
        for (n_messages, message) in messages.enumerate() {
            let message = match message {
                Ok(message) => message,
                // What stands before the cut is whole.
                Err(McapError::UnexpectedEof) if n_messages > 0 => {
                    let words = format!(
                        "the bag is cut off within a record, after {n_messages} messages; they are \
                         used"
                    );
                    if !self.warnings.contains(&words) {
                        self.warnings.push(words);
                    }
                    break;
                }
                Err(error) => return Err(RecordError::damaged(&error)),
            };
            let channel = &message.channel;
            let topic = topic(channel);
            visit(
                &topic,
                RawMessage {
                    topic: &channel.topic,
                    log_time_ns: message.log_time,
                    data: &message.data,
                },
            )?;
        }
        Ok(())
    }

    /// The topics with messages, from the index or from the messages themselves.
    fn find_topics(&mut self) -> Result<Vec<Topic>, RecordError> {
        let mut found = BTreeSet::new();
        if let Some(index) = &self.index {
            let counts = index.stats.as_ref().map(|s| &s.channel_message_counts);
            for (id, channel) in &index.channels {
                let is_used = counts.is_none_or(|counts| counts.get(id).is_some_and(|n| *n > 0));
                if is_used {
                    found.insert(topic(channel));
                }
            }
        } else {
            self.visit_all(|topic, _| {
                if !found.contains(topic) {
                    found.insert(topic.clone());
                }
                Ok(())
            })?;
        }
        Ok(found.into_iter().collect())
    }
}

fn topic(channel: &mcap::Channel<'_>) -> Topic {
    let schema = channel.schema.as_ref();
    Topic {
        name: channel.topic.clone(),
        type_name: schema.map_or_else(String::new, |schema| schema.name.clone()),
        encoding: channel.message_encoding.clone(),
    }
}

/// The summary at the end of a file; none where there is none, as in one that was cut off.
fn summary<R: Read + Seek>(source: &mut R, n_bytes: u64) -> Result<Option<Summary>, McapError> {
    let options = SummaryReaderOptions::default()
        .with_file_size(n_bytes)
        .with_record_length_limit(MAX_RECORD);
    source.seek(SeekFrom::Start(0))?;
    let mut reader = SummaryReader::new_with_options(options);
    while let Some(event) = reader.next_event() {
        match event? {
            SummaryReadEvent::ReadRequest(need) => {
                let n_read = source.read(reader.insert(need))?;
                reader.notify_read(n_read);
            }
            SummaryReadEvent::SeekRequest(to) => reader.notify_seeked(source.seek(to)?),
        }
    }
    Ok(reader.finish())
}

/// Fills a buffer with a part of the file, which must be there.
fn read_at<R: Read + Seek>(
    source: &mut R,
    n_bytes: u64,
    (offset, length): (u64, usize),
    buffer: &mut Vec<u8>,
) -> Result<(), RecordError> {
    let end = offset.checked_add(length as u64);
    if length > MAX_RECORD || end.is_none_or(|end| end > n_bytes) {
        return Err(RecordError::Damaged {
            reason: format!(
                "its index names a chunk of {length} bytes at {offset}; the file has {n_bytes} bytes"
            ),
        });
    }
    let io = |error: std::io::Error| RecordError::damaged(&error);
    source.seek(SeekFrom::Start(offset)).map_err(io)?;
    buffer.resize(length, 0);
    source.read_exact(buffer).map_err(io)
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let metadata = std::collections::BTreeMap::new();
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
        assert!(error.to_string().contains("exceeds limit"), "{error}");
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
