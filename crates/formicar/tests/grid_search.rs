//! A*, the goal field and known optima agree on grids.

use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::builtin::BuiltinMap;
use formicar::map::{BitGrid, Cell, DiagonalRule, MoveMasks, STEPS};
use formicar::map::{Components, DistanceField};
use formicar::progress::{Limits, Observer, Status};
use formicar::search::{
    AstarWorkspace, DIAGONAL_COST, GoalField, GridSearch, ImprovedAstarConfig, STRAIGHT_COST,
    SearchError, astar, improved_astar,
};
use formicar::vehicle::Vehicle;
use proptest::prelude::*;
use std::path::{Path, PathBuf};

fn run_astar(
    moves: &MoveMasks,
    ends: [Cell; 2],
    workspace: &mut AstarWorkspace,
) -> Result<GridSearch, SearchError> {
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    astar(moves, ends[0], ends[1], workspace, &mut limits)
}

fn goal_field(moves: &MoveMasks, goals: &[Cell]) -> GoalField {
    let mut nobody = ();
    GoalField::new(moves, goals, &mut Limits::new(&mut nobody, None, None)).unwrap()
}

/// Whether a step is allowed, straight from the definition of the rule.
fn allows(blocked: &BitGrid, rule: DiagonalRule, from: Cell, (dx, dy): (i32, i32)) -> bool {
    let free = |dx: i32, dy: i32| {
        let col = i64::from(from.col) + i64::from(dx);
        let row = i64::from(from.row) + i64::from(dy);
        let inside =
            col >= 0 && row >= 0 && col < blocked.n_cols() as i64 && row < blocked.n_rows() as i64;
        inside && !blocked.contains(col, row)
    };
    let corner = match rule {
        _ if dx == 0 || dy == 0 => true,
        DiagonalRule::Always => true,
        DiagonalRule::AtMostOneObstacle => free(dx, 0) || free(0, dy),
        DiagonalRule::NoObstacles => free(dx, 0) && free(0, dy),
    };
    free(0, 0) && free(dx, dy) && corner
}

/// Costs from a cell by relaxing all steps until nothing changes.
fn bellman_ford(blocked: &BitGrid, rule: DiagonalRule, from: Cell) -> Vec<Option<u64>> {
    let (n_cols, n_rows) = (blocked.n_cols(), blocked.n_rows());
    let mut costs = vec![None; n_cols * n_rows];
    costs[from.row as usize * n_cols + from.col as usize] = Some(0_u64);
    let mut is_settled = false;
    while !is_settled {
        is_settled = true;
        for i in 0..n_cols * n_rows {
            let cell = Cell::new((i % n_cols) as u32, (i / n_cols) as u32);
            let Some(cost) = costs[i] else { continue };
            for &(dx, dy) in STEPS.iter().filter(|&&s| allows(blocked, rule, cell, s)) {
                let to = (i as isize + dy as isize * n_cols as isize + dx as isize) as usize;
                let is_straight = dx == 0 || dy == 0;
                let step = if is_straight {
                    STRAIGHT_COST
                } else {
                    DIAGONAL_COST
                };
                let offered = cost + u64::from(step);
                if costs[to].is_none_or(|known| offered < known) {
                    costs[to] = Some(offered);
                    is_settled = false;
                }
            }
        }
    }
    costs
}

/// Checks that a path leads from start to goal by allowed steps, as many as counted.
fn assert_walkable(blocked: &BitGrid, rule: DiagonalRule, ends: [Cell; 2], found: &GridSearch) {
    let cells = &found.path.cells;
    assert_eq!([cells[0], cells[cells.len() - 1]], ends);
    let (mut n_straight, mut n_diagonal) = (0, 0);
    for pair in cells.windows(2) {
        let step = (
            pair[1].col as i32 - pair[0].col as i32,
            pair[1].row as i32 - pair[0].row as i32,
        );
        assert!(STEPS.contains(&step) && allows(blocked, rule, pair[0], step));
        if step.0 == 0 || step.1 == 0 {
            n_straight += 1;
        } else {
            n_diagonal += 1;
        }
    }
    assert_eq!(
        (n_straight, n_diagonal),
        (found.n_straight, found.n_diagonal)
    );
}

prop_compose! {
    fn random_grid()(n_cols in 1_usize..24, n_rows in 1_usize..24, density in 0.0..0.5)
        (bits in prop::collection::vec(prop::bool::weighted(density), n_cols * n_rows), n_cols in Just(n_cols))
        -> BitGrid
    {
        let mut grid = BitGrid::new(n_cols, bits.len() / n_cols);
        for (i, _) in bits.iter().enumerate().filter(|(_, is_set)| **is_set) {
            grid.insert(Cell::new((i % n_cols) as u32, (i / n_cols) as u32));
        }
        grid
    }
}

