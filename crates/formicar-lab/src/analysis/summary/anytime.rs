//! Cost over time: how good the best path of a planner is, however long it has been given.

use crate::analysis::compare::{planners, runs_of};
use crate::analysis::statistics::{median, quantile_or_forever};
use crate::report::{Block, Field, Section, Table, Trend, TrendPanel, Trends};
use crate::run::{Improvement, Run};
use formicar::render::AxisScale;
use std::collections::{BTreeMap, BTreeSet};

/// Times at which the tables look, milliseconds.
const LOOKS_MS: [f64; 7] = [3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, f64::INFINITY];
/// Places along the time axis at which curves are drawn.
const N_PLACES: usize = 160;

type Place<'a> = [&'a str; 3];

/// Costs over the least of its scenario, falling with time: `[ms, ratio]`.
type Steps = Vec<[f64; 2]>;

/// A planner's courses by scenario, one for each seed.
struct Courses<'a> {
    name: String,
    by_place: BTreeMap<Place<'a>, Vec<Steps>>,
}

/// Curves and tables; nothing where no history holds costs.
pub(super) fn anytime(runs: &[Run]) -> Option<Section> {
    let least = least(runs);
    let courses = courses(runs, &least);
    if courses.is_empty() {
        return None;
    }
    let tables = [("median", 0.5), ("p90", 0.9), ("largest", 1.0)];
    let tables = tables.map(|(word, p)| table(word, p, &courses));
    let mut blocks = vec![Block::Trends(curves(&courses, least.len()))];
    blocks.extend(tables.map(Block::Table));
    Some(Section::new("Cost over time", blocks))
}

/// The least cost of any valid path, by scenario.
fn least(runs: &[Run]) -> BTreeMap<Place<'_>, f64> {
    let mut least: BTreeMap<Place, f64> = BTreeMap::new();
    for run in runs {
        let history = run.history.improvements.iter().chain(&run.history.cold);
        let of_history = history.filter_map(|improvement| improvement.cost_m);
        let last = run.record.cost_m.filter(|_| run.record.is_solved());
        for cost_m in of_history.chain(last) {
            let entry = least.entry(run.place()).or_insert(cost_m);
            *entry = entry.min(cost_m);
        }
    }
    least
}

/// The courses of all planners, and those of planners that were asked for the first time.
fn courses<'a>(runs: &'a [Run], least: &BTreeMap<Place<'a>, f64>) -> Vec<Courses<'a>> {
    type Of = fn(&Run) -> &[Improvement];
    let queries: [(&str, Of); 2] = [
        (", cold", |run| &run.history.cold),
        ("", |run| &run.history.improvements),
    ];
    let mut all = Vec::new();
    for planner in planners(runs) {
        for (suffix, of) in queries {
            let mut by_place: BTreeMap<Place, Vec<Steps>> = BTreeMap::new();
            for run in runs_of(runs, planner) {
                if let Some(least_m) = least.get(&run.place()) {
                    let steps = steps(of(run), *least_m);
                    by_place.entry(run.place()).or_default().push(steps);
                }
            }
            if by_place.values().flatten().any(|steps| !steps.is_empty()) {
                let name = format!("{planner}{suffix}");
                all.push(Courses { name, by_place });
            }
        }
    }
    all
}

/// The paths that were better than all before, by processor time where it is told.
fn steps(improvements: &[Improvement], least_m: f64) -> Steps {
    let mut steps = Steps::new();
    for improvement in improvements {
        let Some(cost_m) = improvement.cost_m else {
            continue;
        };
        let at_ms = 1e3 * improvement.cpu_s.unwrap_or(improvement.at_s);
        if steps
            .last()
            .is_none_or(|[_, best]| cost_m / least_m < *best)
        {
            steps.push([at_ms, cost_m / least_m]);
        }
    }
    steps
}

impl Courses<'_> {
    /// A quantile over the scenarios of the medians over their seeds, after a time; forever
    /// without a path by then.
    fn at(&self, ms: f64, p: f64) -> f64 {
        let value = |steps: &Steps| {
            let n_before = steps.partition_point(|[at_ms, _]| *at_ms <= ms);
            n_before
                .checked_sub(1)
                .map_or(f64::INFINITY, |i| steps[i][1])
        };
        let of_place = |seeds: &Vec<Steps>| median(&seeds.iter().map(value).collect::<Vec<_>>());
        let medians: Vec<f64> = self.by_place.values().filter_map(of_place).collect();
        quantile_or_forever(&medians, p).unwrap_or(f64::INFINITY)
    }

    fn times_ms(&self) -> impl Iterator<Item = f64> {
        self.by_place
            .values()
            .flatten()
            .flatten()
            .map(|[ms, _]| *ms)
    }

    fn curve(&self, p: f64) -> Trend {
        let [first, last] = ends(self.times_ms());
        let at = |i: usize| first * (last / first).powf(i as f64 / N_PLACES as f64);
        let point = |ms: f64| [ms, self.at(ms, p), self.at(ms, p), self.at(ms, p)];
        let places = (0..N_PLACES).map(at).chain([last]);
        Trend {
            name: self.name.clone(),
            points: places
                .map(point)
                .filter(|point| point[1].is_finite())
                .collect(),
        }
    }
}

