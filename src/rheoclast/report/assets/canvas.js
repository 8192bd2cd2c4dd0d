// The same picture without WebGL: discs and bars from back to front.

class CanvasRenderer {
  constructor(canvas) {
    this.context = canvas.getContext("2d");
    this.load(new Float32Array(0), new Float32Array(0));
  }

  load(spheres, cylinders) {
    [this.spheres, this.cylinders] = [spheres, cylinders];
  }

  draw(camera, [width, height], ratio, { reach, fog, paper }) {
    const { context } = this;
    [context.canvas.width, context.canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = css(paper);
    context.fillRect(0, 0, width, height);
    const faded = (colour, depth) => mixed(colour, paper, fog * (0.5 - (0.5 * depth) / reach));
    const pixel = (seen) => camera.pixel(seen, width, height);
    const shapes = [...this.discs(camera, pixel, faded), ...this.bars(camera, pixel, faded)];
    for (const { paint } of shapes.sort((one, other) => one.depth - other.depth)) paint();
  }

  *discs(camera, pixel, faded) {
    const rows = this.spheres;
    for (let k = 0; k < rows.length; k += 7) {
      const seen = camera.seen(rows, k);
      const colour = faded([...rows.subarray(k + 4, k + 7)], seen[2]);
      const [[x, y], radius] = [pixel(seen), rows[k + 3] * camera.zoom];
      yield { depth: seen[2], paint: () => this.disc(x, y, radius, colour) };
    }
  }

  *bars(camera, pixel, faded) {
    const rows = this.cylinders;
    for (let k = 0; k < rows.length; k += 10) {
      const [start, end] = [camera.seen(rows, k), camera.seen(rows, k + 3)];
      const depth = (start[2] + end[2]) / 2 + rows[k + 6];
      const colour = faded([...rows.subarray(k + 7, k + 10)], depth);
      yield { depth, paint: () => this.bar(pixel(start), pixel(end), 2 * rows[k + 6] * camera.zoom, colour) };
    }
  }

  disc(x, y, radius, colour) {
    const { context } = this;
    const shade = context.createRadialGradient(x - 0.35 * radius, y - 0.4 * radius, 0.1 * radius, x, y, radius);
    shade.addColorStop(0, css(mixed(colour, [1, 1, 1], 0.25)));
    shade.addColorStop(0.92, css(mixed(colour, [0, 0, 0], 0.35)));
    shade.addColorStop(1, css(mixed(colour, [0, 0, 0], 0.55)));
    context.fillStyle = shade;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
  }

  bar(start, end, width, colour) {
    const { context } = this;
    context.strokeStyle = css(colour);
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(...start);
    context.lineTo(...end);
    context.stroke();
  }
}

function css(colour) {
  return `rgb(${colour.map((value) => Math.round(255 * Math.min(1, value))).join(" ")})`;
}
