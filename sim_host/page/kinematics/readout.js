function addRow(table, name, unit, color) {
  const row = table.insertRow();
  const label = document.createElement("th");
  label.scope = "row";
  if (color) {
    const swatch = Object.assign(document.createElement("span"), { className: "swatch" });
    swatch.style.background = color;
    label.append(swatch);
  }
  label.append(name);
  row.append(label);
  const value = row.insertCell();
  value.className = "number";
  row.insertCell().textContent = unit;
  return value;
}

function show(cell, value) {
  cell.textContent = value.toFixed(4);
  cell.dataset.value = value;
}

/** The joints, and where the drawn tool is. */
export class Readout {
  constructor(joints) {
    const [jointTable, toolTable] = ["joints", "tool"].map((id) => document.getElementById(id));
    this.joints = joints.map((joint, i) =>
      addRow(jointTable, joint.name, joint.unit, `var(--series-${i})`));
    this.tool = ["x", "y", "z"].map((axis) => addRow(toolTable, `tool ${axis}`, "m"));
  }

  show(values, tool) {
    this.joints.forEach((cell, i) => show(cell, values[i]));
    this.tool.forEach((cell, i) => show(cell, tool.getComponent(i)));
  }
}
