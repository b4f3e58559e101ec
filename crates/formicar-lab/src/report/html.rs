//! Reports as one page that needs nothing else.

use super::keys::{Keys, NamedPart, slug};
use super::provenance::config_hash;
use super::{Block, Field, Figure, PROSE_CHARS, Report, Section, Table, Verdict};
use formicar::render::{Element, Markup, html_page};

/// Pictures up to this width stand two in a row where two follow each other, pixels.
const HALF_PX: f64 = 800.0;

const STYLE: &str = include_str!("page.css");

/// A fact about the origin of results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// Its name.
    pub name: String,
    /// Its value.
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
    html_page(&report.title, STYLE, |html| {
        html.raw("<main>\n");
        html.words(&Element::new("h1"), &report.title);
        html.end_line();
        prose_line(html, &Element::of_class("p", "intro"), &report.intro);
        write_contents(html, report);
        let mut writer = SectionWriter {
            html,
            keys: Keys::of(report),
            n_figures: 0,
        };
        for (i, section) in report.sections.iter().enumerate() {
            writer.write(i + 1, section);
        }
        write_provenance(html, page);
        html.raw("</main>\n");
    })
}

/// An element around words on a line of its own.
fn prose_line(html: &mut Markup, element: &Element, words: &str) {
    html.within(element, |inner| inner.prose(words));
    html.end_line();
}

fn write_contents(html: &mut Markup, report: &Report) {
    html.raw("<nav aria-label=\"Contents\"><ol>\n");
    let sections = report.sections.iter().enumerate();
    let sections = sections.map(|(i, s)| (format!("#section-{}", i + 1), s.heading.as_str()));
    let last = (String::from("#provenance"), "Provenance");
    for (target, heading) in sections.chain([last]) {
        html.within(&Element::new("li"), |item| {
            let link = Element::new("a").text("href", &target);
            item.within(&link, |link| link.prose(heading));
        });
        html.end_line();
    }
    html.raw("</ol></nav>\n");
}

/// Writes sections one after another.
struct SectionWriter<'a> {
    html: &'a mut Markup,
    keys: Keys,
    n_figures: usize,
}

impl SectionWriter<'_> {
    fn write(&mut self, number: usize, section: &Section) {
        let html = &mut *self.html;
        html.raw(&format!("<section id=\"section-{number}\">\n"));
        prose_line(html, &Element::new("h2"), &section.heading);
        let figures: Vec<Option<Figure>> = section.blocks.iter().map(Block::figure).collect();
        let is_narrow: Vec<bool> = figures.iter().map(|f| is_narrow(f.as_ref())).collect();
        for (i, (block, figure)) in section.blocks.iter().zip(&figures).enumerate() {
            let is_beside = |j: Option<usize>| j.and_then(|j| is_narrow.get(j)) == Some(&true);
            let has_neighbor = is_beside(i.checked_sub(1)) || is_beside(Some(i + 1));
            match (block, figure) {
                (Block::Table(table), _) => {
                    let named = self.keys.name(table);
                    write_table(self.html, table, &named);
                }
                (Block::Text(words), _) => prose_line(self.html, &Element::new("p"), words),
                (_, None) => {}
                (_, Some(figure)) if is_narrow[i] && has_neighbor => {
                    self.figure(&Element::of_class("figure", "half"), figure);
                }
                (_, Some(figure)) => self.figure(&Element::new("figure"), figure),
            }
        }
        self.html.raw("</section>\n");
    }

    fn figure(&mut self, element: &Element, figure: &Figure) {
        self.n_figures += 1;
        let number = self.n_figures;
        self.html.within(element, |html| {
            html.raw(&format!("\n{}", figure.svg));
            html.within(&Element::new("figcaption"), |caption| {
                caption.raw(&format!("<b>Figure {number}.</b> "));
                caption.prose(&figure.caption);
            });
            html.end_line();
        });
        self.html.end_line();
    }
}

/// Tells if a picture is narrow enough to stand beside another such picture.
fn is_narrow(figure: Option<&Figure>) -> bool {
    let svg = figure.map_or("", |figure| figure.svg.as_str());
    let width = svg.split_once(" width=\"");
    let width = width.and_then(|(_, rest)| rest.split_once('"'));
    let width_px = width.and_then(|(width, _)| width.parse::<f64>().ok());
    width_px.is_some_and(|width_px| width_px <= HALF_PX)
}

