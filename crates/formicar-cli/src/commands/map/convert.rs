//! `map convert`: a map in another format.

use super::args::ConvertArgs;
use super::files;
use super::files::Frame;
use crate::failure::{Ending, Failure};
use std::io::Write;

/// Carries out `map convert`.
pub(super) fn run(args: &ConvertArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let grid = files::read(&args.source)?;
    let grid = match args.unknown {
        Some(policy) => grid.with_unknown(policy),
        None => grid,
    };
    let frame = if args.drop_frame {
        Frame::Drop
    } else {
        Frame::Keep
    };
    files::write(&args.out, &grid, frame)?;
    writeln!(
        out,
        "{}: {} x {} cells of {} m",
        args.out.display(),
        grid.frame().n_cols(),
        grid.frame().n_rows(),
        grid.frame().resolution_m()
    )?;
    Ok(Ending::Done)
}
