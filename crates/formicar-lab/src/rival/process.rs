//! Runs a program: a document in, a document out, within a time.

use anyhow::{Context, Result, anyhow, bail};
use std::io::{Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::{Duration, Instant};

/// The output of a program.
#[derive(Clone, Debug)]
pub struct Ended {
    /// All that it printed.
    pub stdout: String,
    /// From its start to its end, seconds.
    pub total_s: f64,
}

/// The most that a program may print, bytes.
const MAX_PRINTED: u64 = 1 << 28;
/// The most that is kept of its errors, bytes.
const MAX_ERRORS: u64 = 1 << 16;
/// Interval between looks at a running program.
const PAUSE: Duration = Duration::from_millis(2);
/// Time after its end by which its output is there.
const LAST_WORDS: Duration = Duration::from_secs(5);

/// Runs a program with a text on its stdin, and ends it where it takes longer than a time.
///
/// # Errors
/// A program that cannot be started, that fails, or that does not end in time.
pub fn run(command: &mut Command, input: String, within: Duration) -> Result<Ended> {
    let begun = Instant::now();
    command.stdin(Stdio::piped());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let name = command.get_program().to_string_lossy().into_owned();
    let mut child = command.spawn();
    let child = child
        .as_mut()
        .map_err(|error| anyhow!("{name}: it cannot be started: {error}"))?;
    if let Some(mut stdin) = child.stdin.take() {
        // A program that answers without reading is no failure.
        thread::spawn(move || stdin.write_all(input.as_bytes()));
    }
    let stdout = collect(child.stdout.take(), MAX_PRINTED);
    let stderr = collect(child.stderr.take(), MAX_ERRORS);
    let status = wait(child, begun, within)?;
    let total_s = begun.elapsed().as_secs_f64();
    if !status.success() {
        let errors = stderr.recv_timeout(LAST_WORDS).unwrap_or_default();
        bail!("{status}: {}", last_line(&errors));
    }
    let stdout = stdout.recv_timeout(LAST_WORDS);
    let stdout = stdout.context("its output does not end with it")?;
    if stdout.len() as u64 > MAX_PRINTED {
        bail!("it has printed more than {MAX_PRINTED} bytes");
    }
    let stdout = String::from_utf8(stdout).context("its output")?;
    Ok(Ended { stdout, total_s })
}

/// Reads on a thread of its own, one byte more than is allowed at most; the rest is thrown away,
/// so that the program is not held up.
fn collect(source: Option<impl Read + Send + 'static>, most: u64) -> Receiver<Vec<u8>> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut source) = source {
            let _ = source.by_ref().take(most + 1).read_to_end(&mut bytes);
            let _ = std::io::copy(&mut source, &mut std::io::sink());
        }
        // Nobody listens any more where the program took too long.
        let _ = sender.send(bytes);
    });
    receiver
}

fn wait(child: &mut Child, begun: Instant, within: Duration) -> Result<ExitStatus> {
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(status);
        }
        if begun.elapsed() > within {
            // It may end by itself just now.
            let _ = child.kill();
            let _ = child.wait();
            bail!(
                "ended after {:.1} s without an answer",
                within.as_secs_f64()
            );
        }
        thread::sleep(PAUSE);
    }
}

/// The last line that says something, which is where most programs tell their error.
fn last_line(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let line = text.lines().map(str::trim).rfind(|line| !line.is_empty());
    line.unwrap_or("no word of why").chars().take(300).collect()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn sh(script: &str, input: &str, within_ms: u64) -> Result<Ended> {
        let mut command = Command::new("sh");
        let command = command.args(["-c", script]);
        run(command, input.to_owned(), Duration::from_millis(within_ms))
    }

    #[test]
    fn a_document_in_and_a_document_out() {
        assert_eq!(sh("cat", "so it is", 60_000).unwrap().stdout, "so it is");
        let large = "x".repeat(1 << 20);
        assert_eq!(sh("cat", &large, 60_000).unwrap().stdout, large);
        assert_eq!(
            sh("echo at once", &large, 60_000).unwrap().stdout,
            "at once\n"
        );
    }

    #[test]
    fn what_goes_wrong_is_told() {
        let error = |script, ms| sh(script, "", ms).unwrap_err().to_string();
        assert!(error("echo first >&2; echo why >&2; exit 3", 60_000).ends_with("3: why"));
        assert!(error("exec sleep 60", 200).contains("ended after 0.2 s"));
        let mut nothing = Command::new("./no-such-program");
        let told = run(&mut nothing, String::new(), LAST_WORDS).unwrap_err();
        assert!(
            told.to_string()
                .contains("./no-such-program: it cannot be started")
        );
    }
}
