// The moving picture, drawn on a canvas: in the plane as it is, in space seen from a camera that
// can be turned, without perspective, so that lengths compare.

function setUpAnimation() {
  const figure = find("#animation");
  const scene = data.animation;
  if (figure && scene?.times.length) new Player(figure, scene, clock).begin();
  else if (data.trajectory?.times.length) clock.set(data.trajectory.times[0]);
}

function setUpAlbums() {
  for (const figure of findAll("[data-album]")) {
    const pictures = data.albums?.[Number(figure.dataset.album)];
    if (pictures?.length && !find("canvas", figure)) new Album(figure, pictures);
  }
}

/** Moving pictures of which one is shown, each with a time of its own. */
class Album {
  constructor(figure, pictures) {
    this.figure = figure;
    this.pictures = pictures;
    const label = make("label", { class: "choice" }, null, `${figure.dataset.choice} `);
    figure.prepend(label);
    this.choice = make("select", {}, label);
    pictures.forEach(({ name }, i) => make("option", { value: i }, this.choice, name));
    this.choice.addEventListener("change", () => this.show(Number(this.choice.value)));
    this.frame = make("div");
    label.after(this.frame);
    this.said = make("p", { class: "hint", "aria-live": "polite" }, null);
    this.frame.after(this.said);
    this.show(0);
  }

  show(i) {
    const isPlaying = this.player?.playing ?? false;
    this.player?.end();
    this.frame.replaceChildren();
    this.said.textContent = this.pictures[i].explanation;
    this.player = new Player(this.frame, this.pictures[i].animation, newClock());
    const { player } = this;
    player.repeat.checked = true;
    // What matters is the body beside its place, not how far both travel.
    player.follow.checked = player.scene.bodySize > 0 && player.scene.bodySize < player.scene.size / 6;
    player.paint();
    player.setPlaying(isPlaying);
  }
}

class Player {
  constructor(figure, spec, ownClock) {
    this.figure = figure;
    this.spec = spec;
    this.clock = ownClock;
    this.scene = new Scene(spec);
    this.camera = new Camera(this.scene, spec.camera);
    this.first = this.scene.times[0];
    this.last = this.scene.times.at(-1);
    this.build();
    this.listen();
    this.readColors();
    this.clock.set(this.first);
  }

  /** Stops for good: another picture takes the place. */
  end() {
    this.setPlaying(false);
    this.clock.listeners.length = 0;
    const place = themed.indexOf(this.repaint);
    if (place >= 0) themed.splice(place, 1);
  }

  build() {
    this.stage = make("div", { class: "stage" });
    this.figure.prepend(this.stage);
    const label = this.spec.description ?? this.figure.getAttribute("aria-label");
    this.canvas = make("canvas", { tabindex: 0, role: "img", "aria-label": label }, this.stage);
    this.canvas.title = this.scene.spatial ? words.hintSpatial : words.hintPlanar;
    const bar = make("div", { class: "controls" });
    this.stage.after(bar);
    this.playButton = make("button", { type: "button", class: "play" }, bar);
    this.slider = make("input", {
      type: "range", ...(this.clock === clock ? { id: "time-slider" } : {}), min: this.first, max: this.last, step: "any", value: this.first, "aria-label": words.time,
    }, bar);
    this.clockText = make("span", { class: "time" }, bar);
    const options = make("div", { class: "options" });
    bar.after(options);
    this.buildSpeed(options);
    this.follow = this.option(options, words.follow, this.scene.bodySize > 0 && this.scene.bodySize < this.scene.size / 40);
    this.repeat = this.option(options, words.repeat, false);
    this.ghosts = this.option(options, words.ghosts, false);
    this.ghosts.addEventListener("change", () => this.paint());
    this.fade = 1;
    this.resetButton = make("button", { type: "button", class: "plain" }, options, words.resetView);
    this.buildExports(options);
    this.buildKey(options);
    this.setPlaying(false);
  }

