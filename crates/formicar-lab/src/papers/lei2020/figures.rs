//! Figures 2 to 5 and 9 to 13.

use super::variants::{COLONIES, CONVENTIONAL, IMPROVED, MAPS, Map, variants};
use crate::papers::drawn_run::{DrawnRun, Line, overlay, strips_of};
use crate::papers::experiment::{Ground, Variant};
use crate::papers::trial::{Moment, Trial};
use crate::papers::trials::Runs;
use crate::report::{Block, Field, Figure, Section, Table};
use anyhow::{Context, Result};
use formicar::colony::deposit::{AllAnts, Deposit};
use formicar::colony::evaporation::{Constant, Evaporation, PoissonEvaporation};
use formicar::colony::initial::{InitialPheromone, LineGradient, PheromoneUnit};
use formicar::geometry::{Point2, Pose2};
use formicar::planner::{ColonyParameters, PlannerName};
use formicar::render::{
    Axis, CellStyle, Chart, Dash, LineStyle, Picture, PoseMark, Scene, Series, Side, palette,
};

/// Generations of figure 5 and figure 11.
const N_GENERATIONS: u32 = 150;

fn named(ground: &Ground, name: &str) -> Result<Variant> {
    let mut variants = variants(ground).into_iter();
    let found = variants.find(|variant| variant.name == name);
    found.with_context(|| format!("there is no variant {name}"))
}

fn scene_block(caption: &str, scene: Scene) -> Block {
    let picture = Picture {
        scene: Some(scene),
        ..Picture::default()
    };
    Block::Figure(Figure::new(caption, &picture))
}

fn chart_block(caption: &str, charts: Vec<Chart>) -> Block {
    let picture = Picture {
        charts,
        ..Picture::default()
    };
    Block::Figure(Figure::new(caption, &picture))
}

fn scene(ground: &Ground) -> Scene {
    let mut scene = Scene::new(&ground.grid);
    scene.pose(ground.request.start, &ground.vehicle, PoseMark::Start);
    scene.pose(ground.request.goal, &ground.vehicle, PoseMark::Goal);
    scene
}

/// Figures 2 and 3.
pub(super) fn layers(grounds: &[Ground]) -> Result<Section> {
    let mut blocks = Vec::new();
    for ground in grounds {
        let drawn = DrawnRun::new(ground, &named(ground, IMPROVED)?)?;
        let Some(layers) = &drawn.outcome.stages().layers else {
            continue;
        };
        let mut scene = scene(ground);
        scene.cells(&layers.expanded, &CellStyle::expanded());
        scene.cells(&layers.closed, &CellStyle::closed());
        let caption = format!(
            "Figures 2 and 3 on `{}`: {} obstacle cells, {} cells of expansion by half the \
             vehicle's width, {} cells of closed U-shapes.",
            ground.map,
            layers.obstacles.count(),
            layers.expanded.count(),
            layers.closed.count()
        );
        blocks.push(scene_block(&caption, scene));
    }
    Ok(Section::new(
        "Obstacle expansion and U-shapes: figures 2 and 3",
        blocks,
    ))
}

/// Figures 4 and 5.
pub(super) fn pheromone(grounds: &[Ground]) -> Result<Section> {
    let blocks = vec![gradient(&grounds[0])?, evaporation()];
    Ok(Section::new(
        "Pheromone at the start, evaporation: figures 4 and 5",
        blocks,
    ))
}

