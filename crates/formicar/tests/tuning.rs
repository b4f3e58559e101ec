//! The bee colony on functions whose least values are known, and what it promises of itself.

use formicar::numeric::Seed;
use formicar::tuning::{
    BeeColony, BeeColonyConfig, BeeVariant, Dimension, Kind, ParameterSpace, TuningError,
};
use proptest::prelude::*;
use std::f64::consts::TAU;

const VARIANTS: [BeeVariant; 2] = [BeeVariant::Basic, BeeVariant::VariableStrategy];

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

fn rosenbrock(x: &[f64]) -> f64 {
    let pairs = x.windows(2);
    let term = |p: &[f64]| 100.0 * (p[1] - p[0] * p[0]).powi(2) + (1.0 - p[0]).powi(2);
    pairs.map(term).sum()
}

fn rastrigin(x: &[f64]) -> f64 {
    let term = |x: &f64| x * x - 10.0 * (TAU * x).cos() + 10.0;
    x.iter().map(term).sum()
}

fn cube(n: usize, reach: f64) -> ParameterSpace {
    let side = Kind::Real {
        low: -reach,
        high: 0.8 * reach,
    };
    let dimensions = (0..n).map(|i| Dimension::new(&format!("x{i}"), side.clone()));
    ParameterSpace::new(dimensions.collect()).unwrap()
}

fn mixed() -> ParameterSpace {
    let dimension = |(name, kind): (&str, Kind)| Dimension::new(name, kind);
    let (low, high) = (2.0, 9.0);
    let kinds = [
        ("real", Kind::Real { low, high }),
        ("ratio", Kind::LogReal { low: 1e-3, high }),
        ("count", Kind::Integer { low, high }),
        ("many", Kind::LogInteger { low, high: 5000.0 }),
        ("which", Kind::Choice { n_choices: 3 }),
    ];
    ParameterSpace::new(kinds.map(dimension).to_vec()).unwrap()
}

/// Far from a sphere's middle in every dimension.
fn mixed_cost(v: &[f64]) -> f64 {
    (v[0] - 3.0).abs() + (v[1] / 0.05).ln().abs() + (v[2] - 4.0).abs() + (v[3] / 700.0).ln().abs()
        - v[4]
}

fn config(variant: BeeVariant, max_evaluations: u64) -> BeeColonyConfig {
    BeeColonyConfig {
        n_sources: 20,
        limit: None,
        max_evaluations,
        variant,
    }
}

