//! Text: strokes of a small round alphabet, the same on every machine, or the reader's font.

use super::markup::Element;
use super::palette::{Color, PAGE};
use super::svg::{Letters, PathData, Svg};
use crate::geometry::Point2;

/// Gap between letters, in hundredths of the size.
const GAP: f64 = 17.0;

/// The anchor of a text, relative to its point on the base line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// The style of a text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lettering {
    pub(super) size_px: f64,
    pub(super) color: Color,
    pub(super) anchor: Anchor,
    /// Stroke width in hundredths of the size.
    pub(super) weight: f64,
}

impl Lettering {
    /// Stroke width of plain letters.
    const PLAIN: f64 = 8.5;

    pub(super) const fn new(size_px: f64, color: Color) -> Self {
        Self {
            size_px,
            color,
            anchor: Anchor::Start,
            weight: Self::PLAIN,
        }
    }

    pub(super) const fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    pub(super) const fn bold(self) -> Self {
        Self {
            weight: 11.5,
            ..self
        }
    }

    /// Width of a text in pixels.
    pub(super) fn width_px(&self, text: &str) -> f64 {
        let hundredths: f64 = text.chars().map(|c| glyph(c).0 + GAP).sum();
        (hundredths - GAP).max(0.0) * self.size_px / 100.0
    }

    /// Writes a text with its base line at a point.
    pub(super) fn write(&self, svg: &mut Svg, at: Point2, text: &str) {
        match svg.letters {
            _ if text.is_empty() => {}
            Letters::Strokes => {
                let element = self.strokes(at, text).text("aria-label", text);
                svg.add(&element.pen(self.color, self.weight));
            }
            Letters::Font => svg.words(&self.font(at), text),
        }
    }

    /// Writes a text with the page shining around it, to be read on any ground.
    pub(super) fn write_with_halo(&self, svg: &mut Svg, at: Point2, text: &str) {
        match svg.letters {
            _ if text.is_empty() => {}
            Letters::Strokes => {
                let halo = self.strokes(at, text).pen(PAGE, self.weight + 32.0);
                svg.add(&halo.text("stroke-opacity", "0.85"));
                self.write(svg, at, text);
            }
            Letters::Font => {
                let halo = self.font(at).pen(PAGE, 0.3 * self.size_px);
                svg.words(&halo.text("paint-order", "stroke"), text);
            }
        }
    }

    /// The words broken into lines of at most a width; a longer word stands alone.
    pub(super) fn wrapped(&self, text: &str, width_px: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            let longer = lines.last().map(|line| format!("{line} {word}"));
            match (longer, lines.last_mut()) {
                (Some(longer), Some(line)) if self.width_px(&longer) <= width_px => *line = longer,
                _ => lines.push(word.to_owned()),
            }
        }
        lines
    }

    /// A text element with its base line at a point.
    fn font(&self, at: Point2) -> Element {
        let anchor = match self.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let element = Element::new("text")
            .number("x", at.x)
            .number("y", at.y)
            .number("font-size", self.size_px)
            .text("text-anchor", anchor)
            .fill(self.color);
        if self.weight > Self::PLAIN {
            element.text("font-weight", "600")
        } else {
            element
        }
    }

    fn strokes(&self, at: Point2, text: &str) -> Element {
        let scale = self.size_px / 100.0;
        let before = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * self.width_px(text),
            Anchor::End => self.width_px(text),
        };
        let mut path = PathData::default();
        let mut x = 0.0;
        for c in text.chars() {
            let (width, strokes) = glyph(c);
            if !strokes.is_empty() {
                path.relative(Point2::new(x, 0.0), strokes);
            }
            x += width + GAP;
        }
        let (right, down) = (Point2::new(scale, 0.0), Point2::new(0.0, scale));
        Element::path(path).matrix(right, down, Point2::new(at.x - before, at.y))
    }
}

