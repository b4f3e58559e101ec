//! Map and scenario formats on files by others, and on random bytes.

use formicar::geometry::Pose2;
use formicar::map::format::{
    GreyImage, ReadOptions, RosMapDescription, RosMapMode, TpcapCase, parse_car_scenarios,
    parse_matrix, parse_movingai_map, parse_movingai_scenarios, read_car_scenarios, read_map,
    read_movingai_scenarios, ros_pgm, ros_png, to_csv_matrix, to_movingai_map, to_text_matrix,
};
use formicar::map::{GridFrame, OccupancyGrid};
use formicar::vehicle::Vehicle;
use proptest::prelude::*;
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
        let grid = read_map(
            &path,
            &ReadOptions {
                resolution_m,
                ..ReadOptions::default()
            },
        )
        .unwrap();
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

#[test]
fn reads_movingai_maps_and_scenarios() {
    let Some(folder) = shared("movingai") else {
        return;
    };
    for path in files(&folder, "map") {
        let grid = read_map(&path, &ReadOptions::default()).unwrap();
        let again = parse_movingai_map(&to_movingai_map(&grid).unwrap(), 1.0).unwrap();
        assert_eq!(grid, again);
        let scenarios = read_movingai_scenarios(&path.with_extension("map.scen")).unwrap();
        assert!(scenarios.len() > 100);
        for scenario in scenarios {
            let size = (grid.frame().n_cols(), grid.frame().n_rows());
            assert_eq!(size, (scenario.n_cols, scenario.n_rows));
            assert!(!grid.is_lethal(scenario.start), "{scenario:?}");
            assert!(!grid.is_lethal(scenario.goal), "{scenario:?}");
        }
    }
}

#[test]
fn reads_tpcap_cases() {
    let Some(folder) = shared("tpcap") else {
        return;
    };
    for path in files(&folder, "csv") {
        let case = TpcapCase::read(&path).unwrap();
        let grid = read_map(&path, &ReadOptions::default()).unwrap();
        assert_eq!(grid, case.rasterize(0.1).unwrap());
        assert!(count(&grid, 100) > 0);
        for pose in [case.start, case.goal] {
            let cell = grid.frame().cell_at(pose.position()).unwrap();
            assert!(!grid.is_lethal(cell), "{}", path.display());
        }
        for corner in case.obstacles.iter().flatten() {
            let cell = grid.frame().cell_at(*corner).unwrap();
            assert!(grid.is_lethal(cell), "{}", path.display());
        }
    }
}

#[test]
fn reads_the_matrix_of_the_colony_papers() {
    let Some(folder) = shared("aco") else { return };
    let grid = read_map(&folder.join("aco20.txt"), &ReadOptions::default()).unwrap();
    assert_eq!((grid.frame().n_cols(), grid.frame().n_rows()), (20, 20));
    assert_eq!(grid.value(formicar::map::Cell::new(0, 5)), 100);
    assert_eq!(grid.value(formicar::map::Cell::new(0, 14)), 0);
}

/// Grids of any values among those given.
fn grids(values: &'static [i8]) -> impl Strategy<Value = OccupancyGrid> {
    let frames = (
        1_usize..20,
        1_usize..20,
        1e-3..1e3,
        any::<(i16, i16, i16)>(),
    );
    frames.prop_flat_map(move |(n_cols, n_rows, resolution_m, (x, y, yaw))| {
        let origin = Pose2::new(
            f64::from(x) / 7.0,
            f64::from(y) * 3e4,
            f64::from(yaw) / 5300.0,
        );
        let frame = GridFrame::new(n_cols, n_rows, resolution_m, origin).unwrap();
        let cells = prop::collection::vec(prop::sample::select(values), n_cols * n_rows);
        cells.prop_map(move |values| OccupancyGrid::new(frame, values).unwrap())
    })
}

const TRINARY: &[i8] = &[0, 100, -1];
const GRADED: &[i8] = &[0, 1, 2, 37, 50, 98, 99, 100, -1];
const PLAIN: &[i8] = &[0, 100];

fn check_ros_round_trip(grid: &OccupancyGrid) {
    let yaml = RosMapDescription::of_grid("map.pgm", grid).to_yaml();
    let description = RosMapDescription::from_yaml(&yaml).unwrap();
    for bytes in [ros_pgm(grid), ros_png(grid).unwrap()] {
        let image = GreyImage::from_bytes(&bytes).unwrap();
        assert_eq!(&description.to_grid(&image).unwrap(), grid);
    }
}

proptest! {
    #[test]
    fn ros_maps_come_back_as_they_went(trinary in grids(TRINARY), graded in grids(GRADED)) {
        check_ros_round_trip(&trinary);
        check_ros_round_trip(&graded);
    }

    #[test]
    fn matrices_and_movingai_maps_keep_their_cells(grid in grids(PLAIN)) {
        let texts = [to_text_matrix(&grid).unwrap(), to_csv_matrix(&grid).unwrap()];
        for text in texts {
            let read = parse_matrix(&text, 1.0).unwrap();
            prop_assert_eq!(read.values(), grid.values());
        }
        let read = parse_movingai_map(&to_movingai_map(&grid).unwrap(), 2.0).unwrap();
        prop_assert_eq!(read.values(), grid.values());
    }

    #[test]
    fn plain_and_raw_graymaps_agree(
        n_cols in 1_usize..9,
        max_value in 1_u16..=u16::MAX,
        values in prop::collection::vec(any::<u16>(), 72),
    ) {
        let n_rows = values.len() / n_cols;
        let values = values[..n_cols * n_rows].iter().map(|v| v % max_value.saturating_add(1));
        let values: Vec<u16> = values.collect();
        let words: Vec<String> = values.iter().map(u16::to_string).collect();
        let plain = format!("P2\n{n_cols} {n_rows} {max_value}\n{}", words.join("\n"));
        let mut raw = format!("P5\n{n_cols} {n_rows} {max_value}\n").into_bytes();
        for value in &values {
            let bytes = value.to_be_bytes();
            raw.extend(if max_value > 255 { &bytes[..] } else { &bytes[1..] });
        }
        let plain = GreyImage::from_bytes(plain.as_bytes()).unwrap();
        prop_assert_eq!(&plain.values, &values);
        prop_assert_eq!(GreyImage::from_bytes(&raw).unwrap(), plain);
    }
}

