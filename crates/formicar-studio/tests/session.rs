//! The orders of a visitor and their results.

use crate::common::{LEI_MAP1, NEIGHBORHOOD, Visitor, get, plan, run, studio};
use formicar_studio::Options;
use serde_json::json;

#[test]
fn ants_walk_and_a_certified_path_is_driven() {
    let at = studio(Options::default());
    run(async {
        let mut visitor = Visitor::on(at, "lei-map1").await;
        visitor.say(&plan(1, "lei2020", LEI_MAP1)).await;
        let frame = visitor.wait_for("iteration").await;
        assert_eq!(frame["record"]["iteration"], 0);
        assert!(
            visitor.wait_for("improved").await["length_m"]
                .as_f64()
                .unwrap()
                > 9.0
        );
        let end = visitor.wait_for("answer").await;
        assert_eq!(end["answer"]["status"], "found");
        assert_eq!(end["answer"]["certificate"]["valid"], true);
        assert!(end["history"].as_array().unwrap().len() > 10);
        assert!(end["stages"]["expanded"].as_array().unwrap().len() > 10);
        assert!(end["cli"].as_str().unwrap().contains("--planner lei2020"));

        visitor
            .say(&json!({ "type": "drive", "slot": "a", "law": "stanley" }))
            .await;
        let driven = visitor.wait_for("driven").await;
        assert_eq!(driven["status"], "arrived");
        for format in ["svg", "png"] {
            let order = json!({ "type": "picture", "slot": "a", "format": format });
            visitor.say(&order).await;
            assert_eq!(visitor.wait_for("picture").await["format"], format);
        }
    });
}

#[test]
fn ants_that_drive_and_hybrid_astar_are_shown() {
    let at = studio(Options::default());
    run(async {
        let mut visitor = Visitor::on(at, "neighborhood").await;
        visitor.say(&plan(1, "formicar", NEIGHBORHOOD)).await;
        let ants = visitor.wait_for("drive").await;
        let n_ways = ["arrived", "died"].map(|kind| ants[kind].as_array().unwrap().len());
        assert!(n_ways.iter().sum::<usize>() > 0);
        visitor.wait_for("answer").await;
        visitor.say(&plan(2, "hybrid-astar", NEIGHBORHOOD)).await;
        let reached = visitor.wait_for("expanded").await;
        assert!(reached["motions"].as_array().unwrap().len() >= 4);
        visitor.wait_for("answer").await;
    });
}

#[test]
fn what_is_painted_is_planned_around() {
    let at = studio(Options::default());
    run(async {
        let mut visitor = Visitor::on(at, "wang-open").await;
        visitor
            .say(&json!({ "type": "set_vehicle", "vehicle": { "preset": "point" } }))
            .await;
        visitor.wait_for("vehicle").await;
        let ends = [[0.5, 0.5, 0.0], [18.5, 18.5, 0.0]];
        let wall = |value: i8| {
            let region = json!({ "col": 0, "row": 10, "n_cols": 20, "n_rows": 1 });
            json!({ "type": "paint", "region": region, "values": vec![value; 20] })
        };
        for (number, value, status) in [(1, 100, "no_path"), (2, 0, "found")] {
            visitor.say(&wall(value)).await;
            visitor.say(&plan(number, "astar", ends)).await;
            let end = visitor.wait_for("answer").await;
            assert_eq!(
                end["answer"]["status"], status,
                "{}",
                end["answer"]["reason"]
            );
            assert!(end["cli"].as_str().unwrap().contains("--map map.yaml"));
        }
        visitor.say(&json!({ "type": "keep_map" })).await;
        let hash = visitor.wait_for("kept").await["hash"]
            .as_str()
            .unwrap()
            .to_owned();
        let picture = get(at, &format!("/maps/{hash}/map.yaml"));
        assert!(picture.contains("image: map.png"), "{picture}");
        visitor
            .say(&json!({ "type": "open_map", "map": { "hash": hash } }))
            .await;
        assert_eq!(visitor.wait_for("map").await["hash"], json!(hash));
    });
}

