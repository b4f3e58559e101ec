//! What an experiment hands over: rows, a report, and how they came about.

use crate::experiment::{Ground, Scale, Variant};
use crate::report::{Fact, Page, Report, latex, markdown, page};
use crate::trial::Trial;
use anyhow::Result;
use formicar::collision::ObstacleMap;
use serde::Serialize;

/// All rows of an experiment, and what they come to.
#[derive(Clone, Debug)]
pub struct Reproduction {
    /// Tables and figures.
    pub report: Report,
    /// Every run, as CSV.
    pub csv: String,
    /// Number of runs.
    pub n_runs: usize,
    /// Maps, vehicles and seeds.
    pub facts: Vec<Fact>,
    /// Every configuration, as JSON.
    pub configs: Vec<Fact>,
}

impl Reproduction {
    /// Of runs of all variants on all grounds.
    pub(crate) fn of_trials(
        report: Report,
        trials: &[Trial],
        (grounds, variants): (&[Ground], impl Fn(&Ground) -> Vec<Variant>),
        scale: Scale,
    ) -> Result<Self> {
        let mut facts = facts_of(grounds);
        facts.push(Fact::new("Seeds", seeds(scale.n_seeds)));
        let all: Vec<_> = grounds
            .iter()
            .map(|ground| (ground, variants(ground)))
            .collect();
        let pairs = all.iter().flat_map(|(ground, variants)| {
            let ground: &Ground = ground;
            variants.iter().map(move |variant| (ground, variant))
        });
        Ok(Self {
            report,
            csv: csv(trials)?,
            n_runs: trials.len(),
            facts,
            configs: configs_of(pairs)?,
        })
    }

    /// The files of its folder: names and contents. `machine` tells version, machine and command.
    pub fn files(&self, machine: &[Fact]) -> Vec<(&'static str, String)> {
        let facts = [machine, &self.facts].concat();
        let whole = Page {
            report: &self.report,
            facts: &facts,
            configs: &self.configs,
        };
        vec![
            ("index.html", page(&whole)),
            ("results.csv", self.csv.clone()),
            ("tables.tex", latex(&self.report)),
            ("summary.md", markdown(&self.report)),
        ]
    }
}

/// Rows as CSV.
pub(crate) fn csv(rows: &[impl Serialize]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Maps with their hashes, vehicles and ends.
pub(crate) fn facts_of(grounds: &[Ground]) -> Vec<Fact> {
    let fact = |ground: &Ground| {
        let (frame, request) = (ground.grid.frame(), &ground.request);
        let hash = ObstacleMap::new(&ground.grid).hash();
        let ends = [request.start, request.goal]
            .map(|pose| format!("({:.3}, {:.3}, {:.4})", pose.x, pose.y, pose.heading));
        Fact::new(
            &format!("Map `{}`", ground.map),
            format!(
                "{} x {} cells of {} m, hash `{hash:032x}`, vehicle hash `{:032x}`, from {} to {}",
                frame.n_cols(),
                frame.n_rows(),
                frame.resolution_m(),
                ground.vehicle.hash(),
                ends[0],
                ends[1]
            ),
        )
    };
    grounds.iter().map(fact).collect()
}

/// The configurations that variants have on grounds, each once.
pub(crate) fn configs_of<'a>(
    variants: impl IntoIterator<Item = (&'a Ground, &'a Variant)>,
) -> Result<Vec<Fact>> {
    let mut configs: Vec<Fact> = Vec::new();
    for (ground, variant) in variants {
        let json = serde_json::to_string_pretty(&variant.config)?;
        let known = |config: &Fact| config.value == json && config.name.starts_with(&variant.name);
        if configs.iter().any(known) {
            continue;
        }
        let is_taken = configs.iter().any(|config| config.name == variant.name);
        let name = if is_taken {
            format!("{} ({})", variant.name, ground.map)
        } else {
            variant.name.clone()
        };
        configs.push(Fact::new(&name, json));
    }
    Ok(configs)
}

/// Seeds from 0 on, in words.
pub(crate) fn seeds(n_seeds: u64) -> String {
    match n_seeds {
        0 | 1 => "0".to_owned(),
        n => format!("0 to {}", n - 1),
    }
}