fn gradient(ground: &Ground) -> Result<Block> {
    // One ant that leaves next to nothing.
    let variant = Variant::changed(
        PlannerName::Lei2020,
        "one ant",
        |c: &mut ColonyParameters| {
            c.colony.n_ants = 1;
            c.colony.n_iterations = 1;
            c.colony.initial = InitialPheromone::LineGradient(LineGradient {
                unit: PheromoneUnit::Absolute,
                ..LineGradient::default()
            });
            c.colony.evaporation = Evaporation::Constant(Constant { rho: 0.0 });
            c.colony.deposit = Deposit::AllAnts(AllAnts { q: 1e-6 });
        },
    );
    let drawn = DrawnRun::new(ground, &variant)?;
    let mut scene = Scene::new(&ground.grid);
    if let Some(run) = &drawn.outcome.stages().colony {
        scene.heat_map(&run.pheromone, "pheromone, units");
    }
    let ends = [ground.request.start, ground.request.goal].map(Pose2::position);
    let style = LineStyle {
        label: "start to goal".to_owned(),
        color: palette::REVERSE,
        width_px: 2.5,
        dash: Dash::Solid,
    };
    scene.polyline(&ends, &style);
    let caption = "Figure 4: pheromone before the first generation, twice as much on the line from \
                   start to goal as in the farthest corner. The paper gives the gradient as a \
                   picture; its ends, 1 and 2, are a reading.";
    Ok(scene_block(caption, scene))
}

fn evaporation() -> Block {
    let literal = PoissonEvaporation::default();
    let stretched = PoissonEvaporation {
        stretch: f64::from(N_GENERATIONS) / 20.0,
        ..literal.clone()
    };
    let line = |of: &dyn Fn(u32) -> f64| -> Vec<Point2> {
        let generations = 0..N_GENERATIONS;
        generations
            .map(|k| Point2::new(f64::from(k), of(k)))
            .collect()
    };
    let probability = |k: u32| (literal.rho(k) - literal.offset) / literal.amplitude;
    let series = |label: &str, of: &dyn Fn(u32) -> f64, color, dash| Series {
        dash,
        ..Series::new(label, line(of), color)
    };
    let chart = Chart {
        x: Axis::named("generation k"),
        y: Axis {
            label: "rho".to_owned(),
            range: Some((0.0, 1.1)),
            ..Axis::default()
        },
        series: vec![
            series(
                "equation 1",
                &|k| literal.rho(k),
                palette::LIMIT,
                Dash::Solid,
            ),
            series(
                "stretched to N/20",
                &|k| stretched.rho(k),
                palette::FORWARD,
                Dash::Dashed,
            ),
            series("constant", &|_| 0.5, palette::MUTED, Dash::Dotted),
            series(
                "Poisson distribution + B",
                &|k| probability(k) + literal.offset,
                palette::REVERSE,
                Dash::Dashed,
            ),
        ],
        height_px: 260.0,
        ..Chart::default()
    };
    chart_block(
        "Figure 5: evaporation over the generations (lambda = 10, A = -5, B = 0.9). To the letter \
         the trough lies at generations 9 and 10; the figure's text puts it in the middle of the \
         run, as the stretched form does. The constant is what the conventional colony has.",
        vec![chart],
    )
}

/// Figure 9.
pub(super) fn nodes(grounds: &[Ground], runs: Runs) -> Result<Section> {
    let ground = &grounds[0];
    let drawn = DrawnRun::new(ground, &named(ground, IMPROVED)?)?;
    let stages = drawn.outcome.stages();
    let mut blocks = vec![Block::Table(node_table(runs))];
    if let Some(path) = &stages.grid_path {
        let mut scene = scene(ground);
        scene.grid_path(path);
        scene.nodes(&path.cells, &stages.nodes);
        let caption = format!(
            "Figure 9 on `{}`, seed 0: {} nodes of the ants' way, {} after redundant ones are \
             removed; in the paper 33 and 12.",
            ground.map,
            path.cells.len(),
            stages.nodes.len()
        );
        blocks.push(scene_block(&caption, scene));
    }
    Ok(Section::new("Redundant nodes: figure 9", blocks))
}

