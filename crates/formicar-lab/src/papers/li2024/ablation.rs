//! Each term of the proposed method switched off, with the same seeds.

use super::drive::Drive;
use super::group::{ABLATION, COST, DRIVEN, STEP, TIME, drives_of};
use super::methods::PROPOSED;
use crate::papers::claims::{Claim, Claims, Expected, Tested};
use crate::papers::experiment::Variant;
use crate::papers::group::{GroupColumn, Quantity, ratio, table_of};
use crate::report::{Block, Column, Field, Section, Table};
use formicar::colony::chord::{
    ChordConfig, ChordTransition, CornerRule, CornerTerm, Depositor, DistanceTerm, Safety,
    SteeringLimit, StraightnessUse,
};
use formicar::colony::corridor::Corridor;
use formicar::colony::dead_end::DeadEnd;
use formicar::colony::evaporation::{Constant, Evaporation, Generational, Recursion};
use formicar::colony::heuristic::Guidance;
use formicar::planner::{AstarParameters, ChordParameters, PlannerName};
use formicar::smoothing::{Corners, RedundantNodes};

/// The method as it is, then with each of its terms off, and two that tell what ants and arcs
/// bring apart.
pub(super) fn variants() -> Vec<Variant> {
    let faco = PlannerName::Faco2024;
    let off = |what: &str, change: fn(&mut ChordConfig)| {
        Variant::changed(faco, what, |c: &mut ChordParameters| change(&mut c.chords))
    };
    vec![
        Variant::of(faco),
        off("corners cost nothing", |c| c.corner = CornerTerm::None),
        off("corners as a sum", |c| {
            c.corner = CornerTerm::Sum(CornerRule::default());
        }),
        off("straightness 1", |c| {
            c.corner = CornerTerm::Product(CornerRule {
                straightness: StraightnessUse::One,
                ..CornerRule::default()
            });
        }),
        off("no distance term", |c| c.distance = DistanceTerm::None),
        off("rigid steering limit", |c| c.limit = SteeringLimit::Rigid),
        off("integer order", |c| c.transition = ChordTransition::Plain),
        off("no A* seed", |c| c.initial.factor = 1.0),
        off("constant evaporation", |c| {
            c.evaporation = Evaporation::Constant(Constant { rho: 0.5 });
        }),
        off("evaporation to the letter", |c| {
            c.evaporation = Evaporation::Generational(Generational {
                recursion: Recursion::Compound,
                ..Generational::default()
            });
        }),
        off("deposit by length alone", |c| c.deposit.spread_weight = 0.0),
        off("all ants deposit", |c| c.deposit.by = Depositor::All),
        off("no footprint", |c| c.safety = Safety::None),
        off("a disc for the footprint", |c| c.safety = Safety::Disc),
        off("no guidance", |c| c.guidance = Guidance::None),
        off("no corridor", |c| c.corridor = Corridor::None),
        off("ants die in dead ends", |c| c.dead_end = DeadEnd::Die),
        off("eight neighbors", |c| c.reach = 1),
        off("all 50 generations", |c| c.stopping.stall_iterations = 0),
        off("the paper's plain form", |c| {
            c.guidance = Guidance::None;
            c.corridor = Corridor::None;
            c.dead_end = DeadEnd::Die;
        }),
        Variant::changed(
            faco,
            "2-turning for wide arcs",
            |c: &mut ChordParameters| {
                c.smoothing.corners = Corners::TwoTurningOrDubins;
            },
        ),
        Variant::changed(
            PlannerName::Astar,
            "wide arcs, no ants",
            |c: &mut AstarParameters| {
                c.smoothing = ChordParameters::default().smoothing;
                c.smoothing.redundant_nodes = RedundantNodes::Collinear;
            },
        ),
    ]
}

/// Quantities that variants are compared by, with the names of their tables.
const MEASURES: [(&str, Quantity<Drive>); 4] = [
    ("paired-length", DRIVEN),
    ("paired-step", STEP),
    ("paired-cost", COST),
    ("paired-time", TIME),
];

/// The tables of the runs of some variants, the first of which the others are compared with.
pub(super) fn section(drives: &[Drive], variants: &[Variant]) -> Section {
    let measures = MEASURES.iter().filter(|_| variants.len() > 1);
    let paired = measures.map(|(key, quantity)| paired(drives, variants, key, quantity));
    let tables = [outcomes(drives, variants)].into_iter().chain(paired);
    Section::new(
        format!("What each term of {PROPOSED} brings"),
        tables.map(Block::Table).collect(),
    )
}

