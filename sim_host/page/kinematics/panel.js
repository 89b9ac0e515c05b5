import { Player } from "../shared/player.js";
import { ScenePanel } from "../shared/scene_panel.js";
import { Machine } from "./machine.js";
import { PathLine } from "./path_line.js";
import { Readout } from "./readout.js";
import { roomOf } from "./room.js";
import { Trajectory } from "./trajectory.js";

/** Thickness of a link as a share of the room that the machine needs. */
const THICKNESS = 1 / 55;
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5];

/** The machine in 3-D with its controls and values; one per page. Begins when the player is told a time. */
export function addMachinePanel(place, data) {
  const { joints, rows } = data;
  const trajectory = new Trajectory(rows);
  const room = roomOf(joints, trajectory, rows.tool_m);
  const size = room.max.distanceTo(room.min);
  const machine = new Machine(joints, rows.joints, THICKNESS * size);
  const path = new PathLine(rows.tool_m, data.points_m, size);
  const player = new Player(trajectory.start, trajectory.end);
  const panel = new ScenePanel(place, player, SPEEDS);
  const readout = new Readout(panel.readout, joints);
  panel.open(room, [path, machine]);
  player.onChange(() => {
    const values = trajectory.jointsAt(player.time);
    machine.pose(values);
    readout.show(values, machine.toolPosition());
    path.showTrace(trajectory.rowAt(player.time) + 1);
    panel.view?.draw();
  });
  return { player, trajectory };
}
