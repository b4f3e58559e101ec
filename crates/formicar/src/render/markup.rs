//! Markup for pictures and pages: elements, attributes and escaped text.

use std::fmt::Write;

/// Text as it may stand in an attribute or between tags of XML and HTML; characters that XML cannot
/// hold become U+FFFD.
///
/// ```
/// assert_eq!(formicar::render::escape("a < \"b\""), "a &lt; &quot;b&quot;");
/// ```
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(c),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(c),
        }
    }
    out
}

/// An HTML page with its style sheet in it, in the light or dark scheme of its reader. `write`
/// appends the body.
pub fn html_page(title: &str, style: &str, write: impl FnOnce(&mut Markup)) -> String {
    let mut page = Markup::default();
    page.raw("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    page.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    page.raw("<meta name=\"color-scheme\" content=\"light dark\">\n");
    // Without an icon of its own a browser asks the server for one.
    page.raw("<link rel=\"icon\" href=\"data:,\">\n");
    page.words(&Element::new("title"), title);
    page.raw(&format!("\n<style>\n{style}</style>\n</head>\n<body>\n"));
    write(&mut page);
    page.raw("</body>\n</html>\n");
    page.text
}

/// An element with its attributes, before it is appended to a document.
#[derive(Clone, Debug)]
pub struct Element {
    name: &'static str,
    attributes: String,
    is_finite: bool,
}

impl Element {
    /// An element without attributes.
    pub fn new(name: &'static str) -> Self {
        Self {
            name,
            attributes: String::new(),
            is_finite: true,
        }
    }

    /// Adds an attribute; line breaks in its value become spaces.
    #[must_use]
    pub fn text(mut self, name: &str, value: &str) -> Self {
        let value = escape(value).replace(['\t', '\n', '\r'], " ");
        let _ = write!(self.attributes, " {name}=\"{value}\"");
        self
    }

    /// An element of a class of the style sheet.
    pub fn of_class(name: &'static str, class: &str) -> Self {
        Self::new(name).text("class", class)
    }

    /// Adds a number with at most two decimals. An element with a number that is not finite is
    /// left out of its document.
    #[must_use]
    pub fn number(mut self, name: &str, value: f64) -> Self {
        self.is_finite &= value.is_finite();
        let _ = write!(self.attributes, " {name}=\"");
        write_number(&mut self.attributes, value);
        self.attributes.push('"');
        self
    }

    /// The same attributes under another name.
    pub(super) fn rename(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// Leaves the element out of its document unless the condition holds.
    pub(super) fn only_if(mut self, is_finite: bool) -> Self {
        self.is_finite &= is_finite;
        self
    }
}

/// A document or a part of one: elements and text in order.
#[derive(Clone, Debug, Default)]
pub struct Markup {
    text: String,
}

impl Markup {
    /// Appends an element without contents, on a line of its own.
    pub fn add(&mut self, element: &Element) {
        if element.is_finite {
            let (name, attributes) = (element.name, &element.attributes);
            let _ = writeln!(self.text, "<{name}{attributes}/>");
        }
    }

    /// Appends an element around others, on lines of its own; left out as a whole where `element`
    /// is.
    pub fn wrap(&mut self, element: &Element, inner: &Self) {
        if element.is_finite {
            let (name, attributes) = (element.name, &element.attributes);
            let _ = writeln!(self.text, "<{name}{attributes}>\n{}</{name}>", inner.text);
        }
    }

    /// Appends an element around everything that `write` appends, in the same line; left out as a
    /// whole where `element` is.
    pub fn within(&mut self, element: &Element, write: impl FnOnce(&mut Self)) {
        if !element.is_finite {
            return;
        }
        let (name, attributes) = (element.name, &element.attributes);
        let _ = write!(self.text, "<{name}{attributes}>");
        write(self);
        let _ = write!(self.text, "</{name}>");
    }

    /// Appends an element around words, in the same line.
    pub fn words(&mut self, element: &Element, words: &str) {
        self.within(element, |inner| inner.text(words));
    }

    /// Appends words; those between backticks are set as code.
    pub fn prose(&mut self, words: &str) {
        for (i, part) in words.split('`').enumerate() {
            match i % 2 {
                0 => self.text(part),
                _ => self.words(&Element::new("code"), part),
            }
        }
    }

    /// Appends escaped text.
    pub fn text(&mut self, words: &str) {
        self.text.push_str(&escape(words));
    }

    /// Appends markup as it is.
    pub fn raw(&mut self, markup: &str) {
        self.text.push_str(markup);
    }

    /// Ends a line.
    pub fn end_line(&mut self) {
        self.text.push('\n');
    }

    /// Everything so far.
    pub fn as_str(&self) -> &str {
        &self.text
    }
}

/// Writes a number with at most two decimals; far beyond any page, it stops at a million.
pub(super) fn write_number(out: &mut String, value: f64) {
    let hundredths = (value.clamp(-1e6, 1e6) * 100.0).round() as i64;
    let sign = if hundredths < 0 { "-" } else { "" };
    let (whole, rest) = (hundredths.abs() / 100, hundredths.abs() % 100);
    let _ = match (rest, rest % 10) {
        (0, _) => write!(out, "{sign}{whole}"),
        (_, 0) => write!(out, "{sign}{whole}.{}", rest / 10),
        _ => write!(out, "{sign}{whole}.{rest:02}"),
    };
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
    fn escapes_text() {
        let mut markup = Markup::default();
        markup.add(&Element::new("a").text("b", "<\"&\u{1}\n>"));
        assert_eq!(markup.as_str(), "<a b=\"&lt;&quot;&amp;\u{fffd} &gt;\"/>\n");
    }

    #[test]
    fn text_is_escaped_and_elements_are_closed() {
        let mut page = Markup::default();
        let paragraph = Element::new("p").text("class", "a");
        page.words(&paragraph, "1 < 2 & \"so\"");
        page.within(&Element::new("b"), |inner| inner.raw("<i>x</i>"));
        assert_eq!(
            page.as_str(),
            "<p class=\"a\">1 &lt; 2 &amp; &quot;so&quot;</p><b><i>x</i></b>"
        );
    }
}
