//! Numbers in sentences.

use std::fmt::Display;

/// A number with what it counts: `1 step`, `2 steps`.
pub fn counted<N: Copy + Display + PartialEq + From<u8>>(n: N, noun: &str) -> String {
    let plural = if n == N::from(1) { "" } else { "s" };
    format!("{n} {noun}{plural}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_has_no_plural() {
        assert_eq!(counted(1_u64, "step"), "1 step");
        assert_eq!(counted(0_usize, "step"), "0 steps");
    }
}
