//! Tables as LaTeX, with a macro for every number.

use super::keys::{Keys, NamedPart};
use super::{Field, PROSE_CHARS, Report, Table};
use std::fmt::Write;

/// The tables of a report for `\input` in a document that uses `booktabs`: first a `\newcommand`
/// per number, for use in running text, then the tables, which use the same macros.
pub fn latex(report: &Report) -> String {
    let mut keys = Keys::of(report);
    let (mut macros, mut tables) = (String::new(), String::new());
    for table in report.tables() {
        let named = keys.name(table);
        for part in named.iter().flatten().flatten() {
            let _ = writeln!(
                macros,
                "\\newcommand{{\\{}}}{{{}}}",
                part.key,
                escaped(&part.text)
            );
        }
        tables.push_str(&of_table(report, table, &named));
    }
    format!(
        "% {}\n% Needs \\usepackage{{booktabs}}.\n{macros}{tables}",
        report.title
    )
}

fn of_table(report: &Report, table: &Table, named: &[Vec<Vec<NamedPart>>]) -> String {
    let columns: String = (0..table.heading.len()).map(|i| column(table, i)).collect();
    let caption = if table.caption.is_empty() {
        &report.title
    } else {
        &table.caption
    };
    let heading: Vec<String> = table.heading.iter().map(|name| escaped(name)).collect();
    let mut text = format!(
        "\n\\begin{{table}}\n\\caption{{{}}}\n\\label{{tab:{}-{}}}\n\\begin{{tabular}}{{{columns}}}\n\
         \\toprule\n{} \\\\\n\\midrule\n",
        escaped(caption),
        report.name,
        table.key,
        heading.join(" & ")
    );
    for (row, named) in table.rows.iter().zip(named) {
        let fields = row.iter().zip(named).map(|(field, parts)| {
            let macros: Vec<String> = parts.iter().map(|p| format!("\\{}{{}}", p.key)).collect();
            let macros: Vec<&str> = macros.iter().map(String::as_str).collect();
            let laid_out = field.laid_out(&macros);
            if parts.is_empty() {
                escaped(&laid_out)
            } else {
                laid_out.replace('%', "\\%")
            }
        });
        let fields: Vec<String> = fields.collect();
        let _ = writeln!(text, "{} \\\\", fields.join(" & "));
    }
    text + "\\bottomrule\n\\end{tabular}\n\\end{table}\n"
}

/// How a column is set: numbers from the right, words from the left, long ones in several lines.
fn column(table: &Table, i: usize) -> &'static str {
    let fields = || table.rows.iter().filter_map(|row| row.get(i));
    let is_words = |field: &Field| matches!(field, Field::Words(_) | Field::Verdict(_));
    let is_long =
        |field: &Field| matches!(field, Field::Words(words) if words.chars().count() > PROSE_CHARS);
    match i {
        _ if fields().any(is_long) => "p{0.22\\linewidth}",
        0 => "l",
        _ if fields().next().is_some() && fields().all(is_words) => "l",
        _ => "r",
    }
}

/// Words for LaTeX; those between backticks as code.
fn escaped(words: &str) -> String {
    let mut text = String::new();
    for (i, part) in words.split('`').enumerate() {
        let plain: String = part.chars().map(escaped_char).collect();
        let _ = match i % 2 {
            0 => write!(text, "{plain}"),
            _ => write!(text, "\\texttt{{{plain}}}"),
        };
    }
    text
}

fn escaped_char(c: char) -> String {
    match c {
        '\\' => "\\textbackslash{}".to_owned(),
        '~' => "\\textasciitilde{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        '<' => "$<$".to_owned(),
        '>' => "$>$".to_owned(),
        '%' | '&' | '#' | '_' | '$' | '{' | '}' => format!("\\{c}"),
        c => c.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Section;

    #[test]
    fn numbers_are_macros_and_words_are_escaped() {
        let mut table = Table::new("t", &["who", "share %", "p"]).captioned("Of `a_b` & c.");
        let p = Field::Probability(Some(1e-6));
        table.row(vec![Field::words("x_1"), Field::Rate(3, 3), p]);
        let report = Report {
            name: "p".to_owned(),
            sections: vec![Section::of_table("Part", table)],
            ..Report::default()
        };
        let text = latex(&report);
        assert!(
            text.contains("\\newcommand{\\pTXOneShareLow}{44}"),
            "{text}"
        );
        assert!(
            text.contains("\\newcommand{\\pTXOneP}{$<$ 0.0001}"),
            "{text}"
        );
        assert!(
            text.contains("x\\_1 & \\pTXOneShare{}/\\pTXOneShareOf{} ["),
            "{text}"
        );
        assert!(
            text.contains("\\caption{Of \\texttt{a\\_b} \\& c.}"),
            "{text}"
        );
        assert!(
            text.contains("] \\% & \\pTXOneP{} \\\\\n\\bottomrule"),
            "{text}"
        );
        assert!(text.contains("\\begin{tabular}{lrr}"), "{text}");
    }
}
