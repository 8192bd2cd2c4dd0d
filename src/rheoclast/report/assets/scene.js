// The aggregate: what is where at a stage of the crack, what lies under the pointer, and what stands beside the spheres.

const THICKNESS = [0.1, 0.45]; // radius of a contact in smaller radii: of the thinnest spheres, and how it grows
const APART = 0.9; // how far fragments part, in their distances from the centre
const MANY = 2000; // spheres, between which contacts are too small to be seen

class Scene {
  constructor(canvas, overlay, data) {
    Object.assign(this, data);
    this.canvas = canvas;
    this.overlay = overlay;
    this.camera = new Camera(data.axes);
    this.normals = this.pairs.map(([i, j]) => unit(difference(this.centers, 3 * j, 3 * i)));
    this.thinnest = this.pairs.map(([i, j]) => Math.min(this.radii[i], this.radii[j]));
    this.around = neighbours(this.pairs, this.radii.length);
    this.isPainted = this.radii.length > MANY;
    this.shifts = partings(this.centers, this.radii, this.fragment);
    this.state = { size: 1, parting: 0, chosen: null, colours: [], failed: new Set() };
    this.renderer = renderer(canvas, this.pairs.length);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => {
      this.renderer = renderer(canvas, this.pairs.length);
      this.show({});
    });
    new ResizeObserver(() => this.resized()).observe(canvas);
  }

  get extent() {
    return [this.canvas.clientWidth, this.canvas.clientHeight];
  }

  // All in sight again, from where it was seen first.
  reset() {
    this.camera.rotation = this.camera.first;
    this.touched = false;
    this.fit();
    this.draw();
  }

  fit() {
    const [width, height] = this.extent;
    if (!width) return; // not laid out yet; `resized` comes then
    this.camera.fit(this.moved, this.radii, [24, 92, width - 24, height - 84], width, height);
  }

  // Until the view is changed by hand it fills whatever room there is.
  resized() {
    if (this.moved && !this.touched) this.fit();
    this.draw();
  }

  // Let the fragments part, and keep them in sight.
  part(share) {
    this.show({ parting: share });
    const { zoom, pan } = this.camera;
    this.fit();
    if (this.camera.zoom > zoom) Object.assign(this.camera, { zoom, pan });
    this.draw();
  }

  choose(contact) {
    this.state.chosen = contact;
    if (this.moved) this.overlay.innerHTML = this.beside();
  }

  // Change what is shown: `size` of spheres, `parting` of fragments, `colours` of contacts, the set of `failed` ones, and
  // whether the aggregate has `split`.
  show(changes) {
    Object.assign(this.state, changes);
    this.place();
    this.renderer.load(this.sphereRows(), this.contactRows(), this.isParted);
    this.draw();
  }

  // Where everything is once the fragments have parted.
  place() {
    const { parting, size } = this.state;
    const moved = (points, spheres) =>
      Float32Array.from(points, (value, k) => value + parting * this.shifts[3 * spheres[Math.floor(k / 3)] + (k % 3)]);
    this.moved = moved(this.centers, this.radii.map((_, n) => n));
    this.halves = [0, 1].map((side) => {
      const spheres = this.pairs.map((pair) => pair[side]);
      const points = moved(this.points, spheres);
      const tips = points.map((value, k) => {
        const c = Math.floor(k / 3);
        return value + (2 * side - 1) * this.length(c, spheres[c], size) * this.normals[c][k % 3];
      });
      return { points, tips };
    });
    this.reach = farthest(this.moved, this.radii);
  }

  thickness(c) {
    return this.thinnest[c] * (THICKNESS[0] + THICKNESS[1] * this.state.size);
  }

  // From the contact point to where the contact meets a sphere as large as it is drawn.
  length(c, sphere, size) {
    const radius = size * this.radii[sphere];
    return this.radii[sphere] - Math.sqrt(Math.max(0, radius ** 2 - this.thickness(c) ** 2)) + 0.02;
  }

  sphereRows() {
    const paint = rowsOf(this.sphereColours());
    return interleaved(this.radii.length, (n) => [
      ...this.moved.subarray(3 * n, 3 * n + 3), this.state.size * this.radii[n], ...paint(n),
    ]);
  }

  // Pale, with the colour of the fragment once the last contact has failed; of very many, that of its most loaded contact.
  sphereColours() {
    const { sphere } = this.theme();
    if (this.state.split) {
      const colours = this.fragment_colours.map(rgb);
      return this.fragment.map((k) => mixed(colours[Math.min(k, colours.length - 1)], sphere, 0.15));
    }
    if (!this.isPainted) return this.radii.map(() => sphere);
    const colours = this.contactColours();
    const boldness = colours.map((colour) => Math.hypot(...colour.map((value, k) => value - PALE[k])));
    return this.around.map((all) => all.reduce((best, c) => (boldness[c] > boldness[best] ? c : best), all[0])).map((c) => colours[c]);
  }

  contactColours() {
    const { failed: ink } = this.theme();
    return this.state.colours.map((colour, c) => (this.state.failed.has(c) ? ink : colour));
  }

  get isParted() {
    return this.state.parting > 0;
  }

  // From sphere to sphere; each contact in two halves once fragments are apart.
  contactRows() {
    const colours = this.contactColours();
    const [first, second] = this.halves;
    const ends = this.isParted ? this.halves.map(({ points, tips }) => [points, tips]) : [[first.tips, second.tips]];
    return interleaved(ends.length * this.pairs.length, (k) => {
      const c = Math.floor(k / ends.length);
      const [from, to] = ends[k % ends.length].map((list) => list.subarray(3 * c, 3 * c + 3));
      return [...from, ...to, this.thickness(c), ...colours[c]];
    });
  }

  theme() {
    return this.printing ? { paper: [1, 1, 1], sphere: [0.8, 0.82, 0.84], failed: [0.1, 0.1, 0.1] } : theme();
  }

  // At most once per picture of the screen, however often it is asked for.
  draw() {
    this.waiting ??= requestAnimationFrame(() => this.render());
  }

  render() {
    cancelAnimationFrame(this.waiting);
    this.waiting = undefined;
    const [width, height] = this.extent;
    if (!this.moved || !width) return;
    const ratio = Math.max(2, window.devicePixelRatio);
    const fog = (0.5 * this.reach) / (this.reach + 8);
    this.overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.renderer.draw(this.camera, [width, height], ratio, { reach: this.reach, fog, paper: this.theme().paper });
    this.overlay.innerHTML = this.beside();
  }

  // What stands beside the spheres and around the chosen contact.
  beside() {
    const [width, height] = this.extent;
    if (!width) return "";
    return this.scaleBar(height) + this.axesAndFlow(width, height) + this.ring(width, height);
  }

  // The contact under a pixel: one that is hit, or the nearest one of the sphere that is.
  contactAt(px, py) {
    const [width, height] = this.extent;
    const [x, y] = this.camera.place(px, py, width, height);
    let nearest = { height: -Infinity, contact: null };
    for (let n = 0; n < this.radii.length; n++) {
      const at = this.camera.seen(this.moved, 3 * n);
      const depth = heightOver(at, at, x, y, this.state.size * this.radii[n]);
      if (depth > nearest.height) nearest = { height: depth, sphere: n };
    }
    for (const { points, tips } of this.halves) {
      for (let c = 0; c < this.pairs.length; c++) {
        const ends = [points, tips].map((list) => this.camera.seen(list, 3 * c));
        const depth = heightOver(...ends, x, y, this.thickness(c));
        if (depth > nearest.height) nearest = { height: depth, contact: c };
      }
    }
    if (nearest.sphere === undefined) return nearest.contact;
    return this.nearestOf(nearest.sphere, [x, y, nearest.height]);
  }

  nearestOf(sphere, place) {
    const away = (c) => {
      const side = this.pairs[c][0] === sphere ? 0 : 1;
      const at = this.camera.seen(this.halves[side].points, 3 * c);
      return Math.hypot(...at.map((value, k) => value - place[k]));
    };
    return this.around[sphere].reduce((best, c) => (best === null || away(c) < away(best) ? c : best), null);
  }

  scaleBar(height) {
    const length = roundDown((110 * this.radius) / this.camera.zoom);
    const pixels = (length * this.camera.zoom) / this.radius;
    const y = height - 34;
    return `<g id="scale-bar" data-length="${length}" data-pixels="${pixels}">
      <line x1="16" x2="${16 + pixels}" y1="${y}" y2="${y}" stroke="currentColor" stroke-width="3"/>
      <text x="16" y="${y + 18}">${quoted(length, this.length_unit)}</text></g>`;
  }

  // Axes of coordinates, and the principal strain rates as pairs of arrows.
  axesAndFlow(width, height) {
    const y = height - 46;
    const axes = ["x", "y", "z"].map((name, k) => {
      const [dx, dy] = this.camera.seen([0, 1, 2].map((n) => Number(n === k)), 0).map((part) => 24 * part);
      const from = [width - 42, y];
      const aside = Math.hypot(dx, dy) < 12 ? [-11, -11] : [1.45 * dx, 1.45 * dy]; // of an axis seen end on
      return `${arrow(from, [from[0] + dx, from[1] - dy], "var(--faint)")}
        <text class="faint" x="${from[0] + aside[0]}" y="${from[1] - aside[1] + 4}" text-anchor="middle">${name}</text>`;
    });
    return axes.join("") + this.strainArrows(width - 122, y);
  }

  strainArrows(x, y) {
    const { rates, directions } = this.strain;
    const arrows = rates.flatMap((rate, k) => {
      const [dx, dy] = this.camera.seen(directions[k], 0);
      const ends = [7, 9 + 21 * Math.abs(rate)];
      if (rate < 0) ends.reverse();
      const tips = (side) => ends.map((length) => [x + side * length * dx, y - side * length * dy]);
      const seen = Math.abs(rate) > 0.02 && Math.hypot(dx, dy) > 0.25;
      return seen ? [1, -1].map((side) => arrow(...tips(side), `var(--${rate > 0 ? "stretched" : "squeezed"})`)) : [];
    });
    return arrows.length ? `${arrows.join("")}<text class="faint" x="${x}" y="${y + 42}" text-anchor="middle">flow</text>` : "";
  }

  // Around the chosen contact; dashed where spheres hide it.
  ring(width, height) {
    const c = this.state.chosen;
    if (c === null) return "";
    const at = this.camera.seen(this.halves[0].points, 3 * c);
    const [x, y] = this.camera.pixel(at, width, height);
    const radius = Math.max(8, 1.5 * this.thickness(c) * this.camera.zoom);
    const dashes = this.isHidden(at, c) ? `stroke-dasharray="4 3"` : "";
    const circle = (style) => `<circle cx="${x}" cy="${y}" r="${radius}" fill="none" ${style}/>`;
    return circle(`stroke="var(--paper)" stroke-width="4" opacity="0.8"`) + circle(`id="ring" stroke="var(--ink)" stroke-width="1.8" ${dashes}`);
  }

  isHidden([x, y, depth], contact) {
    return this.radii.some((radius, n) => {
      if (this.pairs[contact].includes(n)) return false;
      const at = this.camera.seen(this.moved, 3 * n);
      return heightOver(at, at, x, y, this.state.size * radius) > depth + this.thickness(contact);
    });
  }
}

