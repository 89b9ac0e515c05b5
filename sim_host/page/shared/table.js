import "./table.css";
import { shown } from "./number.js";

/** "0.22 .. 0.77", "1.45" or a dash. */
export function rangeText(range) {
  if (!range) return "–";
  const [low, high] = range;
  return low === high ? shown(low) : `${shown(low)} .. ${shown(high)}`;
}

/** Words on the row above, as wide as the table: in a column of their own they are too narrow to be read. */
function addNote(body, columns, text) {
  const line = body.insertRow();
  line.className = "note";
  const cell = line.insertCell();
  cell.colSpan = columns.length;
  cell.textContent = text;
}

/**
 * A table in a frame that scrolls where it is too wide. `columns`: [heading, text of a row, is a number];
 * `note`: a sentence on a row, or nothing.
 */
export function tableOf(columns, rows, note = () => "") {
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
    const words = note(row);
    if (words) addNote(body, columns, words);
  }
  const frame = document.createElement("div");
  frame.className = "table";
  frame.append(table);
  return frame;
}
