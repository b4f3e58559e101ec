//! Tables as LaTeX, with a macro for every number.

use super::keys::{Keys, NamedPart, slug};
use super::{Field, PROSE_CHARS, Report, Table};
use std::fmt::Write;

/// The tables of a report for `\input` in a document that uses `booktabs`: first a `\newcommand`
/// per number, for use in running text, then the tables, which use the same macros. Macros and
/// labels begin with the report's name, so that reports of other names go into the same document.
/// Tables that a page folds may run over pages, by `longtable`.
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
    let is_long = report.tables().any(|table| table.is_folded);
    let packages = if is_long {
        "booktabs,longtable"
    } else {
        "booktabs"
    };
    let title = report.title.replace(char::is_control, " ");
    format!("% {title}\n% Needs \\usepackage{{{packages}}}.\n{macros}{tables}")
}

fn of_table(report: &Report, table: &Table, named: &[Vec<Vec<NamedPart>>]) -> String {
    let columns: String = (0..table.heading.len()).map(|i| column(table, i)).collect();
    let caption = if table.caption.is_empty() {
        &report.title
    } else {
        &table.caption
    };
    let heading: Vec<String> = table.heading.iter().map(|name| escaped(name)).collect();
    let label = slug(&format!("{} {}", report.name, table.key));
    let about = format!("\\caption{{{}}}\n\\label{{tab:{label}}}", escaped(caption));
    let head = format!("\\toprule\n{} \\\\\n\\midrule\n", heading.join(" & "));
    let (begin, end) = if table.is_folded {
        (
            format!("\\begin{{longtable}}{{{columns}}}\n{about} \\\\\n{head}\\endhead\n"),
            "\\end{longtable}\n",
        )
    } else {
        (
            format!("\\begin{{table}}\n{about}\n\\begin{{tabular}}{{{columns}}}\n{head}"),
            "\\end{tabular}\n\\end{table}\n",
        )
    };
    format!("\n{begin}{}\\bottomrule\n{end}", rows(table, named))
}

fn rows(table: &Table, named: &[Vec<Vec<NamedPart>>]) -> String {
    let mut text = String::new();
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
        let row = fields.join(" & ");
        // Behind the end of a row these two would be read as part of it.
        let guard = if row.starts_with(['[', '*']) {
            "{}"
        } else {
            ""
        };
        let _ = writeln!(text, "{guard}{row} \\\\");
    }
    text
}

/// The alignment of a column: numbers right, words left, long ones in several lines.
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
        c if c.is_control() => " ".to_owned(),
        c => c.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Block, Section};

    /// A report under a name, of one row that is called so too.
    fn named(name: &str) -> Report {
        let mut table = Table::new(&format!("compare {name}"), &["who", "m"]);
        table.row(vec![Field::words(name), Field::Number(Some(1.0), 0)]);
        Report {
            name: name.to_owned(),
            title: name.to_owned(),
            sections: vec![Section::of_table("Part", table)],
            ..Report::default()
        }
    }

    #[test]
    fn names_of_campaigns_are_safe_in_labels_captions_and_macros() {
        let text = latex(&named("My 1st_run & #2 {50 %}\n\n~^$\\"));
        let label = "\\label{tab:my-1st-run-2-50-compare-my-1st-run-2-50}";
        assert!(text.contains(label), "{text}");
        let caption = "\\caption{My 1st\\_run \\& \\#2 \\{50 \\%\\}  \\textasciitilde{}\
                       \\textasciicircum{}\\$\\textbackslash{}}";
        assert!(text.contains(caption), "{text}");
        assert!(
            text.starts_with("% My 1st_run & #2 {50 %}  ~^$\\\n% Needs"),
            "{text}"
        );
        let name = text.split("\\newcommand{\\").nth(1).unwrap();
        let name = name.split_once('}').unwrap().0;
        assert!(name.bytes().all(|b| b.is_ascii_alphabetic()), "{name}");
        assert!(latex(&named("[a]")).contains("\n{}[a] & "));
    }

    #[test]
    fn two_reports_go_into_one_document() {
        let names = |name: &str| -> Vec<String> {
            let text = latex(&named(name));
            let lines = text.lines();
            let lines = lines.filter(|l| l.contains("\\newcommand") || l.contains("\\label"));
            lines.map(str::to_owned).collect()
        };
        let (one, other) = (names("junctions, slow"), names("junctions, fast"));
        assert_eq!((one.len(), other.len()), (2, 2));
        assert!(one.iter().all(|name| !other.contains(name)), "{one:?}");
    }

    #[test]
    fn folded_tables_may_run_over_pages() {
        let mut report = named("p");
        let Block::Table(table) = &mut report.sections[0].blocks[0] else {
            panic!("a table");
        };
        table.is_folded = true;
        let text = latex(&report);
        assert!(
            text.contains("% Needs \\usepackage{booktabs,longtable}."),
            "{text}"
        );
        assert!(
            text.contains("\\label{tab:p-compare-p} \\\\\n\\toprule\nwho & m \\\\"),
            "{text}"
        );
        assert!(text.ends_with("\\bottomrule\n\\end{longtable}\n"), "{text}");
    }

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
