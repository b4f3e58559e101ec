//! A drive in words.

use formicar::numeric::counted;
use formicar_drive::{Contact, Contacted, Culprit, DriveRecord, DriveStatus, Latency};
use std::io::{self, Write};

/// The ending in a word or two.
pub(super) fn verdict(record: &DriveRecord) -> &'static str {
    match record.status {
        DriveStatus::Arrived => "arrived",
        DriveStatus::Collided => "collided",
        _ => "did not arrive in time",
    }
}

/// Key numbers, for a picture.
pub(super) fn caption(record: &DriveRecord) -> String {
    let mut parts = vec![
        format!("{:.1} s", record.duration_s),
        format!("{:.2} m driven", record.driven_m),
        format!("{:.3} m from obstacles", record.min_static_distance_m),
    ];
    if let Some(distance_m) = record.min_agent_distance_m {
        parts.push(format!("{distance_m:.3} m from agents"));
    }
    parts.push(counted(record.n_stops, "stop"));
    parts.join(", ")
}

/// The record for people.
pub(super) fn explain(record: &DriveRecord, out: &mut impl Write) -> io::Result<()> {
    let status = record.status.name();
    writeln!(
        out,
        "{status:<10} {:.2} s  {:.2} m driven  up to {:.2} m/s  {:.3} m from the goal",
        record.duration_s, record.driven_m, record.max_speed_mps, record.goal_error_m
    )?;
    write!(
        out,
        "distance   {:.3} m from obstacles",
        record.min_static_distance_m
    )?;
    if let Some(distance_m) = record.min_agent_distance_m {
        write!(out, ", {distance_m:.3} m from agents")?;
    }
    if let Some(time_s) = record.min_time_to_collision_s {
        write!(out, ", {time_s:.2} s to a collision")?;
    }
    let driver = record.driver;
    writeln!(out)?;
    writeln!(
        out,
        "driver     {}, {}, {}, {}, {}",
        counted(record.n_stops, "stop"),
        counted(driver.n_routes, "path"),
        counted(driver.n_flips, "flip"),
        counted(driver.n_emergency_brakes, "emergency brake"),
        counted(driver.n_recoveries, "recovery").replace("recoverys", "recoveries"),
    )?;
    if let Some(latencies) = record.latencies {
        latency(out, "planner", &latencies.planner)?;
        latency(out, "controller", &latencies.controller)?;
    }
    for contact in &record.contacts {
        writeln!(out, "contact    {}", contact_in_words(contact))?;
    }
    Ok(())
}

fn latency(out: &mut impl Write, name: &str, latency: &Latency) -> io::Result<()> {
    writeln!(
        out,
        "{name:<10} {:.2} ms median, {:.2} ms in 99 of 100, {:.2} ms at worst",
        latency.median_ms, latency.p99_ms, latency.worst_ms
    )
}

fn contact_in_words(contact: &Contact) -> String {
    let with = match &contact.with {
        Contacted::Agent(name) => format!("agent {name}"),
        _ => "an obstacle".to_owned(),
    };
    let what = match contact.by {
        Culprit::Robot => format!("the robot drove into {with}"),
        Culprit::Other => format!("{with} ran into the robot"),
        Culprit::Both => format!("the robot and {with} drove into each other"),
    };
    format!(
        "{:.2} s at ({:.3}, {:.3}) m: {what}; the robot at {:.2} m/s",
        contact.t_s, contact.place.x, contact.place.y, contact.robot_mps
    )
}
