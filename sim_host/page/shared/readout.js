/** A row of a table of values: name, with a mark of a colour where `mark` is there, value, unit. Gives its cell. */
export function addValue(table, name, unit, mark) {
  const row = table.insertRow();
  const label = document.createElement("th");
  label.scope = "row";
  if (mark) {
    const swatch = Object.assign(document.createElement("span"), { className: "swatch" });
    swatch.style.background = mark;
    label.append(swatch);
  }
  label.append(name);
  row.append(label);
  const value = row.insertCell();
  value.className = "number";
  row.insertCell().textContent = unit;
  return value;
}

/** null: there is none. */
export function showValue(cell, value, digits = 4) {
  cell.textContent = value == null ? "–" : value.toFixed(digits).replace(/^-(?=[0.]+$)/, "");
  cell.dataset.value = value;
}
