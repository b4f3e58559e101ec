//! Sessions: a mapper as a file, with version and checksum, to be continued.
//!
//! A line `formicar-session 1 CHECKSUM`, then JSON packed by gzip. Submaps are not in it: they
//! follow from scans and poses, and are built again to the bit.

use crate::error::MappingError;
use crate::mapper::{Mapper, SavedMapper};
use crate::scan::LaserScan;
use flate2::read::GzDecoder;
use flate2::{Compression, GzBuilder};
use formicar::numeric::Fnv;
use std::io::{Read, Write};

/// The version that is written and read.
pub const SESSION_VERSION: u32 = 1;
const NAME: &str = "formicar-session";
/// The longest session that is unpacked, bytes.
const MAX_BYTES: u64 = 4 << 30;
/// Poses beyond this are no robot's, meters.
const MAX_POSE_M: f64 = 1e7;

impl Mapper {
    /// The session as the bytes of a file. The same mapper gives the same bytes.
    ///
    /// # Errors
    /// A session that cannot be packed; this does not happen while memory lasts.
    pub fn to_session(&self) -> Result<Vec<u8>, MappingError> {
        let failed = |error: &dyn std::fmt::Display| MappingError::Session {
            reason: error.to_string(),
        };
        let mut packer = GzBuilder::new().write(Vec::new(), Compression::fast());
        let json = serde_json::to_vec(&self.saved()).map_err(|e| failed(&e))?;
        packer.write_all(&json).map_err(|e| failed(&e))?;
        let packed = packer.finish().map_err(|e| failed(&e))?;
        let mut bytes =
            format!("{NAME} {SESSION_VERSION} {:016x}\n", checksum(&packed)).into_bytes();
        bytes.extend(packed);
        Ok(bytes)
    }

    /// A mapper from the bytes of a session.
    ///
    /// # Errors
    /// No session, another version, a wrong checksum, or contents that contradict each other.
    pub fn from_session(bytes: &[u8]) -> Result<Self, MappingError> {
        let packed = payload(bytes)?;
        let mut json = Vec::new();
        let mut unpacker = GzDecoder::new(packed).take(MAX_BYTES + 1);
        unpacker
            .read_to_end(&mut json)
            .map_err(|error| bad(format!("it cannot be unpacked: {error}")))?;
        if json.len() as u64 > MAX_BYTES {
            return Err(bad(format!("it has more than {MAX_BYTES} bytes")));
        }
        let saved: SavedMapper =
            serde_json::from_slice(&json).map_err(|error| bad(error.to_string()))?;
        check(&saved)?;
        Ok(Self::restored(saved))
    }
}

fn bad(reason: String) -> MappingError {
    MappingError::Session { reason }
}

fn checksum(packed: &[u8]) -> u64 {
    let mut hash = Fnv::default();
    hash.add(packed);
    hash.value()
}

/// What follows the first line, its checksum confirmed.
fn payload(bytes: &[u8]) -> Result<&[u8], MappingError> {
    let end = bytes.iter().take(80).position(|&byte| byte == b'\n');
    let line = end.and_then(|end| std::str::from_utf8(&bytes[..end]).ok());
    let words: Vec<&str> = line.unwrap_or_default().split(' ').collect();
    let (Some(end), [NAME, version, sum]) = (end, words.as_slice()) else {
        return Err(bad(format!(
            "it does not begin with {NAME:?}; hint: `map build --session` writes one"
        )));
    };
    if *version != SESSION_VERSION.to_string() {
        return Err(bad(format!(
            "version {version}; this program reads version {SESSION_VERSION}; hint: build the map \
             again from its logs"
        )));
    }
    let packed = &bytes[end + 1..];
    let found = format!("{:016x}", checksum(packed));
    if *sum != found {
        return Err(bad(format!(
            "checksum {found}, the file says {sum}; hint: the file is damaged, take a copy"
        )));
    }
    Ok(packed)
}

/// Checks that all indices lead somewhere, and that numbers are those of maps.
fn check(saved: &SavedMapper) -> Result<(), MappingError> {
    saved.config.check()?;
    saved.policy.check()?;
    let front = &saved.front;
    let n_nodes = front.nodes.len();
    let n_beams = saved.n_beams.unwrap_or(0);
    for (i, node) in front.nodes.iter().enumerate() {
        let is_pose = node.front_pose.is_finite()
            && node.front_pose.position().norm() < MAX_POSE_M
            && node.motion.is_finite();
        let is_range = |range: &f32| (0.0..1e5).contains(range);
        let sweep = &node.sweep;
        let is_sweep = sweep.ranges_m.len() == n_beams
            && n_beams <= LaserScan::MAX_BEAMS
            && sweep.ranges_m.iter().all(is_range)
            && sweep.angle_step_rad > 0.0
            && sweep.angle_step_rad < 1.0
            && sweep.first_angle_rad.abs() <= 10.0;
        if !is_pose || !is_sweep || node.scan >= front.places.len() {
            return Err(bad(format!(
                "key scan {i} has an impossible pose, range or index"
            )));
        }
    }
    let lost_place = front.places.iter().position(|p| p.node >= n_nodes.max(1));
    if let Some(i) = lost_place {
        return Err(bad(format!(
            "scan {i} hangs on a key scan that is not there"
        )));
    }
    let ranges = front.submaps.iter().chain(&front.growing);
    let mut bad_ranges = ranges.filter(|(first, end)| first > end || *end > n_nodes);
    if bad_ranges.next().is_some() || front.growing.len() > 2 {
        return Err(bad(
            "its submaps name key scans that are not there".to_owned()
        ));
    }
    let limit = 4 * n_nodes + 4;
    let n_inserted: usize = front.submaps.iter().map(|(first, end)| end - first).sum();
    if n_inserted > limit {
        return Err(bad(format!(
            "{n_inserted} key scans in submaps; at most {limit}"
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::MappingConfig;

    fn session() -> Vec<u8> {
        Mapper::new(MappingConfig::default())
            .unwrap()
            .to_session()
            .unwrap()
    }

    #[test]
    fn damage_is_noticed() {
        assert!(Mapper::from_session(&session()).is_ok());
        let message = |bytes: &[u8]| Mapper::from_session(bytes).unwrap_err().to_string();
        let mut flipped = session();
        let last = flipped.len() - 5;
        flipped[last] ^= 1;
        assert!(message(&flipped).contains("checksum"));
        assert!(message(b"hello").contains("does not begin"));
        let text = String::from_utf8_lossy(&session()).replacen("session 1", "session 9", 1);
        assert!(message(text.as_bytes()).contains("version 9"));
    }
}
