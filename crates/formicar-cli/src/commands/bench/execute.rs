//! Runs processes, some at a time.

use super::job::Job;
use super::row::Row;
use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Carries out all runs, each in a process of its own, and hands over their rows as they come.
pub(super) fn all(
    jobs: &[&Job],
    n_at_once: u32,
    mut on_row: impl FnMut(Row) -> Result<()>,
) -> Result<()> {
    let program = std::env::current_exe().context("this program cannot find itself")?;
    let next = AtomicUsize::new(0);
    let bar = progress_bar(jobs.len());
    let result = thread::scope(|scope| {
        let (sender, rows) = mpsc::channel();
        for _ in 0..jobs.len().min(n_at_once as usize) {
            let (sender, next, program) = (sender.clone(), &next, &program);
            let mine = std::iter::from_fn(move || jobs.get(next.fetch_add(1, Ordering::Relaxed)));
            // Nobody listens any more after a failure.
            scope.spawn(move || {
                mine.map(|job| one(program, job))
                    .try_for_each(|row| sender.send(row))
            });
        }
        drop(sender);
        for row in rows {
            on_row(row?)?;
            bar.inc(1);
        }
        Ok(())
    });
    bar.finish_and_clear();
    result
}

/// A bar on stderr; none where that is no terminal.
fn progress_bar(n_jobs: usize) -> ProgressBar {
    let style =
        ProgressStyle::with_template("{bar:30} {pos} of {len} runs, {elapsed} of {duration}");
    let bar = ProgressBar::new(n_jobs as u64);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn one(program: &Path, job: &Job) -> Result<Row> {
    let output = Command::new(program)
        .arg("bench-run")
        .arg(serde_json::to_string(job)?)
        .stdin(Stdio::null())
        .output();
    let output = output.with_context(|| format!("{} cannot be started", program.display()))?;
    Ok(row_of(job, &output))
}

/// The row of a run that is over. One that has not told its own has crashed.
fn row_of(job: &Job, output: &Output) -> Row {
    let told = String::from_utf8_lossy(&output.stdout);
    let row = output.status.success().then(|| Row::from_json(&told, job));
    if let Some(row) = row.flatten() {
        return row;
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    let lines = errors.lines().map(str::trim);
    let lines: Vec<_> = lines.filter(|line| !line.is_empty()).take(3).collect();
    let mut row = Row::begin(job);
    row.set("status", &json!("crashed"));
    let reason = format!("{}: {}", output.status, lines.join(" "));
    row.set("reason", &json!(reason.trim_end_matches([':', ' '])));
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    fn job() -> Job {
        serde_json::from_value(json!({
            "task": {"scenario": "a", "source": "b", "place": {"builtin": {"map": "m", "request": "r"}}},
            "planner": "astar", "name": "astar", "seed": 3, "motion": null, "budget_steps": null,
            "deadline_ms": null, "set": [], "is_cold": false, "answer": null,
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
        let row = row_of(&job(), &output(9, ""));
        assert_eq!(row.get("status"), "crashed");
        assert!(row.get("reason").contains("signal: 9"), "{row:?}");
        assert!(row.get("reason").contains("x such, \"is\" life"));
        assert_eq!(row.key(), job().key());
        for (status, stdout) in [
            (0, "half a ro"),
            (256, &*told("a")),
            (0, &*told("of another")),
        ] {
            let row = row_of(&job(), &output(status, stdout));
            assert_eq!(row.get("status"), "crashed", "{stdout}");
        }
        let row = row_of(&job(), &output(0, &told("a")));
        assert_eq!((row.get("status"), row.get("source")), ("found", "b"));
        assert_eq!(row.number("length_m"), Some(2.5));
    }

    fn told(scenario: &str) -> String {
        let row: Value = json!({
            "scenario": scenario, "planner": "astar", "seed": 3, "status": "found", "length_m": 2.5,
        });
        row.to_string()
    }
}