/// The named numbers of a table, by row and field.
type NamedRows = [Vec<Vec<NamedPart>>];

fn write_table(html: &mut Markup, table: &Table, named: &NamedRows) {
    let about = format!("about-{}", slug(&table.key));
    if table.is_folded {
        html.raw("<details class=\"sheet\">");
        prose_line(
            html,
            &Element::new("summary").text("id", &about),
            &table.caption,
        );
    } else if !table.caption.is_empty() {
        let caption = Element::of_class("p", "caption").text("id", &about);
        prose_line(html, &caption, &table.caption);
    }
    html.within(&Element::of_class("div", "table"), |html| {
        let element = Element::new("table")
            .text("id", &format!("table-{}", slug(&table.key)))
            .text("aria-describedby", &about);
        html.within(&element, |html| write_rows(html, table, named));
    });
    html.end_line();
    if table.is_folded {
        html.raw("</details>\n");
    }
}

fn write_rows(html: &mut Markup, table: &Table, named: &NamedRows) {
    html.raw("\n<thead><tr>");
    for (i, name) in table.heading.iter().enumerate() {
        let mut fields = table.rows.iter().filter_map(|row| row.get(i));
        let heading = Element::new("th").text("scope", "col");
        let heading = if fields.all(|f| matches!(f, Field::Words(_) | Field::Verdict(_))) {
            heading.text("class", "words")
        } else {
            heading
        };
        html.within(&heading, |html| html.prose(name));
    }
    html.raw("</tr></thead>\n<tbody>\n");
    for (row, named) in table.rows.iter().zip(named) {
        html.raw("<tr>");
        for (i, (field, parts)) in row.iter().zip(named).enumerate() {
            let cell = match i {
                0 => Element::new("th").text("scope", "row"),
                _ => Element::new("td"),
            };
            html.within(&with_class(cell, field), |html| {
                write_field(html, field, parts);
            });
        }
        html.raw("</tr>\n");
    }
    html.raw("</tbody>");
}

/// Words are set from the left, and long ones in several lines.
fn with_class(cell: Element, field: &Field) -> Element {
    match field {
        Field::Words(words) if words.chars().count() > PROSE_CHARS => cell.text("class", "prose"),
        Field::Words(_) | Field::Verdict(_) => cell.text("class", "words"),
        _ => cell,
    }
}

fn write_field(html: &mut Markup, field: &Field, parts: &[NamedPart]) {
    if let Field::Verdict(verdict) = field {
        return write_verdict(html, *verdict);
    }
    let numbers: Vec<String> = parts.iter().map(number).collect();
    let numbers: Vec<&str> = numbers.iter().map(String::as_str).collect();
    let laid_out = field.laid_out(&numbers);
    if parts.is_empty() {
        html.prose(&laid_out);
    } else {
        html.raw(&laid_out);
    }
}

fn write_verdict(html: &mut Markup, verdict: Verdict) {
    let class = format!("verdict {}", verdict.class());
    html.within(&Element::of_class("span", &class), |html| {
        let mark = Element::new("span").text("aria-hidden", "true");
        html.words(&mark, verdict.mark());
        html.text(&format!(" {}", verdict.name()));
    });
}

/// A number with its name, for programs that read the page.
fn number(part: &NamedPart) -> String {
    let mut html = Markup::default();
    html.words(&Element::new("data").text("value", &part.key), &part.text);
    html.as_str().to_owned()
}

fn write_provenance(html: &mut Markup, page: &Page) {
    html.raw("<section id=\"provenance\">\n<h2>Provenance</h2>\n<dl>\n");
    for fact in page.facts {
        html.within(&Element::new("dt"), |html| html.prose(&fact.name));
        prose_line(html, &Element::new("dd"), &fact.value);
    }
    html.raw("</dl>\n");
    if !page.configs.is_empty() {
        html.raw("<h3>Configurations</h3>\n");
    }
    for config in page.configs {
        html.within(&Element::new("details"), |html| {
            html.within(&Element::new("summary"), |html| {
                html.prose(&config.name);
                html.text(" ");
                html.words(
                    &Element::of_class("code", "hash"),
                    &config_hash(&config.value),
                );
            });
            html.words(&Element::new("pre"), &config.value);
        });
        html.end_line();
    }
    html.raw("</section>\n");
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
