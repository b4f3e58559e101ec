//! MACHINE.md: where and how the results were measured.

use formicar_lab::report::Fact;
use std::fmt::Write;
use std::fs;
use std::thread::available_parallelism;

/// The machine, the program and the command, as Markdown; what is unknown is left out.
pub(crate) fn description() -> String {
    let mut text = "# Machine\n\n| | |\n|---|---|\n".to_owned();
    for Fact { name, value } in facts() {
        let _ = writeln!(text, "| {name} | {} |", value.replace('|', "\\|"));
    }
    text
}

/// What is known of the machine, the program and the command.
pub(crate) fn facts() -> Vec<Fact> {
    let read = |path: &str| fs::read_to_string(path).unwrap_or_default();
    let facts = [
        ("Processor", processor()),
        ("Cores", available_parallelism().ok().map(|n| n.to_string())),
        ("Memory", memory(&read("/proc/meminfo"))),
        ("System", Some(system(&read("/etc/os-release")))),
        ("formicar", Some(env!("CARGO_PKG_VERSION").to_owned())),
        ("Build", Some(build().to_owned())),
        ("Compiler", option_env!("FORMICAR_RUSTC").map(str::to_owned)),
        ("Command", Some(command())),
    ];
    let known = facts
        .into_iter()
        .filter_map(|(name, fact)| Some(Fact::new(name, fact?)));
    known.filter(|fact| !fact.value.is_empty()).collect()
}

/// The machine in a line, which tells machines apart as far as times go.
pub(crate) fn name() -> String {
    let memory = memory(&fs::read_to_string("/proc/meminfo").unwrap_or_default());
    let cores = available_parallelism().ok().map(|n| format!("{n} cores"));
    let parts = [processor(), cores, memory];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// The processor's name.
pub(crate) fn processor() -> Option<String> {
    let cpuinfo = fs::read_to_string("/proc/cpuinfo").ok()?;
    value(&cpuinfo, "model name", ':')
}

/// The value behind a key, of the first line that has it.
fn value(text: &str, key: &str, mark: char) -> Option<String> {
    let mut pairs = text.lines().filter_map(|line| line.split_once(mark));
    let (_, value) = pairs.find(|(name, _)| name.trim() == key)?;
    Some(value.trim().trim_matches('"').to_owned())
}

fn memory(meminfo: &str) -> Option<String> {
    let kibibytes: f64 = value(meminfo, "MemTotal", ':')?
        .trim_end_matches("kB")
        .trim()
        .parse()
        .ok()?;
    Some(format!("{:.1} GiB", kibibytes / f64::from(1 << 20)))
}

fn system(os_release: &str) -> String {
    let name = value(os_release, "PRETTY_NAME", '=').unwrap_or_default();
    let kernel = fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
    let parts = [
        name.as_str(),
        std::env::consts::OS,
        kernel.trim(),
        std::env::consts::ARCH,
    ];
    let parts: Vec<_> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.join(", ")
}

fn build() -> &'static str {
    if cfg!(debug_assertions) {
        "debug: times mean nothing"
    } else {
        "release"
    }
}

/// The command line, without the folders that the program lies in.
fn command() -> String {
    let words = std::env::args().skip(1);
    let words = words.map(|word| {
        if word.contains([' ', '\'', '"']) {
            format!("{word:?}")
        } else {
            word
        }
    });
    let words: Vec<_> = std::iter::once("formicar".to_owned())
        .chain(words)
        .collect();
    format!("`{}`", words.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_facts() {
        let cpuinfo = "processor\t: 0\nmodel name\t: A fast one @ 3 GHz\n";
        let name = value(cpuinfo, "model name", ':');
        assert_eq!(name.as_deref(), Some("A fast one @ 3 GHz"));
        let memory = memory("MemTotal:       16777216 kB\n");
        assert_eq!(memory.as_deref(), Some("16.0 GiB"));
        assert!(
            system(
                "PRETTY_NAME=\"Some OS 1\"
"
            )
            .starts_with("Some OS 1, ")
        );
        assert!(description().contains("| formicar | "));
    }
}