#[test]
fn a_newer_plan_ends_an_older_one_at_once() {
    let at = studio(Options::default());
    run(async {
        let mut visitor = Visitor::on(at, "neighborhood").await;
        let mut endless = plan(1, "max-min", NEIGHBORHOOD);
        endless["config"] = json!({ "planner": "max-min", "colony": { "n_iterations": 100_000 } });
        endless["watch"] = json!(false);
        visitor.say(&endless).await;
        visitor.say(&json!({ "type": "cancel", "slot": "a" })).await;
        endless["plan"] = json!(2);
        visitor.say(&endless).await;
        visitor.say(&plan(3, "formicar", NEIGHBORHOOD)).await;
        let mut ended = Vec::new();
        while ended.last() != Some(&3) {
            let message = visitor.hear().await;
            if message["type"] == "answer" || message["type"] == "dropped" {
                let status = message["answer"]["status"].as_str().unwrap_or("cancelled");
                let plan = message["plan"].as_u64().unwrap();
                assert_eq!(status, if plan == 3 { "found" } else { "cancelled" });
                ended.push(plan);
            }
        }
        assert_eq!(ended, [1, 2, 3]);
    });
}

#[test]
fn a_plan_goes_on_from_the_one_before() {
    let at = studio(Options::default());
    run(async {
        let mut visitor = Visitor::on(at, "neighborhood").await;
        visitor.say(&plan(1, "formicar", NEIGHBORHOOD)).await;
        let first = visitor.wait_for("answer").await;
        let poses = &first["answer"]["path"]["poses"];
        let place = &poses[poses.as_array().unwrap().len() / 3];
        let on_the_way = ["x", "y", "heading"].map(|key| place[key].as_f64().unwrap());
        let mut again = plan(2, "formicar", [on_the_way, NEIGHBORHOOD[1]]);
        again["previous"] = json!(1);
        visitor.say(&again).await;
        let rest = visitor.wait_for("answer").await;
        let length_m = |end: &serde_json::Value| end["answer"]["metrics"]["length_m"].as_f64();
        let driven_m = place["s"].as_f64().unwrap();
        let off_m = length_m(&first).unwrap() - driven_m - length_m(&rest).unwrap();
        assert!(off_m.abs() < 0.5, "{off_m}");
        again["plan"] = json!(3);
        visitor.say(&again).await;
        let error = loop {
            let message = visitor.hear().await;
            if message["type"] == "error" {
                break message;
            }
        };
        assert_eq!(
            (&error["plan"], &error["about"]),
            (&json!(3), &json!("plan"))
        );
    });
}

#[test]
fn what_makes_no_sense_gets_an_error_and_nothing_is_lost() {
    let at = studio(Options::default());
    run(async {
        let mut visitor = Visitor::new(at).await;
        let mut bad_config = plan(7, "formicar", LEI_MAP1);
        bad_config["config"] = json!({ "planner": "formicar", "drive": { "n_ants": -1 } });
        let region = json!({ "col": 20, "row": 20, "n_cols": 3, "n_rows": 3 });
        let bad = [
            json!({ "type": "drive", "slot": "a", "law": "stanley" }),
            json!({ "type": "open_map", "map": { "builtin": "../../etc/passwd" } }),
            json!({ "type": "open_map", "map": { "hash": "../../etc/passwd" } }),
            json!({ "type": "open_map", "map": { "builtin": "lei-map1" } }),
            json!({ "type": "sudo" }),
            json!([1, 2, 3]),
            json!({ "type": "paint", "region": region, "values": vec![100; 9] }),
            json!({ "type": "paint", "region": region, "values": [100] }),
            json!({ "type": "set_vehicle", "vehicle": { "parameters": { "width_m": -1.0 } } }),
            bad_config,
        ];
        for message in &bad {
            visitor.say(message).await;
        }
        let mut n_errors = 0;
        while n_errors < bad.len() - 1 {
            let message = visitor.hear().await;
            n_errors += usize::from(message["type"] == "error");
        }
        visitor.say(&plan(8, "lei2020", LEI_MAP1)).await;
        assert_eq!(
            visitor.wait_for("answer").await["answer"]["status"],
            "found"
        );
    });
}

#[test]
fn a_request_that_cannot_be_asked_is_answered() {
    let at = studio(Options::default());
    run(async {
        let mut visitor = Visitor::on(at, "lei-map1").await;
        let off_the_map = [LEI_MAP1[0], [99.0, 99.0, 0.0]];
        visitor.say(&plan(1, "formicar", off_the_map)).await;
        let end = visitor.wait_for("answer").await;
        assert_eq!(end["answer"]["status"], "invalid_request");
        assert_eq!(end["answer"]["code"], "GOAL_OUTSIDE_MAP");
    });
}
