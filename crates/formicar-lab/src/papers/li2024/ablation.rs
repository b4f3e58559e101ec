//! What each term of the proposed method brings: each off, with the same seeds.

use super::drive::Drive;
use super::group::{Group, ratio};
use super::methods::PROPOSED;
use crate::analysis::statistics::{bootstrap_median, holm, quantile, vargha_delaney_a, wilcoxon};
use crate::papers::experiment::Variant;
use crate::report::Block;
use crate::report::{Field, Section, Table};
use formicar::colony::chord::{
    ChordConfig, ChordTransition, CornerRule, CornerTerm, Depositor, DistanceTerm, Safety,
    SteeringLimit, StraightnessUse,
};
use formicar::colony::corridor::Corridor;
use formicar::colony::dead_end::DeadEnd;
use formicar::colony::evaporation::{Constant, Evaporation, Generational, Recursion};
use formicar::colony::heuristic::Guidance;
use formicar::numeric::Seed;
use formicar::planner::{PlannerConfig, PlannerName};
use formicar::smoothing::{Corners, RedundantNodes};

/// The part of the experiment.
pub(super) const ABLATION: &str = "ablation";

/// The method as it is, then with each of its terms off, and two that tell what ants and arcs
/// bring apart.
pub(super) fn variants() -> Vec<Variant> {
    let faco = PlannerName::Faco2024;
    let off = |what: &str, change: fn(&mut ChordConfig)| {
        Variant::changed(faco, what, |c| change(&mut c.chords))
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
        Variant::changed(faco, "2-turning for wide arcs", |c| {
            c.smoothing.corners = Corners::TwoTurningOrDubins;
        }),
        Variant::changed(PlannerName::Astar, "wide arcs, no ants", |c| {
            c.smoothing = PlannerConfig::of(PlannerName::Faco2024).smoothing;
            c.smoothing.redundant_nodes = RedundantNodes::Collinear;
        }),
    ]
}

/// A number that variants are compared by, pair by pair.
struct Measure {
    key: &'static str,
    name: &'static str,
    n_decimals: usize,
    of: fn(&Drive) -> Option<f64>,
}

const MEASURES: [Measure; 4] = [
    Measure {
        key: "paired-length",
        name: "certified length, m",
        n_decimals: 3,
        of: |drive| drive.certified_length_m,
    },
    Measure {
        key: "paired-step",
        name: "largest step over 1 m, deg",
        n_decimals: 2,
        of: |drive| drive.largest_step_deg,
    },
    Measure {
        key: "paired-cost",
        name: "J",
        n_decimals: 4,
        of: |drive| drive.cost,
    },
    Measure {
        key: "paired-time",
        name: "time, ms",
        n_decimals: 1,
        of: |drive| Some(drive.total_ms),
    },
];

/// The tables of the runs of some variants, the first of which the others are compared with.
pub(super) fn section(drives: &[Drive], variants: &[Variant]) -> Section {
    let compared = variants.len() > 1;
    let paired = MEASURES
        .iter()
        .filter(|_| compared)
        .map(|measure| paired(drives, variants, measure));
    let tables = [outcomes(drives, variants)].into_iter().chain(paired);
    Section {
        heading: format!("What each term of {PROPOSED} brings"),
        blocks: tables.map(Block::Table).collect(),
    }
}

fn outcomes(drives: &[Drive], variants: &[Variant]) -> Table {
    let caption = "Each term off, with the same seeds: certified runs with the 95 % interval of \
                   their rate (Wilson), medians with quartiles of certified length, largest turn \
                   over 1 m, J of the path before corners are rounded, and time.";
    let mut table = Table::new(
        "ablation",
        &[
            "variant",
            "certified",
            "driven m",
            "largest step deg",
            "J",
            "time ms",
            "time / first",
        ],
    )
    .captioned(caption);
    let time = |drive: &Drive| Some(drive.total_ms);
    let group = |variant: &Variant| Group::new(drives, ABLATION, &variant.name);
    let first = variants.first().and_then(|first| group(first).median(time));
    for variant in variants {
        let group = group(variant);
        table.row(vec![
            Field::words(&variant.name),
            group.certified(),
            group.spread(|drive| drive.certified_length_m, 2),
            group.spread(|drive| drive.largest_step_deg, 1),
            group.spread(|drive| drive.cost, 4),
            group.spread(time, 1),
            Field::Number(ratio(group.median(time), first), 2),
        ]);
    }
    table
}

