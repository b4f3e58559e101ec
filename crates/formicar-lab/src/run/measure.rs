//! One query, watched and timed.

use super::usage;
use formicar::path::CurvePath;
use formicar::progress::{Event, IterationRecord, Observer};
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// A certified path that was better than all before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Improvement {
    /// Time since the beginning of the query, seconds.
    pub at_s: f64,
    /// Search steps by then.
    pub steps: u64,
    /// Length of the path.
    pub length_m: f64,
    /// Processor time since the beginning of the query, seconds; none where nobody tells.
    #[serde(default)]
    pub cpu_s: Option<f64>,
    /// Cost of driving the path by the usual weights; none of a path that was not judged valid.
    #[serde(default)]
    pub cost_m: Option<f64>,
}

/// An iteration of a colony or a population, with the time at which it ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedIteration {
    /// Time since the search began, seconds.
    pub at_s: f64,
    /// Its results.
    pub record: IterationRecord,
}

/// The answer to a query with everything that was measured of it.
#[derive(Clone, Debug)]
pub struct Measured<T> {
    /// The value that the query returned.
    pub answer: T,
    /// Wall time of the query, seconds.
    pub query_s: f64,
    /// Processor time of the process during the query, seconds; none where the platform does not
    /// tell.
    pub cpu_s: Option<f64>,
    /// Certified paths, the best last; their costs are not computed yet.
    pub improvements: Vec<Improvement>,
    /// The paths themselves, in the same order.
    pub paths: Vec<CurvePath>,
    /// Iterations of the last colony or population that ran.
    pub iterations: Vec<TimedIteration>,
}

impl<T> Measured<T> {
    /// Time from the beginning of the query to its first certified path, seconds.
    pub fn first_feasible_s(&self) -> Option<f64> {
        self.improvements.first().map(|first| first.at_s)
    }

    /// Processor time from the beginning of the query to its first certified path, seconds.
    pub fn first_feasible_cpu_s(&self) -> Option<f64> {
        self.improvements.first()?.cpu_s
    }

    /// The same measures with another answer.
    pub fn map<U>(self, convert: impl FnOnce(T) -> U) -> Measured<U> {
        Measured {
            answer: convert(self.answer),
            query_s: self.query_s,
            cpu_s: self.cpu_s,
            improvements: self.improvements,
            paths: self.paths,
            iterations: self.iterations,
        }
    }
}

/// Runs one query, which begins now, and measures it.
///
/// The query gets an observer that lends it a clock; `other` hears every event too.
///
/// ```
/// # use formicar::{geometry::Pose2, map::OccupancyGrid, numeric::Seed, scenario::Request};
/// # use formicar::{planner::{Planner, PlannerConfig}, vehicle::Vehicle};
/// # use formicar_lab::run::measure;
/// let map = OccupancyGrid::from_rows(&["..............."; 10], 1.0)?;
/// let mut planner = Planner::new(&map, Vehicle::warehouse_amr(), PlannerConfig::default())?;
/// let request = Request::new(Pose2::new(3.0, 5.0, 0.0), Pose2::new(11.0, 5.0, 0.0));
/// let measured = measure(&mut (), |observer| planner.plan(&request, Seed(1), observer));
/// assert!(measured.first_feasible_s().unwrap() <= measured.query_s);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure<T>(
    other: &mut dyn Observer,
    query: impl FnOnce(&mut dyn Observer) -> T,
) -> Measured<T> {
    let cpu_before_s = usage::cpu_s();
    let mut watch = Watch {
        begun: Instant::now(),
        cpu_before_s,
        search_begun: Duration::ZERO,
        improvements: Vec::new(),
        paths: Vec::new(),
        iterations: Vec::new(),
        other,
    };
    let answer = query(&mut watch);
    let query_s = watch.begun.elapsed().as_secs_f64();
    let cpu_s = usage::cpu_s().zip(cpu_before_s);
    Measured {
        answer,
        query_s,
        cpu_s: cpu_s.map(|(after_s, before_s)| after_s - before_s),
        improvements: watch.improvements,
        paths: watch.paths,
        iterations: watch.iterations,
    }
}

/// Lends a clock to a query and notes its paths and iterations.
struct Watch<'a> {
    begun: Instant,
    cpu_before_s: Option<f64>,
    search_begun: Duration,
    improvements: Vec<Improvement>,
    paths: Vec<CurvePath>,
    iterations: Vec<TimedIteration>,
    other: &'a mut dyn Observer,
}

impl Watch<'_> {
    fn improve(&mut self, path: &CurvePath, length_m: f64, steps: u64) {
        let cpu_s = usage::cpu_s().zip(self.cpu_before_s);
        self.improvements.push(Improvement {
            at_s: self.begun.elapsed().as_secs_f64(),
            steps,
            length_m,
            cpu_s: cpu_s.map(|(now_s, before_s)| now_s - before_s),
            cost_m: None,
        });
        self.paths.push(path.clone());
    }

    fn note(&mut self, record: &IterationRecord) {
        if record.iteration == 0 {
            // A planner that tries again begins anew.
            self.iterations.clear();
        }
        let since = self.begun.elapsed().saturating_sub(self.search_begun);
        self.iterations.push(TimedIteration {
            at_s: since.as_secs_f64(),
            record: *record,
        });
    }
}

impl Observer for Watch<'_> {
    fn on_event(&mut self, event: &Event) {
        match event {
            Event::SearchStarted => self.search_begun = self.begun.elapsed(),
            Event::Improved {
                path,
                length_m,
                n_steps,
            } => self.improve(path, *length_m, *n_steps),
            Event::Iteration(view) => self.note(view.record),
            Event::Generation(view) => self.note(view.record),
            _ => {}
        }
        self.other.on_event(event);
    }

    fn elapsed(&mut self) -> Option<Duration> {
        Some(self.begun.elapsed())
    }

    fn is_cancelled(&mut self) -> bool {
        self.other.is_cancelled()
    }

    fn watches_search(&self) -> bool {
        self.other.watches_search()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_what_it_hears_and_hands_it_on() {
        #[derive(Default)]
        struct Counter(usize);
        impl Observer for Counter {
            fn on_event(&mut self, _: &Event) {
                self.0 += 1;
            }
        }
        let mut counter = Counter::default();
        let path = CurvePath::from_polyline(&[]);
        let measured = measure(&mut counter, |observer| {
            observer.on_event(&Event::SearchStarted);
            for (length_m, n_steps) in [(3.0, 5), (2.0, 9)] {
                observer.on_event(&Event::Improved {
                    path: &path,
                    length_m,
                    n_steps,
                });
            }
            observer.elapsed().is_some()
        });
        assert!(measured.answer, "it lends a clock");
        assert_eq!(counter.0, 3);
        let steps: Vec<u64> = measured.improvements.iter().map(|i| i.steps).collect();
        assert_eq!(steps, [5, 9]);
        assert_eq!(measured.paths.len(), 2);
        assert!(measured.first_feasible_cpu_s() <= measured.cpu_s);
        let first_s = measured.first_feasible_s().unwrap();
        assert!(first_s <= measured.improvements[1].at_s && first_s <= measured.query_s);
    }
}
