const dark = matchMedia("(prefers-color-scheme: dark)");

/** A colour of theme.css, as it is now. */
export function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Eight colours that can be told apart on both backgrounds, also by the colour-blind. */
export function seriesColor(index) {
  return color(`series-${index % 8}`);
}

/** Calls back whenever light turns to dark or back. */
export function onThemeChange(action) {
  dark.addEventListener("change", action);
}
