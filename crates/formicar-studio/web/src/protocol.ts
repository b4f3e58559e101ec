/** The messages between page and server; the server's side is `src/protocol.rs`.
 *
 * Text messages are JSON, distinguished by `type`. A binary message is a header of the same kind
 * with a payload behind it: the header's length in bytes (u32, little endian), the header as
 * JSON, the payload. */

/** `[x m, y m, heading rad]`, world coordinates. */
export type Pose = [number, number, number];

/** A planner's configuration document; its shape is the JSON schema of the catalog. */
export type Config = { planner: string; [section: string]: unknown };

/** A point to pass on the way, with the given heading or any. */
export interface Via {
  at: [number, number];
  heading?: number;
  tolerance?: { xy: number; yaw: number };
}

/** A request document; what is left out takes its default. */
export interface Request {
  start: Pose;
  goal: Pose;
  goals?: Pose[];
  via?: Via[];
  motion?: "forward" | "reverse";
  start_heading?: "exact" | "any";
  goal_heading?: "exact" | "bidirectional" | "any";
  goal_tolerance?: { xy: number; yaw: number };
  curvature?: unknown;
  deadline_ms?: number;
  budget_steps?: number;
}

/** Parameters of a vehicle, as in vehicle files. */
export type VehicleParameters = Record<string, unknown>;

/** The choice of a vehicle: a preset, or parameters. */
export type VehicleChoice = { preset: string } | { parameters: VehicleParameters };

/** The choice of a map: a built-in by name, or an uploaded or edited one by its hash. */
export type MapChoice = { builtin: string } | { hash: string };

/** A rectangle of cells, its corner lowest and leftmost. */
export interface Region {
  col: number;
  row: number;
  n_cols: number;
  n_rows: number;
}

/** The slots of two plans side by side; `a` is always there. */
export type Slot = "a" | "b";

/** The controller that steers when a path is driven. */
export type DriveLaw = "open-loop" | "pure-pursuit" | "stanley";

// --- From the page ---------------------------------------------------------------------------

export type ClientMessage =
  /** Changes the map of this session; answered by `map`. */
  | { type: "open_map"; map: MapChoice }
  /** Changes the vehicle; answered by `vehicle`, or by `error`: then the old one stays. */
  | { type: "set_vehicle"; vehicle: VehicleChoice }
  /** Puts values (-1 unknown, 0 free to 100 occupied) into a rectangle, row by row, lowest row
   * first. Nothing is answered, but a plan asked for afterwards sees it. */
  | { type: "paint"; region: Region; values: number[] }
  /** Plans; a plan under way in the same slot is cancelled. `plan` grows from call to call.
   * Answered by frames, `improved` and one `answer`. With `previous`, the number of a plan that
   * was answered with a path, it replans from `request.start` along that path. With `watch`
   * frames of ants are sent; without it only `improved` and `answer`. */
  | {
      type: "plan";
      plan: number;
      slot: Slot;
      request: Request;
      config: Config;
      seed: number;
      watch: boolean;
      previous?: number;
    }
  /** Stops the plan under way in a slot; its `answer` says `cancelled`. */
  | { type: "cancel"; slot: Slot }
  /** Drives the last path of a slot; answered by `driven`. */
  | { type: "drive"; slot: Slot; law: DriveLaw; speed_mps?: number }
  /** Asks for the picture of the last answer of a slot; answered by `picture`. */
  | { type: "picture"; slot: Slot; format: "svg" | "png" }
  /** Keeps the map as it is now under the hash of its content; answered by `kept`. */
  | { type: "keep_map" };

// --- From the server -------------------------------------------------------------------------

/** A map; its payload is its values as signed bytes, row by row, lowest row first. */
export interface MapMessage {
  type: "map";
  /** Built-in name, or the name of the uploaded file. */
  name: string;
  /** The hash that opens it again; null for a built-in map. */
  hash: string | null;
  n_cols: number;
  n_rows: number;
  resolution_m: number;
  /** World pose of the lower left corner. */
  origin: Pose;
  /** Preset name of the vehicle that a built-in is made for. */
  vehicle: string | null;
  requests: { id: string; start: Pose; goal: Pose }[];
}

