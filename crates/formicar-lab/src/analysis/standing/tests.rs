use super::*;
use crate::report::{Field, Table, markdown};
use crate::run::RunRecord;
use crate::run::{RunStatus, read_csv};

const PEERS: &str = "\
scenario,peer,solved,valid,first_s,length_1s_m,cusps,min_clearance_m,peak_mb
a,nav2-smac-rs,1,0,0.4,9,1,,96
a,nav2-smac-dubins,1,1,0.2,9.5,0,,96
a,ompl-rrtconnect-rs,1,1,0.02,10,2,0.04,26.1
b,nav2-smac-rs,0,0,2,,,,96
b,ompl-rrtconnect-rs,1,1,0.04,20,3,0.04,26.1
";

/// A run of a scenario of one map: the first path after so long.
fn run(scenario: &str, seed: u64, first_s: f64) -> RunRecord {
    RunRecord {
        scenario: scenario.to_owned(),
        planner: "formicar".to_owned(),
        seed,
        status: RunStatus::Found,
        valid: Some(true),
        source: "map".to_owned(),
        first_feasible_s: Some(first_s),
        length_m: Some(10.0),
        length_by_tenth_m: Some(10.2),
        length_by_second_m: Some(10.0),
        cost_m: Some(12.0),
        ends_clearance_m: Some(0.5),
        min_clearance_m: Some(0.3),
        n_cusps: Some(2),
        ..RunRecord::default()
    }
}

fn standing(runs: Vec<RunRecord>) -> Standing {
    Standing {
        runs,
        peers: Peer::read(PEERS).unwrap(),
        forward_only: false,
    }
}

/// Reached and met of the goal whose name begins so.
fn goal(report: &Report, name: &str) -> (String, bool) {
    let tables: Vec<&Table> = report.tables().collect();
    let row = tables[0]
        .rows
        .iter()
        .find(|row| row[0].text().starts_with(name));
    let row = row.unwrap_or_else(|| panic!("no goal {name:?} in {:?}", tables[0]));
    (row[2].text(), row[3].text() == "yes")
}

#[test]
fn goals_are_held_against_the_peers_of_each_scenario() {
    let runs = vec![
        run("a", 0, 0.01),
        run("a", 1, 0.03),
        run("b", 0, 0.01),
        run("b", 1, 0.01),
    ];
    let report = standing(runs).report();
    assert_eq!(goal(&report, "solved"), ("4 of 4 runs".to_owned(), true));
    // Of a only: Smac fails on b. The median over seeds is 0.02 s.
    let smac = goal(&report, "first path, times faster than Smac");
    assert_eq!(smac, ("20.0, worst 20.00, of 1 scenarios".to_owned(), true));
    let connect = goal(&report, "first path beside RRT-Connect, `map`");
    assert!(
        connect.1 && connect.0.contains("median 2.50, worst 1.00"),
        "{connect:?}"
    );
    // Smac's 9 m of a are not valid; its 9.5 m forward are.
    let length = goal(&report, "length at 1 s");
    let expected = 0.5 * (10.0 / 9.5 + 0.5);
    assert!(
        length.0.starts_with(&format!("{expected:.3}, worst 1.053")),
        "{length:?}"
    );
    assert_eq!(
        goal(&report, "clearance"),
        ("0.300 m, of 2 scenarios".to_owned(), true)
    );
    assert_eq!(
        goal(&report, "cusps"),
        ("2.00, more than it in 0 of its 2 valid".to_owned(), true)
    );
}

#[test]
fn a_run_without_a_path_takes_forever() {
    let lost = RunRecord {
        status: RunStatus::NoPath,
        valid: None,
        length_by_second_m: None,
        ..run("b", 0, 0.01)
    };
    let report = standing(vec![run("a", 0, 0.01), lost]).report();
    assert_eq!(goal(&report, "solved"), ("1 of 2 runs".to_owned(), false));
    let connect = goal(&report, "first path beside RRT-Connect");
    assert!(
        !connect.1 && connect.0.contains("worst 0.00"),
        "{connect:?}"
    );
    assert!(goal(&report, "length at 1 s").0.contains("in 1 of 2"));
}

#[test]
fn every_peer_stands_beside_ours_and_variants_beside_the_first() {
    let other = RunRecord {
        planner: "formicar-without-ants".to_owned(),
        cost_m: Some(15.0),
        ..run("a", 0, 0.02)
    };
    let report = standing(vec![run("a", 0, 0.01), other]).report();
    let text = markdown(&report);
    for row in [
        "| a nav2-smac-rs | yes | no | 400.0 | - | 9.00 | 1.0 | - | 96.0 |",
        "| a formicar | 1/1 | 1/1 | 10.0 | 10.20 | 10.00 | 2.0 | 0.300 | - |",
        "| formicar-without-ants | 1/1 | 20.0 | 20.0 | - | - | - | - | 1.0000 | 1.2500 |",
    ] {
        assert!(text.contains(row), "no {row} in {text}");
    }
    assert!(!text.contains("a ompl-rrtconnect-dubins"));
}

#[test]
fn without_peers_the_report_says_so() {
    let alone = Standing {
        peers: Vec::new(),
        ..standing(vec![run("a", 0, 0.01)])
    };
    let report = alone.report();
    assert!(report.intro.contains("Nothing is known of peers"));
    assert_eq!(
        report
            .tables()
            .filter(|t| t.key.starts_with("peers"))
            .count(),
        0
    );
    assert!(matches!(
        report.tables().next().unwrap().rows[0][0],
        Field::Words(_)
    ));
}

#[test]
fn tables_with_missing_values_are_read() {
    let peers = Peer::read(PEERS).unwrap();
    assert_eq!((peers[3].solved, peers[3].length_1s_m), (0, None));
    assert!(Peer::read("scenario,peer\na,b\n").is_err());
    let columns = "scenario,planner,seed,status,valid,source,length_0.1s_m,length_1s_m\n";
    let runs = read_csv(&format!("{columns}a,formicar,3,found,true,m,,9.5\n"));
    let run = &runs.unwrap()[0].record;
    assert_eq!(
        (run.seed, run.valid, run.length_by_second_m),
        (3, Some(true), Some(9.5))
    );
}
