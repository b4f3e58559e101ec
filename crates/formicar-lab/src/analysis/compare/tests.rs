//! Verdicts on sides whose difference is known.

use super::*;
use serde_json::json;

/// The values of a run of a side.
type Values = fn(usize) -> serde_json::Value;

/// Twelve scenarios with two seeds each.
fn side(name: &str, planner: &str, values: Values) -> Side {
    let record = |i: usize| {
        let mut run = Run::default();
        run.record
            .fill(&json!({
                "scenario": format!("s{}", i / 2), "planner": planner, "seed": i % 2,
                "status": "found", "valid": true,
            }))
            .unwrap();
        run.record.fill(&values(i)).unwrap();
        run.origin
            .fill(&json!({"machine": "one", "build": "release", "map_hash": "m"}))
            .unwrap();
        run
    };
    Side {
        name: name.to_owned(),
        runs: (0..24).map(record).collect(),
    }
}

fn base(i: usize) -> serde_json::Value {
    let x = i as f64;
    json!({
        "length_m": 50.0 + x, "query_s": 0.1 + 0.001 * x, "steps": 100 + i, "n_cusps": 0,
        "min_clearance_m": 0.3, "peak_rss_bytes": 30_000_000, "first_feasible_s": 0.01,
        "cost_m": 60.0 + x, "first_steps": 10,
    })
}

/// Longer and slower by a tenth, more clearance.
fn other(i: usize) -> serde_json::Value {
    let x = i as f64;
    json!({
        "length_m": 55.0 + 1.1 * x, "query_s": 0.11 + 0.0011 * x, "steps": 100 + i, "n_cusps": 0,
        "min_clearance_m": 0.31, "peak_rss_bytes": 30_100_000, "first_feasible_s": 0.01,
        "cost_m": 60.0 + x, "first_steps": 10,
    })
}

/// The values of a program that is not installed.
fn unavailable(_: usize) -> serde_json::Value {
    json!({"status": "unavailable", "valid": null, "reason": "no OMPL"})
}

/// As the base, with two runs lost.
fn failing(i: usize) -> serde_json::Value {
    let mut values = base(i);
    if i < 2 {
        values["status"] = json!("no_path");
        values["valid"] = json!(null);
    }
    values
}

fn compare(a: &Side, b: &Side) -> Comparison {
    Comparison::new(a, b, Scope::All).unwrap()
}

fn verdict(comparison: &Comparison, metric: &str) -> Verdict {
    let mut findings = comparison.duels[0].findings.iter();
    findings.find(|f| f.metric == metric).unwrap().verdict
}

#[test]
fn differences_are_told_where_there_are_any() {
    let (a, b) = (side("a", "p", base), side("b", "p", other));
    let found = compare(&a, &b);
    assert!(found.is_worse() && !found.has_lost());
    assert_eq!(verdict(&found, "length m"), Verdict::Worse);
    assert_eq!(verdict(&found, "query ms"), Verdict::Worse);
    assert_eq!(verdict(&found, "clearance m"), Verdict::Better);
    for same in ["success", "steps", "cost m", "cusps", "first path ms"] {
        assert_eq!(verdict(&found, same), Verdict::NoDifferenceShown, "{same}");
    }
    // A third of a percent more memory in every run is noise.
    assert_eq!(verdict(&found, "memory MB"), Verdict::NoDifferenceShown);
    let length = &found.duels[0].findings[3];
    let [low, mid, high] = length.ratio.unwrap();
    assert!((mid - 1.1).abs() < 1e-12 && low <= mid && mid <= high);
    assert_eq!((length.n_pairs, length.n_equal), (24, 0));
    // Every value of b is above both of a on its scenario.
    assert_eq!(length.above, Some(1.0));
    let back = compare(&b, &a);
    assert_eq!(verdict(&back, "length m"), Verdict::Better);
}

#[test]
fn a_side_does_not_differ_from_itself() {
    let a = side("a", "p", base);
    let found = compare(&a, &a);
    assert!(!found.is_worse());
    let findings = &found.duels[0].findings;
    let is_equal = |f: &Finding| f.p.is_none() && f.n_equal == f.n_pairs && f.n_all_pairs == 24;
    assert!(findings.iter().all(is_equal));
}

