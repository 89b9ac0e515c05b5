// Pictures of parts of a page, as a reader sees them.
// usage: node pictures.mjs PAGE.html FOLDER PART...
// A part is a section by its id (verdict, gap, ...) or a piece of one by the first word of its heading (gap:Where).
// Writes FOLDER/<part>.png. The browser's driver is that of the page tests, from build/host.
import { mkdirSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
process.env.MOREPRO_PAGE_MODULES ??= resolve(here, "../../build/host/tests/page/node_modules");
process.env.MOREPRO_BROWSER ??= "/usr/bin/chromium";
const { openPage, startBrowser } = await import("./browser.mjs");

const SIZE = { width: 900, height: 800 };
const MARGIN_PX = 8;

/** Where a part is on the page; null: nowhere. A piece reaches from its heading to the next one. */
function placeOf([section, word]) {
  const whole = document.getElementById(section);
  if (!whole) return null;
  const { left: x, right, top, bottom } = whole.getBoundingClientRect();
  if (!word) return { x, y: top, width: right - x, height: bottom - top };
  const headings = [...whole.querySelectorAll("h3")];
  const i = headings.findIndex(({ textContent }) => textContent.split(/\W/)[0] === word);
  if (i < 0) return null;
  const y = headings[i].getBoundingClientRect().top;
  const end = headings[i + 1]?.getBoundingClientRect().top ?? bottom;
  return { x, y, width: right - x, height: end - y };
}

async function find(page, part) {
  const at = await page.evaluate(placeOf, part.split(":"));
  if (!at) throw new Error(`the page has no part '${part}'`);
  return at;
}

async function take(page, part, path) {
  const at = await find(page, part);
  await page.screenshot({ path, fullPage: true, clip: { ...at, y: at.y - MARGIN_PX } });
  console.log(path);
}

const [file, folder, ...parts] = process.argv.slice(2);
if (parts.length === 0) throw new Error("usage: node pictures.mjs PAGE.html FOLDER PART...");
mkdirSync(folder, { recursive: true });
const browser = await startBrowser();
try {
  const { page, faults } = await openPage(browser, resolve(file), { size: SIZE });
  // What is not there is said before anything is drawn.
  for (const part of parts) await find(page, part);
  await page.waitForFunction(() =>
    [...document.querySelectorAll(".slot")].every((slot) => slot.querySelector("canvas")));
  // The bar with the buttons follows the reader and would cover what is below it.
  await page.addStyleTag({ content: "#view { display: none }" });
  for (const part of parts)
    await take(page, part, join(folder, `${part.replace(":", "_").toLowerCase()}.png`));
  if (faults.length > 0) throw new Error(faults.join("\n"));
} finally {
  await browser.close();
}
