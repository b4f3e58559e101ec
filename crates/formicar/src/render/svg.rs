//! The drawing core: SVG elements, outlines and text.

use super::markup::{Element, Markup, write_number};
use super::palette::{Color, PAGE};
use super::style::Dash;
use crate::geometry::Point2;

/// How words are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Letters {
    /// As strokes: the same on every machine, and no font is needed.
    #[default]
    Strokes,
    /// As text in the reader's font, which a browser can search.
    Font,
}

/// Part of an SVG document: elements in painting order. Elements with a number that is not finite
/// are left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Svg {
    body: Markup,
    pub(super) letters: Letters,
}

impl Svg {
    /// A part whose words are drawn in a way.
    pub(super) fn with_letters(letters: Letters) -> Self {
        Self {
            letters,
            ..Self::default()
        }
    }

    /// Appends an element.
    pub(super) fn add(&mut self, element: &Element) {
        self.body.add(element);
    }

    /// Appends an element around others.
    pub(super) fn wrap(&mut self, element: &Element, inner: &Self) {
        self.body.wrap(element, &inner.body);
    }

    /// Appends an element around words.
    pub(super) fn words(&mut self, element: &Element, words: &str) {
        self.body.words(element, words);
        self.body.end_line();
    }

    /// Appends everything of another part.
    pub(super) fn append(&mut self, other: &Self) {
        self.body.raw(other.body.as_str());
    }

    /// The elements as a document on a page of a size. `title` and `description` are read out, not
    /// drawn.
    pub(super) fn document(&self, size: Point2, title: &str, description: &str) -> String {
        let (width_px, height_px) = (size.x.ceil(), size.y.ceil());
        let root = Element::new("svg")
            .text("xmlns", "http://www.w3.org/2000/svg")
            .number("width", width_px)
            .number("height", height_px)
            .text("viewBox", &format!("0 0 {width_px} {height_px}"))
            .text("fill", "none")
            .text("stroke-linecap", "round")
            .text("stroke-linejoin", "round");
        let root = match self.letters {
            Letters::Strokes => root,
            Letters::Font => root
                .text("font-family", "system-ui, sans-serif")
                .text("role", "img"),
        };
        let mut page = Self::default();
        page.words(&Element::new("title"), title);
        page.words(&Element::new("desc"), description);
        page.add(&Element::rectangle(Point2::default(), size).fill(PAGE));
        page.append(self);
        let mut document = Markup::default();
        document.wrap(&root, &page.body);
        document.as_str().to_owned()
    }

    /// The elements as text.
    #[cfg(test)]
    pub(super) fn as_str(&self) -> &str {
        self.body.as_str()
    }
}

impl Element {
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

    pub(super) fn fill(self, color: Color) -> Self {
        self.text("fill", &color.to_string())
    }

    pub(super) fn pen(self, color: Color, width_px: f64) -> Self {
        self.text("stroke", &color.to_string())
            .number("stroke-width", width_px)
    }

    pub(super) fn dashed(self, dash: Dash) -> Self {
        match dash.pattern() {
            None => self,
            Some(pattern) => self
                .text("stroke-dasharray", pattern)
                .text("stroke-linecap", "butt"),
        }
    }

    /// A linear map of the element: the images of both unit vectors, and of the origin.
    pub(super) fn matrix(self, x: Point2, y: Point2, origin: Point2) -> Self {
        let numbers = [x.x, x.y, y.x, y.y, origin.x, origin.y];
        let words = numbers.map(|n| {
            let digits = format!("{n:.6}");
            digits
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned()
        });
        self.only_if(numbers.iter().all(|n| n.is_finite()))
            .text("transform", &format!("matrix({})", words.join(" ")))
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
