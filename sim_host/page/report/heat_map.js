import { shown } from "../shared/number.js";
import { element, spoken } from "./element.js";

const SIGNIFICANT = 0.01;
/** Ratio at which a cell has its darkest colour where none is larger; the scale is logarithmic. */
const DARKEST = 100;
/** Of the colour, in percent: text stays readable on it, light or dark. */
const STRONGEST = 65;
const REGIMES = {
  contact: { title: "Contact", name: ({ from }) => (from > 0 ? "in contact" : "in the air") },
  direction: { title: "Direction", name: ({ from }) => (from > 0 ? "forward" : "backward") },
  speed: { title: "Speed, rad/s or m/s" },
  temperature: { title: "Temperature, degC" },
  frequency: { title: "Frequency, Hz" },
  order: { title: "Order of the spindle's turn", name: ({ from }) => shown(from, 3) },
  time: { title: "Time, s" },
};
const range = ({ from, to }) => `${shown(from, 3)} .. ${shown(to, 3)}`;
/** A frequency or an order that stands alone, not a band: nothing between its ends could be read. */
const isLine = ({ by, from, to }) => (by === "frequency" || by === "order") && to > from && to - from < 0.05 * to;
const nameOf = (cell, regime) => (isLine(cell) ? `at ${shown((cell.from + cell.to) / 2)}` : (regime.name ?? range)(cell));

function cellOf(cell, regime) {
  const made = element("td", { className: "heat" },
    element("b", { text: shown(cell.residual_ratio, 3) }),
    element("span", { text: nameOf(cell, regime) }));
  made.classList.toggle("significant", cell.p_value < SIGNIFICANT);
  made.title = `p = ${shown(cell.p_value, 2)}`;
  made.dataset.ratio = cell.residual_ratio;
  made.dataset.line = isLine(cell);
  return made;
}

/** A stretch of time leads to it in all charts. */
function lead(cell, { from, to }, view) {
  cell.tabIndex = 0;
  cell.setAttribute("role", "button");
  cell.title += "; shows this time in all charts";
  cell.addEventListener("click", () => view.set(from, to));
  cell.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    view.set(from, to);
  });
  return cell;
}

function mapOf(by, balances, view) {
  const regime = REGIMES[by] ?? { title: by };
  const table = element("table", { className: "heatmap" }, element("caption", { text: regime.title }));
  const width = Math.max(...balances.map(({ cells }) => cells.filter((cell) => cell.by === by).length));
  for (const { balance, cells } of balances) {
    const row = table.insertRow();
    row.append(element("th", { scope: "row", text: spoken(balance) }));
    const own = cells.filter((cell) => cell.by === by);
    for (const cell of own) {
      const made = cellOf(cell, regime);
      row.append(by === "time" ? lead(made, cell, view) : made);
    }
    if (own.length < width)
      row.append(element("td", { className: "muted", colSpan: width - own.length, text: own.length ? "" : "–" }));
  }
  return table;
}

function overall(balances) {
  const table = element("table", { className: "heatmap" }, element("caption", { text: "Overall" }));
  for (const balance of balances) {
    const row = table.insertRow();
    row.append(element("th", { scope: "row", text: spoken(balance.balance) }));
    const one = (residual_ratio, name) =>
      cellOf({ residual_ratio, p_value: balance.significant && name === "refit" ? 0 : 1 }, { name: () => name });
    row.append(one(balance.residual_ratio, "refit"), one(balance.residual_ratio_after, "with effects"));
    if (balance.onset_s != null) row.append(element("td", { text: `from ${shown(balance.onset_s)} s on` }));
  }
  return table;
}

const LEGEND =
  "1 is a perfect model. An outlined cell is more than chance (p below 0.01, corrected for the number of cells). A cell " +
  "of time shows that time in all charts.";

/**
 * One scale for all maps, so that the largest residual is the darkest and the place of a gap is seen. A line is over the
 * noise of one frequency, and would leave no colour to the bands.
 */
function colour(cells) {
  const ratios = cells.map(({ dataset }) => Number(dataset.ratio) || 1);
  const darkest = Math.max(DARKEST, ...ratios.filter((_, i) => cells[i].dataset.line !== "true"));
  cells.forEach((cell, i) => {
    const share = Math.min(1, Math.log(Math.max(1, ratios[i])) / Math.log(darkest));
    cell.style.setProperty("--heat", `${Math.round(STRONGEST * share)}%`);
  });
}

/** Balances down, regimes across: one map per kind of regime. */
export function addHeatMap(place, where, view) {
  const evaluated = where.filter((balance) => balance.evaluated);
  const kinds = [...new Set(evaluated.flatMap(({ cells }) => cells.map(({ by }) => by)))];
  if (evaluated.length > 0) {
    const maps = [overall(evaluated), ...kinds.map((by) => mapOf(by, evaluated, view))];
    colour(maps.flatMap((map) => [...map.querySelectorAll(".heat")]));
    place.append(element("div", { className: "maps" }, ...maps.map((map) => element("div", { className: "map" }, map))),
      element("p", { className: "muted", text: LEGEND }));
  }
  for (const { balance, reason } of where.filter((one) => !one.evaluated))
    place.append(element("p", { className: "muted", text: `${spoken(balance)} is not evaluated: ${reason}.` }));
}
