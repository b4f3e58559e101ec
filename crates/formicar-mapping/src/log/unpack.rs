//! Compressed logs.

use crate::error::MappingError;
use flate2::read::MultiGzDecoder;
use std::borrow::Cow;
use std::io::Read;

/// The longest log that is unpacked, bytes.
const MAX_LOG_BYTES: u64 = 4 << 30;

/// The bytes of a log, unpacked where they are those of a gzip file.
///
/// # Errors
/// A damaged file, or one that unpacks to more than 4 GiB.
pub fn unpacked(bytes: &[u8]) -> Result<Cow<'_, [u8]>, MappingError> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(Cow::Borrowed(bytes));
    }
    let mut plain = Vec::new();
    let mut source = MultiGzDecoder::new(bytes).take(MAX_LOG_BYTES + 1);
    source
        .read_to_end(&mut plain)
        .map_err(|error| MappingError::Unpack {
            reason: error.to_string(),
        })?;
    if plain.len() as u64 > MAX_LOG_BYTES {
        return Err(MappingError::Unpack {
            reason: format!("it has more than {MAX_LOG_BYTES} bytes"),
        });
    }
    Ok(Cow::Owned(plain))
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::{Compression, write::GzEncoder};
    use std::io::Write;

    #[test]
    fn unpacks_gzip_and_leaves_the_rest() {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(b"ODOM 1").unwrap();
        let packed = encoder.finish().unwrap();
        assert_eq!(&*unpacked(&packed).unwrap(), b"ODOM 1");
        assert_eq!(&*unpacked(b"ODOM 1").unwrap(), b"ODOM 1");
        let cut = unpacked(&packed[..packed.len() - 3]).unwrap_err();
        assert!(cut.to_string().contains("cannot be unpacked"), "{cut}");
    }
}
