//! Reports as Markdown.

use super::{Block, Field, Report, Table};
use std::fmt::Write;

/// The report as Markdown; of figures the captions.
pub fn markdown(report: &Report) -> String {
    let mut text = format!("# {}\n\n{}\n", report.title, report.intro);
    for section in &report.sections {
        let _ = write!(text, "\n## {}\n", section.heading);
        for block in &section.blocks {
            let _ = match block {
                Block::Text(words) => write!(text, "\n{words}\n"),
                Block::Table(table) => write!(text, "\n{}", of_table(table)),
                figure => {
                    let caption = figure.figure_caption().unwrap_or_default();
                    write!(text, "\nFigure, in `index.html`: {caption}\n")
                }
            };
        }
    }
    text
}

fn of_table(table: &Table) -> String {
    let mut text = String::new();
    if !table.caption.is_empty() {
        let _ = writeln!(text, "{}\n", table.caption);
    }
    line(&mut text, table.heading.iter().cloned());
    line(&mut text, table.heading.iter().map(|_| "---".to_owned()));
    for row in &table.rows {
        line(&mut text, row.iter().map(Field::text));
    }
    text
}

fn line(text: &mut String, fields: impl Iterator<Item = String>) {
    text.push('|');
    for field in fields {
        let _ = write!(text, " {} |", field.replace('|', "\\|"));
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Section;

    #[test]
    fn a_report_is_written() {
        let mut table = Table::new("t", &["who", "what"]).captioned("All of it.");
        table.row(vec![Field::words("a|b"), Field::Number(Some(2.0), 1)]);
        let report = Report {
            title: "Title".to_owned(),
            intro: "Words.".to_owned(),
            sections: vec![Section::of_table("Part", table)],
            ..Report::default()
        };
        let expected = "# Title\n\nWords.\n\n## Part\n\nAll of it.\n\n| who | what |\n\
                        | --- | --- |\n| a\\|b | 2.0 |\n";
        assert_eq!(markdown(&report), expected);
    }
}
