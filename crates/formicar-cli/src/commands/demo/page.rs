//! The page of the demo: one HTML file that needs no network.

use super::RUNS_FOLDER;
use super::case::Chapter;
use super::run::{Done, status};
use super::table::{Numbers, tally};
use crate::summary::duration;
use formicar::planner::Answer;
use formicar::render::Picture;
use std::fmt::Write;

const STYLE: &str = include_str!("style.css");

const HOW_TO_READ: &str = "A path counts as found only with a certificate: a judge that knows \
    nothing of the planners has swept the whole body along it and seen that it touches no occupied \
    cell, stays on the map, keeps to the turning radius, and ends at the goal. Clearance is the \
    least distance between body and obstacle on the whole way.";

/// The page for runs that have ended.
pub(super) fn html(done: &[Done], total_s: f64) -> String {
    let mut page = Html::default();
    page.raw("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    page.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    // Without an icon of its own a browser asks the server for one.
    page.raw("<link rel=\"icon\" href=\"data:,\">\n<title>formicar demo</title>\n");
    page.raw(&format!(
        "<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n"
    ));
    page.element("h1", "formicar demo");
    let version = env!("CARGO_PKG_VERSION");
    let tally = tally(done).join("; ");
    page.element("p class=\"lead\"", &format!("{tally}."));
    page.element("p", HOW_TO_READ);
    page.element(
        "p class=\"muted\"",
        &format!("formicar {version}, {total_s:.1} s in all"),
    );
    page.raw("</header>\n<main>\n");
    overview(&mut page, done);
    for chapter in Chapter::ALL {
        let mut runs = done.iter().filter(|d| d.case.chapter == chapter).peekable();
        if runs.peek().is_some() {
            page.element("h2", chapter.title());
            for run in runs {
                article(&mut page, run);
            }
        }
    }
    page.raw("</main>\n</body>\n</html>\n");
    page.0
}

/// The table of all runs, chapter by chapter.
fn overview(page: &mut Html, done: &[Done]) {
    page.raw("<div class=\"scroll\">\n<table>\n<thead><tr>");
    for head in [
        "run",
        "status",
        "length",
        "clearance",
        "curvature",
        "cusps",
        "steps",
        "map set-up",
        "first path",
        "query",
    ] {
        page.element("th scope=\"col\"", head);
    }
    page.raw("</tr></thead>\n");
    for chapter in Chapter::ALL {
        let runs = done.iter().filter(|d| d.case.chapter == chapter);
        page.raw("<tbody>\n");
        for run in runs {
            row(page, run);
        }
        page.raw("</tbody>\n");
    }
    page.raw("</table>\n</div>\n");
}

fn row(page: &mut Html, done: &Done) {
    page.raw("<tr><th scope=\"row\">");
    page.link(&format!("#{}", done.case.id()), &done.case.title());
    page.raw("</th><td>");
    badge(page, done);
    page.raw("</td>");
    let numbers = Numbers::of(done);
    let Timings { map, first, query } = Timings::of(&done.answer);
    let steps = done.n_steps.to_string();
    for number in [
        &numbers.length,
        &numbers.clearance,
        &numbers.curvature,
        &numbers.cusps,
        &steps,
        &map,
        &first,
        &query,
    ] {
        page.element("td class=\"number\"", number);
    }
    page.raw("</tr>\n");
}

fn badge(page: &mut Html, done: &Done) {
    let (class, note) = match (done.is_found(), done.case.is_impossible) {
        (true, _) => ("good", ""),
        (false, true) => ("told", ", rightly"),
        (false, false) => ("bad", ""),
    };
    let text = format!("{}{note}", status(&done.answer));
    page.element(&format!("span class=\"badge {class}\""), &text);
}

fn article(page: &mut Html, done: &Done) {
    let id = done.case.id();
    page.raw(&format!("<article id=\"{id}\">\n<h3>"));
    page.text(&done.case.title());
    page.raw(" ");
    badge(page, done);
    page.raw("</h3>\n");
    page.element("p class=\"about\"", done.case.about);
    if let Some(reason) = &done.answer.reason {
        page.element("p class=\"reason\"", reason);
    }
    facts(page, done);
    figure(page, done);
    if done.has_film() {
        film(page, done);
    }
    if let Some(command) = done.case.command() {
        page.raw("<pre>");
        page.text(&command);
        page.raw("</pre>\n");
    }
    page.raw("</article>\n");
}

fn facts(page: &mut Html, done: &Done) {
    let numbers = Numbers::of(done);
    let Timings { map, first, query } = Timings::of(&done.answer);
    let planner = format!("{}, {} steps", done.answer.planner, done.n_steps);
    let times = if first.is_empty() {
        format!("map {map}, gave up after {query}")
    } else {
        format!("map {map}, first path {first}, query {query}")
    };
    page.raw("<dl>\n");
    for (name, value) in [
        ("length", &numbers.length),
        ("clearance", &numbers.clearance),
        ("curvature", &numbers.curvature),
        ("cusps", &numbers.cusps),
        ("vehicle", &done.answer.provenance.vehicle.name),
        ("planner", &planner),
        ("time", &times),
    ] {
        if !value.is_empty() {
            page.raw("<div>");
            page.element("dt", name);
            page.element("dd", value);
            page.raw("</div>\n");
        }
    }
    page.raw("</dl>\n");
}

fn figure(page: &mut Html, done: &Done) {
    let id = done.case.id();
    let file = |extension: &str| format!("{RUNS_FOLDER}/{id}.{extension}");
    let sized = |picture: &Picture| {
        let size = picture.size_px();
        format!("width=\"{}\" height=\"{}\"", size.x, size.y)
    };
    page.raw(&format!(
        "<figure><a href=\"{svg}\"><picture>\n\
         <source media=\"(max-width: 700px)\" srcset=\"{phone}\" {phone_size}>\n\
         <img src=\"{svg}\" {size} loading=\"lazy\" alt=\"",
        svg = file("svg"),
        phone = file("phone.svg"),
        phone_size = sized(&done.phone),
        size = sized(&done.picture),
    ));
    page.text(&format!("{}. {}", done.picture.title, done.picture.caption));
    page.raw("\"></picture></a>\n<figcaption>");
    page.link(&file("svg"), "picture (SVG)");
    if done.case.has_png {
        page.raw(" ");
        page.link(&file("png"), "picture (PNG)");
    }
    page.raw(" ");
    page.link(&file("json"), "answer (JSON)");
    page.raw("</figcaption></figure>\n");
}

fn film(page: &mut Html, done: &Done) {
    let file = format!("{RUNS_FOLDER}/{}.gif", done.case.id());
    page.raw(&format!(
        "<figure><img src=\"{file}\" loading=\"lazy\" alt=\""
    ));
    page.text("The ants and their pheromone, iteration by iteration.");
    page.raw("\"><figcaption>");
    page.link(&file, "ants (GIF)");
    page.raw("</figcaption></figure>\n");
}

/// Times of a run, as text.
struct Timings {
    map: String,
    first: String,
    query: String,
}

impl Timings {
    fn of(answer: &Answer) -> Self {
        let timing = &answer.timing;
        Self {
            map: duration(timing.map_setup_s),
            first: timing.first_feasible_s.map_or(String::new(), duration),
            query: duration(timing.query_s),
        }
    }
}

/// HTML under construction.
#[derive(Default)]
struct Html(String);

impl Html {
    /// Markup of our own.
    fn raw(&mut self, markup: &str) {
        self.0.push_str(markup);
    }

    /// Text, escaped for content and attributes.
    fn text(&mut self, text: &str) {
        for c in text.chars() {
            match c {
                '&' => self.0.push_str("&amp;"),
                '<' => self.0.push_str("&lt;"),
                '>' => self.0.push_str("&gt;"),
                '"' => self.0.push_str("&quot;"),
                _ => self.0.push(c),
            }
        }
    }

    /// An element with text in it; `tag` may carry attributes.
    fn element(&mut self, tag: &str, text: &str) {
        let name = tag.split(' ').next().unwrap_or_default();
        let _ = write!(self.0, "<{tag}>");
        self.text(text);
        let _ = write!(self.0, "</{name}>");
    }

    fn link(&mut self, to: &str, text: &str) {
        self.element(&format!("a href=\"{to}\""), text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_elements_are_closed() {
        let mut page = Html::default();
        page.element("p class=\"a\"", "1 < 2 & \"so\"");
        assert_eq!(page.0, "<p class=\"a\">1 &lt; 2 &amp; &quot;so&quot;</p>");
    }
}
