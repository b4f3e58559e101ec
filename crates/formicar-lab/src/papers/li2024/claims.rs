//! The claims of the paper about its method.

use super::drive::Drive;
use super::group::{
    ABLATION, COMPARISON, COST, Drives, LARGE_TURNS, LENGTH, STEP, TIME, drives_of,
};
use super::methods::PROPOSED;
use crate::papers::claims::{Claims, Comparison, Counted, Expected, claims};
use crate::papers::group::Quantity;

/// The method with integer orders, and without the seed of A*.
const INTEGER: &str = "faco2024, integer order";
const UNSEEDED: &str = "faco2024, no A* seed";
/// Share of turns up to 5 degrees that the paper's conclusion names.
const SMALL_TURNS: f64 = 0.99;

/// The runs that claims are tested on.
struct Evidence<'a> {
    drives: &'a [Drive],
    ground: &'a str,
    /// Methods that were run.
    methods: &'a [&'a str],
}

/// The claims about the proposed method, over the methods that were run.
pub(super) fn claims(drives: &[Drive], methods: &[&str], ground: &str) -> Claims {
    let evidence = Evidence {
        drives,
        ground,
        methods,
    };
    let less = |others: &[&str], quantity| evidence.against(others, quantity, Expected::Less);
    let without = |variant: &str, quantities: [&Quantity<Drive>; 2]| {
        quantities
            .map(|quantity| evidence.against_variant(variant, quantity))
            .to_vec()
    };
    let others = ["astar", "improved-astar", "ga", "aga", "aco"];
    claims! {
        "Takes less time than A*, GA and ACO" | "Table 1, sec. 5.2"
            | "63.74 : 857.26, 100.61 and 350.66 s: 92.56, 57.84 and 81.82 % less"
            => less(&["astar", "ga", "aco"], &TIME);
        "Takes less time than improved A*, AGA and ACOF" | "Table 1"
            | "63.74 : 591.73, 123.67 and 153.71 s"
            => less(&["improved-astar", "aga", "acof"], &TIME);
        "Its path is shorter than those of improved A*, AGA and ACOF" | "Table 1, sec. 5.2"
            | "92.98 : 93.57, 93.36 and 94.97 m: 0.63, 0.40 and 2.10 % less"
            => less(&["improved-astar", "aga", "acof"], &LENGTH);
        "GA's path is longer" | "Table 1" | "92.98 : 101.24 m" => less(&["ga"], &LENGTH);
        "A* and ACO, which heed no constraints, find shorter paths" | "Table 1, sec. 5.2"
            | "92.98 : 91.60 and 89.20 m"
            => evidence.against(&["astar", "aco"], &LENGTH, Expected::More);
        "It always succeeds" | "Table 1" | "100 %"
            => evidence.counted(&[PROPOSED], "certified", |drive| drive.certified);
        "So do all others but ACOF" | "Table 1" | "100 %"
            => evidence.counted(&others, "certified", |drive| drive.certified);
        "ACOF, smoothed afterwards, never succeeds" | "Table 1, sec. 5.2" | "0 %"
            => evidence.counted(&["acof"], "not certified", |drive| !drive.certified);
        "More than 99 % of its turns are up to 5 degrees" | "Table 2, sec. 5.2" | "99.4 %"
            => evidence.counted(&[PROPOSED], "more than 99 %", is_smooth);
        "It has fewer turns above 10 degrees than all others but ACOF" | "Table 2"
            | "0 : 0.46, 0.93, 66.67, 100 and 66.67 %" => less(&others, &LARGE_TURNS);
        "Its steps keep the steering limit while it searches" | "sec. 4, eq. 18"
            | "-" => evidence.counted(&[PROPOSED], "within the limit", is_within_limit);
        "It reaches the lowest cost J of the methods that search by generations"
            | "sec. 5.2, fig. 12" | "-" => less(&["ga", "aga", "aco", "acof"], &COST);
        "The fractional order leads to smoother paths than an integer order" | "sec. 4, 5.2, 6"
            | "-" => without(INTEGER, [&STEP, &COST]);
        "Pheromone on the path of A* helps the search" | "sec. 4, 5.2"
            | "-" => without(UNSEEDED, [&COST, &TIME]);
    }
}

fn is_smooth(drive: &Drive) -> bool {
    drive
        .native_to_5_deg
        .is_some_and(|share| share > SMALL_TURNS)
}

fn is_within_limit(drive: &Drive) -> bool {
    let ratio = drive.largest_steering_ratio;
    ratio.is_some_and(|ratio| ratio <= 1.0 + 1e-9)
}

impl Evidence<'_> {
    fn group(&self, method: &str) -> Drives<'_> {
        drives_of(self.drives, COMPARISON, method).on(self.ground)
    }

    /// Those of some methods that were run.
    fn ran<'a>(&self, methods: &[&'a str]) -> impl Iterator<Item = &'a str> {
        let ran = methods.iter().filter(|name| self.methods.contains(name));
        ran.copied()
    }

    /// The proposed method against others that were run.
    fn against(
        &self,
        others: &[&str],
        quantity: &Quantity<Drive>,
        expected: Expected,
    ) -> Vec<Comparison> {
        let own = self.group(PROPOSED);
        let compare = |other: &str| {
            let name = format!("{PROPOSED} - {other}");
            own.compare(&self.group(other), quantity, name, expected)
        };
        self.ran(others).map(compare).collect()
    }

    /// The proposed method as it is against one of its variants.
    fn against_variant(&self, variant: &str, quantity: &Quantity<Drive>) -> Comparison {
        let [own, other] = [PROPOSED, variant].map(|name| drives_of(self.drives, ABLATION, name));
        let what = variant.strip_prefix(PROPOSED).unwrap_or(variant);
        let name = format!("{PROPOSED} - with {}", what.trim_start_matches(", "));
        own.compare(&other, quantity, name, Expected::Less)
    }

    /// Runs of methods that are as they should be.
    fn counted(&self, methods: &[&str], what: &str, is: impl Fn(&Drive) -> bool) -> Vec<Counted> {
        let count = |name: &str| self.group(name).counted(format!("{name}, {what}"), &is);
        self.ran(methods).map(count).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Verdict;

    #[test]
    fn claims_are_judged_over_the_methods_that_ran() {
        let drive = |method: &str, seed: u64, total_ms: f64| Drive {
            part: COMPARISON.to_owned(),
            method: method.to_owned(),
            ground: "g".to_owned(),
            seed,
            certified: true,
            total_ms,
            ..Drive::default()
        };
        let drives: Vec<Drive> = (0..31)
            .flat_map(|seed| {
                [
                    drive(PROPOSED, seed, 5.0),
                    drive("ga", seed, 9.0 + seed as f64),
                ]
            })
            .collect();
        let claims = claims(&drives, &[PROPOSED, "ga"], "g");
        let judged = claims.judged();
        assert_eq!(judged[0].verdict, Verdict::Holds);
        // No other method has runs.
        assert_eq!(judged[1].verdict, Verdict::Undecided);
        assert_eq!(judged[5].verdict, Verdict::Holds);
    }
}
