//! Statistics equal those of `SciPy` and statsmodels: `data/make_statistics.py` makes the values.

use formicar_lab::analysis::statistics::{
    holm, quantile, vargha_delaney_a, wilcoxon, wilcoxon_normal, wilson_interval,
};
use serde_json::Value;

const TOLERANCE: f64 = 1e-9;

/// The cases of a kind.
fn cases(kind: &str) -> Vec<Value> {
    let reference: Value = serde_json::from_str(include_str!("data/statistics.json")).unwrap();
    let cases = reference[kind].as_array().unwrap().clone();
    assert!(cases.len() >= 8, "{kind}: {}", cases.len());
    cases
}

fn number(case: &Value, key: &str) -> f64 {
    case[key].as_f64().unwrap()
}

fn count(case: &Value, key: &str) -> usize {
    usize::try_from(case[key].as_u64().unwrap()).unwrap()
}

fn numbers(case: &Value, key: &str) -> Vec<f64> {
    let values = case[key].as_array().unwrap();
    values.iter().map(|value| value.as_f64().unwrap()).collect()
}

/// Equal to 1e-9, of small probabilities relatively.
fn assert_equal(found: f64, expected: f64, case: &Value) {
    let allowed = TOLERANCE * expected.abs().clamp(f64::MIN_POSITIVE, 1.0);
    assert!(
        (found - expected).abs() <= allowed,
        "{found} instead of {expected}: {case}"
    );
}

#[test]
fn wilson_intervals() {
    for case in cases("wilson") {
        let (low, high) = wilson_interval(count(&case, "n_success"), count(&case, "n"));
        for (found, expected) in [(low, "low"), (high, "high")] {
            assert!(
                (found - number(&case, expected)).abs() <= TOLERANCE,
                "{found}: {case}"
            );
        }
    }
}

#[test]
fn signed_rank_tests() {
    for case in cases("wilcoxon") {
        let differences = numbers(&case, "differences");
        let found = wilcoxon(&differences).unwrap();
        assert_eq!(found.n, count(&case, "n"));
        assert_equal(found.statistic, number(&case, "statistic"), &case);
        assert_equal(found.p, number(&case, "p"), &case);
        let normal = wilcoxon_normal(&differences).unwrap();
        assert_equal(normal.p, number(&case, "p_normal"), &case);
    }
}

#[test]
fn corrections_of_holm() {
    for case in cases("holm") {
        let adjusted = holm(&numbers(&case, "p"));
        for (found, expected) in adjusted.iter().zip(numbers(&case, "adjusted")) {
            assert_equal(*found, expected, &case);
        }
    }
}

#[test]
fn probabilities_of_vargha_and_delaney() {
    for case in cases("vargha_delaney") {
        let found = vargha_delaney_a(&numbers(&case, "a"), &numbers(&case, "b")).unwrap();
        assert_equal(found, number(&case, "probability"), &case);
    }
}

#[test]
fn quantiles() {
    for case in cases("quantiles") {
        let found = quantile(&numbers(&case, "values"), number(&case, "p")).unwrap();
        assert_equal(found, number(&case, "quantile"), &case);
    }
}
