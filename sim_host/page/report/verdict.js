import { shown } from "../shared/number.js";
import { element, percent, spoken } from "./element.js";

/** Colour and sign; nobody has to see the colour. */
const MOODS = {
  no_gap: "good", HEALTHY: "good", identified: "good",
  parameter_error: "watch", WATCH: "watch", partly_identified: "watch", effect: "watch",
  same: "good", differs: "bad", unexplained: "bad", REPLACE: "bad", SENSOR_FAULT: "bad", MODEL_GAP: "bad",
};
const SIGNS = { good: "✓", watch: "!", bad: "✕", unknown: "?" };

function gapEvidence({ where, which, shrinkage, missing }) {
  const list = where.filter(({ evaluated }) => evaluated)
    .sort((a, b) => b.residual_ratio - a.residual_ratio).slice(0, 1)
    .map((b) => `Largest residual: ${spoken(b.balance)}, ${shown(b.residual_ratio)} times the noise floor after the ` +
      `refit${which.length > 0 ? `, ${shown(b.residual_ratio_after)} with the effects` : ""}.`);
  for (const cause of which)
    list.push(`${spoken(cause.effect)} = ${shown(cause.magnitude)} ± ${shown(cause.standard_error, 2)} ` +
      `${cause.unit}, confidence ${percent(cause.confidence, 0)}` +
      (cause.alias_set.length > 1 ? `, or ${cause.alias_set.slice(1).map(spoken).join(" or ")}` : "") + ".");
  if (which.length > 0)
    list.push(`${percent(shrinkage.share_closed)} of the gap is closed on held-out data ` +
      `(90 %: ${percent(shrinkage.ci90[0])} .. ${percent(shrinkage.ci90[1])}).`);
  return list;
}

function replayEvidence({ health, chip_load_mm: chip, frames, gap }) {
  const list = [`Likely cause: ${health.likely_cause}`, `Next step: ${health.next_step}`];
  if (chip.state === "valid")
    list.push(`The torque looks like a chip load of ${shown(chip.estimate)} ± ${shown(chip.standard_error, 2)} mm ` +
      `at ${shown(chip.time_s, 6)} s.`);
  list.push(`Frames: ${frames.accepted} accepted, ${frames.rejected} rejected, ${frames.missing} missing.`);
  list.push(`Difference between machine and model: ${spoken(gap.verdict)}` +
    (gap.effect ? `, ${spoken(gap.effect)} with confidence ${percent(gap.confidence, 0)}.` : "."));
  return list;
}

function identificationEvidence({ parameters, excitation, fit = [] }) {
  const known = parameters.filter(({ identifiable }) => identifiable).length;
  const list = [`${known} of ${parameters.length} parameters identified to better than 5 %.`];
  if (excitation.advice) list.push(`To know more: ${excitation.advice}.`);
  for (const axis of fit)
    list.push(`${spoken(axis.axis)}: mean squared innovation ${shown(axis.innovation_ratio)} in units of the ` +
      "sensors' noise (1 is a perfect model).");
  return list;
}

/** The verdict as the JSON has it, a sentence, and what it rests on. */
function verdictOf({ command, result }) {
  if (command === "diagnose")
    return { state: result.verdict, sentence: result.explanation, evidence: gapEvidence(result) };
  if (command === "replay")
    return { state: result.health.state, sentence: result.health.reason, evidence: replayEvidence(result) };
  const state = result.parameters.every(({ identifiable }) => identifiable) ? "identified"
    : result.parameters.some(({ identifiable }) => identifiable) ? "partly_identified" : "not_identified";
  const sentence = result.excitation.sufficient
    ? "The recording tells all that its signals can tell."
    : "The recording does not tell every parameter that its signals could.";
  return { state, sentence, evidence: identificationEvidence(result) };
}

function sentenceOf(text) {
  const whole = text.charAt(0).toUpperCase() + text.slice(1);
  return /[.!?]$/.test(whole) ? whole : `${whole}.`;
}

/** `outcomeOf`: {state, sentence, evidence} of what sections are built from. */
export function verdictSection(outcomeOf) {
  return {
    id: "verdict",
    title: "Verdict",
    build(place, context) {
      const { state, sentence, evidence } = outcomeOf(context);
      const mood = MOODS[state] ?? "unknown";
      const badge = element("span", { className: `badge ${mood}` },
        element("b", { text: SIGNS[mood], ariaHidden: "true" }), spoken(state).toUpperCase());
      badge.dataset.verdict = state;
      place.append(
        element("p", { className: "strip" }, badge,
          element("span", { className: "sentence", text: sentenceOf(sentence) })),
        element("ul", {}, ...evidence.map((text) => element("li", { text: sentenceOf(text) }))));
    },
  };
}

export const verdict = verdictSection(verdictOf);
