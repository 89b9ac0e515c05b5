// The machine in 3-D on the page of a recording: it stands where the recording has it at the time of the cursor.
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { closePages, openPage, startBrowser } from "./browser.mjs";
import { columnOf, hover, pageSeries, waitForCharts } from "./charts.mjs";
import { clock, pictureOf, seek } from "./scene.mjs";
import { Folder, tableOf } from "./program.mjs";

const SECONDS = 2;
const DROPOUT = [0.9, 1];

let browser;
let folder;
let rows;

/** Some columns of the recording alone. */
function part(...names) {
  return `${names.join(",")}\n${rows.time_s.map((_, i) => names.map((name) => rows[name][i]).join(",")).join("\n")}\n`;
}

before(async () => {
  folder = new Folder();
  // The tool gets blunt, so that its colour has something to tell.
  folder.run("simulate", "--profile", "cutting", "--duration", String(SECONDS), "--effect", "tool_wear_ramp=0.1",
    "--out", "whole.csv", "--progress", "off");
  const isKept = (line) => !(Number.parseFloat(line) >= DROPOUT[0] && Number.parseFloat(line) < DROPOUT[1]);
  folder.write("run.csv", folder.read("whole.csv").split("\n").filter(isKept).join("\n"));
  rows = tableOf(folder.read("run.csv"));
  folder.write("feed.csv", part("time_s", "feed_force_n", "feed_position_m"));
  folder.write("spindle.csv", part("time_s", "armature_voltage_v", "spindle_speed_rad_s"));
  folder.write("still.csv", part("time_s", "armature_voltage_v", "armature_current_a"));
  for (const name of ["run", "feed", "spindle", "still"])
    folder.run("replay", `${name}.csv`, "--machine", "reference", "--report", `${name}.html`, "--json", `${name}.json`,
      "--progress", "off");
  browser = await startBrowser();
});
afterEach(closePages);
after(async () => {
  await browser?.close();
  folder?.remove();
});

async function open(name, options) {
  const opened = await openPage(browser, folder.file(`${name}.html`), options);
  await opened.page.waitForSelector("#machine");
  return opened;
}

async function openSeen(name, options) {
  const opened = await open(name, options);
  await opened.page.waitForSelector("#clock");
  await (await opened.page.$("#scene")).scrollIntoViewIfNeeded();
  await opened.page.waitForSelector("#scene canvas");
  return opened;
}

/** NaN where the page shows a dash. */
const valueOf = (page, id) => page.$eval(`#machine-${id}`, ({ dataset }) => Number.parseFloat(dataset.value));
const toolText = (page) => page.$eval("#machine-tool", (cell) => cell.textContent);

/** A position lies between the smallest and the largest sample of its bucket: float32 and 16 bits around them. */
function assertRecorded(position, time, series) {
  const first = Math.floor(time / series.bucket_s + 1e-6) * series.bucket_s;
  const samples = rows.feed_position_m.filter((_, i) =>
    rows.time_s[i] > first - 2e-5 && rows.time_s[i] < first + series.bucket_s - 2e-5);
  assert.ok(samples.length > 0);
  const close = series.step + 1e-7 * Math.max(...samples.map(Math.abs));
  assert.ok(position >= Math.min(...samples) - close && position <= Math.max(...samples) + close,
    `${position} at ${time} s, not ${Math.min(...samples)} .. ${Math.max(...samples)}`);
}

test("the drawn tool is where the recording has it, wherever the cursor of a chart stands", async () => {
  const { page, faults } = await open("run");
  await page.waitForSelector("#model .u-over");
  const series = await pageSeries(page, "recording.feed_position_m");
  const { width } = await (await page.$("#model .u-over")).boundingBox();
  const seen = new Set();
  for (const share of [0.1, 0.35, 0.6, 0.95]) {
    await hover(page, "#model", share * width);
    const time = await clock(page);
    assert.ok(Math.abs(time - share * SECONDS) < (2 * SECONDS) / width, `${time}`);
    const position = await valueOf(page, "position");
    assertRecorded(position, time, series);
    seen.add(position);
  }
  assert.equal(seen.size, 4);
  assert.deepEqual(faults, []);
});