/** The vehicle of the session. */
export interface VehicleMessage {
  type: "vehicle";
  /** Preset name, or "own". */
  name: string;
  parameters: VehicleParameters;
  /** Corners about the center of the rear axle, x forward, meters. */
  footprint: [number, number][];
  /** `car`, or `point`: holonomic, without measures. */
  motion: "car" | "point";
  min_turning_radius_m: number | null;
  wheelbase_m: number | null;
  track_width_m: number | null;
  max_steer_rad: number | null;
}

/** One iteration of a colony, as in answer documents. */
export interface IterationRecord {
  iteration: number;
  n_ants: number;
  n_arrived: number;
  best_cost: number | null;
  mean_cost: number | null;
  best_length: number | null;
  mean_length: number | null;
  best_so_far_cost: number | null;
  best_so_far_length: number | null;
  rho: number;
  min_pheromone: number;
  max_pheromone: number;
}

/** Ants that walk over cells, at the end of an iteration. Sent at a steady rate: of fast colonies
 * not every one. The payload is the pheromone by cell, row by row, lowest row first, a byte each:
 * 0 where no ant can go, else 1 to 255, logarithmic between the least and the most. */
export interface IterationFrame {
  type: "iteration";
  plan: number;
  record: IterationRecord;
  /** Passages between two cells: col, row, col, row, how many; five numbers each. */
  arrived: number[];
  lost: number[];
  /** Cells of the best way: col, row; two numbers each. */
  best: number[];
}

/** Individuals of a genetic algorithm, at the end of a generation. */
export interface GenerationFrame {
  type: "generation";
  plan: number;
  record: IterationRecord;
  /** Polylines over cells: col, row, col, row ... */
  free: number[][];
  colliding: number[][];
  best: number[];
}

/** Ants that drive: a generation of the race, or of the improvement. World coordinates. */
export interface DriveFrame {
  type: "drive";
  plan: number;
  generation: number;
  n_steps: number;
  /** Ways of ants as polylines x, y, x, y ..., meters. */
  arrived: number[][];
  died: number[][];
}

/** Places that hybrid A* has reached since the last frame: the motions to them, as
 * x, y, x, y; four numbers each, world coordinates. */
export interface ExpandedFrame {
  type: "expanded";
  plan: number;
  n_steps: number;
  motions: number[];
}

/** A certified path, first or better than the last. */
export interface ImprovedFrame {
  type: "improved";
  plan: number;
  slot: Slot;
  length_m: number;
  n_steps: number;
  at_ms: number;
  /** x, y, heading, gear (1 or -1); four numbers each, at most 0.25 m apart. */
  poses: number[];
}

/** A sampled pose of a path. */
export interface PoseRecord {
  x: number;
  y: number;
  heading: number;
  s: number;
  direction: 1 | -1;
  curvature: number;
  steer: number | null;
  clearance: number;
  speed?: number;
  time?: number;
}

/** The answer document (`formicar/answer/1`), in the parts that the page reads. */
export interface Answer {
  schema: string;
  status: "found" | "no_path" | "infeasible" | "budget_exhausted" | "timed_out" | "cancelled" | "invalid_request";
  code: string;
  code_number: number;
  reason?: string | null;
  explanation?: {
    leg: number | null;
    collision: { end: string; cells: [number, number][] } | null;
    disconnected: { disc_radius_m: number; n_cells_at_start: number; n_cells_at_goal: number } | null;
    gap: { x: number; y: number; gap_m: number; vehicle_width_m: number } | null;
  } | null;
  planner: string;
  seed: number;
  certificate?: Record<string, unknown> | null;
  metrics?: Record<string, number> | null;
  timing: { map_setup_s: number; first_feasible_s: number | null; query_s: number; total_s: number };
  path?: { poses: PoseRecord[]; segments: unknown[] } | null;
  provenance: Record<string, unknown>;
}

