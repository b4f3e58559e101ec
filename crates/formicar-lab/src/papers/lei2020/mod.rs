//! Lei & Zheng 2020: the effect of each part of the method, on three maps.

mod claims;
mod figures;
mod tables;
mod variants;

use crate::papers::correspondence;
use crate::papers::experiment::{Ground, Setup, Variant};
use crate::papers::parameters;
use crate::papers::reproduction::Reproduction;
use crate::papers::trials::{Runs, run_all};
use crate::report::{Block, BoxPlot, Report, Section};
use anyhow::Result;
use formicar::planner::PlannerName;
use variants::{IMPROVED, MAPS, variants};

/// Runs conventional, elitist and improved colonies, and the improved one less each of its parts.
///
/// # Errors
/// No error is expected: maps and configurations are built in.
pub fn lei2020(setup: &Setup, report_progress: &mut dyn FnMut(&str)) -> Result<Reproduction> {
    let grounds = MAPS.map(|map| Ground::builtin(map.name));
    let grounds = grounds.into_iter().collect::<Result<Vec<_>>>()?;
    let runs = run_all(&grounds, variants, setup, report_progress)?;
    report_progress("figures");
    let report = report(&grounds, Runs(&runs))?;
    Reproduction::of_runs(report, &runs, &grounds, variants, setup)
}

fn report(grounds: &[Ground], runs: Runs) -> Result<Report> {
    let claims = claims::claims(runs);
    let mut sections = vec![
        claims.verdicts(),
        tables::table_1(runs),
        figures::layers(grounds)?,
        figures::pheromone(grounds)?,
        figures::nodes(grounds, runs)?,
    ];
    for (map, ground) in MAPS.iter().zip(grounds) {
        sections.push(figures::paths(map, ground)?);
    }
    sections.push(figures::convergence(runs));
    for map in MAPS {
        sections.push(of_map(map.name, runs));
    }
    sections.push(claims.tests());
    sections.push(parameters::section(&Variant::of(PlannerName::Lei2020))?);
    sections.push(correspondence::section(PLACES));
    Ok(Report {
        name: "lei2020".to_owned(),
        title: "Lei & Zheng 2020: what each part brings".to_owned(),
        intro: "Lengths of the ants' way in cells; medians with quartiles. `optimum` is the \
                shortest way under the same layers and moves. `certified` counts smoothed paths, \
                free headings, with a certificate of the whole swept body. `to best` is the \
                iteration that found the best way. The paper's maps exist only as pictures: ours \
                have the same sizes and U-shapes, so that ratios compare and lengths do not. The \
                paper's times are those of MATLAB on an i5-4210M."
            .to_owned(),
        sections,
    })
}

/// Each part off, on one map.
fn of_map(map: &str, runs: Runs) -> Section {
    let caption = format!(
        "`{map}`: length of the best way of each run by variant. Boxes reach from quartile to \
         quartile, whiskers to the farthest value within 1.5 box lengths, dots are runs."
    );
    let improved = runs.group(map, IMPROVED);
    let optimum = improved.median(|trial| trial.optimum_cells);
    let lengths = BoxPlot {
        reference: optimum.map(|optimum| (optimum, "optimum of lei2020's map".to_owned())),
        ..runs.boxes_of_lengths(map, &caption)
    };
    let blocks = vec![
        Block::Table(tables::ablation(map, runs)),
        Block::BoxPlot(lengths),
    ];
    Section::new(format!("Each part off: {map}"), blocks)
}

const PLACES: &str = include_str!("figures.txt");
