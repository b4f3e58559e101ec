//! Drives that suites share.

use formicar::numeric::RandomStream;
use formicar::scenario::{GoalHeading, ObstacleShape};
use formicar::{OccupancyGrid, Pose2, Seed, Vehicle};
use formicar_drive::{
    Agent, DriveRecord, Driver, DriverConfig, KnownMap, LidarConfig, RunConfig, Simulation,
    SimulationConfig, Solid, World, drive,
};

/// A drive to be simulated.
pub(crate) struct Case {
    pub(crate) world: World,
    pub(crate) known: KnownMap,
    pub(crate) start: Pose2,
    pub(crate) goal: Pose2,
    pub(crate) agents: Vec<Agent>,
    pub(crate) simulation: SimulationConfig,
    pub(crate) driver: DriverConfig,
    pub(crate) run: RunConfig,
}

/// A lidar of fewer beams, for tests.
pub(crate) fn small_lidar() -> LidarConfig {
    LidarConfig {
        n_beams: 361,
        ..LidarConfig::default()
    }
}

impl Case {
    /// A drive without noise, to any heading, on an unknown map.
    pub(crate) fn unknown(world: World, start: Pose2, goal: Pose2) -> Self {
        let simulation = SimulationConfig {
            lidar: LidarConfig {
                sigma_m: 0.0,
                ..small_lidar()
            },
            ..SimulationConfig::default()
        };
        Self {
            known: KnownMap::unknown(*world.map().frame()),
            driver: Self::usual(&simulation),
            simulation,
            world,
            start,
            goal,
            agents: Vec::new(),
            run: RunConfig {
                max_time_s: 60.0,
                ..RunConfig::default()
            },
        }
    }

    /// The same on a known map.
    pub(crate) fn known(world: World, start: Pose2, goal: Pose2) -> Self {
        Self {
            known: KnownMap::prior(world.map()),
            ..Self::unknown(world, start, goal)
        }
    }

    /// The usual driver of a simulation, to any heading.
    pub(crate) fn usual(simulation: &SimulationConfig) -> DriverConfig {
        DriverConfig {
            goal_heading: GoalHeading::Any,
            ..DriverConfig::for_simulation(simulation)
        }
    }

    pub(crate) fn drive(self) -> DriveRecord {
        let vehicle = Vehicle::f1tenth();
        let robot = Simulation::new(self.world, &vehicle, self.start, &self.simulation).unwrap();
        let mut robot = robot.with_agents(self.agents).unwrap();
        let mut driver = Driver::new(self.known, &vehicle, self.goal, &self.driver).unwrap();
        drive(&mut robot, &mut driver, &self.run, &mut ()).unwrap()
    }
}

/// A hall of 9 m x 6 m with pillars at random places, some of them round, none near the ends.
pub(crate) fn pillars(seed: u64) -> World {
    let mut random = Seed(seed).stream([9, 9]);
    let mut rows = vec![vec!['.'; 90]; 60];
    for row in &mut rows {
        row[0] = '#';
        row[89] = '#';
    }
    rows[0].fill('#');
    rows[59].fill('#');
    for _ in 0..9 {
        let (col, row) = place(&mut random);
        for line in rows.iter_mut().skip(row).take(3 + random.below(5)) {
            for cell in line.iter_mut().skip(col).take(3 + random.below(5)) {
                *cell = '#';
            }
        }
    }
    let rows: Vec<String> = rows
        .into_iter()
        .map(|row| row.into_iter().collect())
        .collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let solids = (0..4).map(|_| {
        let (col, row) = place(&mut random);
        let shape = ObstacleShape::Disc {
            radius_m: random.range(0.1, 0.3),
        };
        Solid::placed(&shape, Pose2::new(0.1 * col as f64, 0.1 * row as f64, 0.0))
    });
    let solids = solids.collect();
    World::new(OccupancyGrid::from_rows(&rows, 0.1).unwrap(), solids)
}

/// A cell between the ends of a hall.
fn place(random: &mut RandomStream) -> (usize, usize) {
    (20 + random.below(48), 5 + random.below(44))
}
