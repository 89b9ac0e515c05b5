// The page of a recording: what diagnose, replay and identify have found, beside the signals.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, statSync } from "node:fs";
import { after, afterEach, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { closePages, DESKTOP, openPage, startBrowser, TABLET } from "./browser.mjs";
import { hover, inkOf, pageSeries, shownTime, waitForCharts } from "./charts.mjs";
import { Folder, tableOf } from "./program.mjs";

const MOST_BYTES = 3e6;
const COMMON = ["verdict", "timeline", "model", "residuals"];
const SECTIONS = {
  diagnose: [...COMMON, "gap", "parameters", "signals", "machine", "reproduce"],
  replay: [...COMMON, "gap", "hypotheses", "parameters", "wear", "budget", "signals", "machine", "reproduce"],
  identify: [...COMMON, "gap", "parameters", "signals", "machine", "reproduce"],
};
const LOOKS = {
  diagnose: { size: TABLET, colorScheme: "light" },
  replay: { size: TABLET, colorScheme: "dark" },
  identify: { size: DESKTOP, colorScheme: "dark" },
};
const DRAWN = {
  diagnose: ["#timeline", "#model", "#residuals", "#gap"],
  replay: ["#timeline", "#model", "#residuals", "#hypotheses", "#wear"],
  identify: ["#timeline", "#model", "#residuals", "#gap"],
};
const COMMANDS = Object.keys(SECTIONS);
const SECONDS = 3;
const DROPOUT = [1.2, 1.5];

let browser;
let folder;
/** A machine with an effect, a datasheet that is wrong, and rows that are missing. */
before(async () => {
  folder = new Folder();
  folder.run("simulate", "--profile", "rich", "--duration", String(SECONDS), "--effect", "feed_coulomb_friction=6",
    "--datasheet-error", "0.1", "--machine-out", "datasheet.toml", "--out", "whole.csv", "--progress", "off");
  const lines = folder.read("whole.csv").split("\n");
  const header = lines.findIndex((line) => line.startsWith("time_s"));
  const isKept = (line, i) => i <= header || line === "" ||
    !(Number.parseFloat(line) >= DROPOUT[0] && Number.parseFloat(line) < DROPOUT[1]);
  folder.write("run.csv", lines.filter(isKept).join("\n"));
  const run = (command, machine, ...more) => folder.run(command, "run.csv", "--machine", machine, "--report",
    `${command}.html`, "--json", `${command}.json`, "--progress", "off", ...more);
  run("diagnose", "datasheet.toml", "--bootstrap", "20");
  run("replay", "reference");
  run("identify", "datasheet.toml");
  browser = await startBrowser();
});
afterEach(closePages);
after(async () => {
  await browser?.close();
  folder?.remove();
});

const open = (command, options) => openPage(browser, folder.file(`${command}.html`), options);
const json = (command) => JSON.parse(folder.read(`${command}.json`));

/** The verdict as the JSON has it. */
const VERDICTS = {
  diagnose: ({ verdict }) => verdict,
  replay: ({ health }) => health.state,
  identify: ({ parameters }) =>
    (parameters.every(({ identifiable }) => identifiable) ? "identified" : "partly_identified"),
};

for (const command of COMMANDS) {
  test(`${command}: every section that there is data for, the JSON and its verdict, nothing blank or too wide, no network`, async () => {
    const { page, faults } = await open(command, LOOKS[command]);
    await waitForCharts(page);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} px beyond ${LOOKS[command].size.width}`);
    assert.deepEqual(await page.$$eval("section", (all) => all.map(({ id }) => id)), SECTIONS[command]);
    for (const selector of DRAWN[command])
      for (const [i, ink] of (await inkOf(page, selector)).entries())
        assert.ok(ink > 200, `chart ${i} of ${selector} has ${ink} pixels of ink`);
    assert.ok(statSync(folder.file(`${command}.html`)).size <= MOST_BYTES);
    const result = json(command);
    assert.equal(await page.$eval(".badge", ({ dataset }) => dataset.verdict), VERDICTS[command](result));
    const held = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent).result);
    assert.deepEqual(held, result);
    // Not page.click(): the picture in 3-D comes when its place is scrolled by, and moves the button.
    const press = page.$eval("#download", (button) => button.click());
    const [download] = await Promise.all([page.waitForEvent("download"), press]);
    assert.deepEqual(JSON.parse(readFileSync(await download.path(), "utf8")), result);
    assert.deepEqual(faults, []);
  });
}

// A tool gets blunt, faster and faster: how the page says what the monitor says, colour included.
for (const { wear, state, mood } of [
  { wear: 0, state: "HEALTHY", mood: "good" },
  { wear: 0.02, state: "WATCH", mood: "watch" },
  { wear: 0.05, state: "REPLACE", mood: "bad" },
]) {
  test(`replay of a tool that is ${state}: verdict, reason and states over time are those of the JSON`, async () => {
    const name = `tool_${state}`;
    folder.run("simulate", "--profile", "cutting", "--duration", "3", "--effect", `tool_wear_ramp=${wear}`, "--out",
      `${name}.csv`, "--progress", "off");
    folder.run("replay", `${name}.csv`, "--report", `${name}.html`, "--json", `${name}.json`, "--progress", "off");
    const { health } = json(name);
    assert.equal(health.state, state);
    const { page, faults } = await open(name);
    assert.equal(await page.$eval(".badge", ({ dataset }) => dataset.verdict), health.state);
    assert.equal(await page.$eval(".badge", ({ textContent }) => textContent.slice(1)), state);
    assert.ok(await page.$(`.badge.${mood}`));
    const text = await page.$eval("#verdict", (section) => section.textContent);
    for (const sentence of [health.reason, health.likely_cause, health.next_step])
      assert.ok(text.includes(sentence), sentence);
    const listed = await page.$$eval("#timeline tbody tr", (rows) => rows.map((row) => row.cells[1].textContent));
    assert.ok(listed.includes(state) && listed.includes("REPLACE") === (state === "REPLACE"), `${listed}`);
    const { slope_per_s: slope, standard_error_per_s: error } = await page.evaluate(() =>
      JSON.parse(document.getElementById("data").textContent).wear_trend);
    assert.equal(slope > 2 * error, wear > 0);
    const trend = await page.$eval("#trend", ({ textContent }) => textContent);
    assert.equal(trend.includes("none that can be seen"), wear === 0, trend);
    assert.deepEqual(faults, []);
  });
}

test("dragging over one chart changes the time of all, a double click restores it", async () => {
  const { page, faults } = await open("diagnose");
  await page.waitForSelector("#model .slot:last-child canvas");
  const over = await page.$("#model .u-over");
  await over.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await over.boundingBox();
  const drag = async (from, to) => {
    await page.mouse.move(x + from * width, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + to * width, y + height / 2, { steps: 4 });
    await page.mouse.up();
  };
  await drag(0.25, 0.5);
  // A pixel of the chart is this long.
  const pixel = (2 * SECONDS) / width;
  const [from, to] = await shownTime(page);
  assert.ok(Math.abs(from - 0.25 * SECONDS) < pixel && Math.abs(to - 0.5 * SECONDS) < pixel, `${from} .. ${to}`);
  await hover(page, "#model", width / 2);
  // The cursor stands at one time in all charts that are on the page.
  const times = await page.$$eval("#timeline .u-legend, #model .u-legend", (legends) =>
    legends.map((legend) => Number.parseFloat(legend.querySelector(".u-value").textContent)));
  for (const time of times) assert.ok(Math.abs(time - (from + to) / 2) < 4 * pixel, `${times}`);
  assert.ok(times.length >= 4);
  await over.dblclick();
  assert.deepEqual(await shownTime(page), [0, SECONDS]);
  assert.deepEqual(faults, []);
});

test("keys and buttons move the time; nothing zooms beyond the recording", async () => {
  const { page } = await open("replay");
  await page.waitForSelector("#timeline .chart");
  await page.focus("#timeline .chart");
  await page.keyboard.press("+");
  assert.deepEqual(await shownTime(page), [0.25 * SECONDS, 0.75 * SECONDS]);
  await page.keyboard.press("ArrowLeft");
  assert.deepEqual(await shownTime(page), [0.125 * SECONDS, 0.625 * SECONDS]);
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowLeft");
  assert.equal((await shownTime(page))[0], 0);
  await page.click("#view button[aria-label='Zoom out']");
  await page.click("#view button[aria-label='Zoom out']");
  assert.deepEqual(await shownTime(page), [0, SECONDS]);
});

test("samples that the page shows are those of the recording, and missing rows are a hole", async () => {
  const { page } = await open("replay");
  const columns = tableOf(folder.read("run.csv"));
  const series = await pageSeries(page, "recording.armature_voltage_v");
  const inBucket = (i) => columns.armature_voltage_v.filter((_, row) =>
    Math.floor(Math.round(columns.time_s[row] * 1e4) / Math.round(series.bucket_s * 1e4)) === i);
  for (const i of [0, 7, Math.floor(0.9 / series.bucket_s), Math.floor(2.7 / series.bucket_s)]) {
    const values = inBucket(i);
    // One step of the 16 bits, and the float that the frame holds.
    const { low, high } = series.bucket(i);
    assert.ok(Math.abs(low - Math.min(...values)) < 1.01 * series.step + 1e-5, `bucket ${i}`);
    assert.ok(Math.abs(high - Math.max(...values)) < 1.01 * series.step + 1e-5, `bucket ${i}`);
  }
  assert.equal(series.at((DROPOUT[0] + DROPOUT[1]) / 2), null);
});

test("where, which and how far are those of the JSON", async () => {
  const { page } = await open("diagnose");
  const { where, which, verdict, not_found: notFound } = json("diagnose");
  assert.equal(verdict, "effect");
  const ratios = await page.$$eval(".heat", (cells) => cells.map(({ dataset }) => Number(dataset.ratio)));
  const expected = where.filter(({ evaluated }) => evaluated)
    .flatMap(({ residual_ratio: refit, residual_ratio_after: after, cells }) =>
      [refit, after, ...cells.map((cell) => cell.residual_ratio)]);
  const sorted = (values) => [...values].sort((a, b) => a - b);
  assert.deepEqual(sorted(ratios), sorted(expected));
  const heats = await page.$$eval(".heat", (cells) => cells.map(({ style, dataset }) =>
    [Number(dataset.ratio), Number.parseInt(style.getPropertyValue("--heat"), 10)]));
  const largest = heats.reduce((most, cell) => (cell[0] > most[0] ? cell : most));
  assert.equal(largest[1], Math.max(...heats.map(([, heat]) => heat)), "the largest residual is the darkest");
  assert.deepEqual(await page.$$eval(".cause", (all) => all.map(({ dataset }) => dataset.effect)),
    which.map(({ effect }) => effect));
  const limits = await page.$$eval(".limits li", (all) => all.map(({ textContent }) => textContent));
  assert.equal(limits.length, notFound.length);
  assert.ok(limits.length > 10 && limits.every((text) => /: (from [\d.e−-]+( [^ ].*)? on|not shown, it needs .+)$/.test(text)),
    limits.join("; "));
  const { from, to } = where[0].cells.findLast(({ by }) => by === "time");
  await page.click(".map:has(caption:text-is('Time, s')) tr:first-of-type .heat:last-of-type");
  const shown = await shownTime(page);
  assert.ok(Math.abs(shown[0] - from) < 1e-9 && Math.abs(shown[1] - Math.min(to, SECONDS)) < 1e-9, `${shown}`);
});

test("eight seconds of it fit a tablet, and a cause says what outside the catalogue looks the same", async () => {
  folder.run("simulate", "--profile", "rich", "--duration", "8", "--effect", "brush_voltage_drop=1", "--out",
    "brush.csv", "--progress", "off");
  folder.run("diagnose", "brush.csv", "--bootstrap", "0", "--report", "brush.html", "--progress", "off");
  const { page } = await open("brush", { size: TABLET });
  const cut = await page.$$eval(".map", (all) => all.filter((map) => map.scrollWidth > map.clientWidth).length);
  assert.equal(cut, 0, "maps whose last cells are out of sight");
  assert.match(await page.$eval(".cause[data-effect=brush_voltage_drop]", ({ textContent }) => textContent),
    /inverter dead time looks the same/);
});

test("every error of a model stands with its interval", async () => {
  const { page } = await open("diagnose");
  const { shrinkage } = json("diagnose");
  const percent = (share) => (100 * share).toFixed(2);
  const rows = ["free_run_nrmse", "one_step_nrmse"].flatMap((figure) =>
    Object.entries(shrinkage[`${figure}_ci90`]).flatMap(([balance, intervals]) =>
      ["datasheet", "refit", "with_effect", "noise_floor"].map((model) => {
        const error = shrinkage[figure][balance][model];
        const [low, high] = intervals[model] ?? [];
        return { text: `${percent(error)} %${low == null ? "" : `${percent(low)} .. ${percent(high)} %`}`, low, high, error };
      })));
  assert.equal(rows.length, 2 * 3 * 4);
  const shown = await page.$$eval("#gap .bars tr", (all) => all.map((row) => {
    const style = row.querySelector(".bar").style;
    const share = (name) => Number.parseFloat(style.getPropertyValue(name));
    return { text: [...row.querySelectorAll(".number")].map(({ textContent }) => textContent).join(""),
      error: share("--share"), low: share("--low"), high: share("--high") };
  }));
  assert.deepEqual(shown.map(({ text }) => text), rows.map(({ text }) => text));
  shown.forEach((bar, i) => {
    const { low, high, error } = rows[i];
    if (low == null) return assert.ok(Number.isNaN(bar.low), "no whisker without an interval");
    assert.ok(Math.abs(bar.low * error - bar.error * low) < 0.02 * error, `${i}: the whisker begins where it should`);
    assert.ok(Math.abs(bar.high * error - bar.error * high) < 0.02 * error, `${i}: and ends where it should`);
  });
});

test("the page names the command and the recording's bytes", async () => {
  const { page } = await open("identify");
  const text = await page.$eval("#reproduce", (section) => section.textContent);
  assert.match(text, /morepro identify run\.csv --machine datasheet\.toml --report identify\.html/);
  assert.match(text, new RegExp(`run\\.csv: ${statSync(folder.file("run.csv")).size} bytes, CRC-32 [0-9a-f]{8}`));
});

test("pictures of a section and of its pieces are taken, without what follows the reader", () => {
  const take = (...parts) => spawnSync(process.execPath,
    [fileURLToPath(new URL("./pictures.mjs", import.meta.url)), folder.file("diagnose.html"), folder.file("pictures"),
      ...parts], { encoding: "utf8" });
  const done = take("verdict", "gap:Where", "gap:How");
  assert.equal(done.status, 0, done.stderr);
  for (const name of ["verdict", "gap_where", "gap_how"]) {
    const picture = readFileSync(folder.file(`pictures/${name}.png`));
    assert.equal(picture.subarray(1, 4).toString(), "PNG");
    assert.ok(picture.readUInt32BE(16) > 800 && picture.readUInt32BE(20) > 100, name);
  }
  assert.match(take("gap:Elsewhere").stderr, /the page has no part 'gap:Elsewhere'/);
});
