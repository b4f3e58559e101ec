//! Bags opened, and what commands take out of them.

use super::MapAddress;
use anyhow::{Context, Result};
use formicar::map::OccupancyGrid;
use formicar_record::{Bag, MapAt, check_folder};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A bag: a file, or the only file of a folder.
fn open(path: &Path) -> Result<Bag<File>> {
    let path = file_of(path)?;
    let name = path.display().to_string();
    let file = File::open(&path).with_context(|| format!("{name} cannot be read"))?;
    Bag::open(&name, file).with_context(|| name.clone())
}

fn file_of(path: &Path) -> Result<PathBuf> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    let name = path.display().to_string();
    let entries = fs::read_dir(path).with_context(|| format!("{name} cannot be read"))?;
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut names: Vec<String> = names.collect();
    names.sort();
    let file = check_folder(&name, &names)?;
    Ok(path.join(file))
}

/// The lidar log of a bag.
#[cfg(feature = "mapping")]
pub(crate) fn read_log(
    path: &Path,
    options: &formicar_record::LogOptions,
) -> Result<formicar_mapping::Log> {
    let log = formicar_record::read_log(&mut open(path)?, options);
    log.with_context(|| path.display().to_string())
}

/// The map at an address, and doubts about its bag.
pub(crate) fn read_map(address: &MapAddress) -> Result<(OccupancyGrid, Vec<String>)> {
    let mut bag = open(&address.bag)?;
    let at = address.time_s.map_or(MapAt::Last, MapAt::Time);
    let read = formicar_record::read_map(&mut bag, address.topic.as_deref(), at);
    let (map, _) = read.with_context(|| address.bag.display().to_string())?;
    Ok((map, bag.warnings().to_vec()))
}