function renderer(canvas, contacts) {
  try {
    return new WebGLRenderer(canvas, contacts);
  } catch {
    return new CanvasRenderer(canvas);
  }
}

// Height at (x, y) of the surface around a line between two points; −∞ beside it.
function heightOver(start, end, x, y, radius) {
  const along = [end[0] - start[0], end[1] - start[1]];
  const length2 = along[0] ** 2 + along[1] ** 2;
  const share = length2 ? ((x - start[0]) * along[0] + (y - start[1]) * along[1]) / length2 : 0;
  const at = Math.min(1, Math.max(0, share));
  const distance2 = (start[0] + at * along[0] - x) ** 2 + (start[1] + at * along[1] - y) ** 2;
  if (distance2 > radius ** 2) return -Infinity;
  return start[2] + at * (end[2] - start[2]) + Math.sqrt(radius ** 2 - distance2);
}

// How far every sphere moves with its fragment, away from the centre of mass, which is the origin.
function partings(centers, radii, fragment) {
  if (!fragment) return new Float32Array(3 * radii.length);
  const sums = Array.from({ length: Math.max(...fragment) + 1 }, () => [0, 0, 0, 0]);
  fragment.forEach((part, n) => {
    const mass = radii[n] ** 3;
    for (let k = 0; k < 3; k++) sums[part][k] += mass * centers[3 * n + k];
    sums[part][3] += mass;
  });
  return Float32Array.from(centers, (_, k) => {
    const part = sums[fragment[Math.floor(k / 3)]];
    return (APART * part[k % 3]) / part[3];
  });
}

