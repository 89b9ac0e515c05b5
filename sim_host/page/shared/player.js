/** The time that is shown, and how it runs. Tells its listeners about every change. */
export class Player {
  constructor(start, end) {
    Object.assign(this, { start, end, time: start, speed: 1, isPlaying: false, listeners: [] });
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.#tell();
  }

  toggle() {
    if (this.isPlaying) this.pause();
    else this.play();
  }

  play() {
    if (this.time >= this.end) this.time = this.start;
    this.isPlaying = true;
    let before = performance.now();
    const tick = (now) => {
      if (!this.isPlaying) return;
      const elapsed_s = Math.max(0, now - before) / 1000;
      before = now;
      if (this.time + elapsed_s * this.speed >= this.end) this.isPlaying = false;
      this.seek(this.time + elapsed_s * this.speed);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
    this.#tell();
  }

  pause() {
    this.isPlaying = false;
    this.#tell();
  }

  #tell() {
    for (const listener of this.listeners) listener(this);
  }
}