  /** The picture as it stands as PNG; the motion as a film, where the browser can record one. */
  buildExports(parent) {
    const save = (blob, ending) => {
      const link = make("a", { href: URL.createObjectURL(blob), download: `${document.title}.${ending}` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    };
    make("button", { type: "button", class: "plain" }, parent, "PNG")
      .addEventListener("click", () => this.canvas.toBlob((blob) => blob && save(blob, "png")));
    if (!globalThis.MediaRecorder || !this.canvas.captureStream || !MediaRecorder.isTypeSupported("video/webm")) return;
    const button = make("button", { type: "button", class: "plain" }, parent, words.film);
    button.addEventListener("click", () => {
      const parts = [];
      const recorder = new MediaRecorder(this.canvas.captureStream(30), { mimeType: "video/webm" });
      recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
      recorder.addEventListener("stop", () => {
        button.disabled = false;
        save(new Blob(parts, { type: "video/webm" }), "webm");
      });
      button.disabled = true;
      this.repeat.checked = false;
      this.clock.set(this.first);
      recorder.start();
      this.setPlaying(true);
      const wait = setInterval(() => {
        if (this.playing) return;
        clearInterval(wait);
        recorder.stop();
      }, 100);
    });
  }

  option(parent, text, value) {
    const label = make("label", {}, parent);
    const box = make("input", { type: "checkbox" }, label);
    box.checked = value;
    label.append(` ${text}`);
    return box;
  }

  /** Speeds about the one at which the motion takes some ten seconds. */
  buildSpeed(parent) {
    const label = make("label", {}, parent, `${words.speed} `);
    this.speed = make("select", {}, label);
    const duration = this.last - this.first;
    const base = !(duration > 0) || (duration >= 3 && duration <= 25) ? 1 : roundSpeed(duration / 12);
    const speeds = new Set([0.1, 0.2, 0.5, 1, 2, 5, 10].map((factor) => Number((factor * base).toPrecision(1))));
    speeds.add(1);
    for (const speed of [...speeds].sort((a, b) => a - b)) {
      make("option", { value: speed }, this.speed, `× ${readable(speed)}`);
    }
    this.speed.value = String(base);
  }

  buildKey(parent) {
    const named = this.scene.elements.filter((element) => element.name);
    if (!named.length) return;
    const key = make("ul", { class: "key" }, parent);
    for (const element of named) {
      const item = make("li", {}, key);
      make("i", { class: `swatch tint-${element.tint}`, "aria-hidden": "true" }, item);
      item.append(element.name);
    }
  }

  /** The motion starts by itself once it is in view, unless the reader prefers stillness. */
  begin() {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    const observer = new IntersectionObserver((entries) => {
      if (!entries.at(-1).isIntersecting) return;
      observer.disconnect();
      if (this.clock.time === this.first) this.setPlaying(true);
    }, { threshold: 0.5 });
    observer.observe(this.canvas);
  }

  listen() {
    this.clock.listeners.push((time) => this.show(time));
    this.repaint = () => { this.readColors(); this.paint(); };
    themed.push(this.repaint);
    new ResizeObserver(() => this.resize()).observe(this.stage);
    this.playButton.addEventListener("click", () => this.setPlaying(!this.playing));
    this.slider.addEventListener("input", () => { this.setPlaying(false); this.clock.set(Number(this.slider.value)); });
    this.follow.addEventListener("change", () => { this.camera.reset(); this.paint(); });
    this.resetButton.addEventListener("click", () => this.resetView());
    this.canvas.addEventListener("dblclick", () => this.resetView());
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    this.canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== this.canvas) return;
      event.preventDefault();
      this.zoomAbout([event.offsetX, event.offsetY], Math.exp(-Math.max(-1, Math.min(1, event.deltaY / 300))));
    }, { passive: false });
    this.listenToPointer();
  }

  listenToPointer() {
    let last = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      last = [event.clientX, event.clientY];
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!last) return;
      const [dx, dy] = [event.clientX - last[0], event.clientY - last[1]];
      last = [event.clientX, event.clientY];
      const { camera } = this;
      if (this.scene.spatial && !event.shiftKey) {
        camera.azimuth -= dx / 120;
        camera.elevation = Math.max(-0.2, Math.min(Math.PI / 2, camera.elevation + dy / 120));
      } else camera.shift = plus(camera.shift, [dx, dy]);
      this.paint();
    });
    for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => { last = null; });
  }

  zoomAbout(place, factor) {
    const { camera } = this;
    const from = plus(place, camera.center, -1);
    camera.zoom *= factor;
    camera.shift = plus(camera.shift, scaled(from, 1 - factor));
    this.paint();
  }

  resetView() {
    this.camera.reset();
    this.paint();
  }

  key(event) {
    const step = (this.last - this.first) / (event.shiftKey ? 20 : 200);
    const to = (time) => { this.setPlaying(false); this.clock.set(Math.max(this.first, Math.min(this.last, time))); };
    const middle = this.camera.center;
    switch (event.key) {
      case " ": this.setPlaying(!this.playing); break;
      case "ArrowLeft": to(this.clock.time - step); break;
      case "ArrowRight": to(this.clock.time + step); break;
      case "Home": to(this.first); break;
      case "End": to(this.last); break;
      case "+": case "=": this.zoomAbout(middle, 1.3); break;
      case "-": this.zoomAbout(middle, 1 / 1.3); break;
      case "0": this.resetView(); break;
      default: return;
    }
    event.preventDefault();
  }

  setPlaying(playing) {
    this.playing = playing;
    this.playButton.textContent = playing ? "❚❚" : "▶";
    this.playButton.setAttribute("aria-label", playing ? words.pause : words.play);
    this.playButton.title = playing ? words.pause : words.play;
    if (!playing) return;
    if (this.clock.time >= this.last) this.clock.set(this.first);
    let before = null;
    const advance = (now) => {
      if (!this.playing) return;
      // A page that was hidden does not jump.
      const passed = before === null ? 0 : Math.min(0.1, (now - before) / 1000);
      before = now;
      let time = this.clock.time + passed * Number(this.speed.value);
      if (time >= this.last) {
        if (this.repeat.checked) time = this.first;
        else { time = this.last; this.setPlaying(false); }
      }
      this.clock.set(time);
      requestAnimationFrame(advance);
    };
    requestAnimationFrame(advance);
  }

  show(time) {
    this.slider.value = time;
    const timeUnit = data.trajectory?.timeUnit;
    const decimals = Math.max(0, Math.min(9, 3 - Math.floor(Math.log10(Math.max(this.last - this.first, 1e-9)))));
    this.clockText.textContent = `${time.toFixed(decimals).replace("-", "−")}${timeUnit ? ` ${timeUnit}` : ""}`;
    this.slider.setAttribute("aria-valuetext", this.clockText.textContent);
    this.paint();
  }

  resize() {
    const width = this.stage.clientWidth;
    // A flat picture takes no more height than it fills.
    const most = Math.max(240, Math.min(460, width * 0.56));
    const camera = new Camera(this.scene, this.spec.camera);
    const across = camera.fit(width, 1e9, this.scene.bounds);
    const height = Math.round(Math.max(180, Math.min(most, across * camera.extent("up") + 70)));
    const ratio = devicePixelRatio || 1;
    this.canvas.style.height = `${height}px`;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    [this.width, this.height, this.ratio] = [width, height, ratio];
    this.fitted = new Camera(this.scene, this.spec.camera).fit(width, height, this.scene.bounds);
    this.paint();
  }

  /** The colors of the style sheet, as the browser resolves them. */
  readColors() {
    const probe = make("span", { hidden: "" }, this.figure);
    this.colors = {};
    for (const name of ["ink", "muted", "blue", "red", "green", "amber", "violet", "teal", "grid", "paper"]) {
      probe.className = `tint-${name}`;
      this.colors[name] = getComputedStyle(probe).color;
    }
    probe.remove();
    this.font = getComputedStyle(this.clockText).fontFamily;
  }

  // Drawing.

  paint() {
    if (!this.width) return;
    const { canvas, scene } = this;
    const time = Number.isFinite(this.clock.time) ? this.clock.time : this.first;
    const g = canvas.getContext("2d");
    this.g = g;
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    g.clearRect(0, 0, this.width, this.height);
    g.lineCap = g.lineJoin = "round";
    this.aim(time);
    this.paintGround();
    const shapes = scene.elements.flatMap((element) => {
      const v = scene.at(element, time);
      return v.some(Number.isNaN) ? [] : [{ element, v, depth: this.depth(element, v) }];
    });
    if (scene.spatial) shapes.sort((a, b) => a.depth - b.depth);
    if (this.ghosts.checked) this.paintGhosts(time);
    for (const { element, v } of shapes) this.paintElement(element, v, time);
    this.paintScale();
  }

  /** The bodies at earlier times, faintly: a stroboscopic picture. */
  paintGhosts(time) {
    const { scene } = this;
    const still = (element) => ["trail", "label"].includes(element.kind) || element.tint === "muted";
    this.fade = 0.22;
    for (let i = 0; i < 8; i++) {
      const then = this.first + (time - this.first) * i / 8;
      for (const element of scene.elements) {
        const v = still(element) ? [NaN] : scene.at(element, then);
        if (!v.some(Number.isNaN)) this.paintElement(element, v, then);
      }
    }
    this.fade = 1;
  }

  aim(time) {
    const { camera, scene } = this;
    let [bounds, scale] = [scene.bounds, this.fitted];
    if (this.follow.checked && scene.bodySize > 0) {
      const body = scene.bodyBounds(time);
      if (body.every(([low, high]) => low <= high)) {
        bounds = body;
        scale = Math.min(this.width, this.height) / (scene.bodySize * 5);
      }
    }
    camera.aim(this.width, this.height, bounds.map(([low, high]) => (low + high) / 2), scale);
  }

  /** Paths lie behind everything, labels before. */
  depth(element, v) {
    if (element.kind === "trail") return -Infinity;
    if (element.kind === "label") return Infinity;
    const points = this.scene.hull(element, v);
    return points.reduce((sum, point) => sum + this.camera.depth(point), 0) / points.length;
  }

  /** A grid whose lines stay on round coordinates: of the picture's plane, or of the ground. */
  paintGround() {
    const { g, scene, camera } = this;
    g.strokeStyle = this.colors.grid;
    g.lineWidth = 1;
    if (scene.spatial) {
      if (scene.ground) this.paintFloor();
      return;
    }
    const [a, b] = [camera.from([0, this.height]), camera.from([this.width, 0])];
    this.gridStep = niceStep(0, 90 / camera.scale, 1);
    g.beginPath();
    for (let x = Math.ceil(a[0] / this.gridStep); x * this.gridStep < b[0]; x++) {
      const px = camera.to([x * this.gridStep, 0])[0];
      g.moveTo(px, 0);
      g.lineTo(px, this.height);
    }
    for (let y = Math.ceil(a[1] / this.gridStep); y * this.gridStep < b[1]; y++) {
      const py = camera.to([0, y * this.gridStep])[1];
      g.moveTo(0, py);
      g.lineTo(this.width, py);
    }
    g.stroke();
  }

  paintFloor() {
    const { g, scene } = this;
    const step = niceStep(0, scene.size, 10);
    const [x, y] = scene.bounds.slice(0, 2).map(([low, high]) => [Math.floor(low / step) - 1, Math.ceil(high / step) + 1]);
    g.beginPath();
    for (let i = x[0]; i <= x[1]; i++) this.trace([[i * step, y[0] * step, 0], [i * step, y[1] * step, 0]]);
    for (let j = y[0]; j <= y[1]; j++) this.trace([[x[0] * step, j * step, 0], [x[1] * step, j * step, 0]]);
    g.stroke();
  }

  /** Adds a broken line to the path of the canvas; points that are not finite leave a gap. */
  trace(points, close = false) {
    const { g, camera } = this;
    let isDown = false;
    for (const point of points) {
      const [x, y] = camera.to(point);
      if (!Number.isFinite(x) || !Number.isFinite(y)) { isDown = false; continue; }
      if (isDown) g.lineTo(x, y);
      else g.moveTo(x, y);
      isDown = true;
    }
    if (close) g.closePath();
  }

  line(points, { width = 2, close = false, fill = 0, alpha = 1 } = {}) {
    const { g } = this;
    g.beginPath();
    this.trace(points, close);
    if (fill > 0) { g.globalAlpha = fill * this.fade; g.fill(); }
    g.globalAlpha = alpha * this.fade;
    g.lineWidth = width;
    g.stroke();
    g.globalAlpha = 1;
  }

  paintElement(element, v, time) {
    const { g, camera, scene } = this;
    const d = scene.dimension;
    g.strokeStyle = g.fillStyle = this.colors[element.tint] ?? this.colors.ink;
    const [a, b] = [v.slice(0, d), v.slice(d, 2 * d)];
    switch (element.kind) {
      case "point": this.disc(camera.to(a), 4.5); break;
      case "segment": this.line([a, b]); break;
      case "arrow": this.arrow(a, b); break;
      case "circle": this.line(this.ring(a, v.slice(d, -1), v.at(-1)).points, { close: true }); break;
      case "sphere": this.sphere(camera.to(a), v.at(-1) * camera.scale); break;
      case "wheel": this.wheel(a, v.slice(d, -2), v.at(-2), v.at(-1)); break;
      case "blade": this.blade(a, v.slice(d, -1), v.at(-1)); break;
      case "polyline": {
        const points = Array.from({ length: element.points }, (_, i) => v.slice(i * d, i * d + d));
        this.line(points, { close: element.closed, fill: element.filled ? 0.18 : 0 });
        break;
      }
      case "trail": this.trail(element, time, a); break;
      case "label": this.label(camera.to(a), element.text); break;
    }
  }

  disc([x, y], radius) {
    this.g.globalAlpha = this.fade;
    this.g.beginPath();
    this.g.arc(x, y, radius, 0, 2 * Math.PI);
    this.g.fill();
    this.g.globalAlpha = 1;
  }

  arrow(tail, tip) {
    this.line([tail, tip]);
    const [a, b] = [this.camera.to(tail), this.camera.to(tip)];
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (length < 2) return;
    const along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    const head = Math.min(9, length / 2);
    this.g.beginPath();
    this.g.moveTo(...b);
    for (const side of [-1, 1]) {
      this.g.lineTo(b[0] - head * along[0] + side * head * 0.45 * along[1], b[1] - head * along[1] - side * head * 0.45 * along[0]);
    }
    this.g.fill();
  }

  /** Points of a circle with the two directions that span it. */
  ring(center, axis, radius) {
    let [e1, e2] = [[1, 0], [0, 1]];
    if (this.scene.spatial) {
      const n = unit(axis);
      const level = cross([0, 0, 1], n);
      e1 = Math.hypot(...level) > 1e-9 ? unit(level) : [1, 0, 0];
      e2 = cross(n, e1);
    }
    const on = (angle) => plus(plus(center, e1, radius * Math.cos(angle)), e2, radius * Math.sin(angle));
    return { on, points: Array.from({ length: 64 }, (_, i) => on(i * Math.PI / 32)) };
  }

  wheel(center, axis, radius, angle) {
    const { on, points } = this.ring(center, axis, radius);
    this.line(points, { close: true, fill: 0.16, width: 2.5 });
    this.line([center, on(angle)], { width: 2.5 });
    this.line([on(angle + Math.PI), center], { width: 1, alpha: 0.5 });
    this.disc(this.camera.to(center), 3);
  }

  sphere([x, y], radius) {
    const { g } = this;
    const color = g.fillStyle;
    const light = g.createRadialGradient(x - radius * 0.35, y - radius * 0.4, 0, x - radius * 0.35, y - radius * 0.4, radius * 1.3);
    light.addColorStop(0, "rgb(255 255 255 / 0.75)");
    light.addColorStop(1, "rgb(255 255 255 / 0)");
    g.beginPath();
    g.arc(x, y, radius, 0, 2 * Math.PI);
    g.globalAlpha = 0.6 * this.fade;
    g.fill();
    g.fillStyle = light;
    g.fill();
    g.globalAlpha = 1;
    g.lineWidth = 1.5;
    g.stroke();
    g.fillStyle = color;
  }

  blade(center, direction, length) {
    const along = this.scene.spatial ? unit(direction) : [Math.cos(direction[0]), Math.sin(direction[0])];
    this.line([plus(center, along, -length / 2), plus(center, along, length / 2)], { width: 5 });
    this.g.fillStyle = this.colors.paper;
    this.disc(this.camera.to(center), 1.5);
  }

  /** The whole path faintly, the part already run in full. */
  trail(element, time, present) {
    const { times } = this.scene;
    const { stride, values } = element;
    const step = Math.max(1, Math.ceil(times.length / 3000));
    const [whole, past] = [[], []];
    for (let i = 0; i < times.length; i += step) {
      const point = [...values.subarray(i * stride, (i + 1) * stride)];
      whole.push(point);
      if (times[i] <= time) past.push(point);
    }
    past.push(present);
    this.line(whole, { width: 1.2, alpha: 0.28 });
    this.line(past, { width: 1.8, alpha: 0.9 });
  }

  label([x, y], text) {
    this.g.font = `13px ${this.font}`;
    this.g.fillText(text, x + 8, y - 8);
  }

  /** A bar of one step of the grid with its length; in space also the three axes. */
  paintScale() {
    const { g, camera, scene } = this;
    g.strokeStyle = g.fillStyle = this.colors.muted;
    g.font = `12px ${this.font}`;
    const step = scene.spatial ? niceStep(0, 70 / camera.scale, 1) : this.gridStep;
    const [x, y, size] = [16, this.height - 14, step * camera.scale];
    g.lineWidth = 2;
    g.beginPath();
    g.moveTo(x, y - 4);
    g.lineTo(x, y);
    g.lineTo(x + size, y);
    g.lineTo(x + size, y - 4);
    g.stroke();
    g.fillText(`${readable(step)}${this.spec.unit ? ` ${this.spec.unit}` : ""}`, x + size + 8, y + 1);
    if (!scene.spatial) return;
    const corner = [this.width - 46, this.height - 40];
    g.lineWidth = 1.5;
    ["x", "y", "z"].forEach((name, i) => {
      const axis = [0, 0, 0].map((_, j) => (i === j ? 1 : 0));
      const tip = [corner[0] + 26 * dot(axis, camera.right), corner[1] - 26 * dot(axis, camera.up)];
      g.beginPath();
      g.moveTo(...corner);
      g.lineTo(...tip);
      g.stroke();
      g.fillText(name, tip[0] + (tip[0] >= corner[0] ? 3 : -10), tip[1] + 3);
    });
  }
}

/** A speed of one digit near the given one. */
function roundSpeed(speed) {
  const power = 10 ** Math.floor(Math.log10(Math.max(speed, 1e-9)));
  const factor = speed / power;
  return Number((power * (factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10)).toPrecision(1));
}

