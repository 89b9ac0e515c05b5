import "../shared/theme.css";
import "./style.css";
import "./gap.css";
import { element } from "./element.js";
import { phaseLegend, phaseSpans } from "./phases.js";
import { SeriesStore } from "./series.js";
import { addViewBar, View } from "./view.js";

/** What sections are built from; without a recording there is no time, so neither view nor series. */
function contextOf(data, marks) {
  const { span } = data;
  return {
    data, result: data.result, command: data.command, marks,
    view: span && new View(span),
    store: new SeriesStore(data.series, span ? 1 / span.rate_hz : 1),
    phases: span ? phaseSpans(data.phases, span.duration_s) : [],
  };
}

function addSection({ id, title, build }, context) {
  const section = element("section", { className: "panel", id },
    element("h2", { className: "title", text: title }));
  const outcome = build(section, context);
  if (outcome === false) return;
  if (typeof outcome === "string") section.append(element("p", { className: "muted", text: outcome }));
  document.getElementById("sections").append(section);
  document.getElementById("contents").append(element("a", { href: `#${id}`, text: title }));
}

/**
 * Fills a page of a recording. `sections`: in order; `build` fills one, what it gives back: nothing or true, a
 * sentence on why there is nothing, or false. `header`: {title, subject, text}; `marks`: {x, label} in all charts.
 */
export function startPage(data, sections, { title, subject, text }, marks = []) {
  const context = contextOf(data, marks);
  document.title = `${title}: ${subject}`;
  document.getElementById("title").textContent = title;
  document.getElementById("recording").textContent = text;
  const bar = document.getElementById("view");
  if (context.view) addViewBar(bar, context.view, phaseLegend(context.phases));
  else bar.remove();
  for (const section of sections) addSection(section, context);
}
