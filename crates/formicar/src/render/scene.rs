//! A map with layers on it, north up.

use super::cells::CellLayer;
use super::heat::{Heat, HeatScale};
use super::labels::Labels;
use super::legend::{Legend, Swatch};
use super::markup::Element;
use super::palette::{self, Color};
use super::style::{COLUMN_PX, CellStyle, Dash, LEFT_PX, Layout, LineStyle};
use super::svg::{PathData, Svg};
use super::view::{View, frame_bounds, frame_corners};
use crate::geometry::Point2;
use crate::map::{BitGrid, GridFrame, OCCUPIED, OccupancyGrid, UNKNOWN};
use crate::path::{GridPath, WaypointPath};

/// The largest panel of a map that is wider than high, pixels.
const WIDE_PX: Point2 = Point2::new(1100.0, 740.0);
/// The largest panel of any other map: charts stand beside it.
const TALL_PX: Point2 = Point2::new(680.0, 820.0);
/// The largest panel on a phone.
const PHONE_PX: Point2 = Point2::new(330.0, 440.0);
/// From this ratio of width to height on a map counts as wide.
const WIDE_RATIO: f64 = 1.4;
/// Panels at least this wide have their charts below.
const WIDE_PANEL_PX: f64 = 720.0;
/// Cells of at least this size show their grid lines.
const GRID_LINES_FROM_PX: f64 = 8.0;

/// The darkest shade of a heat map, the palest being 0: more would look the same.
const LAST_SHADE: u8 = 63;
/// Powers of ten that a logarithmic heat map shows.
const LOG_HEAT_DECADES: f64 = 3.0;

/// A map with layers: each call draws over what is there already, but cells stay below lines and
/// marks.
///
/// World coordinates throughout; north is up, and a map with yaw stands askew.
///
/// ```
/// use formicar::render::{Picture, PoseMark, Scene};
/// use formicar::{OccupancyGrid, Pose2, Vehicle};
///
/// let map = OccupancyGrid::from_rows(&["..........", ".....#....", ".........."], 1.0)?;
/// let mut scene = Scene::new(&map);
/// scene.pose(Pose2::new(2.0, 1.5, 0.0), &Vehicle::warehouse_amr(), PoseMark::Start);
/// let picture = Picture { scene: Some(scene), title: "a hall".to_owned(), ..Picture::default() };
/// assert!(picture.to_svg().starts_with("<svg"));
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scene {
    pub(super) frame: GridFrame,
    pub(super) view: View,
    /// Cells.
    ground: Svg,
    /// Lines and marks.
    pub(super) body: Svg,
    pub(super) labels: Labels,
    pub(super) legend: Legend,
}

impl Scene {
    /// The whole of a map.
    pub fn new(map: &OccupancyGrid) -> Self {
        Self::part(map, frame_bounds(map.frame()), Layout::Page)
    }

    /// The part of a map between a lowest and a highest world coordinate.
    pub fn window(map: &OccupancyGrid, low: Point2, high: Point2) -> Self {
        let whole = frame_bounds(map.frame());
        let low = Point2::new(low.x.max(whole.0.x), low.y.max(whole.0.y));
        let high = Point2::new(high.x.min(whole.1.x), high.y.min(whole.1.y));
        if low.x < high.x && low.y < high.y {
            Self::part(map, (low, high), Layout::Page)
        } else {
            Self::new(map)
        }
    }

    /// The part between a lowest and a highest world coordinate.
    pub(super) fn part(map: &OccupancyGrid, bounds: (Point2, Point2), layout: Layout) -> Self {
        let (low, high) = bounds;
        let extent = high - low;
        let max_px = match layout {
            Layout::Phone => PHONE_PX,
            Layout::Page if extent.x >= WIDE_RATIO * extent.y => WIDE_PX,
            Layout::Page => TALL_PX,
        };
        Self::with_view(map, View::fit(low, high, max_px))
    }

