//! The maps that clients may open: built-in, uploaded or kept.

use crate::options::Limits;
use crate::protocol::{MapChoice, NamedRequest, PoseList};
use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::builtin::{self, BuiltinMap};
use formicar::map::{OccupancyGrid, UnknownPolicy};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// A map as it was opened, shared by all clients.
#[derive(Debug)]
pub(crate) struct OpenMap {
    pub(crate) name: String,
    /// The hash that opens it again; none for a built-in map.
    pub(crate) hash: Option<String>,
    pub(crate) grid: OccupancyGrid,
    /// Doubts about the file that it was read from.
    pub(crate) warnings: Vec<String>,
    /// The same map, prepared for queries.
    pub(crate) obstacles: Arc<ObstacleMap>,
    pub(crate) builtin: Option<&'static BuiltinMap>,
}

impl OpenMap {
    fn new(name: String, grid: OccupancyGrid, builtin: Option<&'static BuiltinMap>) -> Self {
        let decided = grid.clone().with_unknown(UnknownPolicy::Occupied);
        Self {
            hash: builtin.is_none().then(|| hash(&grid)),
            name,
            warnings: Vec::new(),
            obstacles: Arc::new(ObstacleMap::new(&decided)),
            grid,
            builtin,
        }
    }

    /// The requests that come with it.
    pub(crate) fn requests(&self) -> Vec<NamedRequest> {
        let requests = self.builtin.map_or(&[][..], |builtin| builtin.requests);
        let named = |request: &builtin::BuiltinRequest| NamedRequest {
            id: request.id.to_owned(),
            start: list(request.start),
            goal: list(request.goal),
        };
        requests.iter().map(named).collect()
    }
}

/// A pose in the form of messages.
pub(crate) fn list(pose: Pose2) -> PoseList {
    [pose.x, pose.y, pose.heading]
}

/// The hash that opens a map again, of its frame and all its values.
fn hash(grid: &OccupancyGrid) -> String {
    let frame = grid.frame();
    let origin = frame.origin();
    let numbers = [frame.resolution_m(), origin.x, origin.y, origin.heading];
    let sizes = [frame.n_cols() as u64, frame.n_rows() as u64];
    let words = sizes.into_iter().chain(numbers.map(f64::to_bits));
    let values = grid.values().iter().map(|&value| value as u8);
    let bytes: Vec<u8> = words.flat_map(u64::to_le_bytes).chain(values).collect();
    format!("{:032x}", xxhash_rust::xxh3::xxh3_128(&bytes))
}

/// All maps that can be opened.
#[derive(Debug)]
pub(crate) struct MapStore {
    builtin: Vec<OnceLock<Arc<OpenMap>>>,
    kept: Mutex<VecDeque<Arc<OpenMap>>>,
    limits: Limits,
}

impl MapStore {
    pub(crate) fn new(limits: Limits) -> Self {
        Self {
            builtin: builtin::all().iter().map(|_| OnceLock::new()).collect(),
            kept: Mutex::default(),
            limits,
        }
    }

    /// Opens a map.
    ///
    /// # Errors
    /// A name or a hash that no map here has.
    pub(crate) fn open(&self, choice: &MapChoice) -> Result<Arc<OpenMap>, String> {
        match choice {
            MapChoice::Builtin(name) => self.builtin(name),
            MapChoice::Hash(hash) => self.kept(hash).ok_or_else(|| {
                format!(
                    "no map with the content {hash} is here; hint: drop its file on the page, or keep it again"
                )
            }),
        }
    }

    fn builtin(&self, name: &str) -> Result<Arc<OpenMap>, String> {
        let map = BuiltinMap::by_name(name).map_err(|error| error.to_string())?;
        let place = builtin::all().iter().position(|other| other.name == name);
        let drawn = || Arc::new(OpenMap::new(name.to_owned(), map.grid(), Some(map)));
        let entry = place.and_then(|place| self.builtin.get(place));
        Ok(entry.map_or_else(drawn, |entry| entry.get_or_init(drawn).clone()))
    }

    /// An uploaded or kept map.
    pub(crate) fn kept(&self, hash: &str) -> Option<Arc<OpenMap>> {
        let mut maps = self.lock().clone().into_iter();
        maps.find(|map| map.hash.as_deref() == Some(hash))
    }

    /// Keeps a map under the hash of its content; the oldest maps go when there are too many
    /// cells.
    ///
    /// # Errors
    /// More cells than a map may have.
    pub(crate) fn keep(&self, name: &str, grid: OccupancyGrid) -> Result<Arc<OpenMap>, String> {
        self.keep_file(name, grid, Vec::new())
    }

    /// The same with doubts about the file.
    ///
    /// # Errors
    /// More cells than a map may have.
    pub(crate) fn keep_file(
        &self,
        name: &str,
        grid: OccupancyGrid,
        warnings: Vec<String>,
    ) -> Result<Arc<OpenMap>, String> {
        let n_cells = grid.frame().n_cells();
        let max_cells = self.limits.max_cells;
        if n_cells > max_cells {
            return Err(format!(
                "{name}: {n_cells} cells, at most {max_cells} here; hint: coarser cells or a part of the map, or start the studio with --max-cells"
            ));
        }
        let map = Arc::new(OpenMap {
            warnings,
            ..OpenMap::new(name.to_owned(), grid, None)
        });
        let mut kept = self.lock();
        kept.retain(|other| other.hash != map.hash);
        kept.push_back(map.clone());
        let n_kept = |kept: &VecDeque<Arc<OpenMap>>| -> usize {
            kept.iter().map(|map| map.grid.frame().n_cells()).sum()
        };
        while n_kept(&kept) > self.limits.max_kept_cells && kept.len() > 1 {
            kept.pop_front();
        }
        Ok(map)
    }

    fn lock(&self) -> MutexGuard<'_, VecDeque<Arc<OpenMap>>> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(rows: &[&str]) -> OccupancyGrid {
        OccupancyGrid::from_rows(rows, 1.0).unwrap()
    }

    #[test]
    fn maps_are_found_by_name_and_by_content() {
        let store = MapStore::new(Limits::default());
        let by_name = |name: &str| store.open(&MapChoice::Builtin(name.to_owned()));
        assert!(Arc::ptr_eq(
            &by_name("aco20").unwrap(),
            &by_name("aco20").unwrap()
        ));
        assert!(by_name("../etc/passwd").unwrap_err().contains("aco20"));
        let kept = store.keep("a.png", grid(&["..", ".#"])).unwrap();
        let hash = kept.hash.clone().unwrap();
        assert!(Arc::ptr_eq(
            &store.open(&MapChoice::Hash(hash)).unwrap(),
            &kept
        ));
        assert!(store.open(&MapChoice::Hash("0".to_owned())).is_err());
    }

    #[test]
    fn the_oldest_are_forgotten_and_too_large_ones_refused() {
        let limits = Limits {
            max_cells: 4,
            max_kept_cells: 8,
            ..Limits::default()
        };
        let store = MapStore::new(limits);
        let rows = [["..", ".#"], ["..", "#."], [".#", ".."]];
        let hashes = rows.map(|rows| store.keep("m", grid(&rows)).unwrap().hash.clone().unwrap());
        let is_kept = hashes.each_ref().map(|hash| store.kept(hash).is_some());
        assert_eq!(is_kept, [false, true, true]);
        assert!(
            store
                .keep("m", grid(&["...", "..."]))
                .unwrap_err()
                .contains("at most 4")
        );
    }
}
