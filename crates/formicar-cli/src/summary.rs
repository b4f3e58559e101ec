//! The summary of an answer for people.

use formicar::motion::MotionStatus;
use formicar::numeric::counted;
use formicar::planner::{Answer, KeepOutMapRecord, MotionRecord};
use formicar::progress::Status;
use formicar::validation::TimedReport;
use formicar::vehicle::Vehicle;
use std::io::{self, Write};

/// Writes the summary of an answer.
pub(crate) fn write(
    answer: &Answer,
    vehicle: &Vehicle,
    n_improvements: u32,
    out: &mut impl Write,
) -> io::Result<()> {
    let (Some(path), Some(certificate)) = (&answer.path, &answer.certificate) else {
        let reason = answer.reason.as_deref().unwrap_or_default();
        writeln!(out, "{}  {reason}", answer.status.name())?;
        return writeln!(out, "gave up after {}", duration(answer.timing.query_s));
    };
    let length_m = path.poses.last().map_or(0.0, |pose| pose.s);
    let changes = path.segments.windows(2);
    let n_cusps = changes.filter(|w| w[0].direction != w[1].direction).count();
    writeln!(
        out,
        "{:<9}  {length_m:.2} m  clearance {}{}  {}{}",
        answer.status.name(),
        clearance(certificate.min_clearance_m),
        curvature(certificate.max_curvature_per_m, vehicle),
        counted(n_cusps, "cusp"),
        goal_of_several(answer),
    )?;
    write_speed_and_steering(answer, out)?;
    if let Some(motion) = &answer.motion {
        write_motion(motion, out)?;
    }
    let closed = &answer.provenance.map.keep_out_maps;
    for closed in closed.iter().map(KeepOutMapRecord::in_words) {
        writeln!(out, "note       {closed}")?;
    }
    for note in &answer.notes {
        writeln!(out, "note       {note}")?;
    }
    let asked = answer.provenance.request.as_ref();
    let budget_steps = asked.and_then(|request| request.budget_steps);
    let first = answer
        .timing
        .first_feasible_s
        .map_or(String::new(), |s| format!("first path {}, ", duration(s)));
    writeln!(
        out,
        "certified  {}, {}     {first}improved {}, {} at {}",
        counted(path.poses.len(), "pose"),
        counted(path.segments.len(), "segment"),
        counted(n_improvements, "time"),
        match (answer.cut_by, budget_steps) {
            (Some(Status::TimedOut), _) => "stopped by the deadline".to_owned(),
            (Some(_), Some(n_steps)) => format!("stopped by the budget of {n_steps} steps"),
            (Some(_), None) => "stopped by the budget".to_owned(),
            (None, _) => "done".to_owned(),
        },
        duration(answer.timing.query_s),
    )
}

/// The goal that was reached, if there were several.
fn goal_of_several(answer: &Answer) -> String {
    let request = answer.provenance.request.as_ref();
    let goals = request.and_then(|request| request.goals.as_ref());
    let reached = answer.certificate.as_ref().and_then(|c| c.goal_index);
    match (goals, reached) {
        (Some(goals), Some(i)) => format!("  at goal {} of {}", i + 1, goals.len()),
        _ => String::new(),
    }
}

/// The drive in time: when it ends, what it waits for, and what the judge has proven.
fn write_motion(motion: &MotionRecord, out: &mut impl Write) -> io::Result<()> {
    let (Some(profile), Some(certificate)) = (&motion.profile, &motion.certificate) else {
        let reason = motion.reason.as_deref().unwrap_or_default();
        return writeln!(out, "not driven {reason}");
    };
    // With a bounded jerk the drive takes longer for that alone.
    let is_comparable = motion.config.limits.max_jerk_mps3.is_none();
    let lost_s = profile.duration_s - profile.unhindered_s;
    let ends = match motion.status {
        Some(MotionStatus::Waits) => {
            let s_m = profile.phases.last().map_or(0.0, |phase| phase.s_m);
            format!("waits at {s_m:.2} m, before what stays in the way")
        }
        _ if motion.moving.obstacles.is_empty() => "arrives".to_owned(),
        _ if is_comparable && lost_s > 0.05 => {
            format!("arrives {lost_s:.1} s later than with nothing in the way")
        }
        _ if profile.stops.is_empty() => "arrives without waiting".to_owned(),
        _ => "arrives".to_owned(),
    };
    writeln!(
        out,
        "in time    {:.1} s at up to {:.2} m/s, {}; {ends}",
        profile.duration_s,
        certificate.max_speed_mps,
        counted(profile.stops.len(), "stop"),
    )?;
    write_distance(certificate, out)
}

/// What the judge has proven about moving obstacles.
pub(crate) fn write_distance(report: &TimedReport, out: &mut impl Write) -> io::Result<()> {
    let (Some(least_m), Some(nearest)) = (report.min_distance_m, &report.nearest) else {
        return Ok(());
    };
    writeln!(
        out,
        "distance   {} from {} at {:.1} s, {} m to be kept, over {:.1} s",
        clearance(least_m),
        nearest.obstacle,
        nearest.t_s,
        report.distance_m,
        report.horizon_s.max(report.duration_s),
    )
}

/// Travel time and greatest rate of curvature, as far as they are known.
fn write_speed_and_steering(answer: &Answer, out: &mut impl Write) -> io::Result<()> {
    let travel_time_s = answer.metrics.as_ref().and_then(|m| m.travel_time_s);
    let asked = answer.provenance.request.as_ref();
    let is_continuous = asked.is_some_and(|request| request.curvature.is_some());
    let rate = answer.certificate.as_ref().filter(|_| is_continuous);
    let rate = rate.map(|report| report.max_curvature_rate_per_m2);
    match (travel_time_s, rate) {
        (None, None) => Ok(()),
        (Some(time_s), None) => writeln!(out, "driven     in {time_s:.1} s"),
        (None, Some(rate)) => writeln!(out, "curvature  continuous, up to {rate:.3} 1/m^2"),
        (Some(time_s), Some(rate)) => writeln!(
            out,
            "driven     in {time_s:.1} s, curvature continuous, up to {rate:.3} 1/m^2"
        ),
    }
}

/// Largest curvature and its limit; empty for a point, which has no limit.
pub(crate) fn curvature(largest_per_m: f64, vehicle: &Vehicle) -> String {
    let limit = vehicle.max_curvature_per_m();
    if limit.is_finite() {
        format!("  curvature {largest_per_m:.2} of {limit:.2} 1/m")
    } else {
        String::new()
    }
}

/// A clearance, to the millimeter if it is small.
pub(crate) fn clearance(meters: f64) -> String {
    if meters < 0.1 {
        format!("{meters:.3} m")
    } else {
        format!("{meters:.2} m")
    }
}

/// A time in milliseconds or seconds, whichever suits it.
pub(crate) fn duration(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{:.1} ms", seconds * 1e3)
    } else {
        format!("{seconds:.2} s")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_the_unit_that_suits_them() {
        assert_eq!(duration(0.0041), "4.1 ms");
        assert_eq!(duration(2.5), "2.50 s");
    }
}
