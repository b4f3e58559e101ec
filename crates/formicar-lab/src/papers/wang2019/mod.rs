//! Wang et al. 2019: narrow aisles, convergence, and the cost of the adjacency.

mod adjacency;
mod claims;
mod steps;
mod variants;

use crate::papers::correspondence;
use crate::papers::drawn_run::{DrawnRun, Line, overlay};
use crate::papers::experiment::{Ground, Setup, Variant};
use crate::papers::group::{Group, GroupColumn, table_of};
use crate::papers::parameters;
use crate::papers::reproduction::Reproduction;
use crate::papers::trial::Trial;
use crate::papers::trials::{Runs, run_all};
use crate::report::{Block, Field, Report, Section, Table};
use anyhow::Result;
use formicar::planner::PlannerName;
use variants::{COLONIES, MAPS, PROPOSED, variants};

/// Runs the colony and those it is compared with, and times both calculations of the adjacency.
///
/// # Errors
/// No error is expected: maps and configurations are built in.
pub fn wang2019(setup: &Setup, report_progress: &mut dyn FnMut(&str)) -> Result<Reproduction> {
    let grounds = MAPS.map(|(map, _)| Ground::builtin(map));
    let grounds = grounds.into_iter().collect::<Result<Vec<_>>>()?;
    let runs = run_all(&grounds, |_| variants(), setup, report_progress)?;
    report_progress("adjacency timing");
    let timings = adjacency::time_all(setup.scale)?;
    let all = Runs(&runs);
    let claims = claims::claims(all, &timings);
    let mut sections = vec![claims.verdicts()];
    for ((map, figure), ground) in MAPS.iter().zip(&grounds) {
        sections.push(of_map(map, figure, ground, all)?);
    }
    sections.push(adjacency::section(&timings));
    sections.push(steps::section());
    sections.push(claims.tests());
    sections.push(parameters::section(&Variant::of(PlannerName::Wang2019))?);
    sections.push(correspondence::section(PLACES));
    let report = Report {
        name: "wang2019".to_owned(),
        title: "Wang et al. 2019: aisles, convergence, adjacency".to_owned(),
        intro: "Lengths in cells, a diagonal step counting the square root of 2; medians with \
                quartiles. `squeezes` are diagonal steps between two obstacles that meet at a \
                corner: runs with any. `to best` is the iteration that found the best way, `to 1 \
                %` the one that found a way at most 1 % dearer. `zhang2016` and `joshy2016` are the \
                paper's references 7 and 11. The paper's maps exist only as pictures: ours have the \
                same 20 x 20 cells, with narrow aisles, without, and the matrix that circulates in \
                code for this problem."
            .to_owned(),
        sections,
    };
    Reproduction::of_runs(report, &runs, &grounds, |_| variants(), setup)
}

/// Paths, convergence and numbers on one map.
fn of_map(map: &str, figure: &str, ground: &Ground, runs: Runs) -> Result<Section> {
    let plain = variants().into_iter();
    let plain = plain.filter(|variant| COLONIES.contains(&variant.name.as_str()));
    let mut drawn_runs = Vec::new();
    for variant in plain {
        drawn_runs.push(DrawnRun::new(ground, &variant)?);
    }
    drawn_runs.sort_by_key(|drawn| drawn.variant == PROPOSED);
    let caption = format!(
        "Figure {figure}(a) on `{map}`, seed 0: the ways of the three colonies from cell to cell."
    );
    let paths = overlay(ground, &drawn_runs, Line::Cells, &caption);
    let caption = format!(
        "Figure {figure}(b) on `{map}`: length of the best way so far, medians and quartiles over \
         the seeds, by iteration, by ants sent out and by time since the colony set out. A line \
         begins where three quarters of the runs have a way."
    );
    let convergence = runs.convergence(map, &COLONIES, &caption);
    let caption = format!("`{map}`: length of the best way of each run by variant.");
    let lengths = runs.boxes_of_lengths(map, &caption);
    let blocks = vec![
        Block::Table(table(map, runs)),
        Block::Figure(paths),
        Block::Trends(convergence),
        Block::BoxPlot(lengths),
    ];
    Ok(Section::new(format!("{map}: figure {figure}"), blocks))
}

fn table(map: &str, runs: Runs) -> Table {
    let n_squeezing = |g: &Group<Trial>| g.count(|t| t.n_squeezes.is_some_and(|n| n > 0)) as f64;
    let columns: [GroupColumn<Trial>; 7] = [
        ("arrived", &|g, _| {
            Field::Count(g.count(|trial| trial.arrived), g.len())
        }),
        ("squeezes", &|g, _| Field::Number(Some(n_squeezing(g)), 0)),
        ("length", &|g, _| g.spread(|trial| trial.length_cells, 1)),
        ("/ optimum", &|g, _| {
            g.number(|t| Some(t.length_cells? / t.optimum_cells?), 3)
        }),
        ("to best", &|g, _| {
            g.number(|trial| Some(f64::from(trial.n_to_best?)), 0)
        }),
        ("to 1 %", &|g, _| {
            g.number(|trial| Some(f64::from(trial.n_to_1_percent?)), 0)
        }),
        ("ms", &|g, _| g.number(|trial| Some(trial.query_ms), 1)),
    ];
    table_of(map, "variant", &columns, runs.groups(map))
}

const PLACES: &str = include_str!("figures.txt");
