//! Runs of colonies, carried out and grouped by map and variant.

use crate::analysis::statistics::distinct;
use crate::papers::claims::{Comparison, Expected};
use crate::papers::experiment::{Ground, Setup, Variant};
use crate::papers::group::{Group, Quantity, ResultRow};
use crate::papers::trial::{Moment, Run, Trial};
use crate::report::{BoxPlot, Trend, TrendPanel, Trends};
use crate::run::pool;
use anyhow::Result;
use formicar::render::AxisScale;

/// A number of a run.
pub(crate) type Measure = fn(&Trial) -> Option<f64>;

impl ResultRow for Trial {
    fn ground(&self) -> &str {
        &self.map
    }

    fn seed(&self) -> u64 {
        self.seed
    }
}

/// Runs every variant on every ground with every seed, and tells before each variant.
pub(crate) fn run_all(
    grounds: &[Ground],
    variants: impl Fn(&Ground) -> Vec<Variant>,
    setup: &Setup,
    report_progress: &mut dyn FnMut(&str),
) -> Result<Vec<Run>> {
    let mut runs = Vec::new();
    for ground in grounds {
        for variant in variants(ground) {
            report_progress(&format!("{}: {}", ground.map, variant.name));
            let n_seeds = setup.scale.n_seeds as usize;
            let of_variant = pool::map(setup.n_jobs, n_seeds, |seed| {
                Trial::run(ground, &variant, seed as u64)
            });
            runs.extend(of_variant?);
        }
    }
    Ok(runs)
}

/// Quantities that claims of more than one paper are about.
pub(crate) const LENGTH: Quantity<Trial> =
    Quantity::new("length, cells", 1, |trial| trial.length_cells);
pub(crate) const SEARCH: Quantity<Trial> =
    Quantity::new("search, ms", 1, |trial| Some(trial.search_ms));
pub(crate) const CONVERGED: Quantity<Trial> =
    Quantity::new("iterations to within 1 % of its best", 0, |trial| {
        Some(f64::from(trial.n_to_1_percent?))
    });

/// All runs of an experiment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Runs<'a>(pub(crate) &'a [Run]);

impl<'a> Runs<'a> {
    /// The runs of a variant on a map, in the order of their seeds.
    pub(crate) fn of<'b>(
        &self,
        map: &'b str,
        variant: &'b str,
    ) -> impl Iterator<Item = &'a Run> + use<'a, 'b> {
        let belongs = move |run: &&Run| run.trial.map == map && run.trial.variant == variant;
        self.0.iter().filter(belongs)
    }

    /// The rows of a variant on a map.
    pub(crate) fn group(&self, map: &str, variant: &str) -> Group<'a, Trial> {
        Group::new(self.of(map, variant).map(|run| &run.trial))
    }

    /// The variants on a map, in the order in which they ran, each with its rows.
    pub(crate) fn groups(&self, map: &str) -> Vec<(&'a str, Group<'a, Trial>)> {
        let of_map = self.0.iter().filter(|run| run.trial.map == map);
        let names = distinct(of_map.map(|run| run.trial.variant.as_str()));
        let groups = names.into_iter().map(|name| (name, self.group(map, name)));
        groups.collect()
    }

    /// Two variants with the same seeds.
    pub(crate) fn compare(
        &self,
        map: &str,
        [first, other]: [&str; 2],
        quantity: &Quantity<Trial>,
        expected: Expected,
    ) -> Comparison {
        let name = comparison_name(map, first, other);
        let groups = [first, other].map(|variant| self.group(map, variant));
        groups[0].compare(&groups[1], quantity, name, expected)
    }

    /// A box per variant of a map, of the lengths of the ants' best ways.
    pub(crate) fn boxes_of_lengths(&self, map: &str, caption: &str) -> BoxPlot {
        let groups = self.groups(map).into_iter();
        BoxPlot {
            caption: caption.to_owned(),
            quantity: "length, cells".to_owned(),
            groups: groups
                .map(|(name, group)| group.boxed(name, |trial| trial.length_cells))
                .collect(),
            ..BoxPlot::default()
        }
    }

    /// Length of the best way so far by iteration, by ants sent out and by time.
    pub(crate) fn convergence(&self, map: &str, variants: &[&str], caption: &str) -> Trends {
        let trend = |variant: &str, scale, x: fn(&Moment) -> f64| {
            let runs = self.of(map, variant);
            let steps: Vec<Vec<[f64; 2]>> = runs.map(|run| steps(&run.moments, x)).collect();
            Trend::of_runs(variant, &steps, scale)
        };
        let panel = |name: &str, scale, x: fn(&Moment) -> f64| TrendPanel {
            x: name.to_owned(),
            x_scale: scale,
            trends: variants.iter().map(|v| trend(v, scale, x)).collect(),
        };
        Trends {
            caption: caption.to_owned(),
            quantity: "best way so far, cells".to_owned(),
            y_scale: AxisScale::Linear,
            panels: vec![
                panel("iteration", AxisScale::Linear, |m| f64::from(m.iteration)),
                panel("ants sent out", AxisScale::Log, |m| m.n_ants as f64),
                panel("time, ms", AxisScale::Log, |m| m.ms.max(1e-3)),
            ],
        }
    }
}

/// The map and the two that are compared; a variant of the first by its difference.
fn comparison_name(map: &str, first: &str, other: &str) -> String {
    let variant = other.strip_prefix(first);
    match variant.and_then(|rest| rest.strip_prefix(", ")) {
        Some(what) => format!("{map}, {first} - with {what}"),
        None => format!("{map}, {first} - {other}"),
    }
}

/// The best length after each iteration that has one.
fn steps(moments: &[Moment], x: fn(&Moment) -> f64) -> Vec<[f64; 2]> {
    let step = |moment: &Moment| Some([x(moment), moment.best_so_far_length?]);
    moments.iter().filter_map(step).collect()
}
