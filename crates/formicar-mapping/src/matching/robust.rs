//! Robust losses: how much a residual counts.

use serde::{Deserialize, Serialize};

/// A loss of a squared residual; its scale is in meters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "loss", rename_all = "snake_case", deny_unknown_fields)]
pub enum Robust {
    /// Half the square.
    Square,
    /// Square up to the scale, linear beyond.
    Huber {
        /// The scale, meters.
        scale_m: f64,
    },
    /// Logarithmic beyond the scale.
    Cauchy {
        /// The scale, meters.
        scale_m: f64,
    },
    /// Bounded: what lies far beyond the scale costs the same everywhere (Geman and `McClure`).
    GemanMcClure {
        /// The scale, meters.
        scale_m: f64,
    },
}

impl Robust {
    /// The loss, square meters.
    pub fn loss(self, residual: f64) -> f64 {
        let square = residual * residual;
        match self {
            Self::Square => 0.5 * square,
            Self::Huber { scale_m } if residual.abs() <= scale_m => 0.5 * square,
            Self::Huber { scale_m } => scale_m * (residual.abs() - 0.5 * scale_m),
            Self::Cauchy { scale_m } => {
                let s = scale_m * scale_m;
                0.5 * s * (square / s).ln_1p()
            }
            Self::GemanMcClure { scale_m } => {
                let s = scale_m * scale_m;
                0.5 * square * s / (s + square)
            }
        }
    }

    /// The weight of the residual in a least squares step: the slope of the loss over the residual.
    pub fn weight(self, residual: f64) -> f64 {
        let square = residual * residual;
        match self {
            Self::Square => 1.0,
            Self::Huber { scale_m } => (scale_m / residual.abs()).min(1.0),
            Self::Cauchy { scale_m } => 1.0 / (1.0 + square / (scale_m * scale_m)),
            Self::GemanMcClure { scale_m } => {
                let s = scale_m * scale_m;
                (s / (s + square)).powi(2)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_is_the_slope_over_the_residual() {
        for loss in [
            Robust::Square,
            Robust::Huber { scale_m: 0.1 },
            Robust::Cauchy { scale_m: 0.1 },
            Robust::GemanMcClure { scale_m: 0.1 },
        ] {
            for residual in [-0.4, -0.05, 0.03, 0.2, 1.0] {
                let h = 1e-6;
                let slope = (loss.loss(residual + h) - loss.loss(residual - h)) / (2.0 * h);
                let weight = loss.weight(residual);
                assert!(
                    (slope - weight * residual).abs() < 1e-6,
                    "{loss:?} {residual}"
                );
            }
        }
    }
}
