//! The numbers of the paper (Li et al. 2024, Tables 1 and 2; MATLAB on an i7-6500U).

/// A row of both tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stated {
    method: &'static str,
    pub(super) length_m: f64,
    pub(super) time_s: f64,
    pub(super) success_percent: f64,
    /// Shares of turns up to 5, from 5 to 10, and above 10 degrees.
    pub(super) shares_percent: [f64; 3],
}

const TABLES: [Stated; 7] = [
    row("astar", [91.60, 857.26, 100.0], [98.39, 1.15, 0.46]),
    row(
        "improved-astar",
        [93.57, 591.73, 100.0],
        [96.77, 2.30, 0.93],
    ),
    row("ga", [101.24, 100.61, 100.0], [0.0, 33.33, 66.67]),
    row("aga", [93.36, 123.67, 100.0], [0.0, 0.0, 100.0]),
    row("aco", [89.20, 350.66, 100.0], [33.33, 0.0, 66.67]),
    row("acof", [94.97, 153.71, 0.0], [100.0, 0.0, 0.0]),
    row("faco2024", [92.98, 63.74, 100.0], [99.4, 0.6, 0.0]),
];

const fn row(method: &'static str, one: [f64; 3], shares_percent: [f64; 3]) -> Stated {
    let [length_m, time_s, success_percent] = one;
    Stated {
        method,
        length_m,
        time_s,
        success_percent,
        shares_percent,
    }
}

/// The paper's numbers for a method, by our name of it.
pub(super) fn stated(method: &str) -> Option<&'static Stated> {
    TABLES.iter().find(|row| row.method == method)
}

/// The gain in time over GA that the text states, and what it is on either base.
pub(super) fn remark() -> String {
    let time_s = |method| stated(method).map_or(f64::NAN, |row| row.time_s);
    let (ga, faco) = (time_s("ga"), time_s("faco2024"));
    format!(
        "The paper's text gives the gain in time over GA as 57.84 %. That is ({ga} - {faco}) / \
         {faco} = {:.2} %, a share of FACO's own time; as a share of GA's, the base of its other \
         claims, it is {:.2} %.",
        100.0 * (ga - faco) / faco,
        100.0 * (ga - faco) / ga
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_and_the_remark_is_as_computed() {
        for row in TABLES {
            let sum: f64 = row.shares_percent.iter().sum();
            assert!((sum - 100.0).abs() < 0.011, "{}: {sum}", row.method);
        }
        let remark = remark();
        assert!(
            remark.contains("= 57.84 %") && remark.contains("it is 36.65 %"),
            "{remark}"
        );
    }
}
