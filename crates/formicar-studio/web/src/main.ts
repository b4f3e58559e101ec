/** The entry point of the page. */

import "./style.css";
import { Actions } from "./actions";
import { Connection } from "./connection";
import { showShell } from "./shell";
import { Store, type State } from "./store";
import { startTheme } from "./theme";
import { socketUrl } from "./urls";

const BEGINNING: State = {
  catalog: null,
  isConnected: false,
  map: null,
  vehicle: null,
  request: { start: [0, 0, 0], goal: [0, 0, 0] },
  slots: { a: { config: { planner: "formicar" }, seed: 0, plan: null, driven: null }, b: null },
  shown: "a",
  tool: "move",
  brushM: 1,
  frame: null,
  frameShare: 0,
  isPlaying: false,
  past: { canUndo: false, canRedo: false },
  step: null,
  hoverM: null,
  driveS: null,
  layers: { swept: true, pheromone: true, ants: true, clearance: true },
  error: null,
};

startTheme();
const store = new Store(BEGINNING);
const connection = new Connection(
  socketUrl(),
  (message, payload) => actions.receive(message, payload),
  (isOpen) => actions.connected(isOpen),
);
const actions = new Actions(store, connection);
const root = document.getElementById("app");
if (root) showShell(root, store, actions);
void actions.start();