fn outcomes(drives: &[Drive], variants: &[Variant]) -> Table {
    let caption = "Each term off, with the same seeds: certified runs with the 95 % interval of \
                   their rate (Wilson), medians with quartiles of certified length, largest turn \
                   over 1 m, J of the path before corners are rounded, and time.";
    let names = variants.iter().map(|variant| variant.name.as_str());
    let groups: Vec<_> = names
        .map(|name| (name, drives_of(drives, ABLATION, name)))
        .collect();
    let first = groups.first().and_then(|(_, first)| first.median(TIME.of));
    let columns: [GroupColumn<Drive>; 6] = [
        ("certified", &|g, _| g.certified()),
        ("driven m", &|g, _| g.spread(DRIVEN.of, 2)),
        ("largest step deg", &|g, _| g.spread(STEP.of, 1)),
        ("J", &|g, _| g.spread(COST.of, 4)),
        ("time ms", &|g, _| g.spread(TIME.of, 1)),
        ("time / first", &|g, _| {
            Field::Number(ratio(g.median(TIME.of), first), 2)
        }),
    ];
    table_of("ablation", "variant", &columns, groups).captioned(caption)
}

/// Differences of variants to the first, seed by seed.
fn paired(drives: &[Drive], variants: &[Variant], key: &str, quantity: &Quantity<Drive>) -> Table {
    let caption = format!(
        "Differences to the first, seed by seed, in {}: median with its 95 % interval (percentile \
         bootstrap, seed 0), probability of the signed-rank test (two-sided, exact up to 50 \
         differences) and after Holm's correction over this table, and Vargha and Delaney's A: how \
         often the variant has the larger value.",
        quantity.name
    );
    let group = |variant: &Variant| drives_of(drives, ABLATION, &variant.name);
    let (first, others) = variants
        .split_first()
        .expect("there are two variants at least");
    let first = group(first);
    let compare = |variant: &Variant| {
        let name = variant.name.clone();
        group(variant).compare(&first, quantity, name, Expected::Less)
    };
    let claims = Claims(vec![Claim::new(
        "Each is less than the first",
        "",
        "-",
        others.iter().map(compare).collect::<Vec<_>>(),
    )]);
    let columns: [Column<&Tested>; 6] = [
        ("variant", &|test| Field::words(&test.comparison.name)),
        ("pairs", &|test| Field::count(test.comparison.pairs.len())),
        ("difference", &|test| {
            Field::Spread(test.difference, quantity.n_decimals)
        }),
        ("p", &|test| Field::Number(test.p, 4)),
        ("p, Holm", &|test| Field::Number(test.p_holm, 4)),
        ("A", &|test| Field::Number(test.a, 2)),
    ];
    Table::of(key, &claims.judged()[0].tests, &columns).captioned(&caption)
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::ColonyParameters;

    /// Two variants of ten runs; the second is longer by 1 to 10 m, but has no run of seed 3.
    fn drives() -> (Vec<Drive>, [Variant; 2]) {
        let variants = [
            Variant::of(PlannerName::Lei2020),
            Variant::changed(
                PlannerName::Lei2020,
                "turns cost nothing",
                |c: &mut ColonyParameters| {
                    c.colony.cost.turn_weight = 0.0;
                },
            ),
        ];
        let drive = |variant: usize, seed: u64| Drive {
            part: ABLATION.to_owned(),
            method: variants[variant].name.clone(),
            seed,
            certified: (variant, seed) != (1, 3),
            certified_length_m: ((variant, seed) != (1, 3))
                .then_some(90.0 + (variant as u64 * (seed + 1)) as f64),
            ..Drive::default()
        };
        let drives = (0..2).flat_map(|variant| (0..10).map(move |seed| (variant, seed)));
        (drives.map(|(v, s)| drive(v, s)).collect(), variants)
    }

    #[test]
    fn variants_are_compared_seed_by_seed() {
        let (drives, variants) = drives();
        let section = section(&drives, &variants);
        let tables: Vec<&Table> = section
            .blocks
            .iter()
            .filter_map(|block| match block {
                Block::Table(table) => Some(table),
                _ => None,
            })
            .collect();
        assert_eq!(tables.len(), 1 + MEASURES.len());
        assert_eq!(tables[0].rows[1][1], Field::Rate(9, 10));
        let row = &tables[1].rows[0];
        assert_eq!(row[1], Field::Number(Some(9.0), 0));
        let Field::Spread(Some([low, median, high]), 3) = row[2] else {
            panic!("{row:?}")
        };
        // Of 1 to 10 without 4.
        assert_eq!(median, 6.0);
        assert!(low < median && median < high);
        let Field::Number(Some(p), 4) = row[3] else {
            panic!("{row:?}")
        };
        // All of nine signs are the same.
        assert!((p - 2.0 / 512.0).abs() < 1e-12, "{p}");
        assert_eq!(row[3], row[4]);
        assert_eq!(row[5], Field::Number(Some(1.0), 2));
        // Nobody was late or early.
        assert_eq!(tables[4].rows[0][3], Field::Number(None, 4));
    }
}
