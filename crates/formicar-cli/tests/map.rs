//! `map`: info, convert, generate, clearance.

use crate::common::Room;
use serde_json::json;

#[test]
fn info_counts_the_cells() {
    let room = Room::new();
    let info = room.run(&["map", "info", "room.yaml", "--json"]).json();
    assert_eq!(info["schema"], "formicar/map-info/1");
    assert_eq!((&info["n_cols"], &info["n_rows"]), (&json!(60), &json!(40)));
    assert_eq!(info["extents_m"], json!([[0.0, 0.0], [12.0, 8.0]]));
    // The walls around, and one of rows 1 to 25 across.
    assert_eq!(info["n_occupied"], 2 * 60 + 2 * 38 + 25);
    assert_eq!(info["n_free"].as_u64().unwrap() + 221, 2400);
    assert_eq!(info["n_components"], 1);
    assert_eq!(info["largest_component_cells"], info["n_free"]);
    // Between the wall across and that of one side there are 28 or 29 columns.
    let widest = info["widest"]["clearance_m"].as_f64().unwrap();
    assert!((2.7..3.6).contains(&widest), "{widest}");
    let text = room.run(&["map", "info", "room.yaml"]).stdout;
    assert!(text.starts_with("size        60 x 40 cells of 0.2 m: 12.00 x 8.00 m\n"));
}

#[test]
fn info_follows_yaw_and_unknown_policy() {
    let room = Room::new();
    room.write("u.pgm", b"P5\n3 1\n255\n\xfe\xcd\xfe");
    let yaml = "image: u.pgm\nresolution: 1.0\norigin: [10.0, 0.0, 1.5707963267948966]\n\
                negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    room.write("u.yaml", yaml);
    let info = room.run(&["map", "info", "u.yaml", "--json"]).json();
    let extents: [[f64; 2]; 2] = serde_json::from_value(info["extents_m"].clone()).unwrap();
    let expected = [[9.0, 0.0], [10.0, 3.0]];
    for (corner, expected) in extents.iter().flatten().zip(expected.iter().flatten()) {
        assert!((corner - expected).abs() < 1e-9, "{extents:?}");
    }
    assert_eq!(
        (&info["n_unknown"], &info["n_components"]),
        (&json!(1), &json!(2))
    );
    let free = room.run(&["map", "info", "u.yaml", "--unknown", "free", "--json"]);
    assert_eq!(free.json()["n_components"], 1);
}

#[test]
fn info_knows_the_built_in_maps_and_full_ones() {
    let room = Room::new();
    let info = room.run(&["map", "info", "aco20", "--json"]).json();
    assert_eq!(info["n_cols"], 20);
    room.write("full.txt", "1 1\n1 1\n");
    let run = room.run(&["map", "info", "full.txt"]);
    assert!(run.stdout.contains("no cell is free"), "{}", run.stdout);
    room.run(&["map", "info", "nowhere"])
        .assert_refused(&["nowhere", "aco20"]);
    room.run(&["map", "info", "nowhere.yaml"])
        .assert_refused(&["nowhere.yaml"]);
}

#[test]
fn converts_there_and_back_without_loss() {
    let room = Room::new();
    let convert = |from: &str, to: &str, more: &[&str]| {
        room.run(&[&["map", "convert", from, to], more].concat())
    };
    assert_eq!(convert("room.yaml", "copy.png", &[]).code, 0);
    assert!(room.read("copy.yaml").contains("resolution: 0.2\n"));
    convert("room.yaml", "room.map", &[]).assert_refused(&["0.2 m", "--drop-frame"]);
    assert_eq!(convert("copy.yaml", "room.map", &["--drop-frame"]).code, 0);
    assert_eq!(
        convert("room.map", "room.csv", &[]).code,
        0,
        "1 m at the origin"
    );
    let scale = ["--resolution", "0.2"];
    assert_eq!(convert("room.csv", "back.yaml", &scale).code, 0);
    let image = |name: &str| std::fs::read(room.path(name)).unwrap();
    assert_eq!(image("back.pgm"), image("room.pgm"));
}

