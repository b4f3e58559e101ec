//! Runs in processes of their own.

use super::job::Job;
use super::record::{Run, RunRecord};
use super::status::RunStatus;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A build of formicar whose processes carry out runs, each told its job by `bench-run`.
#[derive(Clone, Debug)]
pub struct Program(PathBuf);

impl Program {
    /// This program.
    ///
    /// # Errors
    /// A platform that does not tell where it is.
    pub fn this() -> Result<Self> {
        this_program().map(Self)
    }

    /// The program in a file.
    pub fn at(path: &Path) -> Self {
        Self(path.to_owned())
    }

    /// The file of the program.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Carries out one run in a process of its own. A process that does not answer has crashed,
    /// which is a result.
    ///
    /// # Errors
    /// A program that cannot be started.
    pub fn run(&self, job: &Job) -> Result<Run> {
        let output = Command::new(&self.0)
            .arg("bench-run")
            .arg(serde_json::to_string(job)?)
            .stdin(Stdio::null())
            .output();
        let name = || format!("{} cannot be started", self.0.display());
        Ok(run_of(job, &output.with_context(name)?))
    }

    /// The version that the program states.
    ///
    /// # Errors
    /// A program that is not formicar.
    pub fn version(&self) -> Result<String> {
        let name = || self.0.display().to_string();
        let output = Command::new(&self.0).arg("--version").output();
        let output = output.with_context(name)?;
        let text = String::from_utf8_lossy(&output.stdout);
        match text.trim().strip_prefix("formicar ") {
            Some(version) if output.status.success() => Ok(version.to_owned()),
            _ => bail!("{}: it is no formicar; hint: --with PROGRAM", name()),
        }
    }
}

/// The file of this program.
pub(super) fn this_program() -> Result<PathBuf> {
    std::env::current_exe().context("this program cannot find itself")
}

/// The run that a process has printed. One that has not printed its own run has crashed.
fn run_of(job: &Job, output: &Output) -> Run {
    let printed = || {
        let run: Run = serde_json::from_slice(&output.stdout).ok()?;
        let is_told = run.record.status != RunStatus::Crashed || !run.record.reason.is_empty();
        (is_told && run.record.key() == job.key()).then_some(run)
    };
    if let Some(mut run) = output.status.success().then(printed).flatten() {
        run.record.source.clone_from(&job.task.source);
        return run;
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    let lines = errors.lines().map(str::trim);
    let lines: Vec<_> = lines.filter(|line| !line.is_empty()).take(3).collect();
    let reason = format!("{}: {}", output.status, lines.join(" "));
    Run {
        record: RunRecord::crashed(job, reason.trim_end_matches([':', ' '])),
        ..Run::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

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
    fn a_run_that_prints_no_row_has_crashed() {
        use std::os::unix::process::ExitStatusExt;
        let output = |status, stdout: &str| Output {
            status: std::process::ExitStatus::from_raw(status),
            stdout: stdout.as_bytes().to_vec(),
            stderr: b"thread main panicked at x\nsuch, \"is\" life\n".to_vec(),
        };
        let record = run_of(&job(), &output(9, "")).record;
        assert_eq!(record.status, RunStatus::Crashed);
        assert!(record.reason.contains("signal: 9"), "{record:?}");
        assert!(record.reason.contains("x such, \"is\" life"));
        assert_eq!(record.key(), job().key());
        for (status, stdout) in [
            (0, "half a ro"),
            (256, &*printed("a", &json!(2.5))),
            (0, &*printed("of another", &json!(2.5))),
            (0, &*printed("a", &json!("far"))),
        ] {
            let record = run_of(&job(), &output(status, stdout)).record;
            assert_eq!(record.status, RunStatus::Crashed, "{stdout}");
        }
        // Builds before this one print all values as text.
        for length in [json!(2.5), json!("2.5")] {
            let record = run_of(&job(), &output(0, &printed("a", &length))).record;
            assert_eq!(record.status, RunStatus::Found);
            assert_eq!((record.source.as_str(), record.length_m), ("b", Some(2.5)));
        }
    }

    fn printed(scenario: &str, length_m: &Value) -> String {
        let row = json!({
            "scenario": scenario, "planner": "astar", "seed": "3", "status": "found",
            "length_m": length_m,
        });
        json!({"row": row, "history": {}, "path": null}).to_string()
    }
}
