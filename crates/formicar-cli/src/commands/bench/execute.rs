//! Runs processes, some at a time.

use anyhow::{Context, Result};
use formicar_lab::campaign::{Job, Row, Told};
use formicar_lab::run::pool;
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A run that is over: its row, and what else its process has told.
pub(crate) type Over = (Row, Told);

/// Carries out all runs, each in a process of its own, and hands them over as they end, each with
/// its place in the list.
pub(super) fn all(
    jobs: &[&Job],
    n_at_once: u32,
    mut on_over: impl FnMut(usize, Over) -> Result<()>,
) -> Result<()> {
    let program = this_program()?;
    let bar = progress_bar(jobs.len());
    let run = |place: usize| one(&program, jobs[place]);
    let result = pool::each(n_at_once as usize, jobs.len(), run, |place, over| {
        on_over(place, over?)?;
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    result
}

/// This program, which runs itself.
pub(crate) fn this_program() -> Result<PathBuf> {
    std::env::current_exe().context("this program cannot find itself")
}

/// A bar on stderr with the time left; none where that is no terminal.
pub(crate) fn progress_bar(n_jobs: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos} of {len} runs, {elapsed}, {eta} left");
    let bar = ProgressBar::new(n_jobs as u64);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Carries out one run by a program.
pub(crate) fn one(program: &Path, job: &Job) -> Result<Over> {
    let output = Command::new(program)
        .arg("bench-run")
        .arg(serde_json::to_string(job)?)
        .stdin(Stdio::null())
        .output();
    let output = output.with_context(|| format!("{} cannot be started", program.display()))?;
    Ok(over(job, &output))
}

/// What a process has told. One that has not told its own row has crashed.
fn over(job: &Job, output: &Output) -> Over {
    let told = String::from_utf8_lossy(&output.stdout);
    let over = output.status.success().then(|| Told::read(&told, job));
    if let Some(over) = over.flatten() {
        return over;
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    let lines = errors.lines().map(str::trim);
    let lines: Vec<_> = lines.filter(|line| !line.is_empty()).take(3).collect();
    let mut row = Row::begin(job);
    row.set("status", &json!("crashed"));
    let reason = format!("{}: {}", output.status, lines.join(" "));
    row.set("reason", &json!(reason.trim_end_matches([':', ' '])));
    (row, Told::default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    fn job() -> Job {
        serde_json::from_value(json!({
            "task": {"scenario": "a", "source": "b", "place": {"builtin": {"map": "m", "request": "r"}}},
            "vehicle": null, "contender": {"planner": "astar", "name": "astar", "config": {}},
            "seed": 3, "answer": null, "limits": {
                "motion": null, "budget_steps": null, "deadline_ms": null, "is_cold": false,
            },
        }))
        .unwrap()
    }

    #[test]
    #[cfg(unix)]
    fn a_run_that_tells_no_row_has_crashed() {
        use std::os::unix::process::ExitStatusExt;
        let output = |status, stdout: &str| Output {
            status: std::process::ExitStatus::from_raw(status),
            stdout: stdout.as_bytes().to_vec(),
            stderr: b"thread main panicked at x\nsuch, \"is\" life\n".to_vec(),
        };
        let (row, _) = over(&job(), &output(9, ""));
        assert_eq!(row.get("status"), "crashed");
        assert!(row.get("reason").contains("signal: 9"), "{row:?}");
        assert!(row.get("reason").contains("x such, \"is\" life"));
        assert_eq!(row.key(), job().row_key());
        for (status, stdout) in [
            (0, "half a ro"),
            (256, &*told("a")),
            (0, &*told("of another")),
        ] {
            let (row, _) = over(&job(), &output(status, stdout));
            assert_eq!(row.get("status"), "crashed", "{stdout}");
        }
        let (row, _) = over(&job(), &output(0, &told("a")));
        assert_eq!((row.get("status"), row.get("source")), ("found", "b"));
        assert_eq!(row.number("length_m"), Some(2.5));
    }

    fn told(scenario: &str) -> String {
        let row: Value = json!({
            "scenario": scenario, "planner": "astar", "seed": 3, "status": "found", "length_m": 2.5,
        });
        json!({"row": row, "history": {}, "path": null}).to_string()
    }
}
