//! Portable graymaps: plain (P2) and raw (P5).

use super::grey_image::{GreyImage, check_size};
use super::{FormatError, FormatProblem, Place};

/// Reads P2 or P5, with comments and any maximal value from 1 to 65535.
pub(super) fn read(bytes: &[u8]) -> Result<GreyImage, FormatError> {
    let mut scanner = Scanner { bytes, offset: 2 };
    let n_cols = scanner.number("the width")?;
    let n_rows = scanner.number("the height")?;
    let at_max = scanner.offset;
    let max_value = u16::try_from(scanner.number("the maximal grey value")?)
        .ok()
        .filter(|&v| v > 0)
        .ok_or_else(|| {
            let thing = "the maximal grey value";
            FormatProblem::bad_value(thing, "0 or above 65535", "1 to 65535")
                .at(Place::Byte(at_max))
        })?;
    check_size(n_cols, n_rows)?;
    let n_cells = n_cols * n_rows;
    let values = if bytes[1] == b'2' {
        plain_values(&mut scanner, n_cells)?
    } else {
        raw_values(&scanner, n_cells, max_value)?
    };
    // The largest value is found many at a time, the first that is too large is not.
    let is_too_large = values.iter().max() > Some(&max_value);
    let too_large = || values.iter().position(|&v| v > max_value);
    if let Some(i) = is_too_large.then(too_large).flatten() {
        let expected = format!("at most {max_value}, the file's own maximum");
        return Err(
            FormatProblem::bad_value("a grey value", values[i], expected).at(Place::Value(i + 1)),
        );
    }
    Ok(GreyImage {
        n_cols,
        n_rows,
        max_value,
        values,
        transparent: None,
    })
}

/// Writes 8-bit P5; `values` are rows from the top.
pub(super) fn write(n_cols: usize, n_rows: usize, values: &[u8]) -> Vec<u8> {
    let mut bytes = format!("P5\n{n_cols} {n_rows}\n255\n").into_bytes();
    bytes.extend_from_slice(values);
    bytes
}

fn plain_values(scanner: &mut Scanner<'_>, n_cells: usize) -> Result<Vec<u16>, FormatError> {
    // Each value takes a digit and a space, so that a lying header allocates nothing.
    let n_left = scanner.bytes.len() - scanner.offset;
    if n_left < 2 * n_cells {
        check_count("values", n_left / 2, n_cells)?;
    }
    let mut values = Vec::with_capacity(n_cells);
    while scanner.skip_blank() {
        let at = Place::Byte(scanner.offset);
        let value = scanner.number("a grey value")?;
        if values.len() == n_cells {
            let unit = "or more values";
            return Err(FormatProblem::Trailing { unit, n_extra: 1 }.at(at));
        }
        values.push(u16::try_from(value).map_err(|_| {
            FormatProblem::bad_value("a grey value", value, "at most 65535").at(at)
        })?);
    }
    check_count("values", values.len(), n_cells)?;
    Ok(values)
}

fn raw_values(
    scanner: &Scanner<'_>,
    n_cells: usize,
    max_value: u16,
) -> Result<Vec<u16>, FormatError> {
    // One blank ends the header; whatever follows is data.
    let mut data = scanner.bytes.get(scanner.offset + 1..).unwrap_or(&[]);
    let n_bytes = if max_value > 255 {
        2 * n_cells
    } else {
        n_cells
    };
    // But a CR LF that leaves all of the data is one end of a line, as text editors write it.
    let ends_with_cr_lf = scanner.bytes[scanner.offset..].starts_with(b"\r\n");
    if ends_with_cr_lf && data.len() > n_bytes {
        data = &data[1..];
        if !data[n_bytes..].trim_ascii().is_empty() {
            let (found, needed) = (data.len(), n_bytes);
            return Err(FormatProblem::CopiedAsText { found, needed }.into());
        }
    }
    check_count("bytes of image data", data.len(), n_bytes)?;
    let (data, rest) = data.split_at(n_bytes);
    if !rest.trim_ascii().is_empty() {
        let n_extra = rest.len();
        let unit = "bytes";
        return Err(FormatProblem::Trailing { unit, n_extra }
            .at(Place::Byte(scanner.bytes.len() - n_extra)));
    }
    Ok(if max_value > 255 {
        data.chunks_exact(2)
            .map(|pair| u16::from_be_bytes([pair[0], pair[1]]))
            .collect()
    } else {
        data.iter().map(|&v| u16::from(v)).collect()
    })
}

fn check_count(unit: &'static str, found: usize, needed: usize) -> Result<(), FormatError> {
    if found >= needed {
        return Ok(());
    }
    Err(FormatProblem::Truncated {
        unit,
        found,
        needed,
    }
    .into())
}

