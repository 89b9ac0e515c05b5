// How soon a page of a recording answers: no test, because a busy machine is no fault of the page.
// usage: node timing.mjs PAGE.html
// Opens the page five times, without a cache, and presses "Zoom in" as soon as it can be pressed; prints medians in ms since
// the browser began to load. Status 1 where that takes longer than a second. The browser's driver is that of the page tests.
import { statSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
process.env.MOREPRO_PAGE_MODULES ??= resolve(here, "../../build/host/tests/page/node_modules");
process.env.MOREPRO_BROWSER ??= "/usr/bin/chromium";
const { closePages, openPage, startBrowser } = await import("./browser.mjs");

const TIMES = 5;
const LIMIT_MS = 1000;

/** Runs in the page, before anything of it. */
function watch() {
  const times = {};
  globalThis.times = times;
  const shown = () => document.getElementById("shown")?.textContent;
  const look = () => {
    const before = shown();
    if (before && !times.answers) {
      document.querySelector("#view [aria-label='Zoom in']").click();
      if (shown() !== before) times.answers = performance.now();
    }
    const slots = [...document.querySelectorAll(".slot")];
    const drawn = slots.filter((slot) => slot.querySelector("canvas"));
    if (drawn.length > 0) times.chart ??= performance.now();
    if (times.answers && drawn.length === slots.length) times.all = performance.now();
    else setTimeout(look, 5);
  };
  look();
}

const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

const file = resolve(process.argv[2] ?? "");
if (!process.argv[2]) throw new Error("usage: node timing.mjs PAGE.html");
const browser = await startBrowser();
try {
  const runs = [];
  for (let i = 0; i < TIMES; ++i) {
    const { page } = await openPage(browser, file, { onStart: watch });
    await page.waitForFunction(() => globalThis.times.all);
    runs.push(await page.evaluate(() => globalThis.times));
    await closePages();
  }
  const of = (name) => Math.round(median(runs.map((run) => run[name])));
  console.log(`${(statSync(file).size / 1e6).toFixed(2)} MB: answers after ${of("answers")} ms, first chart after ` +
    `${of("chart")} ms, all charts after ${of("all")} ms`);
  process.exitCode = of("answers") <= LIMIT_MS ? 0 : 1;
} finally {
  await browser.close();
}
