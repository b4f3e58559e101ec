//! The page of the demo: one HTML file that needs no network.

use super::case::Chapter;
use super::run::RUNS_FOLDER;
use super::run::{Done, status};
use super::table::{Numbers, tally};
use crate::summary::duration;
use formicar::planner::Answer;
use formicar::render::{Element, Markup, Picture, html_page};

const STYLE: &str = include_str!("style.css");

const HOW_TO_READ: &str = "A path counts as found only with a certificate: a judge that knows \
    nothing of the planners has swept the whole body along it and seen that it touches no occupied \
    cell, stays on the map, keeps to the turning radius, and ends at the goal. Clearance is the \
    least distance between body and obstacle on the whole way.";

/// The page for runs that have ended.
pub(super) fn html(done: &[Done], total_s: f64) -> String {
    html_page("formicar demo", STYLE, |page| {
        page.raw("<header>\n");
        page.words(&Element::new("h1"), "formicar demo");
        let tally = tally(done).join("; ");
        page.words(&Element::of_class("p", "lead"), &format!("{tally}."));
        page.words(&Element::new("p"), HOW_TO_READ);
        let version = env!("CARGO_PKG_VERSION");
        let about = format!("formicar {version}, {total_s:.1} s in all");
        page.words(&Element::of_class("p", "muted"), &about);
        page.raw("</header>\n<main>\n");
        overview(page, done);
        for chapter in Chapter::ALL {
            let mut runs = done.iter().filter(|d| d.case.chapter == chapter).peekable();
            if runs.peek().is_some() {
                page.words(&Element::new("h2"), chapter.title());
                for run in runs {
                    article(page, run);
                }
            }
        }
        page.raw("</main>\n");
    })
}

/// A link with its words.
fn link(page: &mut Markup, to: &str, words: &str) {
    page.words(&Element::new("a").text("href", to), words);
}

/// The table of all runs, chapter by chapter.
fn overview(page: &mut Markup, done: &[Done]) {
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
        page.words(&Element::new("th").text("scope", "col"), head);
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

fn row(page: &mut Markup, done: &Done) {
    page.raw("<tr><th scope=\"row\">");
    link(page, &format!("#{}", done.case.id()), &done.case.title());
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
        page.words(&Element::of_class("td", "number"), number);
    }
    page.raw("</tr>\n");
}

fn badge(page: &mut Markup, done: &Done) {
    let (class, note) = match (done.is_found(), done.case.is_impossible) {
        (true, _) => ("good", ""),
        (false, true) => ("told", ", rightly"),
        (false, false) => ("bad", ""),
    };
    let text = format!("{}{note}", status(&done.answer));
    page.words(&Element::of_class("span", &format!("badge {class}")), &text);
}

fn article(page: &mut Markup, done: &Done) {
    let id = done.case.id();
    page.raw(&format!("<article id=\"{id}\">\n<h3>"));
    page.text(&done.case.title());
    page.raw(" ");
    badge(page, done);
    page.raw("</h3>\n");
    page.words(&Element::of_class("p", "about"), done.case.about);
    if let Some(reason) = &done.answer.reason {
        page.words(&Element::of_class("p", "reason"), reason);
    }
    facts(page, done);
    figure(page, done);
    if done.has_film() {
        film(page, done);
    }
    if let Some(command) = done.case.command() {
        page.words(&Element::new("pre"), &command);
        page.end_line();
    }
    page.raw("</article>\n");
}

fn facts(page: &mut Markup, done: &Done) {
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
            page.words(&Element::new("dt"), name);
            page.words(&Element::new("dd"), value);
            page.raw("</div>\n");
        }
    }
    page.raw("</dl>\n");
}

fn figure(page: &mut Markup, done: &Done) {
    let id = done.case.id();
    let file = |extension: &str| format!("{RUNS_FOLDER}/{id}.{extension}");
    let sized = |element: Element, picture: &Picture| {
        let size = picture.size_px();
        element.number("width", size.x).number("height", size.y)
    };
    let phone = Element::new("source")
        .text("media", "(max-width: 700px)")
        .text("srcset", &file("phone.svg"));
    let about = format!("{}. {}", done.picture.title, done.picture.caption);
    let wide = Element::new("img").text("src", &file("svg"));
    let wide = sized(wide, &done.picture).text("loading", "lazy");
    page.raw("<figure>");
    page.within(&Element::new("a").text("href", &file("svg")), |page| {
        page.within(&Element::new("picture"), |page| {
            page.add(&sized(phone, &done.phone));
            page.add(&wide.text("alt", &about));
        });
    });
    page.raw("\n<figcaption>");
    link(page, &file("svg"), "picture (SVG)");
    if done.case.has_png {
        page.raw(" ");
        link(page, &file("png"), "picture (PNG)");
    }
    page.raw(" ");
    link(page, &file("json"), "answer (JSON)");
    page.raw("</figcaption></figure>\n");
}

fn film(page: &mut Markup, done: &Done) {
    let file = format!("{RUNS_FOLDER}/{}.gif", done.case.id());
    let about = "The ants and their pheromone, iteration by iteration.";
    let image = Element::new("img").text("src", &file);
    page.raw("<figure>");
    page.add(&image.text("loading", "lazy").text("alt", about));
    page.raw("<figcaption>");
    link(page, &file, "ants (GIF)");
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
