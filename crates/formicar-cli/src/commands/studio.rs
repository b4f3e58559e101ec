//! `studio`: the page that shows ants at work.

use crate::failure::{Ending, Failure, note};
use clap::Args;
use formicar_studio::{Limits, Options, serve};
use std::net::{IpAddr, Ipv4Addr};
use std::process::{Command, Stdio};

/// Bytes of a mebibyte.
const MIB: usize = 1 << 20;

/// Flags of `studio`.
#[derive(Args, Debug)]
pub(crate) struct StudioArgs {
    /// Port of the page; 0 for any that is free.
    #[arg(long, default_value_t = Options::DEFAULT_PORT)]
    port: u16,

    /// Open the page in the browser.
    #[arg(long)]
    open: bool,

    /// Address to listen at; others reach only one that is not loopback, which needs --token.
    #[arg(long, value_name = "IP", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    address: IpAddr,

    /// What visitors must know: at least 16 letters and digits.
    #[arg(long, env = "FORMICAR_STUDIO_TOKEN", hide_env_values = true)]
    token: Option<String>,

    /// Most cells of a map that visitors bring.
    #[arg(long, value_name = "N", default_value_t = Limits::default().max_cells)]
    max_cells: usize,

    /// Largest upload, MiB.
    #[arg(long, value_name = "MIB", default_value_t = Limits::default().max_upload_bytes / MIB,
          value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=1024))]
    max_upload: usize,

    /// Plans at a time; more wait for their turn. As many as the machine has processors by default.
    #[arg(long, value_name = "N",
          value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=256))]
    plans: Option<usize>,
}

/// Carries out `studio`: serves until it is interrupted.
pub(crate) fn run(args: &StudioArgs) -> Result<Ending, Failure> {
    let limits = Limits::default();
    let options = Options {
        address: args.address,
        port: args.port,
        token: args.token.clone(),
        limits: Limits {
            max_cells: args.max_cells,
            max_upload_bytes: args.max_upload * MIB,
            // Maps are sent whole.
            max_unsent_bytes: limits.max_unsent_bytes.max(args.max_cells),
            max_plans: args.plans.unwrap_or(limits.max_plans),
            ..limits
        },
    };
    let served = serve(options, |address| {
        note(&format!("studio at {address} (end it with Ctrl-C)"));
        if args.open && open(address).is_err() {
            note("no browser could be started; open the address yourself");
        }
    });
    served.map_err(|error| Failure::Input(error.into()))?;
    Ok(Ending::Done)
}

/// Asks the desktop to show an address.
fn open(address: &str) -> std::io::Result<()> {
    let opener = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let mut command = Command::new(opener);
    let silent = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    silent.arg(address).spawn().map(|_| ())
}
