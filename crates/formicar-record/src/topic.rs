//! Topics, and messages as they stand in a file.

use crate::cdr;
use crate::error::RecordError;
use crate::messages::Message;

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
