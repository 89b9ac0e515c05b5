// The page of the thesis's figures.
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { closePages, DESKTOP, openPage, startBrowser, TABLET } from "./browser.mjs";
import { Folder } from "./program.mjs";

const FIGURES = [13, 14, 15, 16, 17, 18, 21, 22, 23, 24, 25, 26, 28, 29, 30, 31, 32, 33];
const BANK_ROWS = 2 * 12 * 4;

let browser;
let folder;
before(async () => {
  folder = new Folder();
  folder.run("thesis", "--report", "page.html", "--json", "values.json", "--bank", "--runs", "1", "--progress", "off");
  browser = await startBrowser();
});
afterEach(closePages);
after(async () => {
  await browser?.close();
  folder?.remove();
});

/** Pixels of a chart that are not the background. */
const inkOf = (page) =>
  page.$$eval(".chart canvas", (canvases) => canvases.map((canvas) => {
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    return pixels.reduce((count, value, i) => count + (i % 4 === 3 && value > 0 ? 1 : 0), 0);
  }));

test("every figure has its curves, its values and its sentence", async () => {
  const { page, faults } = await openPage(browser, folder.file("page.html"));
  const sections = await page.$$eval(".figure", (all) => all.map((section) => ({
    id: section.id,
    charts: section.querySelectorAll(".chart canvas").length,
    rows: section.querySelectorAll(".table tbody tr").length,
    remark: [...section.querySelectorAll(":scope > p")].at(-1)?.textContent ?? "",
  })));
  assert.deepEqual(sections.map(({ id }) => id), [...FIGURES.map((number) => `figure-${number}`), "bank"]);
  for (const { id, charts, rows, remark } of sections) {
    const isCurves = id !== "bank" && id !== "figure-18";
    assert.ok(!isCurves || charts > 0, `${id} has no chart`);
    assert.ok((rows > 0 || id === "figure-18") && remark.length > 20, `${id} has ${rows} rows and '${remark}'`);
  }
  assert.equal(sections.at(-1).rows, BANK_ROWS);
  // An empty plot of this size has its grid alone, some 3000 pixels.
  (await inkOf(page)).forEach((ink, i) => assert.ok(ink > 5000, `chart ${i} has ${ink} pixels of ink`));
  assert.deepEqual(faults, []);
});

test("the machine of figure 18 moves along the path", async () => {
  const { page, faults } = await openPage(browser, folder.file("page.html"));
  await page.focus("#scene");
  await page.keyboard.press("End");
  const tool = await page.$$eval("#tool td.number", (cells) => cells.map((cell) => Number(cell.dataset.value)));
  const last = await page.$$eval("#figure-14 .chart:first-of-type .u-value", (values) =>
    values.slice(1).map((value) => Number(value.textContent)));
  // The CLIK lags by h a/(2 K), 2.2e-6 m while the path's end brakes; the legend has six digits.
  tool.forEach((value, i) => assert.ok(Math.abs(value - last[i]) < 5e-6, `${tool} and ${last}`));
  assert.deepEqual(faults, []);
});

test("the table shows the values of the JSON", async () => {
  const { page } = await openPage(browser, folder.file("page.html"));
  const { figures } = JSON.parse(folder.read("values.json"));
  const cells = await page.$$eval("#figure-25 .table tbody tr", (rows) =>
    rows.map((row) => [...row.cells].map((cell) => cell.textContent)));
  const { comparisons } = figures.find(({ figure }) => figure === 25);
  comparisons.forEach(({ quantity, ours, difference }, i) => {
    assert.equal(cells[i][0], quantity);
    assert.ok(Math.abs(Number.parseFloat(cells[i][2]) - ours[0]) < 1e-4, `${cells[i][2]} and ${ours[0]}`);
    assert.equal(cells[i][3], difference);
  });
});

test("nothing is wider than a tablet, light or dark", async () => {
  for (const size of [DESKTOP, TABLET]) {
    const { page, faults } = await openPage(browser, folder.file("page.html"), { size, colorScheme: "dark" });
    for (const colorScheme of ["dark", "light"]) {
      await page.emulateMedia({ colorScheme });
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `${wide} px beyond ${size.width}`);
    }
    assert.deepEqual(faults, []);
  }
});
