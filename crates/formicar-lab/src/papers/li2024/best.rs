//! The proposed method beside the best of the others, in one table.

use super::drive::Drive;
use super::group::{COMPARISON, drives_of};
use super::methods::{Method, PROPOSED};
use crate::papers::group::ratio;
use crate::report::{Field, Table};

/// The measures, each with the better direction and its decimals.
const MEASURES: [(&str, Measure, Better, usize); 5] = [
    (
        "share of turns up to 10 deg over 1 m, %",
        |drive| Some(100.0 * (1.0 - drive.coarse_over_10_deg?)),
        Better::More,
        2,
    ),
    (
        "curvature jumps",
        |drive| Some(drive.n_curvature_jumps? as f64),
        Better::Less,
        1,
    ),
    (
        "largest step over 1 m, deg",
        |drive| drive.largest_step_deg,
        Better::Less,
        2,
    ),
    (
        "driven m",
        |drive| drive.certified_length_m,
        Better::Less,
        2,
    ),
    ("time ms", |drive| Some(drive.total_ms), Better::Less, 1),
];

type Measure = fn(&Drive) -> Option<f64>;

#[derive(Clone, Copy, Debug)]
enum Better {
    More,
    Less,
}

/// The proposed method beside the best of the others in each measure.
pub(super) fn table(drives: &[Drive], methods: &[Method], ground: &str) -> Table {
    let caption = format!(
        "`{PROPOSED}` beside the best of the other methods, by the mean over the runs that have a \
         value: shares, jumps, steps and lengths are those of certified curves."
    );
    let mut table = Table::new(
        "claims",
        &["measure", PROPOSED, "best of others", "whose", "ratio"],
    )
    .captioned(&caption);
    let mean = |name: &str, of: Measure| {
        let group = drives_of(drives, COMPARISON, name).on(ground);
        group.mean(of)
    };
    for (claim, of, better, n_decimals) in MEASURES {
        let own = mean(PROPOSED, of);
        let others = methods
            .iter()
            .map(|method| method.planner.name())
            .filter(|&name| name != PROPOSED)
            .filter_map(|name| Some((name, mean(name, of)?)));
        let best = others.reduce(|best, other| {
            let is_better = match better {
                Better::More => other.1 > best.1,
                Better::Less => other.1 < best.1,
            };
            if is_better { other } else { best }
        });
        let (whose, value) = best.unzip();
        table.row(vec![
            Field::words(claim),
            Field::Number(own, n_decimals),
            Field::Number(value, n_decimals),
            Field::words(whose.unwrap_or("-")),
            Field::Number(ratio(own, value), 3),
        ]);
    }
    table
}
