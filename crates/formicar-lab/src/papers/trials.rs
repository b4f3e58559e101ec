//! Runs that belong together, and what stands in tables, plots and claims of them.

use crate::analysis::statistics::quantile;
use crate::papers::claims::{Comparison, Expected};
use crate::papers::trial::{Moment, Run, Trial};
use crate::report::{BandPanel, Bands, BoxGroup, BoxPlot, Course, ScaleKind};

/// A number of a run.
pub(crate) type Measure = fn(&Trial) -> Option<f64>;

/// All runs of an experiment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Runs<'a>(pub(crate) &'a [Run]);

/// A quantity that claims compare.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantity {
    pub(crate) name: &'static str,
    pub(crate) n_decimals: usize,
    pub(crate) of: Measure,
}

impl<'a> Runs<'a> {
    /// The runs of a variant on a map, in the order of their seeds.
    pub(crate) fn of(&self, map: &str, variant: &str) -> Vec<&'a Run> {
        let belongs = |run: &&Run| run.trial.map == map && run.trial.variant == variant;
        self.0.iter().filter(belongs).collect()
    }

    pub(crate) fn trials(&self, map: &str, variant: &str) -> Vec<&'a Trial> {
        let runs = self.of(map, variant).into_iter();
        runs.map(|run| &run.trial).collect()
    }

    pub(crate) fn values(&self, map: &str, variant: &str, of: Measure) -> Vec<f64> {
        let trials = self.trials(map, variant).into_iter();
        trials.filter_map(of).collect()
    }

    pub(crate) fn median(&self, map: &str, variant: &str, of: Measure) -> Option<f64> {
        quantile(&self.values(map, variant, of), 0.5)
    }

    /// Names of variants on a map, in the order in which they ran.
    pub(crate) fn variants(&self, map: &str) -> Vec<&'a str> {
        let mut names: Vec<&str> = Vec::new();
        for run in self.0.iter().filter(|run| run.trial.map == map) {
            if !names.contains(&run.trial.variant.as_str()) {
                names.push(&run.trial.variant);
            }
        }
        names
    }

    /// Two variants with the same seeds.
    pub(crate) fn compare(
        &self,
        map: &str,
        [first, other]: [&str; 2],
        (quantity, expected): (Quantity, Expected),
    ) -> Comparison {
        let others = self.trials(map, other);
        let pair = |trial: &Trial| {
            let same = others.iter().find(|other| other.seed == trial.seed)?;
            Some([(quantity.of)(trial)?, (quantity.of)(same)?])
        };
        let pairs = self.trials(map, first).into_iter().filter_map(pair);
        Comparison {
            name: named(map, first, other),
            quantity: quantity.name.to_owned(),
            n_decimals: quantity.n_decimals,
            pairs: pairs.collect(),
            expected,
        }
    }

    /// A box per variant of a map.
    pub(crate) fn boxes(
        &self,
        map: &str,
        (caption, quantity): (&str, &str),
        of: Measure,
    ) -> BoxPlot {
        let group = |name: &str| BoxGroup {
            name: name.to_owned(),
            values: self.values(map, name, of),
        };
        BoxPlot {
            caption: caption.to_owned(),
            quantity: quantity.to_owned(),
            groups: self.variants(map).into_iter().map(group).collect(),
            ..BoxPlot::default()
        }
    }

    /// Length of the best way so far by iteration, by ants sent out and by time.
    pub(crate) fn convergence(&self, map: &str, variants: &[&str], caption: &str) -> Bands {
        let course = |variant: &str, scale, x: fn(&Moment) -> f64| {
            let runs = self.of(map, variant).into_iter();
            let steps: Vec<Vec<[f64; 2]>> = runs.map(|run| steps(&run.course, x)).collect();
            Course::of_runs(variant, &steps, scale)
        };
        let panel = |name: &str, scale, x: fn(&Moment) -> f64| BandPanel {
            x: name.to_owned(),
            x_scale: scale,
            courses: variants.iter().map(|v| course(v, scale, x)).collect(),
        };
        Bands {
            caption: caption.to_owned(),
            quantity: "best way so far, cells".to_owned(),
            y_scale: ScaleKind::Linear,
            panels: vec![
                panel("iteration", ScaleKind::Linear, |m| f64::from(m.iteration)),
                panel("ants sent out", ScaleKind::Log, |m| m.n_ants as f64),
                panel("time, ms", ScaleKind::Log, |m| m.ms.max(1e-3)),
            ],
        }
    }
}

/// Who is compared with whom, and where; a variant of the first by what differs.
fn named(map: &str, first: &str, other: &str) -> String {
    let variant = other.strip_prefix(first);
    match variant.and_then(|rest| rest.strip_prefix(", ")) {
        Some(what) => format!("{map}, {first} - with {what}"),
        None => format!("{map}, {first} - {other}"),
    }
}

/// The best length after each iteration that has one.
fn steps(course: &[Moment], x: fn(&Moment) -> f64) -> Vec<[f64; 2]> {
    let step = |moment: &Moment| Some([x(moment), moment.best_so_far_length?]);
    course.iter().filter_map(step).collect()
}
