// Charts as SVG: quiet axes, one colour, drawn anew at every width.

const HEIGHT = 260;
const MARGINS = { left: 92, right: 22, top: 10, bottom: 44 };
const BINS = 30;
const MOST_BARS = 40;

// A figure with a title and a note. `draw(width)` returns its axes and the inside of an SVG, `mark(axes)` what is on top
// and changes.
class Chart {
  constructor(parent, title, draw, mark = () => "") {
    Object.assign(this, { draw, mark });
    this.figure = parent.appendChild(document.createElement("figure"));
    this.figure.className = "chart";
    this.figure.innerHTML = `<figcaption></figcaption><svg role="img"><g></g><g></g></svg><p class="note" hidden></p>`;
    this.layers = this.figure.querySelectorAll("g");
    this.title = title;
    new ResizeObserver(() => this.redraw()).observe(this.figure);
  }

  set title(text) {
    this.figure.querySelector("figcaption").textContent = text;
    this.figure.querySelector("svg").setAttribute("aria-label", text);
  }

  set note(text) {
    this.figure.querySelector(".note").textContent = text;
    this.figure.querySelector(".note").hidden = !text;
  }

  redraw() {
    const width = this.figure.clientWidth;
    if (!width) return;
    this.figure.querySelector("svg").setAttribute("viewBox", `0 0 ${width} ${HEIGHT}`); // by which paper of other width takes it
    [this.axes, this.layers[0].innerHTML] = this.draw(width);
    this.remark();
  }

  remark() {
    if (this.axes) this.layers[1].innerHTML = this.mark(this.axes);
  }
}

// Where values lie in a chart of some width, and its axes with labels.
class Axes {
  constructor(width, ranges, labels, [xLog, yLog] = [false, false]) {
    this.inner = { left: MARGINS.left, right: width - MARGINS.right, top: MARGINS.top, bottom: HEIGHT - MARGINS.bottom };
    this.labels = labels;
    [this.horizontal, this.vertical] = [xLog, yLog].map((isLog, k) =>
      isLog ? new LogarithmicScale(ranges[k]) : new LinearScale(ranges[k], labels[k].includes("{power}")),
    );
  }

  x(value) {
    const { left, right } = this.inner;
    return left + (right - left) * this.horizontal.share(value);
  }

  y(value) {
    const { top, bottom } = this.inner;
    return bottom - (bottom - top) * this.vertical.share(value);
  }

  // With `whole` no fractions are marked along x, with `counts` along y.
  drawn({ whole = false, counts = false } = {}) {
    const { left, right, top, bottom } = this.inner;
    const [xLabel, yLabel] = this.labels.map((label, k) => escaped(label.replace("{power}", [this.horizontal, this.vertical][k].power)));
    const marked = (scale, number, isWhole) => scale.ticks(number).filter((value) => !isWhole || Number.isInteger(value));
    const xTicks = marked(this.horizontal, Math.max(2, (right - left) / 80), whole);
    const rows = marked(this.vertical, 4, counts).map((value) => `<path class="grid" d="M${left} ${this.y(value)}H${right}"/>
      <text x="${left - 8}" y="${this.y(value) + 4}" text-anchor="end">${this.vertical.mark(value)}</text>`);
    const columns = xTicks.map((value) => `<path class="axis" d="M${this.x(value)} ${bottom}v5"/>
      <text x="${this.x(value)}" y="${bottom + 19}" text-anchor="middle">${this.horizontal.mark(value)}</text>`);
    return `${rows.join("")}${columns.join("")}<path class="axis" d="M${left} ${bottom}H${right}"/>
      <text x="${(left + right) / 2}" y="${HEIGHT - 6}" text-anchor="middle">${xLabel}</text>
      <text transform="translate(13 ${(top + bottom) / 2}) rotate(-90)" text-anchor="middle">${yLabel}</text>`;
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
  return [axes, axes.drawn({ counts: true }) + bars.join("")];
}

// Dots that choose a contact when clicked; of those that cover each other, one.
function scatter(width, [x, y], contacts, labels) {
  const axes = new Axes(width, [padded([0, spread(x)[1]]), padded(spread(y))], labels);
  const dot = (k) => `<circle class="dot" data-contact="${contacts[k]}" cx="${axes.x(x[k])}" cy="${axes.y(y[k])}" r="3.2"><title>contact ${contacts[k]}: ${shown(y[k])}</title></circle>`;
  return [axes, axes.drawn() + apart(axes, x, y).map(dot).join("")];
}

// Positions in a list of points, without those that lie in a cell of some pixels where there is one already.
function apart(axes, x, y, cell = 2.5) {
  const taken = new Map();
  x.forEach((value, k) => {
    const place = `${Math.round(axes.x(value) / cell)} ${Math.round(axes.y(y[k]) / cell)}`;
    if (!taken.has(place)) taken.set(place, k);
  });
  return [...taken.values()];
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
  return [axes, axes.drawn({ whole: true, counts: true }) + bars.join("")];
}

function spread(values) {
  const [low, high] = values.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [Infinity, -Infinity]);
  return low < high ? [low, high] : [Math.min(0, low), Math.max(0, high) || 1];
}

function padded([low, high]) {
  const room = 0.05 * (high - low || 1);
  return [low < 0 || low > room ? low - room : low, high + room];
}

// The same for values on a logarithmic scale.
function paddedByFactor(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const room = low < high ? (high / low) ** 0.05 * 1.02 : 1.2;
  return [low / room, high * room];
}