/** Intermediate results of a planner, shown step by step; results that it does not compute are
 * left out. Cells are col, row; two numbers each. */
export interface Stages {
  expanded?: number[];
  closed?: number[];
  grid_path?: number[];
  nodes?: number[];
}

/** The end of a plan. */
export interface AnswerMessage {
  type: "answer";
  plan: number;
  slot: Slot;
  /** All iterations of a colony or population; empty without one. */
  history: IterationRecord[];
  stages: Stages;
  /** Place of an obstacle that the vehicle comes nearest to, and how near; null without a path. */
  tightest: { x: number; y: number; clearance_m: number; pose: Pose } | null;
  /** The same request for a terminal, and as a configuration file. */
  cli: string;
  toml: string;
  /** The last field of the message. */
  answer: Answer;
}

/** A simulated drive. Angles in radians, positive to the left. */
export interface DrivenMessage {
  type: "driven";
  slot: Slot;
  plan: number;
  law: DriveLaw;
  /** Whether the vehicle arrived and touched nothing. */
  tracked: boolean;
  status: string;
  summary: Record<string, number>;
  min_clearance_m: number | null;
  /** The first contact of the body with an obstacle. */
  contact: { x: number; y: number; t_s: number } | null;
  trace: {
    t_s: number;
    driven_m: number;
    s_m: number;
    pose: { x: number; y: number; heading: number };
    direction: 1 | -1;
    steer_rad: number;
    left_wheel_rad: number;
    right_wheel_rad: number;
    cross_track_error_m: number;
    heading_error_rad: number;
  }[];
}

/** A picture; its payload is the file. */
export interface PictureMessage {
  type: "picture";
  slot: Slot;
  format: "svg" | "png";
}

export type ServerMessage =
  | { type: "hello"; version: string }
  | MapMessage
  | VehicleMessage
  | IterationFrame
  | GenerationFrame
  | DriveFrame
  | ExpandedFrame
  | ImprovedFrame
  | AnswerMessage
  /** A newer plan of the slot was ordered before this one began. */
  | { type: "dropped"; plan: number; slot: Slot }
  | DrivenMessage
  | PictureMessage
  | { type: "kept"; hash: string }
  /** Something that was asked for could not be done: what, and why, with value, limit and hint.
   * `plan` is the number of the plan that was asked for. */
  | { type: "error"; about: string; message: string; plan?: number };

// --- Over HTTP -------------------------------------------------------------------------------

/** `GET api/catalog`. */
export interface Catalog {
  version: string;
  maps: { name: string; about: string; kind: string; vehicle: string }[];
  vehicles: { name: string; parameters: VehicleParameters }[];
  planners: { name: string; about: string; has_ants: boolean; config: Config }[];
  /** JSON schema of a planner's configuration, and of a vehicle's parameters. */
  config_schema: JsonSchema;
  vehicle_schema: JsonSchema;
  limits: { max_upload_bytes: number; max_cells: number };
}

/** As much of JSON schema as the forms read. */
export interface JsonSchema {
  $ref?: string;
  $defs?: Record<string, JsonSchema>;
  title?: string;
  description?: string;
  type?: string | string[];
  properties?: Record<string, JsonSchema>;
  items?: JsonSchema;
  enum?: unknown[];
  const?: unknown;
  oneOf?: JsonSchema[];
  anyOf?: JsonSchema[];
  default?: unknown;
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  exclusiveMaximum?: number;
  required?: string[];
}

/** `POST api/maps`, a form of files (`files`, a ROS YAML with its image, or one file) and, for
 * formats that leave it open, `resolution_m`: what to open, or a status of 4xx with this error. */
export type UploadAnswer = { hash: string; name: string; warnings: string[] } | { error: string };
