import { Box3, Vector3 } from "three";
import { framesOf } from "./chain.js";

/** The room that the machine needs along its trajectory. */
export function roomOf(joints, trajectory, tool) {
  const room = new Box3().expandByPoint(new Vector3());
  const stride = Math.max(1, Math.floor(trajectory.times.length / 200));
  for (let row = 0; row < trajectory.times.length; row += stride) {
    const values = trajectory.columns.map((column) => column[row]);
    for (const frame of framesOf(joints, values)) room.expandByPoint(new Vector3().setFromMatrixPosition(frame));
  }
  tool[0].forEach((x, row) => room.expandByPoint(new Vector3(x, tool[1][row], tool[2][row])));
  return room;
}