proptest! {
    #[test]
    fn astar_and_goal_field_find_the_optimum_under_every_rule(
        blocked in random_grid(),
        place in any::<prop::sample::Index>(),
    ) {
        let (n_cols, n_cells) = (blocked.n_cols(), blocked.n_cols() * blocked.n_rows());
        let cells: Vec<_> = (0..n_cells).map(|i| Cell::new((i % n_cols) as u32, (i / n_cols) as u32)).collect();
        let goal = cells[place.index(n_cells)];
        prop_assume!(!blocked.get(goal.col as usize, goal.row as usize));
        // One workspace for all: what a query leaves behind must not matter to the next.
        let mut workspace = AstarWorkspace::new();
        for rule in DiagonalRule::ALL {
            let moves = MoveMasks::new(&blocked, rule);
            let components = Components::new(&blocked, rule.connectivity());
            let (field, expected) = (goal_field(&moves, &[goal]), bellman_ford(&blocked, rule, goal));
            for (&cell, &cost) in cells.iter().zip(&expected) {
                prop_assert_eq!(field.cost(cell).map(u64::from), cost);
                prop_assert_eq!(components.same(cell, goal), cost.is_some());
            }
            for (&start, &cost) in cells.iter().zip(&expected).step_by(7) {
                let found = run_astar(&moves, [start, goal], &mut workspace);
                let descended = field.path(&moves, start);
                let Some(cost) = cost else {
                    prop_assert_eq!(&found, &descended);
                    let error = found.unwrap_err();
                    let is_blocked = matches!(error, SearchError::Blocked { end: "start", .. });
                    prop_assert!(is_blocked || error.status() == Some(Status::NoPath));
                    continue;
                };
                for found in [found.unwrap(), descended.unwrap()] {
                    prop_assert_eq!(found.cost(), cost);
                    assert_walkable(&blocked, rule, [start, goal], &found);
                }
            }
        }
    }

    /// The bound of the estimate that weighs more far from the goal; with weight 0 it is A*.
    #[test]
    fn improved_astar_is_at_most_one_and_the_weight_times_as_long_and_without_it_astar(
        blocked in random_grid(),
        places in prop::array::uniform2(any::<prop::sample::Index>()),
        weight in 0.0..=2.0,
    ) {
        let n_cols = blocked.n_cols();
        let ends = places.map(|place| {
            let i = place.index(n_cols * blocked.n_rows());
            Cell::new((i % n_cols) as u32, (i / n_cols) as u32)
        });
        prop_assume!(ends.iter().all(|c| !blocked.get(c.col as usize, c.row as usize)));
        let mut workspace = AstarWorkspace::new();
        for rule in DiagonalRule::ALL {
            let moves = MoveMasks::new(&blocked, rule);
            let mut improved = |distance_weight: f64| {
                let mut nobody = ();
                let mut limits = Limits::new(&mut nobody, None, None);
                let config = ImprovedAstarConfig { distance_weight };
                let found = improved_astar(&moves, ends, &config, &mut workspace, &mut limits);
                (found, limits.n_steps())
            };
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, None, None);
            let shortest = astar(&moves, ends[0], ends[1], &mut AstarWorkspace::new(), &mut limits);
            prop_assert_eq!(improved(0.0), (shortest.clone(), limits.n_steps()));
            for weight in [weight, 1.0] {
                let found = improved(weight).0;
                let (Ok(found), Ok(shortest)) = (&found, &shortest) else {
                    prop_assert_eq!(&found, &shortest);
                    continue;
                };
                assert_walkable(&blocked, rule, ends, found);
                prop_assert!(found.cost() >= shortest.cost());
                prop_assert!(found.cost() as f64 <= (1.0 + weight) * shortest.cost() as f64);
            }
        }
    }

    #[test]
    fn with_several_goals_the_nearest_counts(
        blocked in random_grid(),
        places in prop::collection::vec(any::<prop::sample::Index>(), 1..5),
    ) {
        let (n_cols, n_cells) = (blocked.n_cols(), blocked.n_cols() * blocked.n_rows());
        let cell = |i: usize| Cell::new((i % n_cols) as u32, (i / n_cols) as u32);
        let mut goals: Vec<_> = places.iter().map(|p| cell(p.index(n_cells))).collect();
        goals.retain(|g| !blocked.get(g.col as usize, g.row as usize));
        let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
        let field = goal_field(&moves, &goals);
        let each: Vec<_> = goals.iter().map(|&goal| goal_field(&moves, &[goal])).collect();
        for i in 0..n_cells {
            let nearest = each.iter().filter_map(|field| field.cost(cell(i))).min();
            prop_assert_eq!(field.cost(cell(i)), nearest);
        }
    }
}

