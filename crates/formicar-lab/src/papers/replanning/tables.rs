//! What the drives come to.

use super::drive::Step;
use crate::analysis::statistics::{quantile, quartiles};
use crate::report::{Field, Report, Section, Table};

/// The tables: all maps together, and each map.
pub(super) fn report(steps: &[Step]) -> Report {
    let mut maps: Vec<&str> = Vec::new();
    for step in steps {
        if !maps.contains(&step.map.as_str()) {
            maps.push(&step.map);
        }
    }
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
    let heading = [
        "method", "found", "flips", "needless", "kept", "cost", "dearer", "update", "first",
        "query", "anew",
    ];
    let mut table = Table::new(key, &heading);
    let mut methods: Vec<&str> = Vec::new();
    for step in steps {
        if !methods.contains(&step.method.as_str()) {
            methods.push(&step.method);
        }
    }
    for method in methods {
        let own = steps.iter().filter(|s| belongs(s) && s.method == method);
        table.row(row(method, &own.collect::<Vec<_>>()));
    }
    table
}

fn row(method: &str, steps: &[&Step]) -> Vec<Field> {
    let count = |is: &dyn Fn(&Step) -> bool| steps.iter().filter(|step| is(step)).count();
    let values = |of: &dyn Fn(&Step) -> Option<f64>| -> Vec<f64> {
        steps.iter().filter_map(|step| of(step)).collect()
    };
    let spread = |of: &dyn Fn(&Step) -> Option<f64>| Field::Spread(quartiles(&values(of)), 1);
    let n_found = count(&|step| step.found);
    let n_free = count(&|step| step.found && step.still_free);
    let n_flips = count(&|step| step.flip == Some(true));
    let n_needless = count(&|step| step.flip == Some(true) && step.still_free);
    let kept = values(&|step| step.kept_share);
    let costs = values(&|step| Some(step.cost_m? / step.anew_cost_m?));
    vec![
        Field::words(method),
        Field::Count(n_found, steps.len()),
        Field::Rate(n_flips, n_found),
        Field::Rate(n_needless, n_free),
        Field::Number(mean(&kept), 3),
        Field::Number(mean(&costs), 4),
        Field::Number(quantile(&costs, 1.0), 3),
        spread(&|step| Some(step.update_ms)),
        spread(&|step| step.first_ms),
        spread(&|step| Some(step.query_ms)),
        spread(&|step| Some(step.anew_query_ms)),
    ]
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}
