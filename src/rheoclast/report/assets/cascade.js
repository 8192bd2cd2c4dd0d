// Who broke into whom: pieces in columns by generation, as high as their numbers of spheres, what they broke into on
// their right. What holds goes on to the right edge.

const LEAST_HEIGHT = 1.2; // pixels; pieces that are smaller are drawn together
const LABEL_ROOM = [13, 34]; // pixels

function cascadeChart(parent, pieces) {
  const chart = new Chart(parent, "Who broke into whom", (width) => cascade(width, pieces));
  chart.figure.classList.add("wide");
  chart.note = "Height: number of spheres. Blue breaks, into what is on its right; grey holds to the end.";
  return chart;
}

function cascade(width, pieces) {
  const last = Math.max(1, spread(pieces.generation)[1]);
  const axes = new Axes(width, [[-0.5, last + 0.5], [0, pieces.spheres[0]]], ["generation", "spheres"]);
  const children = pieces.piece.map(() => []);
  pieces.parent.forEach((from, k) => from !== null && children[from].push(k));
  return [axes, axes.drawn({ whole: true }) + blocks(axes, pieces, children, 0, 0, last + 0.5).join("")];
}

// A piece above some number of spheres, and all that came from it.
function blocks(axes, pieces, children, k, below, end) {
  const holds = pieces.holds[k] === "yes";
  const from = pieces.generation[k] - 0.5;
  const until = holds ? end : from + 1;
  const drawn = [block(axes, [from, until], [below, pieces.spheres[k]], holds, pieceText(pieces, k, children[k]))];
  const bySize = [...children[k]].sort((a, b) => pieces.spheres[b] - pieces.spheres[a]);
  const small = bySize.filter((child) => axes.y(0) - axes.y(pieces.spheres[child]) < LEAST_HEIGHT);
  let at = below;
  for (const child of bySize.slice(0, bySize.length - small.length)) {
    drawn.push(...blocks(axes, pieces, children, child, at, end));
    at += pieces.spheres[child];
  }
  const rest = small.reduce((sum, child) => sum + pieces.spheres[child], 0);
  if (rest) drawn.push(block(axes, [until, end], [at, rest], true, `${small.length} pieces of ${rest} spheres together`));
  return drawn;
}

function block(axes, [from, to], [below, spheres], holds, text) {
  const [x, y] = [axes.x(from), axes.y(below + spheres)];
  const [width, height] = [axes.x(to) - x, axes.y(below) - y];
  const gap = Math.min(1, 0.2 * height, 0.2 * width);
  const label = height > LABEL_ROOM[0] && width > LABEL_ROOM[1] ? `<text x="${x + 6}" y="${y + height / 2 + 4}">${spheres}</text>` : "";
  return `<g class="piece ${holds ? "holds" : "breaks"}"><rect x="${x}" y="${y}" width="${width - gap}" height="${height - gap}"><title>${escaped(text)}</title></rect>${label}</g>`;
}

function pieceText(pieces, k, children) {
  const size = `piece ${pieces.piece[k]}, ${pieces.spheres[k]} sphere${pieces.spheres[k] > 1 ? "s" : ""}`;
  if (pieces.holds[k] === "yes") return `${size}: holds`;
  return `${size}: ${pieces.failures[k]} failures from ${shown(pieces.initiation_rate[k])} 1/s on, ${children.length} left`;
}
