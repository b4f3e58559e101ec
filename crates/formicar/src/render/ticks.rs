//! Round numbers on axes and scale bars.

/// The round step (1, 2 or 5 times a power of ten) nearest above `range / n_most`.
pub(super) fn round_step(range: f64, n_most: f64) -> f64 {
    let rough = range / n_most;
    let power = 10_f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= rough);
    factor.unwrap_or(10.0) * power
}

/// Multiples of a step from `low` to `high`; none where the range is no range.
pub(super) fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    if !(first.abs() < 1e12 && last.abs() < 1e12 && last - first < 1e3) {
        return Vec::new();
    }
    (first as i64..=last as i64)
        .map(|i| i as f64 * step)
        .collect()
}

/// A number with as many decimals as its step needs.
pub(super) fn label(value: f64, step: f64) -> String {
    if value.abs() >= 1e6 || step < 1e-5 {
        return format!("{value:.1e}");
    }
    let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
    let digits = format!("{value:.decimals$}");
    if value == 0.0 { "0".to_owned() } else { digits }
}

/// A length in meters with its unit.
pub(super) fn length_label(length_m: f64) -> String {
    match length_m {
        km if km >= 1000.0 => format!("{} km", km / 1000.0),
        m if m >= 1.0 => format!("{m} m"),
        m if m >= 0.01 => format!("{} cm", (m * 100.0).round()),
        m => format!("{m:.0e} m"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round() {
        for (range, step) in [(10.0, 2.0), (0.9, 0.2), (101.0, 50.0), (4.9, 1.0)] {
            assert!(
                (round_step(range, 5.0) / step - 1.0).abs() < 1e-12,
                "{range}"
            );
        }
    }

    #[test]
    fn ticks_stay_in_range_and_read_well() {
        let labels: Vec<_> = multiples(-0.05, 0.1, 0.05)
            .iter()
            .map(|&t| label(t, 0.05))
            .collect();
        assert_eq!(labels, ["-0.05", "0", "0.05", "0.10"]);
        assert!(multiples(f64::NAN, 1.0, 0.1).is_empty());
        assert!(multiples(0.0, 1.0, 0.0).is_empty());
        assert_eq!(label(1500.0, 500.0), "1500");
    }
}
