//! `formicar reproduce`: experiments of papers.

mod common;

use common::Room;

#[test]
fn a_quick_reproduction_writes_rows_tables_and_the_machine() {
    let room = Room::new();
    let run = room.run(&["reproduce", "wang2019", "--quick", "--out", "lab"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let read = |name: &str| std::fs::read_to_string(room.path("lab/wang2019").join(name)).unwrap();
    let rows = read("results.csv");
    // Three maps, seven variants, three seeds.
    assert_eq!(rows.lines().count(), 1 + 3 * 7 * 3);
    let heading: Vec<&str> = rows.lines().next().unwrap().split(',').collect();
    assert!(heading.contains(&"length_cells") && heading.contains(&"n_squeezes"));
    let summary = read("summary.md");
    assert!(summary.contains("| zhang2016 | 3/3 | 3 |"), "{summary}");
    assert!(summary.contains("| wang2019 | 3/3 | 0 |"), "{summary}");
    assert!(read("MACHINE.md").contains("| formicar |"));
    assert_eq!(room.run(&["reproduce", "nobody"]).code, 2);
}
