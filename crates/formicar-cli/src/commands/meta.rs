//! `schema`, `completions`, `man`: the program describes itself.

use crate::failure::{Ending, Failure};
use clap::{Args, Command, ValueEnum};
use formicar::planner::{Answer, MovingDocument, PlannerConfig, RequestDocument};
use formicar::tracking::TrackingDocument;
use formicar::vehicle::VehicleParameters;
use std::io::Write;

/// Flags of `schema`.
#[derive(Args, Debug)]
pub(crate) struct SchemaArgs {
    /// The document.
    #[arg(default_value = "config")]
    document: Document,
}

/// Documents with a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Document {
    /// Planner parameters: `plan --config`, `plan --set`.
    Config,
    /// A vehicle file: `--vehicle`.
    Vehicle,
    /// A line of `plan --stdin`.
    Request,
    /// The output of `plan --json`.
    Answer,
    /// Moving obstacles: `plan --moving`, `check --moving`.
    Moving,
    /// The output of `track --json`.
    Track,
}

/// Prints the JSON schema of a document.
pub(crate) fn schema(args: &SchemaArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let schema = match args.document {
        Document::Config => schemars::schema_for!(PlannerConfig),
        Document::Vehicle => schemars::schema_for!(VehicleParameters),
        Document::Request => schemars::schema_for!(RequestDocument),
        Document::Answer => schemars::schema_for!(Answer),
        Document::Moving => schemars::schema_for!(MovingDocument),
        Document::Track => schemars::schema_for!(TrackingDocument),
    };
    serde_json::to_writer_pretty(&mut *out, &schema).map_err(std::io::Error::from)?;
    writeln!(out)?;
    Ok(Ending::Done)
}

/// Prints the completions of a command line for a shell.
pub(crate) fn completions(
    shell: clap_complete::Shell,
    mut command: Command,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    // The generator panics where its writer fails, so it never sees the pipe.
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut command, "formicar", &mut text);
    out.write_all(&text)?;
    Ok(Ending::Done)
}

/// Prints the manual page of a command line.
pub(crate) fn man(command: Command, out: &mut impl Write) -> Result<Ending, Failure> {
    clap_mangen::Man::new(command).render(out)?;
    Ok(Ending::Done)
}
