import "../shared/theme.css";
import "./style.css";
import "./gap.css";
import "./print.css";
import { pageData } from "../shared/data.js";
import { spoken } from "./element.js";
import { gap } from "./gap.js";
import { budget } from "./budget.js";
import { hypotheses, model, signals, wear } from "./chart_sections.js";
import { parameters } from "./parameters.js";
import { phaseLegend, phaseSpans } from "./phases.js";
import { reproduce } from "./reproduce.js";
import { residuals } from "./residuals.js";
import { SeriesStore } from "./series.js";
import { timeline } from "./timeline.js";
import { verdict } from "./verdict.js";
import { addViewBar, View } from "./view.js";

// What to do first, then what supports it.
const SECTIONS = [verdict, timeline, model, residuals, gap, hypotheses, parameters, wear, budget, signals, reproduce];
const TITLES = {
  diagnose: "Sim-to-real gap", replay: "Replay through the monitor", identify: "Identification",
};

const data = pageData();
const { recording } = data.result;
const view = new View(data.span);
const context = {
  data, view, result: data.result, command: data.command,
  store: new SeriesStore(data.series, 1 / data.span.rate_hz),
  phases: phaseSpans(data.phases, data.span.duration_s),
  marks: (data.result.where ?? []).filter(({ onset_s: onset }) => onset != null)
    .map(({ balance, onset_s: x }) => ({ x, label: `${spoken(balance)}: an effect sets in` })),
};

document.title = `${TITLES[data.command]}: ${recording.file}`;
document.getElementById("title").textContent = TITLES[data.command];
document.getElementById("recording").textContent =
  `${recording.file}: ${recording.rows} rows at ${recording.rate_hz} Hz, ${data.span.duration_s.toFixed(3)} s, ` +
  `from ${data.span.start_s} s on; ${recording.missing_rows} rows missing`;
addViewBar(document.getElementById("view"), view, phaseLegend(context.phases));

/** `build` fills the section; what it gives back: nothing or true, a sentence on why there is nothing, or false. */
for (const { id, title, build } of SECTIONS) {
  const section = Object.assign(document.createElement("section"), { className: "panel", id });
  section.append(Object.assign(document.createElement("h2"), { textContent: title, className: "title" }));
  const outcome = build(section, context);
  if (outcome === false) continue;
  if (typeof outcome === "string")
    section.append(Object.assign(document.createElement("p"), { className: "muted", textContent: outcome }));
  document.getElementById("sections").append(section);
  document.getElementById("contents").append(
    Object.assign(document.createElement("a"), { href: `#${id}`, textContent: title }));
}
