//! How something changes over a run: medians and quartiles over many runs.

use super::axis::{Scale, ScaleKind};
use super::canvas::{Anchor, Canvas, INK, Pen, TEXT_PX, look, width_px};
use crate::analysis::statistics::quartiles;
use serde::Serialize;

const WIDTH_PX: f64 = 1000.0;
const HEIGHT_PX: f64 = 220.0;
const LEFT_PX: f64 = 66.0;
const GAP_PX: f64 = 34.0;
/// Courses shorter than this are drawn as a point, since a line could not be seen.
const MIN_LINE_PX: f64 = 12.0;
/// Places along x at which the runs are compared.
const N_PLACES: usize = 240;

/// A line with its band.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Course {
    /// Its name.
    pub name: String,
    /// `[x, lower quartile, median, upper quartile]`, x ascending.
    pub points: Vec<[f64; 4]>,
}

impl Course {
    /// Median and quartiles over runs that each hold their last value until the next: `[x,
    /// value]`, x ascending. A course begins where three quarters of the runs have a value, those
    /// without one counting as worse than all others, and ends where the last run ends.
    pub fn of_runs(name: &str, runs: &[Vec<[f64; 2]>], scale: ScaleKind) -> Self {
        let all = || runs.iter().flatten().map(|point| point[0]);
        let (first, last) = (
            all().fold(f64::INFINITY, f64::min),
            all().fold(f64::NEG_INFINITY, f64::max),
        );
        let places = places([first, last], scale);
        let point = |x: f64| {
            let value = |run: &Vec<[f64; 2]>| {
                let n_before = run.partition_point(|point| point[0] <= x);
                n_before.checked_sub(1).map_or(f64::INFINITY, |i| run[i][1])
            };
            let [low, median, high] = quartiles(&runs.iter().map(value).collect::<Vec<_>>())?;
            high.is_finite().then_some([x, low, median, high])
        };
        Self {
            name: name.to_owned(),
            points: places.into_iter().filter_map(point).collect(),
        }
    }
}

fn places([first, last]: [f64; 2], scale: ScaleKind) -> Vec<f64> {
    if !first.is_finite() || !last.is_finite() {
        return Vec::new();
    }
    if first == last {
        return vec![first];
    }
    let is_log = scale == ScaleKind::Log && first > 0.0;
    let at = |i: usize| {
        let share = i as f64 / N_PLACES as f64;
        if is_log {
            first * (last / first).powf(share)
        } else {
            first + share * (last - first)
        }
    };
    // The last place is the last value itself, not one that rounding left just before it.
    (0..N_PLACES).map(at).chain([last]).collect()
}

/// Courses over one x axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BandPanel {
    /// What x is, with its unit.
    pub x: String,
    /// Its scale.
    pub x_scale: ScaleKind,
    /// The courses; a course has the same look in all panels by its place.
    pub courses: Vec<Course>,
}

/// Panels side by side over one y axis: medians as lines, quartiles as bands.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Bands {
    /// What it shows.
    pub caption: String,
    /// Quantity and unit.
    pub quantity: String,
    /// Its scale.
    pub y_scale: ScaleKind,
    /// The panels from left to right.
    pub panels: Vec<BandPanel>,
}

impl Bands {
    /// The picture.
    pub fn to_svg(&self) -> String {
        let mut canvas = Canvas::default();
        let top = self.draw_legend(&mut canvas) + 12.0;
        let bottom = top + HEIGHT_PX;
        let courses = self.panels.iter().flat_map(|panel| &panel.courses);
        let values = courses.flat_map(|course| &course.points);
        let values = values.flat_map(|point| point[1..].iter().copied());
        let y = Scale::fit(values, self.y_scale, [bottom, top]);
        let n = self.panels.len().max(1) as f64;
        let width = (WIDTH_PX - LEFT_PX - 16.0 - GAP_PX * (n - 1.0)) / n;
        for (i, panel) in self.panels.iter().enumerate() {
            let left = LEFT_PX + i as f64 * (width + GAP_PX);
            let name = if i == 0 { self.quantity.as_str() } else { "" };
            panel.draw(&mut canvas, [left, left + width], ([top, bottom], &y, name));
        }
        let title = format!("Course: {}", self.quantity);
        canvas.document([WIDTH_PX, bottom + 2.0 * TEXT_PX + 16.0], &title)
    }

    /// Draws the names and returns where they end.
    fn draw_legend(&self, canvas: &mut Canvas) -> f64 {
        let Some(panel) = self.panels.first() else {
            return 0.0;
        };
        let (mut x, mut y) = (LEFT_PX, 14.0);
        let is_drawn = |i: usize| {
            let courses = self.panels.iter().filter_map(|panel| panel.courses.get(i));
            { courses }.any(|course| !course.points.is_empty())
        };
        let drawn = panel.courses.iter().enumerate();
        for (i, course) in drawn.filter(|(i, _)| is_drawn(*i)) {
            let width = 40.0 + width_px(&course.name) + 18.0;
            if x + width > WIDTH_PX && x > LEFT_PX {
                (x, y) = (LEFT_PX, y + 1.6 * TEXT_PX);
            }
            canvas.line([x, y], [x + 32.0, y], pen(i));
            let place = [x + 40.0, y + 0.35 * TEXT_PX];
            canvas.text(place, &course.name, (Anchor::Start, INK));
            x += width;
        }
        y + 0.5 * TEXT_PX
    }
}

