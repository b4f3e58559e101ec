//! Li et al. 2024: FACO and its six rivals on a neighborhood of 800 x 500 cells.

mod ablation;
mod best;
mod claims;
mod drive;
mod figures;
mod generations;
mod grounds;
mod group;
mod methods;
mod native;
mod paper;
mod pictures;
mod scaling;
mod tables;
mod turns;

use crate::papers::correspondence;
use crate::papers::experiment::{Ground, Scale, Setup, Variant};
use crate::papers::parameters;
use crate::papers::reproduction::{Reproduction, at_a_time, configs_of, csv, facts_of, seeds};
use crate::report::{Block, Fact, Report, Section};
use crate::run::pool;
use anyhow::Result;
use drive::{Drawn, Drive, Job};
use formicar::planner::Outcome;
use generations::CostHistory;
use grounds::{hood, neighborhood, shortest_m};
use group::{ABLATION, COMPARISON, HOOD};
use methods::{Method, Native, methods};
use tables::{Comparison, over_scenarios};

/// Compares all methods on the built-in neighborhood and, where the data set is present, on its
/// ten scenarios; switches each term of FACO off; and lets its map grow.
///
/// # Errors
/// Files of the data set that cannot be read.
pub fn li2024(setup: &Setup, report_progress: &mut dyn FnMut(&str)) -> Result<Reproduction> {
    let plan = Plan {
        methods: methods(),
        ablation: ablation::variants(),
        ground: neighborhood()?,
        hood: hood(setup)?,
        scale: setup.scale,
        n_jobs: setup.n_jobs,
    };
    plan.run(report_progress)
}

/// The runs to be made.
struct Plan {
    methods: Vec<Method>,
    ablation: Vec<Variant>,
    ground: Ground,
    /// The scenarios of the data set, or the path of the missing file.
    hood: Result<Vec<Ground>, std::path::PathBuf>,
    scale: Scale,
    /// Runs at a time.
    n_jobs: usize,
}

/// The results of the runs.
#[derive(Default)]
struct Findings {
    drives: Vec<Drive>,
    drawn_runs: Vec<Drawn>,
    cost_histories: Vec<CostHistory>,
    /// Grounds of the scaling experiment.
    grown: Vec<Ground>,
}

impl Plan {
    fn run(&self, report_progress: &mut dyn FnMut(&str)) -> Result<Reproduction> {
        let mut findings = Findings::default();
        self.compare(&mut findings, report_progress)?;
        for ground in self.hood.iter().flatten() {
            for method in &self.methods {
                let variant = Variant::of(method.planner);
                let job = job(HOOD, ground, shortest_m(ground), &variant, method.native);
                report_progress(&format!("{}: {}", ground.map, variant.name));
                findings
                    .drives
                    .extend(self.runs(&job, self.scale.n_runs)?.0);
            }
        }
        self.switch_terms_off(&mut findings, report_progress)?;
        if let Some(method) = scaling::subject(&self.methods) {
            let (drives, grounds) = scaling::run(method, self.scale, report_progress)?;
            findings.drives.extend(drives);
            findings.grown = grounds;
        }
        self.conclude(&findings)
    }

    /// Runs of a job with the seeds from 0 on, and the outcome of the first.
    fn runs(&self, job: &Job, n_seeds: u64) -> Result<(Vec<Drive>, Option<Outcome>)> {
        let run = |seed: usize| -> Result<_> {
            let (drive, outcome) = job.run(seed as u64)?;
            Ok((drive, (seed == 0).then_some(outcome)))
        };
        let runs = pool::map(self.n_jobs, n_seeds as usize, run)?;
        let (drives, outcomes): (_, Vec<_>) = runs.into_iter().unzip();
        Ok((drives, outcomes.into_iter().flatten().next()))
    }

    /// All methods on the built-in neighborhood: timed, then watched by generation.
    fn compare(
        &self,
        findings: &mut Findings,
        report_progress: &mut dyn FnMut(&str),
    ) -> Result<()> {
        let (ground, shortest_m) = (&self.ground, shortest_m(&self.ground));
        for method in &self.methods {
            let variant = Variant::of(method.planner);
            let job = job(COMPARISON, ground, shortest_m, &variant, method.native);
            report_progress(&format!("{}: {}", self.ground.map, variant.name));
            let (drives, first) = self.runs(&job, self.scale.n_seeds)?;
            findings.drives.extend(drives);
            let Some(drawn) = first.map(|outcome| job.drawn(outcome)) else {
                continue;
            };
            report_progress(&format!(
                "{}: {}, by generation",
                self.ground.map, variant.name
            ));
            let history = generations::watch(job, method.generations, &drawn, self.scale.n_runs)?;
            findings.cost_histories.extend(history);
            findings.drawn_runs.push(drawn);
        }
        Ok(())
    }

    fn switch_terms_off(
        &self,
        findings: &mut Findings,
        report_progress: &mut dyn FnMut(&str),
    ) -> Result<()> {
        let (ground, shortest_m) = (&self.ground, shortest_m(&self.ground));
        for variant in &self.ablation {
            report_progress(&format!("{}: {}", self.ground.map, variant.name));
            let job = job(ABLATION, ground, shortest_m, variant, Native::Nodes);
            findings
                .drives
                .extend(self.runs(&job, self.scale.n_seeds)?.0);
        }
        Ok(())
    }

