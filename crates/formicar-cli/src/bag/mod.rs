//! Bags of ROS 2 as files: logs and maps are read from them.

mod address;
#[cfg(feature = "record")]
mod open;

pub(crate) use address::MapAddress;
#[cfg(all(feature = "mapping", feature = "record"))]
pub(crate) use open::read_log;
#[cfg(feature = "record")]
pub(crate) use open::read_map;

use std::path::Path;

/// Extensions of bags, among them those that are refused with the command that converts them.
const EXTENSIONS: [&str; 4] = [".mcap", ".mcap.zstd", ".db3", ".bag"];

/// True where a path is that of a bag: by its extension, or a folder with a description of one.
pub(crate) fn is_bag(path: &Path) -> bool {
    let name = path.to_string_lossy().to_ascii_lowercase();
    let ends = EXTENSIONS.iter().any(|extension| name.ends_with(extension));
    ends || path.join("metadata.yaml").is_file()
}

/// The refusal of a bag by a build that cannot read it.
#[cfg(not(feature = "record"))]
pub(crate) fn refuse<T>(path: &Path) -> anyhow::Result<T> {
    anyhow::bail!(
        "{} is a bag, and this build lacks the feature `record`; hint: cargo install formicar-cli \
         --features record",
        path.display()
    )
}
