//! What lies on a map before ants walk, and where their first step leads.

use crate::{Outcome, ground, send};
use formicar::colony::deposit::{AllAnts, Deposit};
use formicar::colony::evaporation::{Constant, Evaporation};
use formicar::colony::initial::{InitialPheromone, LineGradient, PheromoneUnit};
use formicar::colony::transition::{GoalDirected, ObliqueFirst, Transition};
use formicar::colony::{ColonyConfig, ColonyProblem, presets, run};
use formicar::geometry::Point2;
use formicar::map::{
    BitGrid, Cell, DiagonalRule, FREE, GridFrame, MoveMasks, OccupancyGrid, STEPS,
};
use formicar::numeric::Seed;
use formicar::path::GridPath;
use formicar::progress::{Event, Limits, Observer};
use formicar::render::{CellStyle, Color, Dash, LineStyle, Picture, Scene, palette};
use formicar::search::{GoalField, STRAIGHT_COST};

/// Distances to the goal, straight and along the shortest way, on two copies of a map, with what
/// comes of always going where they fall most.
pub(crate) fn heuristic() -> Outcome<Picture> {
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
pub(crate) fn initial_pheromone() -> Outcome<Picture> {
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
pub(crate) fn transition() -> Outcome<Picture> {
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
