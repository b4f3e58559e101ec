//! The paper's two tables beside ours.

use super::drive::Drive;
use super::group::{Group, ratio};
use super::methods::{Method, Native, PROPOSED, YARDSTICK};
use super::paper::stated;
use crate::report::{Field, Table};

/// The part of the experiment in which methods are compared.
pub(super) const COMPARISON: &str = "comparison";

/// All runs of a comparison on one ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Comparison<'a> {
    pub(super) drives: &'a [Drive],
    pub(super) methods: &'a [Method],
    pub(super) ground: &'a str,
}

impl<'a> Comparison<'a> {
    fn group(&self, method: &str) -> Group<'a> {
        Group::new(self.drives, COMPARISON, method).on(self.ground)
    }

    fn names(&self) -> impl Iterator<Item = &'static str> {
        self.methods.iter().map(|method| method.planner.name())
    }

    /// Table 1, length and success.
    pub(super) fn lengths(&self) -> Table {
        let caption = "Table 1 of the paper, length and success, beside ours: medians with \
                       quartiles over the runs. `path` is the length before corners are rounded, \
                       which the paper compares, `driven` that of certified curves. The map is our \
                       own: lengths compare as ratios.";
        let mut table = Table::new(
            "length",
            &[
                "method",
                "certified",
                "paper's success %",
                "path m",
                "driven m",
                "path / faco2024",
                "paper m",
                "paper's m / FACO",
                "path / paper",
            ],
        )
        .captioned(caption);
        let path = |drive: &Drive| drive.native_length_m;
        let proposed = self.group(PROPOSED).median(path);
        let papers = stated(PROPOSED).map(|row| row.length_m);
        for name in self.names() {
            let (group, paper) = (self.group(name), stated(name));
            let (ours, theirs) = (group.median(path), paper.map(|row| row.length_m));
            table.row(vec![
                Field::words(name),
                group.certified(),
                Field::Number(paper.map(|row| row.success_percent), 0),
                group.spread(path, 2),
                group.spread(|drive| drive.certified_length_m, 2),
                Field::Number(ratio(ours, proposed), 3),
                Field::Number(theirs, 2),
                Field::Number(ratio(theirs, papers), 3),
                Field::Number(ratio(ours, theirs), 3),
            ]);
        }
        table
    }

    /// Table 1, time: all methods in one run.
    pub(super) fn times(&self) -> Table {
        let caption = "Table 1 of the paper, time, beside ours: map set-up and query on one \
                       thread, medians with quartiles. `first path` is the time to the first \
                       certified path.";
        let mut table = Table::new(
            "time",
            &[
                "method",
                "time ms",
                "first path ms",
                "time / astar",
                "time / faco2024",
                "paper s",
                "paper's s / A*",
                "paper's s / FACO",
                "paper's time / ours",
            ],
        )
        .captioned(caption);
        let time = |drive: &Drive| Some(drive.total_ms);
        let [yardstick, proposed] = [YARDSTICK, PROPOSED].map(|name| self.group(name).median(time));
        let paper = |name: &str| stated(name).map(|row| row.time_s);
        for name in self.names() {
            let group = self.group(name);
            let (ours, theirs) = (group.median(time), paper(name));
            table.row(vec![
                Field::words(name),
                group.spread(time, 1),
                group.spread(|drive| drive.first_feasible_ms, 1),
                Field::Number(ratio(ours, yardstick), 2),
                Field::Number(ratio(ours, proposed), 2),
                Field::Number(theirs, 2),
                Field::Number(ratio(theirs, paper(YARDSTICK)), 3),
                Field::Number(ratio(theirs, paper(PROPOSED)), 2),
                Field::Number(ratio(theirs.map(|s| 1e3 * s), ours), 0),
            ]);
        }
        table
    }

    /// Table 2 on the vertices that a method finds.
    pub(super) fn native_shares(&self) -> Table {
        let caption = "Table 2 of the paper beside ours: shares of turns between consecutive \
                       vertices of the path before corners are rounded, in percent, means over the \
                       runs. The paper does not say which points it measures; the vertices here \
                       are cells (A*), nodes, or joints of the curve.";
        let mut table = Table::new(
            "native",
            &[
                "method",
                "vertices",
                "number",
                "0-5 deg",
                "5-10 deg",
                ">10 deg",
                "paper's 0-5",
                "paper's 5-10",
                "paper's >10",
            ],
        )
        .captioned(caption);
        for method in self.methods {
            let name = method.planner.name();
            let group = self.group(name);
            let paper = stated(name).map(|row| row.shares_percent);
            let mut row = vec![
                Field::words(name),
                Field::words(method.native.name()),
                Field::Number(
                    group.median(|drive| Some(drive.n_native_vertices? as f64)),
                    0,
                ),
            ];
            row.extend(percent(&group, NATIVE));
            row.extend((0..3).map(|i| Field::Number(paper.map(|shares| shares[i]), 2)));
            table.row(row);
            let n_pruned = group.median(|drive| Some(drive.n_pruned_vertices? as f64));
            if method.native == Native::Cells && n_pruned.is_some() {
                let mut row = vec![
                    Field::Words(format!("{name}, pruned")),
                    Field::words(Native::Nodes.name()),
                    Field::Number(n_pruned, 0),
                ];
                row.extend(percent(&group, PRUNED));
                row.extend((0..3).map(|_| Field::Number(None, 2)));
                table.row(row);
            }
        }
        table
    }

    /// Table 2 on certified curves, at both spacings.
    pub(super) fn curve_shares(&self) -> Table {
        let caption = "Table 2 on the certified curves: shares of turns over equal steps of one \
                       cell and of 1 m, in percent, means over the runs. Over 0.2 m any curve of \
                       2.29 m radius or more stays below 5 degrees by itself.";
        let mut table = Table::new(
            "curve",
            &[
                "method",
                "0-5 deg, 0.2 m",
                "5-10 deg, 0.2 m",
                ">10 deg, 0.2 m",
                "0-5 deg, 1 m",
                "5-10 deg, 1 m",
                ">10 deg, 1 m",
            ],
        )
        .captioned(caption);
        for name in self.names() {
            let group = self.group(name);
            let mut row = vec![Field::words(name)];
            row.extend(percent(&group, FINE));
            row.extend(percent(&group, COARSE));
            table.row(row);
        }
        table
    }

    /// What the certified curves are like.
    pub(super) fn smoothness(&self) -> Table {
        let caption = "The certified curves, medians with quartiles: joints where the curvature \
                       jumps, changes of gear, the largest turn over a step of 1 m, the least \
                       clearance of the body; and the cost J of the path before corners are \
                       rounded (equation 15, lower is better).";
        let mut table = Table::new(
            "smoothness",
            &[
                "method",
                "curvature jumps",
                "cusps",
                "largest step deg",
                "clearance m",
                "J",
            ],
        )
        .captioned(caption);
        for name in self.names() {
            let group = self.group(name);
            table.row(vec![
                Field::words(name),
                group.spread(|drive| Some(drive.n_curvature_jumps? as f64), 0),
                group.spread(|drive| Some(drive.n_cusps? as f64), 0),
                group.spread(|drive| drive.largest_step_deg, 1),
                group.spread(|drive| drive.min_clearance_m, 3),
                group.spread(|drive| drive.cost, 4),
            ]);
        }
        table
    }
}