#[test]
fn refuses_to_lose_cells_or_files() {
    let room = Room::new();
    room.write("u.pgm", b"P5\n3 1\n255\n\xfe\xcd\xfe");
    let convert = |args: &[&str]| room.run(&[&["map", "convert", "u.pgm"], args].concat());
    let scale = ["--resolution", "1"];
    convert(&[&["u.txt"], &scale[..]].concat()).assert_refused(&["1 cells with value -1"]);
    let decided = [&["u.txt", "--unknown", "free"], &scale[..]].concat();
    assert_eq!(convert(&decided).code, 0);
    assert_eq!(room.read("u.txt"), "0 0 0\n");
    convert(&["u.yaml"]).assert_refused(&["resolution"]);
    convert(&[&["room.png"], &scale[..]].concat()).assert_refused(&["room.yaml would be replaced"]);
    convert(&[&["u.bmp"], &scale[..]].concat()).assert_refused(&["bmp", "png"]);
    convert(&[&["no/such/u.png"], &scale[..]].concat()).assert_refused(&["no/such/u.png"]);
    assert_eq!(room.files(), ["room.pgm", "room.yaml", "u.pgm", "u.txt"]);
}

#[test]
fn the_same_seed_makes_the_same_map() {
    let room = Room::new();
    let generate = |kind: &str, seed: &str, out: &str| {
        let size = ["--width-cells", "150", "--height-cells", "120"];
        let args = ["map", "generate", kind, "--seed", seed, "--out", out];
        room.run(&[&args[..], &size].concat())
    };
    for kind in ["neighborhood", "scatter"] {
        let run = generate(kind, "7", "a.yaml");
        assert_eq!(run.code, 0, "{}", run.stderr);
        assert!(run.stdout.starts_with("a.yaml: 150 x 120 cells of 0."));
        assert_eq!(generate(kind, "7", "b.yaml").code, 0);
        assert_eq!(generate(kind, "8", "c.yaml").code, 0);
        let image = |name: &str| std::fs::read(room.path(name)).unwrap();
        assert_eq!(image("a.pgm"), image("b.pgm"));
        assert_ne!(image("a.pgm"), image("c.pgm"));
    }
}

#[test]
fn parameters_of_generators_are_checked() {
    let room = Room::new();
    let generate = |more: &[&str]| {
        room.run(&[&["map", "generate", "scatter", "--out", "s.yaml"], more].concat())
    };
    assert_eq!(generate(&["--set", "density=0.3"]).code, 0);
    let before = room.read("s.yaml");
    generate(&["--set", "density=2"]).assert_refused(&["density", "2", "0.8"]);
    generate(&["--set", "densty=0.1"]).assert_refused(&["densty", "density"]);
    generate(&["--set", "density=much"]).assert_refused(&["much"]);
    generate(&["--set", "density"]).assert_refused(&["KEY=VALUE"]);
    generate(&["--set", "n_cols=1e99"]).assert_refused(&["parameters"]);
    generate(&["--width-cells", "99999999999"]).assert_refused(&["99999999999"]);
    generate(&["--width-cells", "0"]).assert_refused(&["0"]);
    generate(&["--resolution", "-1"]).assert_refused(&["above 0"]);
    assert_eq!(room.read("s.yaml"), before);
}

#[test]
fn the_widest_way_leads_through_the_door() {
    let room = Room::new();
    let args = [
        "map",
        "clearance",
        "room.yaml",
        "--start",
        "3,2",
        "--goal",
        "9,2",
    ];
    let clearance = room.run(&[&args[..], &["--json"]].concat()).json();
    // The door has 13 rows of 0.2 m: 2.6 m.
    let number = |key: &str| clearance[key].as_f64().unwrap();
    assert!((2.5..=2.6).contains(&number("width_m")), "{clearance}");
    assert!((2.6..2.9).contains(&number("limit_m")), "{clearance}");
    let x = clearance["narrowest"][0].as_f64().unwrap();
    assert!((4.5..7.5).contains(&x), "{x}");
    let text = room.run(&args).stdout;
    assert!(text.starts_with("width      a disc of 2.5"), "{text}");
    assert!(text.contains("m passes, none wider than 2."), "{text}");
}

#[test]
fn the_border_stops_a_body_like_a_wall() {
    let room = Room::new();
    room.write("open.txt", "0 0 0 0 0\n".repeat(3));
    let args = [
        "map",
        "clearance",
        "open.txt",
        "--start",
        "1.5,1.5",
        "--goal",
        "3.5,1.5",
        "--json",
    ];
    assert_eq!(room.run(&args).json()["width_m"], 3.0);
}

