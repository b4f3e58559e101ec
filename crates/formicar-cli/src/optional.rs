//! Commands that a build may leave out, and the message for them.

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// A feature of this crate and the commands that it brings.
struct Feature {
    name: &'static str,
    is_built: bool,
    commands: &'static [&'static str],
}

const FEATURES: [Feature; 5] = [
    Feature {
        name: "drive",
        is_built: cfg!(feature = "drive"),
        commands: &["drive"],
    },
    Feature {
        name: "lab",
        is_built: cfg!(feature = "lab"),
        commands: &[
            "bench",
            "compare",
            "demo",
            "import",
            "report",
            "reproduce",
            "stress",
            "tune",
        ],
    },
    Feature {
        name: "mapping",
        is_built: cfg!(feature = "mapping"),
        commands: &["locate", "build", "evaluate"],
    },
    Feature {
        name: "record",
        is_built: cfg!(feature = "record"),
        commands: &["plan --record"],
    },
    Feature {
        name: "studio",
        is_built: cfg!(feature = "studio"),
        commands: &["studio"],
    },
];

/// A line for the help that names the commands of absent features; empty in a full build.
pub(crate) fn note() -> String {
    let absent = FEATURES.iter().filter(|feature| !feature.is_built);
    let lines = absent.map(|feature| {
        let (commands, name) = (feature.commands.join(", "), feature.name);
        format!("\nNot in this build: {commands} (feature `{name}`).")
    });
    lines.collect()
}

/// The error to show for an unknown command: one of an absent feature says how to get it.
pub(crate) fn explain(error: clap::Error) -> clap::Error {
    let Some(ContextValue::String(command)) = error.get(ContextKind::InvalidSubcommand) else {
        return error;
    };
    let absent = FEATURES.iter().filter(|feature| !feature.is_built);
    let mut absent = absent.filter(|feature| feature.commands.contains(&command.as_str()));
    let Some(feature) = absent.next() else {
        return error;
    };
    let name = feature.name;
    let text = format!(
        "`{command}` is not in this build, which lacks the feature `{name}`; hint: cargo install \
         formicar-cli --features {name}\n"
    );
    clap::Error::raw(ErrorKind::InvalidSubcommand, text)
}