/// Runs with a vehicle of a name and a hash.
fn driven_by(vehicle: [&str; 2], side: &Side) -> Side {
    let mut side = side.clone();
    for run in &mut side.runs {
        run.origin.vehicle = vehicle[0].to_owned();
        run.origin.vehicle_hash = vehicle[1].to_owned();
    }
    side
}

#[test]
fn one_vehicle_under_two_names_is_one_vehicle() {
    let [own, sedan] = [["own", "v"], ["sedan", "v"]];
    let (a, b) = (side("a", "p", base), side("b", "p", other));
    // Another name on the other side is no other vehicle.
    let found = compare(&driven_by(own, &a), &driven_by(sedan, &b));
    assert_eq!(
        (found.duels[0].n_pairs, found.duels[0].n_alone),
        (24, [0, 0])
    );
    // Both names on both sides are no more evidence than one.
    let both = |side: &Side| {
        let mut both = driven_by(own, side);
        both.runs.extend(driven_by(sedan, side).runs);
        both
    };
    let found = compare(&both(&a), &both(&b));
    assert_eq!(
        (found.duels[0].n_pairs, found.duels[0].n_alone),
        (24, [0, 0])
    );
    let note = &found.duels[0].notes[0];
    assert!(
        note.contains("24 of the first side and 24 of the second"),
        "{note}"
    );
    // Other vehicles stay others, and names count where not all hashes are known.
    let kart = driven_by(["kart", "w"], &a);
    assert!(Comparison::new(&kart, &driven_by(sedan, &b), Scope::All).is_err());
    let error = Comparison::new(
        &driven_by(["own", "w"], &a),
        &driven_by(own, &b),
        Scope::All,
    );
    assert!(
        error
            .unwrap_err()
            .to_string()
            .contains("vehicles of the two sides")
    );
    let unknown = driven_by(["sedan", ""], &a);
    assert_eq!(
        compare(&unknown, &driven_by(sedan, &b)).duels[0].n_pairs,
        24
    );
    assert!(Comparison::new(&unknown, &driven_by(own, &b), Scope::All).is_err());
}

#[test]
fn lost_runs_are_named_and_left_out_of_paths() {
    let found = compare(&side("a", "p", base), &side("b", "p", failing));
    assert!(found.has_lost());
    assert_eq!(found.duels[0].lost, ["s0 seed 0", "s0 seed 1"]);
    assert_eq!(found.duels[0].findings[3].n_pairs, 22);
    assert_eq!(
        found.duels[0].findings[0].of_sides,
        Some([1.0, 22.0 / 24.0])
    );
    let text = crate::report::markdown(&found.report());
    assert!(text.contains("| success | 24/24 | 22/24 |"), "{text}");
    assert!(text.contains("Solved by a alone: s0 seed 0, s0 seed 1."));
}

#[test]
fn results_alone_say_nothing_of_times() {
    let (a, b) = (side("a", "p", base), side("b", "p", other));
    let found = Comparison::new(&a, &b, Scope::Results).unwrap();
    let findings = found.duels[0].findings.iter();
    let names: Vec<&str> = findings.map(|finding| finding.metric).collect();
    assert_eq!(names.len(), 7);
    assert!(!names.contains(&"query ms") && !names.contains(&"memory MB"));
    assert_eq!(verdict(&found, "length m"), Verdict::Worse);
}

#[test]
fn seeds_that_change_nothing_count_once() {
    let still = |i: usize| {
        let mut values = base(i - i % 2);
        values["query_s"] = json!(0.1 + 0.001 * i as f64);
        values
    };
    let found = compare(&side("a", "p", still), &side("b", "p", still));
    let duel = &found.duels[0];
    let n_pairs = |metric: &str| {
        let mut findings = duel.findings.iter();
        findings.find(|f| f.metric == metric).unwrap().n_pairs
    };
    assert_eq!((n_pairs("length m"), n_pairs("query ms")), (12, 24));
    assert!(duel.notes[0].contains("success on 12, length m on 12"));
}

