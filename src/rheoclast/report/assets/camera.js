// A parallel projection: what is turned by `rotation` (rows to the right, upwards, towards the viewer) is seen around
// `pan`, with `zoom` pixels per mean radius.

class Camera {
  constructor(axes) {
    this.first = axes;
    this.rotation = axes;
    this.pan = [0, 0];
    this.zoom = 1;
  }

  // Coordinates to the right, upwards and towards the viewer of the point that starts at `k` in a list.
  seen(points, k) {
    const r = this.rotation;
    const [x, y, z] = [points[k], points[k + 1], points[k + 2]];
    return [r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z, r[6] * x + r[7] * y + r[8] * z];
  }

  // Pixels from the upper left corner of a view of given size.
  pixel([x, y], width, height) {
    return [width / 2 + (x - this.pan[0]) * this.zoom, height / 2 - (y - this.pan[1]) * this.zoom];
  }

  // The opposite: right and upwards of a pixel.
  place(px, py, width, height) {
    return [this.pan[0] + (px - width / 2) / this.zoom, this.pan[1] - (py - height / 2) / this.zoom];
  }

  // Turn by angles about the upward and the right axis of the view.
  turn(about_up, about_right) {
    const [c, s, d, t] = [Math.cos(about_up), Math.sin(about_up), Math.cos(about_right), Math.sin(about_right)];
    this.rotation = product([c, 0, s, s * t, d, -c * t, -s * d, t, c * d], this.rotation);
  }

  move(px, py) {
    this.pan = [this.pan[0] - px / this.zoom, this.pan[1] + py / this.zoom];
  }

  // Enlarge, keeping what is at a pixel where it is.
  enlarge(factor, px, py, width, height) {
    const before = this.place(px, py, width, height);
    this.zoom *= factor;
    const after = this.place(px, py, width, height);
    this.pan = this.pan.map((value, k) => value + before[k] - after[k]);
  }

  // Let all spheres fill a window (left, top, right, bottom) of the view.
  fit(centers, radii, window, width, height) {
    const low = [Infinity, Infinity];
    const high = [-Infinity, -Infinity];
    for (let n = 0; n < radii.length; n++) {
      const at = this.seen(centers, 3 * n);
      for (let k = 0; k < 2; k++) {
        low[k] = Math.min(low[k], at[k] - radii[n]);
        high[k] = Math.max(high[k], at[k] + radii[n]);
      }
    }
    const [left, top, right, bottom] = window;
    this.zoom = Math.min((right - left) / (high[0] - low[0]), (bottom - top) / (high[1] - low[1]), 120);
    const middle = [((left + right - width) / 2) / this.zoom, ((height - top - bottom) / 2) / this.zoom];
    this.pan = [0, 1].map((k) => (low[k] + high[k]) / 2 - middle[k]);
  }
}

// Product of two 3 × 3 matrices, row by row.
function product(a, b) {
  return a.map((_, n) => [0, 1, 2].reduce((sum, k) => sum + a[3 * Math.floor(n / 3) + k] * b[3 * k + (n % 3)], 0));
}
