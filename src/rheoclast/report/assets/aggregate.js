// What the controls do.

const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const contacts = data.tables.contacts.rows;
const failures = data.tables.failures?.rows ?? null;
const pairs = contacts.i.map((i, c) => [i, contacts.j[c]]);
const order = new Map(failures ? failures.contact.map((contact, k) => [contact, k]) : []);
const ORDER = { key: "order", label: "Order of failure" };
const state = { load: data.loads[0], chosen: null, step: 0, playing: null };

const scene = new Scene(element("scene"), element("overlay"), { ...data.scene, pairs });

// Loads and colours

function colours() {
  if (state.load === ORDER) return pairs.map((_, c) => orderColour(c));
  const scale = loadScale(state.load, data.colours);
  return contacts[state.load.key].map(scale.colour);
}

function orderColour(contact) {
  if (!order.has(contact)) return PALE;
  return between(SEQUENCE.map(rgb), order.get(contact) / Math.max(1, order.size - 1));
}

function drawLegend() {
  const { load } = state;
  const keys = [];
  if (load === ORDER) element("legend").innerHTML = scaleOf("Order of failure", `linear-gradient(to right, ${SEQUENCE.join(", ")})`, [1, order.size]);
  else {
    const scale = loadScale(load, data.colours);
    element("legend").innerHTML = scaleOf(withUnit(load), scale.gradient, ends(load, scale));
  }
  if (state.step && load !== ORDER) keys.push(`<span><i style="background: var(--failed)"></i>failed</span>`);
  if (isSplit()) keys.push(...fragmentKeys());
  else if (scene.isPainted) keys.push("<span>each sphere as its most loaded contact</span>");
  element("legend").innerHTML += `<div class="keys">${keys.join("")}</div>`;
}

// Numbers below a scale, with signs where values lie beyond its ends.
function ends({ key, limit }, { low, high }) {
  const beyond = (test, sign) => (contacts[key].some(test) ? `${sign} ` : "");
  const least = beyond((value) => value < low - 1e-4 * limit, "≤");
  const most = beyond((value) => value > high + 1e-4 * limit, "≥");
  return [`${least}${shown(low, 3)}`, shown((low + high) / 2, 3), `${most}${shown(high, 3)}`];
}

function scaleOf(label, gradient, texts) {
  const marks = texts.map((text) => `<span>${text}</span>`).join("");
  return `<div>${escaped(label)}</div><div class="scale" style="background: ${gradient}"></div><div class="ticks">${marks}</div>`;
}

function fragmentKeys() {
  const sizes = [];
  for (const part of data.scene.fragment) sizes[part] = (sizes[part] ?? 0) + 1;
  const named = data.scene.fragment_colours.length - 1;
  const keys = sizes.slice(0, named).map((size, k) => [data.scene.fragment_colours[k], `${size}`]);
  if (sizes.length > named) keys.push([data.scene.fragment_colours[named], `${sizes.length - named} more`]);
  if (sizes.length <= named) keys[keys.length - 1][1] += sizes[sizes.length - 1] > 1 ? " spheres" : " sphere";
  return keys.map(([colour, text]) => `<span><i style="background: ${colour}"></i>${text}</span>`);
}

function withUnit({ label, unit }) {
  return unit ? `${label} (${unit})` : label;
}

// The chosen contact

function choose(contact) {
  state.chosen = contact;
  element("number").value = contact;
  element("selected").innerHTML = told(contact);
  scene.choose(contact);
  for (const table of tables) table.mark(contact);
  for (const chart of charts) chart.remark();
}

function told(c) {
  const place = `${shown(contacts.radial_position[c], 3)} Rg from the centre`;
  const rows = data.loads.map(({ key, label, divisor, base }) => {
    const errors = contacts[`${key}_error`];
    const value = quoted(contacts[key][c] * divisor, base, errors ? errors[c] * divisor : null);
    return `<dt>${label}</dt><dd data-load="${key}">${value}</dd>`;
  });
  return `<p class="sub">spheres ${pairs[c][0]} and ${pairs[c][1]}, ${place}</p><dl>${rows.join("")}</dl>${toldFailure(c)}`;
}

function toldFailure(c) {
  if (!failures) return "";
  if (!order.has(c)) return `<p class="sub">does not fail</p>`;
  const k = order.get(c);
  return `<p class="sub">failure ${k + 1} of ${order.size}, at ${shown(failures.rate[k])} 1/s, by ${escaped(failures.criterion[k])}</p>`;
}