/// Width and strokes of a letter, y downwards from the base line, relative path commands.
///
/// Capitals are 70 high, small letters 50, descenders reach 20 below. Letters that are missing
/// show as a box.
#[rustfmt::skip]
#[allow(clippy::too_many_lines, reason = "an alphabet is a table")]
fn glyph(letter: char) -> (f64, &'static str) {
    match letter {
        ' ' => (12.0, ""),
        'A' => (50.0, "l25-70l25 70m-42-22h34"),
        'B' => (42.0, "v-70h24a17 17 0 0 1 0 34h-24m24 0a18 18 0 0 1 0 36h-24"),
        'C' => (45.0, "m45-53c-3-11-11-17-22-17c-15 0-23 9-23 24v22c0 15 8 24 23 24c11 0 19-6 22-17"),
        'D' => (46.0, "v-70h20a26 26 0 0 1 26 26v18a26 26 0 0 1-26 26z"),
        'E' => (40.0, "m40 0h-40v-70h40m-40 34h34"),
        'F' => (38.0, "v-70h38m-38 34h32"),
        'G' => (46.0, "m45-54c-3-10-11-16-22-16c-15 0-23 9-23 24v22c0 15 8 24 23 24c14 0 23-8 23-22v-12h-20"),
        'H' => (46.0, "v-70m46 0v70m-46-36h46"),
        'I' => (0.0, "v-70"),
        'J' => (34.0, "m0-18a17 18 0 0 0 34 0v-52"),
        'K' => (44.0, "v-70m42 0l-42 42m16-16l28 44"),
        'L' => (36.0, "m0-70v70h36"),
        'M' => (56.0, "v-70l28 44l28-44v70"),
        'N' => (46.0, "v-70l46 70v-70"),
        'O' => (48.0, "m0-46c0-15 9-24 24-24s24 9 24 24v22c0 15-9 24-24 24s-24-9-24-24z"),
        'P' => (43.0, "v-70h24a19 19 0 0 1 0 38h-24"),
        'Q' => (50.0, "m0-46c0-15 9-24 24-24s24 9 24 24v22c0 15-9 24-24 24s-24-9-24-24zm28 30l22 20"),
        'R' => (43.0, "v-70h24a19 19 0 0 1 0 38h-24m22 0l20 32"),
        'S' => (41.0, "m40-56c-2-9-9-14-19-14c-12 0-20 7-20 17c0 22 40 12 40 34c0 12-8 19-20 19c-11 0-18-5-21-15"),
        'T' => (44.0, "m0-70h44m-22 0v70"),
        'U' => (46.0, "m0-70v48a23 22 0 0 0 46 0v-48"),
        'V' => (48.0, "m0-70l24 70l24-70"),
        'W' => (68.0, "m0-70l17 70l17-58l17 58l17-70"),
        'X' => (44.0, "l44-70m-44 0l44 70"),
        'Y' => (46.0, "m0-70l23 36v34m0-34l23-36"),
        'Z' => (42.0, "m0-70h42l-42 70h42"),
        'a' => (36.0, "m3-40c3-7 9-10 16-10c11 0 17 6 17 17v33m0-29h-20a14.5 14.5 0 0 0 0 29h4c9 0 16-6 16-15"),
        'b' => (38.0, "m0-70v70m0-29a19 21 0 0 1 38 0v8a19 21 0 0 1-38 0"),
        'c' => (36.0, "m36-37c-3-8-9-13-17-13c-12 0-19 8-19 20v10c0 12 7 20 19 20c8 0 14-5 17-13"),
        'd' => (38.0, "m38-70v70m0-29a19 21 0 0 0-38 0v8a19 21 0 0 0 38 0"),
        'e' => (37.0, "m0-26h37c0-16-6-24-18-24c-12 0-19 8-19 21v8c0 13 7 21 19 21c8 0 14-3 17-11"),
        'f' => (23.0, "m24-70h-5c-7 0-11 4-11 12v58m-8-50h22"),
        'g' => (38.0, "m38-50v50c0 13-7 20-19 20c-7 0-13-2-16-8m35-41a19 21 0 0 0-38 0v8a19 21 0 0 0 38 0"),
        'h' => (36.0, "m0-70v70m0-31c0-12 7-19 18-19c12 0 18 7 18 19v31"),
        'i' => (0.0, "m0-50v50m0-69v1"),
        'j' => (6.0, "m6-50v56c0 9-4 14-12 14m12-89v1"),
        'k' => (36.0, "m0-70v70m34-50l-34 32m13-12l23 30"),
        'l' => (9.0, "m0-70v59c0 7 3 11 9 11"),
        'm' => (60.0, "m0-50v50m0-33c0-11 6-17 15-17c10 0 15 6 15 17v33m0-33c0-11 6-17 15-17c10 0 15 6 15 17v33"),
        'n' => (36.0, "m0-50v50m0-31c0-12 7-19 18-19c12 0 18 7 18 19v31"),
        'o' => (38.0, "m0-29a19 21 0 0 1 38 0v8a19 21 0 0 1-38 0z"),
        'p' => (38.0, "m0-50v70m0-49a19 21 0 0 1 38 0v8a19 21 0 0 1-38 0"),
        'q' => (38.0, "m38-50v70m0-49a19 21 0 0 0-38 0v8a19 21 0 0 0 38 0"),
        'r' => (19.0, "m0-50v50m0-30c0-13 6-20 17-20h3"),
        's' => (33.0, "m31-40c-2-7-8-10-15-10c-10 0-15 5-15 12c0 17 32 8 32 25c0 8-6 13-17 13c-8 0-14-4-16-11"),
        't' => (22.0, "m8-66v54c0 8 4 12 11 12h3m-22-50h21"),
        'u' => (36.0, "m0-50v31c0 12 6 19 18 19c11 0 18-7 18-19m0-31v50"),
        'v' => (38.0, "m0-50l19 50l19-50"),
        'w' => (56.0, "m0-50l14 50l14-42l14 42l14-50"),
        'x' => (34.0, "l34-50m-34 0l34 50"),
        'y' => (38.0, "m0-50l19 50m19-50l-19 50c-4 12-9 20-17 20"),
        'z' => (32.0, "m0-50h32l-32 50h32"),
        '0' => (42.0, "m0-46c0-15 7-24 21-24s21 9 21 24v22c0 15-7 24-21 24s-21-9-21-24z"),
        '1' => (42.0, "m8-56l18-14v70"),
        '2' => (42.0, "m1-52c1-11 8-18 20-18c12 0 20 7 20 18c0 9-6 15-12 21l-29 31h42"),
        '3' => (42.0, "m2-55c2-9 9-15 19-15c11 0 19 6 19 17c0 11-8 16-19 16c13 0 21 6 21 18c0 12-9 19-21 19c-11 0-19-6-21-16"),
        '4' => (42.0, "m32 0v-70l-32 52h42"),
        '5' => (42.0, "m38-70h-32l-3 32c4-4 10-7 17-7c13 0 22 8 22 22c0 14-9 23-22 23c-10 0-17-5-20-14"),
        '6' => (42.0, "m30-70c-18 16-30 30-30 48c0 14 9 22 21 22c12 0 21-8 21-22c0-13-9-21-21-21c-12 0-20 7-21 18"),
        '7' => (42.0, "m0-70h42l-25 70"),
        '8' => (42.0, "m21-38a18 16 0 0 1 0-32a18 16 0 0 1 0 32a21 19 0 0 0 0 38a21 19 0 0 0 0-38"),
        '9' => (42.0, "m12 0c18-16 30-30 30-48c0-14-9-22-21-22c-12 0-21 8-21 22c0 13 9 21 21 21c12 0 20-7 21-18"),
        '.' => (1.0, "m0-1h1"),
        ',' => (5.0, "m4-2l-4 14"),
        ':' => (1.0, "m0-1h1m-1-41h1"),
        ';' => (5.0, "m4-2l-4 14m3-54h1"),
        '!' => (1.0, "m0-70v48m0 21h1"),
        '?' => (34.0, "m0-54c1-10 7-16 17-16c10 0 17 6 17 16c0 14-17 16-17 30v3m0 20h1"),
        '\'' | '’' => (0.0, "m0-72v16"),
        '"' => (14.0, "m0-72v16m14-16v16"),
        '-' => (24.0, "m0-28h24"),
        '–' | '−' => (36.0, "m0-28h36"),
        '—' => (60.0, "m0-28h60"),
        '_' => (44.0, "m0 12h44"),
        '+' => (36.0, "m0-30h36m-18-18v36"),
        '=' => (36.0, "m0-38h36m-36 16h36"),
        '±' => (36.0, "m0-38h36m-18-16v32m-18 14h36"),
        '×' => (28.0, "m0-44l28 28m0-28l-28 28"),
        '*' => (28.0, "m14-70v32m-14-24l28 16m0-16l-28 16"),
        '/' => (28.0, "m0 8l28-84"),
        '\\' => (28.0, "m0-76l28 84"),
        '|' => (0.0, "m0-78v94"),
        '(' => (12.0, "m12-80c-16 26-16 68 0 94"),
        ')' => (12.0, "m0-80c16 26 16 68 0 94"),
        '[' => (13.0, "m13-80h-13v94h13"),
        ']' => (13.0, "m0-80h13v94h-13"),
        '{' => (18.0, "m18-80c-10 0-10 4-10 12v22c0 8-2 12-8 13c6 1 8 5 8 13v22c0 8 0 12 10 12"),
        '}' => (18.0, "m0-80c10 0 10 4 10 12v22c0 8 2 12 8 13c-6 1-8 5-8 13v22c0 8 0 12-10 12"),
        '<' => (32.0, "m32-52l-32 22l32 22"),
        '>' => (32.0, "m0-52l32 22l-32 22"),
        '≤' => (32.0, "m32-60l-32 20l32 20m-32 20h32"),
        '≥' => (32.0, "m0-60l32 20l-32 20m0 20h32"),
        '→' => (54.0, "m0-28h54m-16-16l16 16l-16 16"),
        '%' => (58.0, "m0-55a13 15 0 0 1 26 0a13 15 0 0 1-26 0m6 55l46-70m-20 55a13 15 0 0 1 26 0a13 15 0 0 1-26 0"),
        '&' => (50.0, "m50 0l-36-44c-8-12-2-26 11-26c12 0 18 12 10 22c-8 9-35 14-35 30c0 11 8 18 19 18c16 0 26-12 27-28"),
        '#' => (46.0, "m8 0l10-70m20 0l-10 70m-26-46h44m-2 24h-44"),
        '@' => (64.0, "m48-20v-28m0 14a15 15 0 1 0-4 12c6 8 20 4 20-14c0-20-14-34-32-34a32 34 0 0 0 0 68c8 0 14-2 18-5"),
        '$' => (41.0, "m40-54c-2-8-9-12-19-12c-12 0-20 6-20 15c0 20 40 12 40 31c0 11-8 16-20 16c-11 0-18-4-21-13m21-61v86"),
        '^' => (28.0, "m0-50l14-20l14 20"),
        '~' => (36.0, "m0-24c6-16 14-10 18-6s12 8 18-6"),
        '`' => (10.0, "m0-74l10 12"),
        '°' => (22.0, "m0-59a11 11 0 0 1 22 0a11 11 0 0 1-22 0"),
        '·' => (1.0, "m0-28h1"),
        '²' => (22.0, "m0-62c1-6 5-9 11-9c6 0 10 4 10 9c0 8-10 12-21 24h22"),
        '…' => (37.0, "m0-1h1m17 0h1m17 0h1"),
        'α' => (42.0, "m42-50c-6 26-12 50-25 50c-11 0-17-8-17-25s6-25 17-25c13 0 17 30 25 50"),
        'β' => (38.0, "m0 20v-70c0-13 7-20 17-20c10 0 17 6 17 16c0 11-7 16-19 16c15 0 23 6 23 19c0 12-8 19-20 19c-8 0-14-3-18-8"),
        'δ' => (38.0, "m33-66c-20-8-30 0-24 10c10 14 29 16 29 36c0 13-7 20-19 20s-19-8-19-21c0-14 10-22 22-22"),
        'κ' => (34.0, "m0-50v50m32-50l-32 29m11-10l23 31"),
        'µ' | 'μ' => (36.0, "m0-50v70m0-39c0 12 6 19 18 19c11 0 18-7 18-19m0-31v50"),
        'ρ' => (38.0, "m0 20v-49a19 21 0 0 1 38 0v8a19 21 0 0 1-38 0"),
        'σ' => (42.0, "m42-50h-23c-12 0-19 8-19 21v8c0 13 7 21 19 21s19-8 19-21v-8c0-13-8-21-19-21"),
        'τ' => (34.0, "m0-50h34m-17 0v38c0 8 4 12 12 12"),
        _ => (36.0, "v-70h36v70z"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_printable_ascii_letter_is_drawn() {
        let missing = glyph('\u{2603}');
        for c in ' '..='~' {
            assert_ne!(glyph(c), missing, "{c}");
        }
    }

    #[test]
    fn wraps_at_spaces() {
        let text = Lettering::new(10.0, PAGE);
        let width_px = text.width_px("ab cd");
        assert_eq!(text.wrapped("ab cd  ef", width_px), ["ab cd", "ef"]);
        assert_eq!(text.wrapped("abcdefghij k", 1.0), ["abcdefghij", "k"]);
    }
}
