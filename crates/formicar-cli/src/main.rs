//! The command line of formicar.
fn main() {}