/// On two scenarios the first side alone finds paths, of other lengths with every seed; on
/// fourteen the second alone finds one, always the same.
#[test]
fn success_counts_once_where_only_the_length_varies() {
    let is_of_first = |i: usize| i < 32;
    let scenario = move |i: usize| if is_of_first(i) { i / 16 } else { i - 30 };
    let run_of = |i: usize, is_solved: bool| {
        let mut run = Run::default();
        run.record.fill(&json!({
            "scenario": format!("s{}", scenario(i)), "seed": if is_of_first(i) { i % 16 } else { 0 },
            "status": if is_solved { "found" } else { "no_path" }, "valid": is_solved,
            "length_m": if is_of_first(i) { 10.0 + i as f64 } else { 10.0 },
        })).unwrap();
        run
    };
    let side = |name: &str, solves: &dyn Fn(usize) -> bool| Side {
        name: name.to_owned(),
        runs: (0..46).map(|i| run_of(i, solves(i))).collect(),
    };
    let found = compare(&side("a", &is_of_first), &side("b", &|i| !is_of_first(i)));
    let success = &found.duels[0].findings[0];
    let counts = (success.n_pairs, success.n_all_pairs, success.n_still);
    assert_eq!(counts, (16, 46, 2));
    assert_eq!(success.verdict, Verdict::Better);
    // The shares are of all runs, as everywhere.
    assert_eq!(success.of_sides, Some([32.0 / 46.0, 14.0 / 46.0]));
}

#[test]
fn runs_that_did_not_take_place_are_in_no_rate_and_no_test() {
    let half = |i: usize| if i < 12 { base(i) } else { unavailable(i) };
    let found = compare(&side("a", "p", base), &side("b", "q", half));
    let duel = &found.duels[0];
    let success = &duel.findings[0];
    assert_eq!(
        (success.n_all_pairs, success.of_sides),
        (12, Some([1.0; 2]))
    );
    assert_eq!(duel.notes.len(), 2);
    assert!(
        duel.notes[0].contains("of the second side 12 (unavailable: no OMPL)"),
        "{}",
        duel.notes[0]
    );
    // Whoever asks whether anything is lost is told all the same.
    assert_eq!(duel.lost[0], "s6 seed 0 (unavailable)");
}

#[test]
fn runs_of_several_vehicles_are_told_apart() {
    let (mut a, mut b) = (side("a", "p", base), side("b", "p", failing));
    for vehicle in ["own", "f1tenth"] {
        for side in [&mut a, &mut b] {
            let mut runs = side.runs[..2].to_vec();
            for run in &mut runs {
                run.origin.vehicle = vehicle.to_owned();
            }
            side.runs.extend(runs);
        }
    }
    for side in [&mut a, &mut b] {
        side.runs.drain(..24);
        // Tables that are joined may hold a run twice.
        side.runs.extend_from_within(..1);
    }
    let lost = &compare(&a, &b).duels[0].lost;
    let names = [
        "own seed 0",
        "own seed 1",
        "f1tenth seed 0",
        "f1tenth seed 1",
    ];
    assert_eq!(lost, &names.map(|name| format!("s0 {name}")));
}

#[test]
fn times_of_other_machines_do_not_compare() {
    let (a, mut b) = (side("a", "p", base), side("b", "p", other));
    for run in &mut b.runs {
        run.origin.machine = "two".to_owned();
    }
    let found = compare(&a, &b);
    for metric in ["first path ms", "query ms", "memory MB"] {
        assert_eq!(verdict(&found, metric), Verdict::NotComparable);
    }
    assert_eq!(verdict(&found, "length m"), Verdict::Worse);
    assert!(found.duels[0].notes[0].contains("machines differ (one and two)"));
}

#[test]
fn sides_that_have_nothing_in_common_are_refused() {
    let a = side("a", "p", base);
    // One planner each: those are compared, whatever they are called.
    assert_eq!(compare(&a, &side("b", "q", base)).duels.len(), 1);
    let mut two = side("b", "q", base);
    two.runs.extend(side("b", "r", base).runs);
    let told = |b: &Side| Comparison::new(&a, b, Scope::All).unwrap_err().to_string();
    assert!(told(&two).contains("a has p; b has q, r"));
    let mut moved = side("b", "p", base);
    for run in &mut moved.runs {
        run.origin.map_hash = "n".to_owned();
    }
    assert!(told(&moved).contains("the maps of the two sides are not the same (m and n)"));
    for run in &mut moved.runs {
        run.origin.vehicle = "sedan".to_owned();
    }
    assert!(told(&moved).contains("no run in common"));
}
