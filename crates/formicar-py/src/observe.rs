//! Watching a query from Python: the clock, cancellation, Ctrl-C, progress, ants.

use formicar::path::CurvePath;
use formicar::progress::{AntFrames, CancelToken, Event, Observer, StdClock};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::time::{Duration, Instant};

/// Time between two looks for signals. Each look takes the interpreter's lock.
const SIGNALS_EVERY: Duration = Duration::from_millis(10);
/// Time between two reports of steps.
const PROGRESS_EVERY: Duration = Duration::from_millis(20);

/// A path that was better than all before it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Improvement {
    pub(crate) at_s: f64,
    pub(crate) n_steps: u64,
    pub(crate) length_m: f64,
}

/// Lets Python handle its signals.
fn look(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}

/// The observer of a query that Python asks.
pub(crate) struct Watch {
    pub(crate) clock: StdClock,
    pub(crate) token: CancelToken,
    pub(crate) frames: Option<AntFrames>,
    pub(crate) improvements: Vec<Improvement>,
    /// Hears of the progress.
    listener: Option<Py<PyAny>>,
    /// What Python raised meanwhile, which ends the query.
    pub(crate) raised: Option<PyErr>,
    signals_at: Instant,
    progress_at: Instant,
}

impl Watch {
    pub(crate) fn new(
        token: CancelToken,
        listener: Option<Py<PyAny>>,
        frames: Option<AntFrames>,
    ) -> Self {
        Self {
            clock: StdClock::start(),
            token,
            frames,
            improvements: Vec::new(),
            listener,
            raised: None,
            signals_at: Instant::now(),
            progress_at: Instant::now(),
        }
    }

    fn raise(&mut self, error: PyErr) {
        self.token.cancel();
        self.raised.get_or_insert(error);
    }

    /// Lets Python handle its signals: Ctrl-C raises an exception.
    fn look_for_signals(&mut self) {
        if self.signals_at.elapsed() < SIGNALS_EVERY {
            return;
        }
        let handled = Python::attach(look);
        self.signals_at = Instant::now();
        if let Err(error) = handled {
            self.raise(error);
        }
    }

    /// Tells the listener of an event.
    fn tell(&mut self, event: &str, fill: impl FnOnce(&Bound<'_, PyDict>) -> PyResult<()>) {
        let Some(listener) = self.listener.as_ref().filter(|_| self.raised.is_none()) else {
            return;
        };
        let elapsed_s = self.clock.now().as_secs_f64();
        let told = Python::attach(|py| -> PyResult<()> {
            let members = PyDict::new(py);
            members.set_item("event", event)?;
            members.set_item("elapsed_s", elapsed_s)?;
            fill(&members)?;
            listener.call1(py, (members,))?;
            Ok(())
        });
        if let Err(error) = told {
            self.raise(error);
        }
    }

    fn tell_steps(&mut self, n_steps: u64) {
        if self.progress_at.elapsed() >= PROGRESS_EVERY {
            self.tell("progress", |members| members.set_item("n_steps", n_steps));
            // From the end of the call on: a slow listener is not called at every look.
            self.progress_at = Instant::now();
        }
    }

    fn note_improvement(&mut self, path: &CurvePath, n_steps: u64) {
        let length_m = path.length_m();
        self.improvements.push(Improvement {
            at_s: self.clock.now().as_secs_f64(),
            n_steps,
            length_m,
        });
        self.tell("improved", |members| {
            members.set_item("n_steps", n_steps)?;
            members.set_item("length_m", length_m)
        });
    }
}

impl Observer for Watch {
    fn on_event(&mut self, event: &Event) {
        self.clock.on_event(event);
        if let Some(frames) = &mut self.frames {
            frames.on_event(event);
        }
        match event {
            Event::Progress { n_steps } => self.tell_steps(*n_steps),
            Event::Improved { path, n_steps, .. } => self.note_improvement(path, *n_steps),
            Event::Iteration(view) => self.tell("iteration", |members| {
                members.set_item("iteration", view.record.iteration)?;
                members.set_item("best_so_far_cost", view.record.best_so_far_cost)
            }),
            Event::Generation(view) => self.tell("iteration", |members| {
                members.set_item("iteration", view.record.iteration)?;
                members.set_item("best_so_far_cost", view.record.best_so_far_cost)
            }),
            _ => {}
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        self.clock.elapsed()
    }

    fn is_cancelled(&mut self) -> bool {
        self.look_for_signals();
        self.token.is_cancelled()
    }
}
