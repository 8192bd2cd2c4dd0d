// Charts as SVG: quiet axes, one colour, drawn anew at every width.

const HEIGHT = 260;
const MARGINS = { left: 62, right: 14, top: 10, bottom: 44 };
const BINS = 30;
const MOST_BARS = 40;

// A figure with a title. `draw(width)` returns its axes and the inside of an SVG, `mark(axes)` what is on top and changes.
class Chart {
  constructor(parent, title, draw, mark = () => "") {
    Object.assign(this, { draw, mark });
    this.figure = parent.appendChild(document.createElement("figure"));
    this.figure.className = "chart";
    this.figure.innerHTML = `<figcaption></figcaption><svg role="img"><g></g><g></g></svg>`;
    this.layers = this.figure.querySelectorAll("g");
    this.title = title;
    new ResizeObserver(() => this.redraw()).observe(this.figure);
  }

  set title(text) {
    this.figure.querySelector("figcaption").textContent = text;
    this.figure.querySelector("svg").setAttribute("aria-label", text);
  }

  redraw() {
    const width = this.figure.clientWidth;
    if (!width) return;
    [this.axes, this.layers[0].innerHTML] = this.draw(width);
    this.remark();
  }

  remark() {
    if (this.axes) this.layers[1].innerHTML = this.mark(this.axes);
  }
}

// Where values lie in a chart of some width, and its axes with labels.
class Axes {
  constructor(width, [x, y], [xLabel, yLabel]) {
    this.inner = { left: MARGINS.left, right: width - MARGINS.right, top: MARGINS.top, bottom: HEIGHT - MARGINS.bottom };
    Object.assign(this, { xRange: x, yRange: y, xLabel, yLabel });
  }

  x(value) {
    const { left, right } = this.inner;
    return left + ((right - left) * (value - this.xRange[0])) / (this.xRange[1] - this.xRange[0]);
  }

  y(value) {
    const { top, bottom } = this.inner;
    return bottom - ((bottom - top) * (value - this.yRange[0])) / (this.yRange[1] - this.yRange[0]);
  }

  drawn({ whole = false } = {}) {
    const { left, right, top, bottom } = this.inner;
    const xTicks = ticks(...this.xRange, Math.max(2, (right - left) / 80)).filter((value) => !whole || Number.isInteger(value));
    const [divisor, power] = commonPower(this.yRange);
    const rows = ticks(...this.yRange, 4).map((value) => `<path class="grid" d="M${left} ${this.y(value)}H${right}"/>
      <text x="${left - 8}" y="${this.y(value) + 4}" text-anchor="end">${shown(value / divisor, 3)}</text>`);
    const columns = xTicks.map((value) => `<path class="axis" d="M${this.x(value)} ${bottom}v5"/>
      <text x="${this.x(value)}" y="${bottom + 19}" text-anchor="middle">${shown(value, 3)}</text>`);
    return `${rows.join("")}${columns.join("")}<path class="axis" d="M${left} ${bottom}H${right}"/>
      <text x="${(left + right) / 2}" y="${HEIGHT - 6}" text-anchor="middle">${escaped(this.xLabel)}</text>
      <text transform="translate(13 ${(top + bottom) / 2}) rotate(-90)" text-anchor="middle">${escaped(this.yLabel.replace("{power}", power))}</text>`;
  }
}

function histogram(width, values, label) {
  const [low, high] = spread(values);
  const step = roundDown((high - low) / BINS) || 1;
  const first = Math.floor(low / step);
  const counts = new Array(Math.floor(high / step) - first + 1).fill(0);
  for (const value of values) counts[Math.floor(value / step) - first] += 1;
  const axes = new Axes(width, [[first * step, (first + counts.length) * step], [0, 1.05 * Math.max(...counts)]], [label, "contacts"]);
  const bars = counts.map((count, k) => {
    const [x, y, end] = [axes.x((first + k) * step), axes.y(count), axes.x((first + k + 1) * step)];
    return `<rect class="bar" x="${x + 0.5}" y="${y}" width="${Math.max(0.5, end - x - 1)}" height="${axes.y(0) - y}"><title>${count} contacts</title></rect>`;
  });
  return [axes, axes.drawn() + bars.join("")];
}

// Dots that choose a contact when clicked.
function scatter(width, [x, y], contacts, labels) {
  const axes = new Axes(width, [padded([0, Math.max(...x)]), padded(spread(y))], labels);
  const dots = x.map((value, k) => `<circle class="dot" data-contact="${contacts[k]}" cx="${axes.x(value)}" cy="${axes.y(y[k])}" r="3.2"><title>contact ${contacts[k]}: ${shown(y[k])}</title></circle>`);
  return [axes, axes.drawn() + dots.join("")];
}

function markPoint(axes, x, y) {
  return `<circle class="mark" cx="${axes.x(x)}" cy="${axes.y(y)}" r="6.5"/>`;
}

// Rates at which contacts fail, one after the other, and the rate that the flow has reached.
function sequence(width, { rate, reached, contact }, unit) {
  const axes = new Axes(width, [[0.5, rate.length + 0.5], padded([0, Math.max(...reached)])], ["failure", `rate ({power}${unit})`]);
  const path = reached.map((value, k) => `${k ? "L" : "M"}${axes.x(k + 0.5)} ${axes.y(value)}H${axes.x(k + 1.5)}`).join("");
  const dots = rate.map((value, k) => `<circle class="dot" data-step="${k + 1}" data-contact="${contact[k]}" cx="${axes.x(k + 1)}" cy="${axes.y(value)}" r="3.6"><title>failure ${k + 1}, contact ${contact[k]}: ${shown(value)} ${unit}</title></circle>`);
  return [axes, `${axes.drawn({ whole: true })}<path class="line" d="${path}"/>${dots.join("")}`];
}

function markLine(axes, x) {
  return `<path class="mark" d="M${axes.x(x)} ${axes.inner.top}V${axes.inner.bottom}"/>`;
}

function sizes(width, spheres) {
  const largest = spheres.slice(0, MOST_BARS);
  const axes = new Axes(width, [[0.5, largest.length + 0.5], padded([0, largest[0]])], ["fragment, largest first", "spheres"]);
  const half = Math.min(24, 0.35 * (axes.x(2) - axes.x(1)));
  const bars = largest.map((size, k) => `<rect class="bar" x="${axes.x(k + 1) - half}" y="${axes.y(size)}" width="${2 * half}" height="${axes.y(0) - axes.y(size)}"><title>${size} spheres</title></rect>`);
  return [axes, axes.drawn({ whole: true }) + bars.join("")];
}

function spread(values) {
  const [low, high] = values.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [Infinity, -Infinity]);
  return low < high ? [low, high] : [Math.min(0, low), Math.max(0, high) || 1];
}

// A power of ten, also in words, that is taken out of numbers too long for an axis.
function commonPower(range) {
  const largest = Math.max(...range.map(Math.abs));
  if (largest < 1e4 && largest >= 1e-2) return [1, ""];
  const power = Math.floor(Math.log10(largest));
  return [10 ** power, `10${raised(power)} `];
}

function padded([low, high]) {
  const room = 0.05 * (high - low || 1);
  return [low < 0 || low > room ? low - room : low, high + room];
}
