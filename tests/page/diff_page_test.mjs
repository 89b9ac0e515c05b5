// The page of a comparison: two recordings over each other with their difference, two results as a table.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { after, afterEach, before, test } from "node:test";
import { closePages, DESKTOP, openPage, startBrowser, TABLET } from "./browser.mjs";
import { columnOf, hover, inkOf, pageSeries, shownTime, waitForCharts } from "./charts.mjs";
import { Folder, tableOf } from "./program.mjs";

const MOST_BYTES = 3e6;
const SECONDS = 2;
/** B is different on purpose: force off in a stretch, a spindle that is a percent fast, rows that are missing. */
const FORCE = { from: 1, to: 1.02, add_n: 5 };
const FAST = { from: 1.5, factor: 1.01 };
const DROPOUT = [1.7, 1.8];
const TOLERANCE = { absolute: 0.001, relative: 0.002 };

let browser;
let folder;

function changed(text) {
  const lines = text.split("\n");
  const header = lines.findIndex((line) => line.startsWith("time_s"));
  const names = lines[header].split(",");
  const [force, speed] = ["feed_force_n", "spindle_speed_rad_s"].map((name) => names.indexOf(name));
  return lines.map((line, i) => {
    const fields = line.split(",");
    const time = Number(fields[0]);
    if (i <= header || line === "") return line;
    if (time >= DROPOUT[0] && time < DROPOUT[1]) return null;
    if (time >= FORCE.from && time < FORCE.to) fields[force] = String(Number(fields[force]) + FORCE.add_n);
    if (time >= FAST.from) fields[speed] = String(Number(fields[speed]) * FAST.factor);
    return fields.join(",");
  }).filter((line) => line !== null).join("\n");
}

before(async () => {
  folder = new Folder();
  folder.run("simulate", "--profile", "cutting", "--duration", String(SECONDS), "--out", "a.csv", "--progress", "off");
  folder.write("b.csv", changed(folder.read("a.csv")));
  folder.run("replay", "a.csv", "--json", "replay_a.json", "--progress", "off");
  folder.run("replay", "b.csv", "--json", "replay_b.json", "--progress", "off");
  const diff = (name, ...words) => folder.runWithStatus(["diff", ...words, "--report", `${name}.html`, "--json",
    `${name}.json`, "--progress", "off"]);
  assert.equal(diff("differs", "a.csv", "b.csv", "--abs-tol", String(TOLERANCE.absolute), "--rel-tol",
    String(TOLERANCE.relative)), 1);
  assert.equal(diff("same", "a.csv", "a.csv"), 0);
  assert.equal(diff("results", "replay_a.json", "replay_b.json", "--rel-tol", "0.001"), 1);
  browser = await startBrowser();
});
afterEach(closePages);
after(async () => {
  await browser?.close();
  folder?.remove();
});

const open = (name, options) => openPage(browser, folder.file(`${name}.html`), options);
const json = (name) => JSON.parse(folder.read(`${name}.json`));

const SECTIONS = {
  differs: ["verdict", "timeline", "comparison", "signals", "reproduce"],
  same: ["verdict", "timeline", "comparison", "signals", "reproduce"],
  results: ["verdict", "comparison", "reproduce"],
};
const LOOKS = {
  differs: { size: TABLET, colorScheme: "dark" },
  same: { size: DESKTOP, colorScheme: "light" },
  results: { size: TABLET, colorScheme: "light" },
};

