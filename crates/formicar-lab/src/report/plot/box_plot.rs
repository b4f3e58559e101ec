//! Spread of values: box plots with every value.

use crate::analysis::statistics::quartiles;
use formicar::render::{Axis, AxisScale, BoxRow, Chart, ChartGrid, Limit};
use serde::Serialize;

/// Whiskers reach the farthest value within so many box lengths of the box (Tukey 1977).
const WHISKER: f64 = 1.5;

/// The values of one group.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BoxGroup {
    /// Its name.
    pub name: String,
    /// Its values in any order.
    pub values: Vec<f64>,
}

impl BoxGroup {
    fn row(&self) -> BoxRow {
        let values = self.values.clone();
        let quartiles = quartiles(&values);
        BoxRow {
            name: self.name.clone(),
            quartiles,
            whiskers: quartiles.map_or([f64::NAN; 2], |quartiles| whiskers(&values, quartiles)),
            values,
        }
    }
}

/// The farthest values within [`WHISKER`] box lengths of the box.
fn whiskers(values: &[f64], [low, _, high]: [f64; 3]) -> [f64; 2] {
    let reach = WHISKER * (high - low);
    let is_within = |v: &&f64| (low - reach..=high + reach).contains(*v);
    let within = values.iter().filter(is_within);
    within.fold([low, high], |[a, b], &v| [a.min(v), b.max(v)])
}

/// Boxes from quartile to quartile with the median, whiskers to the farthest value within 1.5 box
/// lengths, and every value as a dot; a row per group.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BoxPlot {
    /// The caption below the picture.
    pub caption: String,
    /// Quantity and unit.
    pub quantity: String,
    /// The scale of its axis.
    pub scale: AxisScale,
    /// The groups from above down.
    pub groups: Vec<BoxGroup>,
    /// A value to be marked with a line over all rows, and its name.
    pub reference: Option<(f64, String)>,
}

impl BoxPlot {
    /// The picture.
    pub fn to_svg(&self) -> String {
        let reference = self.reference.clone();
        let chart = Chart {
            x: Axis {
                scale: self.scale,
                ..Axis::named(&self.quantity)
            },
            boxes: self.groups.iter().map(BoxGroup::row).collect(),
            reference: reference.map(|(value, label)| Limit { label, value }),
            ..Chart::default()
        };
        let grid = ChartGrid {
            title: format!("Box plot: {}", self.quantity),
            charts: vec![chart],
            n_columns: 1,
            ..ChartGrid::default()
        };
        grid.to_svg()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_drawn_and_strays_are_beyond_the_whiskers() {
        let plot = BoxPlot {
            quantity: "length < 9, m".to_owned(),
            groups: vec![
                BoxGroup {
                    name: "ants".to_owned(),
                    values: vec![1.0, 2.0, 3.0, 4.0, 30.0],
                },
                BoxGroup {
                    name: "none".to_owned(),
                    values: Vec::new(),
                },
            ],
            reference: Some((2.0, "optimum".to_owned())),
            ..BoxPlot::default()
        };
        let svg = plot.to_svg();
        assert_eq!(svg.matches("<circle").count(), 5);
        // The page, the frame and a box.
        assert_eq!(svg.matches("<rect").count(), 3);
        assert!(svg.contains("length &lt; 9, m") && svg.contains(">optimum</text>"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert_eq!(svg, plot.to_svg());
    }
}
