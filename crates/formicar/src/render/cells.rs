//! A layer of cells: outlines of merged rectangles on small maps, an embedded image on large ones.

use super::markup::Element;
use super::palette::Color;
use super::svg::{PathData, Svg};
use super::view::View;
use crate::geometry::Point2;
use crate::map::GridFrame;
use std::ops::Range;

/// Up to this many cells are drawn as outlines.
const MAX_OUTLINED: usize = 128 * 128;
/// The longest side of an embedded image, pixels; larger maps are thinned to it.
const MAX_IMAGE_SIDE: usize = 2048;

/// A level for every cell in view: 0 draws nothing, higher levels win when cells are merged.
pub(super) struct CellLayer {
    cols: Range<usize>,
    rows: Range<usize>,
    /// Cells along the side of one drawn pixel.
    step: usize,
    /// Row-major, lowest row first.
    levels: Vec<u8>,
}

impl CellLayer {
    /// The layer of the cells in view, from the level of each cell index.
    pub(super) fn new(frame: &GridFrame, view: &View, level: impl Fn(usize) -> u8) -> Self {
        let (cols, rows) = view.cells_in_view(frame);
        let step = cols.len().max(rows.len()).div_ceil(MAX_IMAGE_SIDE).max(1);
        let n_wide = cols.len().div_ceil(step);
        let mut levels = vec![0; n_wide * rows.len().div_ceil(step)];
        for row in rows.clone() {
            let line = &mut levels[(row - rows.start) / step * n_wide..][..n_wide];
            for col in cols.clone() {
                let pixel = &mut line[(col - cols.start) / step];
                *pixel = level(row * frame.n_cols() + col).max(*pixel);
            }
        }
        Self {
            cols,
            rows,
            step,
            levels,
        }
    }

    /// The levels that occur, one flag each.
    pub(super) fn levels_in_use(&self) -> [bool; 256] {
        let mut used = [false; 256];
        self.levels
            .iter()
            .for_each(|&l| used[usize::from(l)] = true);
        used
    }

    /// Draws each cell in the color of its level, whose first is that of level 1.
    pub(super) fn draw(&self, svg: &mut Svg, (frame, view): (&GridFrame, &View), colors: &[Color]) {
        if self.levels_in_use()[1..].iter().all(|&used| !used) {
            return;
        }
        let corner = |col: usize, row: usize| {
            let local = Point2::new(col as f64, row as f64) * frame.resolution_m();
            view.to_px(frame.origin().transform(local))
        };
        let (left, bottom) = (self.cols.start, self.rows.start);
        let origin = corner(left, bottom);
        let right = (corner(left + 1, bottom) - origin) * self.step as f64;
        let up = (corner(left, bottom + 1) - origin) * self.step as f64;
        if self.levels.len() <= MAX_OUTLINED {
            self.draw_outlines(svg, |element| element.matrix(right, up, origin), colors);
            return;
        }
        let n_high = self.levels.len() / self.n_wide();
        let style = if right.norm() < 1.0 {
            "image-rendering:auto"
        } else {
            "image-rendering:pixelated"
        };
        let image = Element::new("image")
            .number("width", self.n_wide() as f64)
            .number("height", n_high as f64)
            .text("preserveAspectRatio", "none")
            .text("style", style)
            .text("href", &data_url(&self.png(colors)))
            .matrix(right, -up, origin + up * n_high as f64);
        svg.add(&image);
    }

    fn n_wide(&self) -> usize {
        self.cols.len().div_ceil(self.step)
    }

    fn draw_outlines(&self, svg: &mut Svg, place: impl Fn(Element) -> Element, colors: &[Color]) {
        let used = self.levels_in_use();
        for (level, &color) in (1..=255).zip(colors) {
            if used[usize::from(level)] {
                let outline = Element::path(self.outline(level)).fill(color);
                svg.add(&place(outline.text("shape-rendering", "crispEdges")));
            }
        }
    }

