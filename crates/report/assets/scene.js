// What the moving picture shows: elements placed by numbers, and a camera.

/** The elements with their numbers, in one set of coordinates. */
class Scene {
  constructor(scene) {
    this.spatial = scene.spatial;
    this.dimension = scene.spatial ? 3 : 2;
    this.times = numbers(scene.times);
    this.ground = scene.spatial && scene.ground;
    this.elements = scene.elements.map((element, i) => ({
      ...element,
      ...element.shape,
      stride: (scene.strides ?? data.strides)[i],
      values: numbers(element.values),
    }));
    this.bounds = scene.bounds ?? this.findBounds();
    this.bodySize = this.findBodySize();
  }

  /** The numbers of an element at a time, between two frames in proportion. */
  at(element, time) {
    const { times } = this;
    const next = Math.max(1, Math.min(times.length - 1, lowerBound(times, time)));
    const here = Math.max(0, next - 1);
    const span = times[next] - times[here];
    const part = span > 0 ? Math.max(0, Math.min(1, (time - times[here]) / span)) : 0;
    const { stride, values } = element;
    const out = new Array(stride);
    for (let j = 0; j < stride; j++) {
      const a = values[here * stride + j] ?? NaN;
      out[j] = part === 0 ? a : a + (values[next * stride + j] - a) * part;
    }
    return out;
  }

  /** Points whose hull contains the element. */
  hull(element, v) {
    const d = this.dimension;
    const center = v.slice(0, d);
    const around = (radius) => [-1, 1].map((sign) => center.map((c) => c + sign * radius));
    switch (element.kind) {
      case "circle": return around(v.at(-1));
      case "sphere": return around(v.at(-1));
      case "wheel": return around(v.at(-2));
      case "blade": return around(v.at(-1) / 2);
      default: return Array.from({ length: Math.floor(v.length / d) }, (_, i) => v.slice(i * d, i * d + d));
    }
  }

  findBounds() {
    const bounds = Array.from({ length: this.dimension }, () => [Infinity, -Infinity]);
    const step = Math.max(1, Math.floor(this.times.length / 400));
    for (let frame = 0; frame < this.times.length; frame += step) {
      for (const element of this.elements) {
        for (const point of this.hull(element, this.at(element, this.times[frame]))) widen(bounds, point);
      }
    }
    return bounds.map(([low, high]) => (low <= high ? [low, high] : [-1, 1]));
  }

  /** Extent of the body itself in the first frame, without paths and scaffolding. */
  findBodySize() {
    const bounds = this.bodyBounds(this.times[0]);
    return Math.max(0, ...bounds.map(([low, high]) => high - low).filter(Number.isFinite));
  }

  bodyBounds(time) {
    const bounds = Array.from({ length: this.dimension }, () => [Infinity, -Infinity]);
    for (const element of this.elements) {
      if (element.kind === "trail" || element.tint === "muted") continue;
      for (const point of this.hull(element, this.at(element, time))) widen(bounds, point);
    }
    return bounds;
  }

  get size() { return Math.max(...this.bounds.map(([low, high]) => high - low), 1e-9); }
}

function widen(bounds, point) {
  point.forEach((c, i) => {
    if (!Number.isFinite(c)) return;
    bounds[i][0] = Math.min(bounds[i][0], c);
    bounds[i][1] = Math.max(bounds[i][1], c);
  });
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + (a[2] ?? 0) * (b[2] ?? 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => a.map((c) => c * s);
const plus = (a, b, s = 1) => a.map((c, i) => c + s * b[i]);
const unit = (a) => { const size = Math.hypot(...a); return size > 0 ? scaled(a, 1 / size) : a; };

/** Where points of the scene lie on the canvas. */
class Camera {
  constructor(scene, angles) {
    this.scene = scene;
    this.first = (angles ?? [-60, 25]).map((degrees) => degrees * Math.PI / 180);
    this.reset();
  }

  reset() {
    [this.azimuth, this.elevation] = this.first;
    this.zoom = 1;
    this.shift = [0, 0];
  }

  /** Prepares for a canvas of a size, looking at a target at a scale (pixels per length). */
  aim(width, height, target, scale) {
    this.center = [width / 2 + this.shift[0], height / 2 + this.shift[1]];
    this.target = target;
    this.scale = scale * this.zoom;
    if (!this.scene.spatial) { [this.right, this.up, this.toward] = [[1, 0], [0, 1], [0, 0]]; return; }
    const [sa, ca, se, ce] = [Math.sin(this.azimuth), Math.cos(this.azimuth), Math.sin(this.elevation), Math.cos(this.elevation)];
    this.right = [-sa, ca, 0];
    this.up = [-se * ca, -se * sa, ce];
    this.toward = [ce * ca, ce * sa, se];
  }

  to(point) {
    const p = plus(point, this.target, -1);
    return [this.center[0] + this.scale * dot(p, this.right), this.center[1] - this.scale * dot(p, this.up)];
  }

  depth(point) { return dot(point, this.toward); }

  /** The point of the plane picture under a place on the canvas. */
  from([px, py]) {
    return [this.target[0] + (px - this.center[0]) / this.scale, this.target[1] - (py - this.center[1]) / this.scale];
  }

  /** The scale at which the corners of a box fill the canvas. */
  fit(width, height, bounds) {
    const corners = [[]];
    for (const [low, high] of bounds) {
      for (const corner of corners.splice(0)) corners.push([...corner, low], [...corner, high]);
    }
    this.aim(width, height, bounds.map(([low, high]) => (low + high) / 2), 1);
    this.extent = (axis) => Math.max(...corners.map((c) => Math.abs(dot(plus(c, this.target, -1), this[axis])))) * 2;
    const [w, h] = [this.extent("right"), this.extent("up")];
    return Math.min((width - 70) / Math.max(w, 1e-12), (height - 70) / Math.max(h, 1e-12));
  }
}

