//! The Moving AI Lab's grid maps and their scenarios (Sturtevant 2012, *Benchmarks for grid-based
//! pathfinding*).

use super::files::{MAX_MAP_BYTES, read_bytes, text};
use super::table::{RowsFromTop, lines, occupied_from_top};
use super::{FormatError, FormatProblem, Place};
use crate::map::{Cell, OCCUPIED, OccupancyGrid};
use std::fmt::Write;
use std::path::Path;

/// One line of a `.scen` file: a problem with its known optimum.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingAiScenario {
    /// Problems of similar length share a bucket.
    pub bucket: u32,
    /// The map as written; often a path in the benchmark's own folders.
    pub map: String,
    /// Width of the map, cells.
    pub n_cols: usize,
    /// Height of the map, cells.
    pub n_rows: usize,
    /// Start cell, row 0 at the bottom.
    pub start: Cell,
    /// Goal cell, row 0 at the bottom.
    pub goal: Cell,
    /// Shortest length in cells over straight and diagonal moves that cut no corner; printed with
    /// about six digits.
    pub optimal_length_cells: f64,
}

/// Reads the text of a `.map` file: `.`, `G` and `S` are free, `@`, `O`, `T` and `W` occupied.
///
/// # Errors
/// Another kind of file, other cells, rows that do not fit the header, or a bad resolution.
///
/// ```
/// use formicar::map::format::parse_movingai_map;
///
/// let map = parse_movingai_map("type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n", 1.0)?;
/// assert_eq!(map.lethal_cells().count(), 1);
/// # Ok::<(), formicar::map::format::FormatError>(())
/// ```
pub fn parse_movingai_map(text: &str, resolution_m: f64) -> Result<OccupancyGrid, FormatError> {
    let mut lines = lines(text);
    let (n_cols, n_rows) = header(&mut lines)?;
    super::grey_image::check_size(n_cols, n_rows)?;
    let mut rows = RowsFromTop::default();
    for (place, line) in lines {
        let line = line.trim_end();
        if rows.n_rows() == n_rows {
            if line.is_empty() {
                continue;
            }
            let (unit, n_extra) = ("or more rows", 1);
            return Err(FormatProblem::Trailing { unit, n_extra }.at(place));
        }
        if line.chars().count() != n_cols {
            let value = format!("{} cells long", line.chars().count());
            return Err(
                FormatProblem::bad_value("a row", value, format!("{n_cols}, the width")).at(place),
            );
        }
        rows.push(line.chars().map(is_occupied))
            .map_err(|e| e.at(place))?;
    }
    if rows.n_rows() < n_rows {
        return Err(FormatProblem::Truncated {
            unit: "rows",
            found: rows.n_rows(),
            needed: n_rows,
        }
        .into());
    }
    rows.into_grid(resolution_m)
}

/// The text of a `.map` file. The format keeps neither resolution nor origin.
///
/// # Errors
/// Unknown or graded cells, which the format cannot hold.
pub fn to_movingai_map(grid: &OccupancyGrid) -> Result<String, FormatError> {
    let frame = grid.frame();
    let (n_cols, n_rows) = (frame.n_cols(), frame.n_rows());
    let mut text = String::with_capacity((n_cols + 1) * n_rows + 60);
    let _ = write!(text, "type octile\nheight {n_rows}\nwidth {n_cols}\nmap\n");
    for row in occupied_from_top(grid, "a MovingAI map")? {
        text.extend(row.iter().map(|&v| if v == OCCUPIED { '@' } else { '.' }));
        text.push('\n');
    }
    Ok(text)
}

/// Reads a `.scen` file.
///
/// # Errors
/// A file that cannot be read, and whatever [`parse_movingai_scenarios`] refuses.
pub fn read_movingai_scenarios(path: &Path) -> Result<Vec<MovingAiScenario>, FormatError> {
    let bytes = read_bytes(path, MAX_MAP_BYTES)?;
    text(&bytes, "MovingAI scenarios")
        .and_then(parse_movingai_scenarios)
        .map_err(|e| e.in_file(path))
}

