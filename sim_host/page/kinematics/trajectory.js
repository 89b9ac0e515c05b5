/** The joints of the rows, and between two rows on the straight line from one to the next. */
export class Trajectory {
  constructor({ time_s, joints }) {
    this.times = time_s;
    this.columns = joints;
  }

  get start() {
    return this.times[0];
  }

  get end() {
    return this.times[this.times.length - 1];
  }

  /** The last row that is not after a time. */
  rowAt(time) {
    let [low, high] = [0, this.times.length - 1];
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  jointsAt(time) {
    const row = this.rowAt(time);
    const next = Math.min(row + 1, this.times.length - 1);
    const share = next === row ? 0 : Math.max(0, (time - this.times[row]) / (this.times[next] - this.times[row]));
    return this.columns.map((values) => values[row] + (values[next] - values[row]) * Math.min(1, share));
  }
}
