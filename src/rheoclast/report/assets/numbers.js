// Numbers as they are read: a few digits, true minus signs, powers of ten, decimal prefixes.

const PREFIXES = { "-18": "a", "-15": "f", "-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k" };

function shown(value, digits = 4) {
  const size = Math.abs(value);
  if (size === 0 || (size >= 1e-3 && size < 1e5)) return minus(String(Number(value.toPrecision(digits))));
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  return `${minus(String(Number(mantissa)))} × 10${raised(Number(power))}`;
}

function minus(text) {
  return text.replace("-", "−");
}

function raised(power) {
  return [...String(power)].map((sign) => (sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(sign)])).join("");
}

// A value, with its error if there is one, and the unit with the prefix that suits it.
function quoted(value, unit, error = null, digits = 4) {
  const [divisor, prefix] = prefixed(Math.max(Math.abs(value), error ?? 0), unit);
  const margin = error === null ? "" : ` ± ${shown(error / divisor, 2)}`;
  return `${shown(value / divisor, digits)}${margin} ${prefix}${unit}`.trimEnd();
}

// Units other than these take no prefix.
function prefixed(size, unit) {
  if (!["m", "N", "N m"].includes(unit) || size === 0) return [1, ""];
  const power = Math.min(3, Math.max(-18, 3 * Math.floor(Math.log10(size * (1 + 1e-9)) / 3)));
  return [10 ** power, PREFIXES[power]];
}

// The largest of 1, 2, 5 times a power of ten that is not above a positive value.
function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [5, 2, 1].find((step) => step * power <= value * (1 + 1e-9));
}

// Round values, about `count` of them, between two ends.
function ticks(low, high, count) {
  const step = roundDown((high - low) / count) || 1;
  const first = Math.ceil(low / step - 1e-6);
  const last = Math.floor(high / step + 1e-6);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

function escaped(text) {
  return String(text).replace(/[&<>"]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]);
}
