//! Pictures of what the rules of a colony do, each from the engine itself.
//!
//! `cargo run --release -p formicar --example 08_rules_of_a_colony`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::colony::deposit::{AllAnts, BestAnt, BestWorst, Deposit, Elitist, Fittest};
use formicar::colony::evaporation::{Adaptive, Constant, Evaporation, PoissonEvaporation};
use formicar::colony::initial::{InitialPheromone, LineGradient, PheromoneUnit};
use formicar::colony::limits::{Floor, MaxMin, PheromoneLimits};
use formicar::colony::transition::{GoalDirected, ObliqueFirst, Transition};
use formicar::colony::{ColonyConfig, ColonyProblem, ColonyRun, dead_end, presets, run};
use formicar::geometry::Point2;
use formicar::layers::obstacle_expansion;
use formicar::map::builtin::BuiltinMap;
use formicar::map::{
    BitGrid, Cell, DiagonalRule, FREE, GridFrame, MoveMasks, OccupancyGrid, STEPS,
};
use formicar::numeric::Seed;
use formicar::path::GridPath;
use formicar::progress::{Event, IterationRecord, Limits, Observer};
use formicar::render::{
    Axis, CellStyle, Chart, Color, Dash, LineStyle, Picture, SERIES_COLORS, Scene, Series, palette,
};
use formicar::search::{GoalField, STRAIGHT_COST};
use std::{error::Error, fs};

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    fs::create_dir_all("formicar-examples/rules")?;
    for (name, picture) in [
        ("heuristic", heuristic()?),
        ("initial-pheromone", initial_pheromone()?),
        ("transition", transition()?),
        ("dead-ends", dead_ends()?),
        ("evaporation", evaporation()),
        ("deposit", deposit()?),
        ("limits", limits()?),
    ] {
        println!("{name}: {}", picture.caption);
        let file = format!("formicar-examples/rules/{name}.svg");
        fs::write(file, picture.to_svg())?;
    }
    Ok(())
}

/// Distances to the goal, straight and along the shortest way, on two copies of a map, with what
/// comes of always going where they fall most.
fn heuristic() -> Outcome<Picture> {
    let (map, problem) = ground("lei-map1", 0)?;
    let (moves, goal) = (problem.moves(), problem.goal());
    let field = GoalField::new(moves, &[goal], &mut Limits::new(&mut (), None, None))?;
    let cells: Vec<Cell> = (0..map.frame().n_cells()).map(|i| moves.cell(i)).collect();
    let straight = |&cell: &Cell| {
        let (dx, dy) = (cell.col.abs_diff(goal.col), cell.row.abs_diff(goal.row));
        let is_open = moves.moves(cell) != 0;
        if is_open {
            f64::from(dx).hypot(f64::from(dy))
        } else {
            f64::NAN
        }
    };
    let straight: Vec<f64> = cells.iter().map(straight).collect();
    let around = |&cost: &u32| match cost {
        u32::MAX => f64::NAN,
        cost => f64::from(cost) / f64::from(STRAIGHT_COST),
    };
    let around: Vec<f64> = field.costs().iter().map(around).collect();

    let gap = 1;
    let twice = side_by_side(&map, gap)?;
    let n_cols = map.frame().n_cols();
    let rows = straight.chunks(n_cols).zip(around.chunks(n_cols));
    let values = rows.flat_map(|(left, right)| {
        let between = std::iter::repeat_n(f32::NAN, gap);
        left.iter()
            .map(|&d| d as f32)
            .chain(between)
            .chain(right.iter().map(|&s| s as f32))
    });
    let mut scene = Scene::new(&twice);
    scene.heat_map(&values.collect::<Vec<_>>(), "distance to the goal, cells");
    let ways = [descent(&problem, &straight), descent(&problem, &around)];
    let lengths = ways.each_ref().map(|way| way.cells.len() - 1);
    for (mut way, shift) in ways.into_iter().zip([0, n_cols + gap]) {
        way.cells
            .iter_mut()
            .for_each(|cell| cell.col += shift as u32);
        scene.grid_path(&way);
    }
    Ok(Picture {
        title: "Nearness to the goal, straight and along the shortest way".to_owned(),
        caption: format!(
            "Always to the least distance: straight (left) the way ends at a wall after {} steps, along the field (right) at the goal after {}",
            lengths[0], lengths[1]
        ),
        scene: Some(scene),
        ..Picture::default()
    })
}

