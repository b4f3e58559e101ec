//! The report of a drive for people.

use crate::scene::Scene;
use crate::summary::clearance;
use formicar::collision::ObstacleMap;
use formicar::numeric::counted;
use formicar::path::CurvePath;
use formicar::tracking::{Controller, DrivenClearance, Tracking, TrackingStatus};
use formicar::validation::{Report, ViolationKind};
use std::io::{self, Write};

/// A drive with the scene it was driven on.
pub(super) struct Driven<'a> {
    pub(super) scene: &'a Scene,
    pub(super) obstacles: &'a ObstacleMap,
    /// The path that was to be driven, and what the judge says of it.
    pub(super) planned: &'a CurvePath,
    pub(super) report: &'a Report,
    pub(super) drive: &'a Tracking,
    pub(super) clearance: &'a DrivenClearance,
}

/// The result in a word.
pub(super) fn verdict(driven: &Driven) -> &'static str {
    match (driven.drive.status, &driven.clearance.contact) {
        (_, Some(_)) => "collides",
        (TrackingStatus::Arrived, None) => "tracked",
        (other, None) => other.name(),
    }
}

/// Key numbers for a picture.
pub(super) fn caption(driven: &Driven) -> String {
    let summary = &driven.drive.summary;
    format!(
        "{} by {} at {}: {:.2} m in {:.0} s, {} m beside the path at most, {}, swept {:.1} m²",
        driven.scene.vehicle.name,
        law(driven),
        speed(driven),
        summary.driven_m,
        summary.duration_s,
        meters(summary.max_cross_track_error_m),
        nearest(driven),
        summary.swept_area_m2,
    )
}

/// Advice where wheels that take their time were to jump.
fn hint(driven: &Driven) -> Option<&'static str> {
    let is_steered = driven.drive.config.max_steer_rate_rad_per_s.is_some();
    let is_lost = verdict(driven) != "tracked";
    (is_lost && is_steered && !driven.report.is_curvature_continuous).then_some(
        "the curvature of the path jumps, and these wheels take their time; plan with --continuous-curvature, or drive slower (--speed)",
    )
}

/// Writes verdict, errors, wheels and clearance, a line each.
pub(super) fn explain(driven: &Driven, out: &mut impl Write) -> io::Result<()> {
    let summary = &driven.drive.summary;
    writeln!(
        out,
        "{:<9}  {:.2} m in {:.1} s at {} by {}, {}",
        verdict(driven),
        summary.driven_m,
        summary.duration_s,
        speed(driven),
        law(driven),
        counted(summary.n_gear_changes, "change") + " of gear",
    )?;
    explain_end(driven, out)?;
    writeln!(
        out,
        "error      cross-track {} m at most, {} rms; heading {} deg at most, {} rms",
        meters(summary.max_cross_track_error_m),
        meters(summary.rms_cross_track_error_m),
        degrees(summary.max_heading_error_rad),
        degrees(summary.rms_heading_error_rad),
    )?;
    writeln!(
        out,
        "goal       missed by {} m and {} deg",
        meters(summary.goal_error_m),
        degrees(summary.goal_error_rad),
    )?;
    let vehicle = &driven.scene.vehicle.vehicle;
    let limit_rad = vehicle.steer_rad(vehicle.max_curvature_per_m());
    writeln!(
        out,
        "wheels     {} of {} deg at most, the inner one {}; saturated on {:.1} % of the drive",
        degrees(summary.max_steer_rad),
        limit_rad.map_or(String::new(), degrees),
        degrees(summary.max_wheel_rad),
        100.0 * summary.steering_saturated_share,
    )?;
    writeln!(
        out,
        "body       {}, swept {:.1} m2",
        nearest(driven),
        summary.swept_area_m2,
    )?;
    if summary.n_controller_failures > 0 {
        let times = counted(summary.n_controller_failures, "time");
        writeln!(out, "braked     {times}, for want of a solution")?;
    }
    match hint(driven) {
        Some(hint) => writeln!(out, "hint       {hint}"),
        None => Ok(()),
    }
}

/// The least distance of the body from obstacles.
fn nearest(driven: &Driven) -> String {
    match driven.clearance.violations.len() {
        0 => format!(
            "clearance {} at {:.2} m",
            clearance(driven.clearance.min_clearance_m),
            driven.clearance.tightest_driven_m
        ),
        n => format!("touches at {}", counted(n, "place")),
    }
}

/// The point where the drive failed, and whether the path was infeasible itself.
fn explain_end(driven: &Driven, out: &mut impl Write) -> io::Result<()> {
    if let Some(contact) = driven.clearance.contact {
        let what = match contact.kind {
            ViolationKind::LeavesMap => "the border of the map",
            _ => "an obstacle",
        };
        writeln!(
            out,
            "contact    with {what} after {:.2} m and {:.1} s, at ({:.2}, {:.2}), heading {:.3}",
            contact.driven_m, contact.t_s, contact.pose.x, contact.pose.y, contact.pose.heading,
        )?;
    }
    let config = &driven.drive.config;
    match (driven.drive.status, driven.drive.trace.last()) {
        (TrackingStatus::LeftPath, Some(last)) => writeln!(
            out,
            "left_path  at {:.2} m of it: {} m beside it, the limit is {} m",
            last.s_m,
            meters(last.cross_track_error_m.abs()),
            config.give_up_error_m,
        )?,
        (TrackingStatus::GaveUp, Some(last)) => writeln!(
            out,
            "gave_up    at {:.2} of {:.2} m after a drive of {:.2} m",
            last.s_m,
            driven.planned.length_m(),
            last.driven_m,
        )?,
        _ => {}
    }
    if let Some(violation) = driven.report.violations.first() {
        let message = &violation.message;
        writeln!(out, "path       not valid to begin with: {message}")?;
    }
    Ok(())
}

fn law(driven: &Driven) -> String {
    match driven.drive.config.controller {
        Controller::OpenLoop => "open loop".to_owned(),
        Controller::PurePursuit(law) => {
            let lookahead = law.lookahead_m.map(|m| format!(" ({m:.2} m ahead)"));
            "pure pursuit".to_owned() + &lookahead.unwrap_or_default()
        }
        Controller::Stanley(law) => format!("stanley (gain {} 1/s)", law.gain_per_s),
        Controller::RegulatedPurePursuit(_) => "regulated pure pursuit".to_owned(),
        Controller::Mpc(_) => "model-predictive control".to_owned(),
    }
}

/// The speed of the drive; of a drive in time, its highest.
fn speed(driven: &Driven) -> String {
    let speeds = driven.drive.trace.iter().filter_map(|p| p.speed_mps);
    match speeds.map(f64::abs).reduce(f64::max) {
        Some(top_mps) => format!("up to {top_mps:.2} m/s"),
        None => format!("{} m/s", driven.drive.config.speed_mps.unwrap_or_default()),
    }
}

/// A length to the millimeter.
fn meters(meters: f64) -> String {
    format!("{meters:.3}")
}

fn degrees(radians: f64) -> String {
    format!("{:.1}", radians.to_degrees())
}
