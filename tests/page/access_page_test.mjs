// The pages of recordings without a mouse, without eyes, and on paper.
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { closePages, DESKTOP, openPage, PATIENCE_MS, startBrowser } from "./browser.mjs";
import { differing, inkOf, picturesOf, shownTime, waitForCharts } from "./charts.mjs";
import { Folder } from "./program.mjs";

const PAGES = ["diagnose", "replay", "diff"];
/** A4 between margins of 10 mm, at 96 px an inch. */
const PAPER_PX = 717;

let browser;
let folder;
before(async () => {
  folder = new Folder();
  const simulate = (name, ...more) => folder.run("simulate", "--profile", "rich", "--duration", "3", "--out", name,
    "--progress", "off", ...more);
  simulate("run.csv", "--effect", "feed_coulomb_friction=6");
  simulate("other.csv", "--seed", "2");
  folder.run("diagnose", "run.csv", "--bootstrap", "0", "--report", "diagnose.html", "--progress", "off");
  folder.run("replay", "run.csv", "--report", "replay.html", "--progress", "off");
  folder.runWithStatus(["diff", "run.csv", "other.csv", "--report", "diff.html", "--progress", "off"]);
  browser = await startBrowser();
});
afterEach(closePages);
after(async () => {
  await browser?.close();
  folder?.remove();
});

async function openWith(name, options) {
  const { page, faults } = await openPage(browser, folder.file(`${name}.html`), options);
  await waitForCharts(page);
  return { page, faults };
}

/** What a browser does before it prints, then the page as wide as the paper. The charts as a printer gets them. */
async function printed(page) {
  const pictures = await page.evaluate(async () => {
    dispatchEvent(new Event("beforeprint"));
    // The charts draw behind the event; a printer does not wait for the next frame.
    await Promise.resolve();
    return [...document.querySelectorAll(".chart canvas")].map((canvas) => canvas.toDataURL());
  });
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize({ width: PAPER_PX, height: 1000 });
  return pictures;
}

