//! One verdict from all checks.

use super::report::{Report, Violation, ViolationKind};
use super::{CURVATURE_TOLERANCE, continuity, ends, shape, swept, via};
use crate::collision::ObstacleMap;
use crate::geometry::Pose2;
use crate::path::CurvePath;
use crate::scenario::Request;
use crate::vehicle::Vehicle;
use xxhash_rust::xxh3::xxh3_128;

/// Judges a path against everything that a request asks for.
pub fn judge(
    obstacles: &ObstacleMap,
    vehicle: &Vehicle,
    request: &Request,
    path: &CurvePath,
) -> Report {
    let body = (obstacles, vehicle);
    judge_while(body, request, path, &mut || true).expect("nothing ends it")
}

/// The same, where `goes_on` is asked on the way whether to go on; no verdict where it said no.
pub(crate) fn judge_while(
    (obstacles, vehicle): (&ObstacleMap, &Vehicle),
    request: &Request,
    path: &CurvePath,
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Report> {
    let mut report = judge_path_while((obstacles, vehicle), path, CURVATURE_TOLERANCE, goes_on)?;
    if report
        .violations
        .iter()
        .any(|v| v.kind == ViolationKind::Malformed)
    {
        return Some(report);
    }
    let ends = ends::check(vehicle, request, path);
    let passed = via::check(vehicle, request, path);
    report.goal_index = Some(ends.reached.index);
    report.goal_error_m = ends.reached.error_m;
    report.goal_error_rad = ends.reached.error_rad;
    report.via_s_m = passed.s_m;
    let violations = ends.violations.into_iter().chain(passed.missed);
    let violations = violations.chain(continuity::violations(vehicle, request, path));
    Some(finish(report, violations.collect()))
}

/// Judges a path by itself: swept collision, border, curvature and joints, with a relative slack
/// on the curvature limit for paths that were measured or sampled.
///
/// ```
/// use formicar::collision::ObstacleMap;
/// use formicar::path::Direction::Forward;
/// use formicar::validation::{ViolationKind, judge_path};
/// use formicar::{CurvePath, OccupancyGrid, Pose2, Vehicle};
///
/// let map = OccupancyGrid::from_rows(&["..........", "..........", "....#.....", ".........."], 1.0)?;
/// let mut path = CurvePath::new(Pose2::new(2.0, 1.5, 0.0));
/// path.push(0.0, 5.0, Forward);
/// let report = judge_path(&ObstacleMap::new(&map), &Vehicle::warehouse_amr(), &path, 0.0);
/// assert!(!report.valid);
/// assert_eq!(report.violations[0].kind, ViolationKind::Collision);
/// # Ok::<(), formicar::MapError>(())
/// ```
pub fn judge_path(
    obstacles: &ObstacleMap,
    vehicle: &Vehicle,
    path: &CurvePath,
    curvature_slack: f64,
) -> Report {
    let body = (obstacles, vehicle);
    judge_path_while(body, path, curvature_slack, &mut || true).expect("nothing ends it")
}

fn judge_path_while(
    (obstacles, vehicle): (&ObstacleMap, &Vehicle),
    path: &CurvePath,
    curvature_slack: f64,
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Report> {
    let report = blank(obstacles, vehicle, path);
    let malformed = shape::malformed(path);
    if !malformed.is_empty() {
        return Some(finish(report, malformed));
    }
    let swept = swept::check(obstacles, vehicle, path, goes_on)?;
    let report = Report {
        min_clearance_m: swept.min_clearance_m,
        tightest: swept.tightest,
        tightest_s_m: swept.tightest_s_m,
        max_curvature_per_m: shape::max_curvature_per_m(path),
        max_curvature_rate_per_m2: continuity::max_rate_per_m2(path),
        is_curvature_continuous: continuity::is_continuous(path),
        ..report
    };
    let mut violations = shape::check(vehicle, path, curvature_slack);
    violations.extend(swept.violations);
    Some(finish(report, violations))
}

fn blank(obstacles: &ObstacleMap, vehicle: &Vehicle, path: &CurvePath) -> Report {
    let hex = |hash: u128| format!("{hash:032x}");
    Report {
        valid: true,
        min_clearance_m: 0.0,
        tightest: path.start(),
        tightest_s_m: 0.0,
        max_curvature_per_m: 0.0,
        max_curvature_rate_per_m2: 0.0,
        is_curvature_continuous: true,
        goal_index: None,
        goal_error_m: 0.0,
        goal_error_rad: 0.0,
        via_s_m: Vec::new(),
        violations: Vec::new(),
        assumptions: Vec::new(),
        map_hash: hex(obstacles.hash()),
        vehicle_hash: hex(vehicle.hash()),
        path_hash: hex(path_hash(path)),
    }
}

fn finish(mut report: Report, violations: Vec<Violation>) -> Report {
    report.violations.extend(violations);
    report.violations.sort_by(|a, b| a.s_m.total_cmp(&b.s_m));
    report.valid = report.violations.is_empty();
    report
}

/// A 128-bit hash of a path's numbers, headings wrapped as files hold them; a zero has no sign,
/// which programs lose that write JSON anew.
fn path_hash(path: &CurvePath) -> u128 {
    hash_of(path, |number| number + 0.0)
}

/// The hash that certificates held before, which kept the signs of zeros; 32 hexadecimal digits.
///
/// ```
/// use formicar::Pose2;
/// use formicar::path::CurvePath;
/// use formicar::validation::path_hash_with_signs;
///
/// let paths = [0.0, -0.0].map(|y| CurvePath::new(Pose2::new(0.0, y, 0.0)));
/// assert_ne!(path_hash_with_signs(&paths[0]), path_hash_with_signs(&paths[1]));
/// ```
pub fn path_hash_with_signs(path: &CurvePath) -> String {
    format!("{:032x}", hash_of(path, |number| number))
}

fn hash_of(path: &CurvePath, number: impl Fn(f64) -> f64) -> u128 {
    let pose = |pose: Pose2| {
        let Pose2 { x, y, heading } = pose.wrapped();
        [x, y, heading]
    };
    let segments = path.segments().iter().flat_map(|s| {
        let [x, y, heading] = pose(s.start);
        // The rate stands where there is one: chains of arcs keep the hash that they had before
        // there were clothoids.
        let rate = Some(s.curvature_rate_per_m2).filter(|&rate| rate != 0.0);
        [
            x,
            y,
            heading,
            s.curvature_per_m,
            s.length_m,
            s.direction.sign(),
        ]
        .into_iter()
        .chain(rate)
    });
    let bytes: Vec<u8> = pose(path.start())
        .into_iter()
        .chain(segments)
        .flat_map(|value| number(value).to_le_bytes())
        .collect();
    xxh3_128(&bytes)
}
