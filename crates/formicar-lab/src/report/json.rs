//! Reports as JSON: everything that stands on the page, pictures as the values that they show.

use super::provenance::config_hash;
use super::{Block, Fact, Field, Page, Section, Table};
use serde_json::{Map, Value, json};

/// The page as a JSON document. A picture that comes as SVG, of paths on a map, has its caption
/// only.
pub fn json(page: &Page) -> String {
    let report = page.report;
    let document = json!({
        "name": report.name,
        "title": report.title,
        "intro": report.intro,
        "sections": report.sections.iter().map(section).collect::<Vec<_>>(),
        "provenance": facts(page.facts),
        "configs": facts(page.configs),
        "config_hashes": hashes(page.configs),
    });
    format!("{document:#}\n")
}

fn facts(facts: &[Fact]) -> Value {
    let value = |fact: &Fact| serde_json::from_str(&fact.value).unwrap_or(json!(fact.value));
    let pairs = facts.iter().map(|fact| (fact.name.clone(), value(fact)));
    Value::Object(pairs.collect::<Map<_, _>>())
}

fn hashes(configs: &[Fact]) -> Value {
    let pairs = configs.iter();
    let pairs = pairs.map(|config| (config.name.clone(), json!(config_hash(&config.value))));
    Value::Object(pairs.collect::<Map<_, _>>())
}

fn section(section: &Section) -> Value {
    json!({
        "heading": section.heading,
        "blocks": section.blocks.iter().map(block).collect::<Vec<_>>(),
    })
}

fn block(block: &Block) -> Value {
    match block {
        Block::Text(words) => json!({ "kind": "text", "text": words }),
        Block::Table(table) => of_table(table),
        Block::Figure(figure) => json!({ "kind": "figure", "caption": figure.caption }),
        Block::BoxPlot(plot) => json!({ "kind": "box_plot", "plot": plot }),
        Block::Paired(plot) => json!({ "kind": "paired", "plot": plot }),
        Block::Trends(plot) => json!({ "kind": "bands", "plot": plot }),
    }
}

fn of_table(table: &Table) -> Value {
    let rows = table.rows.iter();
    let rows = rows.map(|row| row.iter().map(field).collect::<Vec<_>>());
    json!({
        "kind": "table",
        "key": table.key,
        "caption": table.caption,
        "columns": table.heading,
        "rows": rows.collect::<Vec<_>>(),
    })
}

/// A field with all its digits.
fn field(field: &Field) -> Value {
    match field {
        Field::Words(words) => json!(words),
        Field::Verdict(verdict) => json!(verdict.name()),
        Field::Number(value, _) | Field::Probability(value) => json!(value),
        Field::Spread(None, _) => Value::Null,
        Field::Spread(Some([low, value, high]), _) => {
            json!({ "value": value, "low": low, "high": high })
        }
        Field::Count(n, of) | Field::Rate(n, of) => json!({ "n": n, "of": of }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{BoxGroup, BoxPlot, Report};

    #[test]
    fn tables_and_plots_keep_their_values() {
        let mut table = Table::new("t", &["who", "m"]);
        table.row(vec![Field::words("a"), Field::Number(Some(0.125), 1)]);
        table.row(vec![Field::words("b"), Field::Number(None, 1)]);
        let plot = BoxPlot {
            groups: vec![BoxGroup {
                name: "a".to_owned(),
                values: vec![0.125],
            }],
            ..BoxPlot::default()
        };
        let report = Report {
            sections: vec![Section {
                heading: "Part".to_owned(),
                blocks: vec![Block::Table(table), Block::BoxPlot(plot)],
            }],
            ..Report::default()
        };
        let text = json(&Page {
            report: &report,
            facts: &[Fact::new("Cores", "2")],
            configs: &[Fact::new("aco", "{\"n\": 1}")],
        });
        let value: Value = serde_json::from_str(&text).unwrap();
        let blocks = &value["sections"][0]["blocks"];
        assert_eq!(blocks[0]["rows"], json!([["a", 0.125], ["b", null]]));
        assert_eq!(blocks[1]["plot"]["groups"][0]["values"], json!([0.125]));
        assert_eq!(value["configs"]["aco"]["n"], json!(1));
        let hash = value["config_hashes"]["aco"].as_str().unwrap();
        assert_eq!(hash, config_hash("{\"n\": 1}"));
        assert_eq!(hash.len(), 32);
        assert_eq!(value["provenance"]["Cores"], json!(2));
    }
}
