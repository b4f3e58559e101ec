//! Reports as one page that needs nothing else.

use super::keys::{Keys, NamedPart, slug};
use super::provenance::config_hash;
use super::{Block, Field, Figure, PROSE_CHARS, Report, Section, Table, Verdict};
use std::fmt::Write;

/// Pictures up to this width stand two in a row where two follow each other, pixels.
const HALF_PX: f64 = 800.0;

const STYLE: &str = include_str!("page.css");

/// Something that is known about how results came about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// What it is about.
    pub name: String,
    /// What it is.
    pub value: String,
}

impl Fact {
    /// A fact.
    pub fn new(name: &str, value: impl Into<String>) -> Self {
        Self {
            name: name.to_owned(),
            value: value.into(),
        }
    }
}

/// A report with its provenance.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// The report.
    pub report: &'a Report,
    /// Version, machine, seeds, maps.
    pub facts: &'a [Fact],
    /// Names of configurations and their parameters as JSON.
    pub configs: &'a [Fact],
}

/// The page: one HTML document with style and pictures in it. It loads nothing, has no script,
/// follows the light or dark scheme of its reader, and prints.
pub fn page(page: &Page) -> String {
    let report = page.report;
    let title = escaped(&report.title);
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n<p class=\"intro\">{}</p>\n",
        inline(&report.intro)
    );
    contents(&mut text, report);
    let (mut keys, mut n_figures) = (Keys::of(report), 0);
    for (i, section) in report.sections.iter().enumerate() {
        write_section(&mut text, (i, section), &mut keys, &mut n_figures);
    }
    provenance(&mut text, page);
    text + "</main>\n</body>\n</html>\n"
}

fn contents(text: &mut String, report: &Report) {
    text.push_str("<nav aria-label=\"Contents\"><ol>\n");
    for (i, section) in report.sections.iter().enumerate() {
        let heading = inline(&section.heading);
        let _ = writeln!(
            text,
            "<li><a href=\"#section-{}\">{heading}</a></li>",
            i + 1
        );
    }
    text.push_str("<li><a href=\"#provenance\">Provenance</a></li>\n</ol></nav>\n");
}

fn write_section(
    text: &mut String,
    (i, section): (usize, &Section),
    keys: &mut Keys,
    n_figures: &mut usize,
) {
    let heading = inline(&section.heading);
    let _ = writeln!(
        text,
        "<section id=\"section-{}\">\n<h2>{heading}</h2>",
        i + 1
    );
    let figures: Vec<Option<Figure>> = section.blocks.iter().map(Block::figure).collect();
    let is_narrow: Vec<bool> = figures
        .iter()
        .map(|figure| is_narrow(figure.as_ref()))
        .collect();
    for (i, (block, figure)) in section.blocks.iter().zip(&figures).enumerate() {
        let is_beside = |j: Option<usize>| j.and_then(|j| is_narrow.get(j)) == Some(&true);
        let has_neighbor = is_beside(i.checked_sub(1)) || is_beside(Some(i + 1));
        let class = if is_narrow[i] && has_neighbor {
            " class=\"half\""
        } else {
            ""
        };
        match (block, figure) {
            (Block::Table(table), _) => {
                let named = keys.name(table);
                write_table(text, table, &named);
            }
            (Block::Text(words), _) => {
                let _ = writeln!(text, "<p>{}</p>", inline(words));
            }
            (_, figure) => {
                *n_figures += usize::from(figure.is_some());
                write_figure(text, figure.as_ref(), (*n_figures, class));
            }
        }
    }
    text.push_str("</section>\n");
}

fn write_figure(text: &mut String, figure: Option<&Figure>, (number, class): (usize, &str)) {
    let Some(figure) = figure else {
        return;
    };
    let caption = inline(&figure.caption);
    let _ = writeln!(
        text,
        "<figure{class}>\n{}<figcaption><b>Figure {number}.</b> {caption}</figcaption>\n</figure>",
        figure.svg
    );
}

/// Whether a picture is narrow enough to stand beside another such.
fn is_narrow(figure: Option<&Figure>) -> bool {
    let svg = figure.map_or("", |figure| figure.svg.as_str());
    let width = svg.split_once(" width=\"");
    let width = width.and_then(|(_, rest)| rest.split_once('"'));
    let width_px = width.and_then(|(width, _)| width.parse::<f64>().ok());
    width_px.is_some_and(|width_px| width_px <= HALF_PX)
}

fn write_table(text: &mut String, table: &Table, named: &[Vec<Vec<NamedPart>>]) {
    let (key, caption) = (slug(&table.key), inline(&table.caption));
    let _ = match (table.is_folded, caption.is_empty()) {
        (true, _) => writeln!(
            text,
            "<details class=\"sheet\"><summary id=\"about-{key}\">{caption}</summary>"
        ),
        (false, true) => Ok(()),
        (false, false) => writeln!(
            text,
            "<p class=\"caption\" id=\"about-{key}\">{caption}</p>"
        ),
    };
    write_rows(text, table, (&key, named));
    if table.is_folded {
        text.push_str("</details>\n");
    }
}

