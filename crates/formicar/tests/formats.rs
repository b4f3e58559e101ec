//! Map and scenario formats on files by others, and on random bytes.

use formicar::map::OccupancyGrid;
use formicar::map::format::{ReadOptions, read_car_scenarios, read_map};
use formicar::vehicle::Vehicle;
use std::path::{Path, PathBuf};

/// A folder of the shared data, or a printed word that it is absent.
fn shared(folder: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(folder);
    if !path.is_dir() {
        println!("skipped: {} is absent", path.display());
        return None;
    }
    Some(path)
}

fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "no .{extension} in {}", folder.display());
    files
}

fn count(grid: &OccupancyGrid, value: i8) -> usize {
    grid.values().iter().filter(|&&v| v == value).count()
}

#[test]
fn reads_ros_maps_by_others() {
    let Some(folder) = shared("ros") else { return };
    for path in files(&folder, "yaml") {
        let grid = OccupancyGrid::read_ros_yaml(&path).unwrap();
        let n_cells = grid.frame().n_cells();
        assert!(count(&grid, 0) > n_cells / 20, "{}", path.display());
        assert!(count(&grid, 100) > 0, "{}", path.display());
    }
    let depot = OccupancyGrid::read_ros_yaml(folder.join("depot.yaml")).unwrap();
    assert_eq!((depot.frame().n_cols(), depot.frame().n_rows()), (604, 307));
    assert_eq!(count(&depot, -1), 0, "its free_thresh makes grey 205 free");
    for path in files(&folder, "pgm") {
        let error = read_map(&path, &ReadOptions::default()).unwrap_err();
        assert!(error.to_string().contains("the resolution is missing"));
        let resolution_m = Some(0.2);
        let grid = read_map(&path, &ReadOptions { resolution_m }).unwrap();
        assert_eq!(grid.frame().resolution_m(), 0.2);
    }
}

#[test]
fn reads_car_scenarios_with_their_maps() {
    let Some(folder) = shared("car") else { return };
    for path in files(&folder, "json") {
        let scenarios = read_car_scenarios(&path).unwrap();
        assert_eq!(scenarios.len(), 10);
        let grid = read_map(&scenarios[0].map, &ReadOptions::default()).unwrap();
        for scenario in scenarios {
            Vehicle::new(scenario.vehicle).unwrap();
            for pose in [scenario.start, scenario.goal] {
                let cell = grid.frame().cell_at(pose.position()).unwrap();
                assert!(!grid.is_lethal(cell), "{}", scenario.id);
            }
        }
    }
}
