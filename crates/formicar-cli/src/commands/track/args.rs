//! The flags of `track` and the parameters they set.

use crate::scene::SceneArgs;
use crate::values;
use anyhow::{Result, bail};
use clap::{Args, ValueEnum, ValueHint};
use formicar::tracking::{
    Actuators, Controller, MpcParameters, PurePursuit, RegulatedPurePursuit, Stanley, StartOffset,
    TrackingConfig,
};
use std::path::PathBuf;

/// Flags of `track`.
#[derive(Args, Debug)]
pub(crate) struct TrackArgs {
    /// The path: an answer of `plan` (.json), or a CSV of x, y[, heading] in meters and radians;
    /// `-` reads it from stdin.
    #[arg(value_name = "PATH", value_hint = ValueHint::FilePath)]
    pub(super) path: PathBuf,

    #[command(flatten)]
    pub(super) scene: SceneArgs,

    /// Steering controller; `stanley` by default.
    #[arg(long, value_name = "LAW")]
    controller: Option<Law>,

    /// Drive in time: by the drive of the answer (`plan --moving`, `plan --speed`) or, without one,
    /// by the fastest within speed, acceleration and steering rate.
    #[arg(long)]
    pub(super) speed_plan: bool,

    /// Time until a command takes effect, seconds; 0 by default.
    #[arg(long, value_name = "S", value_parser = values::not_negative, allow_hyphen_values = true)]
    delay: Option<f64>,

    /// Largest acceleration in m/s^2, with a speed plan; that of the vehicle by default, or 1.
    #[arg(long, value_name = "MPS2", value_parser = values::positive, allow_hyphen_values = true)]
    acceleration: Option<f64>,

    /// Lookahead distance of `pure-pursuit`, meters; half a wheelbase by default.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    lookahead: Option<f64>,

    /// Rate at which `stanley` brings the front axle back to the path, 1/s; 1 by default.
    #[arg(long, value_name = "PER_S", value_parser = values::positive, allow_hyphen_values = true)]
    gain: Option<f64>,

    /// Softening speed of `stanley`, which limits steering at low speed, m/s.
    #[arg(long, value_name = "MPS", value_parser = values::not_negative, allow_hyphen_values = true)]
    softening: Option<f64>,

    /// Speed in m/s; that of the vehicle by default, or 0.3.
    #[arg(long, value_name = "MPS", value_parser = values::positive, allow_hyphen_values = true)]
    speed: Option<f64>,

    /// Steering rate in rad/s (or 30deg); that of the vehicle by default, or unlimited.
    #[arg(long, value_name = "RAD_PER_S", value_parser = values::turn_rate, allow_hyphen_values = true)]
    steer_rate: Option<f64>,

    /// Offset of the start from the path: meters to the left, radians (or 5deg), meters ahead.
    #[arg(long, value_name = "LEFT[,TURN[,AHEAD]]", value_parser = values::start_offset,
          allow_hyphen_values = true)]
    offset: Option<StartOffset>,

    /// Time step of the simulation, seconds; 0.02 by default.
    #[arg(long, value_name = "S", value_parser = values::positive, allow_hyphen_values = true)]
    time_step: Option<f64>,

    /// Time between two points of the trace, seconds; 0.1 by default.
    #[arg(long, value_name = "S", value_parser = values::positive, allow_hyphen_values = true)]
    record: Option<f64>,

    /// Distance from the path at which the drive is given up, meters; 2 by default.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    give_up: Option<f64>,

    /// Write the trace as a table.
    #[arg(long, value_name = "F.csv", value_hint = ValueHint::FilePath)]
    pub(super) csv: Option<PathBuf>,

    /// Write a picture.
    #[arg(long, value_name = "F.svg|F.png", value_hint = ValueHint::FilePath)]
    pub(super) picture: Option<PathBuf>,

    /// Print the result with its trace as one JSON object (see `schema track`).
    #[arg(long)]
    pub(super) json: bool,
}

/// The steering controllers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Law {
    /// The path's own steering angle at the driven length.
    OpenLoop,
    /// Follow the circle to a point ahead.
    PurePursuit,
    /// The front wheels follow the path and steer toward it.
    Stanley,
    /// Pure pursuit that slows down in turns, near obstacles and toward stops.
    RegulatedPurePursuit,
    /// Look ahead with a model of the vehicle.
    Mpc,
}

impl TrackArgs {
    /// True where the drive is one in time.
    pub(super) fn is_in_time(&self, config: &TrackingConfig) -> Result<bool> {
        let is_in_time = self.speed_plan || config.controller.needs_time();
        for (flag, is_given) in [
            ("--delay", self.delay.is_some()),
            ("--acceleration", self.acceleration.is_some()),
        ] {
            if is_given && !is_in_time {
                bail!("{flag}: a drive at one speed has no such parameter; hint: --speed-plan");
            }
        }
        Ok(is_in_time)
    }

    /// The parameters of the flags, over the defaults.
    pub(super) fn config(&self) -> Result<TrackingConfig> {
        let usual = TrackingConfig::default();
        Ok(TrackingConfig {
            controller: self.controller()?,
            speed_mps: self.speed,
            max_steer_rate_rad_per_s: self.steer_rate,
            time_step_s: self.time_step.unwrap_or(usual.time_step_s),
            record_interval_s: self.record.unwrap_or(usual.record_interval_s),
            actuators: Actuators {
                delay_s: self.delay.unwrap_or(usual.actuators.delay_s),
                max_acceleration_mps2: self.acceleration,
                ..usual.actuators
            },
            start_offset: self.offset.unwrap_or(usual.start_offset),
            give_up_error_m: self.give_up.unwrap_or(usual.give_up_error_m),
            ..usual
        })
    }

    fn controller(&self) -> Result<Controller> {
        let usual = Stanley::default();
        let controller = match self.controller.unwrap_or(Law::Stanley) {
            Law::OpenLoop => Controller::OpenLoop,
            Law::PurePursuit => Controller::PurePursuit(PurePursuit {
                lookahead_m: self.lookahead,
            }),
            Law::Stanley => Controller::Stanley(Stanley {
                gain_per_s: self.gain.unwrap_or(usual.gain_per_s),
                softening_mps: self.softening.unwrap_or(usual.softening_mps),
            }),
            Law::RegulatedPurePursuit => {
                Controller::RegulatedPurePursuit(RegulatedPurePursuit::default())
            }
            Law::Mpc => Controller::Mpc(MpcParameters::default()),
        };
        // A flag of another law would do nothing.
        for (flag, is_given, law) in [
            ("--lookahead", self.lookahead.is_some(), "pure-pursuit"),
            ("--gain", self.gain.is_some(), "stanley"),
            ("--softening", self.softening.is_some(), "stanley"),
        ] {
            if is_given && controller.name() != law {
                let asked = controller.name();
                bail!("{flag}: {asked} has no such parameter; hint: --controller {law}");
            }
        }
        Ok(controller)
    }
}
