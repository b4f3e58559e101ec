//! Parameter sheets from the tables of the library's `references`.

use crate::papers::experiment::Variant;
use crate::report::{Column, Field, Section, Source, Table, leaves};
use anyhow::Result;

const LEI2020: &str = include_str!("../../../formicar/references/lei2020.md");
const WANG2019: &str = include_str!("../../../formicar/references/wang2019.md");
const LI2024: &str = include_str!("../../../formicar/references/li2024.md");

/// A parameter, its origin, and the place in the paper or the reason.
type Known = (&'static str, Source, &'static str);

/// The configuration of a variant, each parameter with its origin as the reference of its paper
/// states it.
pub(crate) fn section(variant: &Variant) -> Result<Section> {
    let config = serde_json::to_value(&variant.config)?;
    let origins = Origins::of(variant.config.planner().name());
    let columns: [Column<(String, String)>; 4] = [
        ("parameter", &|(key, _)| Field::Words(format!("`{key}`"))),
        ("value", &|(_, value)| Field::words(value)),
        ("source", &|(key, _)| {
            Field::words(origins.of_key(key).0.name())
        }),
        ("where, or why", &|(key, _)| {
            Field::Words(origins.of_key(key).1)
        }),
    ];
    let leaves = leaves(&config).into_iter();
    let leaves = leaves.filter(|(key, _)| origins.has_section_of(key));
    let table = Table::of("parameters", leaves, &columns).captioned(
        "Every parameter of the configuration: stated by the paper, read from what the paper \
         leaves open, chosen here, or tuned.",
    );
    Ok(Section::of_table("Parameters", table))
}

/// The origins of the parameters of a planner's preset, from the references: its own table, then
/// those of the presets that it is derived from.
pub(crate) struct Origins {
    tables: Vec<(String, Vec<Known>)>,
}

impl Origins {
    /// The origins for a planner; one without a reference has no tables.
    pub(crate) fn of(planner: &str) -> Self {
        let (mut tables, mut next) = (Vec::new(), Some(planner));
        while let Some(name) = next {
            let Some((base, rows)) = table_of(name) else {
                break;
            };
            tables.push((name.to_owned(), rows));
            next = base;
        }
        Self { tables }
    }

    /// True if the table of the planner's own reference holds parameters of the section of a key.
    fn has_section_of(&self, key: &str) -> bool {
        let section = |key: &'_ str| key.split('.').next().map(str::to_owned);
        let own = self.tables.first().map_or(&[][..], |(_, rows)| rows);
        own.iter().any(|row| section(row.0) == section(key))
    }

    /// The origin of a parameter as the preset has it, and the place in the paper or the reason.
    /// A value taken from another preset counts as our choice.
    pub(crate) fn of_key(&self, key: &str) -> (Source, String) {
        let mut rows = self
            .tables
            .iter()
            .enumerate()
            .flat_map(|(i, (name, rows))| rows.iter().map(move |row| (i, name, row)));
        match rows.find(|(.., row)| row.0 == key) {
            Some((0, _, (_, source, from))) => (*source, (*from).to_owned()),
            Some((_, name, (_, source, from))) => {
                let words = format!("as `{name}` ({}: {from})", source.name());
                (Source::Chosen, words)
            }
            None => (Source::Chosen, String::new()),
        }
    }
}

/// The table of a preset, and the preset of which it tells the differences.
fn table_of(preset: &str) -> Option<(Option<&'static str>, Vec<Known>)> {
    let (whole, part) = (
        format!("## Parameters of `{preset}`"),
        format!("### `{preset}`, from `"),
    );
    let pages = [LEI2020, WANG2019, LI2024].into_iter();
    let mut headings =
        pages.flat_map(|page| page.match_indices("\n##").map(|(at, _)| &page[at + 1..]));
    headings.find_map(|rest| {
        let heading = rest.lines().next()?;
        let base = heading
            .strip_prefix(&part)
            .map(|base| base.trim_matches('`'));
        let is_it = base.is_some() || heading == whole;
        is_it.then(|| (base, known(rest)))
    })
}

/// The rows of the first table of parameters: `| key | value | origin | from |`.
fn known(reference: &'static str) -> Vec<Known> {
    let lines = reference.lines();
    let rows = lines.skip_while(|line| row(line).is_none());
    rows.map_while(row).collect()
}

fn row(line: &'static str) -> Option<Known> {
    let fields: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
    let [key, _, origin, from] = fields[..] else {
        return None;
    };
    let source = match origin {
        "stated" => Source::Stated,
        "read" => Source::Read,
        "chosen" => Source::Chosen,
        "tuned" => Source::Tuned,
        _ => return None,
    };
    Some((key.trim_matches('`'), source, from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::PlannerName;

    #[test]
    fn what_a_preset_takes_over_is_chosen() {
        let of = |planner: &str, key: &str| Origins::of(planner).of_key(key);
        let (source, from) = of("lei2020", "colony.n_ants");
        assert_eq!((source, &from[..9]), (Source::Stated, "sec. IV.B"));
        assert_eq!(
            of("acof", "colony.initial.rule"),
            (Source::Stated, "(21)".to_owned())
        );
        let (source, from) = of("acof", "colony.alpha");
        assert_eq!(source, Source::Chosen);
        assert_eq!(from, "as `lei2020` (stated: sec. IV.B)");
        let (source, from) = of("acof", "colony.n_iterations");
        assert_eq!(
            (source, from.as_str()),
            (Source::Chosen, "as `aco` (stated: sec. 5, N_max)")
        );
        assert_eq!(of("astar", "colony.alpha"), (Source::Chosen, String::new()));
    }

    #[test]
    fn every_parameter_of_a_colony_has_an_origin() {
        for planner in PlannerName::ALL
            .into_iter()
            .filter(|planner| planner.has_ants())
        {
            let config = serde_json::to_value(Variant::of(planner).config).unwrap();
            let origins = Origins::of(planner.name());
            for (key, _) in leaves(&config)
                .into_iter()
                .filter(|(key, _)| key != "planner")
            {
                let (_, from) = origins.of_key(&key);
                assert!(!from.is_empty(), "{planner:?}: {key}");
            }
        }
    }

    #[test]
    fn references_hold_tables_of_parameters() {
        for (reference, n_least) in [(LEI2020, 40), (WANG2019, 35), (LI2024, 40)] {
            assert!(known(reference).len() >= n_least);
        }
    }
}
