//! `studio`: the page in the browser.

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
    /// Port of the page; 0 for any free one.
    #[arg(long, default_value_t = Options::DEFAULT_PORT)]
    port: u16,

    /// Open the page in the browser.
    #[arg(long)]
    open: bool,

    /// Address to listen on; other machines reach it only if it is not loopback, which needs --token.
    #[arg(long, value_name = "IP", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    address: IpAddr,

    /// Token that visitors must present: at least 16 letters and digits.
    #[arg(long, env = "FORMICAR_STUDIO_TOKEN", hide_env_values = true)]
    token: Option<String>,

    /// The most cells of a map that visitors upload.
    #[arg(long, value_name = "N", default_value_t = Limits::default().max_cells)]
    max_cells: usize,

    /// Largest upload, MiB.
    #[arg(long, value_name = "MIB", default_value_t = Limits::default().max_upload_bytes / MIB,
          value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=1024))]
    max_upload: usize,

    /// Plans at a time; further ones wait in line. One per processor by default.
    #[arg(long, value_name = "N",
          value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=256))]
    plans: Option<usize>,
}

/// Carries out `studio`: serves the page until interrupted.
pub(crate) fn run(args: &StudioArgs) -> Result<Ending, Failure> {
    let limits = Limits::default();
    let options = Options {
        address: args.address,
        port: args.port,
        token: args.token.clone(),
        limits: Limits {
            max_cells: args.max_cells,
            max_upload_bytes: args.max_upload * MIB,
            // A map is sent as a single message.
            max_unsent_bytes: limits.max_unsent_bytes.max(args.max_cells),
            max_plans: args.plans.unwrap_or(limits.max_plans),
            ..limits
        },
    };
    let served = serve(options, |address| {
        note(&format!("studio at {address} (stop it with Ctrl-C)"));
        if args.open && open(address).is_err() {
            note("no browser could be started; hint: open the address yourself");
        }
    });
    served.map_err(|error| Failure::Input(error.into()))?;
    Ok(Ending::Done)
}

/// Opens an address in the desktop's browser.
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
