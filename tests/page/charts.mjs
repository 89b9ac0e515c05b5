// What the tests of pages with charts over time ask of them.

/** All charts, wherever they are on the page. */
export async function waitForCharts(page) {
  await page.waitForFunction(() =>
    [...document.querySelectorAll(".slot")].every((slot) => slot.querySelector("canvas")));
}

/** Pixels that are neither background nor grid: far from grey. */
export const inkOf = (page, selector) =>
  page.$$eval(`${selector} canvas`, (canvases) => canvases.map((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let ink = 0;
    for (let i = 0; i < data.length; i += 4) {
      const [red, green, blue, alpha] = [data[i], data[i + 1], data[i + 2], data[i + 3]];
      if (alpha > 150 && Math.max(red, green, blue) - Math.min(red, green, blue) > 60) ++ink;
    }
    return ink;
  }));

export const picturesOf = (page) =>
  page.$$eval(".chart canvas", (all) => all.map((canvas) => canvas.toDataURL()));

/** A browser smooths a line in one of two ways, as its time allows: the same pixel is then a half or a third covered. */
const SMOOTHING = 96;

/**
 * Charts that two lists of pictures show differently. A pixel of one line is up to 56 of 255 off where it is smoothed
 * in the other way; in the colours of the other theme, or in another place, 162 and more.
 */
export async function differing(page, before, after) {
  const most = await page.evaluate(async ([some, others]) => {
    const pixelsOf = async (url) => {
      const image = Object.assign(new Image(), { src: url });
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height);
    };
    const difference = async (url, other) => {
      if (url === other) return 0;
      const [a, b] = await Promise.all([pixelsOf(url), pixelsOf(other)]);
      if (a.width !== b.width || a.height !== b.height) return 255;
      let largest = 0;
      const see = (one, other) => { largest = Math.max(largest, Math.abs(one - other)); };
      // A loop: a callback for each of the ten million values takes seconds.
      for (let pixel = 0; pixel < a.data.length; pixel += 4) {
        const [cover, otherCover] = [a.data[pixel + 3], b.data[pixel + 3]];
        see(cover, otherCover);
        for (let i = pixel; i < pixel + 3; ++i) see((a.data[i] * cover) / 255, (b.data[i] * otherCover) / 255);
      }
      return largest;
    };
    return Promise.all(some.map((url, i) => difference(url, others[i])));
  }, [before, after]);
  return most.map((difference, i) => (difference > SMOOTHING ? `chart ${i}: ${Math.round(difference)} of 255` : [])).flat();
}

/** From and to, in s. */
export const shownTime = (page) =>
  page.$eval("#shown", ({ dataset }) => [Number(dataset.from), Number(dataset.to)]);

/** Puts the cursor so many pixels into the first chart of a place. */
export async function hover(page, selector, x) {
  const place = await page.$(`${selector} .u-over`);
  await place.scrollIntoViewIfNeeded();
  await place.hover({ position: { x, y: 20 } });
}

/** One value of each of the legends: 0 is the time. */
export const columnOf = (page, legends, column) =>
  page.$$eval(legends, (all, i) => all.map((legend) =>
    Number.parseFloat(legend.querySelectorAll(".u-value")[i].textContent)), column);

/** A series of the page; `at` gives the smallest and largest value of a time's bucket, null where there is none. */
export async function pageSeries(page, id) {
  const series = await page.evaluate((name) =>
    JSON.parse(document.getElementById("data").textContent).series[name], id);
  const steps = new Uint16Array(Uint8Array.from(atob(series.data), (c) => c.charCodeAt(0)).buffer);
  const step = (series.high - series.low) / 65534;
  const bucket = (i) => (steps[2 * i] === 65535 ? null
    : { low: series.low + steps[2 * i] * step, high: series.low + steps[2 * i + 1] * step });
  return { ...series, step, bucket, at: (time) => bucket(Math.floor(time / series.bucket_s + 1e-6)) };
}
