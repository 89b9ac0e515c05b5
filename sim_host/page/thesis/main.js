import "../shared/theme.css";
import "./style.css";
import { addChart } from "../shared/chart.js";
import { pageData } from "../shared/data.js";
import { addMachinePanel } from "../kinematics/panel.js";
import { rangeText, tableOf } from "../shared/table.js";

const HEIGHT = 230;
const { figures, bank, animation } = pageData();

const COMPARISON = [
  ["quantity", (row) => (row.unit === "1" ? row.quantity : `${row.quantity}, ${row.unit}`)],
  ["printed", (row) => rangeText(row.printed), true],
  ["ours", (row) => rangeText(row.ours), true],
  ["difference", (row) => row.difference],
];
const milliseconds = (value) => (value === null ? "never" : value.toFixed(1));
const BANK_TEXT =
  "The thesis's rule, the smallest integral of the errors of angular acceleration and current, beside likelihoods and " +
  "the continuous chip load. Times in ms are those from which 95 % of the runs are right: nearer to the true chip " +
  "load than to any other hypothesis.";
const BANK = [
  ["machine", (row) => row.machine],
  ["noise", (row) => `${row.noise} x`, true],
  ["not as stated", (row) => row.mismatch || "–"],
  ["rule", (row) => row.rule],
  ["right after contact, ms", (row) => milliseconds(row.contact_ms), true],
  ["right after a change, ms", (row) => milliseconds(row.switch_ms), true],
  ["right at the end", (row) => `${Math.round(100 * row.right_share)} %`, true],
  ["error at the end, mm", (row) => row.mean_error_mm.toFixed(4), true],
];

/** A section with a heading, and its link above. */
function addSection(id, short, title) {
  const section = document.createElement("section");
  section.className = "panel figure";
  section.id = id;
  const heading = document.createElement("h2");
  heading.textContent = title;
  section.append(heading);
  document.getElementById("figures").append(section);
  const link = Object.assign(document.createElement("a"), { href: `#${id}`, textContent: short, title });
  document.getElementById("contents").append(link);
  return section;
}

function addText(section, text) {
  section.append(Object.assign(document.createElement("p"), { textContent: text }));
}

function addFigure(figure) {
  const section = addSection(`figure-${figure.figure}`, figure.figure,
    `Figure ${figure.figure} (${figure.section}): ${figure.title}`);
  for (const { title, unit, x_name, x, curves } of figure.charts) {
    const series = curves.map((curve) => ({ label: curve.label, dash: curve.dashed ? [6, 4] : undefined }));
    addChart(section, { title, x: x_name, y: unit, series, height: HEIGHT }, [x, ...curves.map((curve) => curve.y)]);
  }
  section.append(tableOf(COMPARISON, figure.comparisons));
  addText(section, figure.remark);
}

/** Figure 18 is the machine itself. */
function addAnimation() {
  const section = addSection("figure-18", 18,
    "Figure 18 (3.4): Trajectory in the operational space travelled by the robot");
  section.classList.add("wide");
  const { player } = addMachinePanel(section, animation);
  addText(section,
    "The path of figure 13, which the tool follows by the joints of figure 17: the picture is computed from them.");
  player.seek(player.start);
}

for (const figure of figures) {
  addFigure(figure);
  if (figure.figure === 17) addAnimation();
}
if (bank.length > 0) {
  const section = addSection("bank", "bank", "Filter bank and decision (4.4)");
  section.classList.add("wide");
  addText(section, BANK_TEXT);
  section.append(tableOf(BANK, bank));
}
