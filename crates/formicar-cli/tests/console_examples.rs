//! Every console example of the README and the book: it runs, and prints what the page shows.
//!
//! `FORMICAR_SLOW=1` also runs those that take more than some seconds; of these, and of those that
//! need files of others, the flags are parsed otherwise.

use crate::common::runs_slow_tests;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A command as a page shows it.
struct Example {
    page: PathBuf,
    command: String,
    /// The lines that the page shows below it.
    shown: Vec<String>,
}

/// How an example is tested that cannot simply be run.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Treatment {
    /// Run in the slow tier; its flags are parsed otherwise.
    Slow,
    /// Its flags are parsed.
    Flags,
    /// Another program.
    Skip,
}

/// The exceptions: what a command contains, its treatment and the reason.
const EXCEPTIONS: [(&str, Treatment, &str); 28] = [
    (
        "formicar drive",
        Treatment::Slow,
        "a drive through a warehouse, and its film",
    ),
    ("cargo ", Treatment::Skip, "what runs this test"),
    (
        "ompl_benchmark_statistics",
        Treatment::Skip,
        "a program of OMPL",
    ),
    (
        "formicar studio",
        Treatment::Flags,
        "serves until it is stopped",
    ),
    (
        "--with target/before",
        Treatment::Flags,
        "needs a build of before",
    ),
    (
        "map build",
        Treatment::Flags,
        "lidar logs are data of others",
    ),
    ("locate", Treatment::Flags, "lidar logs are data of others"),
    ("drive.mcap", Treatment::Flags, "bags are data of others"),
    ("ros2 ", Treatment::Skip, "ROS"),
    ("cars", Treatment::Flags, "car scenarios are data of others"),
    (
        "CaseN.csv",
        Treatment::Flags,
        "TPCAP cases are data of others",
    ),
    (
        "arena.map",
        Treatment::Flags,
        "MovingAI maps are data of others",
    ),
    ("smac/", Treatment::Flags, "paths of another planner"),
    (
        "import path.csv",
        Treatment::Flags,
        "paths of another planner",
    ),
    (
        "bench campaign.toml",
        Treatment::Flags,
        "a campaign of the reader's",
    ),
    ("before.", Treatment::Flags, "results of the reader's"),
    ("report r", Treatment::Flags, "results of the reader's"),
    ("junctions", Treatment::Slow, "a campaign"),
    ("guard", Treatment::Slow, "a campaign, in .ci/nightly"),
    ("bench narrow", Treatment::Slow, "a benchmark"),
    (
        "formicar stress --n 1000",
        Treatment::Slow,
        "1000 scenarios",
    ),
    (
        "formicar tune narrow",
        Treatment::Slow,
        "evaluates for minutes",
    ),
    ("tuned/tuned.toml", Treatment::Flags, "follows a tuning"),
    (
        "formicar reproduce",
        Treatment::Flags,
        "minutes; tests/reproduce.rs runs it small",
    ),
    ("formicar demo", Treatment::Flags, "tests/demo.rs runs it"),
    ("colony.n_ants=1000", Treatment::Slow, "a large colony"),
    (
        "--ants ants.gif",
        Treatment::Slow,
        "a film; tests/ants.rs makes another",
    ),
    (
        "--vehicle forklift.toml",
        Treatment::Slow,
        "a long improvement in narrow aisles",
    ),
];

fn treatment(command: &str) -> Option<Treatment> {
    let found = EXCEPTIONS
        .iter()
        .find(|(part, _, _)| command.contains(part));
    found.map(|&(_, treatment, _)| treatment)
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// All pages, in a fixed order.
fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("README.md")];
    let mut folders = vec![root().join("docs/src")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "md") {
                pages.push(path);
            }
        }
    }
    pages[1..].sort();
    pages
}

fn examples(page: &Path) -> Vec<Example> {
    let text = fs::read_to_string(page).unwrap();
    let mut examples: Vec<Example> = Vec::new();
    let (mut is_inside, mut continues) = (false, false);
    for line in text.lines() {
        if line.starts_with("```") {
            is_inside = line == "```console";
        } else if let Some(command) = line.strip_prefix("$ ").filter(|_| is_inside) {
            continues = command.ends_with('\\');
            examples.push(Example {
                page: page.to_owned(),
                command: command.trim_end_matches('\\').to_owned(),
                shown: Vec::new(),
            });
        } else if let Some(example) = examples.last_mut().filter(|_| is_inside) {
            if continues {
                continues = line.ends_with('\\');
                example.command += line.trim_end_matches('\\');
            } else {
                example.shown.push(line.to_owned());
            }
        }
    }
    examples
}

