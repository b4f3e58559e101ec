//! Relations between poses of a log, as Kümmerle et al. (2009) use them to judge mapping.

use crate::error::MappingError;
use formicar::Pose2;

/// The true motion between two times of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relation {
    /// Earlier or later time, seconds.
    pub from_s: f64,
    /// The other time, seconds.
    pub to_s: f64,
    /// The pose at `to_s` in the frame of the pose at `from_s`.
    pub motion: Pose2,
}

/// Relations from text: a line holds `time1 time2 x y z roll pitch yaw` (meters, radians).
///
/// Empty lines and lines that start with `#` are skipped. Height, roll and pitch are ignored.
///
/// # Errors
/// A line with another number of columns, or with a word that is no finite number.
pub fn parse_relations(text: &str) -> Result<Vec<Relation>, MappingError> {
    let lines = text.lines().enumerate();
    let lines = lines.filter(|(_, line)| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with('#')
    });
    lines.map(|(i, line)| relation(i + 1, line)).collect()
}

fn relation(line_number: usize, line: &str) -> Result<Relation, MappingError> {
    let failed = |problem: String| MappingError::Line {
        line: line_number,
        problem,
    };
    let number = |word: &str| {
        let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| failed(format!("{word:?} is no finite number")))
    };
    let columns = line.split_whitespace().map(number);
    let columns = columns.collect::<Result<Vec<f64>, _>>()?;
    let &[from_s, to_s, x, y, _, _, _, yaw] = columns.as_slice() else {
        return Err(failed(format!(
            "{} columns; a relation has 8: time1 time2 x y z roll pitch yaw",
            columns.len()
        )));
    };
    Ok(Relation {
        from_s,
        to_s,
        motion: Pose2::new(x, y, yaw),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_eight_columns() {
        let text = "# a file\n1216.630413 1217.490267 0.407950 -0.016330 0 0 0 -0.069620\n\n";
        let relations = parse_relations(text).unwrap();
        assert_eq!(relations.len(), 1);
        assert_eq!(
            relations[0].motion,
            Pose2::new(0.407_950, -0.016_330, -0.069_620)
        );
        assert_eq!(relations[0].from_s, 1_216.630_413);
    }

    #[test]
    fn names_the_bad_line() {
        let error = parse_relations("1 2 3 4 5 6 7 8\n1 2 3").unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 2: 3 columns; a relation has 8: time1 time2 x y z roll pitch yaw"
        );
        let error = parse_relations("1 2 nan 4 5 6 7 8").unwrap_err();
        assert_eq!(error.to_string(), "line 1: \"nan\" is no finite number");
    }
}
