//! How values are spread: box plots with every value.

use super::axis::{Scale, ScaleKind};
use super::canvas::{Anchor, Canvas, FIRST, INK, MUTED, Pen, SECOND, TEXT_PX, width_px};
use crate::analysis::statistics::quartiles;
use serde::Serialize;

const WIDTH_PX: f64 = 1000.0;
const ROW_PX: f64 = 27.0;
const HALF_BOX_PX: f64 = 8.0;
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

/// Boxes from quartile to quartile with the median, whiskers to the farthest value within 1.5 box
/// lengths, and every value as a dot; a row per group.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BoxPlot {
    /// What it shows.
    pub caption: String,
    /// Quantity and unit.
    pub quantity: String,
    /// Whether the axis is logarithmic.
    pub scale: ScaleKind,
    /// The groups from above down.
    pub groups: Vec<BoxGroup>,
    /// A value to be marked with a line over all rows, and its name.
    pub reference: Option<(f64, String)>,
}

impl BoxPlot {
    /// The picture.
    pub fn to_svg(&self) -> String {
        let names = self.groups.iter().map(|group| width_px(&group.name));
        let left_px = names.fold(40.0, f64::max) + 14.0;
        let top_px = if self.reference.is_some() { 24.0 } else { 6.0 };
        let bottom_px = top_px + ROW_PX * self.groups.len() as f64 + 4.0;
        let values = self.groups.iter().flat_map(|group| group.values.iter());
        let marked = self.reference.iter().map(|reference| reference.0);
        let scale = Scale::fit(
            values.copied().chain(marked),
            self.scale,
            [left_px, WIDTH_PX - 16.0],
        );
        let mut canvas = Canvas::default();
        scale.draw_below(&mut canvas, [top_px, bottom_px], &self.quantity);
        if let Some((value, name)) = &self.reference {
            let x = scale.px(*value);
            let pen = Pen {
                color: SECOND,
                width_px: 1.3,
                dash: "5 3",
            };
            canvas.line([x, top_px], [x, bottom_px], pen);
            let anchor = if x > 0.5 * WIDTH_PX {
                Anchor::End
            } else {
                Anchor::Start
            };
            canvas.text([x, top_px - 8.0], name, (anchor, SECOND));
        }
        for (i, group) in self.groups.iter().enumerate() {
            let y = top_px + ROW_PX * (i as f64 + 0.5);
            let place = [left_px - 8.0, y + 0.35 * TEXT_PX];
            canvas.text(place, &group.name, (Anchor::End, INK));
            draw(&mut canvas, &scale, y, &group.values);
        }
        canvas.document(
            [WIDTH_PX, bottom_px + 2.0 * TEXT_PX + 16.0],
            &format!("Box plot: {}", self.quantity),
        )
    }
}

fn draw(canvas: &mut Canvas, scale: &Scale, y: f64, values: &[f64]) {
    let Some([low, median, high]) = quartiles(values) else {
        let place = [scale.left_px() + 6.0, y + 0.35 * TEXT_PX];
        canvas.text(place, "no value", (Anchor::Start, MUTED));
        return;
    };
    let reach = WHISKER * (high - low);
    let within = |v: &&f64| (low - reach..=high + reach).contains(*v);
    let (from, to) = values
        .iter()
        .filter(within)
        .fold((low, high), |(a, b), &v| (a.min(v), b.max(v)));
    let pen = Pen::new(FIRST, 1.4);
    for [a, b] in [[from, low], [high, to]] {
        canvas.line([scale.px(a), y], [scale.px(b), y], pen);
    }
    for end in [from, to] {
        let x = scale.px(end);
        canvas.line([x, y - 4.0], [x, y + 4.0], pen);
    }
    canvas.rectangle(
        [scale.px(low), y - HALF_BOX_PX],
        [scale.px(high), y + HALF_BOX_PX],
        ("#dbe8f6", pen),
    );
    for (i, &value) in values.iter().enumerate() {
        // Dots lie in five lines so that equal values are seen to be many.
        let off_px = 2.6 * ((i * 2 % 5) as f64 - 2.0);
        let place = [scale.px(value), y + off_px];
        canvas.dot(place, 1.9, (INK, Pen::new("none", 0.0)));
    }
    let x = scale.px(median);
    let pen = Pen::new(INK, 2.6);
    canvas.line([x, y - HALF_BOX_PX], [x, y + HALF_BOX_PX], pen);
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
        // A background and a box.
        assert_eq!(svg.matches("<rect").count(), 2);
        assert!(svg.contains("length &lt; 9, m") && svg.contains(">optimum</text>"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert_eq!(svg, plot.to_svg());
    }
}