/// Every parser on the same bytes; each may refuse them, none may panic.
fn feed_all_parsers(bytes: &[u8]) {
    if let Ok(image) = GreyImage::from_bytes(bytes) {
        for mode in [RosMapMode::Trinary, RosMapMode::Scale, RosMapMode::Raw] {
            let grid = OccupancyGrid::free(GridFrame::new(1, 1, 0.1, Pose2::default()).unwrap());
            let mut description = RosMapDescription::of_grid("m", &grid);
            description.mode = mode;
            if let Ok(grid) = description.to_grid(&image) {
                assert_eq!(grid.values().len(), image.values.len());
            }
        }
    }
    let text = String::from_utf8_lossy(bytes);
    let _ = RosMapDescription::from_yaml(&text);
    let _ = parse_movingai_map(&text, 1.0);
    let _ = parse_movingai_scenarios(&text);
    let _ = parse_matrix(&text, 1.0);
    let _ = parse_car_scenarios(&text, Path::new(""));
    if let Ok(case) = TpcapCase::parse(&text) {
        // So coarse that far corners still give a small map.
        let _ = case.rasterize(1e10);
        let _ = case.rasterize(1e-300);
    }
}

/// A correct file of each kind.
fn samples() -> Vec<Vec<u8>> {
    let rows = ["#..?", "....", "?.##"];
    let grid = OccupancyGrid::from_rows(&rows, 0.05).unwrap();
    let plain = OccupancyGrid::from_rows(&["#..", "..#"], 0.05).unwrap();
    let car = r#"{"version": 1, "scenarios": [{"id": "a", "map": "m.yaml", "start": [1, 2, 0.5],
        "goal": [3, 4, -1], "vehicle": {"wheelbase": 2, "max_steer_deg": 40, "width": 1,
        "rear_overhang": 0.5, "front_overhang": 0.5, "length": 3}}]}"#;
    vec![
        ros_pgm(&grid),
        ros_png(&grid).unwrap(),
        b"P2 # c\n3 2 15\n0 1 2\n3 4 15\n".to_vec(),
        b"P5 2 1 1000 \x01\x00\x03\xe8".to_vec(),
        RosMapDescription::of_grid("m.pgm", &grid)
            .to_yaml()
            .into_bytes(),
        to_movingai_map(&plain).unwrap().into_bytes(),
        to_csv_matrix(&plain).unwrap().into_bytes(),
        to_text_matrix(&plain).unwrap().into_bytes(),
        b"version 1\n7\ta.map\t4\t3\t0\t0\t3\t2\t4.65685\n".to_vec(),
        b"1e9,5,0.5,1000000004,7,1,1,3,1000000000,5,1000000002,5,1000000000,8\n".to_vec(),
        car.as_bytes().to_vec(),
    ]
}

#[derive(Clone, Debug)]
enum Mutation {
    Set(usize, u8),
    Cut(usize),
    Remove(usize),
    Insert(usize, Vec<u8>),
}

fn mutations() -> impl Strategy<Value = Mutation> {
    let words: Vec<Vec<u8>> = [
        "-1",
        "0",
        "1e400",
        "nan",
        "99999999999999999999",
        "1000000000",
    ]
    .iter()
    .chain(&["\n", " ", ",", "#", "[", "{", "\"", "\u{feff}", "&a *a"])
    .map(|word| word.as_bytes().to_vec())
    .collect();
    prop_oneof![
        any::<(usize, u8)>().prop_map(|(at, byte)| Mutation::Set(at, byte)),
        any::<usize>().prop_map(Mutation::Cut),
        any::<usize>().prop_map(Mutation::Remove),
        (any::<usize>(), prop::sample::select(words)).prop_map(|(at, w)| Mutation::Insert(at, w)),
    ]
}

fn mutate(bytes: &mut Vec<u8>, mutation: &Mutation) {
    let n = bytes.len().max(1);
    match mutation {
        _ if bytes.is_empty() => {}
        Mutation::Set(at, byte) => bytes[at % n] = *byte,
        Mutation::Cut(at) => bytes.truncate(at % n),
        Mutation::Remove(at) => {
            bytes.remove(at % n);
        }
        Mutation::Insert(at, word) => {
            bytes.splice(at % n..at % n, word.iter().copied());
        }
    }
}

proptest! {
    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        feed_all_parsers(&bytes);
    }

    #[test]
    fn damaged_files_never_panic(
        mut bytes in prop::sample::select(samples()),
        mutations in prop::collection::vec(mutations(), 1..5),
    ) {
        for mutation in &mutations {
            mutate(&mut bytes, mutation);
        }
        feed_all_parsers(&bytes);
    }
}
