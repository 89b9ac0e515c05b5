import { shown } from "../shared/number.js";
import { barOf, element, percent, spoken } from "./element.js";

const NONE = {
  no_gap: "No cause is needed: the datasheet's model explains the recording to its noise.",
  parameter_error: "No effect is missing: other values of the parameters explain the recording.",
  unexplained: "No effect of the catalogue explains the structure that is left.",
  insufficient_excitation: "Nothing moves enough to tell causes apart.",
};
const ALONE = "Nothing of the catalogue looks like it in this recording.";
const SEPARATE = "What separates it from look-alikes";

function causeOf(cause) {
  const aliases = cause.alias_set.filter((name) => name !== cause.effect);
  const sure = `confidence ${percent(cause.confidence, 0)}, evidence ${shown(cause.evidence, 3)}`;
  const size = `${shown(cause.magnitude)} ± ${shown(cause.standard_error, 2)} ${cause.unit}`;
  const made = element("li", { className: "cause" },
    element("div", { className: "line" },
      element("b", { text: spoken(cause.effect) }), element("span", { text: size })),
    element("div", { className: "line" }, barOf(cause.confidence), element("span", { text: sure })),
    element("p", { text: aliases.length > 0 ? `Could also be: ${aliases.map(spoken).join(", ")}.` : ALONE }),
    cause.other_causes
      ? element("p", { text: `Outside the catalogue, ${cause.other_causes} looks the same.` }) : null,
    cause.separate_by ? element("p", { className: "muted", text: `${SEPARATE}: ${cause.separate_by}` }) : null);
  made.dataset.effect = cause.effect;
  return made;
}

/** What structure without a name follows, balance by balance; nothing where it follows no signal. */
function followedBy({ follows }) {
  const balances = [...new Set(follows.map(({ balance }) => balance))];
  if (balances.length === 0) return null;
  return element("ul", { className: "follows" }, ...balances.map((balance) => {
    const signals = follows.filter((one) => one.balance === balance).map(({ signal }) => signal);
    return element("li", { text: `In ${spoken(balance)} it follows ${signals.join("; ")}.` });
  }));
}

/** From which size on each effect without a name would have had one. */
function limitsOf(notFound) {
  if (notFound.length === 0) return "";
  const words = ({ effect, detection_limit: limit, unit, needs }) =>
    `${spoken(effect)}: ${limit == null ? `not shown, it needs ${needs}` : `from ${shown(limit, 2)}${unit === "1" ? "" : ` ${unit}`} on`}`;
  return element("details", { className: "limits" },
    element("summary", { text: "What was not found, and from about which size on each alone would have been" }),
    element("ul", {}, ...notFound.map((one) => element("li", { text: words(one) }))));
}

/** Ranked causes with how sure they are. */
export function addCauses(place, { which, verdict, threshold, unexplained, not_found: notFound }) {
  if (which.length === 0) place.append(element("p", { text: NONE[verdict] ?? "" }));
  else place.append(element("ol", { className: "causes" }, ...which.map(causeOf)));
  if (verdict === "unexplained")
    place.append(element("p", {
      text: `${percent(unexplained.share)} of what the datasheet's model leaves has no name.`,
    }), followedBy(unexplained) ?? "");
  place.append(limitsOf(notFound));
  const { evidence, bootstrap_runs: runs, temperature } = threshold;
  if (evidence === 0) return;  // nothing was looked at
  const chance = `Chance reaches an evidence of ${shown(evidence, 3)} in this recording (${runs} runs); evidence ` +
    `counts 1/${shown(temperature, 3)} in odds.`;
  place.append(element("p", { className: "muted", text: chance }));
}