// The crack

function isSplit() {
  return Boolean(data.scene.fragment) && Math.max(...data.scene.fragment) > 0 && state.step === order.size;
}

function goTo(step) {
  state.step = Math.min(order.size, Math.max(0, step));
  element("step").value = state.step;
  if (!isSplit()) element("parting").value = 0;
  element("parting").disabled = !isSplit();
  element("step-text").textContent = stepText();
  const failed = new Set(state.load === ORDER ? [] : failures.contact.slice(0, state.step));
  scene.show({ colours: crackColours(), failed, split: isSplit(), parting: Number(element("parting").value) });
  drawLegend();
  if (state.step) choose(failures.contact[state.step - 1]);
  else for (const chart of charts) chart.remark();
}

// In the order of failure only those that have failed are coloured.
function crackColours() {
  if (state.load !== ORDER || !state.step) return colours();
  return pairs.map((_, c) => ((order.get(c) ?? Infinity) < state.step ? orderColour(c) : PALE));
}

function stepText() {
  const k = state.step - 1;
  if (k < 0) return `whole; ${order.size} contact${order.size > 1 ? "s" : ""} will fail`;
  return `failure ${state.step} of ${order.size}: contact ${failures.contact[k]}, at ${shown(failures.rate[k])} 1/s, by ${failures.criterion[k]}`;
}

function play() {
  element("play").textContent = "Pause";
  if (state.step === order.size) goTo(0);
  schedule();
}

function pause() {
  clearTimeout(state.playing);
  state.playing = null;
  element("play").textContent = "Play";
}

function schedule() {
  const failing = Math.max(60, Math.min(700, 5000 / order.size));
  state.playing = setTimeout(advance, state.step < order.size ? failing : 60);
}

// The next failure, and after the last one the fragments part.
function advance() {
  const parting = element("parting");
  if (state.step < order.size) goTo(state.step + 1);
  else if (isSplit() && Number(parting.value) < 1) {
    parting.value = Number(parting.value) + 0.06;
    scene.part(Number(parting.value));
  } else {
    pause();
    return;
  }
  schedule();
}

// Turning, moving, zooming, choosing by pointer and keys

const pointers = new Map();
let travelled = 0;

function onDown(event) {
  scene.touched = true;
  scene.canvas.setPointerCapture(event.pointerId);
  if (!pointers.size) travelled = 0;
  pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
}

function onMove(event) {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const now = [event.offsetX, event.offsetY];
  const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
  travelled += Math.hypot(dx, dy);
  if (pointers.size === 2) pinch(event.pointerId, before, now);
  else if (event.shiftKey || event.buttons === 2) scene.camera.move(dx, dy);
  else scene.camera.turn(dx / 160, dy / 160);
  pointers.set(event.pointerId, now);
  scene.draw();
}

