//! Files that are no MCAP, and the commands that make one of them.

use crate::error::RecordError;

/// First bytes of an MCAP file.
const MCAP: &[u8] = b"\x89MCAP0\r\n";
/// Bytes that tell kinds of files apart.
pub(crate) const N_MAGIC: usize = 16;

/// Checks by its first bytes that a file is MCAP. `name` appears in the command that converts it.
///
/// # Errors
/// A bag of ROS 1, one in `SQLite`, a packed file, or bytes of no bag, each with the command that
/// converts it.
pub fn check_kind(name: &str, first_bytes: &[u8]) -> Result<(), RecordError> {
    if first_bytes.starts_with(MCAP) {
        return Ok(());
    }
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let (kind, hint) = match first_bytes {
        [b'#', b'R', b'O', b'S', b'B', b'A', b'G', ..] => ("a bag of ROS 1", of_ros1(name, stem)),
        [b'S', b'Q', b'L', b'i', b't', b'e', b' ', ..] => ("a bag in SQLite", of_sqlite(name)),
        [0x28, 0xb5, 0x2f, 0xfd, ..] => ("a file packed by zstd", format!("zstd -d {name}")),
        [0x04, 0x22, 0x4d, 0x18, ..] => ("a file packed by lz4", format!("lz4 -d {name}")),
        [0x1f, 0x8b, ..] => ("a file packed by gzip", format!("gunzip {name}")),
        _ => {
            let reason = format!(
                "{name} begins with {first_bytes:02x?}, not with the eight bytes of MCAP; hint: \
                 `ros2 bag info` says what it is"
            );
            return Err(RecordError::Damaged { reason });
        }
    };
    let kind = format!("{name}, {kind},");
    Err(RecordError::Foreign { kind, hint })
}

fn of_ros1(name: &str, stem: &str) -> String {
    format!(
        "pip install rosbags && rosbags-convert --src {name} --dst {stem} --dst-storage mcap \
         --src-typestore ros1_noetic --dst-typestore ros2_jazzy"
    )
}

/// The command takes the folder, in which the description of the bag is.
fn of_sqlite(name: &str) -> String {
    let folder = match name.rsplit_once('/') {
        Some((folder, _)) => folder,
        None => ".",
    };
    let out = match folder {
        "." => "bag".to_owned(),
        folder => folder.to_owned(),
    };
    format!(
        "pip install rosbags && rosbags-convert --src {folder} --dst {out}-mcap --dst-storage mcap"
    )
}

/// The file to read of a bag that is a folder, given its name and the names of its files.
///
/// # Errors
/// A folder with no MCAP file, or with more than one, with the command that converts or joins them.
pub fn check_folder<'a>(name: &str, files: &'a [String]) -> Result<&'a str, RecordError> {
    let ends_with = |extension: &str| {
        let files = files.iter().filter(|file| file.ends_with(extension));
        files.map(String::as_str).collect::<Vec<_>>()
    };
    let mcaps = ends_with(".mcap");
    let refused = |kind: String, hint: String| Err(RecordError::Foreign { kind, hint });
    if let [only] = mcaps[..] {
        return Ok(only);
    }
    if mcaps.len() > 1 {
        return refused(
            format!("{name}, a bag split into {} files,", mcaps.len()),
            format!(
                "pip install rosbags && rosbags-convert --src {name} --dst {name}-joined \
                 --dst-storage mcap, or name one of {}",
                mcaps.join(", ")
            ),
        );
    }
    if let [packed, ..] = ends_with(".mcap.zstd")[..] {
        let kind = format!("{name}, a bag whose files are packed by zstd,");
        return refused(kind, format!("zstd -d {name}/{packed}"));
    }
    if !ends_with(".db3").is_empty() || !ends_with(".db3.zstd").is_empty() {
        let inside = format!("{name}/x");
        return refused(format!("{name}, a bag in SQLite,"), of_sqlite(&inside));
    }
    let reason = format!("the folder {name} has no .mcap file");
    Err(RecordError::Damaged { reason })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_files_are_refused_with_a_command() {
        let hint = |name: &str, bytes: &[u8]| check_kind(name, bytes).unwrap_err().to_string();
        assert!(check_kind("a.mcap", b"\x89MCAP0\r\n.").is_ok());
        assert!(
            hint("a.bag", b"#ROSBAG V2.0\n").contains("--src a.bag --dst a --dst-storage mcap")
        );
        assert!(hint("b/a.db3", b"SQLite format 3\0").contains("--src b --dst b-mcap"));
        assert!(hint("a.mcap.zstd", b"\x28\xb5\x2f\xfd").contains("zstd -d a.mcap.zstd"));
        assert!(hint("a.mcap", b"hello").contains("not with the eight bytes of MCAP"));
        assert!(hint("a.mcap", b"").contains("begins with []"));
    }

    #[test]
    fn a_folder_is_read_where_it_has_one_file() {
        let folder = |files: &[&str]| {
            let files: Vec<String> = files.iter().map(|&file| file.to_owned()).collect();
            check_folder("drive", &files).map(str::to_owned)
        };
        assert_eq!(folder(&["metadata.yaml", "a_0.mcap"]).unwrap(), "a_0.mcap");
        let message = |files: &[&str]| folder(files).unwrap_err().to_string();
        assert!(message(&["a_0.mcap", "a_1.mcap"]).contains("split into 2 files"));
        assert!(message(&["a_0.mcap.zstd"]).contains("zstd -d drive/a_0.mcap.zstd"));
        assert!(message(&["a_0.db3"]).contains("--src drive --dst drive-mcap"));
        assert!(message(&["metadata.yaml"]).contains("no .mcap file"));
    }
}