    /// The cells of a level as rectangles: runs along rows, merged with equal runs below.
    fn outline(&self, level: u8) -> PathData {
        let mut path = PathData::default();
        let mut open: Vec<(Range<usize>, usize)> = Vec::new();
        let rows = self
            .levels
            .chunks(self.n_wide())
            .map(|row| runs(row, level));
        for (row, runs) in rows.chain([Vec::new()]).enumerate() {
            open.retain(|(run, from)| {
                let goes_on = runs.contains(run);
                if !goes_on {
                    path.polygon(corners(run, *from..row));
                }
                goes_on
            });
            for run in runs {
                if !open.iter().any(|(known, _)| *known == run) {
                    open.push((run, row));
                }
            }
        }
        path
    }

    /// The layer as a PNG file with one byte per pixel, topmost row first.
    fn png(&self, colors: &[Color]) -> Vec<u8> {
        let n_wide = self.n_wide();
        let top_down: Vec<u8> = self
            .levels
            .chunks(n_wide)
            .rev()
            .flatten()
            .copied()
            .collect();
        let clear = Color::rgb(0xff, 0xff, 0xff);
        let palette = [clear].into_iter().chain(colors.iter().copied());
        let palette: Vec<u8> = palette.flat_map(|c| [c.red, c.green, c.blue]).collect();
        let mut file = Vec::new();
        let (width, height) = (n_wide as u32, (top_down.len() / n_wide) as u32);
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_filter(png::Filter::NoFilter);
        encoder.set_palette(palette);
        encoder.set_trns(vec![0]);
        encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(&top_down))
            .expect("an image with pixels, whose levels all have a color, encodes in memory");
        file
    }
}

fn runs(row: &[u8], level: u8) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (i, _) in row.iter().enumerate().filter(|(_, l)| **l == level) {
        match runs.last_mut() {
            Some(run) if run.end == i => run.end += 1,
            _ => runs.push(i..i + 1),
        }
    }
    runs
}

fn corners(cols: &Range<usize>, rows: Range<usize>) -> [Point2; 4] {
    let [left, right, low, high] = [cols.start, cols.end, rows.start, rows.end].map(|i| i as f64);
    [(left, low), (right, low), (right, high), (left, high)].map(|(x, y)| Point2::new(x, y))
}

/// A file inside an address (RFC 2397), in base 64 (RFC 4648).
fn data_url(png: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut url = String::from("data:image/png;base64,");
    for chunk in png.chunks(3) {
        let byte = |i| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            if digit <= chunk.len() {
                let index = bits >> (18 - 6 * digit) & 63;
                url.push(char::from(DIGITS[index as usize]));
            } else {
                url.push('=');
            }
        }
    }
    url
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;

    #[test]
    fn base_64_pads_as_the_standard_shows() {
        let cases = [
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
        ];
        for (bytes, digits) in cases {
            let url = data_url(bytes.as_bytes());
            assert_eq!(url, format!("data:image/png;base64,{digits}"));
        }
    }

    #[test]
    fn equal_runs_become_one_rectangle() {
        let grid = OccupancyGrid::from_rows(&["##.", "##.", "#.#"], 1.0).unwrap();
        let frame = *grid.frame();
        let view = View::fit(Point2::default(), frame.extent_m(), Point2::new(90.0, 90.0));
        let layer = CellLayer::new(&frame, &view, |i| u8::from(grid.values()[i] == 100));
        let mut svg = Svg::default();
        layer.draw(&mut svg, (&frame, &view), &[Color::rgb(0, 0, 0)]);
        assert_eq!(svg.as_str().matches('z').count(), 3);
    }

    #[test]
    fn merged_pixels_keep_the_highest_level() {
        let frame = GridFrame::new(5000, 3, 1.0, crate::geometry::Pose2::default()).unwrap();
        let view = View::fit(
            Point2::default(),
            frame.extent_m(),
            Point2::new(900.0, 90.0),
        );
        let layer = CellLayer::new(&frame, &view, |i| u8::from(i == 4999) * 7);
        assert_eq!((layer.step, layer.levels.len()), (3, 1667));
        assert_eq!(layer.levels[1666], 7);
    }
}
