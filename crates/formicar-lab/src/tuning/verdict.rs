//! Default against tuned on scenarios that were held back, as it is.

use super::convergence;
use super::evaluate::Tuning;
use super::objective::Objective;
use super::runs::{Asked, TunedRun, run_all};
use super::state::TuningState;
use crate::analysis::statistics::{holm, quantile, wilcoxon};
use crate::papers::reproduction::{csv, facts_of, seeds};
use crate::report::{Block, Column, Fact, Field, Figure, Report, Section, Table};
use anyhow::{Context, Result};
use formicar::numeric::counted;
use formicar::planner::PlannerConfig;
use formicar::tuning::SearchRule;
use serde_json::Value;

/// The result of a tuning.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Tables and the picture.
    pub report: Report,
    /// The picture of the search alone.
    pub convergence_svg: String,
    /// Every run of the comparison, as CSV.
    pub runs_csv: String,
    /// Every cycle of the search, as CSV.
    pub cycles_csv: String,
    /// The tuned parameters, and nothing else, with the planner's name.
    pub document: Value,
    /// The configuration that comes of it.
    pub config: PlannerConfig,
    /// Maps, vehicles, seeds.
    pub facts: Vec<Fact>,
    /// Both configurations as JSON.
    pub configs: Vec<Fact>,
}

/// The runs of a scenario with both configurations, seed by seed.
struct Pairs<'a> {
    asked: &'a Asked,
    runs: Vec<[&'a TunedRun; 2]>,
}

impl Tuning {
    /// Runs the default and the best that was found on the scenarios held back, with seeds that were
    /// not tuned on.
    ///
    /// # Errors
    /// A search that has not begun.
    pub fn verdict(&self, state: &TuningState) -> Result<Verdict> {
        let best = state.colony.best_values();
        let best = best.context("the search has not begun")?;
        let default = self.default_config()?;
        let tuned = self.space.config(&best);
        let tuned = tuned.context("no candidate was a valid configuration")?;
        let configs = [("default", default.clone()), ("tuned", tuned.clone())];
        let check_seeds = self.n_seeds..self.n_seeds + self.n_check_seeds;
        let runs = run_all(&configs, &self.held_back, &check_seeds, self.n_jobs);
        let pairs = self.pairs(&runs);
        let picture = convergence::picture(state).to_svg();
        let rows: Vec<&TunedRun> = runs.iter().flatten().flatten().collect();
        let json = |config: &PlannerConfig| serde_json::to_string_pretty(config);
        Ok(Verdict {
            report: self.report(state, &best, &pairs, picture.clone()),
            convergence_svg: picture,
            runs_csv: csv(&rows)?,
            cycles_csv: csv(state.colony.history())?,
            document: self.space.document(&best),
            facts: self.facts(),
            configs: vec![
                Fact::new("default", json(&default)?),
                Fact::new("tuned", json(&tuned)?),
            ],
            config: tuned,
        })
    }

    fn pairs<'a>(&'a self, runs: &'a [Vec<Vec<TunedRun>>]) -> Vec<Pairs<'a>> {
        let [default, tuned] = [&runs[0], &runs[1]];
        let scenarios = self.held_back.iter().zip(default).zip(tuned);
        scenarios
            .map(|((asked, default), tuned)| Pairs {
                asked,
                runs: default.iter().zip(tuned).map(|(a, b)| [a, b]).collect(),
            })
            .collect()
    }

    fn facts(&self) -> Vec<Fact> {
        let grounds = |all: &[Asked]| all.iter().map(|asked| asked.ground.clone()).collect();
        let (on, back): (Vec<_>, Vec<_>) = (grounds(&self.scenarios), grounds(&self.held_back));
        let mut facts = facts_of(&on);
        facts.extend(facts_of(&back).into_iter().map(|fact| Fact {
            name: format!("{}, held back", fact.name),
            ..fact
        }));
        let (first, last) = (self.n_seeds, self.n_seeds + self.n_check_seeds - 1);
        facts.push(Fact::new("Seeds tuned on", seeds(self.n_seeds)));
        facts.push(Fact::new("Seeds held back", format!("{first} to {last}")));
        facts.push(Fact::new("Seed of the search", self.seed.0.to_string()));
        facts
    }

    fn report(&self, state: &TuningState, best: &[f64], pairs: &[Pairs], svg: String) -> Report {
        let search = vec![
            Block::Text(self.describe_search(state)),
            Block::Figure(Figure {
                caption: "The objective on the scenarios tuned on: the least so far, and that of \
                          the middle food source after each cycle."
                    .to_owned(),
                svg,
            }),
            Block::Table(gains(state)),
        ];
        let held_back = if pairs.is_empty() {
            let words = "Nothing was held back, so nothing is known of other scenarios.";
            Section::new("Held back", vec![Block::Text(words.to_owned())])
        } else {
            let (table, words) = summary(pairs);
            let tables = [table, scenarios(pairs)].map(Block::Table);
            let blocks = [Block::Text(words)].into_iter().chain(tables).collect();
            Section::new("Held back: default against tuned", blocks)
        };
        Report {
            name: "tuning".to_owned(),
            title: format!("Tuning of {}", self.planner_name()),
            intro: self.intro(),
            sections: vec![
                Section::of_table("What was found", self.parameters(best)),
                Section::new("The search", search),
                held_back,
            ],
        }
    }

