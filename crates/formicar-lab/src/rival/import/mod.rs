//! Files of other planners: paths to be judged, or results of their benchmarks.

mod imported;
mod ompl_log;

pub use imported::Imported;

use anyhow::{Context, Result};
use formicar::validation::ReadSamples;

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A path: a table or a message of ROS.
    Path,
    /// A benchmark log of OMPL.
    OmplLog,
}

impl Format {
    /// The format that a text looks like.
    pub fn of(text: &str) -> Self {
        if is_log(text.trim_start().lines().next().unwrap_or_default()) {
            Self::OmplLog
        } else {
            Self::Path
        }
    }
}

/// True if a benchmark log begins so: `PROGRAM version X`, of any program, or without it.
fn is_log(first: &str) -> bool {
    let words: Vec<&str> = first.split_whitespace().collect();
    match words[..] {
        ["Experiment", _, ..] => true,
        [_, .., "version", _] => !first.contains(','),
        _ => false,
    }
}

/// The runs of a file.
///
/// # Errors
/// The mistake in it, by line and field.
pub fn read(text: &str) -> Result<Vec<Imported>> {
    let of_path = |samples| {
        vec![Imported {
            is_found: true,
            samples: Some(samples),
            ..Imported::default()
        }]
    };
    match Format::of(text) {
        Format::Path => Ok(of_path(ReadSamples::from_text(text)?.samples)),
        Format::OmplLog => ompl_log::read(text).context("OMPL benchmark log"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_told_apart() {
        assert_eq!(Format::of("\n {\"poses\": []}"), Format::Path);
        assert_eq!(Format::of("OMPL version 2.0.1\n"), Format::OmplLog);
        assert_eq!(Format::of("formicar version 0.1.0\n"), Format::OmplLog);
        assert_eq!(Format::of("Experiment door\n"), Format::OmplLog);
        assert_eq!(Format::of("x,y\n1,2\n"), Format::Path);
        assert_eq!(Format::of("x y version\n1 2 3\n"), Format::Path);
        let runs = read("1,2,0.5\n2,2,0.5\n").unwrap();
        assert_eq!(runs[0].samples.as_ref().unwrap().points.len(), 2);
        assert!(read("1,2\n3\n").unwrap_err().to_string().contains("line 2"));
    }

    /// Every beginning of a text, and the text with each of some bytes in each place, is read or
    /// refused in words.
    pub(super) fn assert_no_text_panics(text: &str, try_read: impl Fn(&str)) {
        let ends = text.char_indices().map(|(i, _)| i);
        for end in ends.clone().step_by(3) {
            try_read(&text[..end]);
        }
        for at in ends.step_by(5) {
            for odd in [
                "",
                "-",
                "9",
                "\"",
                "\n",
                ";",
                "nan",
                "99999999999999999999",
                "\u{e9}",
            ] {
                let rest = text[at..].chars().next().map_or(at, |c| at + c.len_utf8());
                try_read(&format!("{}{odd}{}", &text[..at], &text[rest..]));
            }
        }
    }
}
