//! The distribution of the sum of positive ranks where both signs are equally likely.

/// The two-sided probability of a sum of positive ranks: twice the smaller of both tails, at most
/// 1. Ranks are whole or half numbers, as those that equal values share.
///
/// Time and memory grow with the square of the number of ranks times their number.
pub(super) fn two_sided_exact(ranks: &[f64], positive: f64) -> f64 {
    // Twice a rank is a whole number.
    let doubled: Vec<usize> = ranks.iter().map(|rank| (2.0 * rank) as usize).collect();
    let shares = shares_of_sums(&doubled);
    let sum = (2.0 * positive) as usize;
    let below: f64 = shares[..=sum].iter().sum();
    let above: f64 = shares[sum..].iter().sum();
    (2.0 * below.min(above)).min(1.0)
}

/// For each sum the share of all choices of numbers that add up to it.
fn shares_of_sums(numbers: &[usize]) -> Vec<f64> {
    let mut shares = vec![1.0];
    for &number in numbers {
        let mut next = vec![0.0; shares.len() + number];
        for (sum, share) in shares.iter().enumerate() {
            next[sum] += 0.5 * share;
            next[sum + number] += 0.5 * share;
        }
        shares = next;
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_counted() {
        // Of 1, 2, 3: 0 1 2 3 3 4 5 6.
        let shares = shares_of_sums(&[1, 2, 3]);
        assert_eq!(shares, [1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0].map(|n| n / 8.0));
        assert_eq!(two_sided_exact(&[1.0, 2.0, 3.0], 6.0), 0.25);
        assert_eq!(two_sided_exact(&[1.0, 2.0, 3.0], 3.0), 1.0);
        // Signs of two equal values: sums 0, 1.5 twice, 3.
        assert_eq!(two_sided_exact(&[1.5, 1.5], 3.0), 0.5);
    }
}
