//! Pictures of maps and vehicles.

use crate::grid::Grid;
use crate::vehicle::Car;
use formicar::geometry::{Point2, Pose2};
use formicar::map::{GridFrame, OccupancyGrid};
use formicar::render::{Dash, Layout, LineStyle, Picture, Scene, palette};
use formicar::vehicle::Motion;
use pyo3::prelude::*;

/// Cells across the floor that a vehicle stands on.
const N_FLOOR_CELLS: f64 = 12.0;

/// A map as SVG.
#[pyfunction]
pub(crate) fn grid_svg(grid: &Grid, title: &str, py: Python<'_>) -> String {
    py.detach(|| {
        let scene = Scene::new(&grid.map);
        picture(scene, title).to_svg()
    })
}

/// A vehicle as SVG, on a floor of round squares.
#[pyfunction]
pub(crate) fn vehicle_svg(car: &Car, title: &str) -> PyResult<String> {
    let (low, high) = car.vehicle.footprint().bounds();
    let size_m = (high.x - low.x).max(high.y - low.y).max(0.1);
    let side_m = 10_f64.powf((2.0 * size_m / N_FLOOR_CELLS).log10().floor());
    let side_m = [1.0, 2.0, 5.0, 10.0]
        .map(|times| times * side_m)
        .into_iter()
        .find(|side_m| side_m * N_FLOOR_CELLS >= 1.5 * size_m)
        .unwrap_or(10.0 * side_m);
    let n_cols = (1.4 * (high.x - low.x) / side_m).ceil().max(2.0) + 2.0;
    let n_rows = (1.4 * (high.y - low.y) / side_m).ceil().max(2.0) + 2.0;
    let middle = Point2::new(0.5 * (low.x + high.x), 0.5 * (low.y + high.y));
    let corner = Point2::new(
        middle.x - 0.5 * n_cols * side_m,
        middle.y - 0.5 * n_rows * side_m,
    );
    let frame = GridFrame::new(
        n_cols as usize,
        n_rows as usize,
        side_m,
        Pose2::at(corner, 0.0),
    );
    let floor = OccupancyGrid::free(frame.map_err(crate::errors::map)?);
    let mut scene = Scene::new(&floor);
    if car.vehicle.motion() == Motion::Car {
        let corners = car.vehicle.footprint().corners();
        let outline: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
        scene.polyline(
            &outline,
            &LineStyle {
                label: "body".to_owned(),
                color: palette::FORWARD,
                width_px: 2.0,
                dash: Dash::Solid,
            },
        );
        if let Some(wheelbase_m) = car.vehicle.wheelbase_m() {
            scene.point(Point2::new(wheelbase_m, 0.0), "front axle");
        }
    }
    scene.point(Point2::default(), "rear axle");
    Ok(picture(scene, title).to_svg())
}

fn picture(scene: Scene, title: &str) -> Picture {
    Picture {
        scene: Some(scene),
        title: title.to_owned(),
        layout: Layout::Page,
        ..Picture::default()
    }
}
