//! What charts are drawn on: lines, marks and text as SVG.

use std::fmt::Write;

pub(super) const INK: &str = "#22272e";
pub(super) const MUTED: &str = "#5d6670";
pub(super) const RULE: &str = "#a9b1b9";
pub(super) const HAIRLINE: &str = "#e4e7ea";
pub(super) const FIRST: &str = "#0b4f9c";
pub(super) const SECOND: &str = "#d9690a";
/// Size of text, pixels.
pub(super) const TEXT_PX: f64 = 12.5;
/// Mean width of a character over the size of the text, on the safe side.
const CHAR_WIDTH: f64 = 0.56;

/// Colors and dashes of lines in one chart, in turn.
const LOOKS: [(&str, &str); 7] = [
    (FIRST, ""),
    (SECOND, "7 4"),
    ("#0b7a53", "2 3.5"),
    ("#7b2d8b", "9 3 2 3"),
    ("#8c5a14", "4 2.5"),
    ("#22272e", "1.5 2.5"),
    ("#c2185b", "12 4"),
];

/// Color and dash of the i-th line.
pub(super) fn look(i: usize) -> (&'static str, &'static str) {
    LOOKS[i % LOOKS.len()]
}

/// Where text stands beside its point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen<'a> {
    pub(super) color: &'a str,
    pub(super) width_px: f64,
    pub(super) dash: &'a str,
}

impl<'a> Pen<'a> {
    pub(super) fn new(color: &'a str, width_px: f64) -> Self {
        Self {
            color,
            width_px,
            dash: "",
        }
    }
}

/// An SVG document that grows by what is drawn.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    body: String,
}

impl Canvas {
    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2], pen: Pen) {
        self.polyline(&[from, to], pen);
    }

    pub(super) fn polyline(&mut self, points: &[[f64; 2]], pen: Pen) {
        let dash = match pen.dash {
            "" => String::new(),
            dash => format!(" stroke-dasharray=\"{dash}\""),
        };
        let _ = writeln!(
            self.body,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{dash}/>",
            coordinates(points),
            pen.color,
            pen.width_px
        );
    }

    /// Ground between lines.
    pub(super) fn area(&mut self, outline: &[[f64; 2]], (color, opacity): (&str, f64)) {
        let _ = writeln!(
            self.body,
            "<polygon points=\"{}\" fill=\"{color}\" fill-opacity=\"{opacity}\"/>",
            coordinates(outline)
        );
    }

    pub(super) fn rectangle(&mut self, low: [f64; 2], high: [f64; 2], (fill, pen): (&str, Pen)) {
        let _ = writeln!(
            self.body,
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{fill}\" \
             stroke=\"{}\" stroke-width=\"{}\"/>",
            low[0],
            low[1],
            high[0] - low[0],
            high[1] - low[1],
            pen.color,
            pen.width_px
        );
    }

    /// A dot; hollow where the fill is `none`.
    pub(super) fn dot(&mut self, [x, y]: [f64; 2], radius_px: f64, (fill, pen): (&str, Pen)) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius_px}\" fill=\"{fill}\" \
             fill-opacity=\"0.55\" stroke=\"{}\" stroke-width=\"{}\"/>",
            pen.color, pen.width_px
        );
    }

    pub(super) fn text(&mut self, [x, y]: [f64; 2], words: &str, (anchor, color): (Anchor, &str)) {
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{}\" fill=\"{color}\">{}</text>",
            anchor.name(),
            escaped(words)
        );
    }

    /// Text that reads upwards, its middle at a point.
    pub(super) fn upright(&mut self, [x, y]: [f64; 2], words: &str) {
        let _ = writeln!(
            self.body,
            "<text transform=\"translate({x:.2} {y:.2}) rotate(-90)\" text-anchor=\"middle\" \
             fill=\"{MUTED}\">{}</text>",
            escaped(words)
        );
    }

    /// The document; `title` is what screen readers say.
    pub(super) fn document(&self, size: [f64; 2], title: &str) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0}\" height=\"{1:.0}\" \
             viewBox=\"0 0 {0:.0} {1:.0}\" font-family=\"system-ui, sans-serif\" \
             font-size=\"{TEXT_PX}\" role=\"img\">\n<title>{2}</title>\n\
             <rect width=\"{0:.0}\" height=\"{1:.0}\" fill=\"#ffffff\"/>\n{3}</svg>\n",
            size[0].ceil(),
            size[1].ceil(),
            escaped(title),
            self.body
        )
    }
}

/// About how wide some words are.
pub(super) fn width_px(words: &str) -> f64 {
    words.chars().count() as f64 * CHAR_WIDTH * TEXT_PX
}

fn coordinates(points: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for [x, y] in points {
        let _ = write!(text, "{x:.2},{y:.2} ");
    }
    text.trim_end().to_owned()
}

fn escaped(words: &str) -> String {
    let words = words.replace('`', "");
    let words = words.replace('&', "&amp;").replace('<', "&lt;");
    words.replace('>', "&gt;").replace('"', "&quot;")
}
