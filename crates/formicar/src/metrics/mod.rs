//! metrics: to come.

/// Exact metrics of a path (stub).
#[derive(Clone, Debug, serde::Serialize)]
pub struct PathMetrics {
    /// Driven length.
    pub length_m: f64,
}