    fn planner_name(&self) -> String {
        let planner = self.space.document(&[]).get("planner").cloned();
        planner
            .and_then(|name| name.as_str().map(str::to_owned))
            .unwrap_or_default()
    }

    fn intro(&self) -> String {
        format!(
            "An artificial bee colony tuned {} on {} with {} each, and the best that it found was \
             compared with the default on {} held back, with {} each. Costs are those of the usual \
             weights (`DriveCost::default`), meters; steps are those to the first certified path. \
             Nothing here depends on time.",
            counted(self.space.space.dimensions().len(), "parameter"),
            counted(self.scenarios.len(), "scenario"),
            counted(self.n_seeds, "seed"),
            counted(self.held_back.len(), "scenario"),
            counted(self.n_check_seeds, "other seed")
        )
    }

    fn parameters(&self, best: &[f64]) -> Table {
        let own = self.space.own_values().unwrap_or_default();
        let mut table = Table::new("parameters", &["parameter", "default", "tuned"]);
        let (own, best) = (self.space.parameters(&own), self.space.parameters(best));
        for ((key, own), (_, best)) in own.into_iter().zip(best) {
            let words = |value: &Value| Field::Words(written(value));
            table.row(vec![
                Field::Words(format!("`{key}`")),
                words(&own),
                words(&best),
            ]);
        }
        table
    }

    fn describe_search(&self, state: &TuningState) -> String {
        let colony = &state.colony;
        let least = colony.best().map_or(f64::NAN, |best| best.cost);
        let n_scouts = colony.history().iter().filter(|c| c.scouted).count();
        format!(
            "{} in {} of {} food sources. Sources abandoned: {}; candidates that were no valid \
             configuration: {}. The default counts 1 where it always finds a \
             path of the same cost; the best candidate counts {least:.4} on the scenarios tuned \
             on. A run without a path counts {}.{}",
            counted(colony.n_evaluations(), "evaluation"),
            counted(colony.history().len(), "cycle"),
            self.bees.n_sources,
            n_scouts,
            state.n_invalid,
            Objective::FAILURE,
            self.never_solved(state)
        )
    }

    /// A sentence on the scenarios tuned on of which nothing can be learned.
    fn never_solved(&self, state: &TuningState) -> String {
        let pairs = self.scenarios.iter().zip(&state.solved);
        let never = pairs.filter(|(_, solved)| !**solved);
        let names: Vec<&str> = never.map(|(asked, _)| asked.ground.map.as_str()).collect();
        match names[..] {
            [] => String::new(),
            _ => format!(
                " Neither the default nor any candidate ever found a path on {}: nothing was tuned \
                 there.",
                names.join(", ")
            ),
        }
    }
}

/// A value as it stands in a table: numbers with four significant digits.
fn written(value: &Value) -> String {
    match (value.as_u64(), value.as_f64()) {
        (None, Some(number)) if number != 0.0 => {
            let digits = (3 - number.abs().log10().floor() as i32).clamp(0, 9) as usize;
            format!("{number:.digits$}")
        }
        _ => value.to_string().trim_matches('"').to_owned(),
    }
}

fn gains(state: &TuningState) -> Table {
    let columns: [Column<(SearchRule, u64)>; 2] = [
        ("search rule", &|(rule, _)| Field::words(rule.name())),
        ("gains", &|(_, n)| Field::Number(Some(*n as f64), 0)),
    ];
    Table::of("rules", state.colony.gains(), &columns)
        .captioned("How often a candidate of each rule was better than its source.")
}

impl Pairs<'_> {
    fn n_found(&self, which: usize) -> usize {
        let found = self.runs.iter().filter(|pair| pair[which].cost_m.is_some());
        found.count()
    }

    fn median(&self, which: usize, of: fn(&TunedRun) -> Option<f64>) -> Option<f64> {
        let values: Vec<f64> = self
            .runs
            .iter()
            .filter_map(|pair| of(pair[which]))
            .collect();
        quantile(&values, 0.5)
    }

    /// Mean logarithm of tuned over default, over the seeds with which both found a path.
    fn log_ratio(&self, of: fn(&TunedRun) -> Option<f64>) -> Option<f64> {
        let both = self.runs.iter();
        let both = both.filter_map(|[a, b]| Some((of(b)? / of(a)?).ln()));
        let logs: Vec<f64> = both.collect();
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        (!logs.is_empty()).then_some(mean)
    }

    /// Runs that found a path, tuned less default, as a share.
    fn more_found(&self) -> f64 {
        let [default, tuned] = [0, 1].map(|which| self.n_found(which) as f64);
        (tuned - default) / self.runs.len() as f64
    }
}

