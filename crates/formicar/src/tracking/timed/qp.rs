//! The quadratic program of a model-predictive controller, in the form of Clarabel.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT,
};

/// States of the kinematic bicycle: x, y, heading, speed, steering angle.
pub(super) const N_STATES: usize = 5;
/// Inputs: acceleration, steering rate.
pub(super) const N_INPUTS: usize = 2;
/// Variables of a step: its input, and the state after it.
const N_STEP: usize = N_STATES + N_INPUTS;

/// A step of the horizon: `x' = A x + B u + c`, its cost and its limits.
#[derive(Clone, Debug)]
pub(super) struct QpStep {
    /// A, row by row.
    pub(super) by_state: [[f64; N_STATES]; N_STATES],
    /// B, row by row.
    pub(super) by_input: [[f64; N_INPUTS]; N_STATES],
    /// c.
    pub(super) constant: [f64; N_STATES],
    /// The symmetric weight of the state after the step.
    pub(super) weight: [[f64; N_STATES]; N_STATES],
    /// The state wished for.
    pub(super) wish: [f64; N_STATES],
    /// The weights of the inputs.
    pub(super) input_weight: [f64; N_INPUTS],
    /// Limits of speed and steering angle after the step.
    pub(super) state_limits: [[f64; 2]; 2],
    /// Limits of the inputs.
    pub(super) input_limits: [[f64; 2]; N_INPUTS],
}

/// The inputs that cost least from a state on; none where the solver finds none.
///
/// Variables are ordered by steps; the dynamics are equations, the limits inequalities.
pub(super) fn solve(first: [f64; N_STATES], steps: &[QpStep]) -> Option<Vec<[f64; N_INPUTS]>> {
    let n = N_STEP * steps.len();
    let (weights, linear) = cost(steps);
    let mut rows = Rows::default();
    for (k, step) in steps.iter().enumerate() {
        dynamics(&mut rows, k, step, (k == 0).then_some(first));
    }
    let n_equations = rows.bounds.len();
    for (k, step) in steps.iter().enumerate() {
        limits(&mut rows, k, step);
    }
    let n_limits = rows.bounds.len() - n_equations;
    let (at_rows, at_cols, values) = rows.entries;
    let matrix = CscMatrix::new_from_triplets(rows.bounds.len(), n, at_rows, at_cols, values);
    let cones = [ZeroConeT(n_equations), NonnegativeConeT(n_limits)];
    let settings = DefaultSettingsBuilder::default();
    let settings = { settings }
        .verbose(false)
        .max_iter(MAX_ITERATIONS)
        .build()
        .ok()?;
    let solver = DefaultSolver::new(&weights, &linear, &matrix, &rows.bounds, &cones, settings);
    let mut solver = solver.ok()?;
    solver.solve();
    let is_solved = matches!(
        solver.solution.status,
        SolverStatus::Solved | SolverStatus::AlmostSolved
    );
    let inputs = (0..steps.len()).map(|k| {
        let at = k * N_STEP;
        [solver.solution.x[at], solver.solution.x[at + 1]]
    });
    let inputs: Vec<_> = inputs.collect();
    let is_finite = inputs.iter().flatten().all(|input| input.is_finite());
    (is_solved && is_finite).then_some(inputs)
}

/// A program of this size takes about ten.
const MAX_ITERATIONS: u32 = 50;

/// Triplets of a matrix and the right side.
#[derive(Default)]
struct Rows {
    entries: (Vec<usize>, Vec<usize>, Vec<f64>),
    bounds: Vec<f64>,
}

impl Rows {
    fn entry(&mut self, col: usize, value: f64) {
        if value != 0.0 {
            self.entries.0.push(self.bounds.len());
            self.entries.1.push(col);
            self.entries.2.push(value);
        }
    }

    fn end(&mut self, bound: f64) {
        self.bounds.push(bound);
    }
}

fn input_at(k: usize, i: usize) -> usize {
    k * N_STEP + i
}

