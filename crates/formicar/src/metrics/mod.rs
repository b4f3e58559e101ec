//! metrics: to come.

/// Exact metrics of a path (stub).
#[derive(Clone, Debug, serde::Serialize, schemars::JsonSchema)]
pub struct PathMetrics {
    /// Driven length.
    pub length_m: f64,
}