fn finished(
    space: &ParameterSpace,
    config: &BeeColonyConfig,
    seed: u64,
    cost: fn(&[f64]) -> f64,
) -> BeeColony {
    let mut colony = BeeColony::new(space.clone(), config.clone(), Seed(seed)).unwrap();
    while !colony.is_done() {
        let mut all = |values: &[Vec<f64>]| values.iter().map(|v| cost(v)).collect();
        colony.cycle(&mut all).unwrap();
    }
    colony
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Least cost of as many places drawn alike.
fn random_search(space: &ParameterSpace, n: u64, seed: u64, cost: fn(&[f64]) -> f64) -> f64 {
    let costs = (0..n).map(|i| {
        let mut random = Seed(seed).stream([i, 9]);
        let place: Vec<f64> = space.dimensions().iter().map(|_| random.unit()).collect();
        cost(&space.values(&place))
    });
    costs.fold(f64::MAX, f64::min)
}

/// A function to be searched: its name, reach of the cube, dimensions, evaluations, and the most
/// that the median of 11 runs of each variant may be off.
type Case = (&'static str, fn(&[f64]) -> f64, f64, usize, u64, [f64; 2]);

#[test]
fn known_least_values_are_found() {
    let cases: [Case; 4] = [
        ("sphere", sphere, 100.0, 10, 20_000, [1e-15, 1e-20]),
        ("rosenbrock", rosenbrock, 10.0, 5, 20_000, [0.3, 0.05]),
        ("rastrigin", rastrigin, 5.12, 5, 10_000, [1e-10, 1e-10]),
        ("rastrigin", rastrigin, 5.12, 10, 20_000, [1e-10, 1e-10]),
    ];
    for (name, function, reach, n, n_evaluations, bounds) in cases {
        let space = cube(n, reach);
        let blind = median((0..11).map(|s| random_search(&space, n_evaluations, s, function)));
        for (variant, bound) in VARIANTS.into_iter().zip(bounds) {
            let config = config(variant, n_evaluations);
            let runs = (0..11).map(|seed| finished(&space, &config, seed, function));
            let found = median(runs.map(|colony| colony.best().unwrap().cost));
            println!("{name} {n}: {variant:?} {found:e}, at random {blind:e}");
            assert!(found <= bound, "{name} {n}, {variant:?}: {found:e}");
            assert!(10.0 * found < blind, "{name} {n}: {found} beside {blind}");
        }
    }
}

#[test]
fn numbers_ratios_counts_and_choices_are_found_together() {
    let space = mixed();
    for variant in VARIANTS {
        let runs = (0..11).map(|seed| finished(&space, &config(variant, 2000), seed, mixed_cost));
        let colonies: Vec<BeeColony> = runs.collect();
        let found = median(colonies.iter().map(|colony| colony.best().unwrap().cost));
        assert!(found < -1.95, "{variant:?}: {found}");
        for colony in colonies {
            let values = colony.best_values().unwrap();
            assert!(values[2].fract() == 0.0 && values[3].fract() == 0.0 && values[4] == 2.0);
        }
    }
}

#[test]
fn evaluations_are_counted_to_the_last_one() {
    for variant in VARIANTS {
        for n_most in [20, 21, 37, 59, 60, 61, 100, 499] {
            let mut n_seen = 0;
            let space = cube(3, 1.0);
            let mut colony = BeeColony::new(space, config(variant, n_most), Seed(3)).unwrap();
            while !colony.is_done() {
                let mut all = |values: &[Vec<f64>]| {
                    n_seen += values.len() as u64;
                    values.iter().map(|v| sphere(v)).collect()
                };
                colony.cycle(&mut all).unwrap();
            }
            assert_eq!((n_seen, colony.n_evaluations()), (n_most, n_most));
            // A cycle of 20 sources is 20 employed bees, 20 onlookers and a scout at most.
            assert_eq!(colony.history()[0].n_evaluations, 20);
            for pair in colony.history().windows(2) {
                let n = pair[1].n_evaluations - pair[0].n_evaluations;
                let is_last = pair[1].n_evaluations == n_most;
                assert!(is_last || n == 40 + u64::from(pair[1].scouted));
            }
        }
    }
}

#[test]
fn a_search_taken_up_again_is_one_undisturbed() {
    for variant in VARIANTS {
        let config = BeeColonyConfig {
            limit: Some(5),
            ..config(variant, 1500)
        };
        let whole = finished(&mixed(), &config, 8, mixed_cost);
        assert!(whole.history().iter().any(|cycle| cycle.scouted));
        let mut colony = BeeColony::new(mixed(), config, Seed(8)).unwrap();
        let begun = colony.clone();
        while !colony.is_done() {
            let text = serde_json::to_string(&colony).unwrap();
            colony = serde_json::from_str(&text).unwrap();
            colony.check().unwrap();
            assert!(colony.began_like(&begun));
            let mut all = |values: &[Vec<f64>]| values.iter().map(|v| mixed_cost(v)).collect();
            colony.cycle(&mut all).unwrap();
        }
        assert_eq!(colony, whole);
        let text = |colony| serde_json::to_string(colony).unwrap();
        assert_eq!(text(&colony), text(&whole));
    }
}

#[test]
fn a_known_place_is_where_the_search_begins() {
    let known = [4.0, 0.05, 4.0, 650.0, 2.0];
    let colony = BeeColony::new(mixed(), config(BeeVariant::Basic, 20), Seed(1)).unwrap();
    let mut colony = colony.with_known(&known).unwrap();
    let mut first = None;
    let mut all = |values: &[Vec<f64>]| {
        first.get_or_insert(values[0].clone());
        values.iter().map(|v| mixed_cost(v)).collect()
    };
    colony.cycle(&mut all).unwrap();
    let first = first.unwrap();
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
    assert!(first.iter().zip(&known).all(near), "{first:?}");
    assert!(colony.best().unwrap().cost <= mixed_cost(&known) + 1e-9);
}

#[test]
fn costs_that_are_no_numbers_are_the_worst() {
    let mut colony =
        BeeColony::new(cube(2, 1.0), config(BeeVariant::default(), 400), Seed(2)).unwrap();
    let cost = |v: &Vec<f64>| match v[0] {
        x if x < -0.5 => f64::NAN,
        x if x < 0.0 => f64::NEG_INFINITY,
        _ => sphere(v),
    };
    while !colony.is_done() {
        let mut all = |values: &[Vec<f64>]| values.iter().map(cost).collect();
        colony.cycle(&mut all).unwrap();
    }
    let best = colony.best_values().unwrap();
    assert!(best[0] >= 0.0 && colony.best().unwrap().cost < 0.01);
}

#[test]
fn spaces_that_cannot_be_are_refused() {
    let one = |kind: Kind| ParameterSpace::new(vec![Dimension::new("k", kind)]);
    let (low, high) = (2.0, 1.0);
    let cases = [
        (
            Kind::Real { low, high },
            "high of k = 1; it must be above 2 and finite",
        ),
        (
            Kind::Real {
                low: f64::MIN,
                high: f64::MAX,
            },
            "high of k = 179769313486231570000",
        ),
        (
            Kind::LogReal { low: 0.0, high },
            "low of k = 0; it must be in 2.2250738585072014e-308",
        ),
        (
            Kind::Integer { low: 0.5, high },
            "bound of k = 0.5; it must be an integer",
        ),
        (
            Kind::LogInteger { low: 0.0, high },
            "low of k = 0; it must be in 1e0 to",
        ),
        (
            Kind::Choice { n_choices: 1 },
            "number of choices of k = 1; it must be at least 2",
        ),
        (
            Kind::Real {
                low: f64::NAN,
                high,
            },
            "low of k = NaN",
        ),
    ];
    for (kind, expected) in cases {
        let error = one(kind).unwrap_err().to_string();
        assert!(error.starts_with(expected), "{error}");
    }
    let real = || Dimension::new("k", Kind::Real { low: 0.0, high });
    let error = ParameterSpace::new(vec![real(), real()]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "two dimensions are named \"k\"; hint: each parameter once"
    );
    assert!(ParameterSpace::new(Vec::new()).is_err());
}

#[test]
fn searches_that_cannot_be_are_refused() {
    let message = |error: TuningError| error.to_string();
    let colony = |config| BeeColony::new(cube(2, 1.0), config, Seed(0));
    let few = BeeColonyConfig {
        n_sources: 3,
        ..BeeColonyConfig::default()
    };
    let error = message(colony(few).unwrap_err());
    assert_eq!(error, "n_sources = 3; it must be in 4 to 10000");
    let short = BeeColonyConfig {
        max_evaluations: 9,
        ..BeeColonyConfig::default()
    };
    let error = message(colony(short).unwrap_err());
    assert_eq!(
        error,
        "max_evaluations = 9; it must be in 10 to 1000000000000"
    );
    let mut sound = colony(BeeColonyConfig::default()).unwrap();
    let error = message(sound.clone().with_known(&[0.0, 3.0]).unwrap_err());
    assert_eq!(error, "x1 = 3; it must be in -1 to 0.8");
    let error = message(sound.cycle(&mut |_| vec![1.0]).unwrap_err());
    assert!(
        error.starts_with("1 costs were given for 10 candidates"),
        "{error}"
    );
}

#[test]
fn a_damaged_state_is_told_from_a_sound_one() {
    let colony = finished(&cube(2, 1.0), &config(BeeVariant::Basic, 100), 1, sphere);
    let sound = serde_json::to_value(&colony).unwrap();
    let checked = |value| serde_json::from_value::<BeeColony>(value).unwrap().check();
    assert!(checked(sound.clone()).is_ok());
    let damage = [
        ("/sources/0/position/0", serde_json::json!(1.5)),
        ("/sources/0/position", serde_json::json!([0.5])),
        ("/sources", serde_json::json!([])),
        ("/best", serde_json::json!(null)),
        ("/counters", serde_json::json!([])),
        ("/config/n_sources", serde_json::json!(5)),
        ("/space", serde_json::json!([])),
    ];
    for (pointer, value) in damage {
        let mut damaged = sound.clone();
        *damaged.pointer_mut(pointer).unwrap() = value;
        assert!(checked(damaged).is_err(), "{pointer}");
    }
}

proptest! {
    #[test]
    fn candidates_stay_inside_and_the_best_never_gets_worse(
        seed in any::<u64>(),
        n_most in 4_u64..400,
        limit in 1_u32..30,
        is_basic in any::<bool>(),
    ) {
        let variant = VARIANTS[usize::from(is_basic)];
        let config = BeeColonyConfig {
            n_sources: 4,
            limit: Some(limit),
            max_evaluations: n_most,
            variant,
        };
        let mut colony = BeeColony::new(mixed(), config, Seed(seed)).unwrap();
        let mut least = f64::MAX;
        while !colony.is_done() {
            let mut all = |values: &[Vec<f64>]| {
                for v in values {
                    assert!((2.0..=9.0).contains(&v[0]) && (1e-3..=9.0).contains(&v[1]));
                    assert!((2.0..=9.0).contains(&v[2]) && v[2].fract() == 0.0);
                    assert!((2.0..=5000.0).contains(&v[3]) && v[3].fract() == 0.0);
                    assert!([0.0, 1.0, 2.0].contains(&v[4]));
                }
                let costs: Vec<f64> = values.iter().map(|v| mixed_cost(v)).collect();
                least = costs.iter().copied().fold(least, f64::min);
                costs
            };
            colony.cycle(&mut all).unwrap();
            prop_assert_eq!(colony.best().unwrap().cost, least);
            prop_assert!(colony.check().is_ok());
        }
        let values = colony.best_values().unwrap();
        prop_assert!((mixed_cost(&values) - least).abs() < 1e-12);
        let costs: Vec<f64> = colony.history().iter().map(|c| c.best_cost).collect();
        prop_assert!(costs.is_sorted_by(|a, b| a >= b));
        prop_assert_eq!(colony.n_evaluations(), n_most);
    }

    #[test]
    fn values_and_places_name_each_other(place in prop::collection::vec(0.0..=1.0_f64, 5)) {
        let space = mixed();
        let values = space.values(&place);
        let again = space.values(&space.position(&values).unwrap());
        for (a, b) in values.iter().zip(&again) {
            prop_assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{} {}", a, b);
        }
    }
}
