// Scales of axes: where a value lies between two ends, and round values to mark, by steps or by factors.

class LinearScale {
  // With `takesPower` a power of ten is taken out of numbers that are too long.
  constructor([low, high], takesPower = false) {
    Object.assign(this, { low, high });
    [this.divisor, this.power] = takesPower ? commonPower([low, high]) : [1, ""];
  }

  share(value) {
    return (value - this.low) / (this.high - this.low);
  }

  ticks(count) {
    return ticks(this.low, this.high, count);
  }

  mark(value) {
    return shown(value / this.divisor, 3);
  }
}

class LogarithmicScale {
  constructor([low, high]) {
    Object.assign(this, { low, high, power: "" });
  }

  share(value) {
    return Math.log(value / this.low) / Math.log(this.high / this.low);
  }

  // Powers of ten, and 2 and 5 times these where there is room, or else as on a linear scale.
  ticks(count) {
    const [first, last] = [this.low, this.high].map((value) => Math.floor(Math.log10(value)));
    const every = Math.ceil((last - first) / count) || 1;
    const powers = Array.from({ length: last - first + 1 }, (_, k) => first + k).filter((power) => power % every === 0);
    const inside = (value) => value >= this.low * (1 - 1e-9) && value <= this.high * (1 + 1e-9);
    const by = (steps) => powers.flatMap((power) => steps.map((step) => Number(`${step}e${power}`))).filter(inside);
    const fine = by([1, 2, 5]);
    if (every > 1 || fine.length > 1.5 * count) return by([1]);
    return fine.length > 1 ? fine : ticks(this.low, this.high, Math.min(count, 2));
  }

  mark(value) {
    const power = Math.round(Math.log10(value));
    if (Math.abs(power) > 3 && Math.abs(value / 10 ** power - 1) < 1e-9) return `10${raised(power)}`;
    return shown(value, 3);
  }
}

// A power of ten, and the same in words.
function commonPower(range) {
  const largest = Math.max(...range.map(Math.abs));
  if (largest < 1e4 && largest >= 1e-2) return [1, ""];
  const power = Math.floor(Math.log10(largest));
  return [10 ** power, `10${raised(power)} `];
}
