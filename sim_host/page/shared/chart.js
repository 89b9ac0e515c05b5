import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import "./chart.css";
import { shown } from "./number.js";
import { color, onThemeChange, seriesColor } from "./theme.js";

const charts = [];

function axis(options) {
  const grid = { stroke: color("line"), width: 1 };
  return { stroke: color("muted"), grid, ticks: grid, font: "12px system-ui", ...options };
}

/** As many decimals as the step between ticks has: however far one zooms in, no two ticks look alike. */
function stepTicks(_, ticks, __, ___, step) {
  let decimals = 0;
  while (decimals < 9 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6) ++decimals;
  return ticks.map((tick) => (tick == null ? null : String(Number(tick.toFixed(decimals)))));
}

/** The legend's values while nobody points anywhere; charts with a common time have that time's. */
const LAST_VALUES = { hooks: { ready: (plot) => plot.setLegend({ idx: plot.data[0].length - 1 }) } };

function optionsOf({ x, series, height, sync, plugins = [], scales = {}, adjust = (options) => options }, width) {
  return adjust({
    width,
    height,
    plugins: sync ? plugins : [...plugins, LAST_VALUES],
    scales: { x: { time: false }, ...scales },
    cursor: { sync: sync ? { key: sync } : undefined, drag: { x: false, y: false }, points: { size: 7 } },
    legend: { live: true },
    axes: [
      axis({ size: 30, space: 70, values: stepTicks }),
      axis({ size: 66, space: 26, values: (_, ticks) => ticks.map((tick) => shown(tick)) }),
    ],
    series: [
      { label: x, value: (_, value) => shown(value, 6) },
      ...series.map((one, index) => ({
        label: one.label,
        stroke: seriesColor(one.color ?? index),
        width: one.points ? 0 : 2,
        dash: one.dash,
        points: { show: Boolean(one.points), size: 6, fill: seriesColor(one.color ?? index) },
        spanGaps: false,
        value: (_, value) => shown(value, 6),
        ...one.more,
      })),
    ],
  });
}

/** What it shows, for who does not see it. */
function describe(plot, name) {
  plot.ctx.canvas.setAttribute("role", "img");
  plot.ctx.canvas.setAttribute("aria-label", name);
}

/** A line's name in the legend hides the line: by mouse, and by key. */
function addLegendKeys(plot) {
  const names = [...plot.root.querySelectorAll(".u-legend .u-series:not(:first-child) .u-label")];
  for (const [i, name] of names.entries()) {
    if (name.textContent === "") continue;
    const tell = () => name.setAttribute("aria-pressed", plot.series[i + 1].show);
    name.tabIndex = 0;
    name.setAttribute("role", "button");
    name.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      name.click();
    });
    plot.hooks.setSeries = [...(plot.hooks.setSeries ?? []), tell];
    tell();
  }
}

/**
 * A chart that follows the width of its place and the theme.
 * `description`: {title, x, y, series: [{label, color?, dash?, points?, more?}], height, sync?, plugins?, adjust?};
 * `more` and `adjust` are for uPlot's own options of a series and of the chart.
 * `hasLines`: false where a plugin draws all that there is, so that no line can be hidden.
 * `data`: uPlot's columns, x first, or a function that gives them for a width.
 */
export function addChart(place, description, data) {
  const figure = document.createElement("figure");
  figure.className = "chart";
  const heading = document.createElement("h2");
  heading.textContent = description.y === "1" ? description.title : `${description.title}, ${description.y}`;
  figure.setAttribute("aria-label", heading.textContent);
  const lines = description.series.map(({ label }) => label).filter(Boolean).join(", ");
  const body = document.createElement("div");
  figure.append(heading, body);
  place.append(figure);
  const columns = typeof data === "function" ? data : () => data;
  const chart = { plot: null, figure };
  const width = () => Math.max(240, Math.floor(body.clientWidth));
  const draw = () => {
    chart.plot?.destroy();
    chart.plot = new uPlot(optionsOf(description, width()), columns(width()), body);
    describe(chart.plot, `${heading.textContent} over ${description.x}: ${lines}`);
    if (description.hasLines !== false) addLegendKeys(chart.plot);
  };
  draw();
  new ResizeObserver(() => {
    if (chart.plot.width === width()) return;
    if (data !== columns) chart.plot.setSize({ width: width(), height: description.height });
    else draw();
  }).observe(body);
  charts.push(draw);
  return chart;
}

/** Calls back with x wherever the cursor stands in charts that share it. */
export function onCursor(sync, action) {
  const pub = (type, source, left) => {
    if (type === "mousemove" && left >= 0) action(source.posToVal(left, "x"));
  };
  uPlot.sync(sync).sub({ pub });
}

/** Puts the cursor of all charts that share it at x; nobody is called back. */
export function moveCursor(sync, x) {
  for (const plot of uPlot.sync(sync).plots) plot.setCursor?.({ left: plot.valToPos(x, "x"), top: 0 }, false, false);
}

onThemeChange(() => charts.forEach((draw) => draw()));