/// The gradient about the line from start to goal, as it lies before the first iteration.
fn initial_pheromone() -> Outcome<Picture> {
    let (map, problem) = ground("lei-map1", 1)?;
    let gradient = LineGradient {
        unit: PheromoneUnit::Absolute,
        ..LineGradient::default()
    };
    let config = ColonyConfig {
        // One ant that leaves next to nothing.
        n_ants: 1,
        n_iterations: 1,
        initial: InitialPheromone::LineGradient(gradient),
        evaporation: Evaporation::Constant(Constant { rho: 0.0 }),
        deposit: Deposit::AllAnts(AllAnts { q: 1e-6 }),
        ..presets::lei2020()
    };
    let pheromone = send(&problem, &config)?.pheromone;
    let mut scene = Scene::new(&map);
    scene.heat_map(&pheromone, "pheromone, units");
    let line = [problem.start(), problem.goal()].map(|cell| map.frame().center(cell));
    scene.polyline(&line, &line_style("start to goal", palette::REVERSE, 2.5));
    Ok(Picture {
        title: "Pheromone before the first iteration: line-gradient".to_owned(),
        caption: "Twice as much on the line as in the farthest corner of the map".to_owned(),
        scene: Some(scene),
        ..Picture::default()
    })
}

/// First steps of many ants on open ground, under three rules side by side.
fn transition() -> Outcome<Picture> {
    let rows = ["       #       #       "; 5];
    let map = OccupancyGrid::from_rows(&rows, 1.0)?;
    let (start, goal) = (Cell::new(2, 2), Cell::new(6, 3));
    let mut scene = Scene::new(&map);
    let mut goals = BitGrid::new(map.frame().n_cols(), map.frame().n_rows());
    let mut captions = Vec::new();
    for (i, (name, rule)) in [
        ("roulette", Transition::Roulette),
        ("goal-directed", Transition::GoalDirected(GoalDirected {})),
        ("oblique-first", Transition::ObliqueFirst(ObliqueFirst {})),
    ]
    .into_iter()
    .enumerate()
    {
        let shares = first_steps(start, goal, rule)?;
        let shift = 8 * i as u32;
        goals.insert(Cell::new(goal.col + shift, goal.row));
        let from = map.frame().center(Cell::new(start.col + shift, start.row));
        for (step, share) in shares.into_iter().enumerate() {
            arrow(&mut scene, from, step, share);
        }
        let n_taken = shares.iter().filter(|&&share| share > 0.0).count();
        let most = 100.0 * shares.into_iter().fold(0.0, f64::max);
        captions.push(format!(
            "{name}: {n_taken} steps, at most {most:.0} % of the ants"
        ));
    }
    let style = CellStyle {
        label: "goal".to_owned(),
        color: palette::GOAL,
    };
    scene.cells(&goals, &style);
    Ok(Picture {
        title: "The first step of 20 000 ants".to_owned(),
        caption: captions.join("; "),
        scene: Some(scene),
        ..Picture::default()
    })
}

/// How many ants arrive on a map with long walls, by what they do in dead ends.
fn dead_ends() -> Outcome<Picture> {
    let (_, problem) = ground("lei-map3", 1)?;
    let retreat = |max_steps| dead_end::DeadEnd::Retreat(dead_end::Retreat { max_steps });
    let mut series = Vec::new();
    for (name, rule) in [
        ("die", dead_end::DeadEnd::Die),
        ("retreat, max_steps = 10", retreat(10)),
        ("retreat, max_steps = 100", retreat(100)),
        ("retreat, max_steps = 1000", retreat(1000)),
    ] {
        let config = ColonyConfig {
            dead_end: rule,
            ..presets::ant_system()
        };
        let share = |r: &IterationRecord| 100.0 * f64::from(r.n_arrived) / f64::from(r.n_ants);
        series.push((name, over_iterations(&problem, &config, share)?));
    }
    let caption = "Ant System on lei-map3, obstacles grown by one cell, 500 ants";
    Ok(charts(
        "Ants that arrive",
        caption,
        vec![chart("ants that arrive, %", series)],
    ))
}

/// The evaporated share over a run of 150 iterations.
fn evaporation() -> Picture {
    let poisson = |stretch| {
        Evaporation::Poisson(PoissonEvaporation {
            stretch,
            ..PoissonEvaporation::default()
        })
    };
    let rules = [
        ("constant", Evaporation::Constant(Constant::default())),
        ("poisson, stretch = 1", poisson(1.0)),
        ("poisson, stretch = N / 20", poisson(150.0 / 20.0)),
        (
            "adaptive, nothing better found",
            Evaporation::Adaptive(Adaptive::default()),
        ),
    ];
    let series = rules.into_iter().map(|(name, rule)| {
        let rho = |i| Point2::new(f64::from(i + 1), rule.rho(i, i));
        (name, (0..150).map(rho).collect())
    });
    charts(
        "What evaporates after each iteration",
        "150 iterations; every rule with its defaults but for what is named",
        vec![chart("rho", series.collect())],
    )
}

