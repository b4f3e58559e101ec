//! Tables of the drives.

use super::drive::Step;
use crate::analysis::statistics::distinct;
use crate::analysis::statistics::quantile;
use crate::papers::group::{Group, GroupColumn, table_of};
use crate::report::{Field, Report, Section, Table};

/// The tables: all maps together, and each map.
pub(super) fn report(steps: &[Step]) -> Report {
    let maps = distinct(steps.iter().map(|step| step.map.as_str()));
    let all = Section::of_table("All maps", table("all", steps, |_| true));
    let each = maps.iter().map(|&map| {
        let table = table(map, steps, |step| step.map == map);
        Section::of_table(map, table)
    });
    Report {
        name: "replanning".to_owned(),
        title: "Replanning against planning anew".to_owned(),
        intro:
            "A vehicle drives a tenth of its first path, the block that appeared last vanishes, \
                another one appears on the way ahead or beside it, and there is a new path. \
                `flips` are new paths that pass an obstacle on another side than the path before; \
                `needless` those of them where the path before was still free. `kept` is the share \
                of the new path that lies on the one before, `cost` what it costs relative to the \
                path planned anew from the same place (mean), and `dearer` the worst. Times in \
                milliseconds, medians and quartiles; `first` is the time to the first certified \
                path, `anew` that of planning anew in the same place."
                .to_owned(),
        sections: [all].into_iter().chain(each).collect(),
    }
}

fn table(key: &str, steps: &[Step], belongs: impl Fn(&Step) -> bool) -> Table {
    let methods = distinct(steps.iter().map(|step| step.method.as_str()));
    let groups = methods.into_iter().map(|method| {
        let is_own = |step: &Step| belongs(step) && step.method == method;
        (method, Group::of(steps, is_own))
    });
    let found = |g: &Group<Step>| g.count(|step| step.found);
    let free = |g: &Group<Step>| g.count(|step| step.found && step.still_free);
    let flips = |g: &Group<Step>| g.count(|step| step.flip == Some(true));
    let needless = |g: &Group<Step>| g.count(|s| s.flip == Some(true) && s.still_free);
    let cost = |step: &Step| Some(step.cost_m? / step.anew_cost_m?);
    let columns: [GroupColumn<Step>; 10] = [
        ("found", &|g, _| Field::Count(found(g), g.len())),
        ("flips", &|g, _| Field::Rate(flips(g), found(g))),
        ("needless", &|g, _| Field::Rate(needless(g), free(g))),
        ("kept", &|g, _| {
            Field::Number(g.mean(|step| step.kept_share), 3)
        }),
        ("cost", &|g, _| Field::Number(g.mean(cost), 4)),
        ("dearer", &|g, _| {
            Field::Number(quantile(&g.values(cost), 1.0), 3)
        }),
        ("update", &|g, _| g.spread(|step| Some(step.update_ms), 1)),
        ("first", &|g, _| g.spread(|step| step.first_ms, 1)),
        ("query", &|g, _| g.spread(|step| Some(step.query_ms), 1)),
        ("anew", &|g, _| g.spread(|step| Some(step.anew_query_ms), 1)),
    ];
    table_of(key, "method", &columns, groups)
}