/// Reads the text of a `.scen` file.
///
/// # Errors
/// A first line other than `version 1`, lines without nine fields, or cells outside their map.
pub fn parse_movingai_scenarios(text: &str) -> Result<Vec<MovingAiScenario>, FormatError> {
    let mut lines = lines(text);
    let first = lines.next().map_or("", |(_, line)| line.trim());
    let version = first.strip_prefix("version").map(str::trim);
    if !matches!(version, Some("1" | "1.0")) {
        let magic = FormatProblem::wrong_magic(first.as_bytes(), "\"version 1\"");
        return Err(magic.at(Place::Line(1)));
    }
    lines
        .filter(|(_, line)| !line.trim().is_empty())
        .map(|(place, line)| scenario(line).map_err(|problem| problem.at(place)))
        .collect()
}

fn scenario(line: &str) -> Result<MovingAiScenario, FormatProblem> {
    // Names of maps may hold spaces where tabs separate the fields.
    let fields: Vec<&str> = if line.contains('\t') {
        line.split('\t').map(str::trim).collect()
    } else {
        line.split_whitespace().collect()
    };
    let [bucket, map, numbers @ ..] = fields.as_slice() else {
        return Err(FormatProblem::bad_value("a line", line, NINE_FIELDS));
    };
    let &[width, height, start_x, start_y, goal_x, goal_y, length] = numbers else {
        return Err(FormatProblem::bad_value("a line", line, NINE_FIELDS));
    };
    let n_cols = whole("the width", width)?;
    let n_rows = whole("the height", height)?;
    super::grey_image::check_size(n_cols, n_rows).map_err(FormatProblem::Map)?;
    let cell = |x, y| {
        let col = below("a column", x, n_cols)?;
        let from_top = below("a row", y, n_rows)?;
        Ok(Cell::new(col as u32, (n_rows - 1 - from_top) as u32))
    };
    let optimal_length_cells = length
        .parse()
        .ok()
        .filter(|l: &f64| l.is_finite() && *l >= 0.0)
        .ok_or_else(|| {
            FormatProblem::bad_value("the optimal length", length, "a number of at least 0")
        })?;
    Ok(MovingAiScenario {
        bucket: whole("the bucket", bucket)?
            .try_into()
            .map_err(|_| FormatProblem::bad_value("the bucket", bucket, "below 2^32"))?,
        map: (*map).to_owned(),
        n_cols,
        n_rows,
        start: cell(start_x, start_y)?,
        goal: cell(goal_x, goal_y)?,
        optimal_length_cells,
    })
}

const NINE_FIELDS: &str =
    "9 fields: bucket, map, width, height, start x and y, goal x and y, optimal length";

/// Width and height from the lines up to `map`.
fn header<'a>(
    lines: &mut impl Iterator<Item = (Place, &'a str)>,
) -> Result<(usize, usize), FormatError> {
    let first = lines.next().map_or("", |(_, line)| line.trim_end());
    if first.split_whitespace().ne(["type", "octile"]) {
        let magic = FormatProblem::wrong_magic(first.as_bytes(), "\"type octile\"");
        return Err(magic.at(Place::Line(1)));
    }
    let (mut n_cols, mut n_rows) = (None, None);
    for (place, line) in lines {
        let mut words = line.split_whitespace();
        let (key, value) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
        let size = |thing| whole(thing, value).map_err(|problem| problem.at(place));
        match key {
            "width" => n_cols = Some(size("the width")?),
            "height" => n_rows = Some(size("the height")?),
            "map" => break,
            _ => {
                let expected = "\"width\", \"height\" or \"map\"";
                return Err(FormatProblem::bad_value("the header line", line, expected).at(place));
            }
        }
    }
    let needed = |thing, size: Option<usize>| {
        let hint = "the lines width N and height N stand before the line map";
        size.ok_or(FormatProblem::Missing { thing, hint })
    };
    Ok((needed("the width", n_cols)?, needed("the height", n_rows)?))
}

