//! Runs as a benchmark log of OMPL, which `ompl_benchmark_statistics` reads into a data base that
//! Planner Arena opens.
//!
//! The grammar is that of OMPL 1.5 to 2.0: a head with the experiment, then per planner its
//! settings, the names and types of what each run has, a line per run, and where it was recorded a
//! line per run of how the best solution improved.

use std::fmt::Write;

/// The type of a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PropertyKind {
    /// True or false.
    Boolean,
    /// A whole number.
    Integer,
    /// A number.
    Real,
}

/// A property that every run of a planner has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its name in small letters, as OMPL has `time` and `solution length`.
    pub name: &'static str,
    /// Its type.
    pub kind: PropertyKind,
}

impl Property {
    fn written(&self) -> String {
        let kind = match self.kind {
            PropertyKind::Boolean => "BOOLEAN",
            PropertyKind::Integer => "INTEGER",
            PropertyKind::Real => "REAL",
        };
        format!("{} {kind}", self.name)
    }
}

/// One run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OmplRun {
    /// A value per property; none where it is missing. Truth is 1 or 0.
    pub values: Vec<Option<f64>>,
    /// Seconds and the cost of the best solution so far, seconds ascending; may be empty.
    pub progress: Vec<[f64; 2]>,
}

/// The runs of one planner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OmplPlanner {
    /// Its name.
    pub name: String,
    /// The runs.
    pub runs: Vec<OmplRun>,
}

/// An experiment: planners on one scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OmplLog {
    /// Its name; spaces become underscores.
    pub name: String,
    /// Version of the program.
    pub version: String,
    /// The machine.
    pub host: String,
    /// Map, vehicle and ends in words.
    pub setup: String,
    /// The processor.
    pub cpu: String,
    /// The properties of all runs.
    pub properties: Vec<Property>,
    /// The planners.
    pub planners: Vec<OmplPlanner>,
}

impl OmplLog {
    /// The log. Each run may take what time and memory it wants, which the format states as 0; the
    /// beginning is not noted, and seeds count from 0.
    pub fn to_text(&self) -> String {
        let n_runs = self.planners.iter().map(|planner| planner.runs.len());
        let mut text = format!(
            "formicar version {}\nExperiment {}\n0 experiment properties\nRunning on {}\n\
             Starting at 1970-01-01 00:00:00\n<<<|\n{}\n|>>>\n<<<|\n{}\n|>>>\n0 is the random seed\n\
             0 seconds per run\n0 MB per run\n{} runs per planner\n\
             {:.6} seconds spent to collect the data\n0 enum types\n{} planners\n",
            one_word(&self.version),
            one_word(&self.name),
            one_word(&self.host),
            several_lines(&self.setup),
            several_lines(&self.cpu),
            n_runs.max().unwrap_or_default(),
            self.seconds(),
            self.planners.len()
        );
        for planner in &self.planners {
            self.write_planner(&mut text, planner);
        }
        text
    }

    /// Time of all runs.
    fn seconds(&self) -> f64 {
        let is_time = |property: &Property| property.name == "time";
        let Some(place) = self.properties.iter().position(is_time) else {
            return 0.0;
        };
        let runs = self.planners.iter().flat_map(|planner| &planner.runs);
        let times = runs.filter_map(|run| *run.values.get(place)?);
        times.sum()
    }

    fn write_planner(&self, text: &mut String, planner: &OmplPlanner) {
        let _ = writeln!(text, "{}\n0 common properties", one_line(&planner.name));
        let _ = writeln!(text, "{} properties for each run", self.properties.len());
        for property in &self.properties {
            let _ = writeln!(text, "{}", property.written());
        }
        let _ = writeln!(text, "{} runs", planner.runs.len());
        for run in &planner.runs {
            for i in 0..self.properties.len() {
                let value = run.values.get(i).copied().flatten();
                let _ = write!(text, "{}; ", value.map_or(String::new(), number));
            }
            text.push('\n');
        }
        if planner.runs.iter().any(|run| !run.progress.is_empty()) {
            write_progress(text, planner);
        }
        text.push_str(".\n");
    }
}

fn write_progress(text: &mut String, planner: &OmplPlanner) {
    let _ = writeln!(
        text,
        "2 progress properties for each run\ntime REAL\nbest cost REAL\n{} runs",
        planner.runs.len()
    );
    for run in &planner.runs {
        let mut last_s = f64::NEG_INFINITY;
        for &[time_s, cost] in &run.progress {
            // A time that comes twice would be left out with a warning.
            if time_s > last_s {
                let _ = write!(text, "{},{},;", number(time_s), number(cost));
                last_s = time_s;
            }
        }
        text.push('\n');
    }
}

