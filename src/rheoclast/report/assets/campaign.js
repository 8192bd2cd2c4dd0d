// The page of a campaign: charts under a condition that is chosen, and tables.

const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const DASHES = ["none", "7 3", "2 3", "9 3 2 3"];
const SYMBOLS = [
  (r) => `M${-r} 0A${r} ${r} 0 1 0 ${r} 0A${r} ${r} 0 1 0 ${-r} 0Z`,
  (r) => `M${-0.9 * r} ${-0.9 * r}H${0.9 * r}V${0.9 * r}H${-0.9 * r}Z`,
  (r) => `M0 ${-1.2 * r}L${1.1 * r} ${0.8 * r}H${-1.1 * r}Z`,
  (r) => `M0 ${-1.25 * r}L${1.25 * r} 0L0 ${1.25 * r}L${-1.25 * r} 0Z`,
];
const SMALL = 2.6;
const LARGE = 5;

function colour(k) {
  return `var(--series-${k % 8})`;
}

function symbol(k, x, y, radius, text) {
  const style = radius === SMALL ? `fill="${colour(k)}" fill-opacity="0.35"` : `fill="${colour(k)}" stroke="var(--paper)"`;
  return `<path class="point" d="${SYMBOLS[k % SYMBOLS.length](radius)}" transform="translate(${x} ${y})" ${style}><title>${escaped(text)}</title></path>`;
}

// Points of aggregates, and over them those of kinds with bars.
function points(width, chart, { points, medians }) {
  const known = medians.flat();
  const all = (key, bars) => [...points.flatMap((each) => each[key]), ...known.flatMap((each) => bars.map((bar) => each[bar]))].filter((value) => value !== null);
  const [x, y] = [all("x", ["x"]), all("y", ["y", "low", "high"])];
  if (!y.length) return empty(width);
  const axes = new Axes(width, [paddedByFactor(x), paddedByFactor(y)], [chart.x.label, chart.y.label], [chart.x.log, chart.y.log]);
  const small = points.flatMap((each, k) =>
    apart(axes, each.x, each.y).filter((n) => each.y[n] !== null).map((n) => symbol(k, axes.x(each.x[n]), axes.y(each.y[n]), SMALL, shown(each.y[n]))),
  );
  const large = medians.flatMap((each, k) => each.map((kind) => withBar(axes, k, kind)));
  return [axes, axes.drawn() + small.join("") + large.join("")];
}

// A bar from the lower to the upper value, down to the axis if the lower one is none, and a point between.
function withBar(axes, k, { x, y, low, high, told }) {
  if (high === null && low === null && y === null) return "";
  const at = axes.x(x) + 3 * ((k % 3) - 1); // so that bars at one place stand side by side
  const top = high === null ? axes.inner.top : axes.y(high);
  const bottom = low === null ? axes.inner.bottom : axes.y(low);
  const bar = `<path d="M${at} ${bottom}V${top}M${at - 4} ${top}h8" stroke="${colour(k)}" stroke-width="1.6" fill="none"><title>${escaped(told)}</title></path>`;
  return bar + (y === null ? "" : symbol(k, at, axes.y(y), LARGE, `${told}: ${shown(y)}`));
}

function steps(width, chart, { edges, shares }) {
  if (!edges.length) return empty(width);
  const high = 1.05 * Math.max(...shares.flat());
  const axes = new Axes(width, [[edges[0], edges[edges.length - 1]], [0, high]], [chart.x.label, chart.y.label], [chart.x.log, chart.y.log]);
  const lines = shares.map((each, k) => {
    const path = each.map((share, n) => `V${axes.y(share)}H${axes.x(edges[n + 1])}`).join("");
    const drawn = each.some((share) => share > 0);
    return drawn ? `<path class="distribution" d="M${axes.x(edges[0])} ${axes.y(0)}${path}V${axes.y(0)}" stroke="${colour(k)}" stroke-dasharray="${DASHES[k % DASHES.length]}"><title>${escaped(data.series[k])}</title></path>` : "";
  });
  return [axes, axes.drawn() + lines.join("")];
}

function empty(width) {
  return [null, `<text x="${width / 2}" y="${HEIGHT / 2}" text-anchor="middle">nothing to draw: nothing fails</text>`];
}

function drawKeys() {
  element("keys").innerHTML = data.series.map((name, k) =>
    `<span><svg width="34" height="14" aria-hidden="true"><path d="M0 7H34" stroke="${colour(k)}" stroke-width="1.8" stroke-dasharray="${DASHES[k % DASHES.length]}"/>${symbol(k, 17, 7, LARGE - 1, "")}</svg>${escaped(name)}</span>`,
  ).join("");
}

function setUpCharts() {
  element("drawn").hidden = !data.charts.length;
  element("condition").innerHTML = data.conditions.map((name, k) => `<option value="${k}">${escaped(name)}</option>`).join("");
  const view = (chart) => chart.views[Number(element("condition").value)];
  const draw = { points, steps };
  const made = data.charts.map((chart) => new Chart(element("charts"), chart.title, (width) => draw[chart.kind](width, chart, view(chart))));
  const show = () => made.forEach((drawn, k) => {
    drawn.note = view(data.charts[k]).note;
    drawn.redraw();
  });
  element("condition").addEventListener("change", show);
  element("choice").textContent = data.choice;
  drawKeys();
  show();
}

for (const table of Object.values(data.tables)) new SortedTable(element("tables"), table, () => {});
setUpCharts();
