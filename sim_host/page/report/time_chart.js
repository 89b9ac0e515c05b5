import { addChart } from "../shared/chart.js";
import { shown } from "../shared/number.js";
import { color } from "../shared/theme.js";
import { limitPlugin, markPlugin, readableTicks, segmentPlugin, yScale } from "./limits.js";
import { phasePlugin } from "./phases.js";

/** The cursor that all charts over time share. */
export const CURSOR = "time";
const HEIGHT = 190;
const AXIS_PX = 80;
const COLORS = 8;
/** What a line is called decides how it looks, in every chart. */
const LOOKS = {
  measured: { color: 0 },
  commanded: { color: 7, dash: [8, 4] },
  datasheet: { color: 1, dash: [6, 3] },
  refit: { color: 4, dash: [2, 3] },
  B: { color: 1, dash: [6, 3] },
  "B − A": { color: 5 },
};
/** In these sections the last line is the best model that there is. */
const WITH_MODEL = ["model", "residuals", "free_run", "wear"];
const MODEL = { color: 2 };

function lookOf(label, index, lines, section) {
  if (WITH_MODEL.includes(section) && index + 1 === lines.length) return MODEL;
  return LOOKS[label] ?? { color: index, dash: index < COLORS ? undefined : [3, 3] };
}

const waiting = [];

/** One chart that is still waiting, whenever the browser has nothing better to do. */
function drawNext() {
  waiting.shift()?.();
  if (waiting.length > 0) later(drawNext);
}
const later = (action) => (globalThis.requestIdleCallback ?? setTimeout)(action);

/** Draws when it comes near the screen, else when there is time, and all of it before printing. */
function whenNear(place, draw) {
  let isDrawn = false;
  const once = () => {
    if (isDrawn) return;
    isDrawn = true;
    draw();
  };
  if (waiting.push(once) === 1) later(drawNext);
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    once();
  }, { rootMargin: "500px" });
  observer.observe(place);
  addEventListener("beforeprint", once);
}

/** Common to all charts over time: one cursor, drag and double click change the view of all of them. */
export function timeOptions(options, view) {
  options.axes[1].size = AXIS_PX;
  options.scales.x = { time: false, range: () => [view.from, view.to] };
  options.cursor.drag = { x: true, y: false, setScale: false };
  options.cursor.sync.filters = { pub: (type) => type === "mousemove" || type === "mouseleave" };
  options.cursor.bind = { dblclick: () => () => view.reset() };
  options.hooks = {
    setSelect: [(plot) => {
      const { left, width } = plot.select;
      if (width < 3) return;
      const [from, to] = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
      plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      view.set(from, to);
    }],
  };
  return options;
}

/** Registers a chart with the view; one that is not on the screen is brought up to date when it is seen again. */
export function followView(place, view, addIt) {
  whenNear(place, () => {
    const chart = addIt();
    chart.figure.tabIndex = 0;
    chart.figure.setAttribute("aria-describedby", "keys");
    let isNear = true;
    let isOld = false;
    const refresh = () => {
      isOld = !isNear;
      if (isNear) chart.refresh();
    };
    new IntersectionObserver(([entry]) => {
      isNear = entry.isIntersecting;
      if (isNear && isOld) refresh();
    }, { rootMargin: "300px" }).observe(place);
    addEventListener("beforeprint", () => {
      if (isOld) chart.refresh();
      isOld = false;
    });
    view.onChange(refresh);
  });
}

/** A band's two edges; the lower one is the next column. */
function edges(plot, _, column, at) {
  if (at == null || plot.data[column][at] == null) return "–";
  return `${shown(plot.data[column + 1][at])} .. ${shown(plot.data[column][at])}`;
}

function seriesOf(lines, bands, section) {
  const look = ({ label }, index) => lookOf(label, index, lines, section);
  const series = lines.map((line, index) => ({ label: line.label, ...look(line, index), more: { width: 1.25 } }));
  const edge = (label, more) => ({ label, color: 2, more: { width: 0, points: { show: false }, ...more } });
  for (const { label } of bands)
    series.push(edge(`± ${label}`, { value: edges }), edge("", { class: "other-edge" }));
  return series;
}

/** `chart`: as the program wrote it. False where there is nothing to draw. */
export function addTimeChart(place, chart, { store, view, phases, marks }) {
  const lines = chart.lines.map((id) => store.get(id)).filter(Boolean);
  const bands = chart.band && store.get(chart.band) ? [store.get(chart.band)] : [];
  if (lines.length === 0) return false;
  const slot = Object.assign(document.createElement("div"), { className: "slot" });
  slot.style.minHeight = `${HEIGHT + 60}px`;
  place.append(slot);
  const columns = (width) => store.columns(lines, bands, view.from, view.to, 1.5 * width);
  const adjust = (options) => {
    timeOptions(options, view);
    Object.assign(options.axes[1], readableTicks(chart.scale, "y"));
    const edge = lines.length + 1;
    options.bands = bands.map(() => ({ series: [edge, edge + 1], fill: color("band") }));
    return options;
  };
  followView(slot, view, () => {
    const drawn = addChart(slot, {
      title: chart.title, x: "time, s", y: chart.unit, height: HEIGHT, sync: CURSOR,
      series: seriesOf(lines, bands, chart.section), scales: { y: yScale(chart.scale, chart.limits) },
      plugins: [phasePlugin(phases), limitPlugin(chart.limits), markPlugin([...marks, ...chart.marks]),
        segmentPlugin(chart.segments)], adjust,
    }, columns);
    drawn.refresh = () => drawn.plot.setData(columns(drawn.plot.width));
    return drawn;
  });
  return true;
}

/** All charts that the program meant for a section. */
export function addTimeCharts(place, section, context) {
  const charts = context.data.charts.filter((chart) => chart.section === section);
  const grid = Object.assign(document.createElement("div"), { className: "charts" });
  place.append(grid);
  return charts.filter((chart) => addTimeChart(grid, chart, context)).length;
}
