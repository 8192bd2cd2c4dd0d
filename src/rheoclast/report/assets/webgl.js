// Spheres and cylinders by WebGL 2. A sphere is a square that faces the viewer, each of whose pixels finds its own depth
// and normal, so that spheres are round at any size; a cylinder is a prism. All are drawn as instances, in two calls.

const SIDES = [20, 8]; // of the prism, and where there are many
const LEAST = 0.8; // pixels that the radius of a sphere has: smaller ones would vanish between pixels
const MANY_CYLINDERS = 3000;

const COMMON = `#version 300 es
precision highp float;
uniform mat3 rotation;
uniform vec2 pan, scale;
uniform float reach, fog, least;
uniform vec3 paper;
`;
const SHADING = `
vec3 lit(vec3 colour, vec3 normal, float height) {
  float light = 0.5 + 0.5 * dot(normal, normalize(vec3(-0.45, 0.6, 0.72)));
  vec3 shaded = colour * (0.34 + 0.78 * light * light) + 0.05 * pow(light, 24.0);
  float far = clamp(0.5 - 0.5 * height / reach, 0.0, 1.0);
  return mix(shaded, paper, fog * far);
}
float depth(float height) { return 0.5 - 0.5 * height / reach; }
`;
const SPHERE_VERTEX = `${COMMON}
layout(location = 0) in vec2 corner;
layout(location = 1) in vec3 center;
layout(location = 2) in float radius;
layout(location = 3) in vec3 colour;
out vec2 at;
flat out vec3 paint;
flat out vec2 size;
void main() {
  vec3 seen = rotation * center;
  at = corner * 1.02;
  paint = colour;
  size = vec2(max(radius, least), seen.z);
  gl_Position = vec4((seen.xy + at * size.x - pan) * scale, 0.0, 1.0);
}`;
const SPHERE_FRAGMENT = `${COMMON}${SHADING}
in vec2 at;
flat in vec3 paint;
flat in vec2 size;
out vec4 pixel;
void main() {
  float distance = length(at);
  float width = fwidth(distance);
  if (distance > 1.0) discard;
  vec3 normal = vec3(at, sqrt(max(0.0, 1.0 - distance * distance)));
  float height = size.y + size.x * normal.z;
  float rim = smoothstep(1.0 - min(2.5 * width, 0.12), 1.0, distance);
  pixel = vec4(lit(paint, normal, height) * (1.0 - 0.45 * rim), 1.0);
  gl_FragDepth = depth(height);
}`;
const CYLINDER_VERTEX = `${COMMON}${SHADING}
layout(location = 0) in vec3 corner; // cosine, sine, and 0 or 1 along the axis
layout(location = 1) in vec3 start;
layout(location = 2) in vec3 end;
layout(location = 3) in float radius;
layout(location = 4) in vec3 colour;
layout(location = 5) in float lid; // -1 or 1 on the ends, 0 on the side
out vec3 normal;
out float height;
flat out vec3 paint;
void main() {
  vec3 axis = normalize(end - start);
  vec3 across = normalize(cross(axis, abs(axis.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0)));
  vec3 outwards = corner.x * across + corner.y * cross(axis, across);
  vec3 seen = rotation * (mix(start, end, corner.z) + radius * outwards);
  normal = rotation * (lid == 0.0 ? outwards : lid * axis);
  height = seen.z;
  paint = colour;
  gl_Position = vec4((seen.xy - pan) * scale, 2.0 * depth(height) - 1.0, 1.0);
}`;
const CYLINDER_FRAGMENT = `${COMMON}${SHADING}
in vec3 normal;
in float height;
flat in vec3 paint;
out vec4 pixel;
void main() { pixel = vec4(lit(paint, normalize(normal), height), 1.0); gl_FragDepth = depth(height); }`;

