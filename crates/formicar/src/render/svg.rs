//! The drawing core: SVG elements with escaped text and short numbers.

use super::palette::Color;
use crate::geometry::Point2;
use std::fmt::Write;

/// Part of an SVG document: elements in painting order.
#[derive(Clone, Debug, Default)]
pub(super) struct Svg {
    text: String,
}

impl Svg {
    /// Appends an element; one with a number that is not finite is left out.
    pub(super) fn add(&mut self, element: &Element) {
        if element.finite {
            let (name, attributes) = (element.name, &element.attributes);
            let _ = writeln!(self.text, "<{name}{attributes}/>");
        }
    }

    /// Appends an element around others; left out as a whole where `element` is.
    pub(super) fn wrap(&mut self, element: &Element, inner: &Self) {
        if element.finite {
            let (name, attributes) = (element.name, &element.attributes);
            let _ = writeln!(self.text, "<{name}{attributes}>\n{}</{name}>", inner.text);
        }
    }

    /// Appends everything of another part.
    pub(super) fn append(&mut self, other: &Self) {
        self.text.push_str(&other.text);
    }

    /// Appends text that every reader of the document sees, without drawing it.
    pub(super) fn describe(&mut self, name: &'static str, words: &str) {
        let _ = writeln!(self.text, "<{name}>{}</{name}>", escaped(words));
    }

    /// The elements as text.
    pub(super) fn as_str(&self) -> &str {
        &self.text
    }
}

/// One element before it is appended.
#[derive(Clone, Debug)]
pub(super) struct Element {
    name: &'static str,
    attributes: String,
    finite: bool,
}

impl Element {
    pub(super) fn new(name: &'static str) -> Self {
        Self {
            name,
            attributes: String::new(),
            finite: true,
        }
    }

    /// A disc or ring.
    pub(super) fn circle(center: Point2, radius_px: f64) -> Self {
        Self::new("circle")
            .number("cx", center.x)
            .number("cy", center.y)
            .number("r", radius_px)
    }

    /// An upright rectangle.
    pub(super) fn rectangle(low: Point2, size: Point2) -> Self {
        Self::new("rect")
            .number("x", low.x)
            .number("y", low.y)
            .number("width", size.x)
            .number("height", size.y)
    }

    /// A straight line.
    pub(super) fn line(from: Point2, to: Point2) -> Self {
        Self::path(PathData::polyline([from, to]))
    }

    /// Any outline.
    pub(super) fn path(path: PathData) -> Self {
        let PathData { data, .. } = path;
        Self::new("path").text("d", &data)
    }

    /// The same attributes under another name.
    pub(super) fn rename(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    pub(super) fn number(mut self, name: &str, value: f64) -> Self {
        self.finite &= value.is_finite();
        let _ = write!(self.attributes, " {name}=\"");
        write_number(&mut self.attributes, value);
        self.attributes.push('"');
        self
    }

    pub(super) fn text(mut self, name: &str, value: &str) -> Self {
        let _ = write!(self.attributes, " {name}=\"{}\"", escaped(value));
        self
    }

    pub(super) fn fill(self, color: Color) -> Self {
        self.text("fill", &color.to_string())
    }

    pub(super) fn pen(self, color: Color, width_px: f64) -> Self {
        self.text("stroke", &color.to_string())
            .number("stroke-width", width_px)
    }

    /// A linear map of the element: the images of both unit vectors, and of the origin.
    pub(super) fn matrix(mut self, x: Point2, y: Point2, origin: Point2) -> Self {
        let numbers = [x.x, x.y, y.x, y.y, origin.x, origin.y];
        self.finite &= numbers.iter().all(|n| n.is_finite());
        let words = numbers.map(|n| {
            let digits = format!("{n:.6}");
            digits
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned()
        });
        self.text("transform", &format!("matrix({})", words.join(" ")))
    }
}

/// The outline of a path element; a point that is not finite lifts the pen.
#[derive(Clone, Debug, Default)]
pub(super) struct PathData {
    data: String,
    pen_down: bool,
}

impl PathData {
    /// Straight lines through the points.
    pub(super) fn polyline(points: impl IntoIterator<Item = Point2>) -> Self {
        let mut path = Self::default();
        points.into_iter().for_each(|p| path.line_to(p));
        path
    }

