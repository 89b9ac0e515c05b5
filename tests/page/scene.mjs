// The picture in 3-D as pixels.

/** Draws the picture anew and gives how many colours it has - an empty one has the background alone - and their sum. */
export const pictureOf = (page) =>
  page.$eval("#scene canvas", (canvas) => new Promise((resolve) => {
    requestAnimationFrame(() => {
      const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
      const context = copy.getContext("2d");
      // Of the frame that is being drawn: a canvas of WebGL keeps nothing.
      document.getElementById("fit").click();
      requestAnimationFrame(() => {
        context.drawImage(canvas, 0, 0);
        const pixels = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
        resolve({ colours: new Set(pixels).size, sum: pixels.reduce((sum, pixel, i) => sum + pixel * (i % 97), 0) });
      });
    });
  }));

/** Moves the slider below the picture. */
export const seek = (page, time) =>
  page.$eval("#time", (slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, time);

/** The time that the picture shows, in s. */
export const clock = (page) => page.$eval("#clock", (output) => Number(output.dataset.value));
