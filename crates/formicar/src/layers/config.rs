//! Parameters of the layers.

use crate::parameters::{OutOfRange, Parameters, Range, parameters};

/// The most cells that [`Expansion::Cells`] may ask for.
pub const MAX_EXPANSION_CELLS: u32 = 64;

/// A share of a cell by which a width may exceed whole cells and still count as whole, so that
/// rounding adds no cell.
const WIDTH_TOLERANCE_CELLS: f64 = 1e-6;

parameters! {
    /// Cells that are blocked in addition before ants walk on a map; by default none.
    #[derive(Default, Eq)]
    pub struct LayersConfig {
        /// Growth of obstacles: `none`, `half-width` (of the vehicle), or `{ cells = n }`.
        pub expansion: Expansion,
        /// Treatment of U-shaped areas of obstacles: `keep` or `close`.
        pub u_shapes: UShapes,
    }
}

/// The growth of obstacles in cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Expansion {
    /// By none.
    #[default]
    None,
    /// By half the vehicle's width, rounded up to whole cells (Lei 2020, sec. II.B).
    HalfWidth,
    /// By a number of cells, 0 to [`MAX_EXPANSION_CELLS`].
    Cells(#[cfg_attr(feature = "schema", schemars(range(min = 0, max = MAX_EXPANSION_CELLS)))] u32),
}

impl Parameters for Expansion {
    fn check(&self) -> Result<(), OutOfRange> {
        match self {
            Self::None | Self::HalfWidth => Ok(()),
            Self::Cells(n_cells) => {
                Range::of::<u32>(0..=MAX_EXPANSION_CELLS).check("cells", n_cells)
            }
        }
    }
}

impl Expansion {
    /// The number of cells for a vehicle whose width is given in cells.
    pub fn n_cells(self, vehicle_width_cells: f64) -> u32 {
        match self {
            Self::None => 0,
            Self::HalfWidth => (0.5 * vehicle_width_cells - WIDTH_TOLERANCE_CELLS).ceil() as u32,
            Self::Cells(n_cells) => n_cells,
        }
    }
}

/// The treatment of areas that an obstacle encloses on three sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum UShapes {
    /// They stay open.
    #[default]
    Keep,
    /// They are closed where that lengthens no path around them (Lei 2020, sec. II.C).
    Close,
}

impl Parameters for UShapes {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_width_is_rounded_up_to_cells_but_not_by_rounding_errors() {
        let n_cells =
            |width_m: f64, resolution_m: f64| Expansion::HalfWidth.n_cells(width_m / resolution_m);
        // Lei 2020, sec. II.B: cells of half the vehicle's width.
        assert_eq!(n_cells(1.0, 0.5), 1);
        assert_eq!(n_cells(0.62, 0.05), 7);
        assert_eq!(n_cells(0.3, 0.05), 3);
        assert_eq!(n_cells(0.0, 0.05), 0);
        assert_eq!(Expansion::None.n_cells(8.0), 0);
        assert_eq!(Expansion::Cells(3).n_cells(8.0), 3);
    }

    #[test]
    fn words_are_read_back() {
        let config = LayersConfig {
            expansion: Expansion::Cells(2),
            u_shapes: UShapes::Close,
        };
        let json = serde_json::to_string(&config).unwrap();
        assert_eq!(json, r#"{"expansion":{"cells":2},"u_shapes":"close"}"#);
        assert_eq!(serde_json::from_str::<LayersConfig>(&json).unwrap(), config);
        let half: LayersConfig = serde_json::from_str(r#"{"expansion":"half-width"}"#).unwrap();
        assert_eq!(
            (half.expansion, half.u_shapes),
            (Expansion::HalfWidth, UShapes::Keep)
        );
        assert!(serde_json::from_str::<LayersConfig>(r#"{"expand":2}"#).is_err());
    }
}
