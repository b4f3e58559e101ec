//! Where the runs of a campaign go.

use crate::run::Run;
use anyhow::Result;

/// Takes the runs of a campaign as they end.
pub trait Sink {
    /// The runs that it has not taken yet, as indices in order.
    ///
    /// # Errors
    /// A file that cannot be read.
    fn missing(&self) -> Result<Vec<usize>>;

    /// Takes the run of an index; it is safe when this returns.
    ///
    /// # Errors
    /// A file that cannot be written.
    fn add(&mut self, index: usize, run: &Run) -> Result<()>;
}

/// Runs in memory, by index.
impl Sink for Vec<Option<Run>> {
    fn missing(&self) -> Result<Vec<usize>> {
        Ok((0..self.len()).filter(|i| self[*i].is_none()).collect())
    }

    fn add(&mut self, index: usize, run: &Run) -> Result<()> {
        self[index] = Some(run.clone());
        Ok(())
    }
}
