//! `formicar reproduce`: experiments of papers.

use crate::common::Room;
use std::collections::BTreeMap;

#[test]
fn a_quick_reproduction_writes_rows_tables_and_the_machine() {
    let room = Room::new();
    let reproduce = |jobs: &str, out: &str| {
        let quick = ["reproduce", "wang2019", "--quick", "--jobs", jobs];
        room.run(&[&quick[..], &["--out", out]].concat())
    };
    let run = reproduce("1", "lab");
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
    // Three seeds are too few to say anything.
    assert!(summary.contains("too few runs") && !summary.contains("| holds |"));
    let log = read("ompl-wang-aisles.log");
    assert!(log.starts_with("formicar version ") && log.contains("\n7 planners\nwang2019\n"));
    let report: serde_json::Value = serde_json::from_str(&read("report.json")).unwrap();
    assert_eq!(report["name"], "wang2019");
    // A row per iteration of three planners on three maps, three seeds each.
    assert_eq!(read("courses.csv").lines().count(), 1 + 3 * 3 * 3 * 200);
    assert_eq!(reproduce("3", "again").code, 0);
    // Jobs change no number but times.
    assert_eq!(untimed(&room, "lab"), untimed(&room, "again"));
    assert_eq!(room.run(&["reproduce", "nobody"]).code, 2);
    let no_jobs = room.run(&["reproduce", "wang2019", "--jobs", "0"]);
    assert_eq!(no_jobs.code, 2);
    assert!(
        no_jobs
            .stderr
            .contains("0 is not a whole number from 1 to 256")
    );
}

/// The rows of `wang2019` without their last two columns, which are times.
fn untimed(room: &Room, folder: &str) -> Vec<String> {
    let rows = std::fs::read_to_string(room.path(folder).join("wang2019/results.csv")).unwrap();
    let untimed = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        fields[..fields.len() - 2].join(",")
    };
    rows.lines().map(untimed).collect()
}

/// The numbers of a page by name.
fn numbers(page: &str) -> BTreeMap<&str, &str> {
    let marked = page.split("<data value=\"").skip(1);
    marked
        .map(|part| {
            let (name, rest) = part.split_once("\">").unwrap();
            (name, rest.split_once("</data>").unwrap().0)
        })
        .collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    0.5 * (values[half] + values[(values.len() - 1) / 2])
}

#[test]
fn the_page_of_li2024_tells_what_the_rows_tell() {
    let room = Room::new();
    let run = room.run(&["reproduce", "li2024", "--quick", "--out", "lab"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let read = |name: &str| std::fs::read_to_string(room.path("lab/li2024").join(name)).unwrap();
    let (page, rows, latex) = (read("index.html"), read("results.csv"), read("tables.tex"));
    assert!(read("MACHINE.md").contains("| formicar |"));
    assert!(read("summary.md").contains("Left out: there is no `../shared/data/car"));

    let mut lines = rows.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let heading = lines.next().unwrap();
    let column = |name: &str| heading.iter().position(|&n| n == name).unwrap();
    let own: Vec<Vec<&str>> = lines
        .filter(|row| (row[column("part")], row[column("method")]) == ("comparison", "astar"))
        .collect();
    assert_eq!(own.len(), 3);
    let values = |name: &str| -> Vec<f64> {
        let fields = own.iter().map(|row| row[column(name)]);
        fields.filter_map(|field| field.parse().ok()).collect()
    };
    let n_certified = own
        .iter()
        .filter(|row| row[column("certified")] == "true")
        .count();
    let numbers = numbers(&page);
    let prefix = "liTwoZeroTwoFour";
    for (name, expected) in [
        (
            "LengthAstarPathM",
            format!("{:.2}", median(values("native_length_m"))),
        ),
        ("LengthAstarCertified", n_certified.to_string()),
        (
            "TimeAstarTimeMs",
            format!("{:.1}", median(values("total_ms"))),
        ),
        ("SmoothnessAstarJ", format!("{:.4}", median(values("cost")))),
    ] {
        let name = format!("{prefix}{name}");
        assert_eq!(
            numbers.get(name.as_str()),
            Some(&expected.as_str()),
            "{name}"
        );
        assert!(
            latex.contains(&format!("\\newcommand{{\\{name}}}{{{expected}}}")),
            "{name}"
        );
    }
    // The page and LaTeX name the same numbers.
    assert_eq!(latex.matches("\\newcommand").count(), numbers.len());
    assert!(page.contains("<svg ") && !page.contains("<script") && !page.contains(" src="));
}
