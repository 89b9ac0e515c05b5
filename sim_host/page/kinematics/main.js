import "../shared/theme.css";
import "./style.css";
import { pageData } from "../shared/data.js";
import { addControls } from "./controls.js";
import { addCurves } from "./curves.js";
import { Machine } from "./machine.js";
import { Player } from "./player.js";
import { Readout } from "./readout.js";
import { roomOf, View } from "./scene.js";
import { Trajectory } from "./trajectory.js";

const THICKNESS = 1 / 55;

const data = pageData();
const { joints, rows } = data;
const trajectory = new Trajectory(rows);
const room = roomOf(joints, trajectory, rows.tool_m);
const size = room.max.distanceTo(room.min);
const machine = new Machine(joints, rows.joints, THICKNESS * size);
const player = new Player(trajectory.start, trajectory.end);

/** Nothing where the browser has no WebGL: curves and values go on. */
function viewOrNothing() {
  const place = document.getElementById("view");
  try {
    return new View(place, machine, room, { tool: rows.tool_m, points_m: data.points_m });
  } catch {
    place.hidden = true;
    document.getElementById("no-view").hidden = false;
    return null;
  }
}

const view = viewOrNothing();
const readout = new Readout(joints);
document.getElementById("summary").textContent = data.summary;
document.getElementById("hint").textContent =
  (view ? `Drag to orbit, two fingers or the right button to move, wheel to zoom; one square of the grid is ${Number(view.gridStep_m.toPrecision(1))} m. ` : "") +
  "Space plays, arrow keys step, a click on a curve goes there.";
addControls(player, view);
addCurves(document.getElementById("charts"), data, trajectory, player);
player.onChange(() => {
  const values = trajectory.jointsAt(player.time);
  machine.pose(values);
  readout.show(values, machine.toolPosition());
  view?.showTrace(trajectory.rowAt(player.time) + 1);
  view?.draw();
});
player.seek(player.start);
