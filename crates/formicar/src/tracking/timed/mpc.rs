//! Model-predictive control of the kinematic bicycle.
//!
//! Over n steps of duration h the state z = (x, y, heading, v, steer) follows
//! `x' = v cos(heading)`, `y' = v sin(heading)`, `heading' = v tan(steer) / L`, `v' = a`,
//! `steer' = w`. The program is linear about the last solution, shifted by the time since: each step
//! is driven by Runge-Kutta, and `A = I + h df/dz`, `B = h df/du`. The cost is quadratic: errors
//! along and across the path at the time, of heading, speed and steering angle, and the inputs. Speed,
//! steering angle, acceleration and steering rate are bounded. Commands that are on their way are
//! driven first, so that the program begins where its first input takes effect.

use super::MpcParameters;
use super::controller::{DriveCommand, DriveController, DriveMoment};
use super::qp::{N_INPUTS, N_STATES, QpStep, solve};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{Phase, TimedPath};
use crate::vehicle::{BicycleInput, BicycleState};

/// Steering rate of wheels that turn as fast as one likes, rad/s.
const FAST_WHEELS_RAD_PER_S: f64 = 20.0;
/// Room above the fastest speed of the reference, for making up for a delay.
const SPEED_ROOM: f64 = 1.1;
/// Speeds below this are in both gears, m/s.
const STANDS_MPS: f64 = 0.02;

/// A model-predictive controller with its last solution.
#[derive(Clone, Debug)]
pub struct ModelPredictive {
    parameters: MpcParameters,
    /// The inputs of the last solution, and the time of the first.
    last: Option<(f64, Vec<[f64; N_INPUTS]>)>,
    n_failures: usize,
}

impl ModelPredictive {
    /// A controller that has not solved anything yet.
    pub fn new(parameters: MpcParameters) -> Self {
        Self {
            parameters,
            last: None,
            n_failures: 0,
        }
    }

    /// The inputs of the last solution from a time on; braking where there is none.
    fn shifted(&self, t_s: f64) -> Vec<[f64; N_INPUTS]> {
        let n_steps = self.parameters.n_steps as usize;
        let Some((first_s, inputs)) = &self.last else {
            return vec![[0.0; N_INPUTS]; n_steps];
        };
        let shift = ((t_s - first_s) / self.parameters.step_s).max(0.0);
        let (whole, share) = (shift.floor() as usize, shift.fract());
        let at = |i: usize| inputs.get(i).copied().unwrap_or_default();
        (0..n_steps)
            .map(|i| {
                let (a, b) = (at(i + whole), at(i + whole + 1));
                [0, 1].map(|j| a[j] + share * (b[j] - a[j]))
            })
            .collect()
    }

    fn steps(&self, at: &DriveMoment, first: BicycleState, first_s: f64) -> Vec<QpStep> {
        let step_s = self.parameters.step_s;
        let mut here = first;
        let shifted = self.shifted(first_s);
        let steps = shifted.into_iter().enumerate().map(|(k, input)| {
            let t_s = first_s + (k + 1) as f64 * step_s;
            let step = self.step(at, here, input, t_s);
            here = driven(here, at, input, step_s);
            step
        });
        steps.collect()
    }

    /// The program of a step about a state and an input; the step ends at a time.
    fn step(
        &self,
        at: &DriveMoment,
        here: BicycleState,
        input: [f64; N_INPUTS],
        t_s: f64,
    ) -> QpStep {
        let p = &self.parameters;
        let next = driven(here, at, input, p.step_s);
        let (by_state, by_input) = linearized(here, at.limits.wheelbase_m, p.step_s);
        let (z, z_next) = (vector(here), vector(next));
        let constant = [0, 1, 2, 3, 4].map(|i: usize| {
            let states: f64 = by_state[i].iter().zip(&z).map(|(a, z)| a * z).sum();
            let inputs: f64 = by_input[i].iter().zip(&input).map(|(b, u)| b * u).sum();
            z_next[i] - states - inputs
        });
        let wish = reference(at, t_s, next.pose.heading);
        let (sin, cos) = wish[2].sin_cos();
        let (along, across) = (p.along_weight, p.across_weight);
        let mut weight = [[0.0; N_STATES]; N_STATES];
        weight[0][0] = along * cos * cos + across * sin * sin;
        weight[1][1] = along * sin * sin + across * cos * cos;
        weight[0][1] = (along - across) * sin * cos;
        weight[1][0] = weight[0][1];
        weight[2][2] = p.heading_weight;
        weight[3][3] = p.speed_weight;
        weight[4][4] = p.steer_weight;
        let top_mps = top_speed_mps(at.reference);
        let steer = at.limits.max_steer_rad;
        let rate = at.limits.steer_rate_rad_per_s.min(FAST_WHEELS_RAD_PER_S);
        let (a, b) = (at.limits.acceleration_mps2, at.limits.braking_mps2);
        let accelerations = match here.speed_mps {
            v if v > STANDS_MPS => [-b, a],
            v if v < -STANDS_MPS => [-a, b],
            _ => [-a, a],
        };
        QpStep {
            by_state,
            by_input,
            constant,
            weight,
            wish,
            input_weight: [p.acceleration_weight, p.steer_rate_weight],
            state_limits: [[-top_mps, top_mps], [-steer, steer]],
            input_limits: [accelerations, [-rate, rate]],
        }
    }
}