class WebGLRenderer {
  constructor(canvas, count) {
    const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.gl = gl;
    this.spheres = new Instances(gl, [SPHERE_VERTEX, SPHERE_FRAGMENT], square(), [2], [3, 1, 3], 1);
    const corners = prism(SIDES[Number(count > MANY_CYLINDERS)]);
    this.cylinders = new Instances(gl, [CYLINDER_VERTEX, CYLINDER_FRAGMENT], corners, [3, 1], [3, 3, 1, 3], 1, [0, 5]);
    gl.enable(gl.DEPTH_TEST);
  }

  // Rows of centre, radius, colour; and of start, end, radius, colour; the ends of cylinders may be hidden in spheres.
  load(spheres, cylinders, endsInSight) {
    this.spheres.fill(spheres);
    this.cylinders.fill(cylinders);
    this.cylinders.shown = endsInSight ? 1 : 0.5;
  }

  draw(camera, [width, height], ratio, { reach, fog, paper }) {
    const { gl } = this;
    const { canvas } = gl;
    const size = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    gl.viewport(0, 0, ...size);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const scale = [(2 * camera.zoom) / width, (2 * camera.zoom) / height];
    const least = LEAST / (ratio * camera.zoom);
    for (const instances of [this.spheres, this.cylinders]) {
      instances.draw({ rotation: camera.rotation, pan: camera.pan, scale, reach, fog, least, paper });
    }
  }
}

// One shape, drawn many times: `shape` has a row per corner, the buffer that `fill` takes a row per instance.
class Instances {
  constructor(gl, shaders, shape, corner, instance, first, places = [0]) {
    this.gl = gl;
    this.program = program(gl, shaders);
    this.corners = shape.length / sum(corner);
    this.shown = 1; // share of the corners that is drawn
    this.stride = sum(instance);
    this.count = 0;
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    this.attributes(shape, corner, places, 0);
    this.buffer = this.attributes(new Float32Array(0), instance, instance.map((_, k) => first + k), 1);
  }

  attributes(values, lengths, places, divisor) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    let offset = 0;
    lengths.forEach((length, k) => {
      gl.enableVertexAttribArray(places[k]);
      gl.vertexAttribPointer(places[k], length, gl.FLOAT, false, 4 * sum(lengths), 4 * offset);
      gl.vertexAttribDivisor(places[k], divisor);
      offset += length;
    });
    return buffer;
  }

  fill(rows) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, rows, this.gl.DYNAMIC_DRAW);
    this.count = rows.length / this.stride;
  }

  draw({ rotation, pan, scale, reach, fog, least, paper }) {
    const { gl } = this;
    const at = (name) => gl.getUniformLocation(this.program, name);
    gl.useProgram(this.program);
    gl.uniformMatrix3fv(at("rotation"), true, rotation);
    gl.uniform2fv(at("pan"), pan);
    gl.uniform2fv(at("scale"), scale);
    gl.uniform1f(at("reach"), reach);
    gl.uniform1f(at("fog"), fog);
    gl.uniform1f(at("least"), least);
    gl.uniform3fv(at("paper"), paper);
    gl.bindVertexArray(this.array);
    gl.drawArraysInstanced(gl.TRIANGLES, 0, this.shown * this.corners, this.count);
  }
}

function program(gl, [vertex, fragment]) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made) || "no shader");
  return made;
}

function square() {
  return new Float32Array([-1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1, 1]);
}

// First the sides and then, as many corners again, the lids of a prism; a row (cosine, sine, along, lid) per corner of its
// triangles.
function prism(sides) {
  const [walls, lids] = [[], []];
  const circle = (k) => [Math.cos((2 * Math.PI * k) / sides), Math.sin((2 * Math.PI * k) / sides)];
  for (let k = 0; k < sides; k++) {
    const [a, b] = [circle(k), circle(k + 1)];
    for (const [point, along] of [[a, 0], [b, 0], [b, 1], [a, 0], [b, 1], [a, 1]]) walls.push(...point, along, 0);
    for (const along of [0, 1]) {
      for (const point of [[0, 0], a, b]) lids.push(...point, along, 2 * along - 1);
    }
  }
  return new Float32Array([...walls, ...lids]);
}

function sum(values) {
  return values.reduce((total, value) => total + value, 0);
}