/// Runs a line in a shell that finds `formicar`.
fn shell(folder: &Path, line: &str) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_formicar"));
    let mut paths = vec![program.parent().unwrap().to_owned()];
    paths.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap()));
    Command::new("sh")
        .args(["-c", line])
        .current_dir(folder)
        .env("PATH", std::env::join_paths(paths).unwrap())
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// The files that pages take for granted: a map and a vehicle of the reader's, a path.
fn fill(folder: &Path) {
    let row = |y: usize| {
        let is_wall = |x: usize| x == 0 || y == 0 || x == 299 || y == 149 || (x == 120 && y > 120);
        let cells = (0..300).map(|x| if is_wall(x) { '1' } else { '0' });
        cells.collect::<String>()
    };
    let rows: Vec<String> = (0..150).map(row).collect();
    fs::write(folder.join("hall.txt"), rows.join("\n")).unwrap();
    for map in ["depot", "lawn", "costmap", "keepout_mask"] {
        let line = format!("formicar map convert hall.txt {map}.yaml --resolution 0.1");
        assert!(shell(folder, &line).status.success(), "{line}");
    }
    for (page, file) in [
        ("first-hour.md", "forklift.toml"),
        ("campaigns.md", "junctions.toml"),
    ] {
        let text = fs::read_to_string(root().join("docs/src").join(page)).unwrap();
        let (_, block) = text.split_once("```toml\n").unwrap();
        let (block, _) = block.split_once("```").unwrap();
        fs::write(folder.join(file), block).unwrap();
    }
    let crossing = root().join("docs/src/crossing.json");
    fs::copy(crossing, folder.join("crossing.json")).unwrap();
    let steered = "wheelbase_m = 1.4\nwidth_m = 1.0\nfront_overhang_m = 0.3\n\
                   rear_overhang_m = 0.4\nmax_steer_deg = 40\n\
                   max_steer_rate_rad_per_s = 0.5\nspeed_mps = 1.0\n";
    fs::write(folder.join("steered.toml"), steered).unwrap();
    fs::write(
        folder.join("theirs.csv"),
        "x,y,heading\n2,3,0\n4,3,0\n6,3,0\n",
    )
    .unwrap();
    let plan = "formicar plan --map parking-lot --request back-in --set improve.max_tries=0 \
                --set drive.n_stalled=0 --out plan.json";
    assert!(shell(folder, plan).status.success());
}

/// A line without times, which differ from run to run.
fn without_times(line: &str) -> &str {
    line.split("first path")
        .next()
        .unwrap_or_default()
        .trim_end()
}

fn run(example: &Example, folder: &Path) {
    let command = &example.command;
    let output = shell(folder, command);
    let page = example.page.display();
    let stderr = String::from_utf8_lossy(&output.stderr);
    // Some pages show how a search ends without a path: exit code 3.
    let is_ended = matches!(output.status.code(), Some(0 | 3));
    assert!(is_ended, "{page}: {command}\n{stderr}");
    let stdout = String::from_utf8_lossy(&output.stdout);
    let printed: Vec<_> = stdout.lines().map(without_times).collect();
    let shown: Vec<_> = example.shown.iter().map(|l| without_times(l)).collect();
    if !shown.is_empty() {
        assert_eq!(printed, shown, "{page} shows otherwise: {command}");
    }
}

fn parse_flags(example: &Example, folder: &Path) {
    let command = example.command.split(" #").next().unwrap_or_default();
    let output = shell(folder, &format!("{command} --help"));
    let stderr = String::from_utf8_lossy(&output.stderr);
    let page = example.page.display();
    assert!(output.status.success(), "{page}: {command}\n{stderr}");
}

#[test]
fn examples_do_what_their_pages_say() {
    let runs_slow = runs_slow_tests();
    let mut n_run = 0;
    for page in pages() {
        let folder = tempfile::tempdir().unwrap();
        let examples = examples(&page);
        let runs = |example: &Example| match treatment(&example.command) {
            None => true,
            Some(Treatment::Slow) => runs_slow,
            Some(Treatment::Flags | Treatment::Skip) => false,
        };
        if examples.iter().any(&runs) {
            fill(folder.path());
        }
        for example in &examples {
            if runs(example) {
                run(example, folder.path());
                n_run += 1;
            } else if treatment(&example.command) != Some(Treatment::Skip) {
                parse_flags(example, folder.path());
            }
        }
    }
    assert!(n_run > 30, "{n_run} examples were run");
}

#[test]
fn every_exception_has_an_example() {
    let commands: Vec<_> = pages().iter().flat_map(|p| examples(p)).collect();
    for (part, treatment, reason) in EXCEPTIONS {
        let is_used = commands.iter().any(|e| e.command.contains(part));
        assert!(
            is_used,
            "{treatment:?} of {part:?} ({reason}) fits no example"
        );
    }
}