/// The first and the last of some times, none of them 0.
fn ends(times_ms: impl Iterator<Item = f64>) -> [f64; 2] {
    times_ms.fold([f64::INFINITY, f64::MIN_POSITIVE], |[first, last], ms| {
        let ms = ms.max(f64::MIN_POSITIVE);
        [first.min(ms), last.max(ms)]
    })
}

fn curves(courses: &[Courses], n_scenarios: usize) -> Trends {
    let panel = |word: &str, p: f64| TrendPanel {
        x: format!("ms, {word} over scenarios"),
        x_scale: AxisScale::Log,
        trends: courses.iter().map(|courses| courses.curve(p)).collect(),
    };
    Trends {
        caption: format!(
            "Cost of the best valid path by then, over the least that any run knows of the \
             scenario: the median over seeds, then median and p90 over the {n_scenarios} scenarios \
             that some run solves, of which one without a path counts as dearer than all others; a \
             curve begins where enough have a path. Processor time where it is told, from the \
             beginning of the query; cold: of a planner that has just been made."
        ),
        quantity: "cost over the least of its scenario".to_owned(),
        y_scale: AxisScale::Log,
        panels: vec![panel("median", 0.5), panel("p90", 0.9)],
    }
}

fn table(word: &str, p: f64, courses: &[Courses]) -> Table {
    let all: BTreeSet<usize> = courses
        .iter()
        .map(|courses| courses.by_place.len())
        .collect();
    let of_scenarios: Vec<String> = all.iter().map(usize::to_string).collect();
    let name = |ms: f64| match ms {
        ms if ms.is_infinite() => "in the end".to_owned(),
        ms if ms >= 1000.0 => format!("{} s", ms / 1e3),
        ms => format!("{ms} ms"),
    };
    let names = LOOKS_MS.map(name);
    let mut heading = vec!["planner"];
    heading.extend(names.iter().map(String::as_str));
    let mut table = Table::new(&format!("anytime {word}"), &heading).captioned(&format!(
        "The {word} over {} scenarios; a dash where too few have a path.",
        of_scenarios.join(" or ")
    ));
    for courses in courses {
        let value = |ms: f64| Some(courses.at(ms, p)).filter(|cost| cost.is_finite());
        let values = LOOKS_MS.map(|ms| Field::Number(value(ms), 4));
        table.row(
            [Field::words(&courses.name)]
                .into_iter()
                .chain(values)
                .collect(),
        );
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn run(planner: &str, scenario: &str, seed: u64, course: &[[f64; 2]]) -> Run {
        let mut run = Run::default();
        let row =
            json!({"scenario": scenario, "planner": planner, "seed": seed, "status": "found"});
        run.record.fill(&row).unwrap();
        let improvement = |&[ms, cost_m]: &[f64; 2]| Improvement {
            at_s: 9.0,
            cpu_s: Some(ms / 1e3),
            cost_m: Some(cost_m),
            ..Improvement::default()
        };
        run.history.improvements = course.iter().map(improvement).collect();
        run
    }

    fn row(section: &Section, table: usize, name: &str) -> Vec<String> {
        let Block::Table(table) = &section.blocks[1 + table] else {
            panic!("{section:?}");
        };
        let row = table.rows.iter().find(|row| row[0].text() == name).unwrap();
        row.iter().skip(1).map(Field::text).collect()
    }

    #[test]
    fn costs_are_those_known_by_then_over_the_least_of_the_scenario() {
        let runs = [
            run("a", "s", 0, &[[2.0, 20.0], [50.0, 10.0]]),
            run("a", "t", 0, &[[20.0, 40.0]]),
            run("b", "s", 0, &[[2.0, 30.0], [4.0, 60.0]]),
            run("b", "t", 0, &[[200.0, 20.0]]),
        ];
        let section = anytime(&runs).unwrap();
        // On s 2 times the least, on t nothing yet; then 2 and 2; then 1 and 2.
        let a = ["-", "-", "2.0000", "1.5000", "1.5000", "1.5000", "1.5000"];
        assert_eq!(row(&section, 0, "a"), a);
        // A dearer path later changes nothing.
        let b = ["-", "-", "-", "-", "2.0000", "2.0000", "2.0000"];
        assert_eq!(row(&section, 0, "b"), b);
        assert_eq!(row(&section, 1, "b")[4], "2.8000");
    }

    #[test]
    fn seeds_are_halved_and_cold_queries_have_a_curve_of_their_own() {
        let mut runs = vec![
            run("a", "s", 0, &[[1.0, 10.0]]),
            run("a", "s", 1, &[[1.0, 12.0]]),
            run("a", "s", 2, &[]),
        ];
        runs[0].history.cold = vec![Improvement {
            at_s: 0.008,
            cost_m: Some(11.0),
            ..Improvement::default()
        }];
        let section = anytime(&runs).unwrap();
        assert_eq!(row(&section, 0, "a")[0], "1.2000");
        // Two of three runs have no cold path.
        assert_eq!(row(&section, 0, "a, cold")[6], "-");
        let Block::Trends(curves) = &section.blocks[0] else {
            panic!("{section:?}");
        };
        let [median, p90] = &curves.panels[..] else {
            panic!("{curves:?}");
        };
        assert_eq!(median.trends.len(), 2);
        assert_eq!(p90.trends[1].points.first().unwrap()[1], 1.2);
        assert!(!curves.to_svg().contains("NaN"));
    }

    #[test]
    fn no_costs_no_section() {
        assert_eq!(anytime(&[run("a", "s", 0, &[])]), None);
    }
}
