//! Errors of bags: thing, value, limit, hint.

use crate::cdr::CdrError;
use formicar_mapping::MappingError;
use thiserror::Error;

/// The reason why a bag cannot be read or written.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RecordError {
    /// A file of another kind, with the command that converts it.
    #[error("{kind} is not read; only MCAP files of ROS 2 are; hint: {hint}")]
    Foreign {
        /// The kind of file.
        kind: String,
        /// The command that converts it.
        hint: String,
    },
    /// A file that is damaged or no MCAP file.
    #[error("the bag cannot be read: {reason}")]
    Damaged {
        /// The reason.
        reason: String,
    },
    /// A file that cannot be written.
    #[error("the bag cannot be written: {reason}")]
    Write {
        /// The reason.
        reason: String,
    },
    /// A message whose bytes do not have the form of its type.
    #[error("{topic}: a message at {time_s} s is no {type_name}: {source}")]
    Message {
        /// Its topic.
        topic: String,
        /// Time at which it was recorded, seconds.
        time_s: f64,
        /// The type that was expected.
        type_name: &'static str,
        /// The reason.
        source: CdrError,
    },
    /// A message with a value that makes no sense.
    #[error("{topic}: the message of {time_s} s has {what} {value}; {limit}")]
    Value {
        /// Its topic.
        topic: String,
        /// Its time, seconds.
        time_s: f64,
        /// The field.
        what: &'static str,
        /// Its value.
        value: String,
        /// The limit.
        limit: &'static str,
    },
    /// A bag without a topic of the type that is needed.
    #[error("the bag has no topic of type {type_name}; it has {topics}")]
    NoTopic {
        /// The type.
        type_name: &'static str,
        /// Names and types of the topics there are.
        topics: String,
    },
    /// A bag in which a topic must be chosen.
    #[error("the bag has {n} topics of type {type_name}: {topics}; hint: {hint} chooses one")]
    ManyTopics {
        /// The type.
        type_name: &'static str,
        /// Number of topics.
        n: usize,
        /// Their names.
        topics: String,
        /// The flag that chooses.
        hint: &'static str,
    },
    /// A topic that is not in the bag, or has another type.
    #[error("the topic {topic} {problem}; topics of type {type_name}: {topics}")]
    OtherTopic {
        /// The name that was asked for.
        topic: String,
        /// The problem.
        problem: String,
        /// The type that is needed.
        type_name: &'static str,
        /// Names of topics that would do.
        topics: String,
    },
    /// Coordinate frames that are not connected.
    #[error("no transforms lead from {from:?} to {to:?}: {reason}; hint: {hint}")]
    Frames {
        /// The frame of the sensor.
        from: String,
        /// The frame in which it is needed.
        to: String,
        /// The place where the chain ends.
        reason: String,
        /// A hint.
        hint: &'static str,
    },
    /// A laser whose plane is not level.
    #[error(
        "the laser in frame {frame:?} is tilted by {tilt_deg:.1} degrees; at most {limit_deg} are \
         allowed, since a plane of scans makes the map; hint: choose the topic of a level laser"
    )]
    Tilted {
        /// The frame of the laser.
        frame: String,
        /// Angle between the laser's axis and the vertical, degrees.
        tilt_deg: f64,
        /// The largest that is allowed, degrees.
        limit_deg: f64,
    },
    /// Messages that do not go together.
    #[error("{thing}: {value}; {limit}; hint: {hint}")]
    Mismatch {
        /// The thing that does not fit.
        thing: String,
        /// Its value.
        value: String,
        /// The limit.
        limit: String,
        /// A hint.
        hint: String,
    },
    /// A log that mapping refuses.
    #[error(transparent)]
    Log(#[from] MappingError),
}

impl RecordError {
    /// A damaged file, for the reason that a reader gives, with all its causes.
    pub(crate) fn damaged(error: &dyn std::error::Error) -> Self {
        let mut reason = error.to_string();
        let mut cause = error.source();
        while let Some(error) = cause {
            let words = error.to_string();
            if !reason.contains(&words) {
                reason = format!("{reason}: {words}");
            }
            cause = error.source();
        }
        Self::Damaged { reason }
    }
}

/// A source that cannot be read.
impl From<std::io::Error> for RecordError {
    fn from(error: std::io::Error) -> Self {
        Self::damaged(&error)
    }
}
