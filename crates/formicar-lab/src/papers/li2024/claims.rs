//! The claims of the paper about its method.

use super::ablation::ABLATION;
use super::drive::Drive;
use super::group::{Drives, drives_of};
use super::methods::PROPOSED;
use super::tables::COMPARISON;
use crate::papers::claims::{Claim, Claims, Comparison, Counted, Expected};
use crate::papers::group::Quantity;

/// The method with integer orders, and without the seed of A*.
const INTEGER: &str = "faco2024, integer order";
const UNSEEDED: &str = "faco2024, no A* seed";
/// Share of turns up to 5 degrees that the paper's conclusion names.
const SMALL_TURNS: f64 = 0.99;

pub(super) const TIME: Quantity<Drive> = Quantity {
    name: "map set-up and query, ms",
    n_decimals: 1,
    of: |drive| Some(drive.total_ms),
};
pub(super) const LENGTH: Quantity<Drive> = Quantity {
    name: "path before rounding, m",
    n_decimals: 2,
    of: |drive| drive.native_length_m,
};
pub(super) const DRIVEN: Quantity<Drive> = Quantity {
    name: "certified curve, m",
    n_decimals: 3,
    of: |drive| drive.certified_length_m,
};
pub(super) const COST: Quantity<Drive> = Quantity {
    name: "J",
    n_decimals: 4,
    of: |drive| drive.cost,
};
const LARGE_TURNS: Quantity<Drive> = Quantity {
    name: "turns above 10 degrees, %",
    n_decimals: 2,
    of: |drive| Some(100.0 * drive.native_over_10_deg?),
};
pub(super) const STEP: Quantity<Drive> = Quantity {
    name: "largest turn over 1 m, degrees",
    n_decimals: 2,
    of: |drive| drive.largest_step_deg,
};

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
    let claims = [
        evidence.of_time(),
        evidence.of_length(),
        evidence.of_success(),
        evidence.of_turns(),
        evidence.of_search(),
    ];
    Claims(claims.concat())
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

    fn of_time(&self) -> Vec<Claim> {
        let less = |others: &[&str]| self.against(others, &TIME, Expected::Less);
        vec![
            Claim::paired(
                "Takes less time than A*, GA and ACO",
                "Table 1, sec. 5.2",
                "63.74 : 857.26, 100.61 and 350.66 s: 92.56, 57.84 and 81.82 % less",
                less(&["astar", "ga", "aco"]),
            ),
            Claim::paired(
                "Takes less time than improved A*, AGA and ACOF",
                "Table 1",
                "63.74 : 591.73, 123.67 and 153.71 s",
                less(&["improved-astar", "aga", "acof"]),
            ),
        ]
    }

    fn of_length(&self) -> Vec<Claim> {
        vec![
            Claim::paired(
                "Its path is shorter than those of improved A*, AGA and ACOF",
                "Table 1, sec. 5.2",
                "92.98 : 93.57, 93.36 and 94.97 m: 0.63, 0.40 and 2.10 % less",
                self.against(&["improved-astar", "aga", "acof"], &LENGTH, Expected::Less),
            ),
            Claim::paired(
                "GA's path is longer",
                "Table 1",
                "92.98 : 101.24 m",
                self.against(&["ga"], &LENGTH, Expected::Less),
            ),
            Claim::paired(
                "A* and ACO, which heed no constraints, find shorter paths",
                "Table 1, sec. 5.2",
                "92.98 : 91.60 and 89.20 m",
                self.against(&["astar", "aco"], &LENGTH, Expected::More),
            ),
        ]
    }

    fn of_success(&self) -> Vec<Claim> {
        let certified = |drive: &Drive| drive.certified;
        vec![
            Claim::counted(
                "It always succeeds",
                "Table 1",
                "100 %",
                self.counted(&[PROPOSED], "certified", certified),
            ),
            Claim::counted(
                "So do all others but ACOF",
                "Table 1",
                "100 %",
                self.counted(
                    &["astar", "improved-astar", "ga", "aga", "aco"],
                    "certified",
                    certified,
                ),
            ),
            Claim::counted(
                "ACOF, smoothed afterwards, never succeeds",
                "Table 1, sec. 5.2",
                "0 %",
                self.counted(&["acof"], "not certified", |drive| !drive.certified),
            ),
        ]
    }

    fn of_turns(&self) -> Vec<Claim> {
        let is_smooth = |drive: &Drive| drive.native_to_5_deg.is_some_and(|s| s > SMALL_TURNS);
        let within = |drive: &Drive| {
            drive
                .largest_steering_ratio
                .is_some_and(|r| r <= 1.0 + 1e-9)
        };
        vec![
            Claim::counted(
                "More than 99 % of its turns are up to 5 degrees",
                "Table 2, sec. 5.2",
                "99.4 %",
                self.counted(&[PROPOSED], "more than 99 %", is_smooth),
            ),
            Claim::paired(
                "It has fewer turns above 10 degrees than all others but ACOF",
                "Table 2",
                "0 : 0.46, 0.93, 66.67, 100 and 66.67 %",
                self.against(
                    &["astar", "improved-astar", "ga", "aga", "aco"],
                    &LARGE_TURNS,
                    Expected::Less,
                ),
            ),
            Claim::counted(
                "Its steps keep the steering limit while it searches",
                "sec. 4, eq. 18",
                "-",
                self.counted(&[PROPOSED], "within the limit", within),
            ),
        ]
    }

    fn of_search(&self) -> Vec<Claim> {
        vec![
            Claim::paired(
                "It reaches the lowest cost J of the methods that search by generations",
                "sec. 5.2, fig. 12",
                "-",
                self.against(&["ga", "aga", "aco", "acof"], &COST, Expected::Less),
            ),
            Claim::paired(
                "The fractional order leads to smoother paths than an integer order",
                "sec. 4, 5.2, 6",
                "-",
                vec![
                    self.against_variant(INTEGER, &STEP),
                    self.against_variant(INTEGER, &COST),
                ],
            ),
            Claim::paired(
                "Pheromone on the path of A* helps the search",
                "sec. 4, 5.2",
                "-",
                vec![
                    self.against_variant(UNSEEDED, &COST),
                    self.against_variant(UNSEEDED, &TIME),
                ],
            ),
        ]
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