function farthest(centers, radii) {
  return radii.reduce((most, radius, n) => Math.max(most, Math.hypot(...centers.subarray(3 * n, 3 * n + 3)) + radius), 0);
}

function neighbours(pairs, count) {
  const around = Array.from({ length: count }, () => []);
  pairs.forEach((pair, c) => pair.forEach((sphere) => around[sphere].push(c)));
  return around;
}

function difference(points, one, other) {
  return [0, 1, 2].map((k) => points[one + k] - points[other + k]);
}

function unit(vector) {
  const length = Math.hypot(...vector);
  return vector.map((value) => value / length);
}

function rowsOf(list) {
  return (n) => list[n];
}

function interleaved(count, row) {
  return Float32Array.from(Array.from({ length: count }, (_, k) => row(k)).flat());
}

function arrow(from, to, colour) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  if (length < 1) return "";
  const head = Math.min(6, 0.6 * length);
  const [ux, uy] = [dx / length, dy / length];
  const base = [to[0] - head * ux, to[1] - head * uy];
  const wing = (side) => [base[0] - side * 0.45 * head * uy, base[1] + side * 0.45 * head * ux];
  return `<line x1="${from[0]}" y1="${from[1]}" x2="${base[0]}" y2="${base[1]}" stroke="${colour}" stroke-width="1.8"/>
    <polygon points="${[to, wing(1), wing(-1)].map((point) => point.join(",")).join(" ")}" fill="${colour}"/>`;
}
