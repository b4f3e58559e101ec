//! Growth of cost with the cells of a map, the density of obstacles, the size of the vehicle, the
//! ants and the threads: on logarithmic axes, with fitted exponents.

mod axes;
mod fit;
mod sample;

use crate::analysis::statistics::distinct;
use crate::analysis::statistics::quartiles;
use crate::papers::experiment::{Ground, Setup, Variant};

use crate::papers::reproduction::{Reproduction, configs_of, csv, facts_of, seeds};
use crate::report::{Block, Fact, Field, Report, Section, Table, Trend, TrendPanel, Trends};
use anyhow::Result;
use axes::Quantity;
use fit::PowerLaw;
use formicar::geometry::Point2;
use formicar::render::AxisScale;
use sample::Sample;

/// Seeds of each query: times differ little between seeds.
const N_SEEDS: u64 = 3;

/// A measure of a query: its name with the unit, and its value.
type Cost = (&'static str, fn(&Sample) -> f64);

const COSTS: [Cost; 3] = [
    ("set-up, ms", |sample| sample.setup_ms),
    ("query, ms", |sample| sample.query_ms),
    ("search steps", |sample| sample.steps as f64),
];

/// Runs the experiment, and tells before each planner.
///
/// # Errors
/// Grounds that cannot be made.
pub fn scaling(setup: &Setup, report_progress: &mut dyn FnMut(&str)) -> Result<Reproduction> {
    let n_seeds = setup.scale.n_seeds.min(N_SEEDS);
    let mut samples = Vec::new();
    let mut used: Vec<(Ground, Vec<Variant>)> = Vec::new();
    for quantity in Quantity::ALL {
        for point in quantity.points(setup.scale)? {
            for variant in &point.variants {
                report_progress(&format!(
                    "{} {}: {}",
                    quantity.name(),
                    point.x,
                    variant.name
                ));
                for seed in 0..n_seeds {
                    let sample = Sample::run(quantity, &point, variant, seed, setup.scale)?;
                    samples.push(sample);
                }
            }
            used.push((point.ground, point.variants));
        }
    }
    let sections = Quantity::ALL.map(|quantity| section(quantity, &samples));
    let mut grounds: Vec<Ground> = used.iter().map(|(ground, _)| ground.clone()).collect();
    grounds.sort_by(|a, b| a.map.cmp(&b.map));
    grounds.dedup_by(|a, b| a.map == b.map);
    let mut facts = facts_of(&grounds);
    facts.push(Fact::new("Seeds", seeds(n_seeds)));
    let pairs = used
        .iter()
        .flat_map(|(ground, variants)| variants.iter().map(move |v| (ground, v)));
    Ok(Reproduction {
        report: Report {
            name: "scaling".to_owned(),
            title: "How cost grows".to_owned(),
            intro: INTRO.to_owned(),
            sections: sections.into(),
        },
        csv: csv(&samples)?,
        n_runs: samples.len(),
        facts,
        configs: configs_of(pairs)?,
        ..Reproduction::default()
    })
}

const INTRO: &str = "Square fields of scattered obstacles, cells of 0.2 m, the vehicle of Lei & \
    Zheng 2020; one quantity grows at a time, from 400 x 400 cells, density 0.02 and one thread. \
    Both ends are the farthest apart of eight random pairs. Queries are those of a warm planner, \
    the whole of them: `formicar` goes on improving after its first path. Exponents are fitted by \
    least squares on the logarithms of the medians of solved runs, over three points or more.";

/// A table of fits and a picture of each cost, for a quantity.
fn section(quantity: Quantity, samples: &[Sample]) -> Section {
    let of_it = samples.iter().filter(|s| s.quantity == quantity.name());
    let of_it: Vec<&Sample> = of_it.collect();
    let planners = distinct(of_it.iter().map(|sample| sample.planner.as_str()));
    let mut blocks = vec![Block::Table(table(quantity, &of_it, &planners))];
    for cost in &COSTS {
        blocks.push(Block::Trends(plot(quantity, cost, &of_it, &planners)));
    }
    Section::new(format!("Over {}", quantity.about()), blocks)
}

fn table(quantity: Quantity, samples: &[&Sample], planners: &[&str]) -> Table {
    let caption = format!(
        "Exponents over {}, with the share of the variance that they explain; medians at the \
         largest value that was solved.",
        quantity.about()
    );
    let heading = [
        "planner",
        "solved",
        "setup exponent",
        "R2 setup",
        "query exponent",
        "R2 query",
        "steps exponent",
        "R2 steps",
        "largest",
        "query ms there",
    ];
    let mut table = Table::new(quantity.name(), &heading).captioned(&caption);
    for planner in planners {
        let of_planner = samples.iter().filter(|s| s.planner == *planner);
        let n_solved = of_planner.clone().filter(|s| s.is_solved).count();
        let mut row = vec![
            Field::words(planner),
            Field::Count(n_solved, of_planner.count()),
        ];
        for (_, cost) in &COSTS {
            let law = PowerLaw::through(&medians(&spreads(samples, planner, *cost)));
            row.push(Field::Number(law.map(|law| law.exponent), 2));
            row.push(Field::Number(law.map(|law| law.r_squared), 3));
        }
        let last = medians(&spreads(samples, planner, |sample| sample.query_ms)).pop();
        row.push(Field::Words(
            last.map_or("-".to_owned(), |p| format!("{}", p.x)),
        ));
        row.push(Field::Number(last.map(|p| p.y), 2));
        table.row(row);
    }
    table
}

/// Quartiles of a cost at each value, over solved runs: `[x, lower, median, upper]`.
fn spreads(samples: &[&Sample], planner: &str, cost: fn(&Sample) -> f64) -> Vec<[f64; 4]> {
    let is_it = |sample: &&&Sample| sample.planner == planner && sample.is_solved;
    let solved: Vec<&&Sample> = samples.iter().filter(is_it).collect();
    let at_x = solved.chunk_by(|a, b| a.x == b.x);
    let spread = |runs: &[&&Sample]| {
        let values: Vec<f64> = runs.iter().map(|sample| cost(sample)).collect();
        quartiles(&values).map(|[low, middle, high]| [runs[0].x, low, middle, high])
    };
    at_x.filter_map(spread).collect()
}

fn medians(spreads: &[[f64; 4]]) -> Vec<Point2> {
    let median = |&[x, _, middle, _]: &[f64; 4]| Point2::new(x, middle);
    spreads.iter().map(median).collect()
}

/// Medians and quartiles on logarithmic axes, each planner with its exponent.
fn plot(quantity: Quantity, cost: &Cost, samples: &[&Sample], planners: &[&str]) -> Trends {
    let (name, value) = *cost;
    let trend = |planner: &&str| {
        let points = spreads(samples, planner, value);
        let exponent = PowerLaw::through(&medians(&points));
        Trend {
            name: exponent.map_or((*planner).to_owned(), |law| {
                format!("{planner}: {:.2}", law.exponent)
            }),
            points,
        }
    };
    Trends {
        caption: format!(
            "Over {}: medians of solved runs and the band between their quartiles; beside each \
             planner the exponent of the power law through its medians.",
            quantity.about()
        ),
        quantity: name.to_owned(),
        y_scale: AxisScale::Log,
        panels: vec![TrendPanel {
            x: quantity.about().to_owned(),
            x_scale: AxisScale::Log,
            trends: planners.iter().map(trend).collect(),
        }],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::markdown;

    fn sample(x: f64, seed: u64, is_solved: bool) -> Sample {
        Sample {
            quantity: "cells",
            x,
            planner: "astar".to_owned(),
            seed,
            is_solved,
            setup_ms: x,
            query_ms: x * x + seed as f64 - 1.0,
            steps: x as u64,
        }
    }

    #[test]
    fn exponents_are_those_of_the_medians_of_solved_runs() {
        let mut samples: Vec<Sample> = [10.0, 100.0, 1000.0]
            .into_iter()
            .flat_map(|x| (0..3).map(move |seed| sample(x, seed, true)))
            .collect();
        samples.push(sample(1e6, 0, false));
        let report = Report {
            sections: vec![section(Quantity::Cells, &samples)],
            ..Report::default()
        };
        let text = markdown(&report);
        let row =
            "| astar | 9/10 | 1.00 | 1.000 | 2.00 | 1.000 | 1.00 | 1.000 | 1000 | 1000000.00 |";
        assert!(text.contains(row), "{text}");
        let Block::Trends(plot) = &report.sections[0].blocks[2] else {
            panic!("a plot of query times");
        };
        let trend = &plot.panels[0].trends[0];
        assert_eq!(trend.name, "astar: 2.00");
        assert_eq!(trend.points[0], [10.0, 99.5, 100.0, 100.5]);
    }
}
