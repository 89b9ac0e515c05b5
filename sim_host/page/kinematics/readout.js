import { addValue, showValue } from "../shared/readout.js";

const tableIn = (place, id) => {
  const table = Object.assign(document.createElement("table"), { id });
  place.append(table);
  return table;
};

/** The joints, and where the drawn tool is. */
export class Readout {
  constructor(place, joints) {
    const [jointTable, toolTable] = ["joints", "tool"].map((id) => tableIn(place, id));
    this.joints = joints.map((joint, i) => addValue(jointTable, joint.name, joint.unit, `var(--series-${i})`));
    this.tool = ["x", "y", "z"].map((axis) => addValue(toolTable, `tool ${axis}`, "m"));
  }

  show(values, tool) {
    this.joints.forEach((cell, i) => showValue(cell, values[i]));
    this.tool.forEach((cell, i) => showValue(cell, tool.getComponent(i)));
  }
}
