import "./panel.css";
import { addControls } from "./controls.js";
import { Machine } from "./machine.js";
import { Player } from "./player.js";
import { Readout } from "./readout.js";
import { roomOf, View } from "./scene.js";
import { Trajectory } from "./trajectory.js";

/** Thickness of a link as a share of the room that the machine needs. */
const THICKNESS = 1 / 55;

const MARKUP = `
<div id="view" tabindex="0" role="img" aria-label="The machine in 3-D; drag to orbit, wheel to zoom"></div>
<p id="no-view" class="warning" hidden>
This browser shows no 3-D (WebGL is off); the curves and values below work without it.</p>
<div class="controls">
<button id="play" class="primary" type="button">Play</button>
<input id="time" type="range" min="0" step="any" value="0" aria-label="Time in s">
<output id="clock" for="time"></output>
<label>Speed <select id="speed">
<option value="0.1">0.1 x</option>
<option value="0.25">0.25 x</option>
<option value="0.5">0.5 x</option>
<option value="1" selected>1 x</option>
<option value="2">2 x</option>
<option value="5">5 x</option>
</select></label>
<button id="fit" type="button">Fit view</button>
</div>
<div class="readout">
<table id="joints"></table>
<table id="tool"></table>
</div>
<p id="hint" class="muted"></p>
`;

/** Nothing where the browser has no WebGL: curves and values go on. */
function viewOrNothing(machine, room, data) {
  const place = document.getElementById("view");
  try {
    return new View(place, machine, room, { tool: data.rows.tool_m, points_m: data.points_m });
  } catch {
    place.hidden = true;
    document.getElementById("no-view").hidden = false;
    return null;
  }
}

function hintOf(view) {
  const keys = "With the picture in focus space plays, arrow keys step, Home and End go to the ends.";
  if (!view) return keys;
  const square = Number(view.gridStep_m.toPrecision(1));
  const mouse = "Drag to orbit, two fingers or the right button to move, wheel to zoom";
  return `${mouse}; one square of the grid is ${square} m. ${keys}`;
}

/** The machine in 3-D with its controls and values; one per page. Begins when the player is told a time. */
export function addMachinePanel(place, data) {
  place.insertAdjacentHTML("beforeend", MARKUP);
  const { joints, rows } = data;
  const trajectory = new Trajectory(rows);
  const room = roomOf(joints, trajectory, rows.tool_m);
  const machine = new Machine(joints, rows.joints, THICKNESS * room.max.distanceTo(room.min));
  const player = new Player(trajectory.start, trajectory.end);
  const view = viewOrNothing(machine, room, data);
  const readout = new Readout(joints);
  document.getElementById("hint").textContent = hintOf(view);
  addControls(place, player, view);
  player.onChange(() => {
    const values = trajectory.jointsAt(player.time);
    machine.pose(values);
    readout.show(values, machine.toolPosition());
    view?.showTrace(trajectory.rowAt(player.time) + 1);
    view?.draw();
  });
  return { player, trajectory };
}