fn number(value: f64) -> String {
    if value.is_finite() {
        format!("{value}")
    } else {
        String::new()
    }
}

fn one_word(words: &str) -> String {
    let word: Vec<&str> = words.split_whitespace().collect();
    if word.is_empty() {
        "unknown".to_owned()
    } else {
        word.join("_")
    }
}

fn one_line(words: &str) -> String {
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Lines of which none ends the passage.
fn several_lines(words: &str) -> String {
    words.replace("|>>>", "| >>>").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log() -> OmplLog {
        let run = |time: f64, length: Option<f64>, progress: Vec<[f64; 2]>| OmplRun {
            values: vec![
                Some(f64::from(u8::from(length.is_some()))),
                Some(time),
                length,
            ],
            progress,
        };
        OmplLog {
            name: "a map".to_owned(),
            version: "0.1.0".to_owned(),
            setup: "two\nlines".to_owned(),
            properties: vec![
                Property {
                    name: "solved",
                    kind: PropertyKind::Boolean,
                },
                Property {
                    name: "time",
                    kind: PropertyKind::Real,
                },
                Property {
                    name: "solution length",
                    kind: PropertyKind::Real,
                },
            ],
            planners: vec![
                OmplPlanner {
                    name: "aco, plain".to_owned(),
                    runs: vec![
                        run(0.5, Some(7.25), vec![[0.1, 9.0], [0.1, 8.0], [0.3, 7.25]]),
                        run(0.25, None, Vec::new()),
                    ],
                },
                OmplPlanner {
                    name: "astar".to_owned(),
                    runs: vec![run(0.0625, Some(7.0), Vec::new())],
                },
            ],
            ..OmplLog::default()
        }
    }

    /// The lines that `ompl_benchmark_statistics` reads for a planner, in its order.
    fn read_planner<'a>(lines: &mut impl Iterator<Item = &'a str>) -> (String, Vec<Vec<String>>) {
        let count = |line: &str| -> usize { line.split(' ').next().unwrap().parse().unwrap() };
        let name = lines.next().unwrap().to_owned();
        assert_eq!(lines.next(), Some("0 common properties"));
        let n_properties = count(lines.next().unwrap());
        for _ in 0..n_properties {
            let kind = lines.next().unwrap().rsplit(' ').next().unwrap();
            assert!(["BOOLEAN", "INTEGER", "REAL"].contains(&kind), "{kind}");
        }
        let mut rows = Vec::new();
        for _ in 0..count(lines.next().unwrap()) {
            let fields: Vec<String> = lines
                .next()
                .unwrap()
                .split("; ")
                .map(str::to_owned)
                .collect();
            // The last `; ` is followed by nothing.
            assert_eq!(
                (fields.len(), fields.last().unwrap().as_str()),
                (n_properties + 1, "")
            );
            rows.push(fields[..n_properties].to_vec());
        }
        let next = lines.next().unwrap();
        if next != "." {
            assert_eq!(count(next), 2);
            assert_eq!(lines.next(), Some("time REAL"));
            assert_eq!(lines.next(), Some("best cost REAL"));
            let n_runs = count(lines.next().unwrap());
            assert_eq!(n_runs, rows.len());
            for row in &mut rows {
                let samples = lines.next().unwrap().split_terminator(';');
                row.extend(samples.map(|sample| sample.trim_end_matches(',').to_owned()));
            }
            assert_eq!(lines.next(), Some("."));
        }
        (name, rows)
    }

    #[test]
    fn a_reader_of_the_grammar_finds_everything() {
        let text = log().to_text();
        let mut lines = text.lines();
        for expected in [
            "formicar version 0.1.0",
            "Experiment a_map",
            "0 experiment properties",
            "Running on unknown",
            "Starting at 1970-01-01 00:00:00",
            "<<<|",
            "two",
            "lines",
            "|>>>",
            "<<<|",
            "",
            "|>>>",
            "0 is the random seed",
            "0 seconds per run",
            "0 MB per run",
            "2 runs per planner",
            "0.812500 seconds spent to collect the data",
            "0 enum types",
            "2 planners",
        ] {
            assert_eq!(lines.next(), Some(expected));
        }
        let (name, rows) = read_planner(&mut lines);
        assert_eq!(name, "aco, plain");
        assert_eq!(rows[0], ["1", "0.5", "7.25", "0.1,9", "0.3,7.25"]);
        assert_eq!(rows[1], ["0", "0.25", ""]);
        assert_eq!(
            read_planner(&mut lines),
            (
                "astar".to_owned(),
                vec![vec!["1".to_owned(), "0.0625".to_owned(), "7".to_owned()]]
            )
        );
        assert_eq!(lines.next(), None);
    }
}
