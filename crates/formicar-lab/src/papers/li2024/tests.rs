//! The whole experiment in small, with methods that stand in for those of the paper.

use super::*;
use crate::report::{Field, Figure, Table};
use formicar::planner::ColonyParameters;
use methods::Generations;

fn method(name: &str, native: Native, generations: Generations) -> Method {
    Method {
        planner: name.parse().unwrap(),
        native,
        generations,
    }
}

fn plan() -> Plan {
    let scale = Scale {
        n_seeds: 3,
        n_runs: 2,
        ..Scale::QUICK
    };
    let lei2020 = |what: &str, n_ants: u32| {
        Variant::changed(
            "lei2020".parse().unwrap(),
            what,
            |c: &mut ColonyParameters| {
                c.colony.n_ants = n_ants;
            },
        )
    };
    Plan {
        methods: vec![
            method("astar", Native::Cells, Generations::None),
            method("hybrid-astar", Native::Curve, Generations::None),
            method("elitist", Native::Nodes, Generations::Record),
            method("lei2020", Native::Nodes, Generations::Ways),
        ],
        ablation: vec![lei2020("20 ants", 20), lei2020("10 ants", 10)],
        ground: Ground::builtin("lei-map1").unwrap(),
        hood: Err("data/car/hood_800x500.json".into()),
        scale,
        n_jobs: 2,
    }
}

fn table<'a>(report: &'a Report, key: &str) -> &'a Table {
    report.tables().find(|table| table.key == key).unwrap()
}

#[test]
fn tables_and_figures_come_from_the_rows() {
    let plan = plan();
    let mut told = Vec::new();
    let reproduction = plan.run(&mut |what| told.push(what.to_owned())).unwrap();
    assert!(
        told.iter()
            .any(|what| what == "lei-map1: lei2020, by generation"),
        "{told:?}"
    );
    // Four methods and two variants with three seeds.
    assert_eq!(reproduction.n_runs, 4 * 3 + 2 * 3);
    assert_eq!(reproduction.csv.lines().count(), 1 + reproduction.n_runs);
    let report = &reproduction.report;
    assert!(report.intro.contains("3 runs per method"));
    let lengths = table(report, "length");
    assert_eq!(lengths.rows.len(), 4);
    let hybrid = &lengths.rows[1];
    assert_eq!(hybrid[1], Field::Rate(3, 3));
    let Field::Spread(Some([_, driven_m, _]), 2) = hybrid[4] else {
        panic!("{hybrid:?}")
    };
    assert!(driven_m > 8.5 && driven_m < 30.0, "{driven_m}");
    assert_eq!(
        table(report, "time").rows[0][3],
        Field::Number(Some(1.0), 2)
    );
    let shares = &table(report, "native").rows[0][3..6];
    let sum: f64 = shares
        .iter()
        .map(|share| match share {
            Field::Number(Some(share), 2) => *share,
            other => panic!("{other:?}"),
        })
        .sum();
    assert!((sum - 100.0).abs() < 1e-9, "{sum}");
    let blocks = report.sections.iter().flat_map(|section| &section.blocks);
    let n_of = |is_it: fn(&&Block) -> bool| blocks.clone().filter(is_it).count();
    // The map, all paths, and a path of each method; the costs of both colonies.
    assert_eq!(n_of(|block| matches!(block, Block::Figure(_))), 6);
    assert_eq!(n_of(|block| matches!(block, Block::Trends(_))), 2);
    let svgs: Vec<Figure> = blocks.clone().filter_map(Block::figure).collect();
    assert!(svgs.iter().all(|figure| figure.svg.starts_with("<svg ")));
    assert_eq!(reproduction.configs.len(), 4 + 2);
}

#[test]
fn the_same_seeds_give_the_same_rows_but_for_times() {
    let plan = plan();
    let without_times = || {
        let mut findings = Findings::default();
        plan.switch_terms_off(&mut findings, &mut |_| ()).unwrap();
        let untimed = |drive: Drive| Drive {
            total_ms: 0.0,
            map_setup_ms: 0.0,
            query_ms: 0.0,
            first_feasible_ms: None,
            ..drive
        };
        findings.drives.into_iter().map(untimed).collect::<Vec<_>>()
    };
    assert_eq!(without_times(), without_times());
}