#[test]
fn inflation_closes_gaps_that_are_too_narrow() {
    let mut walls = BitGrid::new(21, 9);
    for row in (0..9).filter(|row| !(3..6).contains(row)) {
        walls.insert(Cell::new(10, row));
    }
    let distance = DistanceField::new(&walls, 16);
    let ends = [Cell::new(2, 4), Cell::new(18, 4)];
    let search = |radius| {
        let moves = MoveMasks::new(&distance.within(radius).unwrap(), DiagonalRule::NoObstacles);
        run_astar(&moves, ends, &mut AstarWorkspace::new())
    };
    assert_eq!(search(1.9).unwrap().length_cells(), 16.0);
    let status = search(2.0).unwrap_err().status();
    assert_eq!(status, Some(Status::NoPath));
}

#[test]
fn limits_end_both_searches_with_their_status() {
    struct Impatient;
    impl Observer for Impatient {
        fn is_cancelled(&mut self) -> bool {
            true
        }
    }
    let moves = MoveMasks::new(&BitGrid::new(50, 50), DiagonalRule::NoObstacles);
    let (start, goal) = (Cell::new(0, 0), Cell::new(49, 30));
    let statuses = |observer: &mut dyn Observer, budget| {
        let mut limits = Limits::new(observer, budget, None);
        let found = astar(&moves, start, goal, &mut AstarWorkspace::new(), &mut limits);
        let field = GoalField::new(&moves, &[goal], &mut limits);
        [found.unwrap_err().status(), field.unwrap_err().status()]
    };
    assert_eq!(
        statuses(&mut (), Some(10)),
        [Some(Status::BudgetExhausted); 2]
    );
    assert_eq!(statuses(&mut Impatient, None), [Some(Status::Cancelled); 2]);
}

#[test]
fn bad_ends_are_the_callers_fault() {
    let mut blocked = BitGrid::new(5, 4);
    blocked.insert(Cell::new(1, 1));
    let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
    let (free, off) = (Cell::new(0, 0), Cell::new(5, 0));
    let mut workspace = AstarWorkspace::new();
    let mut error = |ends| run_astar(&moves, ends, &mut workspace).unwrap_err();
    assert_eq!(
        error([off, free]).to_string(),
        "start cell (5, 0) is off the map of 5 x 4 cells"
    );
    let on_wall = error([free, Cell::new(1, 1)]);
    assert!(matches!(on_wall, SearchError::Blocked { end: "goal", .. }));
    assert_eq!(on_wall.status(), None);
    assert_eq!(
        run_astar(&moves, [free, free], &mut workspace)
            .unwrap()
            .length_cells(),
        0.0
    );
}

/// The blocked cells of a `MovingAI` map, top row first as in the file, so that `.scen` rows fit.
fn movingai_map(path: &Path) -> BitGrid {
    let text = std::fs::read_to_string(path).unwrap();
    let rows: Vec<_> = text.lines().skip(4).map(str::trim_end).collect();
    let mut blocked = BitGrid::new(rows[0].len(), rows.len());
    for (row, line) in rows.iter().enumerate() {
        for (col, _) in line
            .bytes()
            .enumerate()
            .filter(|(_, c)| !b".GS".contains(c))
        {
            blocked.insert(Cell::new(col as u32, row as u32));
        }
    }
    blocked
}

fn movingai_folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/movingai");
    if !folder.is_dir() {
        println!("skipped: no MovingAI maps in {}", folder.display());
        return None;
    }
    Some(folder)
}

