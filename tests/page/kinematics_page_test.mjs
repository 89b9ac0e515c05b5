// The page that shows the machine moving along a path (thesis 3.4, figure 18).
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { closePages, DESKTOP, openPage, startBrowser, TABLET } from "./browser.mjs";
import { clock, pictureOf, seek } from "./scene.mjs";
import { columnsOf, Folder } from "./program.mjs";

const PATH = "x_m,y_m,z_m,roll_deg,duration_s\n0.3,0.1,0.4,0,\n0.5,0.15,0.5,30,2\n0.45,0.3,0.55,-15,1.5\n";

// Eight joints of both kinds, with offsets and twists in every place where a row of the table can have them.
const ARM = [["revolute", 0, 0.3, 90], ["revolute", 0.4, 0, 0], ["prismatic", 0.1, 0.2, -90], ["revolute", 0, 0.1, 90],
  ["revolute", 0.3, 0.05, -90], ["prismatic", 0.05, 0.1, 90], ["revolute", 0.1, 0, -90], ["revolute", 0, 0.08, 0]]
  .map(([kind, a, d, alpha]) => `[[joint]]\nkind = "${kind}"\na_m = ${a}\nd_m = ${d}\nalpha_deg = ${alpha}\n`)
  .join("");
const ARM_PATH = "x_m,y_m,z_m,duration_s\n0.9,0.2,0.5,\n0.6,0.5,0.7,1\n0.5,-0.4,0.4,1.5\n";

/** A tenth of a micrometre: rows are exact, between two of them the page goes straight. */
const TOLERANCE_M = 1e-7;

let browser;
let folder;
before(async () => {
  folder = new Folder();
  folder.write("path.csv", PATH);
  folder.write("arm.toml", ARM);
  folder.write("arm_path.csv", ARM_PATH);
  folder.run("kinematics", "path.csv", "--report", "page.html", "--out", "joints.csv");
  folder.run("kinematics", "arm_path.csv", "--chain", "arm.toml", "--report", "arm.html", "--out", "arm.csv");
  browser = await startBrowser();
});
afterEach(closePages);
after(async () => {
  await browser?.close();
  folder?.remove();
});

const shown = (page, table) =>
  page.$$eval(`#${table} td.number`, (cells) => cells.map((cell) => Number(cell.dataset.value)));

/** Brings the page to rows of the trajectory and compares what it draws with them. */
async function assertFollows(page, rows, names) {
  for (const share of [0, 0.23, 0.5, 0.81, 1]) {
    const row = Math.round(share * (rows.time_s.length - 1));
    await seek(page, rows.time_s[row]);
    const tool = await shown(page, "tool");
    ["x_m", "y_m", "z_m"].forEach((name, i) => {
      const reached = rows[name][row] - rows[`error_${name}`][row];
      assert.ok(Math.abs(tool[i] - reached) < TOLERANCE_M,
        `${name} at ${rows.time_s[row]} s: ${tool[i]}, not ${reached}`);
    });
    const joints = await shown(page, "joints");
    names.forEach((name, i) => assert.ok(Math.abs(joints[i] - rows[name][row]) < TOLERANCE_M, name));
  }
}

test("the drawn tool is where the trajectory has it", async () => {
  const { page, faults } = await openPage(browser, folder.file("page.html"));
  await assertFollows(page, columnsOf(folder.read("joints.csv")), ["d1_m", "d2_m", "d3_m", "t4_rad"]);
  assert.ok((await pictureOf(page)).colours > 20, "the picture is empty");
  assert.deepEqual(faults, []);
});

test("a chain of eight joints is drawn and followed", async () => {
  const { page, faults } = await openPage(browser, folder.file("arm.html"));
  const rows = columnsOf(folder.read("arm.csv"));
  const names = ["t1_rad", "t2_rad", "d3_m", "t4_rad", "t5_rad", "d6_m", "t7_rad", "t8_rad"];
  await assertFollows(page, rows, names);
  assert.ok((await pictureOf(page)).colours > 20, "the picture is empty");
  assert.deepEqual(faults, []);
});

test("it plays, pauses and stops at the end", async () => {
  const { page, faults } = await openPage(browser, folder.file("page.html"));
  await page.click("#play");
  await page.waitForFunction(() => Number(document.getElementById("clock").dataset.value) > 0.05);
  await page.click("#play");
  const paused = await clock(page);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  assert.equal(await clock(page), paused);
  await page.selectOption("#speed", "5");
  await page.click("#play");
  await page.waitForFunction(() => document.getElementById("play").textContent === "Play");
  assert.equal(await clock(page), 3.5);
  assert.deepEqual(faults, []);
});

test("a curve, the keys and the slider lead to one time everywhere", async () => {
  const { page, faults } = await openPage(browser, folder.file("page.html"));
  const curve = await page.$(".chart .u-over");
  const { width, height } = await curve.boundingBox();
  await curve.click({ position: { x: width / 2, y: height / 2 } });
  // The curve's axis ends where the trajectory does; a click hits a pixel.
  assert.ok(Math.abs((await clock(page)) - 1.75) < (3.5 / width) * 2);
  await page.focus("#scene");
  await page.keyboard.press("End");
  assert.equal(await clock(page), 3.5);
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowRight");
  assert.ok(Math.abs((await clock(page)) - 0.035) < 1e-12);
  const heads = await page.$$eval(".playhead", (lines) => lines.map((line) => parseFloat(line.style.left)));
  assert.ok(heads.length >= 5);
  assert.ok(Math.abs(heads[0] - 0.01 * width) < 2, `${heads[0]} of ${width}`);
  assert.equal(new Set(heads.map((left) => left.toFixed(1))).size, 1);
  assert.deepEqual(faults, []);
});

test("nothing is wider than a tablet, light or dark", async () => {
  const seen = [];
  for (const size of [DESKTOP, TABLET]) {
    const { page, faults } = await openPage(browser, folder.file("arm.html"), { size });
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme });
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `${wide} px beyond ${size.width}`);
      seen.push(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
    }
    assert.deepEqual(faults, []);
  }
  assert.equal(new Set(seen).size, 2);
});

test("without 3-D the curves and the values are there, and the page says why the picture is not", async () => {
  const { page } = await openPage(browser, folder.file("page.html"), { has3d: false });
  assert.ok(await page.isVisible("#no-view"));
  await assertFollows(page, columnsOf(folder.read("joints.csv")), ["d1_m", "d2_m", "d3_m", "t4_rad"]);
});