    /// A closed outline, appended to what is there.
    pub(super) fn polygon(&mut self, points: impl IntoIterator<Item = Point2>) {
        self.pen_down = false;
        points.into_iter().for_each(|p| self.line_to(p));
        self.data.push('z');
        self.pen_down = false;
    }

    /// Starts anew at a point.
    pub(super) fn move_to(&mut self, point: Point2) {
        self.pen_down = false;
        self.line_to(point);
    }

    /// A straight line, or the first point.
    pub(super) fn line_to(&mut self, point: Point2) {
        if !point.is_finite() {
            self.pen_down = false;
            return;
        }
        self.data.push(if self.pen_down { 'L' } else { 'M' });
        self.write_point(point);
        self.pen_down = true;
    }

    /// An arc of less than half a turn; `turn` is positive where it turns clockwise on the page.
    pub(super) fn arc_to(&mut self, radius_px: f64, turn: f64, point: Point2) {
        if !(self.pen_down && point.is_finite() && radius_px.is_finite()) {
            return self.line_to(point);
        }
        self.data.push('A');
        self.write_point(Point2::new(radius_px, radius_px));
        self.data
            .push_str(if turn > 0.0 { " 0 0 1 " } else { " 0 0 0 " });
        self.write_point(point);
    }

    /// Data written in the language of paths, relative to a point.
    pub(super) fn relative(&mut self, origin: Point2, data: &str) {
        self.move_to(origin);
        if self.pen_down {
            self.data.push_str(data);
        }
    }

    fn write_point(&mut self, point: Point2) {
        write_number(&mut self.data, point.x);
        self.data.push(' ');
        write_number(&mut self.data, point.y);
    }
}

/// Writes a number with at most two decimals; far beyond any page, it stops at a million.
fn write_number(out: &mut String, value: f64) {
    let hundredths = (value.clamp(-1e6, 1e6) * 100.0).round() as i64;
    let sign = if hundredths < 0 { "-" } else { "" };
    let (whole, rest) = (hundredths.abs() / 100, hundredths.abs() % 100);
    let _ = match (rest, rest % 10) {
        (0, _) => write!(out, "{sign}{whole}"),
        (_, 0) => write!(out, "{sign}{whole}.{}", rest / 10),
        _ => write!(out, "{sign}{whole}.{rest:02}"),
    };
}

/// Text as it may stand in an attribute or between tags; what XML cannot hold becomes U+FFFD.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> String {
        let mut out = String::new();
        write_number(&mut out, value);
        out
    }

    #[test]
    fn numbers_are_short() {
        let cases = [
            (1.0, "1"),
            (-0.001, "0"),
            (2.5, "2.5"),
            (-3.146, "-3.15"),
            (0.05, "0.05"),
            (1e300, "1000000"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn leaves_out_what_is_no_number() {
        let mut svg = Svg::default();
        svg.add(&Element::circle(Point2::new(f64::NAN, 0.0), 1.0));
        svg.wrap(
            &Element::new("g").number("x", f64::INFINITY),
            &Svg::default(),
        );
        assert_eq!(svg.as_str(), "");
        let (a, b) = (Point2::default(), Point2::new(0.0, f64::NAN));
        assert_eq!(PathData::polyline([a, b, a, a]).data, "M0 0M0 0L0 0");
    }

    #[test]
    fn escapes_text() {
        let mut svg = Svg::default();
        svg.add(&Element::new("a").text("b", "<\"&\u{1}\n>"));
        assert_eq!(svg.as_str(), "<a b=\"&lt;&quot;&amp;\u{fffd} &gt;\"/>\n");
    }
}
