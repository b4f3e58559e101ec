//! 0/1 matrices as text or CSV, the way papers and MATLAB print bare grids.

use super::table::{RowsFromTop, lines, occupied_from_top};
use super::{FormatError, FormatProblem};
use crate::map::{OCCUPIED, OccupancyGrid};

/// Reads a matrix of 0 (free) and 1 (occupied), first row on top, origin (0, 0, 0).
///
/// Values stand apart by blanks, tabs, commas or semicolons, or a row is one word of digits
/// (`0110`). Numbers may be written as reals (`1.0`, `0e0`). Empty lines are skipped.
///
/// # Errors
/// Other values, rows of unequal length, no rows, or a bad resolution.
///
/// ```
/// use formicar::map::format::parse_matrix;
///
/// let map = parse_matrix("0 0 1\n0 0 0\n", 0.5)?;
/// assert_eq!((map.frame().n_cols(), map.lethal_cells().count()), (3, 1));
/// let error = parse_matrix("0 0 1\n0 0\n", 0.5).unwrap_err();
/// assert!(error.to_string().contains("line 2"));
/// # Ok::<(), formicar::map::format::FormatError>(())
/// ```
pub fn parse_matrix(text: &str, resolution_m: f64) -> Result<OccupancyGrid, FormatError> {
    let mut rows = RowsFromTop::default();
    for (place, line) in lines(text).filter(|(_, line)| !line.trim().is_empty()) {
        let line = line.trim();
        let added = if line.bytes().all(|b| b.is_ascii_digit()) {
            rows.push(line.split("").filter(|digit| !digit.is_empty()).map(value))
        } else {
            rows.push(values(line).map(value))
        };
        added.map_err(|e| e.at(place))?;
    }
    if rows.n_rows() == 0 {
        let expected = "rows of 0 and 1";
        return Err(FormatProblem::Empty { expected }.into());
    }
    rows.into_grid(resolution_m)
}

/// A matrix as text: rows of `0` and `1` with blanks between them. It keeps neither resolution
/// nor origin.
///
/// # Errors
/// Unknown or graded cells, which a 0/1 matrix cannot hold.
pub fn to_text_matrix(grid: &OccupancyGrid) -> Result<String, FormatError> {
    to_matrix(grid, ' ')
}

/// A matrix as comma-separated values; else as [`to_text_matrix`].
///
/// # Errors
/// As [`to_text_matrix`].
pub fn to_csv_matrix(grid: &OccupancyGrid) -> Result<String, FormatError> {
    to_matrix(grid, ',')
}

/// The words of a line: one between any two commas or semicolons, or between blanks.
pub(super) fn values(line: &str) -> impl Iterator<Item = &str> {
    let marks = |c| c == ',' || c == ';';
    let by_marks = line.contains(marks);
    // A mark at the end of a line closes it rather than announcing an empty value.
    let line = line.strip_suffix(marks).unwrap_or(line);
    let blank = move |c: char| c.is_whitespace();
    line.split(move |c| if by_marks { marks(c) } else { blank(c) })
        .map(str::trim)
        .filter(move |word| by_marks || !word.is_empty())
}

fn value(word: &str) -> Result<bool, FormatError> {
    match word.parse::<f64>() {
        Ok(0.0) => Ok(false),
        Ok(1.0) => Ok(true),
        _ => Err(FormatProblem::bad_value("a cell", word, "0 (free) or 1 (occupied)").into()),
    }
}

fn to_matrix(grid: &OccupancyGrid, separator: char) -> Result<String, FormatError> {
    let mut text = String::with_capacity(2 * grid.frame().n_cells());
    for row in occupied_from_top(grid, "a 0/1 matrix")? {
        for (col, &value) in row.iter().enumerate() {
            if col > 0 {
                text.push(separator);
            }
            text.push(if value == OCCUPIED { '1' } else { '0' });
        }
        text.push('\n');
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        parse_matrix(text, 1.0).unwrap_err().to_string()
    }

    #[test]
    fn reads_every_spelling() {
        let grid = OccupancyGrid::from_rows(&[".#.", "##."], 2.0).unwrap();
        let spellings = [
            "0 1 0\n1 1 0\n",
            "010\r\n110\r\n\r\n",
            "0,1,0\n1,1,0",
            "0; 1; 0;\n1; 1; 0;\n",
            "\n  0\t1\t0\n  1\t1\t0",
            "0.0 1e0 0\n1.000 1 0.",
        ];
        for text in spellings {
            assert_eq!(parse_matrix(text, 2.0).unwrap(), grid, "{text:?}");
        }
        assert_eq!(to_text_matrix(&grid).unwrap(), "0 1 0\n1 1 0\n");
        assert_eq!(to_csv_matrix(&grid).unwrap(), "0,1,0\n1,1,0\n");
    }

    #[test]
    fn says_what_is_wrong() {
        assert!(message("0 1\n0 2\n").contains("line 2: a cell is 2; it must be 0 (free) or 1"));
        assert!(
            message("0 1\n0\n").contains("line 2: 1 cells in this row; the row above it has 2")
        );
        assert!(message("0,,1").contains("a cell is empty"));
        assert!(message("#.#").contains("a cell is #.#"));
        assert!(message("0 nan").contains("a cell is nan"));
        assert!(message(" \n\n").contains("the file is empty"));
    }
}
