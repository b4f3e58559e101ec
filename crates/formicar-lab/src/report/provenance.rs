//! The provenance of numbers.

use xxhash_rust::xxh3::xxh3_128;

/// A 128-bit hash of a configuration as JSON.
pub fn config_hash(json: &str) -> String {
    format!("{:032x}", xxh3_128(json.as_bytes()))
}