fn write_rows(text: &mut String, table: &Table, (key, named): (&str, &[Vec<Vec<NamedPart>>])) {
    let _ = writeln!(
        text,
        "<div class=\"table\"><table id=\"table-{key}\" aria-describedby=\"about-{key}\">"
    );
    text.push_str("<thead><tr>");
    for (i, name) in table.heading.iter().enumerate() {
        let fields = table.rows.iter().filter_map(|row| row.get(i));
        let is_words = |field: &Field| matches!(field, Field::Words(_) | Field::Verdict(_));
        let class = if { fields }.all(is_words) {
            " class=\"words\""
        } else {
            ""
        };
        let _ = write!(text, "<th scope=\"col\"{class}>{}</th>", inline(name));
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for (row, named) in table.rows.iter().zip(named) {
        text.push_str("<tr>");
        for (i, (field, parts)) in row.iter().zip(named).enumerate() {
            let numbers: Vec<String> = parts.iter().map(number).collect();
            let numbers: Vec<&str> = numbers.iter().map(String::as_str).collect();
            let laid_out = field.laid_out(&numbers);
            let inner = match field {
                Field::Verdict(verdict) => verdict_mark(*verdict),
                _ if parts.is_empty() => inline(&laid_out),
                _ => laid_out,
            };
            let class = class(field);
            let _ = match i {
                0 => write!(text, "<th scope=\"row\"{class}>{inner}</th>"),
                _ => write!(text, "<td{class}>{inner}</td>"),
            };
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody></table></div>\n");
}

/// Words are set from the left, and long ones in several lines.
fn class(field: &Field) -> &'static str {
    match field {
        Field::Words(words) if words.chars().count() > PROSE_CHARS => " class=\"prose\"",
        Field::Words(_) | Field::Verdict(_) => " class=\"words\"",
        _ => "",
    }
}

fn verdict_mark(verdict: Verdict) -> String {
    let (class, mark, name) = (verdict.class(), verdict.mark(), verdict.name());
    format!(
        "<span class=\"verdict {class}\"><span aria-hidden=\"true\">{mark}</span> {name}</span>"
    )
}

/// A number with its name, for whoever looks for it.
fn number(part: &NamedPart) -> String {
    format!(
        "<data value=\"{}\">{}</data>",
        part.key,
        escaped(&part.text)
    )
}

fn provenance(text: &mut String, page: &Page) {
    text.push_str("<section id=\"provenance\">\n<h2>Provenance</h2>\n<dl>\n");
    for fact in page.facts {
        let (name, value) = (inline(&fact.name), inline(&fact.value));
        let _ = writeln!(text, "<dt>{name}</dt><dd>{value}</dd>");
    }
    text.push_str("</dl>\n");
    if !page.configs.is_empty() {
        text.push_str("<h3>Configurations</h3>\n");
    }
    for config in page.configs {
        let (name, value) = (inline(&config.name), escaped(&config.value));
        let _ = writeln!(
            text,
            "<details><summary>{name} <code class=\"hash\">{}</code></summary><pre>{value}</pre></details>",
            config_hash(&config.value)
        );
    }
    text.push_str("</section>\n");
}

/// Words for HTML; those between backticks as code.
fn inline(words: &str) -> String {
    let mut text = String::new();
    for (i, part) in words.split('`').enumerate() {
        let part = escaped(part);
        let _ = match i % 2 {
            0 => write!(text, "{part}"),
            _ => write!(text, "<code>{part}</code>"),
        };
    }
    text
}

fn escaped(words: &str) -> String {
    let marks = [
        ("&", "&amp;"),
        ("<", "&lt;"),
        (">", "&gt;"),
        ("\"", "&quot;"),
    ];
    marks
        .iter()
        .fold(words.to_owned(), |text, (from, to)| text.replace(from, to))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_holds_everything_and_loads_nothing() {
        let mut table = Table::new("t", &["who", "what", "p"]).captioned("Of `x` < y.");
        let p = Field::Probability(Some(1e-6));
        table.row(vec![Field::words("<a>"), Field::Number(Some(2.0), 1), p]);
        let figure = Figure {
            caption: "A line.".to_owned(),
            svg: "<svg></svg>".to_owned(),
        };
        let report = Report {
            name: "p".to_owned(),
            title: "A & B".to_owned(),
            sections: vec![Section {
                heading: "Part".to_owned(),
                blocks: vec![Block::Table(table), Block::Figure(figure)],
            }],
            ..Report::default()
        };
        let text = page(&Page {
            report: &report,
            facts: &[Fact::new("seed", "0")],
            configs: &[Fact::new("aco", "{\"n\": 1}")],
        });
        for part in [
            "<title>A &amp; B</title>",
            "<p class=\"caption\" id=\"about-t\">Of <code>x</code> &lt; y.</p>",
            "<th scope=\"row\" class=\"words\">&lt;a&gt;</th><td><data value=\"pTAAboveWhat\">2.0</data></td>",
            "<data value=\"pTAAboveP\">&lt; 0.0001</data>",
            "<b>Figure 1.</b> A line.",
            "<dt>seed</dt><dd>0</dd>",
            "<pre>{&quot;n&quot;: 1}</pre>",
            "prefers-color-scheme: dark",
        ] {
            assert!(text.contains(part), "no {part} in {text}");
        }
        assert!(
            !text.contains("http") && !text.contains("<script"),
            "{text}"
        );
    }
}
