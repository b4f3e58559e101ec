//! Common Data Representation (CDR), the encoding of messages on the wire and in bags.
//!
//! Four bytes of encapsulation come first: `00 01 00 00` is little endian, `00 00 00 00` big
//! endian. Alignment counts from the byte after them.

use byteorder::{BigEndian, ByteOrder, LittleEndian};
use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

/// The encapsulation of plain CDR, little endian.
const LITTLE_ENDIAN: [u8; 4] = [0, 1, 0, 0];
/// Bytes that may follow a message: padding to a multiple of eight.
const MAX_PADDING: usize = 7;

/// The reason why bytes are no message of a type.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum CdrError {
    /// Too short for the encapsulation.
    #[error("{n_bytes} bytes; four come before any message")]
    Short {
        /// Number of bytes.
        n_bytes: usize,
    },
    /// An encapsulation other than plain CDR.
    #[error(
        "encapsulation {first:02x} {second:02x}; only plain CDR (00 00 and 00 01) is read; hint: \
         record with a DDS that sends classic CDR, such as Fast DDS or Cyclone DDS of ROS 2"
    )]
    Encapsulation {
        /// First byte.
        first: u8,
        /// Second byte.
        second: u8,
    },
    /// A message that was packed by itself.
    #[error(
        "its bytes are packed by zstd; packed chunks are read, packed messages are not; hint: pip \
         install rosbags && rosbags-convert --src BAG --dst BAG-plain --dst-storage mcap"
    )]
    Packed,
    /// Contents that do not have the form of the type.
    #[error("{reason} after {n_bytes} bytes in all")]
    Contents {
        /// The reason.
        reason: String,
        /// Length of the message, bytes.
        n_bytes: usize,
    },
    /// Bytes after the last field.
    #[error("{n_bytes} bytes follow its last field; hint: the type has another definition there")]
    LeftOver {
        /// Number of bytes.
        n_bytes: usize,
    },
}

/// A message as little-endian bytes, with encapsulation.
///
/// # Errors
/// A sequence of more than 2³² elements.
pub fn encode(message: &impl Serialize) -> Result<Vec<u8>, CdrError> {
    let mut bytes = LITTLE_ENDIAN.to_vec();
    let body = cdr_encoding::to_vec::<_, LittleEndian>(message);
    bytes.extend(body.map_err(|error| CdrError::Contents {
        reason: error.to_string(),
        n_bytes: 0,
    })?);
    Ok(bytes)
}

/// A message from its bytes, little or big endian. Memory is taken only for elements whose bytes are
/// there.
///
/// # Errors
/// Another encapsulation, bytes that end within a field, text that is not UTF-8, and bytes that
/// follow the last field.
pub fn decode<M: DeserializeOwned>(bytes: &[u8]) -> Result<M, CdrError> {
    let Some((&[first, second, _, _], body)) = bytes.split_first_chunk::<4>() else {
        let n_bytes = bytes.len();
        return Err(CdrError::Short { n_bytes });
    };
    match [first, second] {
        [0, 0] => body_of::<M, BigEndian>(body),
        [0, 1] => body_of::<M, LittleEndian>(body),
        [0x28, 0xb5] => Err(CdrError::Packed),
        _ => Err(CdrError::Encapsulation { first, second }),
    }
}

fn body_of<M: DeserializeOwned, Order: ByteOrder>(body: &[u8]) -> Result<M, CdrError> {
    let read = cdr_encoding::from_bytes::<M, Order>(body);
    let (message, n_read) = read.map_err(|error| CdrError::Contents {
        reason: error.to_string(),
        n_bytes: body.len(),
    })?;
    let n_bytes = body.len().saturating_sub(n_read);
    if n_bytes > MAX_PADDING {
        return Err(CdrError::LeftOver { n_bytes });
    }
    Ok(message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::{Header, OccupancyGrid, PoseStamped, Time};
    use proptest::prelude::*;

    fn header() -> Header {
        Header {
            stamp: Time {
                sec: 1,
                nanosec: 0x0203,
            },
            frame_id: "map".to_owned(),
        }
    }

    /// Written by hand from the rules of CDR.
    const HEADER: [u8; 20] = [
        0, 1, 0, 0, // little endian
        1, 0, 0, 0, // sec
        3, 2, 0, 0, // nanosec
        4, 0, 0, 0, b'm', b'a', b'p', 0, // length with the final zero, text
    ];

    #[test]
    fn bytes_are_those_of_the_standard() {
        assert_eq!(encode(&header()).unwrap(), HEADER);
        assert_eq!(decode::<Header>(&HEADER).unwrap(), header());
        let big = [
            0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 3, 0, 0, 0, 4, b'm', b'a', b'p', 0,
        ];
        assert_eq!(decode::<Header>(&big).unwrap(), header());
    }

    #[test]
    fn doubles_are_aligned_from_the_encapsulation_on() {
        let mut pose = PoseStamped {
            header: header(),
            ..PoseStamped::default()
        };
        pose.pose.position.x = 1.5;
        let bytes = encode(&pose).unwrap();
        // 16 bytes of header are a multiple of 8: no padding.
        assert_eq!(bytes[20..28], 1.5_f64.to_le_bytes());
        pose.header.frame_id = "odom".to_owned();
        let bytes = encode(&pose).unwrap();
        assert_eq!(bytes[21..28], [0; 7], "padding after 17 bytes of header");
        assert_eq!(bytes[28..36], 1.5_f64.to_le_bytes());
        assert_eq!(decode::<PoseStamped>(&bytes).unwrap(), pose);
    }

    #[test]
    fn bytes_that_are_no_message_are_refused() {
        let message = |bytes: &[u8]| decode::<Header>(bytes).unwrap_err().to_string();
        assert!(message(&[0, 1]).contains("2 bytes"));
        assert!(message(&[0, 7, 0, 0, 1, 2]).contains("encapsulation 00 07"));
        assert!(message(&HEADER[..18]).contains("end of input"));
        assert!(message(&[0x28, 0xb5, 0x2f, 0xfd, 0]).contains("packed by zstd"));
        let long = [&HEADER[..], &[0; 8]].concat();
        assert!(message(&long).contains("8 bytes follow"));
        // A sequence that claims 4 billion cells, and has none.
        let mut grid = encode(&OccupancyGrid::default()).unwrap();
        let end = grid.len();
        grid[end - 4..].fill(0xff);
        assert!(decode::<OccupancyGrid>(&grid).is_err());
    }

    proptest! {
        #[test]
        fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = decode::<OccupancyGrid>(&bytes);
            let _ = decode::<crate::messages::TFMessage>(&bytes);
            let _ = decode::<crate::messages::LaserScan>(&bytes);
        }
    }
}
