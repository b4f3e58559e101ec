//! `schema`, `completions`, `man`: what the program says about itself.

use crate::args::{Cli, Document, SchemaArgs};
use crate::failure::{Ending, Failure};
use clap::CommandFactory;
use formicar::planner::{Answer, PlannerConfig, RequestDocument};
use formicar::tracking::TrackingDocument;
use formicar::vehicle::VehicleParameters;
use std::io::Write;

/// Prints the JSON schema of a document.
pub(crate) fn schema(args: &SchemaArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let schema = match args.document {
        Document::Config => schemars::schema_for!(PlannerConfig),
        Document::Vehicle => schemars::schema_for!(VehicleParameters),
        Document::Request => schemars::schema_for!(RequestDocument),
        Document::Answer => schemars::schema_for!(Answer),
        Document::Track => schemars::schema_for!(TrackingDocument),
    };
    serde_json::to_writer_pretty(&mut *out, &schema).map_err(std::io::Error::from)?;
    writeln!(out)?;
    Ok(Ending::Done)
}

/// Prints the completions of a shell.
pub(crate) fn completions(
    shell: clap_complete::Shell,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    // The generator panics where its writer fails, so it never sees the pipe.
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "formicar", &mut text);
    out.write_all(&text)?;
    Ok(Ending::Done)
}

/// Prints the manual page.
pub(crate) fn man(out: &mut impl Write) -> Result<Ending, Failure> {
    clap_mangen::Man::new(Cli::command()).render(out)?;
    Ok(Ending::Done)
}
