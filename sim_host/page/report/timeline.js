import { addChart } from "../shared/chart.js";
import { color } from "../shared/theme.js";
import { tableOf } from "../shared/table.js";
import { element } from "./element.js";
import { nameSpans, paintSpans, PHASES, spanAt, spans } from "./phases.js";
import { CURSOR, followView, timeOptions } from "./time_chart.js";

const ROW_PX = 30;
const POINTS = 2000;
const FIRST_EVENTS = 12;
const WHOLE = "No rows are missing.";
const NEVER_GATED = "The gate rejected no measurement.";
const NO_PHASES = "The recording holds neither contact nor a speed, so it does not tell what the machine was doing.";

function strips({ data, phases }) {
  const end = data.span.duration_s;
  const list = [];
  if (phases.length > 0)
    list.push({ title: "Phase", spans: phases, names: PHASES, fill: (value) => color(`phase-strong-${value}`) });
  if (data.states) {
    const { names } = data.states;
    list.push({ title: "Health", spans: spans(data.states, end), names,
      fill: (value) => color(`state-${names[value].toLowerCase().replaceAll("_", "-")}`) });
  }
  const flag = (title, source, yes) => {
    const list0 = spans(source, end).map((span) => ({ ...span, value: span.value === 0 ? null : 1 }));
    list.push({ title, spans: list0, names: ["", yes], fill: () => color("state-replace") });
  };
  if (data.gated) flag("Gate", data.gated, "a measurement was rejected");
  if (data.missing)
    flag("Dropouts", { ...data.missing, runs: data.missing.runs.map(([i, v]) => [i, v ?? 1]) }, "rows are missing");
  for (const strip of data.strips ?? []) flag(strip.title, strip, strip.meaning);
  return list.filter((strip) => strip.spans.some(({ value }) => value != null));
}

function nameAt({ spans: list, names }, time) {
  const value = spanAt(list, time)?.value;
  return value == null ? "–" : names[value];
}

const stripPlugin = (list) => ({
  hooks: {
    draw: (plot) => list.forEach((strip, i) => {
      const row = plot.bbox.height / list.length;
      paintSpans(plot, strip.spans, plot.bbox.top + (i + 0.15) * row, 0.7 * row, strip.fill);
      nameSpans(plot, strip.spans, plot.bbox.top + (i + 0.5) * row, (value) => strip.names[value]);
    }),
  },
});

function addStrips(place, list, context) {
  const { view } = context;
  const columns = () => {
    const times = Array.from({ length: POINTS + 1 }, (_, i) => view.from + (view.span * i) / POINTS);
    return [times, ...list.map(() => times.map(() => null))];
  };
  const adjust = (options) => {
    timeOptions(options, view);
    options.axes[1].splits = () => list.map((_, i) => list.length - i - 0.5);
    options.axes[1].values = () => list.map(({ title }) => title);
    options.axes[1].grid = { show: false };
    options.axes[1].ticks = { show: false };
    return options;
  };
  followView(place, view, () => {
    const drawn = addChart(place, {
      title: "What happened when", x: "time, s", y: "1", hasLines: false, height: ROW_PX * list.length + 50, sync: CURSOR,
      series: list.map((strip, i) => ({
        label: strip.title, color: 7,
        more: { points: { show: false },
          value: (plot, _, __, at) => (at == null ? "–" : nameAt(list[i], plot.data[0][at])) },
      })),
      scales: { y: { range: [0, list.length] } }, plugins: [stripPlugin(list)], adjust,
    }, columns);
    drawn.refresh = () => drawn.plot.setData(columns());
    return drawn;
  });
}

const EVENTS = [
  ["time, s", (event) => event.time_s.toFixed(4), true],
  ["state", (event) => event.state],
  ["code", (event) => event.reason],
  ["what it means", (event) => event.sentence],
  ["likely cause", (event) => event.cause],
  ["what to do", (event) => event.next_step],
];

function addEvents(place, { listed, changes }) {
  if (listed.length === 0) return;
  place.append(element("h3", { text: `Changes of state (${changes})` }),
    tableOf(EVENTS, listed.slice(0, FIRST_EVENTS)));
  if (listed.length === FIRST_EVENTS || changes <= FIRST_EVENTS) return;
  const rest = element("details", {}, element("summary", { text: `${listed.length - FIRST_EVENTS} more` }),
    tableOf(EVENTS, listed.slice(FIRST_EVENTS)));
  const unlisted = changes - listed.length;
  if (unlisted > 0) rest.append(element("p", { className: "muted", text: `The other ${unlisted} are not listed.` }));
  place.append(rest);
}

export const timeline = {
  id: "timeline",
  title: "Timeline",
  build(place, context) {
    if (!context.view) return false;
    const list = strips(context);
    const has = (title) => list.some((strip) => strip.title === title);
    if (list.length > 0) {
      const slot = element("div", { className: "slot" });
      place.append(slot);
      addStrips(slot, list, context);
    }
    const words = [];
    if (!has("Phase")) words.push(NO_PHASES);
    if (context.data.missing && !has("Dropouts")) words.push(WHOLE);
    if (context.data.gated && !has("Gate")) words.push(NEVER_GATED);
    if (words.length > 0) place.append(element("p", { className: "muted", text: words.join(" ") }));
    if (context.data.events) addEvents(place, context.data.events);
  },
};