/// Three shares of a run.
type Shares = [fn(&Drive) -> Option<f64>; 3];
const NATIVE: Shares = [
    |d| d.native_to_5_deg,
    |d| d.native_from_5_to_10_deg,
    |d| d.native_over_10_deg,
];
const PRUNED: Shares = [
    |d| d.pruned_to_5_deg,
    |d| d.pruned_from_5_to_10_deg,
    |d| d.pruned_over_10_deg,
];
const FINE: Shares = [
    |d| d.fine_to_5_deg,
    |d| d.fine_from_5_to_10_deg,
    |d| d.fine_over_10_deg,
];
const COARSE: Shares = [
    |d| d.coarse_to_5_deg,
    |d| d.coarse_from_5_to_10_deg,
    |d| d.coarse_over_10_deg,
];

fn percent(group: &Group, shares: Shares) -> [Field; 3] {
    shares.map(|share| Field::Number(group.mean(share).map(|share| 100.0 * share), 2))
}

/// All scenarios of a data set together.
pub(super) fn over_scenarios(drives: &[Drive], methods: &[Method], part: &str) -> Table {
    let caption = "All scenarios together: `path` and `driven` over the length of the shortest \
                   way over cells, the share of turns up to 10 degrees over 1 m, and times of map \
                   set-up and query; medians with quartiles.";
    let mut table = Table::new(
        part,
        &[
            "method",
            "certified",
            "path / shortest",
            "driven / shortest",
            "to 10 deg, 1 m, %",
            "curvature jumps",
            "time ms",
            "time / astar",
        ],
    )
    .captioned(caption);
    let time = |drive: &Drive| Some(drive.total_ms);
    let yardstick = Group::new(drives, part, YARDSTICK).median(time);
    for name in methods.iter().map(|method| method.planner.name()) {
        let group = Group::new(drives, part, name);
        table.row(vec![
            Field::words(name),
            group.certified(),
            group.spread(|drive| ratio(drive.native_length_m, drive.shortest_m), 3),
            group.spread(|drive| ratio(drive.certified_length_m, drive.shortest_m), 3),
            group.spread(|drive| Some(100.0 * (1.0 - drive.coarse_over_10_deg?)), 1),
            group.spread(|drive| Some(drive.n_curvature_jumps? as f64), 0),
            group.spread(time, 1),
            Field::Number(ratio(group.median(time), yardstick), 2),
        ]);
    }
    table
}