#[test]
fn movingai_optima_are_met() {
    let Some(folder) = movingai_folder() else {
        return;
    };
    let mut workspace = AstarWorkspace::new();
    for name in [
        "arena2",
        "den520d",
        "random512-10-0",
        "maze512-32-0",
        "Berlin_0_256",
    ] {
        let blocked = movingai_map(&folder.join(format!("{name}.map")));
        let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
        let scenarios = std::fs::read_to_string(folder.join(format!("{name}.map.scen"))).unwrap();
        let lines = scenarios
            .lines()
            .skip(1)
            .filter(|line| !line.trim().is_empty());
        let lines: Vec<_> = lines.collect();
        for line in lines.iter().rev().step_by(lines.len() / 8) {
            let fields: Vec<_> = line.split_whitespace().collect();
            let number = |i: usize| fields[i].parse::<u32>().unwrap();
            let (start, goal) = (
                Cell::new(number(4), number(5)),
                Cell::new(number(6), number(7)),
            );
            let optimum: f64 = fields[8].parse().unwrap();
            let found = run_astar(&moves, [start, goal], &mut workspace).unwrap();
            let descended = goal_field(&moves, &[goal]).path(&moves, start).unwrap();
            for length in [found.length_cells(), descended.length_cells()] {
                assert!(
                    (length - optimum).abs() <= 1e-4 * optimum,
                    "{name}: {line}: {length}"
                );
            }
        }
    }
}

#[test]
fn the_route_of_li_neighborhood_is_92_m_long_and_leads_through_alleys() {
    let map = BuiltinMap::by_name("li-neighborhood").unwrap();
    let (grid, ends) = (map.grid(), map.request("route-92m").unwrap());
    let half_width_m = 0.5 * Vehicle::preset(map.vehicle).unwrap().width_m();
    let obstacles = ObstacleMap::new(&grid);
    let half_width_cells = half_width_m / grid.frame().resolution_m();
    let grown = obstacles.distance().within(half_width_cells).unwrap();
    let moves = MoveMasks::new(&grown, DiagonalRule::NoObstacles);
    let cell = |pose: Pose2| grid.frame().cell_at(pose.position()).unwrap();
    let field = goal_field(&moves, &[cell(ends.goal)]);
    let length_m = 0.2 * field.distance_cells(cell(ends.start)).unwrap();
    assert!((length_m - 92.0).abs() < 2.0, "{length_m}");
    let cells = field.path(&moves, cell(ends.start)).unwrap().path.cells;
    let lethal = grid.lethal_cells();
    let is_narrow = |&&cell: &&Cell| width_cells(&lethal, cell) <= 16;
    assert!(2 * cells.iter().filter(is_narrow).count() > cells.len());
}

/// Free cells between the obstacles left and right of a cell, or above and below.
fn width_cells(lethal: &BitGrid, cell: Cell) -> usize {
    let run = |dx: i64, dy: i64| {
        let at = |k: i64| (i64::from(cell.col) + k * dx, i64::from(cell.row) + k * dy);
        let is_free = |&k: &i64| !lethal.contains(at(k).0, at(k).1);
        (1..800).take_while(is_free).count()
    };
    (1 + run(1, 0) + run(-1, 0)).min(1 + run(0, 1) + run(0, -1))
}

proptest! {
    #[test]
    fn a_corridor_holds_the_cells_of_short_ways_at_their_distance(
        cells in prop::collection::vec(any::<prop::sample::Index>(), 0..90),
        ends in prop::array::uniform2(any::<prop::sample::Index>()),
        ratio in 1.0..2.0,
    ) {
        let (n_cols, n_rows) = (20, 15);
        let place = |index: &prop::sample::Index| {
            let i = index.index(n_cols * n_rows);
            Cell::new((i % n_cols) as u32, (i / n_cols) as u32)
        };
        let [start, goal] = [place(&ends[0]), place(&ends[1])];
        let mut blocked = BitGrid::new(n_cols, n_rows);
        blocked.extend(cells.iter().map(place).filter(|&cell| cell != start && cell != goal));
        for rule in DiagonalRule::ALL {
            let moves = MoveMasks::new(&blocked, rule);
            let [to_goal, to_start] = [goal, start].map(|end| goal_field(&moves, &[end]));
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, None, None);
            let corridor = to_goal.corridor(&moves, start, ratio, &mut limits);
            let Some(least) = to_goal.cost(start) else {
                prop_assert_eq!(corridor.unwrap_err().status(), Some(Status::NoPath));
                continue;
            };
            let (corridor, most) = (corridor.unwrap(), (f64::from(least) * ratio) as u32);
            for i in 0..n_cols * n_rows {
                let cell = moves.cell(i);
                let sum = to_goal.cost(cell).zip(to_start.cost(cell)).map(|(a, b)| a + b);
                let expected = to_start.cost(cell).filter(|_| sum.is_some_and(|sum| sum <= most));
                prop_assert_eq!(corridor.cost(cell), expected, "{:?}", cell);
            }
        }
    }
}