    fn conclude(&self, findings: &Findings) -> Result<Reproduction> {
        let hood = self.hood.as_deref().unwrap_or_default();
        let variants: Vec<Variant> = self
            .methods
            .iter()
            .map(|m| Variant::of(m.planner))
            .collect();
        let of_methods = variants.iter().chain(&self.ablation);
        Ok(Reproduction {
            report: self.report(findings)?,
            csv: csv(&findings.drives)?,
            n_runs: findings.drives.len(),
            facts: [
                facts_of(std::slice::from_ref(&self.ground)),
                facts_of(hood),
                facts_of(&findings.grown),
                self.seeds(),
            ]
            .concat(),
            configs: configs_of(of_methods.map(|variant| (&self.ground, variant)))?,
            ..Reproduction::default()
        })
    }

    fn seeds(&self) -> Vec<Fact> {
        let (n_runs, n_seeds) = (seeds(self.scale.n_runs), seeds(self.scale.n_seeds));
        let words = format!("{n_seeds}; costs by generation and the second neighborhood: {n_runs}");
        vec![Fact::new("Seeds", words), at_a_time(self.n_jobs)]
    }

    fn report(&self, findings: &Findings) -> Result<Report> {
        let comparison = Comparison {
            drives: &findings.drives,
            methods: &self.methods,
            ground: &self.ground.map,
        };
        let names: Vec<&str> = self.methods.iter().map(|m| m.planner.name()).collect();
        let claims = claims::claims(&findings.drives, &names, &self.ground.map);
        let mut sections = vec![
            claims.verdicts(),
            Section::new(
                "Length, success and time: Table 1",
                vec![
                    Block::Table(comparison.lengths()),
                    Block::Table(comparison.times()),
                    Block::Text(paper::remark()),
                ],
            ),
            Section::new(
                "Turns: Table 2",
                vec![
                    Block::Table(comparison.native_shares()),
                    Block::Table(comparison.curve_shares()),
                    Block::Table(comparison.smoothness()),
                ],
            ),
        ];
        sections.push(pictures::spreads(
            &findings.drives,
            &names,
            &self.ground.map,
        ));
        sections.extend(self.figures(findings));
        sections.extend(self.of_proposed(findings));
        sections.push(self.of_hood(findings));
        sections.push(claims.tests());
        if let Some(subject) = scaling::subject(&self.methods) {
            let own = Variant::of(subject.planner);
            sections.push(parameters::section(&own)?);
        }
        sections.push(correspondence::section(PLACES));
        Ok(Report {
            name: "li2024".to_owned(),
            title: "Li et al. 2024: FACO and its rivals".to_owned(),
            intro: self.intro(),
            sections,
        })
    }

    fn intro(&self) -> String {
        format!(
            "All methods drive the route of `{}`, {:.1} m over cells, with the 1 m wide `lei2020` \
             vehicle: start heading exact, goal heading any, {} runs per method. `certified` \
             counts runs whose path the judge certified for the whole swept body; everything else \
             counts as a failure. The paper's numbers are those of MATLAB on an i7-6500U, on a map \
             of its own, ten runs per method. `astar` and `improved-astar` do not use the seed.",
            self.ground.map,
            shortest_m(&self.ground).unwrap_or_default(),
            self.scale.n_seeds
        )
    }

    /// Sections on the proposed method alone; none if this build does not know it.
    fn of_proposed(&self, findings: &Findings) -> Vec<Section> {
        let Some(subject) = scaling::subject(&self.methods) else {
            return Vec::new();
        };
        let best = best::table(&findings.drives, &self.methods, &self.ground.map);
        let growth = scaling::table(&findings.drives, subject.planner.name());
        vec![
            Section::of_table("Beside the best of the others", best),
            ablation::section(&findings.drives, &self.ablation),
            Section::of_table("Growing maps", growth),
        ]
    }

    fn of_hood(&self, findings: &Findings) -> Section {
        let block = match &self.hood {
            Ok(_) => Block::Table(over_scenarios(&findings.drives, &self.methods, HOOD)),
            Err(path) => Block::Text(format!(
                "Left out: there is no `{}`. It comes with the data sets; `--data` names their \
                 folder.",
                path.display()
            )),
        };
        Section::new("A second neighborhood: hood_800x500", vec![block])
    }

    fn figures(&self, findings: &Findings) -> Vec<Section> {
        let part = figures::surroundings(&self.ground, &findings.drawn_runs);
        let paths = findings.drawn_runs.iter();
        let paths = paths.map(|drawn| figures::path_figure(&self.ground, drawn, part));
        let mut sections = vec![
            pictures::map(&self.ground, &findings.drawn_runs, part),
            Section::new("Paths: figures 5 to 11", paths.map(Block::Figure).collect()),
        ];
        let histories = &findings.cost_histories;
        if !histories.is_empty() {
            let plots = vec![
                Block::Trends(generations::means(histories)),
                Block::Trends(generations::lowest(histories)),
            ];
            sections.push(Section::new("Cost by generation: figure 12", plots));
        }
        sections
    }
}

fn job<'a>(
    part: &'static str,
    ground: &'a Ground,
    shortest_m: Option<f64>,
    variant: &'a Variant,
    native: Native,
) -> Job<'a> {
    Job {
        part,
        ground,
        variant,
        native,
        shortest_m,
    }
}

const PLACES: &str = include_str!("figures.txt");

#[cfg(test)]
mod tests;
