import { pageData } from "../shared/data.js";
import { budget } from "./budget.js";
import { hypotheses, model, signals, wear } from "./chart_sections.js";
import { spoken } from "./element.js";
import { gap } from "./gap.js";
import { machine } from "./machine.js";
import { parameters } from "./parameters.js";
import { reproduce } from "./reproduce.js";
import { residuals } from "./residuals.js";
import { startPage } from "./start.js";
import { timeline } from "./timeline.js";
import { verdict } from "./verdict.js";

// What to do first, then what supports it.
const SECTIONS = [
  verdict, timeline, model, residuals, gap, hypotheses, parameters, wear, budget, signals, machine, reproduce,
];
const TITLES = {
  diagnose: "Sim-to-real gap", replay: "Replay through the monitor", identify: "Identification",
};

const data = pageData();
const { recording, where = [] } = data.result;
const marks = where.filter(({ onset_s: onset }) => onset != null)
  .map(({ balance, onset_s: x }) => ({ x, label: `${spoken(balance)}: an effect sets in` }));
startPage(data, SECTIONS, {
  title: TITLES[data.command],
  subject: recording.file,
  text: `${recording.file}: ${recording.rows} rows at ${recording.rate_hz} Hz, ${data.span.duration_s.toFixed(3)} s, ` +
    `from ${data.span.start_s} s on; ${recording.missing_rows} rows missing`,
}, marks);