/// The variable of a state after step k.
fn state_at(k: usize, i: usize) -> usize {
    k * N_STEP + N_INPUTS + i
}

/// `1/2 z' P z + q' z`, the upper half of P.
fn cost(steps: &[QpStep]) -> (CscMatrix<f64>, Vec<f64>) {
    let n = N_STEP * steps.len();
    let mut entries = (Vec::new(), Vec::new(), Vec::new());
    let mut linear = vec![0.0; n];
    let mut push = |row: usize, col: usize, value: f64| {
        if value != 0.0 {
            entries.0.push(row);
            entries.1.push(col);
            entries.2.push(value);
        }
    };
    for (k, step) in steps.iter().enumerate() {
        for (i, weight) in step.input_weight.iter().enumerate() {
            push(input_at(k, i), input_at(k, i), 2.0 * weight);
        }
        for i in 0..N_STATES {
            for j in i..N_STATES {
                push(state_at(k, i), state_at(k, j), 2.0 * step.weight[i][j]);
            }
            let row = step.weight[i].iter().zip(&step.wish);
            linear[state_at(k, i)] = -2.0 * row.map(|(w, wish)| w * wish).sum::<f64>();
        }
    }
    let (rows, cols, values) = entries;
    (
        CscMatrix::new_from_triplets(n, n, rows, cols, values),
        linear,
    )
}

/// `x' - A x - B u = c`; the first state is known.
fn dynamics(rows: &mut Rows, k: usize, step: &QpStep, first: Option<[f64; N_STATES]>) {
    for i in 0..N_STATES {
        let mut bound = step.constant[i];
        rows.entry(state_at(k, i), 1.0);
        for (j, value) in step.by_input[i].iter().enumerate() {
            rows.entry(input_at(k, j), -value);
        }
        for (j, value) in step.by_state[i].iter().enumerate() {
            match first {
                Some(first) => bound += value * first[j],
                None => rows.entry(state_at(k - 1, j), -value),
            }
        }
        rows.end(bound);
    }
}

/// `z <= high` and `-z <= -low`.
fn limits(rows: &mut Rows, k: usize, step: &QpStep) {
    let speed_and_steer = [state_at(k, 3), state_at(k, 4)];
    let states = speed_and_steer.into_iter().zip(step.state_limits);
    let inputs = (0..N_INPUTS).map(|i| input_at(k, i)).zip(step.input_limits);
    for (col, [low, high]) in states.chain(inputs) {
        for (sign, bound) in [(1.0, high), (-1.0, -low)] {
            if bound.is_finite() {
                rows.entry(col, sign);
                rows.end(bound);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_double_integrator_is_driven_within_its_limits() {
        let dt = 0.1;
        let mut by_state = [[0.0; N_STATES]; N_STATES];
        (0..N_STATES).for_each(|i| by_state[i][i] = 1.0);
        by_state[0][3] = dt;
        let mut by_input = [[0.0; N_INPUTS]; N_STATES];
        by_input[3][0] = dt;
        by_input[4][1] = dt;
        let mut weight = [[0.0; N_STATES]; N_STATES];
        weight[0][0] = 1.0;
        weight[3][3] = 0.1;
        let step = QpStep {
            by_state,
            by_input,
            constant: [0.0; N_STATES],
            weight,
            wish: [1.0, 0.0, 0.0, 0.0, 0.0],
            input_weight: [0.01, 0.01],
            state_limits: [[-1.0, 1.0], [-0.5, 0.5]],
            input_limits: [[-1.0, 1.0], [-1.0, 1.0]],
        };
        let inputs = solve([0.0; N_STATES], &vec![step; 40]).unwrap();
        assert!((inputs[0][0] - 1.0).abs() < 1e-3, "{:?}", inputs[0]);
        let (mut x, mut v) = (0.0, 0.0);
        for [a, _] in &inputs {
            assert!(a.abs() < 1.0 + 1e-6);
            x += dt * v;
            v += dt * a;
        }
        assert!((x - 1.0).abs() < 0.05 && v.abs() < 0.1, "{x} {v}");
    }
}
