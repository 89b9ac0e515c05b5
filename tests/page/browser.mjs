// A page in a headless browser, and everything that it must not do.
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { chromium } = createRequire(join(process.env.MOREPRO_PAGE_MODULES, "any.js"))("playwright-core");

/** Slow machines draw 3-D in software: nothing here is a measure of speed. */
export const PATIENCE_MS = 120_000;
const SOFTWARE_3D = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
/** A GPU that is software draws charts and paper more slowly than no GPU, and every picture has to be read back from it. */
const NO_GPU_FOR_2D = ["--disable-accelerated-2d-canvas", "--disable-gpu-rasterization"];

export const DESKTOP = { width: 1440, height: 900 };
export const TABLET = { width: 820, height: 1180 };

export async function startBrowser() {
  return chromium.launch({
    executablePath: process.env.MOREPRO_BROWSER,
    args: ["--no-sandbox", "--disable-dev-shm-usage", ...SOFTWARE_3D, ...NO_GPU_FOR_2D],
    timeout: PATIENCE_MS,
  });
}

const contexts = [];

/** After each test: a page that stays open goes on drawing beside the next one. */
export const closePages = () => Promise.all(contexts.splice(0).map((context) => context.close()));

/** Opens a file; `faults` collects errors, warnings of the page's own and every request beyond the file; `onStart` runs in the page before anything of it. */
export async function openPage(browser, file, { size = DESKTOP, colorScheme = "light", has3d = true, onStart } = {}) {
  const context = await browser.newContext({ viewport: size, colorScheme });
  contexts.push(context);
  context.setDefaultTimeout(PATIENCE_MS);
  const page = await context.newPage();
  const address = pathToFileURL(file).href;
  const faults = [];
  page.on("console", (message) => {
    if (message.type() === "error") faults.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => faults.push(`exception: ${error.message}`));
  page.on("request", (request) => {
    if (request.url() !== address && !request.url().startsWith("data:")) faults.push(`request: ${request.url()}`);
  });
  if (onStart) await page.addInitScript(onStart);
  if (!has3d) {
    await page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, {
        apply: (get, canvas, [kind, ...rest]) => (kind.startsWith("webgl") ? null : get.call(canvas, kind, ...rest)),
      });
    });
  }
  await page.goto(address);
  return { page, faults };
}
