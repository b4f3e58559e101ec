//! A path driven in time: its speed planned, and certified by the judge.

use crate::map::GridFrame;
use crate::motion::{MotionConfig, MotionError, MotionPlan, MotionProblem, plan_motion};
use crate::path::CurvePath;
use crate::scenario::{MovingError, Predictions, SpeedZones};
use crate::validation::{DriveRules, TimedCertificate, TimedReport, judge_in_time};
use crate::vehicle::Vehicle;
use thiserror::Error;

/// What is asked about a drive.
#[derive(Clone, Copy, Debug)]
pub struct DriveQuestion<'a> {
    /// Moving obstacles.
    pub predictions: &'a Predictions,
    /// Areas with speed limits of their own.
    pub zones: Option<&'a SpeedZones>,
    /// Limits, present speed and distance.
    pub config: &'a MotionConfig,
}

/// A certified drive along a path.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct TimedPlan {
    /// The speed plan.
    pub motion: MotionPlan,
    /// The judge's word on it.
    pub certificate: TimedCertificate,
}

/// Why there is no drive.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum DriveError {
    /// Predictions that make no sense here.
    #[error(transparent)]
    Moving(#[from] MovingError),
    /// No speed plan.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The judge refused the speed plan.
    #[error(
        "the judge refused the speed plan{}",
        .0.violations.first().map_or(String::new(), |v| format!(": {}", v.message))
    )]
    Refused(Box<TimedReport>),
}

/// Plans the speed along a certified path and lets the judge decide.
///
/// # Errors
/// Obstacles that begin off the map or inside the vehicle, no speed plan, or one that the judge
/// refuses.
pub fn drive_in_time(
    frame: &GridFrame,
    vehicle: &Vehicle,
    path: &CurvePath,
    question: &DriveQuestion,
) -> Result<TimedPlan, DriveError> {
    let DriveQuestion {
        predictions,
        zones,
        config,
    } = *question;
    predictions.check_at(frame, vehicle, path.start())?;
    let problem = MotionProblem {
        path,
        vehicle,
        predictions,
        zones,
    };
    let motion = plan_motion(&problem, config)?;
    let report = judge_in_time(&question.rules(vehicle), &motion.timed);
    let certificate = report.certify().map_err(DriveError::Refused)?;
    Ok(TimedPlan {
        motion,
        certificate,
    })
}

impl<'a> DriveQuestion<'a> {
    /// The rules that a drive of a vehicle has to keep.
    pub fn rules(&self, vehicle: &'a Vehicle) -> DriveRules<'a> {
        DriveRules {
            vehicle,
            limits: &self.config.limits,
            zones: self.zones,
            present_speed_mps: self.config.present_speed_mps,
            predictions: self.predictions,
            distance_m: self.config.distance_m,
        }
    }
}
