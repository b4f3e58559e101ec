//! The paper's two tables beside ours.

use super::drive::Drive;
use super::group::{COMPARISON, Drives, drives_of};
use super::methods::{Method, Native, PROPOSED, YARDSTICK};
use super::paper::stated;
use crate::papers::group::{GroupColumn, ratio, table_of};
use crate::report::{Field, Table};

/// All runs of a comparison on one ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Comparison<'a> {
    pub(super) drives: &'a [Drive],
    pub(super) methods: &'a [Method],
    pub(super) ground: &'a str,
}

impl<'a> Comparison<'a> {
    fn group(&self, method: &str) -> Drives<'a> {
        drives_of(self.drives, COMPARISON, method).on(self.ground)
    }

    fn groups(&self) -> impl Iterator<Item = (&'static str, Drives<'a>)> {
        let names = self.methods.iter().map(|method| method.planner.name());
        names.map(|name| (name, self.group(name)))
    }

    /// Table 1, length and success.
    pub(super) fn lengths(&self) -> Table {
        let caption = "Table 1 of the paper, length and success, beside ours: medians with \
                       quartiles over the runs. `path` is the length before corners are rounded, \
                       which the paper compares, `driven` that of certified curves. The map is our \
                       own: lengths compare as ratios.";
        let path = |drive: &Drive| drive.native_length_m;
        let proposed = self.group(PROPOSED).median(path);
        let stated_m = |name: &str| stated(name).map(|row| row.length_m);
        let columns: [GroupColumn<Drive>; 8] = [
            ("certified", &|g, _| g.certified()),
            ("paper's success %", &|_, name| {
                Field::Number(stated(name).map(|row| row.success_percent), 0)
            }),
            ("path m", &|g, _| g.spread(path, 2)),
            ("driven m", &|g, _| {
                g.spread(|drive| drive.certified_length_m, 2)
            }),
            ("path / faco2024", &|g, _| {
                Field::Number(ratio(g.median(path), proposed), 3)
            }),
            ("paper m", &|_, name| Field::Number(stated_m(name), 2)),
            ("paper's m / FACO", &|_, name| {
                Field::Number(ratio(stated_m(name), stated_m(PROPOSED)), 3)
            }),
            ("path / paper", &|g, name| {
                Field::Number(ratio(g.median(path), stated_m(name)), 3)
            }),
        ];
        table_of("length", "method", &columns, self.groups()).captioned(caption)
    }

    /// Table 1, time: all methods in one run.
    pub(super) fn times(&self) -> Table {
        let caption = "Table 1 of the paper, time, beside ours: map set-up and query on one \
                       thread, medians with quartiles. `first path` is the time to the first \
                       certified path.";
        let time = |drive: &Drive| Some(drive.total_ms);
        let [yardstick, proposed] = [YARDSTICK, PROPOSED].map(|name| self.group(name).median(time));
        let paper_s = |name: &str| stated(name).map(|row| row.time_s);
        let over = |value: Option<f64>, to: Option<f64>, n| Field::Number(ratio(value, to), n);
        let columns: [GroupColumn<Drive>; 8] = [
            ("time ms", &|g, _| g.spread(time, 1)),
            ("first path ms", &|g, _| {
                g.spread(|drive| drive.first_feasible_ms, 1)
            }),
            ("time / astar", &|g, _| over(g.median(time), yardstick, 2)),
            ("time / faco2024", &|g, _| over(g.median(time), proposed, 2)),
            ("paper s", &|_, name| Field::Number(paper_s(name), 2)),
            ("paper's s / A*", &|_, name| {
                over(paper_s(name), paper_s(YARDSTICK), 3)
            }),
            ("paper's s / FACO", &|_, name| {
                over(paper_s(name), paper_s(PROPOSED), 2)
            }),
            ("paper's time / ours", &|g, name| {
                over(paper_s(name).map(|s| 1e3 * s), g.median(time), 0)
            }),
        ];
        table_of("time", "method", &columns, self.groups()).captioned(caption)
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
        let heading = [
            "method",
            "0-5 deg, 0.2 m",
            "5-10 deg, 0.2 m",
            ">10 deg, 0.2 m",
            "0-5 deg, 1 m",
            "5-10 deg, 1 m",
            ">10 deg, 1 m",
        ];
        let mut table = Table::new("curve", &heading).captioned(caption);
        for (name, group) in self.groups() {
            let mut row = vec![Field::words(name)];
            row.extend(percent(&group, FINE));
            row.extend(percent(&group, COARSE));
            table.row(row);
        }
        table
    }

    /// The smoothness of the certified curves.
    pub(super) fn smoothness(&self) -> Table {
        let caption = "The certified curves, medians with quartiles: joints where the curvature \
                       jumps, changes of gear, the largest turn over a step of 1 m, the least \
                       clearance of the body; and the cost J of the path before corners are \
                       rounded (equation 15, lower is better).";
        let columns: [GroupColumn<Drive>; 5] = [
            ("curvature jumps", &|g, _| {
                g.spread(|d| Some(d.n_curvature_jumps? as f64), 0)
            }),
            ("cusps", &|g, _| {
                g.spread(|drive| Some(drive.n_cusps? as f64), 0)
            }),
            ("largest step deg", &|g, _| {
                g.spread(|drive| drive.largest_step_deg, 1)
            }),
            ("clearance m", &|g, _| {
                g.spread(|drive| drive.min_clearance_m, 3)
            }),
            ("J", &|g, _| g.spread(|drive| drive.cost, 4)),
        ];
        table_of("smoothness", "method", &columns, self.groups()).captioned(caption)
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

fn percent(group: &Drives, shares: Shares) -> [Field; 3] {
    shares.map(|share| Field::Number(group.mean(share).map(|share| 100.0 * share), 2))
}

/// All scenarios of a data set together.
pub(super) fn over_scenarios(drives: &[Drive], methods: &[Method], part: &str) -> Table {
    let caption = "All scenarios together: `path` and `driven` over the length of the shortest \
                   way over cells, the share of turns up to 10 degrees over 1 m, and times of map \
                   set-up and query; medians with quartiles.";
    let time = |drive: &Drive| Some(drive.total_ms);
    let yardstick = drives_of(drives, part, YARDSTICK).median(time);
    let names = methods.iter().map(|method| method.planner.name());
    let groups = names.map(|name| (name, drives_of(drives, part, name)));
    let columns: [GroupColumn<Drive>; 7] = [
        ("certified", &|g, _| g.certified()),
        ("path / shortest", &|g, _| {
            g.spread(|d| ratio(d.native_length_m, d.shortest_m), 3)
        }),
        ("driven / shortest", &|g, _| {
            g.spread(|d| ratio(d.certified_length_m, d.shortest_m), 3)
        }),
        ("to 10 deg, 1 m, %", &|g, _| {
            g.spread(|drive| Some(100.0 * (1.0 - drive.coarse_over_10_deg?)), 1)
        }),
        ("curvature jumps", &|g, _| {
            g.spread(|d| Some(d.n_curvature_jumps? as f64), 0)
        }),
        ("time ms", &|g, _| g.spread(time, 1)),
        ("time / astar", &|g, _| {
            Field::Number(ratio(g.median(time), yardstick), 2)
        }),
    ];
    table_of(part, "method", &columns, groups).captioned(caption)
}
