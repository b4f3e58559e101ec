//! A benchmark log of OMPL (Moll, Sucan & Kavraki 2015, *Benchmarking motion planning
//! algorithms*): rows of metrics for each run of each planner, without paths.

use super::imported::Imported;
use anyhow::{Context, Result, anyhow, bail};
use std::iter::{Enumerate, Peekable};
use std::str::Lines;

/// Properties that are used; the time of a planner is without that of simplification.
const USED: [&str; 7] = [
    "solved",
    "approximate solution",
    "time",
    "simplification time",
    "solution length",
    "simplified solution length",
    // Of MoveIt.
    "path_plan_length",
];

/// Most lines that a count may announce.
const MAX_LINES: usize = 1_000_000;

/// The lines that are still to be read, each with its number.
struct Rest<'a>(Peekable<Enumerate<Lines<'a>>>);

/// All runs of all planners.
pub(super) fn read(text: &str) -> Result<Vec<Imported>> {
    let mut rest = Rest(text.lines().enumerate().peekable());
    let n_planners = rest.skip_to_planners()?;
    let mut runs = Vec::new();
    for _ in 0..n_planners {
        runs.extend(planner(&mut rest)?);
    }
    Ok(runs)
}

fn planner(rest: &mut Rest) -> Result<Vec<Imported>> {
    let (_, name) = rest.line("the name of a planner")?;
    let n_common = rest.count("common properties")?;
    for _ in 0..n_common {
        rest.line("a common property")?;
    }
    let n_properties = rest.count("properties for each run")?;
    let mut names = Vec::new();
    for _ in 0..n_properties {
        let (number, line) = rest.line("a property")?;
        let (name, _) = line.rsplit_once(' ').with_context(|| {
            format!(
                "line {number}: {:?}; expected a property and its type",
                short(line)
            )
        })?;
        names.push(name);
    }
    let n_runs = rest.count("runs")?;
    let mut runs = Vec::new();
    for run in 0..n_runs {
        let (number, line) = rest.line("a run")?;
        let values = values(line, &names).with_context(|| format!("line {number}"))?;
        runs.push(imported(name, run as u64, &values));
    }
    rest.skip_past_dot()?;
    Ok(runs)
}

/// The numbers of a run by property; those that are left empty are none.
fn values<'a>(line: &str, names: &[&'a str]) -> Result<Vec<(&'a str, f64)>> {
    let fields: Vec<&str> = line.trim_end().trim_end_matches(';').split(';').collect();
    if fields.len() != names.len() {
        bail!(
            "{} values; there are {} properties",
            fields.len(),
            names.len()
        );
    }
    let mut values = Vec::new();
    for (&name, field) in names.iter().zip(fields) {
        match field.trim() {
            "" => {}
            // Properties of planners may be words; none of ours are.
            field => match number(field) {
                Some(value) => values.push((name, value)),
                None if USED.contains(&name) => {
                    bail!("{name}: {:?}; expected a number", short(field));
                }
                None => {}
            },
        }
    }
    Ok(values)
}

/// A number, or a truth value in the words of `MoveIt`.
fn number(field: &str) -> Option<f64> {
    match field {
        "true" => Some(1.0),
        "false" => Some(0.0),
        number => number.parse().ok(),
    }
}

fn imported(planner: &str, run: u64, values: &[(&str, f64)]) -> Imported {
    let of = |name: &str| {
        let value = values.iter().find(|(other, _)| *other == name);
        value.map(|(_, value)| *value)
    };
    let is_true = |name: &str| of(name).is_some_and(|value| value != 0.0);
    let is_found = is_true("solved") && !is_true("approximate solution");
    let is_known = |value: &f64| value.is_finite() && *value >= 0.0;
    let simplified_s = of("simplification time").filter(is_known);
    let query_s = of("time").map(|time_s| time_s + simplified_s.unwrap_or(0.0));
    // A length of 0 stands where there is no path.
    let is_length = |length_m: &f64| is_found && is_known(length_m) && *length_m > 0.0;
    let length_m = of("simplified solution length").filter(is_length);
    let unsimplified = ["solution length", "path_plan_length"];
    let unsimplified = unsimplified
        .iter()
        .find_map(|name| of(name).filter(is_length));
    let length_m = length_m.or(unsimplified);
    Imported {
        planner: Some(planner.to_owned()),
        run,
        is_found,
        samples: None,
        query_s: query_s.filter(is_known),
        length_m,
    }
}

impl<'a> Rest<'a> {
    /// The next line, counted from 1.
    fn line(&mut self, what: &str) -> Result<(usize, &'a str)> {
        let line = self.0.next().map(|(i, line)| (i + 1, line.trim()));
        line.with_context(|| format!("it ends before {what}; hint: the file is cut off"))
    }

    /// The number in a line like `23 properties for each run`.
    fn count(&mut self, what: &str) -> Result<usize> {
        let (number, line) = self.line(what)?;
        count(line, what)
            .ok_or_else(|| anyhow!("line {number}: {:?}; expected N {what}", short(line)))
    }

    /// Passes the preamble, with its blocks of any text between `<<<|` and `|>>>`.
    fn skip_to_planners(&mut self) -> Result<usize> {
        let mut is_block = false;
        loop {
            let (_, line) = self.line("a line like \"2 planners\"")?;
            match (is_block, line) {
                (false, "<<<|") => is_block = true,
                (true, "|>>>") => is_block = false,
                (false, line) => {
                    if let Some(n) = count(line, "planners") {
                        return Ok(n);
                    }
                }
                _ => {}
            }
        }
    }

