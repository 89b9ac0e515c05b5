import { addChart } from "../shared/chart.js";
import { element, percent } from "./element.js";
import { limitPlugin, markPlugin, readableTicks, yScale } from "./limits.js";
import { addTimeCharts } from "./time_chart.js";

const HEIGHT = 190;
const HARMONICS = 2;
const STEADY = 0.05;
const TEXT =
  "What the model did not expect. Where it is right, innovations are white and of unit variance; the monitor rejects " +
  "a measurement beyond the gate.";

const look = ({ label }, index, all) => {
  const isBefore = index + 1 < all.length;
  return { label, color: isBefore ? 1 : 2, dash: isBefore ? [6, 3] : undefined, more: { width: 1.25 } };
};

function marksOf(turning) {
  if (!turning) return [];
  const { mean_hz: f, teeth } = turning;
  const orders = new Map();
  for (let k = 1; k <= HARMONICS; ++k) {
    orders.set(k, `${k} x spindle`);
    if (k * teeth > HARMONICS) orders.set(k * teeth, `${k} x teeth`);
  }
  return [...orders].map(([order, label]) => ({ x: order * f, label }));
}

/** These have no time: each zooms for itself. */
function zoomable(options) {
  options.cursor.drag = { x: true, y: false };
  return options;
}

function spectral(options) {
  Object.assign(options.axes[0], readableTicks("log", "x"));
  Object.assign(options.axes[1], readableTicks("log", "y"));
  options.scales.x.distr = 3;
  return zoomable(options);
}

function addSpectrum(place, { title, spectra }, rate, marks) {
  const known = spectra.filter(({ power }) => power.length > 0);
  if (known.length === 0) return;
  const bins = known[0].power.length;
  const hertz = Array.from({ length: bins - 1 }, (_, i) => ((i + 1) * rate) / (2 * (bins - 1)));
  const white = [{ value: 1, label: "white" }];
  addChart(place, {
    title: `${title}: spectrum of the innovations`, x: "frequency, Hz", y: "1 is white", height: HEIGHT,
    series: known.map(look), scales: { y: yScale("log", white) },
    plugins: [limitPlugin(white), markPlugin(marks)], adjust: spectral,
  }, [hertz, ...known.map(({ power }) => power.slice(1))]);
}

function addAutocorrelation(place, { title, autocorrelations }) {
  const known = autocorrelations.filter(({ value }) => value.length > 0);
  if (known.length === 0) return;
  const lags = known[0].value.slice(1).map((_, i) => i + 1);
  const { bound } = known.at(-1);
  const limits = [{ value: bound, label: "95 % if white" }, { value: -bound, label: "" }];
  addChart(place, {
    title: `${title}: autocorrelation of the innovations`, x: "lag, samples", y: "1", height: HEIGHT,
    series: known.map(look), scales: { y: yScale("linear", limits) }, plugins: [limitPlugin(limits)],
    adjust: zoomable,
  }, [lags, ...known.map(({ value }) => value.slice(1))]);
}

/** Autocorrelation and spectrum are means over unbroken pieces. */
const BROKEN = "No unbroken piece is long enough for a spectrum or an autocorrelation: they need 2048 samples.";
const hasSpectrum = (sensors) => sensors.some(({ spectra }) => spectra.some(({ power }) => power.length > 0));

function speedText({ mean_hz: f, spread, teeth }) {
  const steady = spread < STEADY ? "" : ` It varied by ${percent(spread, 0)}, so lines of the spindle are blurred.`;
  const tool = teeth > 0 ? `, of its ${teeth} teeth` : "";
  return `Upright lines: multiples of the spindle's mean ${f.toFixed(1)} Hz${tool}.${steady}`;
}

export const residuals = {
  id: "residuals",
  title: "Residuals",
  build(place, context) {
    const { data } = context;
    place.append(element("p", { className: "muted", text: TEXT }));
    if (addTimeCharts(place, "residuals", context) === 0) return "There is no model to compare with: see above.";
    const grid = element("div", { className: "charts" });
    place.append(grid);
    // After the section has its place: charts measure their width.
    requestAnimationFrame(() => {
      for (const sensor of data.whiteness ?? []) {
        addSpectrum(grid, sensor, data.span.rate_hz, marksOf(data.turning));
        addAutocorrelation(grid, sensor);
      }
    });
    const lines = data.turning ? speedText(data.turning) : "";
    place.append(element("p", { className: "muted", text: hasSpectrum(data.whiteness ?? []) ? lines : BROKEN }));
    return true;
  },
};
