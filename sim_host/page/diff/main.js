import "./style.css";
import { pageData } from "../shared/data.js";
import { reproduce } from "../report/reproduce.js";
import { startPage } from "../report/start.js";
import { timeline } from "../report/timeline.js";
import { comparison } from "./comparison.js";
import { overlays } from "./overlays.js";
import { verdict } from "./verdict.js";

const data = pageData();
const { a, b, kind } = data.result;

function sideText(name, side) {
  if (kind === "results") return `${name}: ${side.file}, ${side.values} values`;
  return `${name}: ${side.file}, ${side.rows} rows at ${side.rate_hz} Hz`;
}

startPage(data, [verdict, timeline, comparison, overlays, reproduce], {
  title: kind === "results" ? "Comparison of two results" : "Comparison of two recordings",
  subject: `${a.file} and ${b.file}`,
  text: `${sideText("A, the baseline", a)}. ${sideText("B", b)}.`,
});
