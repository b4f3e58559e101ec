//! Rounding without calls of the mathematics library.

/// The largest integer that is not above a finite number, within the range of `i64`.
///
/// `f64::floor` is a call where the target lacks an instruction for it, as x86-64 does before
/// SSE 4.1; in inner loops that costs more than the rest.
#[inline]
pub(crate) fn integer_below(v: f64) -> i64 {
    let truncated = v as i64;
    truncated - i64::from(truncated as f64 > v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn is_the_floor(v in prop_oneof![-3.0..3.0, -1e12..1e12, (-9_i32..9).prop_map(f64::from)]) {
            prop_assert_eq!(integer_below(v) as f64, v.floor());
        }
    }
}