function pinch(id, before, now) {
  const other = [...pointers].find(([key]) => key !== id)[1];
  const length = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
  const middle = [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2];
  scene.camera.enlarge(length(now) / Math.max(1, length(before)), ...middle, ...scene.extent);
  scene.camera.move((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
}

function onUp(event) {
  const alone = pointers.size === 1;
  if (!pointers.delete(event.pointerId) || !alone || travelled > 4 || event.type !== "pointerup") return;
  const contact = scene.contactAt(event.offsetX, event.offsetY);
  if (contact !== null) choose(contact);
}

function zoom(factor) {
  scene.touched = true;
  scene.camera.enlarge(factor, ...scene.extent.map((length) => length / 2), ...scene.extent);
  scene.draw();
}

function onWheel(event) {
  if (!event.ctrlKey && document.activeElement !== scene.canvas) return;
  event.preventDefault();
  scene.touched = true;
  scene.camera.enlarge(Math.exp(-0.0015 * event.deltaY), event.offsetX, event.offsetY, ...scene.extent);
  scene.draw();
}

function onKey(event) {
  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  scene.touched = true;
  if (steps && event.shiftKey) scene.camera.move(24 * steps[0], 24 * steps[1]);
  else if (steps) scene.camera.turn(0.15 * steps[0], 0.15 * steps[1]);
  else if (event.key === "+" || event.key === "=") zoom(1.2);
  else if (event.key === "-") zoom(1 / 1.2);
  else if (event.key === "0") scene.reset();
  else return;
  event.preventDefault();
  scene.draw();
}

// Setting up

function chartsOf(parent) {
  const load = () => (state.load === ORDER ? data.loads[0] : state.load);
  const values = () => contacts[load().key];
  const distances = contacts.radial_position;
  const dots = (width) =>
    scatter(width, [distances, values()], contacts.contact, ["distance from the centre / Rg", withUnit(load())]);
  const chosen = (axes) => markPoint(axes, distances[state.chosen], values()[state.chosen]);
  const made = [];
  if (pairs.length > 1) {
    made.push(new Chart(parent, "", (width) => histogram(width, values(), withUnit(load()))));
    made.push(new Chart(parent, "", dots, chosen));
  }
  if (order.size > 1) {
    const now = (axes) => (state.step ? markLine(axes, state.step) : "");
    made.push(new Chart(parent, "Rates of failure, in sequence", (width) => sequence(width, failures, "1/s"), now));
  }
  const parts = data.tables.fragments;
  const number = parts?.rows.spheres.length ?? 0;
  const which = number > MOST_BARS ? `the ${MOST_BARS} largest of ${number}` : "sizes";
  if (number > 1) made.push(new Chart(parent, `${parts.title}: ${which}`, (width) => sizes(width, parts.rows.spheres)));
  if (data.tables.pieces) made.push(cascadeChart(parent, data.tables.pieces.rows));
  return made;
}

function retitle() {
  if (pairs.length < 2) return;
  const { label } = state.load === ORDER ? data.loads[0] : state.load;
  charts[0].title = `${label}: distribution over contacts`;
  charts[1].title = `${label} against distance from the centre`;
}

function onLoad() {
  const key = element("load").value;
  state.load = key === ORDER.key ? ORDER : data.loads.find((load) => load.key === key);
  retitle();
  if (failures) goTo(state.step);
  else scene.show({ colours: colours() });
  drawLegend();
  for (const chart of charts) chart.redraw();
}

function setUpControls() {
  const options = [...data.loads, ...(order.size > 1 ? [ORDER] : [])];
  element("load").innerHTML = options.map((load) => `<option value="${load.key}">${escaped(load.unit ? withUnit(load) : load.label)}</option>`).join("");
  element("load").addEventListener("change", onLoad);
  element("size").value = scene.isPainted ? 1 : pairs.length > 1.6 * data.scene.radii.length ? 0.5 : 0.8;
  element("size").addEventListener("input", () => scene.show({ size: Number(element("size").value) }));
  element("number").max = pairs.length - 1;
  element("number").addEventListener("change", () => {
    const number = Number(element("number").value);
    if (Number.isInteger(number) && number >= 0 && number < pairs.length) choose(number);
  });
  if (failures) setUpCrack();
}

function setUpCrack() {
  element("crack").hidden = false;
  element("step").max = order.size;
  element("step").addEventListener("input", () => goTo(Number(element("step").value)));
  element("back").addEventListener("click", () => goTo(state.step - 1));
  element("forth").addEventListener("click", () => goTo(state.step + 1));
  element("play").addEventListener("click", () => (state.playing ? pause() : play()));
  element("parting").addEventListener("input", () => scene.part(Number(element("parting").value)));
}

function setUpScene() {
  const { canvas } = scene;
  canvas.addEventListener("pointerdown", onDown);
  canvas.addEventListener("pointermove", onMove);
  canvas.addEventListener("pointerup", onUp);
  canvas.addEventListener("pointercancel", onUp);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", onWheel, { passive: false });
  canvas.addEventListener("keydown", onKey);
  element("zoom-in").addEventListener("click", () => zoom(1.25));
  element("zoom-out").addEventListener("click", () => zoom(0.8));
  element("reset").addEventListener("click", () => scene.reset());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => scene.show({}));
  for (const [name, printing] of [["beforeprint", true], ["afterprint", false]]) {
    window.addEventListener(name, () => { scene.printing = printing; scene.show({}); scene.render(); });
  }
}

const tables = Object.values(data.tables).map((table) => new SortedTable(element("tables"), table, choose));
const charts = chartsOf(element("charts"));
tables[0].sort("load_ratio", "descending");
for (const place of ["charts", "tables"]) {
  element(place).addEventListener("click", (event) => {
    const { contact, step } = event.target.dataset;
    if (step) goTo(Number(step));
    else if (contact) choose(Number(contact));
  });
}
setUpControls();
setUpScene();
scene.show({ size: Number(element("size").value), colours: colours() });
choose(data.critical ?? tables[0].order[0]);
onLoad();
scene.reset();
