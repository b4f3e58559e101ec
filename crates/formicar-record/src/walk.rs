//! MCAP files record after record, chunks unpacked, channels known by their topics.
//!
//! Lengths are checked against the file before memory is taken for them: the readers of the crate
//! `mcap` (0.26) trust the sizes of records in chunks.

use crate::error::RecordError;
use crate::topic::{RawMessage, Topic};
use mcap::records::{ChunkHeader, Record, op};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{self, Read, Seek, SeekFrom};

/// The longest record, packed or not, bytes.
const MAX_RECORD: u64 = 1 << 28;
/// A record begins with its kind and its length.
const N_HEAD: u64 = 9;

/// A function that takes messages.
pub(crate) type Visit<'v> = dyn FnMut(&Topic, RawMessage<'_>) -> Result<(), RecordError> + 'v;

/// What comes next in a file.
pub(crate) enum Next {
    /// A record of a kind, whose body was read.
    Record(u8),
    /// One that was passed over: nothing of it is needed.
    Passed,
    /// The end of the file lies within a record.
    Cut,
    /// The end of the file.
    End,
}

fn damaged(reason: String) -> RecordError {
    RecordError::Damaged { reason }
}

/// Reads the record at a place of a file into a buffer, and moves the place behind it.
pub(crate) fn next_record<R: Read + Seek>(
    source: &mut R,
    at: &mut u64,
    n_bytes: u64,
    body: &mut Vec<u8>,
) -> Result<Next, RecordError> {
    let left = n_bytes.saturating_sub(*at);
    if left < N_HEAD {
        return Ok(if left == 0 { Next::End } else { Next::Cut });
    }
    source.seek(SeekFrom::Start(*at))?;
    let mut head = [0; N_HEAD as usize];
    source.read_exact(&mut head)?;
    let (kind, length) = split_head(&head);
    if length > left - N_HEAD {
        return Ok(Next::Cut);
    }
    let start = *at;
    *at += N_HEAD + length;
    if matches!(kind, op::ATTACHMENT | op::METADATA | op::MESSAGE_INDEX) {
        return Ok(Next::Passed);
    }
    if length > MAX_RECORD {
        return Err(damaged(format!(
            "the record at byte {start} has {length} bytes; at most {MAX_RECORD} are read"
        )));
    }
    body.resize(length as usize, 0);
    source.read_exact(body)?;
    Ok(Next::Record(kind))
}

fn split_head(head: &[u8; N_HEAD as usize]) -> (u8, u64) {
    let [kind, length @ ..] = *head;
    (kind, u64::from_le_bytes(length))
}

/// The channels met so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Channels {
    /// Names of types.
    schemas: BTreeMap<u16, String>,
    topics: BTreeMap<u16, Topic>,
}

impl Channels {
    /// The topics by the numbers of their channels.
    pub(crate) fn topics(&self) -> &BTreeMap<u16, Topic> {
        &self.topics
    }

    /// Takes in a record: definitions are kept, messages are visited, chunks unpacked first.
    pub(crate) fn take(
        &mut self,
        kind: u8,
        body: &[u8],
        visit: &mut Visit<'_>,
    ) -> Result<(), RecordError> {
        if kind != op::CHUNK {
            return self.take_plain(kind, body, visit);
        }
        let Record::Chunk { header, data } = parsed(kind, body)? else {
            return Ok(());
        };
        let plain = unpacked(&header, &data)?;
        let mut rest = plain.as_ref();
        while !rest.is_empty() {
            let (kind, body, after) = split_record(rest)?;
            self.take_plain(kind, body, visit)?;
            rest = after;
        }
        Ok(())
    }

    fn take_plain(
        &mut self,
        kind: u8,
        body: &[u8],
        visit: &mut Visit<'_>,
    ) -> Result<(), RecordError> {
        if !matches!(kind, op::SCHEMA | op::CHANNEL | op::MESSAGE) {
            return Ok(());
        }
        match parsed(kind, body)? {
            Record::Schema { header, .. } => {
                self.schemas.insert(header.id, header.name);
            }
            Record::Channel(channel) => {
                let type_name = self.schemas.get(&channel.schema_id);
                let topic = Topic {
                    name: channel.topic,
                    type_name: type_name.cloned().unwrap_or_default(),
                    encoding: channel.message_encoding,
                };
                self.topics.insert(channel.id, topic);
            }
            Record::Message { header, data } => {
                let id = header.channel_id;
                let topic = self.topics.get(&id);
                let topic = topic.ok_or_else(|| {
                    damaged(format!(
                        "a message is on channel {id}, which is not defined"
                    ))
                })?;
                let message = RawMessage {
                    topic: &topic.name,
                    log_time_ns: header.log_time,
                    data: &data,
                };
                visit(topic, message)?;
            }
            _ => {}
        }
        Ok(())
    }
}

/// A record as a value.
pub(crate) fn parsed(kind: u8, body: &[u8]) -> Result<Record<'_>, RecordError> {
    mcap::parse_record(kind, body).map_err(|error| RecordError::damaged(&error))
}

/// Kind and body of the first of some records, and the records after it.
fn split_record(bytes: &[u8]) -> Result<(u8, &[u8], &[u8]), RecordError> {
    let cut = || damaged("a chunk ends within a record".to_owned());
    let (head, rest) = bytes.split_first_chunk().ok_or_else(cut)?;
    let (kind, length) = split_head(head);
    let length = usize::try_from(length).map_err(|_| cut())?;
    let (body, after) = rest.split_at_checked(length).ok_or_else(cut)?;
    Ok((kind, body, after))
}

/// The records of a chunk, whose size and checksum are those of its header.
fn unpacked<'a>(header: &ChunkHeader, data: &'a [u8]) -> Result<Cow<'a, [u8]>, RecordError> {
    let expected = header.uncompressed_size;
    if expected > MAX_RECORD {
        return Err(damaged(format!(
            "a chunk unpacks to {expected} bytes; at most {MAX_RECORD} are read"
        )));
    }
    let plain = match header.compression.as_str() {
        "" => Cow::Borrowed(data),
        "zstd" => Cow::Owned(read_out(zstd::Decoder::new(data), expected)?),
        "lz4" => Cow::Owned(read_out(lz4::Decoder::new(data), expected)?),
        other => {
            return Err(damaged(format!(
                "a chunk is packed by {other:?}; zstd and lz4 are read"
            )));
        }
    };
    if plain.len() as u64 != expected {
        return Err(damaged(format!(
            "a chunk unpacks to {} bytes; its header says {expected}",
            plain.len()
        )));
    }
    let (found, saved) = (crc32fast::hash(&plain), header.uncompressed_crc);
    if saved != 0 && found != saved {
        return Err(damaged(format!(
            "a chunk has checksum {found:08x}; its header says {saved:08x}; hint: the file is \
             damaged, take a copy"
        )));
    }
    Ok(plain)
}

/// All that a decoder gives, and one byte more than expected at most.
fn read_out<D: Read>(decoder: io::Result<D>, expected: u64) -> Result<Vec<u8>, RecordError> {
    let mut plain = Vec::new();
    decoder?.take(expected + 1).read_to_end(&mut plain)?;
    Ok(plain)
}