/// Differences of variants to the first, seed by seed.
fn paired(drives: &[Drive], variants: &[Variant], measure: &Measure) -> Table {
    let caption = format!(
        "Differences to the first, seed by seed, in {}: median with its 95 % interval (percentile \
         bootstrap, seed 0), probability of the signed-rank test (two-sided, exact up to 50 \
         differences) and after Holm's correction over this table, and Vargha and Delaney's A: how often the \
         variant has the larger value.",
        measure.name
    );
    let mut table = Table::new(
        measure.key,
        &["variant", "pairs", "difference", "p", "p, Holm", "A"],
    )
    .captioned(&caption);
    let pairs: Vec<(&str, Pairs)> = variants
        .iter()
        .skip(1)
        .map(|variant| {
            (
                variant.name.as_str(),
                Pairs::new(drives, [&variants[0], variant], measure),
            )
        })
        .collect();
    let tests: Vec<Option<f64>> = pairs.iter().map(|(_, pairs)| pairs.p()).collect();
    let adjusted = holm(&tests.iter().flatten().copied().collect::<Vec<_>>());
    let mut adjusted = adjusted.into_iter();
    for ((name, pairs), p) in pairs.iter().zip(tests) {
        table.row(vec![
            Field::words(name),
            Field::Number(Some(pairs.differences.len() as f64), 0),
            Field::Spread(pairs.median(), measure.n_decimals),
            Field::Number(p, 4),
            Field::Number(p.and_then(|_| adjusted.next()), 4),
            Field::Number(vargha_delaney_a(&pairs.other, &pairs.first), 2),
        ]);
    }
    table
}

/// Values of two variants with the same seeds, where both have one.
struct Pairs {
    first: Vec<f64>,
    other: Vec<f64>,
    differences: Vec<f64>,
}

impl Pairs {
    fn new(drives: &[Drive], [first, other]: [&Variant; 2], measure: &Measure) -> Self {
        let [first, other] = [first, other].map(|v| Group::new(drives, ABLATION, &v.name));
        let value_of_first = |drive: &Drive| {
            let same = |run: &&&Drive| run.seed == drive.seed && run.ground == drive.ground;
            (measure.of)(first.runs().iter().find(same)?)
        };
        let pair = |drive: &&Drive| Some([value_of_first(drive)?, (measure.of)(drive)?]);
        let pairs: Vec<[f64; 2]> = other.runs().iter().filter_map(pair).collect();
        Self {
            first: pairs.iter().map(|pair| pair[0]).collect(),
            other: pairs.iter().map(|pair| pair[1]).collect(),
            differences: pairs.iter().map(|pair| pair[1] - pair[0]).collect(),
        }
    }

    fn median(&self) -> Option<[f64; 3]> {
        let [low, high] = bootstrap_median(&self.differences, Seed(0))?;
        Some([low, quantile(&self.differences, 0.5)?, high])
    }

    fn p(&self) -> Option<f64> {
        wilcoxon(&self.differences).map(|test| test.p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two variants of ten runs; the second is longer by 1 to 10 m, but has no run of seed 3.
    fn drives() -> (Vec<Drive>, [Variant; 2]) {
        let variants = [
            Variant::of(PlannerName::Lei2020),
            Variant::changed(PlannerName::Lei2020, "turns cost nothing", |c| {
                c.colony.cost.turn_weight = 0.0;
            }),
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
