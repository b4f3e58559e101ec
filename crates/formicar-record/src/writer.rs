//! Bags to write: MCAP with the profile of ROS 2.

use crate::cdr;
use crate::error::RecordError;
use crate::messages::{Message, definition};
use crate::qos::Durability;
use mcap::records::MessageHeader;
use mcap::{Compression, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::io::{Seek, Write};

/// Writes messages into an MCAP file that `ros2 bag play`, Foxglove and Lichtblick open.
///
/// Chunks are packed by zstd. The same messages give the same bytes.
pub struct BagWriter<W: Write + Seek> {
    writer: Writer<W>,
    channels: BTreeMap<String, Channel>,
}

struct Channel {
    id: u16,
    type_name: &'static str,
    n_messages: u32,
}

impl<W: Write + Seek> BagWriter<W> {
    /// A bag without messages.
    ///
    /// # Errors
    /// A sink that cannot be written.
    pub fn new(sink: W) -> Result<Self, RecordError> {
        let options = WriteOptions::new()
            .profile("ros2")
            .library(concat!("formicar ", env!("CARGO_PKG_VERSION")))
            .compression(Some(Compression::Zstd))
            // Threads would end chunks at other bytes.
            .compression_threads(0);
        let writer = Writer::with_options(sink, options).map_err(|error| failed(&error))?;
        Ok(Self {
            writer,
            channels: BTreeMap::new(),
        })
    }

    /// Names a topic before its first message. Topics that are not named are volatile.
    ///
    /// # Errors
    /// A topic that has another type already, or a sink that cannot be written.
    pub fn advertise<M: Message>(
        &mut self,
        topic: &str,
        durability: Durability,
    ) -> Result<(), RecordError> {
        if let Some(channel) = self.channels.get(topic) {
            if channel.type_name == M::TYPE {
                return Ok(());
            }
            return Err(RecordError::Write {
                reason: format!(
                    "{topic} has messages of type {}, and a {} cannot follow",
                    channel.type_name,
                    M::TYPE
                ),
            });
        }
        let text = definition::<M>();
        let schema = self.writer.add_schema(M::TYPE, "ros2msg", text.as_bytes());
        let schema = schema.map_err(|error| failed(&error))?;
        let metadata = BTreeMap::from([("offered_qos_profiles".to_owned(), durability.profiles())]);
        let id = self.writer.add_channel(schema, topic, "cdr", &metadata);
        let channel = Channel {
            id: id.map_err(|error| failed(&error))?,
            type_name: M::TYPE,
            n_messages: 0,
        };
        self.channels.insert(topic.to_owned(), channel);
        Ok(())
    }

    /// Adds a message, recorded at `time_ns` nanoseconds.
    ///
    /// # Errors
    /// As [`Self::advertise`].
    pub fn write<M: Message>(
        &mut self,
        topic: &str,
        time_ns: u64,
        message: &M,
    ) -> Result<(), RecordError> {
        self.advertise::<M>(topic, Durability::Volatile)?;
        let data = cdr::encode(message).map_err(|error| failed(&error))?;
        let Some(channel) = self.channels.get_mut(topic) else {
            return Ok(());
        };
        let header = MessageHeader {
            channel_id: channel.id,
            sequence: channel.n_messages,
            log_time: time_ns,
            publish_time: time_ns,
        };
        channel.n_messages += 1;
        let written = self.writer.write_to_known_channel(&header, &data);
        written.map_err(|error| failed(&error))
    }

    /// Ends the file and gives back the sink.
    ///
    /// # Errors
    /// A sink that cannot be written.
    pub fn finish(mut self) -> Result<W, RecordError> {
        self.writer.finish().map_err(|error| failed(&error))?;
        Ok(self.writer.into_inner())
    }
}

fn failed(error: &dyn std::error::Error) -> RecordError {
    RecordError::Write {
        reason: error.to_string(),
    }
}
