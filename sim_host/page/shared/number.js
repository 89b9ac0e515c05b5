/** A number as people read it: so many digits, with an exponent where there would be many zeros; a dash for none. */
export function shown(value, digits = 4) {
  if (value == null) return "–";
  const rounded = Number(value.toPrecision(digits));
  const isPlain = rounded === 0 || (Math.abs(rounded) >= 1e-3 && Math.abs(rounded) < 1e6);
  return isPlain ? String(rounded) : rounded.toExponential();
}