fn is_occupied(cell: char) -> Result<bool, FormatError> {
    match cell {
        '.' | 'G' | 'S' => Ok(false),
        '@' | 'O' | 'T' | 'W' => Ok(true),
        other => {
            let expected = "one of . G S (free) and @ O T W (occupied)";
            Err(FormatProblem::bad_value("a cell", format!("{other:?}"), expected).into())
        }
    }
}

fn whole(thing: &'static str, text: &str) -> Result<usize, FormatProblem> {
    let number = text.parse();
    number.map_err(|_| FormatProblem::bad_value(thing, text, "a whole number of at least 0"))
}

fn below(thing: &'static str, text: &str, limit: usize) -> Result<usize, FormatProblem> {
    match whole(thing, text)? {
        number if number < limit => Ok(number),
        number => {
            let expected = format!("below {limit}, the size of the map");
            Err(FormatProblem::bad_value(thing, number, expected))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAP: &str = "type octile\r\nheight 2\r\nwidth 3\r\nmap\r\n.GS\r\n@T.\r\n";

    fn message(from: &str, to: &str) -> String {
        assert!(MAP.contains(from));
        let error = parse_movingai_map(&MAP.replace(from, to), 1.0).unwrap_err();
        error.to_string()
    }

    #[test]
    fn reads_and_writes_maps() {
        let grid = parse_movingai_map(MAP, 0.5).unwrap();
        assert_eq!(
            grid,
            OccupancyGrid::from_rows(&["...", "##."], 0.5).unwrap()
        );
        let text = to_movingai_map(&grid).unwrap();
        assert_eq!(text, "type octile\nheight 2\nwidth 3\nmap\n...\n@@.\n");
        let unknown = OccupancyGrid::from_rows(&["?."], 1.0).unwrap();
        let error = to_movingai_map(&unknown).unwrap_err().to_string();
        assert!(error.contains("1 cells with value -1"), "{error}");
    }

    #[test]
    fn says_what_is_wrong_with_a_map() {
        assert!(message("octile", "hex").contains("line 1: begins with \"type hex\""));
        assert!(message("width 3", "width x").contains("line 3: the width is x"));
        assert!(message("width 3", "depth 3").contains("line 3: the header line is depth 3"));
        assert!(message("width 3\r\n", "").contains("the width is missing"));
        assert!(message(".GS", ".G").contains("line 5: a row is 2 cells long; it must be 3"));
        assert!(message("@T.", "@T,").contains("line 6: a cell is ','"));
        assert!(message("height 2", "height 3").contains("2 rows, but 3 are needed"));
        assert!(message("height 2", "height 1").contains("line 6: 1 or more rows too many"));
        assert!(message("height 2", "height 1000000000").contains("the limit is"));
        assert!(message("height 2", "height 0").contains("3 x 0 cells"));
        assert!(parse_movingai_map("", 1.0).is_err());
        assert!(
            parse_movingai_map(MAP, 0.0)
                .unwrap_err()
                .to_string()
                .contains("resolution 0 m")
        );
    }

    #[test]
    fn counts_scenario_rows_from_below() {
        let text = "version 1\n7\ta b.map\t4\t3\t0\t0\t3\t2\t4.65685\r\n\n";
        let scenario = &parse_movingai_scenarios(text).unwrap()[0];
        assert_eq!((scenario.bucket, scenario.map.as_str()), (7, "a b.map"));
        assert_eq!(
            (scenario.start, scenario.goal),
            (Cell::new(0, 2), Cell::new(3, 0))
        );
        assert_eq!(scenario.optimal_length_cells, 4.65685);
        let bad = |line: &str| {
            let text = format!("version 1\n{line}\n");
            parse_movingai_scenarios(&text).unwrap_err().to_string()
        };
        assert!(bad("0 m 4 3 4 0 0 0 1").contains("line 2: a column is 4; it must be below 4"));
        assert!(bad("0 m 4 3 0 0 0 0 nan").contains("the optimal length is nan"));
        assert!(bad("0 m 4 3 0 0 0 0").contains("9 fields"));
        assert!(parse_movingai_scenarios("0 m 4").is_err());
    }
}