const COST: fn(&TunedRun) -> Option<f64> = |run| run.cost_m;
const STEPS: fn(&TunedRun) -> Option<f64> = |run| run.first_steps.map(|n| 1.0 + n as f64);

/// Both quantities with their paired tests, and the same in words.
fn summary(pairs: &[Pairs]) -> (Table, String) {
    let n: usize = pairs.iter().map(|pairs| pairs.runs.len()).sum();
    let n_found = [0, 1].map(|which| pairs.iter().map(|p| p.n_found(which)).sum::<usize>());
    let logs = |of| -> Vec<f64> { pairs.iter().filter_map(|p| p.log_ratio(of)).collect() };
    let rows = [
        (
            "runs that found a path",
            pairs.iter().map(Pairs::more_found).collect(),
        ),
        ("cost of the path", logs(COST)),
        ("steps to the first path", logs(STEPS)),
    ];
    let p: Vec<Option<f64>> = rows.iter().map(|(_, d)| Some(wilcoxon(d)?.p)).collect();
    let known: Vec<f64> = p.iter().flatten().copied().collect();
    let mut adjusted = holm(&known).into_iter();
    let mut table = Table::new(
        "heldback",
        &["quantity", "default", "tuned", "tuned / default", "better", "worse", "p", "p (Holm)"],
    )
    .captioned(
        "Ratios are geometric means over scenarios, of runs with the same seed that both found a \
         path. Better and worse count scenarios; p is that of the signed-rank test of Wilcoxon over \
         scenarios, two-sided (exact up to 50 differences of different sizes, normal \
         approximation beyond).",
    );
    let mut words = Vec::new();
    for (i, ((name, differences), p)) in rows.iter().zip(&p).enumerate() {
        // More found is better, less cost and fewer steps are.
        let sign = if i == 0 { -1.0 } else { 1.0 };
        let count = |is: fn(f64) -> bool| differences.iter().filter(|d| is(sign * **d)).count();
        let (n_better, n_worse) = (count(|d| d < 0.0), count(|d| d > 0.0));
        let mean = differences.iter().sum::<f64>() / differences.len() as f64;
        let ratio = (i > 0 && !differences.is_empty()).then(|| mean.exp());
        let holm_p = p.and_then(|_| adjusted.next());
        let of = |which: usize| match i {
            0 => Field::Count(n_found[which], n),
            _ => Field::Words("1".to_owned()),
        };
        let tuned = if i == 0 {
            of(1)
        } else {
            Field::Number(ratio, 4)
        };
        table.row(vec![
            Field::words(name),
            of(0),
            tuned,
            Field::Number(ratio, 4),
            Field::Count(n_better, differences.len()),
            Field::Count(n_worse, differences.len()),
            Field::Number(*p, 4),
            Field::Number(holm_p, 4),
        ]);
        words.push(verdict(name, [n_better, n_worse], holm_p));
    }
    (table, words.join(" "))
}

/// A sentence on a quantity.
fn verdict(name: &str, [n_better, n_worse]: [usize; 2], holm_p: Option<f64>) -> String {
    let side = match n_better.cmp(&n_worse) {
        std::cmp::Ordering::Greater => "better",
        std::cmp::Ordering::Equal => "neither better nor worse",
        std::cmp::Ordering::Less => "worse",
    };
    match holm_p {
        None => format!("In {name} nothing differs."),
        Some(p) if p < 0.05 => {
            format!(
                "In {name} the tuned configuration is {side} ({}).",
                after_holm(p, 4)
            )
        }
        Some(p) => format!(
            "In {name} no difference is shown ({}): better on {n_better} scenarios, worse on \
             {n_worse}.",
            after_holm(p, 2)
        ),
    }
}

/// The probability that a sentence goes by, which is not that of the test alone.
fn after_holm(p: f64, digits: usize) -> String {
    format!("p = {p:.digits$} after Holm's adjustment")
}

fn scenarios(pairs: &[Pairs]) -> Table {
    let steps: fn(&TunedRun) -> Option<f64> = |run| run.first_steps.map(|n| n as f64);
    let found = |pairs: &Pairs, which| Field::Count(pairs.n_found(which), pairs.runs.len());
    let columns: [Column<&Pairs>; 7] = [
        ("scenario", &|pairs| Field::words(&pairs.asked.ground.map)),
        ("found: default", &|pairs| found(pairs, 0)),
        ("tuned", &|pairs| found(pairs, 1)),
        ("cost m: default", &|pairs| {
            Field::Number(pairs.median(0, COST), 2)
        }),
        ("tuned ", &|pairs| Field::Number(pairs.median(1, COST), 2)),
        ("steps: default", &|pairs| {
            Field::Number(pairs.median(0, steps), 0)
        }),
        ("tuned  ", &|pairs| Field::Number(pairs.median(1, steps), 0)),
    ];
    let table = Table::of("scenarios", pairs, &columns);
    table.captioned("Medians over the seeds that found a path.")
}