    /// Passes what a planner tells of its progress; a dot ends a planner.
    fn skip_past_dot(&mut self) -> Result<()> {
        loop {
            if self.line("the dot at the end of a planner")?.1 == "." {
                return Ok(());
            }
        }
    }
}

fn count(line: &str, what: &str) -> Option<usize> {
    let (number, words) = line.split_once(' ')?;
    let is_it = words.trim() == what || words.trim() == what.trim_end_matches('s');
    // Some versions write `10 runs per planner` in the preamble, which is another matter.
    number.parse().ok().filter(|&n| is_it && n <= MAX_LINES)
}

/// As much of a line as a message should repeat.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{OmplLog, OmplPlanner, OmplRun, Property, PropertyKind};

    const LOG: &str = "OMPL version 2.0.1\nExperiment door\n0 experiment properties\nRunning on a\n\
        <<<|\n3 planners\n|>>>\n7 is the random seed\n2 runs per planner\n1 enum type\n\
        status|Timeout|Exact solution\n2 planners\ngeometric_RRTConnect\n1 common properties\n\
        range = 3.1\n5 properties for each run\nsolved BOOLEAN\ntime REAL\nsolution length REAL\n\
        simplified solution length REAL\nnote STRING\n2 runs\n1; 0.25; 12.5; 11.0; fine; \n\
        0; 0.5; inf; 0; ; \n.\ngeometric_RRTstar\n0 common properties\n\
        5 properties for each run\nsimplification time REAL\napproximate solution BOOLEAN\nsolved BOOLEAN\ntime REAL\n\
        solution length REAL\n1 runs\n0.25; 1; 1; 0.5; 9; \n2 progress properties for each run\n\
        iterations INTEGER\ntime REAL\n1 runs\n0,0.05,;1,0.1,;\n.\n";

    #[test]
    fn runs_come_out_with_their_metrics() {
        let runs = read(LOG).unwrap();
        assert_eq!(runs.len(), 3);
        assert_eq!(runs[0].planner.as_deref(), Some("geometric_RRTConnect"));
        assert_eq!(
            (runs[0].query_s, runs[0].length_m),
            (Some(0.25), Some(11.0))
        );
        assert!(runs[0].is_found && runs[0].run == 0);
        assert_eq!((runs[1].query_s, runs[1].length_m), (Some(0.5), None));
        assert!(!runs[1].is_found && runs[1].run == 1);
        // An approximate solution does not reach the goal.
        assert_eq!(runs[2].planner.as_deref(), Some("geometric_RRTstar"));
        assert!(!runs[2].is_found);
        assert_eq!((runs[2].query_s, runs[2].length_m), (Some(0.75), None));
    }

    #[test]
    fn truth_values_in_words_and_lengths_of_moveit_are_read() {
        let log = "MoveIt version 1.1.11\nExperiment hall\n1 planners\nRRTConnect\n\
            0 common properties\n3 properties for each run\npath_plan_length REAL\nsolved BOOLEAN\n\
            time REAL\n2 runs\n8.4; true; 0.21; \n; false; 10.0; \n.\n";
        let runs = crate::rival::import::read(log).unwrap();
        assert!(runs[0].is_found && !runs[1].is_found);
        assert_eq!((runs[0].length_m, runs[1].length_m), (Some(8.4), None));
    }

    #[test]
    fn logs_of_ours_are_read() {
        let kinds = [
            ("solved", PropertyKind::Boolean),
            ("time", PropertyKind::Real),
            ("solution length", PropertyKind::Real),
        ];
        let run = |solved, length_m| OmplRun {
            values: vec![Some(solved), Some(0.5), length_m],
            progress: vec![[0.25, 7.0]],
        };
        let log = OmplLog {
            version: "0.1.0".to_owned(),
            properties: kinds.map(|(name, kind)| Property { name, kind }).into(),
            planners: vec![OmplPlanner {
                name: "hybrid-astar".to_owned(),
                runs: vec![run(1.0, Some(6.0)), run(0.0, None)],
            }],
            ..OmplLog::default()
        };
        let runs = crate::rival::import::read(&log.to_text()).unwrap();
        assert_eq!(runs.len(), 2);
        assert_eq!(runs[0].planner.as_deref(), Some("hybrid-astar"));
        assert_eq!((runs[0].query_s, runs[0].length_m), (Some(0.5), Some(6.0)));
        assert!(runs[0].is_found && !runs[1].is_found);
    }

    #[test]
    fn what_is_wrong_is_told_by_its_line() {
        for (from, to, told) in [
            (
                "1; 0.25; 12.5",
                "1; soon; 12.5",
                "line 23: time: \"soon\"; expected a number",
            ),
            (
                "1; 0.25; 12.5",
                "1; 12.5",
                "line 23: 4 values; there are 5 properties",
            ),
            (
                "2 runs\n1;",
                "some runs\n1;",
                "line 22: \"some runs\"; expected N runs",
            ),
            (
                "note STRING",
                "note",
                "line 21: \"note\"; expected a property",
            ),
            (
                "\n2 planners",
                "\n2 plans",
                "it ends before a line like \"2 planners\"",
            ),
            ("0,0.05,;1,0.1,;\n.\n", "", "it ends before the dot"),
        ] {
            let error = format!("{:#}", read(&LOG.replace(from, to)).unwrap_err());
            assert!(error.contains(told), "{told}: {error}");
        }
    }

    #[test]
    fn no_text_makes_it_panic() {
        crate::rival::import::tests::assert_no_text_panics(LOG, |text| drop(read(text)));
    }
}
