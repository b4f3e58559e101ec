//! Runs the binary, and makes small maps for it.

use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Whether tests run in full, as in the slow tier.
pub(crate) fn runs_slow_tests() -> bool {
    std::env::var_os("FORMICAR_SLOW").is_some()
}

/// What a run printed, and its exit code.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Run {
    /// The only line of stdout, as JSON.
    pub(crate) fn json(&self) -> Value {
        assert_eq!(
            self.stdout.lines().count(),
            1,
            "{}{}",
            self.stdout,
            self.stderr
        );
        serde_json::from_str(&self.stdout).unwrap()
    }

    /// Asserts that stdout holds some words.
    pub(crate) fn assert_says(&self, words: &str) {
        assert!(
            self.stdout.contains(words),
            "no {words:?} in: {}",
            self.stdout
        );
    }

    /// Asserts that the input was refused in words, without a panic.
    pub(crate) fn assert_refused(&self, words: &[&str]) {
        assert_eq!(self.code, 2, "{}{}", self.stdout, self.stderr);
        assert_eq!(self.stdout, "");
        assert!(!self.stderr.contains("panicked"), "{}", self.stderr);
        for word in words {
            assert!(
                self.stderr.contains(word),
                "no {word:?} in: {}",
                self.stderr
            );
        }
    }
}

/// Runs `formicar` with words, in a folder.
pub(crate) fn formicar_in(folder: &Path, args: &[&str], input: &str) -> Run {
    let mut child = Command::new(env!("CARGO_BIN_EXE_formicar"))
        .args(args)
        .current_dir(folder)
        // The help is as wide as the terminal says.
        .env_remove("COLUMNS")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A run that refuses its flags does not read.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    let output = child.wait_with_output().unwrap();
    Run {
        code: output.status.code().unwrap(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

/// A room of 12 x 8 m at 0.2 m: walls around it and one across, with a door.
pub(crate) struct Room {
    pub(crate) folder: tempfile::TempDir,
}

/// The default vehicle as a file, without limits of steering rate, speed and acceleration.
pub(crate) const BARE_VEHICLE: &str = "wheelbase_m = 0.65\nwidth_m = 0.62\n\
    front_overhang_m = 0.125\nrear_overhang_m = 0.125\nmax_steer_deg = 40\n";

const N_COLS: usize = 60;
const N_ROWS: usize = 40;

impl Room {
    /// Writes `room.yaml` and `room.pgm`.
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let wall = |col: usize, row: usize| {
            let around = col == 0 || row == 0 || col == N_COLS - 1 || row == N_ROWS - 1;
            around || (col == 30 && row < 26)
        };
        let mut image = format!("P5\n{N_COLS} {N_ROWS}\n255\n").into_bytes();
        for row in (0..N_ROWS).rev() {
            image.extend((0..N_COLS).map(|col| if wall(col, row) { 0 } else { 254 }));
        }
        fs::write(folder.path().join("room.pgm"), image).unwrap();
        let yaml = "image: room.pgm\nresolution: 0.2\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n\
                    occupied_thresh: 0.65\nfree_thresh: 0.196\n";
        fs::write(folder.path().join("room.yaml"), yaml).unwrap();
        Self { folder }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.path(name), contents).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// Runs in the room's folder.
    pub(crate) fn run(&self, args: &[&str]) -> Run {
        formicar_in(self.folder.path(), args, "")
    }

    /// Plans through the door of the room, with more flags.
    pub(crate) fn plan(&self, more: &[&str]) -> Run {
        let through = [
            "plan",
            "--map",
            "room.yaml",
            "--start",
            "2,2,0",
            "--goal",
            "10,2,-90deg",
        ];
        self.run(&[&through[..], more].concat())
    }

    /// Files in the folder, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let name = |entry: std::io::Result<fs::DirEntry>| {
            entry.unwrap().file_name().into_string().unwrap()
        };
        let mut names: Vec<_> = entries.map(name).collect();
        names.sort();
        names
    }
}

/// The rows of a table, by column.
pub(crate) struct Table {
    columns: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

/// Columns that differ from run to run.
const VARYING: [&str; 13] = [
    "cold_first_s",
    "map_setup_cpu_s",
    "first_feasible_cpu_s",
    "cold_first_cpu_s",
    "query_cpu_s",
    "judge_s",
    "map_setup_s",
    "first_feasible_s",
    "query_s",
    "total_s",
    "cpu_s",
    "peak_rss_bytes",
    "machine",
];

impl Table {
    pub(crate) fn of(text: &str) -> Self {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let owned = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        Self {
            columns: owned(reader.headers().unwrap()),
            rows: reader.records().map(|row| owned(&row.unwrap())).collect(),
        }
    }

    pub(crate) fn get(&self, row: usize, column: &str) -> &str {
        let column = self.columns.iter().position(|c| c == column);
        &self.rows[row][column.expect("a column of this name")]
    }

    /// All values of a column.
    pub(crate) fn column(&self, column: &str) -> Vec<&str> {
        (0..self.rows.len()).map(|i| self.get(i, column)).collect()
    }

    /// The rows without times and memory.
    pub(crate) fn repeatable(&self) -> Vec<Vec<&str>> {
        let kept = |row: usize| {
            let columns = self.columns.iter().map(String::as_str);
            // A slow machine may know no path yet at 0.1 s.
            let columns = columns.filter(|c| !VARYING.contains(c) && !c.contains("1s"));
            columns.map(|c| self.get(row, c)).collect()
        };
        (0..self.rows.len()).map(kept).collect()
    }
}