    /// An enlarged part between two corners, in a square panel.
    pub(super) fn detail(map: &OccupancyGrid, (low, high): (Point2, Point2), side_px: f64) -> Self {
        Self::with_view(map, View::fit(low, high, Point2::new(side_px, side_px)))
    }

    /// The whole of a map in a panel of at most a size.
    pub(super) fn small(map: &OccupancyGrid, max_px: Point2) -> Self {
        let (low, high) = frame_bounds(map.frame());
        Self::with_view(map, View::fit(low, high, max_px))
    }

    /// Side of the panel of a detail that goes with this scene.
    pub(super) fn detail_side_px(&self, layout: Layout) -> f64 {
        match layout {
            Layout::Phone => self.panel_px().x,
            Layout::Page if self.is_wide() => 330.0,
            Layout::Page => COLUMN_PX - LEFT_PX,
        }
    }

    /// True if charts stand below it, since it leaves no room beside.
    pub(super) fn is_wide(&self) -> bool {
        self.panel_px().x >= WIDE_PANEL_PX
    }

    fn with_view(map: &OccupancyGrid, view: View) -> Self {
        let mut scene = Self {
            frame: *map.frame(),
            view,
            ground: Svg::default(),
            body: Svg::default(),
            labels: Labels::default(),
            legend: Legend::default(),
        };
        scene.draw_map(map);
        scene
    }

    /// Size of the panel alone, pixels.
    pub(super) fn panel_px(&self) -> Point2 {
        self.view.size_px()
    }

    pub(super) fn px_per_m(&self) -> f64 {
        self.view.px_per_m()
    }

    /// Marks a set of cells of the map.
    pub fn cells(&mut self, set: &BitGrid, style: &CellStyle) -> &mut Self {
        let n_cols = self.frame.n_cols();
        let place = (&self.frame, &self.view);
        let layer = CellLayer::new(place.0, place.1, |i| {
            u8::from(set.contains((i % n_cols) as i64, (i / n_cols) as i64))
        });
        layer.draw(&mut self.ground, place, &[style.color]);
        self.legend.add(&style.label, Swatch::Cell(style.color));
        self
    }

    /// Colors cells by their value, row-major from the lowest row: pale for the smallest, dark
    /// for the largest. Values that are not finite, and cells without one, stay as they are.
    pub fn heat_map(&mut self, values: &[f32], label: &str) -> &mut Self {
        self.heat(values, label, HeatScale::Linear)
    }

    /// A heat map on which equal ratios look equal, over three powers of ten below the largest
    /// value; cells of less stay as they are. The legend says so.
    pub fn log_heat_map(&mut self, values: &[f32], label: &str) -> &mut Self {
        let max_decades = LOG_HEAT_DECADES;
        let label = format!("{label}, log scale");
        self.heat(values, &label, HeatScale::Log { max_decades })
    }

    fn heat(&mut self, values: &[f32], label: &str, scale: HeatScale) -> &mut Self {
        let Some(heat) = Heat::new(values, scale) else {
            return self;
        };
        let place = (&self.frame, &self.view);
        let layer = CellLayer::new(place.0, place.1, |i| {
            let share = values.get(i).and_then(|&v| heat.share(f64::from(v)));
            share.map_or(0, |share| 1 + (share * f64::from(LAST_SHADE)).round() as u8)
        });
        let shade = |i: u8| palette::heat(f64::from(i) / f64::from(LAST_SHADE));
        let colors: Vec<Color> = (0..=LAST_SHADE).map(shade).collect();
        layer.draw(&mut self.ground, place, &colors);
        self.legend.add(label, heat.swatch());
        self
    }

    /// A path over cells, through their centers.
    pub fn grid_path(&mut self, path: &GridPath) -> &mut Self {
        let centers: Vec<Point2> = path.cells.iter().map(|&c| self.frame.center(c)).collect();
        let style = LineStyle {
            label: "grid path".to_owned(),
            color: palette::WAYPOINTS,
            width_px: 2.0,
            dash: Dash::Dotted,
        };
        self.polyline(&centers, &style)
    }