for (const name of Object.keys(SECTIONS)) {
  test(`${name}: the sections, the JSON's verdict and signals, nothing too wide, no network`, async () => {
    const { page, faults } = await open(name, LOOKS[name]);
    await waitForCharts(page);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} px beyond ${LOOKS[name].size.width}`);
    assert.equal(await page.$$eval(".table", (all) => all.filter((one) => one.scrollWidth > one.clientWidth).length), 0);
    const colors = await page.$$eval(".u-legend td", (all) => [...new Set(all.map((one) => getComputedStyle(one).color))]);
    assert.ok(colors.length <= 1, "the colour of a verdict is not that of a legend's value");
    assert.deepEqual(await page.$$eval("section", (all) => all.map(({ id }) => id)), SECTIONS[name]);
    const result = json(name);
    assert.equal(await page.$eval(".badge", ({ dataset }) => dataset.verdict),
      result.within_tolerance ? "same" : "differs");
    assert.ok((await page.$eval("#verdict", (section) => section.textContent)).includes(result.explanation.slice(1)));
    assert.deepEqual(await page.evaluate(() => JSON.parse(document.getElementById("data").textContent).result), result);
    const rows = await page.$$eval("#comparison tbody tr", (all) => all.map(({ dataset }) => ({ ...dataset })));
    assert.deepEqual(Object.fromEntries(rows.map((row) => [row.name, row.verdict])),
      Object.fromEntries(result.signals.map((signal) => [signal.name, signal.verdict])));
    // What differs stands above what does not.
    const lastOut = rows.findLastIndex(({ verdict }) => verdict !== "within");
    assert.ok(lastOut < rows.length - rows.filter(({ verdict }) => verdict === "within").length);
    for (const [i, ink] of (await inkOf(page, "#signals")).entries()) assert.ok(ink > 200, `chart ${i}: ${ink} pixels`);
    assert.ok(statSync(folder.file(`${name}.html`)).size <= MOST_BYTES);
    assert.deepEqual(faults, []);
  });
}

test("the deliberate difference is in the series, as large as it was made, and nowhere else", async () => {
  const { page } = await open("differs");
  const difference = await pageSeries(page, "difference.feed_force_n");
  const allowed = await pageSeries(page, "allowed.feed_force_n");
  const force = tableOf(folder.read("a.csv")).feed_force_n;
  // A bucket that lies in the stretch; single precision of a force of 30 N, and two steps of 16 bits.
  const close = 1e-5 + (2 * (difference.high - difference.low)) / 65534;
  const inside = difference.at((FORCE.from + FORCE.to) / 2);
  assert.ok(Math.abs(inside.low - FORCE.add_n) < close && Math.abs(inside.high - FORCE.add_n) < close,
    JSON.stringify(inside));
  for (const time of [0.4, FORCE.from - 0.01, FORCE.to + 0.01, 1.9]) {
    const { low, high } = difference.at(time);
    assert.ok(Math.abs(low) < close && Math.abs(high) < close, `${time} s: ${low} .. ${high}`);
  }
  const band = allowed.at(1.3);
  const expected = Math.max(TOLERANCE.absolute, TOLERANCE.relative * Math.abs(force[13000]));
  // The force of neighbouring rows, and two steps of 16 bits.
  assert.ok(Math.abs(band.high - expected) < 0.01 * expected && Math.abs(band.low + expected) < 0.01 * expected);
  const speed = await pageSeries(page, "difference.spindle_speed_rad_s");
  assert.ok(speed.at(FAST.from + 0.05).low > 4 && Math.abs(speed.at(FAST.from - 0.05).high) < 0.01);
});

test("a gap stays a gap, and what is out stands on the timeline", async () => {
  const { page } = await open("differs");
  const hole = (DROPOUT[0] + DROPOUT[1]) / 2;
  assert.ok((await pageSeries(page, "b.feed_force_n")).at(hole) === null);
  assert.ok((await pageSeries(page, "difference.feed_force_n")).at(hole) === null);
  assert.ok((await pageSeries(page, "a.feed_force_n")).at(hole) !== null);
  const strips = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent).strips);
  const isOn = (title, time) => {
    const { runs, bucket_s: bucket } = strips.find((strip) => strip.title === title);
    return runs.findLast(([first]) => first * bucket <= time)[1] === 1;
  };
  assert.deepEqual([0.5, 1.01, 1.3, 1.6, hole].map((time) => isOn("Differ", time)), [false, true, false, true, false]);
  assert.deepEqual([1.6, hole, 1.9].map((time) => isOn("Only in A", time)), [false, true, false]);
});

test("dragging zooms every chart, and one cursor stands in all of them", async () => {
  const { page, faults } = await open("differs");
  await page.waitForSelector("#signal-feed_force_n .slot:last-child canvas");
  const over = await page.$("#signal-feed_force_n .u-over");
  await over.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await over.boundingBox();
  await page.mouse.move(x + 0.4 * width, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 0.6 * width, y + height / 2, { steps: 4 });
  await page.mouse.up();
  const pixel = (2 * SECONDS) / width;
  const [from, to] = await shownTime(page);
  assert.ok(Math.abs(from - 0.4 * SECONDS) < pixel && Math.abs(to - 0.6 * SECONDS) < pixel, `${from} .. ${to}`);
  await hover(page, "#signal-feed_force_n", 0.51 * width);
  const times = await columnOf(page, "#signal-feed_force_n .u-legend, #signal-spindle_speed_rad_s .u-legend", 0);
  assert.equal(times.length, 4);
  for (const time of times) assert.ok(Math.abs(time - (from + 0.51 * (to - from))) < pixel, `${times}`);
  // The chart says what the difference is where the cursor stands.
  const [, difference] = await columnOf(page, "#signal-feed_force_n .u-legend", 1);
  assert.ok(Math.abs(difference - FORCE.add_n) < 0.01, `${difference}`);
  assert.deepEqual(faults, []);
});

test("it names the command, the bytes of both files, and leads from a signal to its charts", async () => {
  const { page } = await open("differs");
  const text = await page.$eval("#reproduce", (section) => section.textContent);
  assert.match(text, /morepro diff a\.csv b\.csv --abs-tol 0\.001 --rel-tol 0\.002 --report differs\.html/);
  for (const file of ["a.csv", "b.csv"])
    assert.match(text, new RegExp(`${file}: ${statSync(folder.file(file)).size} bytes, CRC-32 [0-9a-f]{8}`));
  const links = await page.$$eval("#comparison a", (all) => all.map((link) => link.getAttribute("href").slice(1)));
  assert.equal(links.length, json("differs").signals.length);
  for (const id of links) assert.ok(await page.$(`[id="${id}"] .slot`), id);
});
