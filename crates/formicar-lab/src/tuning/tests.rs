use super::*;
use crate::papers::experiment::Ground;
use formicar::map::builtin::BuiltinMap;
use formicar::numeric::Seed;
use formicar::planner::{PlannerConfig, PlannerName};
use formicar::scenario::Request;
use formicar::tuning::{BeeColonyConfig, Kind};
use formicar::vehicle::Vehicle;

fn keys(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

fn range(key: &str, low: f64, high: f64) -> OwnRange {
    OwnRange {
        key: key.to_owned(),
        low,
        high,
        is_log: false,
    }
}

fn space(planner: PlannerName, names: &[&str], ranges: &[OwnRange]) -> anyhow::Result<TuningSpace> {
    let base = PlannerConfig::of(planner);
    Ok(TuningSpace::new(&base, &keys(names), &[], ranges)?.0)
}

fn asked(map: &str, request: &str) -> Asked {
    let builtin = BuiltinMap::by_name(map).unwrap();
    let ends = builtin.request(request).unwrap();
    Asked::new(Ground {
        map: format!("{map}-{request}"),
        grid: builtin.grid(),
        vehicle: Vehicle::preset(builtin.vehicle).unwrap(),
        request: Request {
            budget_steps: Some(3000),
            ..Request::new(ends.start, ends.goal)
        },
    })
}

/// Two parameters of the ants and one word, on two narrow places; a third is held back.
fn tuning(n_jobs: usize) -> Tuning {
    let names = ["drive.beta", "drive.n_ants", "drive.race"];
    let ranges = [range("drive.n_ants", 0.0, 20.0)];
    Tuning {
        space: space(PlannerName::Formicar, &names, &ranges).unwrap(),
        scenarios: vec![
            asked("narrow-junction", "quarter-turn"),
            asked("narrow-aisle", "next-aisle"),
        ],
        held_back: vec![asked("narrow-junction", "turn-around")],
        objective: Objective {
            measure: Measure::Cost,
            steps_weight: 0.1,
        },
        n_seeds: 2,
        n_check_seeds: 2,
        bees: BeeColonyConfig {
            n_sources: 4,
            max_evaluations: 15,
            ..BeeColonyConfig::default()
        },
        seed: Seed(3),
        n_jobs,
    }
}

#[test]
fn every_planner_is_its_own_values() {
    for planner in PlannerName::ALL {
        let base = PlannerConfig::of(planner);
        let Ok((space, left_out)) = TuningSpace::new(&base, &[], &[], &[]) else {
            continue;
        };
        let own = space.own_values().unwrap();
        assert_eq!(space.config(&own), Some(base), "{planner:?}");
        assert!(space.space.position(&own).is_ok(), "{planner:?}");
        assert!(
            space
                .space
                .dimensions()
                .iter()
                .all(|d| !left_out.contains(&d.name))
        );
    }
}

/// The values of a parameter with the ranges given.
fn kind(planner: PlannerName, name: &str, ranges: &[OwnRange]) -> Result<Kind, String> {
    let space = space(planner, &[name], ranges);
    space
        .map(|s| s.space.dimensions()[0].kind.clone())
        .map_err(|e| e.to_string())
}

#[test]
fn ranges_are_those_of_the_schema_or_the_callers() {
    let formicar = PlannerName::Formicar;
    let (low, high) = (0.0, 100.0);
    assert_eq!(
        kind(formicar, "drive.beta", &[]),
        Ok(Kind::Real { low, high })
    );
    let race = kind(formicar, "drive.race", &[]);
    assert_eq!(race, Ok(Kind::Choice { n_choices: 3 }));
    let narrow = [range("drive.n_ants", 2.0, 40.0)];
    let ants = kind(formicar, "drive.n_ants", &narrow);
    assert_eq!(
        ants,
        Ok(Kind::Integer {
            low: 2.0,
            high: 40.0
        })
    );
    let faco = PlannerName::Faco2024;
    let eta = [range("chords.distance.eta", 0.5, 4.0)];
    let of_rule = kind(faco, "chords.distance.eta", &eta);
    assert_eq!(
        of_rule,
        Ok(Kind::Real {
            low: 0.5,
            high: 4.0
        })
    );
}

#[test]
fn what_cannot_be_tuned_is_refused_with_what_can() {
    let [formicar, faco] = [PlannerName::Formicar, PlannerName::Faco2024];
    let refused = [
        (
            faco,
            "chords.stopping.target_cost",
            None,
            "no finite range; hint: --range chords.stopping.target_cost=LOW..HIGH",
        ),
        (
            faco,
            "drive.beta",
            None,
            "no parameter \"drive.beta\" that can be tuned; there are chords.",
        ),
        (
            faco,
            "chords.distance.rule",
            None,
            "no parameter \"chords.distance.rule\"",
        ),
        (
            formicar,
            "drive.beta",
            Some(range("drive.beta", 0.0, 101.0)),
            "it must stay in 0 to 100",
        ),
        (
            formicar,
            "drive.race",
            Some(range("drive.race", 0.0, 1.0)),
            "it takes words",
        ),
        (
            formicar,
            "drive.beta",
            Some(range("drive.n_ants", 0.0, 1.0)),
            "this parameter is not tuned",
        ),
        (
            formicar,
            "drive.n_ants",
            Some(range("drive.n_ants", 0.5, 9.0)),
            "bound of drive.n_ants = 0.5",
        ),
    ];
    for (planner, name, own, words) in refused {
        let own: Vec<OwnRange> = own.into_iter().collect();
        let message = kind(planner, name, &own).unwrap_err();
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn groups_are_sections_and_parts_of_them() {
    let base = PlannerConfig::of(PlannerName::Formicar);
    let group = |name: &str| TuningSpace::new(&base, &[], &keys(&[name]), &[]);
    let (trails, left_out) = group("drive.trails").unwrap();
    assert_eq!(trails.space.dimensions().len(), 3);
    assert!(left_out.is_empty());
    let message = group("drive.trail").unwrap_err().to_string();
    assert!(
        message.contains("no group \"drive.trail\"; there are cost, drive, drive.repair"),
        "{message}"
    );
}

#[test]
fn a_document_holds_what_is_tuned_and_makes_the_same_configuration() {
    let names = ["chords.distance.eta", "chords.n_ants", "chords.deposit.by"];
    let ranges = [
        range("chords.distance.eta", 0.5, 4.0),
        range("chords.n_ants", 1.0, 90.0),
    ];
    let space = space(PlannerName::Faco2024, &names, &ranges).unwrap();
    let order: Vec<&str> = space
        .space
        .dimensions()
        .iter()
        .map(|d| d.name.as_str())
        .collect();
    assert_eq!(
        order,
        ["chords.deposit.by", "chords.distance.eta", "chords.n_ants"]
    );
    let values = [1.0, 2.5, 30.0];
    let document = space.document(&values);
    let expected = serde_json::json!({
        "planner": "faco2024",
        "chords": {"n_ants": 30, "distance": {"eta": 2.5}, "deposit": {"by": "all"}},
    });
    assert_eq!(document, expected);
    let config: PlannerConfig = serde_json::from_value(document).unwrap();
    assert_eq!(space.config(&values), Some(config));
}

#[test]
fn values_that_do_not_go_together_are_no_configuration() {
    let names = ["evolution.n_via", "evolution.n_via_max"];
    let space = space(PlannerName::Ga, &names, &[]).unwrap();
    assert!(space.config(&[3.0, 4.0]).is_some());
    assert_eq!(space.config(&[5.0, 4.0]), None);
    // The whole tuning goes on without them.
    let tuning = Tuning { space, ..tuning(1) };
    let mut state = tuning.begin().unwrap();
    tuning.cycle(&mut state).unwrap();
    assert_eq!(state.colony.n_evaluations(), 4);
    let worst = state.colony.sources().iter().filter(|s| s.cost == f64::MAX);
    assert_eq!(worst.count() as u64, state.n_invalid);
}

#[test]
fn a_share_of_the_scenarios_is_held_back() {
    for (n, share, n_held) in [
        (0, 0.3, 0),
        (1, 0.3, 0),
        (2, 0.01, 1),
        (10, 0.3, 3),
        (4, 0.99, 3),
    ] {
        let held = split(n, share, Seed(5));
        assert_eq!(held.len(), n_held);
        assert!(held.is_sorted_by(|a, b| a < b) && held.iter().all(|&i| i < n));
    }
    assert_ne!(split(40, 0.5, Seed(1)), split(40, 0.5, Seed(2)));
}

#[test]
fn a_run_counts_by_its_cost_its_steps_or_its_failure() {
    let reference = objective::Reference {
        cost_m: 20.0,
        first_steps: 99.0,
    };
    let run = |cost_m, first_steps| TunedRun {
        scenario: String::new(),
        variant: "",
        seed: 0,
        status: String::new(),
        cost_m,
        length_m: cost_m,
        first_steps,
        steps: first_steps,
    };
    let ratio = |measure, run: &TunedRun| {
        let objective = Objective {
            measure,
            steps_weight: 0.5,
        };
        objective.log_ratio(run, &reference).exp()
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    let good = run(Some(10.0), Some(24));
    near(ratio(Measure::Cost, &good), 0.5 * 0.25_f64.sqrt());
    near(ratio(Measure::Steps, &good), 0.25);
    near(ratio(Measure::Success, &good), 1.0);
    for measure in [Measure::Cost, Measure::Steps, Measure::Success] {
        near(ratio(measure, &run(None, None)), Objective::FAILURE);
    }
    near(
        ratio(Measure::Cost, &run(Some(900.0), Some(99))),
        Objective::FAILURE,
    );
}

#[test]
fn jobs_and_interruptions_change_nothing() {
    let whole = tuning(1);
    let mut undisturbed = whole.begin().unwrap();
    while !undisturbed.colony().is_done() {
        whole.cycle(&mut undisturbed).unwrap();
    }
    let parallel = tuning(3);
    let begun = parallel.begin().unwrap();
    let mut state = begun.clone();
    while !state.colony().is_done() {
        parallel.cycle(&mut state).unwrap();
        state = TuningState::read(&state.text().unwrap()).unwrap();
        state.follows(&begun).unwrap();
    }
    assert_eq!(state, undisturbed);
    // The default is the first candidate, and counts about 1 beside its own medians.
    let first = &undisturbed.colony().history()[0];
    assert!(first.best_cost < 1.05, "{first:?}");

    let [a, b] = [(&whole, undisturbed), (&parallel, state)].map(|(t, s)| t.verdict(&s).unwrap());
    assert_eq!(
        (&a.report, &a.runs_csv, &a.document),
        (&b.report, &b.runs_csv, &b.document)
    );
    // Two configurations, one scenario, two seeds that were not tuned on.
    assert_eq!(a.runs_csv.lines().count(), 1 + 4);
    assert!(
        a.runs_csv.contains("narrow-junction-turn-around,tuned,3,"),
        "{}",
        a.runs_csv
    );
    assert_eq!(
        serde_json::from_value::<PlannerConfig>(a.document).unwrap(),
        a.config
    );
}

#[test]
fn scenarios_that_cannot_be_asked_are_refused() {
    let open = BuiltinMap::by_name("wang-open").unwrap();
    let name = format!("wang-open-{}", open.requests[0].id);
    let of_point = || asked("wang-open", open.requests[0].id);
    for tuning in [
        Tuning {
            scenarios: vec![of_point()],
            ..tuning(1)
        },
        Tuning {
            held_back: vec![of_point()],
            ..tuning(1)
        },
    ] {
        let error = tuning.begin().unwrap_err().to_string();
        assert!(
            error.contains(&format!("{name}: formicar cannot be asked this: ")),
            "{error}"
        );
    }
}

#[test]
fn scenarios_that_were_never_solved_are_told() {
    let mut hopeless = asked("narrow-junction", "turn-around");
    hopeless.ground.request.budget_steps = Some(1);
    let tuning = Tuning {
        scenarios: vec![asked("narrow-aisle", "next-aisle"), hopeless],
        held_back: Vec::new(),
        ..tuning(1)
    };
    let mut state = tuning.begin().unwrap();
    tuning.cycle(&mut state).unwrap();
    assert_eq!(state.solved, [true, false]);
    let report = crate::report::markdown(&tuning.verdict(&state).unwrap().report);
    let told = "ever found a path on narrow-junction-turn-around:";
    assert!(report.contains(told), "{report}");
}

#[test]
fn the_state_of_another_tuning_is_refused() {
    let one = tuning(1);
    let begun = one.begin().unwrap();
    let others = [
        (
            Tuning {
                n_seeds: 3,
                ..tuning(1)
            },
            "number of seeds",
        ),
        (
            Tuning {
                seed: Seed(4),
                ..tuning(1)
            },
            "search or its seed",
        ),
        (
            Tuning {
                scenarios: Vec::new(),
                ..tuning(1)
            },
            "scenarios",
        ),
        (
            Tuning {
                objective: Objective {
                    measure: Measure::Steps,
                    steps_weight: 0.1,
                },
                ..tuning(1)
            },
            "objective",
        ),
    ];
    for (other, what) in others {
        let error = other.begin().unwrap().follows(&begun).unwrap_err();
        assert!(error.to_string().contains(what), "{error}");
    }
    assert!(TuningState::read("{}").is_err());
}
