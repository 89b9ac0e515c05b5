import "./paper.css";

const dark = matchMedia("(prefers-color-scheme: dark)");
const root = document.documentElement;
const listeners = [];
/** Of a section that is not torn: less than a page of A4 or Letter has room for. */
const PAGE_PX = 900;

/** A colour of theme.css, as it is now. */
export function color(name) {
  return getComputedStyle(root).getPropertyValue(`--${name}`).trim();
}

/** Eight colours that can be told apart on both backgrounds, also by the colour-blind. */
export function seriesColor(index) {
  return color(`series-${index % 8}`);
}

/** Calls back whenever light turns to dark or back; paper is light, whatever the screen is. */
export function onThemeChange(action) {
  listeners.push(action);
}

const tell = () => listeners.forEach((action) => action());
dark.addEventListener("change", tell);

addEventListener("beforeprint", () => {
  root.classList.add("paper");
  for (const section of document.querySelectorAll("section"))
    section.classList.toggle("whole", section.offsetHeight < PAGE_PX);
  tell();
});
addEventListener("afterprint", () => {
  root.classList.remove("paper");
  tell();
});