    /// A polyline with its nodes.
    pub fn waypoint_path(&mut self, path: &WaypointPath) -> &mut Self {
        let style = LineStyle {
            label: "way points".to_owned(),
            color: palette::WAYPOINTS,
            width_px: 2.0,
            dash: Dash::Solid,
        };
        self.polyline(&path.points, &style);
        for &point in &path.points {
            let node = Element::circle(self.view.to_px(point), 3.2).fill(palette::PAGE);
            self.body.add(&node.pen(palette::WAYPOINTS, 1.6));
        }
        self
    }

    /// A polyline in world coordinates.
    pub fn polyline(&mut self, points: &[Point2], style: &LineStyle) -> &mut Self {
        let line = PathData::polyline(points.iter().map(|&p| self.view.to_px(p)));
        let line = Element::path(line).pen(style.color, style.width_px);
        self.body.add(&match style.dash.pattern() {
            Some(pattern) => line.text("stroke-dasharray", pattern),
            None => line,
        });
        self.legend
            .add(&style.label, Swatch::Line(style.color, style.dash));
        self
    }

    fn draw_map(&mut self, map: &OccupancyGrid) {
        let panel = self.view.size_px();
        let off_map = Element::rectangle(Point2::default(), panel).fill(palette::OFF_MAP);
        self.ground.add(&off_map);
        let ground = Element::path(self.map_outline()).fill(palette::FREE);
        self.ground.add(&ground);

        // Graded cells take the levels of their cost; the unknown wins over them, obstacles over all.
        let (unknown, obstacle) = (100, 101);
        let place = (&self.frame, &self.view);
        let layer = CellLayer::new(place.0, place.1, |i| match map.values()[i] {
            OCCUPIED => obstacle,
            UNKNOWN => unknown,
            cost => cost.unsigned_abs(),
        });
        let graded =
            (1..100).map(|cost| palette::FREE.mix(palette::GRADED, f64::from(cost) / 99.0));
        let colors: Vec<Color> = graded
            .chain([palette::UNKNOWN, palette::OBSTACLE])
            .collect();
        layer.draw(&mut self.ground, place, &colors);
        self.name_ground(&layer.levels_in_use());
    }

    /// Everything within the panel but the labels.
    pub(super) fn contents(&self) -> Svg {
        let mut contents = self.ground.clone();
        self.draw_grid_lines(&mut contents);
        let edge = Element::path(self.map_outline()).pen(palette::RULE, 1.0);
        contents.add(&edge);
        contents.append(&self.body);
        contents
    }

    fn name_ground(&mut self, used: &[bool; 256]) {
        let kinds = [
            ("obstacle", used[101], palette::OBSTACLE),
            ("unknown", used[100], palette::UNKNOWN),
            ("graded cost", used[1..100].contains(&true), palette::GRADED),
        ];
        for (label, _, color) in kinds.into_iter().filter(|kind| kind.1) {
            self.legend.add(label, Swatch::Cell(color));
        }
    }

    fn map_outline(&self) -> PathData {
        let mut outline = PathData::default();
        outline.polygon(frame_corners(&self.frame).map(|p| self.view.to_px(p)));
        outline
    }

    fn draw_grid_lines(&self, svg: &mut Svg) {
        let step_m = self.frame.resolution_m();
        if step_m * self.view.px_per_m() < GRID_LINES_FROM_PX {
            return;
        }
        let (cols, rows) = self.view.cells_in_view(&self.frame);
        let at = |col: usize, row: usize| {
            let local = Point2::new(col as f64, row as f64) * step_m;
            self.view.to_px(self.frame.origin().transform(local))
        };
        let mut lines = PathData::default();
        for col in cols.start..=cols.end {
            lines.move_to(at(col, rows.start));
            lines.line_to(at(col, rows.end));
        }
        for row in rows.start..=rows.end {
            lines.move_to(at(cols.start, row));
            lines.line_to(at(cols.end, row));
        }
        let lines = Element::path(lines).pen(palette::MUTED, 0.5);
        svg.add(&lines.text("stroke-opacity", "0.22"));
    }
}
