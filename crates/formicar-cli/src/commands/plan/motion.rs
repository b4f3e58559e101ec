//! `plan --moving ...`: the speed along the path, among things that move.

use crate::session::Session;
use crate::{motion_files, values};
use anyhow::{Context, Result, bail};
use clap::{Args, ValueHint};
use formicar::collision::ObstacleMap;
use formicar::motion::{MotionConfig, MotionError};
use formicar::numeric::Seed;
use formicar::path::{CurvePath, SpeedLimits};
use formicar::planner::{
    DriveError, DriveQuestion, MotionRecord, TimedPlan, WayAround, drive_in_time, way_around,
};
use formicar::progress::StdClock;
use formicar::scenario::{Predictions, Request, SpeedZones};
use formicar::vehicle::Vehicle;
use std::path::PathBuf;

/// Flags of `plan` for the speed along the path.
#[derive(Args, Debug)]
#[command(next_help_heading = "Speed along the path")]
pub(crate) struct MotionArgs {
    /// Moving obstacles with their predictions (JSON, see `schema moving`): plan when to drive and
    /// when to wait, and certify the drive in time.
    #[arg(long, value_name = "F.json", value_hint = ValueHint::FilePath)]
    moving: Option<PathBuf>,

    /// Plan the speed, up to so many m/s; with --moving that of the vehicle by default, or 1.
    #[arg(long, value_name = "MPS", value_parser = values::positive, allow_hyphen_values = true)]
    speed: Option<f64>,

    /// Largest acceleration, m/s^2; that of the vehicle by default, or 1.
    #[arg(long, value_name = "MPS2", value_parser = values::positive, allow_hyphen_values = true)]
    acceleration: Option<f64>,

    /// Largest deceleration, m/s^2; as the acceleration by default.
    #[arg(long, value_name = "MPS2", value_parser = values::positive, allow_hyphen_values = true)]
    braking: Option<f64>,

    /// Largest lateral acceleration, m/s^2; 2 by default.
    #[arg(long, value_name = "MPS2", value_parser = values::positive, allow_hyphen_values = true)]
    lateral: Option<f64>,

    /// Fastest change of the steering angle, rad/s (or 30deg); that of the vehicle by default.
    #[arg(long, value_name = "RAD_PER_S", value_parser = values::turn_rate, allow_hyphen_values = true)]
    steer_rate: Option<f64>,

    /// Fastest change of the acceleration, m/s^3; unbounded by default.
    #[arg(long, value_name = "MPS3", value_parser = values::positive, allow_hyphen_values = true)]
    jerk: Option<f64>,

    /// Speed at the beginning of the path, m/s; 0 by default.
    #[arg(long, value_name = "MPS", value_parser = values::not_negative, allow_hyphen_values = true)]
    from_speed: Option<f64>,

    /// Least distance from moving obstacles, meters; 0.1 by default.
    #[arg(long, value_name = "M", requires = "moving",
          value_parser = values::not_negative, allow_hyphen_values = true)]
    keep_distance: Option<f64>,

    /// Time up to which predictions hold, seconds, instead of the one in the file.
    #[arg(long, value_name = "S", requires = "moving",
          value_parser = values::positive, allow_hyphen_values = true)]
    horizon: Option<f64>,

    /// Map whose graded cells are speed limits in percent of the top speed, as the mask of Nav2's
    /// speed filter; with numbers behind it, limits of BASE + MULTIPLIER * value m/s.
    #[arg(long, value_name = "F[,BASE,MULTIPLIER]")]
    speed_zones: Option<String>,
}

/// A drive that loses less is not worth looking for a way around, seconds.
const WORTH_A_LOOK_S: f64 = 1.0;

/// What a speed is planned with.
pub(crate) struct Motion {
    config: MotionConfig,
    predictions: Predictions,
    zones: Option<(String, SpeedZones)>,
}

/// The drive along a path, and its record; the record alone where there is no drive.
pub(crate) struct Driven {
    pub(crate) record: MotionRecord,
    pub(crate) plan: Option<TimedPlan>,
}

impl MotionArgs {
    /// What the flags ask for; none where they ask for no speed.
    pub(crate) fn load(&self, vehicle: &Vehicle) -> Result<Option<Motion>> {
        let is_asked = self.moving.is_some() || self.speed.is_some() || self.speed_zones.is_some();
        if !is_asked {
            return match self.first_given() {
                None => Ok(None),
                Some(flag) => bail!("{flag} needs a speed to plan; hint: --speed MPS"),
            };
        }
        let config = self.config(vehicle);
        config.check().context("the speed plan")?;
        Ok(Some(Motion {
            config,
            predictions: self.predictions()?,
            zones: self.zones()?,
        }))
    }