#[test]
fn no_way_is_exit_3_and_bad_ends_are_refused() {
    let room = Room::new();
    room.write("split.txt", "0 1 0\n0 1 0\n");
    let clearance = |start: &str, goal: &str| {
        room.run(&[
            "map",
            "clearance",
            "split.txt",
            "--start",
            start,
            "--goal",
            goal,
        ])
    };
    let run = clearance("0.5,0.5", "2.5,0.5");
    assert_eq!(run.code, 3);
    assert!(run.stdout.starts_with("separated "), "{}", run.stdout);
    assert_eq!(clearance("0.5,0.5", "0.5,1.5").code, 0);
    clearance("0.5,0.5", "1.5,0.5").assert_refused(&["goal (1.5, 0.5)", "occupied"]);
    clearance("-5,0.5", "0.5,0.5").assert_refused(&["start (-5, 0.5)", "off the map"]);
    clearance("0.5", "0.5,0.5").assert_refused(&["X,Y"]);
    clearance("nan,0", "0.5,0.5").assert_refused(&["finite"]);
}

/// A hall whose middle nobody has seen, and a threshold that calls it free.
fn unseen(room: &Room, free_thresh: &str) {
    let mut image = b"P5\n60 40\n255\n".to_vec();
    image.extend((0..60 * 40).map(|i| {
        if (20..40).contains(&(i % 60)) {
            205
        } else {
            254
        }
    }));
    room.write("unseen.pgm", image);
    let yaml = format!(
        "image: unseen.pgm\nresolution: 0.2\norigin: [0, 0, 0]\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: {free_thresh}\n"
    );
    room.write("unseen.yaml", yaml);
}

#[test]
fn never_seen_ground_that_a_threshold_frees_is_never_silent() {
    let room = Room::new();
    unseen(&room, "0.25");
    let told = "800 cells are free by free_thresh 0.25 but have the grey 205";
    let info = room.run(&["map", "info", "unseen.yaml"]);
    assert!(
        info.stdout.contains(&format!("warning     {told}")),
        "{}",
        info.stdout
    );
    let plan = |more: &[&str]| {
        let words = [
            "plan",
            "--map",
            "unseen.yaml",
            "--start",
            "2,4,0",
            "--goal",
            "10,4,0",
        ];
        room.run(&[&words[..], more].concat())
    };
    let out = plan(&["--json", "--out", "path.json"]);
    assert!(out.stderr.contains(told), "{}", out.stderr);
    let answer = out.json();
    assert_eq!(answer["status"], "found");
    for list in [
        &answer["provenance"]["map"]["warnings"],
        &answer["certificate"]["assumptions"],
    ] {
        assert!(list[0].as_str().unwrap().starts_with(told), "{list}");
    }
    let check = room.run(&["check", "path.json", "--map", "unseen.yaml", "--json"]);
    assert_eq!(check.json()["certificate"], answer["certificate"]);
    let grey = ["--unknown-grey", "205"];
    let strict = plan(&[&grey[..], &["--json"]].concat());
    assert_eq!((strict.code, strict.stderr.as_str()), (3, ""));
    let reason = strict.json()["reason"].as_str().unwrap().to_owned();
    assert!(
        reason.contains("800 cells of the map are unknown"),
        "{reason}"
    );
    assert!(reason.contains("--unknown free"), "{reason}");
    let free = plan(&[&grey[..], &["--unknown", "free"]].concat());
    assert_eq!(free.code, 0, "{}", free.stdout);
    unseen(&room, "0.196");
    let quiet = room.run(&["map", "info", "unseen.yaml"]);
    assert!(!quiet.stdout.contains("warning"), "{}", quiet.stdout);
    room.run(&["map", "info", "aco20", "--unknown-grey", "205"])
        .assert_refused(&["--unknown-grey", "aco20"]);
    room.write("m.txt", "0 0\n0 1\n");
    room.run(&["map", "info", "m.txt", "--unknown-grey", "205"])
        .assert_refused(&["m.txt", "no grey values"]);
}

#[test]
fn bitmaps_are_maps() {
    let room = Room::new();
    let mut bytes =
        b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0\x01\0\0\0\x01\0\x18\0".to_vec();
    bytes.extend([0; 24]);
    bytes.extend([254, 254, 254, 0, 0, 0, 0, 0]);
    room.write("m.bmp", &bytes);
    let info = room.run(&["map", "info", "m.bmp", "--resolution", "0.1", "--json"]);
    let info = info.json();
    assert_eq!(
        (&info["n_free"], &info["n_occupied"]),
        (&json!(1), &json!(1))
    );
}
