import "./table.css";
import { shown } from "./number.js";

/** "0.22 .. 0.77", "1.45" or a dash. */
export function rangeText(range) {
  if (!range) return "–";
  const [low, high] = range;
  return low === high ? shown(low) : `${shown(low)} .. ${shown(high)}`;
}

/** A table in a frame that scrolls where it is too wide. `columns`: [heading, text of a row, is a number]. */
export function tableOf(columns, rows) {
  const table = document.createElement("table");
  const head = table.createTHead().insertRow();
  for (const [heading, , isNumber] of columns) {
    const cell = document.createElement("th");
    cell.scope = "col";
    cell.textContent = heading;
    if (isNumber) cell.className = "number";
    head.append(cell);
  }
  const body = table.createTBody();
  for (const row of rows) {
    const line = body.insertRow();
    for (const [, text, isNumber] of columns) {
      const cell = line.insertCell();
      cell.textContent = text(row);
      if (isNumber) cell.className = "number";
    }
  }
  const frame = document.createElement("div");
  frame.className = "table";
  frame.append(table);
  return frame;
}