/// Who deposits: how fast ants agree, and how much pheromone piles up.
fn deposit() -> Outcome<Picture> {
    let (_, problem) = ground("lei-map1", 1)?;
    let (mut costs, mut most) = (Vec::new(), Vec::new());
    for (name, rule) in [
        ("all-ants", Deposit::AllAnts(AllAnts::default())),
        ("elitist", Deposit::Elitist(Elitist::default())),
        ("fittest", Deposit::Fittest(Fittest::default())),
        ("best-ant", Deposit::BestAnt(BestAnt::default())),
        ("best-worst", Deposit::BestWorst(BestWorst::default())),
    ] {
        let config = ColonyConfig {
            deposit: rule,
            limits: PheromoneLimits::Floor(Floor::default()),
            ..presets::ant_system()
        };
        let mean = |record: &IterationRecord| record.mean_cost.unwrap_or(f64::NAN);
        costs.push((name, over_iterations(&problem, &config, mean)?));
        let most_pheromone = |record: &IterationRecord| record.max_pheromone;
        most.push((
            name,
            relative_log(over_iterations(&problem, &config, most_pheromone)?),
        ));
    }
    let caption = "Ant System on lei-map1 with each rule's defaults and a floor of 0.001";
    let charts_of = vec![
        chart("mean cost of ants that arrive", costs),
        chart("log10 of most pheromone / that of iteration 1", most),
    ];
    Ok(charts("Who deposits", caption, charts_of))
}

/// The most (solid) and the least (dashed) pheromone under limits.
fn limits() -> Outcome<Picture> {
    let (_, problem) = ground("lei-map1", 1)?;
    let mut series = Vec::new();
    for (name, color, rule) in [
        ("none", SERIES_COLORS[1], PheromoneLimits::None),
        (
            "floor",
            SERIES_COLORS[2],
            PheromoneLimits::Floor(Floor::default()),
        ),
        (
            "max-min",
            SERIES_COLORS[0],
            PheromoneLimits::MaxMin(MaxMin::default()),
        ),
    ] {
        let config = ColonyConfig {
            limits: rule,
            ..presets::max_min()
        };
        let log = |value: f64| value.max(f64::MIN_POSITIVE).log10();
        let high = over_iterations(&problem, &config, |r| log(r.max_pheromone))?;
        let low = over_iterations(&problem, &config, |r| log(r.min_pheromone))?;
        series.push(Series::new(&format!("{name}: most"), high, color));
        series.push(Series {
            dash: Dash::Dashed,
            ..Series::new(&format!("{name}: least"), low, color)
        });
    }
    let chart = Chart {
        series,
        ..chart("log10 of pheromone", Vec::new())
    };
    let caption = "MAX-MIN Ant System on lei-map1 with its limits, a floor of 0.001, and none";
    Ok(charts(
        "Between which limits pheromone lies",
        caption,
        vec![chart],
    ))
}

/// A built-in map and its first request, with obstacles grown by some cells.
fn ground(name: &str, n_grown: u32) -> Outcome<(OccupancyGrid, ColonyProblem)> {
    let builtin = BuiltinMap::by_name(name)?;
    let (map, request) = (builtin.grid(), builtin.requests[0]);
    let mut blocked = map.lethal_cells();
    blocked.unite(&obstacle_expansion(&map.lethal_cells(), n_grown));
    let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
    let cell = |position| map.frame().cell_at(position).ok_or("off the map");
    let (start, goal) = (
        cell(request.start.position())?,
        cell(request.goal.position())?,
    );
    Ok((map, ColonyProblem::new(moves, start, goal)))
}

fn send(problem: &ColonyProblem, config: &ColonyConfig) -> Outcome<ColonyRun> {
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    Ok(run(problem, config, Seed(0), 1, &mut limits)?)
}

fn over_iterations(
    problem: &ColonyProblem,
    config: &ColonyConfig,
    value: impl Fn(&IterationRecord) -> f64,
) -> Outcome<Vec<Point2>> {
    let history = send(problem, config)?.history.iterations;
    let point = |r: &IterationRecord| Point2::new(f64::from(r.iteration + 1), value(r));
    Ok(history.iter().map(point).collect())
}

/// Shares of ants by their first step, none of which is beside the goal.
fn first_steps(start: Cell, goal: Cell, rule: Transition) -> Outcome<[f64; 8]> {
    let moves = MoveMasks::new(&BitGrid::new(7, 5), DiagonalRule::NoObstacles);
    let problem = ColonyProblem::new(moves, start, goal);
    let config = ColonyConfig {
        n_ants: 20_000,
        n_iterations: 1,
        transition: rule,
        ..presets::ant_system()
    };
    let mut counter = FirstSteps([0; 8]);
    run(
        &problem,
        &config,
        Seed(0),
        1,
        &mut Limits::new(&mut counter, None, None),
    )?;
    Ok(counter.0.map(|n| f64::from(n) / 20_000.0))
}