for (const name of PAGES) {
  test(`${name} on paper: nothing beyond its edge, every chart there, as light as from a light screen`, async () => {
    const { page: dark, faults } = await openWith(name, { colorScheme: "dark" });
    const { page: light } = await openWith(name, { colorScheme: "light" });
    const onScreen = await picturesOf(dark);
    const onPaper = await printed(dark);
    const fromLight = await printed(light);
    assert.deepEqual(await dark.evaluate(() => {
      const width = document.documentElement.clientWidth;
      const isShown = (one) => one.getClientRects().length > 0;
      const beyond = [...document.querySelectorAll("main *, header *")].filter((one) => isShown(one) &&
        (one.getBoundingClientRect().right > width + 0.5 ||
          (getComputedStyle(one).overflowX !== "visible" && one.scrollWidth > one.clientWidth + 1)));
      return beyond.map((one) => `${one.tagName} ${one.className} ${one.textContent.slice(0, 40)}`);
    }), []);
    assert.equal(await dark.$$eval(".chart, .heatmap, tr", (all) =>
      all.filter((one) => !getComputedStyle(one.closest(".map") ?? one).breakInside.startsWith("avoid")).length), 0);
    for (const [i, ink] of (await inkOf(dark, ".chart")).entries()) assert.ok(ink > 0, `chart ${i} is empty`);
    assert.equal(await dark.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
    assert.ok(onPaper.length > 4);
    assert.equal((await differing(dark, onScreen, onPaper)).length, onPaper.length);
    assert.deepEqual(await differing(dark, fromLight, onPaper), []);
    assert.deepEqual(faults, []);
  });
}

test("a real print tells the page before it lays the paper out, and the screen is as it was afterwards", async () => {
  const { page } = await openWith("replay", { colorScheme: "dark" });
  const onScreen = await picturesOf(page);
  await page.evaluate(() => addEventListener("beforeprint", () => {
    globalThis.widest = Math.max(...[...document.querySelectorAll(".chart canvas")].map(({ clientWidth }) => clientWidth));
  }));
  const pages = (await page.pdf({ format: "A4" })).toString("latin1").match(/\/Type \/Page\b/g).length;
  assert.ok(pages >= 3 && pages <= 10, `${pages} pages`);
  const widest = await page.evaluate(() => globalThis.widest);
  assert.ok(widest > 600 && widest <= PAPER_PX, `${widest} px`);
  assert.equal(await page.evaluate(() => document.documentElement.className), "");
  // Charts are laid out anew one after the other; a busy machine takes a while for all.
  const deadline = Date.now() + PATIENCE_MS;
  let changed;
  do {
    changed = await differing(page, onScreen, await picturesOf(page));
  } while (changed.length > 0 && Date.now() < deadline);
  assert.deepEqual(changed, []);
});

/** Presses Tab from the top of the page to its end; what had the focus, in order. */
async function tabThrough(page) {
  await page.evaluate(() => {
    const wanted = "a[href], button:not([disabled]), select, input, summary, figure[tabindex], [role=button], #scene";
    const isShown = (one) => one.getClientRects().length > 0;
    globalThis.controls = [...document.querySelectorAll(wanted)].filter(isShown);
    globalThis.look = () => {
      const one = document.activeElement;
      if (one === document.body) return null;
      const { outlineStyle, outlineWidth } = getComputedStyle(one);
      const bar = document.getElementById("view");
      const isBelow = !one.closest("header, #view");
      return {
        at: globalThis.controls.indexOf(one),
        what: `${one.tagName} ${one.id} ${one.className} ${one.textContent.slice(0, 30)}`,
        name: one.getAttribute("aria-label") ?? (one.labels?.[0]?.textContent || one.textContent),
        isMarked: outlineStyle !== "none" && Number.parseFloat(outlineWidth) >= 2,
        isHidden: isBelow && one.getBoundingClientRect().bottom <= bar.getBoundingClientRect().bottom,
      };
    };
  });
  const seen = [];
  for (let i = 0; i < 600; ++i) {
    await page.keyboard.press("Tab");
    const one = await page.evaluate(() => globalThis.look());
    if (one === null) break;
    seen.push(one);
  }
  return { seen, count: await page.evaluate(() => globalThis.controls.length) };
}

function assertTabReachesAll({ seen, count }) {
  assert.ok(count > 20);
  const reached = seen.map(({ at }) => at).filter((at) => at >= 0);
  assert.deepEqual(reached, Array.from({ length: count }, (_, i) => i));
  for (const { what, name, isMarked, isHidden } of seen) {
    assert.ok(name.trim() !== "", `${what} has no name`);
    assert.ok(isMarked, `${what} does not show that it has the focus`);
    assert.ok(!isHidden, `${what} is behind the bar`);
  }
}

async function assertChartsAreSpoken(page) {
  const charts = await page.$$eval("canvas:not(#scene canvas)", (all) => all.map((canvas) =>
    [canvas.getAttribute("role"), canvas.getAttribute("aria-label"), canvas.closest("figure").querySelector("h2").textContent]));
  for (const [role, label, heading] of charts) {
    assert.equal(role, "img");
    assert.match(label, /^.+ over .+: .+$/);
    assert.ok(label.startsWith(heading), label);
  }
  assert.ok(charts.some(([, label]) => label.startsWith("Spindle speed, rad/s over time, s: ")), `${charts}`);
  assert.equal(await page.$$eval("img:not([alt]), input:not([aria-label])", (all) => all.length), 0);
}

for (const name of PAGES) {
  test(`${name} by Tab and for a screen reader: every control in its order, marked, named; charts say what they show`, async () => {
    const { page } = await openWith(name);
    await assertChartsAreSpoken(page);
    assertTabReachesAll(await tabThrough(page));
  });
}

test("space plays and pauses: on the picture, on the time and on the button", async () => {
  const { page } = await openWith("replay");
  await page.$eval("#machine", (section) => section.scrollIntoView());
  await page.selectOption("#speed", "0.1");
  const label = () => page.$eval("#play", ({ textContent }) => textContent);
  const time = () => page.$eval("#clock", ({ dataset }) => Number(dataset.value));
  for (const place of ["#scene", "#time", "#play"]) {
    await page.focus(place);
    const [start, top] = [await time(), await page.evaluate(() => scrollY)];
    await page.keyboard.press(" ");
    assert.equal(await label(), "Pause", place);
    await page.waitForFunction((before) => Number(document.getElementById("clock").dataset.value) > before, start);
    await page.keyboard.press(" ");
    assert.equal(await label(), "Play", place);
    const scrolled = Math.abs(await page.evaluate(() => scrollY) - top);
    assert.ok(scrolled < 0.2 * DESKTOP.height, "space does not turn the page");
  }
});

test("keys hide a line and lead to a cell's time", async () => {
  const { page } = await openWith("diagnose");
  const line = await page.$("#model .u-label[role=button]");
  assert.equal(await line.getAttribute("aria-pressed"), "true");
  for (const [key, state] of [["Enter", "false"], [" ", "true"]]) {
    await line.focus();
    await page.keyboard.press(key);
    assert.equal(await line.getAttribute("aria-pressed"), state);
    assert.equal(await line.evaluate((one) => one.closest("tr").classList.contains("u-off")), state === "false");
  }
  await page.focus(".heat[role=button]:last-of-type");
  await page.keyboard.press(" ");
  assert.notDeepEqual(await shownTime(page), [0, 3]);
});
