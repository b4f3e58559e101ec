//! The table on stdout: a row per run, and the reason under each that found no path.

use super::case::{Case, Chapter};
use super::run::{Done, status};
use crate::summary::duration;
use std::io::{self, Write};
use std::path::Path;

/// Reasons are broken into lines of this width.
const REASON_WIDTH: usize = 96;

/// Widths that fit every run, and where the table stands.
pub(super) struct Table {
    name_width: usize,
    chapter: Option<Chapter>,
}

impl Table {
    pub(super) fn new(cases: &[Case]) -> Self {
        let widths = cases.iter().map(|case| case.title().len());
        Self {
            name_width: widths.max().unwrap_or(0),
            chapter: None,
        }
    }

    pub(super) fn write_head(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(
            out,
            "{:w$}  {:<16}  {:>9}  {:>9}  {:>16}  {:>5}  {:>7}  {:>8}",
            "run",
            "status",
            "length",
            "clearance",
            "curvature",
            "cusps",
            "steps",
            "time",
            w = self.name_width,
        )
    }

    pub(super) fn write_row(&mut self, done: &Done, out: &mut impl Write) -> io::Result<()> {
        if self.chapter.replace(done.case.chapter) != Some(done.case.chapter) {
            writeln!(out)?;
        }
        let numbers = Numbers::of(done);
        writeln!(
            out,
            "{:w$}  {:<16}  {:>9}  {:>9}  {:>16}  {:>5}  {:>7}  {:>8}",
            done.case.title(),
            status(&done.answer),
            numbers.length,
            numbers.clearance,
            numbers.curvature,
            numbers.cusps,
            done.n_steps,
            duration(done.answer.timing.query_s),
            w = self.name_width,
        )?;
        let reason = done.answer.reason.as_deref().unwrap_or_default();
        for line in lines(reason, REASON_WIDTH) {
            writeln!(out, "    {line}")?;
        }
        Ok(())
    }
}

/// The measures of a path as text; empty without a path.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    pub(super) length: String,
    pub(super) clearance: String,
    /// Largest, against the vehicle's limit; empty for a point.
    pub(super) curvature: String,
    pub(super) cusps: String,
}

impl Numbers {
    pub(super) fn of(done: &Done) -> Self {
        let Some(metrics) = &done.answer.metrics else {
            return Self::default();
        };
        let limit_per_m = done.max_curvature_per_m;
        let curvature = if limit_per_m.is_finite() {
            format!("{:.2} of {limit_per_m:.2} 1/m", metrics.max_curvature_per_m)
        } else {
            String::new()
        };
        Self {
            length: format!("{:.2} m", metrics.length_m),
            clearance: format!("{:.3} m", metrics.min_clearance_m),
            curvature,
            cusps: metrics.n_cusps.to_string(),
        }
    }
}

/// Writes how many found a path, and where to look.
pub(super) fn write_end(
    done: &[Done],
    total_s: f64,
    page: &Path,
    out: &mut impl Write,
) -> io::Result<()> {
    writeln!(out)?;
    writeln!(out, "{}", tally(done).join("; "))?;
    writeln!(out, "{total_s:.1} s in all; look at {}", page.display())
}

/// The endings of the runs in words.
pub(super) fn tally(done: &[Done]) -> Vec<String> {
    let count = |keep: fn(&&Done) -> bool| done.iter().filter(keep).count();
    let n_found = count(|d| d.is_found());
    let mut words = vec![format!(
        "{n_found} of {} runs found a path, each certified",
        done.len()
    )];
    let n_narrow = count(|d| d.case.chapter == Chapter::Narrow);
    let n_passed = count(|d| d.case.chapter == Chapter::Narrow && d.is_found());
    if n_narrow > 0 {
        words.push(format!("narrow places: {n_passed} of {n_narrow}"));
    }
    let n_impossible = count(|d| d.case.is_impossible && !d.is_found());
    if n_impossible > 0 {
        words.push(format!(
            "{n_impossible} ask for what cannot be, and are told so"
        ));
    }
    words
}

/// Breaks a text between words.
fn lines(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_break_between_words() {
        assert_eq!(lines("a way too thin", 6), ["a way", "too", "thin"]);
        assert!(lines("", 6).is_empty());
    }
}
