//! A whole picture, and its two file formats.

use super::Scene;
use super::chart::Chart;
use super::lettering::Lettering;
use super::palette;
use super::style::{COLUMN_PX, LEFT_PX, Layout};
use super::svg::Svg;
use crate::geometry::Point2;

const GAP_PX: f64 = 26.0;
const CHARTS_ALONE_PX: f64 = 900.0;
const TITLE: Lettering = Lettering::new(22.0, palette::INK).bold();
const CAPTION: Lettering = Lettering::new(14.0, palette::MUTED);
const PANEL_HEAD_PX: f64 = 38.0;
const SMALL: Lettering = Lettering::new(13.0, palette::INK);
const DETAIL: Lettering = Lettering::new(13.0, palette::INK).bold();

/// A scene with its title above and its charts below or beside it.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// The heading; empty for none.
    pub title: String,
    /// Key numbers or a reason, under the title; empty for none.
    pub caption: String,
    /// The map.
    pub scene: Option<Scene>,
    /// An enlarged part of the map and its heading; its legend is that of the map.
    pub detail: Option<(Scene, String)>,
    /// Charts, stacked.
    pub charts: Vec<Chart>,
    /// Small scenes and their headings, in rows below everything; their legend is that of the map.
    pub panels: Vec<(Scene, String)>,
    /// The arrangement of its parts; scenes bring their own size.
    pub layout: Layout,
}

impl Picture {
    /// The picture as an SVG document.
    pub fn to_svg(&self) -> String {
        let mut body = Svg::default();
        let size = self.draw(&mut body);
        body.document(size, &self.title, &self.caption)
    }

    /// Width and height of the page in pixels, as the SVG states them.
    pub fn size_px(&self) -> Point2 {
        let size = self.draw(&mut Svg::default());
        Point2::new(size.x.ceil(), size.y.ceil())
    }

    /// Draws everything and returns the size of the page.
    fn draw(&self, svg: &mut Svg) -> Point2 {
        let width_px = self.width_px();
        let top = self.draw_head(svg, width_px);
        let bottom = match &self.scene {
            None => self.draw_charts(svg, top, width_px - 2.0 * self.margin_px()),
            Some(scene) => {
                scene.draw(svg, top);
                let size = scene.size_px();
                if self.charts_below(scene) {
                    self.draw_below(svg, top + Point2::new(0.0, size.y), size.x)
                } else {
                    let beside = top + Point2::new(size.x + GAP_PX, 0.0);
                    self.draw_column(svg, beside, COLUMN_PX).max(top.y + size.y)
                }
            }
        };
        let corner = Point2::new(top.x + LEFT_PX, bottom);
        let bottom = self.draw_panels(svg, corner, width_px - self.margin_px());
        Point2::new(width_px, bottom + self.margin_px())
    }

    /// The largest side of small scenes of which so many stand in a row.
    pub(super) fn panel_side_px(&self, n_in_row: usize) -> f64 {
        let row_px = self.width_px() - 2.0 * self.margin_px() - LEFT_PX;
        let gaps_px = GAP_PX * (n_in_row - 1) as f64;
        (row_px - gaps_px) / n_in_row as f64
    }

    fn charts_below(&self, scene: &Scene) -> bool {
        // A lone chart would leave the column beside the scene empty.
        let column = self.charts.len() > 1 || self.detail.is_some();
        self.layout == Layout::Phone || scene.is_wide() || !column
    }

    fn margin_px(&self) -> f64 {
        match self.layout {
            Layout::Page => 24.0,
            Layout::Phone => 10.0,
        }
    }

    fn width_px(&self) -> f64 {
        let content_px = match &self.scene {
            None => CHARTS_ALONE_PX,
            Some(scene) if self.charts_below(scene) => scene.size_px().x,
            Some(scene) => scene.size_px().x + GAP_PX + COLUMN_PX,
        };
        let least_px = match self.layout {
            Layout::Page => 480.0,
            Layout::Phone => 374.0,
        };
        content_px.max(least_px) + 2.0 * self.margin_px()
    }

    /// Title and caption; returns where the rest begins.
    fn draw_head(&self, svg: &mut Svg, width_px: f64) -> Point2 {
        let margin_px = self.margin_px();
        let mut y = margin_px;
        for (style, text, line_px) in [(TITLE, &self.title, 30.0), (CAPTION, &self.caption, 21.0)] {
            for line in style.wrapped(text, width_px - LEFT_PX - 2.0 * self.margin_px()) {
                y += line_px;
                style.write(
                    svg,
                    Point2::new(margin_px + LEFT_PX, y - 0.4 * line_px),
                    &line,
                );
            }
        }
        Point2::new(margin_px, if y > margin_px { y + 10.0 } else { y })
    }

    /// Charts, and the detail at their right; returns where they end.
    fn draw_below(&self, svg: &mut Svg, at: Point2, width_px: f64) -> f64 {
        let Some((detail, _)) = &self.detail else {
            return self.draw_charts(svg, at + Point2::new(0.0, 8.0), width_px);
        };
        let start = at + Point2::new(0.0, 8.0);
        if self.layout == Layout::Phone {
            return self.draw_column(svg, start, width_px);
        }
        let charts_px = width_px - detail.size_px().x - GAP_PX;
        let charts_end = self.draw_charts(svg, start, charts_px);
        let corner = start + Point2::new(charts_px + GAP_PX, 0.0);
        self.draw_detail(svg, corner).max(charts_end)
    }

    /// A column of charts with the detail at its foot.
    fn draw_column(&self, svg: &mut Svg, at: Point2, width_px: f64) -> f64 {
        let charts_end = self.draw_charts(svg, at, width_px);
        let gap = if self.charts.is_empty() { 0.0 } else { 12.0 };
        self.draw_detail(svg, Point2::new(at.x, charts_end + gap))
    }

    fn draw_charts(&self, svg: &mut Svg, at: Point2, width_px: f64) -> f64 {
        self.charts.iter().fold(at.y, |y, chart| {
            chart.draw(svg, Point2::new(at.x, y), width_px);
            y + chart.full_height_px(width_px)
        })
    }

    fn draw_detail(&self, svg: &mut Svg, at: Point2) -> f64 {
        let Some((detail, heading)) = &self.detail else {
            return at.y;
        };
        DETAIL.write(svg, at + Point2::new(LEFT_PX, 16.0), heading);
        detail.draw(svg, at + Point2::new(0.0, 24.0));
        at.y + 24.0 + detail.size_px().y
    }

    /// Small scenes in rows up to a right edge; returns where they end.
    fn draw_panels(&self, svg: &mut Svg, at: Point2, right_px: f64) -> f64 {
        let mut corner = at;
        let mut bottom = at.y;
        for (scene, heading) in &self.panels {
            let size = scene.panel_px();
            if corner.x > at.x && corner.x + size.x > right_px + 0.5 {
                corner = Point2::new(at.x, bottom);
            }
            let base = corner + Point2::new(0.0, PANEL_HEAD_PX - 8.0);
            SMALL.write(svg, base, heading);
            scene.draw_bare(svg, corner + Point2::new(0.0, PANEL_HEAD_PX));
            bottom = bottom.max(corner.y + PANEL_HEAD_PX + size.y);
            corner.x += size.x + GAP_PX;
        }
        bottom
    }
}
