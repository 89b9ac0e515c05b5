// Signals as the program wrote them: buckets with their smallest and largest value, in 16-bit steps. Coarser levels
// are made here, two buckets at a time.
const STEPS = 65534;
const NONE = 65535;

function decoded({ data, low, high }) {
  const text = atob(data);
  const count = text.length / 4;
  const lows = new Float64Array(count);
  const highs = new Float64Array(count);
  const span = high - low;
  const value = (at) => {
    const step = text.charCodeAt(at) | (text.charCodeAt(at + 1) << 8);
    return step === NONE ? NaN : low + (span * step) / STEPS;
  };
  for (let i = 0; i < count; ++i) {
    lows[i] = value(4 * i);
    highs[i] = value(4 * i + 2);
  }
  return { lows, highs };
}

/** The smaller of two of which each may be missing, or with `sign` -1 the larger one. */
function extreme(a, b, sign) {
  if (Number.isNaN(a)) return b;
  if (Number.isNaN(b)) return a;
  return sign * a < sign * b ? a : b;
}

function halved({ lows, highs }) {
  const count = Math.ceil(lows.length / 2);
  const at = (values, i) => (i < values.length ? values[i] : NaN);
  return {
    lows: Float64Array.from({ length: count }, (_, i) => extreme(lows[2 * i], at(lows, 2 * i + 1), 1)),
    highs: Float64Array.from({ length: count }, (_, i) => extreme(highs[2 * i], at(highs, 2 * i + 1), -1)),
  };
}

class Series {
  constructor(source) {
    this.source = source;
    this.levels = [];
  }

  get label() { return this.source.label; }

  level(index) {
    if (this.levels.length === 0) this.levels.push(decoded(this.source));
    while (this.levels.length <= index) this.levels.push(halved(this.levels.at(-1)));
    return this.levels[index];
  }

  /** The middle of the finest bucket that a time lies in; null where it holds no sample. */
  at(time) {
    const { lows, highs } = this.level(0);
    const i = Math.min(Math.floor(time / this.source.bucket_s + 1e-6), lows.length - 1);
    const value = 0.5 * (lows[i] + highs[i]);
    return Number.isNaN(value) ? null : value;
  }
}

/** All signals by name. A page has one. */
export class SeriesStore {
  constructor(sources, rowS) {
    this.rowS = rowS;
    this.series = new Map(Object.entries(sources).map(([id, source]) => [id, new Series(source)]));
  }

  get(id) { return this.series.get(id); }

  /**
   * Columns for a chart, x first: of the finest level that has at most `most` buckets between two times. Every
   * bucket is two points, its smallest and its largest value, so that no spike is lost; a bucket of one sample is
   * one. `bands`: series of which the largest and then the smallest values are two more columns.
   */
  columns(lines, bands, from, to, most) {
    const finest = (lines[0] ?? bands[0]).source.bucket_s;
    let index = 0;
    while ((to - from) / (finest * 2 ** index) > most) ++index;
    const bucket = finest * 2 ** index;
    const isExact = bucket < 1.5 * this.rowS;
    const count = (lines[0] ?? bands[0]).level(index).lows.length;
    const first = Math.max(0, Math.floor(from / bucket) - 1);
    const last = Math.min(count, Math.ceil(to / bucket) + 2);
    const known = (value) => (Number.isNaN(value) ? null : value);
    const spread = (low, high) => {
      const column = [];
      for (let i = first; i < last; ++i) {
        if (!isExact) column.push(known(low[i]));
        column.push(known(high[i]));
      }
      return column;
    };
    const times = [];
    for (let i = first; i < last; ++i) {
      if (isExact) times.push(bucket * i);
      else times.push(bucket * (i + 0.25), bucket * (i + 0.75));
    }
    const columns = [times];
    for (const line of lines) columns.push(spread(line.level(index).lows, line.level(index).highs));
    for (const band of bands) {
      const { lows, highs } = band.level(index);
      columns.push(spread(highs, highs), spread(lows, lows));
    }
    return columns;
  }
}