impl BandPanel {
    fn draw(
        &self,
        canvas: &mut Canvas,
        [left, right]: [f64; 2],
        ([top, bottom], y, name): ([f64; 2], &Scale, &str),
    ) {
        let xs = self.courses.iter().flat_map(|course| &course.points);
        let x = Scale::fit(xs.map(|point| point[0]), self.x_scale, [left, right]);
        x.draw_below(canvas, [top, bottom], &self.x);
        y.draw_left(canvas, [left, right], name);
        let at = |point: &[f64; 4], which: usize| [x.px(point[0]), y.px(point[which])];
        let is_point = |course: &Course| {
            let ends = [course.points.first(), course.points.last()];
            let [first, last] = ends.map(|end| end.map_or(0.0, |point| x.px(point[0])));
            last - first < MIN_LINE_PX
        };
        for (i, course) in self.courses.iter().enumerate() {
            let low = course.points.iter().map(|point| at(point, 1));
            let high = course.points.iter().rev().map(|point| at(point, 3));
            let outline: Vec<[f64; 2]> = low.chain(high).collect();
            canvas.area(&outline, (look(i).0, 0.16));
        }
        for (i, course) in self.courses.iter().enumerate() {
            let line: Vec<[f64; 2]> = course.points.iter().map(|point| at(point, 2)).collect();
            match line.last() {
                Some(&median) if is_point(course) => {
                    let ends = course.points.last().map(|end| [at(end, 1), at(end, 3)]);
                    draw_point(canvas, i, (median, ends.unwrap_or([median; 2])));
                }
                _ => canvas.polyline(&line, pen(i)),
            }
        }
    }
}

/// A course that is too short for a line: a dot at its end, the quartiles as a bar.
fn draw_point(canvas: &mut Canvas, i: usize, (median, ends): ([f64; 2], [[f64; 2]; 2])) {
    let (color, _) = look(i);
    let thin = Pen::new(color, 1.4);
    canvas.line(ends[0], ends[1], thin);
    for [x, y] in ends {
        canvas.line([x - 4.0, y], [x + 4.0, y], thin);
    }
    canvas.dot(median, 4.5, (color, thin));
}

fn pen(i: usize) -> Pen<'static> {
    let (color, dash) = look(i);
    Pen {
        dash,
        ..Pen::new(color, 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_hold_their_values_and_late_ones_count_as_worse() {
        let runs = [
            vec![[1.0, 9.0], [3.0, 5.0]],
            vec![[2.0, 7.0]],
            vec![[1.0, 8.0]],
            vec![[1.0, 6.0]],
        ];
        let course = Course::of_runs("ants", &runs, ScaleKind::Linear);
        // The second has nothing before 2: the upper quartile is between 9 and nothing.
        assert_eq!(course.points[0][0], 2.0);
        assert_eq!(course.points[0], [2.0, 6.75, 7.5, 8.25]);
        // 5, 6, 7, 8.
        assert_eq!(course.points.last(), Some(&[3.0, 5.75, 6.5, 7.25]));
        assert!(Course::of_runs("", &[], ScaleKind::Log).points.is_empty());
        assert!(
            Course::of_runs("", &[Vec::new()], ScaleKind::Linear)
                .points
                .is_empty()
        );
    }

    #[test]
    fn a_course_of_one_place_is_a_point_with_its_quartiles() {
        let runs = [vec![[1.0, 2.0]], vec![[1.0, 4.0]], vec![[1.0, 3.0]]];
        let course = Course::of_runs("ants", &runs, ScaleKind::Linear);
        assert_eq!(course.points, [[1.0, 2.5, 3.0, 3.5]]);
        let bands = Bands {
            panels: vec![BandPanel {
                courses: vec![course],
                ..BandPanel::default()
            }],
            ..Bands::default()
        };
        let svg = bands.to_svg();
        assert_eq!(svg.matches("<circle").count(), 1, "{svg}");
        assert!(!svg.contains("NaN"), "{svg}");
    }

    #[test]
    fn a_line_and_a_band_are_drawn_per_course() {
        let course = Course {
            name: "ants".to_owned(),
            points: vec![[1.0, 1.0, 2.0, 3.0], [2.0, 1.0, 1.5, 2.0]],
        };
        let panel = BandPanel {
            x: "iteration".to_owned(),
            courses: vec![course.clone(), course],
            ..BandPanel::default()
        };
        let bands = Bands {
            quantity: "length".to_owned(),
            panels: vec![panel.clone(), panel],
            ..Bands::default()
        };
        let svg = bands.to_svg();
        assert_eq!(svg.matches("<polygon").count(), 4);
        assert_eq!(svg.matches(">ants</text>").count(), 2);
        assert!(!svg.contains("NaN"), "{svg}");
    }
}