test("3-D begins when somebody looks, draws the machine, and its picture follows the time", async () => {
  const { page, faults } = await open("run");
  await page.waitForSelector("#model .u-over");
  assert.equal(await page.$("#scene canvas"), null);
  await (await page.$("#scene")).scrollIntoViewIfNeeded();
  await page.waitForSelector("#scene canvas");
  const series = await pageSeries(page, "recording.feed_position_m");
  const sums = new Set();
  for (const time of [0.05, 0.5, 1.3, 1.9]) {
    await seek(page, time);
    assertRecorded(await valueOf(page, "position"), time, series);
    const { colours, sum } = await pictureOf(page);
    assert.ok(colours > 20, "the picture is empty");
    sums.add(sum);
  }
  assert.equal(sums.size, 4);
  assert.deepEqual(faults, []);
});

test("the slider moves the cursor of the charts, and a zoom is what plays", async () => {
  const { page, faults } = await openSeen("run");
  await waitForCharts(page);
  await seek(page, 1.25);
  const [pixel] = await page.$$eval("#signals .u-over", ([over]) => [2 / over.clientWidth]);
  const times = await columnOf(page, "#timeline .u-legend, #signals .u-legend", 0);
  assert.ok(times.length > 5);
  for (const time of times) assert.ok(Math.abs(time - 1.25) < 2 * pixel, `${times}`);
  await page.click("#view button[aria-label='Zoom in']");
  const range = await page.$eval("#time", ({ min, max }) => [Number(min), Number(max)]);
  assert.deepEqual(range, [0.25 * SECONDS, 0.75 * SECONDS]);
  await seek(page, 1.4);
  await page.click("#play");
  await page.waitForFunction(() => document.getElementById("play").textContent === "Play");
  assert.equal(await clock(page), 0.75 * SECONDS);
  assert.deepEqual(faults, []);
});

test("a spindle turns", async () => {
  const { page, faults } = await openSeen("spindle");
  const sums = new Set();
  // In one phase, so of one colour: nothing but the angle is another. A quarter of a revolution and more.
  for (const time of [0.06, 0.07, 0.08]) {
    await seek(page, time);
    sums.add((await pictureOf(page)).sum);
  }
  assert.equal(sums.size, 3);
  assert.deepEqual(faults, []);
});

test("it plays and pauses", async () => {
  const { page, faults } = await openSeen("run");
  await page.selectOption("#speed", "0.01");
  await page.click("#play");
  await page.waitForFunction(() => Number(document.getElementById("clock").dataset.value) > 0.002);
  await page.click("#play");
  const paused = await clock(page);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  assert.equal(await clock(page), paused);
  assert.deepEqual(faults, []);
});

test("the tool says contact and the monitor's word, and what is missing is not shown", async () => {
  const { page } = await openSeen("run");
  const { contact, time_s: times } = rows;
  const began = times[contact.findIndex((value) => value > 0.5)];
  const { listed } = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent).events);
  const worn = listed.find(({ state }) => state === "REPLACE");
  const texts = [];
  for (const time of [0.0005, began - 0.05, began + 0.1, worn.time_s + 0.02]) {
    await seek(page, time);
    texts.push(await toolText(page));
  }
  assert.deepEqual([texts[0], texts[1], texts[2].slice(0, 5), texts[3]], ["idle", "air cut", "cut, ", "cut, REPLACE"]);
  await seek(page, (DROPOUT[0] + DROPOUT[1]) / 2);
  assert.ok(Number.isNaN(await valueOf(page, "position")) && Number.isNaN(await valueOf(page, "speed")));
});

test("what is not recorded does not move, and is said", async () => {
  const said = async (name) => {
    const { page, faults } = await open(name);
    await page.waitForFunction(() => document.querySelectorAll("#machine p").length > 0);
    assert.deepEqual(faults, []);
    return page;
  };
  const text = (page) => page.$eval("#machine", (section) => section.textContent);
  const feed = await said("feed");
  assert.match(await text(feed), /spindle's speed is not recorded/);
  await feed.waitForSelector("#machine-position");
  assert.equal(await feed.$("#machine-speed"), null);
  const spindle = await said("spindle");
  assert.match(await text(spindle), /feed position is not recorded/);
  await spindle.waitForSelector("#machine-speed");
  assert.equal(await spindle.$("#machine-position"), null);
  const still = await said("still");
  assert.match(await text(still), /neither a feed position nor a spindle speed/);
  assert.equal(await still.$("#scene"), null);
});

test("without WebGL the values go on", async () => {
  const { page } = await open("run", { has3d: false });
  await page.waitForSelector("#clock");
  await (await page.$("#scene")).scrollIntoViewIfNeeded();
  await page.waitForSelector("#no-view:not([hidden])");
  await seek(page, 1.3);
  assertRecorded(await valueOf(page, "position"), 1.3, await pageSeries(page, "recording.feed_position_m"));
});