impl DriveController for ModelPredictive {
    fn name(&self) -> &'static str {
        "mpc"
    }

    fn command(&mut self, at: &DriveMoment) -> DriveCommand {
        let first = when_it_takes_effect(at);
        let first_s = at.t_s + at.limits.delay_s;
        let steps = self.steps(at, first, first_s);
        let Some(inputs) = solve(vector(first), &steps) else {
            self.n_failures += 1;
            self.last = None;
            return DriveCommand {
                speed_mps: 0.0,
                steer_rad: at.state.steer_rad,
            };
        };
        // The actuators get there as fast as they can: the command is the state after a period.
        let period_s = at.limits.control_period_s;
        let [acceleration_mps2, steer_rate] = inputs[0];
        let command = DriveCommand {
            speed_mps: first.speed_mps + acceleration_mps2 * period_s,
            steer_rad: first.steer_rad + steer_rate * period_s,
        };
        self.last = Some((first_s, inputs));
        command
    }

    fn n_failures(&self) -> usize {
        self.n_failures
    }
}

/// The state after the commands that are on their way.
fn when_it_takes_effect(at: &DriveMoment) -> BicycleState {
    let period_s = at.limits.control_period_s;
    at.pending.iter().fold(at.state, |state, command| {
        let rate = at.limits.steer_rate_rad_per_s;
        let most_rad = rate * period_s;
        let turn = (command.steer_rad - state.steer_rad).clamp(-most_rad, most_rad);
        let (a, b) = (at.limits.acceleration_mps2, at.limits.braking_mps2);
        let change = command.speed_mps - state.speed_mps;
        let most_mps = if change * state.speed_mps < 0.0 { b } else { a } * period_s;
        let input = BicycleInput {
            acceleration_mps2: change.clamp(-most_mps, most_mps) / period_s,
            steer_rate_rad_per_s: turn / period_s,
        };
        state.step(at.limits.wheelbase_m, input, period_s)
    })
}

fn driven(
    state: BicycleState,
    at: &DriveMoment,
    [acceleration_mps2, steer_rate_rad_per_s]: [f64; N_INPUTS],
    duration_s: f64,
) -> BicycleState {
    let input = BicycleInput {
        acceleration_mps2,
        steer_rate_rad_per_s,
    };
    let limit = at.limits.max_steer_rad;
    let next = state.step(at.limits.wheelbase_m, input, duration_s);
    BicycleState {
        steer_rad: next.steer_rad.clamp(-limit, limit),
        ..next
    }
}

fn vector(state: BicycleState) -> [f64; N_STATES] {
    let Pose2 { x, y, heading } = state.pose;
    [x, y, heading, state.speed_mps, state.steer_rad]
}

type ByState = [[f64; N_STATES]; N_STATES];
type ByInput = [[f64; N_INPUTS]; N_STATES];

/// `I + h df/dz` and `h df/du`.
fn linearized(state: BicycleState, wheelbase_m: f64, step_s: f64) -> (ByState, ByInput) {
    let (sin, cos) = state.pose.heading.sin_cos();
    let (v, tan) = (state.speed_mps, state.steer_rad.tan());
    let mut by_state = [[0.0; N_STATES]; N_STATES];
    for (i, row) in by_state.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    by_state[0][2] = -step_s * v * sin;
    by_state[0][3] = step_s * cos;
    by_state[1][2] = step_s * v * cos;
    by_state[1][3] = step_s * sin;
    by_state[2][3] = step_s * tan / wheelbase_m;
    by_state[2][4] = step_s * v * (1.0 + tan * tan) / wheelbase_m;
    let mut by_input = [[0.0; N_INPUTS]; N_STATES];
    by_input[3][0] = step_s;
    by_input[4][1] = step_s;
    (by_state, by_input)
}

/// The state wished for at a time, with a heading within half a turn of another.
fn reference(at: &DriveMoment, t_s: f64, near_heading: f64) -> [f64; N_STATES] {
    let due = at.reference.at(t_s);
    let path = at.reference.path();
    let pose = path.pose_at(due.s_m);
    let heading = near_heading + angle_difference(pose.heading, near_heading);
    let segment = path.segment_at(due.s_m);
    let sign = segment.map_or(1.0, |(segment, _)| segment.direction.sign());
    let steer_rad = due_steer_rad(at.reference, t_s, at.limits.wheelbase_m);
    [pose.x, pose.y, heading, sign * due.speed_mps, steer_rad]
}

/// The steering angle due at a time: that of the path, and while the vehicle stands at a joint, on the
/// way from the angle before to the angle after it.
fn due_steer_rad(reference: &TimedPath, t_s: f64, wheelbase_m: f64) -> f64 {
    /// Just before and after a joint, meters.
    const BESIDE_M: f64 = 1e-6;
    let path = reference.path();
    let steer = |s_m: f64| {
        let segment = path.segment_at(s_m);
        let curvature = segment.map_or(0.0, |(segment, m)| segment.curvature_at(m));
        (wheelbase_m * curvature).atan()
    };
    let due = reference.at(t_s);
    let begun = reference.phases().partition_point(|phase| phase.t_s <= t_s);
    let phase = begun.checked_sub(1).map(|i| reference.phases()[i]);
    let standing = phase.filter(|phase: &Phase| phase.is_standing() && phase.duration_s > 0.0);
    let Some(phase) = standing.filter(|phase| phase.s_m > BESIDE_M) else {
        return steer(due.s_m);
    };
    let share = ((t_s - phase.t_s) / phase.duration_s).clamp(0.0, 1.0);
    let [before, after] = [due.s_m - BESIDE_M, due.s_m + BESIDE_M].map(steer);
    before + share * (after - before)
}

fn top_speed_mps(reference: &TimedPath) -> f64 {
    let phases = reference.phases().iter();
    let speeds = phases.map(|phase| phase.speed_mps.max(phase.end().speed_mps));
    SPEED_ROOM * speeds.fold(STANDS_MPS, f64::max)
}