    fn first_given(&self) -> Option<&'static str> {
        let given = [
            ("--acceleration", self.acceleration),
            ("--braking", self.braking),
            ("--lateral", self.lateral),
            ("--steer-rate", self.steer_rate),
            ("--jerk", self.jerk),
            ("--from-speed", self.from_speed),
        ];
        let mut given = given.into_iter().filter(|(_, value)| value.is_some());
        given.next().map(|(flag, _)| flag)
    }

    fn config(&self, vehicle: &Vehicle) -> MotionConfig {
        let usual = SpeedLimits::of(vehicle).unwrap_or_else(|| {
            let parameters = vehicle.parameters();
            let usual = SpeedLimits::default();
            SpeedLimits {
                max_acceleration_mps2: parameters
                    .max_acceleration_mps2
                    .unwrap_or(usual.max_acceleration_mps2),
                max_steer_rate_rad_per_s: parameters.max_steer_rate_rad_per_s,
                ..usual
            }
        });
        let limits = SpeedLimits {
            max_speed_mps: self.speed.unwrap_or(usual.max_speed_mps),
            max_lateral_mps2: self.lateral.unwrap_or(usual.max_lateral_mps2),
            max_acceleration_mps2: self.acceleration.unwrap_or(usual.max_acceleration_mps2),
            max_braking_mps2: self.braking,
            max_steer_rate_rad_per_s: self.steer_rate.or(usual.max_steer_rate_rad_per_s),
            max_jerk_mps3: self.jerk,
        };
        let usual = MotionConfig::default();
        MotionConfig {
            limits,
            present_speed_mps: self.from_speed.unwrap_or(usual.present_speed_mps),
            distance_m: self.keep_distance.unwrap_or(usual.distance_m),
            ..usual
        }
    }

    fn predictions(&self) -> Result<Predictions> {
        let Some(path) = &self.moving else {
            // Nothing moves; any horizon serves.
            return Ok(Predictions::new(Vec::new(), 1.0)?);
        };
        motion_files::moving(path, self.horizon)
    }

    fn zones(&self) -> Result<Option<(String, SpeedZones)>> {
        let zones = |text: &String| Ok((text.clone(), motion_files::speed_zones(text)?));
        self.speed_zones.as_ref().map(zones).transpose()
    }
}

impl Motion {
    /// The drive along a path that is certified where it stands still.
    pub(crate) fn drive(
        &self,
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
        path: &CurvePath,
    ) -> Result<Driven> {
        let question = DriveQuestion {
            predictions: &self.predictions,
            zones: self.zones.as_ref().map(|(_, zones)| zones),
            config: &self.config,
        };
        let (record, plan) = match drive_in_time(obstacles.frame(), vehicle, path, &question) {
            Ok(plan) => (MotionRecord::new(&question, &plan), Some(plan)),
            Err(
                error @ (DriveError::Motion(MotionError::Unavoidable { .. })
                | DriveError::Refused(_)),
            ) => {
                let reason = Some(error.to_string());
                (MotionRecord::refused(&question, reason), None)
            }
            Err(error) => return Err(error.into()),
        };
        let speed_zones = self.zones.as_ref().map(|(name, _)| name.clone());
        let record = record.with_speed_zones(speed_zones);
        Ok(Driven { record, plan })
    }

    /// A way around what is waited for, where it is better than the drive along the path.
    pub(crate) fn around(
        &self,
        session: &Session,
        (request, seed): (&Request, Seed),
        driven: &Driven,
    ) -> Result<Option<WayAround>> {
        let loss_s = driven
            .plan
            .as_ref()
            .map_or(f64::INFINITY, |plan| plan.motion.lost_s());
        if loss_s < WORTH_A_LOOK_S || self.predictions.obstacles().is_empty() {
            return Ok(None);
        }
        let question = DriveQuestion {
            predictions: &self.predictions,
            zones: self.zones.as_ref().map(|(_, zones)| zones),
            config: &self.config,
        };
        let regions = driven
            .plan
            .as_ref()
            .map(|plan| plan.motion.regions.as_slice());
        let on = (&session.planner, &session.scene.map);
        let mut clock = StdClock::start();
        let found = way_around(
            on,
            (request, seed),
            &mut clock,
            &question,
            regions.unwrap_or_default(),
        )?;
        let is_better = |way: &WayAround| way.drive.is_better_than(driven.plan.as_ref());
        Ok(found.filter(is_better))
    }

    /// The record of a drive along a path.
    pub(crate) fn driven(&self, plan: TimedPlan) -> Driven {
        let question = DriveQuestion {
            predictions: &self.predictions,
            zones: self.zones.as_ref().map(|(_, zones)| zones),
            config: &self.config,
        };
        let speed_zones = self.zones.as_ref().map(|(name, _)| name.clone());
        Driven {
            record: MotionRecord::new(&question, &plan).with_speed_zones(speed_zones),
            plan: Some(plan),
        }
    }

    pub(crate) fn predictions(&self) -> &Predictions {
        &self.predictions
    }

    pub(crate) fn max_speed_mps(&self) -> f64 {
        self.config.limits.max_speed_mps
    }
}
