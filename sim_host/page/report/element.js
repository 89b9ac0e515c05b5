/** An element with text and children. */
export function element(tag, { className, text, ...more } = {}, ...children) {
  const made = Object.assign(document.createElement(tag), more);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** "12.3 %" */
export function percent(share, digits = 1) {
  return share == null ? "–" : `${(100 * share).toFixed(digits)} %`;
}

/** The same for a style sheet, within 0 .. 100 %. */
export function width(share) {
  return `${(100 * Math.min(1, Math.max(0, share))).toFixed(2)}%`;
}

/** A bar that is so long a part of its place. */
export function barOf(share, className = "") {
  const bar = element("div", { className: `bar ${className}` }, element("i"));
  bar.style.setProperty("--share", width(share));
  return bar;
}

/** The same with what it may be by its uncertainty, from `low` to `high`. */
export function barWithInterval(share, [low, high], className) {
  const bar = barOf(share, className);
  bar.append(element("u"));
  bar.style.setProperty("--low", width(low));
  bar.style.setProperty("--high", width(high));
  return bar;
}

/** A name with underscores as people read it. */
export function spoken(name) {
  return name.replaceAll("_", " ");
}
