//! `plan --ants`: pictures and films of colonies.

use crate::common::{Room, Run, runs_slow_tests};
use std::fs;

/// A small colony for a point through the door of the room, with more flags.
fn few_ants(room: &Room, more: &[&str]) -> Run {
    let few = [
        "--planner",
        "lei2020",
        "--vehicle",
        "point",
        "--set",
        "colony.n_ants=20",
        "--set",
        "colony.n_iterations=4",
    ];
    room.plan(&[&few[..], more].concat())
}

#[test]
fn the_extension_tells_picture_from_film() {
    let room = Room::new();
    for (name, begins) in [
        ("a.svg", &b"<svg"[..]),
        ("a.png", b"\x89PNG"),
        ("a.GIF", b"GIF89a"),
    ] {
        let run = few_ants(&room, &["--ants", name]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{name}");
        assert!(
            fs::read(room.path(name)).unwrap().starts_with(begins),
            "{name}"
        );
    }
    let svg = room.read("a.svg");
    for words in ["iteration 4: ", "pheromone, log scale", "best so far"] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn ants_walk_alike_watched_or_not_and_on_any_threads() {
    let room = Room::new();
    let path = |more: &[&str]| {
        let mut answer = few_ants(&room, &[&["--json"], more].concat()).json();
        answer["timing"] = serde_json::Value::Null;
        answer
    };
    let alone = path(&[]);
    assert_eq!(path(&["--ants", "one.svg"]), alone);
    assert_eq!(path(&["--ants", "two.svg", "--threads", "2"]), alone);
    assert_eq!(room.read("one.svg"), room.read("two.svg"));
}

#[test]
fn a_planner_without_ants_is_refused_before_it_plans() {
    let room = Room::new();
    let refused = room.plan(&["--ants", "ants.svg"]);
    refused.assert_refused(&[
        "--ants",
        "formicar is not an ant colony",
        "--planner lei2020",
    ]);
    few_ants(&room, &["--ants", "ants.txt"]).assert_refused(&["ants.txt", ".svg or .png or .gif"]);
    few_ants(&room, &["--ants", "a.gif", "--stdin"]).assert_refused(&["--ants", "--stdin"]);
    assert_eq!(room.files(), ["room.pgm", "room.yaml"]);
}

#[test]
fn where_no_ant_could_walk_there_is_no_picture() {
    let room = Room::new();
    let door_closed = ["--keep-out", "5.8,5 6.6,5 6.6,8 5.8,8"];
    let run = few_ants(&room, &[&["--ants", "ants.svg"][..], &door_closed].concat());
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(
        run.stderr
            .contains("no ants walked: ants.svg is not written"),
        "{}",
        run.stderr
    );
    assert_eq!(room.files(), ["room.pgm", "room.yaml"]);
}

#[test]
fn films_of_grid_problems_stay_below_a_megabyte() {
    let room = Room::new();
    let maps = ["lei-map3", "lei-map1"];
    let n_maps = if runs_slow_tests() { 2 } else { 1 };
    for map in &maps[..n_maps] {
        let film = ["--planner", "lei2020", "--seed", "1", "--ants", "film.gif"];
        let run = room.run(&[&["plan", "--map", map][..], &film].concat());
        assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
        let n_bytes = fs::metadata(room.path("film.gif")).unwrap().len();
        assert!(n_bytes <= 1_000_000, "{map}: {n_bytes} bytes");
    }
}