fn node_table(runs: Runs) -> Table {
    let mut table = Table::new("nodes", &["map", "before", "after", "after / before, %"])
        .captioned("Nodes of the way of `lei2020` before and after redundant ones are removed.");
    table.row(vec![
        Field::words("the paper's figure 9"),
        Field::Number(Some(33.0), 0),
        Field::Number(Some(12.0), 0),
        Field::Number(Some(100.0 * 12.0 / 33.0), 1),
    ]);
    for map in &MAPS {
        let group = runs.group(map.name, IMPROVED);
        let share = |t: &Trial| Some(100.0 * t.n_nodes_after? as f64 / t.n_nodes_before? as f64);
        table.row(vec![
            Field::words(map.name),
            group.spread(|t| Some(t.n_nodes_before? as f64), 0),
            group.spread(|t| Some(t.n_nodes_after? as f64), 0),
            group.number(share, 1),
        ]);
    }
    table
}

/// Figures 10, 12 and 13.
pub(super) fn paths(map: &Map, ground: &Ground) -> Result<Section> {
    let drawn_runs: Result<Vec<DrawnRun>> = COLONIES
        .iter()
        .map(|name| DrawnRun::new(ground, &named(ground, name)?))
        .collect();
    let drawn_runs = drawn_runs?;
    let caption = format!(
        "Figure {} on `{}`, seed 0: the ants' ways of the three colonies from cell to cell.",
        map.figure, map.name
    );
    let cells = overlay(ground, &drawn_runs, Line::Cells, &caption);
    let last = &drawn_runs[drawn_runs.len() - 1];
    let what = match last.outcome.judged() {
        Some(_) => "the path of the improved colony after its corners are rounded",
        None => "the way of the improved colony, of which a corner leaves no room to be rounded",
    };
    let caption = format!("Figure {} on `{}`, seed 0: {what}.", map.figure, map.name);
    let smooth = overlay(ground, std::slice::from_ref(last), Line::Curve, &caption);
    let judged = last.outcome.judged();
    let strips = judged.map(|(path, report)| strips_of(ground, &last.variant, path, report));
    let figures = [cells, smooth].into_iter().chain(strips);
    Ok(Section::new(
        format!("Paths on {}: figure {}", map.name, map.figure),
        figures.map(Block::Figure).collect(),
    ))
}

/// Figure 11.
pub(super) fn convergence(runs: Runs) -> Section {
    let caption = "Figure 11 on `lei-map1`, seed 0: length of each generation's best way, and the \
                   evaporation on the right axis; above the conventional colony, below the improved \
                   one.";
    let charts = [CONVENTIONAL, IMPROVED].map(|name| {
        let run = runs.of(MAPS[0].name, name).next();
        generations(name, run.map_or(&[], |run| &run.moments))
    });
    let mut blocks = vec![chart_block(caption, charts.to_vec())];
    for map in &MAPS {
        let caption = format!(
            "`{}`: length of the best way so far, medians and quartiles over the seeds, by \
             iteration, by ants sent out and by time since the colony set out. A line begins where \
             three quarters of the runs have a way.",
            map.name
        );
        blocks.push(Block::Trends(
            runs.convergence(map.name, &COLONIES, &caption),
        ));
    }
    Section::new("Convergence: figure 11", blocks)
}

fn generations(name: &str, moments: &[Moment]) -> Chart {
    let points = |of: fn(&Moment) -> Option<f64>| -> Vec<Point2> {
        let point = |moment: &Moment| Some(Point2::new(f64::from(moment.iteration), of(moment)?));
        moments.iter().filter_map(point).collect()
    };
    let rho = Series {
        side: Side::Right,
        dash: Dash::Dotted,
        ..Series::new("rho", points(|moment| Some(moment.rho)), palette::LIMIT)
    };
    let mean = Series {
        dash: Dash::Dashed,
        ..Series::new(
            "mean of the generation",
            points(|m| m.mean_length),
            palette::MUTED,
        )
    };
    let best = Series::new(
        "best of the generation",
        points(|moment| moment.best_length),
        palette::FORWARD,
    );
    Chart {
        title: name.to_owned(),
        x: Axis::named("generation"),
        y: Axis::named("cells"),
        y_right: Some(Axis {
            label: "rho".to_owned(),
            range: Some((0.0, 1.0)),
            ..Axis::default()
        }),
        series: vec![mean, best, rho],
        height_px: 200.0,
        ..Chart::default()
    }
}
