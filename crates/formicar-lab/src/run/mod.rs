//! Runs of planners: how they are spread over threads.

pub(crate) mod pool;