struct Scanner<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl Scanner<'_> {
    /// Moves to the next byte that is neither blank nor comment; false at the end.
    fn skip_blank(&mut self) -> bool {
        while let Some(&byte) = self.bytes.get(self.offset) {
            if byte == b'#' {
                let rest = &self.bytes[self.offset..];
                let line = rest.iter().position(|&b| b == b'\n' || b == b'\r');
                self.offset += line.unwrap_or(rest.len());
            } else if byte.is_ascii_whitespace() {
                self.offset += 1;
            } else {
                return true;
            }
        }
        false
    }

    fn number(&mut self, thing: &'static str) -> Result<usize, FormatError> {
        if !self.skip_blank() {
            let hint = "the file ends before it";
            return Err(FormatProblem::Missing { thing, hint }.at(Place::Byte(self.offset)));
        }
        let rest = &self.bytes[self.offset..];
        let end = rest
            .iter()
            .position(|&b| b.is_ascii_whitespace() || b == b'#');
        let token = String::from_utf8_lossy(&rest[..end.unwrap_or(rest.len()).min(40)]);
        let number = token
            .bytes()
            .all(|b| b.is_ascii_digit())
            .then(|| token.parse().ok())
            .flatten();
        let number = number.ok_or_else(|| {
            FormatProblem::bad_value(thing, &token, "a whole number that is not negative")
                .at(Place::Byte(self.offset))
        })?;
        self.offset += token.len();
        Ok(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(bytes: &[u8]) -> String {
        read(bytes).unwrap_err().to_string()
    }

    #[test]
    fn reads_plain_and_raw_with_comments() {
        let plain =
            read(b"P2 # made by hand\n# 3 columns\n3 2\n15\n0 7 15\n1 2 3 # end\n").unwrap();
        assert_eq!((plain.n_cols, plain.n_rows, plain.max_value), (3, 2, 15));
        assert_eq!(plain.values, [0, 7, 15, 1, 2, 3]);
        let raw = read(b"P5\n#\n3\t2\r15\n\x00\x07\x0f\x01\x02\x03").unwrap();
        assert_eq!(raw, plain);
        let deep = read(b"P5 2 1 1000 \x01\x00\x03\xe8").unwrap();
        assert_eq!(deep.values, [256, 1000]);
    }

    #[test]
    fn a_blank_first_pixel_is_data() {
        assert_eq!(read(b"P5 2 1 255\n\n ").unwrap().values, [10, 32]);
    }

    #[test]
    fn headers_with_cr_lf_do_not_shift_the_image() {
        for bytes in [
            &b"P5\r\n2 2\r\n255\r\nabcd"[..],
            b"P5\r\n# made on Windows\r\n2 2\r\n255\r\nabcd\n",
            b"P5\n2 2\n255\nabcd",
        ] {
            assert_eq!(read(bytes).unwrap().values, [97, 98, 99, 100]);
        }
        // The last pixel is a blank: what follows is no blank behind a shifted image.
        let blank = read(b"P5\r\n2 2\r\n255\r\nabc\n").unwrap();
        assert_eq!(blank.values, [97, 98, 99, 10]);
        // The first pixel is a line feed.
        let first = read(b"P5\r2 2\r255\r\nbcd").unwrap();
        assert_eq!(first.values, [10, 98, 99, 100]);
        let text = message(b"P5\r\n2 2\r\n255\r\na\r\nb\r\nc");
        assert!(
            text.contains("7 bytes") && text.contains("copy it as binary"),
            "{text}"
        );
    }

    #[test]
    fn says_what_is_wrong() {
        assert!(message(b"P5 2 2 255\nab").contains("2 bytes of image data, but 4"));
        assert!(message(b"P5 2 1 255\nabc").contains("1 bytes too many"));
        assert!(message(b"P5 2 1 3\na\x01").contains("at most 3"));
        assert!(message(b"P5 2 1 70000\n").contains("65535"));
        assert!(message(b"P5 2 1 0\n").contains("1 to 65535"));
        assert!(message(b"P5 -2 1 255\n").contains("the width is -2"));
        assert!(message(b"P5 0 1 255\n").contains("0 x 1 cells"));
        assert!(message(b"P5 2").contains("the height is missing"));
        assert!(message(b"P2 2 1 9\n1 2 3 4").contains("too many"));
        assert!(message(b"P2 2 2 9\n1 2 x 4").contains("a grey value is x"));
    }

    #[test]
    fn refuses_sizes_beyond_any_map_before_allocating() {
        assert!(message(b"P5 1000000000 1000000000 255\n").contains("the limit is"));
        assert!(message(b"P2 99999999999999999999 1 255\n").contains("the width"));
        assert!(message(b"P2 16000 16000 255\n1").contains("256000000 are needed"));
    }
}