/// Counts ants by their first step.
struct FirstSteps([u32; 8]);

impl Observer for FirstSteps {
    fn on_event(&mut self, event: &Event) {
        let Event::Iteration(view) = event else {
            return;
        };
        let ways = (0..view.ways.n_ants()).map(|ant| view.ways.way(ant).cells);
        for cells in ways.filter(|cells| cells.len() > 1) {
            let by = |step: (i32, i32)| {
                let to = (cells[0].col as i32 + step.0, cells[0].row as i32 + step.1);
                to == (cells[1].col as i32, cells[1].row as i32)
            };
            if let Some(step) = STEPS.into_iter().position(by) {
                self.0[step] += 1;
            }
        }
    }
}

/// The way that always takes the allowed step to the least value, until none is less.
fn descent(problem: &ColonyProblem, values: &[f64]) -> GridPath {
    let moves = problem.moves();
    let (offsets, mut at) = (moves.offsets(), moves.index(problem.start()));
    let mut cells = vec![problem.start()];
    loop {
        let mask = moves.as_slice()[at];
        let allowed = (0..8).filter(|step| mask >> step & 1 == 1);
        let next = allowed
            .map(|step| at.wrapping_add_signed(offsets[step]))
            .min_by(|&a, &b| values[a].total_cmp(&values[b]));
        match next.filter(|&next| values[next] < values[at]) {
            Some(next) => at = next,
            None => return GridPath { cells },
        }
        cells.push(moves.cell(at));
    }
}

/// Two copies of a map with free columns between them.
fn side_by_side(map: &OccupancyGrid, gap: usize) -> Outcome<OccupancyGrid> {
    let frame = map.frame();
    let width = 2 * frame.n_cols() + gap;
    let between = vec![FREE; gap];
    let row = |row: &[i8]| [row, &between, row].concat();
    let values = map.values().chunks(frame.n_cols()).flat_map(row).collect();
    let (resolution_m, origin) = (frame.resolution_m(), frame.origin());
    let frame = GridFrame::new(width, frame.n_rows(), resolution_m, origin)?;
    Ok(OccupancyGrid::new(frame, values)?)
}

/// An arrow along a step, the thicker the more take it; dotted where nobody does.
fn arrow(scene: &mut Scene, from: Point2, step: usize, share: f64) {
    let along = Point2::new(f64::from(STEPS[step].0), f64::from(STEPS[step].1));
    let (tip, across) = (
        from + along,
        Point2::new(-along.y, along.x) * (0.12 / along.norm()),
    );
    let back = tip - along * (0.25 / along.norm());
    let line = [from, tip, back + across, tip, back - across];
    let style = if share > 0.0 {
        line_style(
            "steps taken, the thicker the oftener",
            palette::FORWARD,
            1.5 + 12.0 * share,
        )
    } else {
        LineStyle {
            dash: Dash::Dotted,
            ..line_style("second class", palette::MUTED, 1.5)
        }
    };
    scene.polyline(&line, &style);
}

fn line_style(label: &str, color: Color, width_px: f64) -> LineStyle {
    LineStyle {
        label: label.to_owned(),
        color,
        width_px,
        dash: Dash::Solid,
    }
}

/// Logarithms of values relative to the first.
fn relative_log(points: Vec<Point2>) -> Vec<Point2> {
    let first = points.first().map_or(1.0, |point| point.y);
    let log = |p: Point2| Point2::new(p.x, (p.y / first).log10());
    points.into_iter().map(log).collect()
}

/// A chart over iterations.
fn chart(quantity: &str, lines: Vec<(&str, Vec<Point2>)>) -> Chart {
    let dashes = [
        Dash::Solid,
        Dash::Dashed,
        Dash::Solid,
        Dash::Dashed,
        Dash::Dotted,
    ];
    let colors = SERIES_COLORS.into_iter().chain([palette::INK]);
    let looks = colors.zip(dashes);
    let line = |((label, points), (color, dash)): ((&str, _), _)| Series {
        dash,
        ..Series::new(label, points, color)
    };
    Chart {
        x: Axis::named("iteration"),
        y: Axis::named(quantity),
        series: lines.into_iter().zip(looks).map(line).collect(),
        height_px: 260.0,
        ..Chart::default()
    }
}

fn charts(title: &str, caption: &str, charts: Vec<Chart>) -> Picture {
    Picture {
        title: title.to_owned(),
        caption: caption.to_owned(),
        charts,
        ..Picture::default()
    }
}
