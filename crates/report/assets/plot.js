// Plots: curves over the time, phase portraits and figures, drawn as SVG.
//
// All coordinates here are those of the axes: the value itself, or its decimal logarithm.

/** Plots over the time show the same interval. */
const timePlots = [];

/** Decimal logarithms of magnitudes; zero has none and is drawn at the foot of the plot. */
const logarithms = (values) => values.map((value) => Math.log10(Math.abs(value)));

function setUpPlots() {
  const motion = data.trajectory;
  const curves = motion?.series.map((series) => ({ ...series, y: numbers(series.values) })) ?? [];
  const times = motion ? numbers(motion.times) : null;
  for (const figure of findAll("[data-plot]")) {
    const spec = data.plots[Number(figure.dataset.plot)];
    if (spec && !find("svg", figure)) new Plot(figure, spec, curves, times);
  }
}

/** Sets a name in an SVG text. */
function drawName(element, text) {
  let isLow = false;
  for (const part of nameParts(text)) {
    draw("tspan", {
      dy: part.isBelow === isLow ? 0 : part.isBelow ? 3 : -3,
      ...(part.isBelow ? { class: "below" } : {}),
      ...(part.isLetter ? { "font-style": "italic" } : {}),
    }, element, part.text);
    isLow = part.isBelow;
  }
}

class Plot {
  constructor(figure, spec, curves, times) {
    this.figure = figure;
    this.spec = spec;
    this.overTime = spec.kind === "time";
    this.isPortrait = spec.kind === "portrait";
    /** Curves in a plane over a parameter, as eigenvalues in the complex plane. */
    this.isPlane = Boolean(spec.own?.plane);
    this.takeCurves(curves, times);
    this.findBounds();
    this.build();
    this.reset();
    this.listen();
  }

  takeCurves(curves, times) {
    const { spec } = this;
    const unit = (name, u) => (u ? `${name} / ${u}` : name);
    if (this.isPortrait) {
      const parts = spec.series.map((i) => curves[i]);
      const { path } = spec;
      this.times = path ? numbers(path.times) : times;
      const thinned = path ? [path.x, path.y, path.besideX, path.besideY] : [];
      const all = parts.map((part, i) => (path ? { ...part, y: numbers(thinned[i]) } : part));
      const pairs = all.length > 2 ? [all.slice(0, 2), all.slice(2)] : [all];
      this.curves = pairs.map(([h, v], hue) => ({ ...v, x: h.y, raw: v.y, hue, visible: true, times: undefined }));
      const [h, v] = all;
      this.names = [unit(h.label, h.unit), unit(v.label, v.unit)];
      this.parts = [h, v];
      return;
    }
    const own = spec.own;
    if (this.isPlane) {
      const parts = own.curves.map((curve) => numbers(curve.values));
      this.rawX = numbers(own.abscissae);
      this.times = null;
      this.names = own.plane;
      this.curves = parts.filter((_, i) => i % 2 === 0).map((x, hue) => ({
        ...own.curves[2 * hue], x, y: parts[2 * hue + 1], raw: parts[2 * hue + 1], hue, visible: true,
      }));
      return;
    }
    const list = own ? own.curves.map((c) => ({ ...c, y: numbers(c.values) })) : spec.series.map((i) => curves[i]);
    const x = own ? numbers(own.abscissae) : times;
    this.rawX = x;
    this.times = own ? null : times;
    this.names = own
      ? [unit(own.name, own.unit), spec.unit ?? ""]
      : [unit("t", data.trajectory.timeUnit), spec.unit ?? ""];
    this.curves = list.map((curve, hue) => ({
      ...curve,
      x: spec.logHorizontal ? logarithms(x) : curve.times ? numbers(curve.times) : x,
      raw: curve.y,
      y: spec.log ? logarithms(curve.y) : curve.y,
      hue,
      visible: hue < 8,
    }));
  }

  /** The interval that shows all visible curves. */
  findBounds() {
    const { spec } = this;
    const shown = this.curves.filter((curve) => curve.visible);
    let [x0, x1] = range(shown.map((c) => c.x));
    let [y0, y1] = range(shown.map((c) => c.y));
    this.isZero = spec.log && !Number.isFinite(y0) && shown.some((c) => c.raw.some((v) => v === 0));
    const bounds = shown.map((c) => c.tolerance).filter((t) => t > 0);
    if (spec.log) {
      for (const t of bounds) { y0 = Math.min(y0, Math.log10(t) - 1); y1 = Math.max(y1, Math.log10(t)); }
      if (!Number.isFinite(y0)) [y0, y1] = [-17, -15];
      // A drift starts at zero and crosses it: what lies far below its largest value tells nothing.
      y0 = Math.max(y0, y1 - 14);
      [y0, y1] = [Math.floor(y0 - 0.05), Math.ceil(y1 + 0.05)];
    } else {
      if (!Number.isFinite(y0)) [y0, y1] = [0, 1];
      const size = Math.max(Math.abs(y0), Math.abs(y1));
      // What is constant to four digits is shown as constant; zooming in shows the rest.
      const least = size > 0 ? size * 0.02 : 1;
      const grow = y1 - y0 < size * 1e-4 || y1 === y0 ? least : (y1 - y0) * 0.06;
      [y0, y1] = [y0 - grow, y1 + grow];
    }
    if (!Number.isFinite(x0)) [x0, x1] = [0, 1];
    if (x0 === x1) [x0, x1] = [x0 - 0.5, x1 + 0.5];
    // Which side of the axes a curve is on is what it tells.
    if (this.isPlane) [x0, x1] = [Math.min(x0, 0), Math.max(x1, 0)];
    if (this.isPortrait || this.isPlane || spec.marks) { const grow = (x1 - x0) * 0.05; [x0, x1] = [x0 - grow, x1 + grow]; }
    this.bounds = { x: [x0, x1], y: [y0, y1] };
  }

  build() {
    const label = fill(words.plotLabel, plainName(this.names[1] || this.spec.title), plainName(this.names[0]));
    this.svg = draw("svg", { role: "img", tabindex: 0, "aria-label": label });
    this.figure.append(this.svg);
    const id = `clip-${this.figure.dataset.plot}`;
    const clip = draw("clipPath", { id }, draw("defs", {}, this.svg));
    this.clip = draw("rect", {}, clip);
    this.axes = draw("g", { class: "axes" }, this.svg);
    const inside = draw("g", { "clip-path": `url(#${id})` }, this.svg);
    this.lines = draw("g", {}, inside);
    this.cursor = draw("line", { class: "cursor", visibility: "hidden" }, inside);
    this.dots = draw("g", { class: "dots" }, inside);
    this.selection = draw("rect", { class: "selection", visibility: "hidden" }, inside);
    for (const curve of this.curves) {
      curve.path = draw("path", { class: `curve ${this.styleOf(curve)}` }, this.lines);
      curve.dot = draw("circle", { r: 3.5, class: `dot hue-${curve.hue % 8}`, visibility: "hidden" }, this.dots);
    }
    this.buildLegend();
  }

  /** Color and dashes: curves of drifts often lie on each other, and dashes let the lower one show. */
  styleOf({ hue }) {
    const dash = this.spec.log && this.overTime && hue % 4 > 0 ? ` dash-${hue % 4}` : hue >= 8 ? " dashed" : "";
    return `hue-${hue % 8}${dash}`;
  }

  /** Names with the values under the cursor; each switches its curve. */
  buildLegend() {
    this.legend = make("div", { class: "legend" }, this.figure);
    if (this.isPortrait) {
      this.readout = make("span", { class: "readout" }, this.legend);
      if (this.curves.length < 2) return;
    }
    for (const curve of this.curves) {
      const button = make("button", {
        type: "button",
        "aria-pressed": curve.visible,
        title: curve.description ?? fill(words.showSeries, plainName(curve.label)),
      }, this.legend);
      const swatch = draw("svg", { class: "swatch", viewBox: "0 0 26 6", "aria-hidden": "true" }, button);
      draw("path", { class: `sample ${this.styleOf(curve)}`, d: "M1 3H25" }, swatch);
      setName(make("span", {}, button), curve.label);
      curve.value = make("span", { class: "reading" }, button);
      button.addEventListener("click", () => {
        curve.visible = !curve.visible;
        button.setAttribute("aria-pressed", curve.visible);
        this.findBounds();
        this.view.y = [...this.bounds.y];
        this.paint();
      });
    }
    if (!this.isPortrait) this.position = make("span", { class: "position" }, this.legend);
  }

  reset() {
    this.view = { x: [...this.bounds.x], y: [...this.bounds.y] };
  }

  get isZoomed() {
    return ["x", "y"].some((axis) => this.view[axis].some((v, i) => v !== this.bounds[axis][i]));
  }

  /** Shows an interval; the other plots over the time follow. */
  zoom(x, y) {
    const least = (interval) => (interval[1] - interval[0]) > 2e-15 * Math.max(...interval.map(Math.abs));
    if (y && least(y)) this.view.y = y;
    if (x && least(x)) {
      for (const plot of this.overTime ? timePlots : [this]) {
        plot.view.x = [...x];
        plot.paint();
      }
    } else this.paint();
  }

  unzoom() {
    for (const plot of this.overTime ? timePlots : [this]) {
      plot.reset();
      plot.paint();
    }
  }

  // Drawing.

  paint() {
    const width = Math.max(this.figure.clientWidth, 200);
    const height = this.isPortrait || this.isPlane ? Math.round(Math.min(width * 0.8, 360)) : 230;
    this.shown = { x: this.view.x, y: this.view.y };
    const ticksY = this.ticks("y", Math.max(3, height / 50));
    const longest = Math.max(2, ...ticksY.list.map((tick) => tick.text.length));
    this.box = { left: 14 + 7 * longest, right: 12, top: 24, bottom: 38, width, height };
    this.box.inner = [width - this.box.left - this.box.right, height - this.box.top - this.box.bottom];
    if (this.spec.equal) this.equalize();
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    finish(this.clip, { x: this.box.left, y: this.box.top, width: this.box.inner[0], height: this.box.inner[1] });
    this.paintAxes(this.ticks("x", Math.max(2, this.box.inner[0] / 70)), this.spec.equal ? this.ticks("y", height / 50) : ticksY);
    for (const curve of this.curves) curve.path.setAttribute("d", curve.visible ? this.pathOf(curve) : "");
    this.paintLevels();
    this.figure.classList.toggle("zoomed", this.isZoomed);
    this.showAt(this.shownTime());
  }

  toX(x) { return within(this.box.left + (x - this.shown.x[0]) / (this.shown.x[1] - this.shown.x[0]) * this.box.inner[0]); }
  toY(y) { return within(this.box.top + (this.shown.y[1] - y) / (this.shown.y[1] - this.shown.y[0]) * this.box.inner[1]); }
  fromX(px) { return this.shown.x[0] + (px - this.box.left) / this.box.inner[0] * (this.shown.x[1] - this.shown.x[0]); }
  fromY(py) { return this.shown.y[1] - (py - this.box.top) / this.box.inner[1] * (this.shown.y[1] - this.shown.y[0]); }

  /** The same scale on both axes, by showing more along one. */
  equalize() {
    const scale = ["x", "y"].map((axis, i) => (this.view[axis][1] - this.view[axis][0]) / this.box.inner[i]);
    const wide = scale[0] < scale[1] ? "x" : "y";
    const length = Math.max(...scale) * this.box.inner[wide === "x" ? 0 : 1];
    const middle = (this.view[wide][0] + this.view[wide][1]) / 2;
    this.shown[wide] = [middle - length / 2, middle + length / 2];
  }

  ticks(axis, count) {
    const [low, high] = this.shown[axis];
    const isLog = axis === "x" ? this.spec.logHorizontal : this.spec.log;
    if (isLog && high - low > 1.2) return { list: decades(low, high, count), head: "" };
    if (!isLog) return linear(low, high, count);
    // Within a decade the round values themselves.
    const { list, head } = linear(10 ** low, 10 ** high, count);
    return { list: list.map(({ at, text }) => ({ at: Math.log10(at), text })), head };
  }

  paintAxes(ticksX, ticksY) {
    const { left, right, top, width, height, bottom } = this.box;
    this.axes.replaceChildren();
    const foot = height - bottom;
    draw("rect", { class: "frame", x: left, y: top, width: width - left - right, height: foot - top }, this.axes);
    for (const tick of ticksX.list) {
      const x = this.toX(tick.at);
      draw("line", { class: "grid", x1: x, x2: x, y1: top, y2: foot }, this.axes);
      draw("text", { x, y: foot + 15, "text-anchor": "middle" }, this.axes, tick.text);
    }
    for (const tick of ticksY.list) {
      const y = this.toY(tick.at);
      draw("line", { class: "grid", x1: left, x2: width - right, y1: y, y2: y }, this.axes);
      draw("text", { x: left - 7, y: y + 4, "text-anchor": "end" }, this.axes, tick.text);
    }
    const heads = [ticksY.head, this.names[1], this.spec.log ? words.logScale : ""].filter(Boolean).join("   ");
    drawName(draw("text", { class: "name", x: left, y: 14 }, this.axes), heads);
    const foots = [ticksX.head, this.names[0]].filter(Boolean).join("   ");
    drawName(draw("text", { class: "name", x: width - right, y: height - 5, "text-anchor": "end" }, this.axes), foots);
    if (this.isZero) draw("text", { class: "name", x: left + 10, y: foot - 10 }, this.axes, words.identicallyZero);
  }

  /** Tolerances, changes of chart and the start of a portrait. */
  paintLevels() {
    this.levels?.remove();
    this.levels = draw("g", { class: "levels" });
    this.lines.before(this.levels);
    const { left, right, top, bottom, width, height } = this.box;
    if (this.spec.log) {
      const levels = new Set(this.curves.filter((c) => c.visible && c.tolerance > 0).map((c) => c.tolerance));
      let last = -Infinity;
      for (const level of [...levels].sort((a, b) => b - a)) {
        const y = this.toY(Math.log10(level));
        draw("line", { class: "level", x1: left, x2: width - right, y1: y, y2: y }, this.levels);
        // A name where there is room for it: below the line at the top, never on another name.
        const foot = y - 16 < top ? y + 12 : y - 4;
        if (foot < last + 14) continue;
        last = foot;
        draw("text", { x: width - right - 6, y: foot, "text-anchor": "end" }, this.levels, `${words.tolerance} ${readable(level, 2)}`);
      }
    }
    if (this.overTime) {
      for (const time of data.trajectory.switches) {
        if (time === null) continue;
        const x = this.toX(time);
        const line = draw("line", { class: "switch", x1: x, x2: x, y1: top, y2: height - bottom }, this.levels);
        draw("title", {}, line, fill(words.switchAt, readable(time)));
      }
      for (const { time, detail } of data.trajectory.events) {
        const x = this.toX(time);
        const line = draw("line", { class: "event", x1: x, x2: x, y1: top, y2: height - bottom }, this.levels);
        draw("title", {}, line, `${detail} (${readable(time)})`);
      }
    }
    if (this.isPlane) {
      const [x, y] = [this.toX(0), this.toY(0)];
      draw("line", { class: "level", x1: x, x2: x, y1: top, y2: height - bottom }, this.levels);
      draw("line", { class: "level", x1: left, x2: width - right, y1: y, y2: y }, this.levels);
      for (const curve of this.curves.filter((c) => c.visible)) {
        const i = curve.x.findIndex(Number.isFinite);
        if (i < 0) continue;
        const mark = draw("circle", { class: "start", r: 3, cx: this.toX(curve.x[i]), cy: this.toY(curve.y[i]) }, this.levels);
        draw("title", {}, mark, this.placeText(i));
      }
    }
    if (this.isPortrait && this.curves[0].x.length) {
      const { x, y } = this.curves[0];
      const mark = draw("circle", { class: "start", r: 3, cx: this.toX(x[0]), cy: this.toY(y[0]) }, this.levels);
      draw("title", {}, mark, words.start);
    }
  }

  /** The line of a curve: of many samples within one pixel only the extremes are kept. */
  pathOf(curve) {
    const pen = new Pen();
    const put = (i) => pen.to(this.toX(curve.x[i]), this.toY(Number.isNaN(curve.y[i]) ? NaN : Math.max(curve.y[i], this.foot())));
    const isRun = !this.isPortrait && !this.isPlane && !this.spec.marks;
    const [first, last] = isRun ? this.visibleRange(curve.x) : [0, curve.x.length];
    // Of a drift the upper edge tells: it crosses zero again and again, down to any depth.
    if (isRun && this.spec.log && last - first > this.box.inner[0] / 2) {
      for (const [, , highest] of groups(curve, first, last, (x) => Math.floor(this.toX(x) / 3))) put(highest);
    } else if (isRun && last - first > 4 * this.box.inner[0]) {
      for (const group of groups(curve, first, last, (x) => Math.floor(this.toX(x)))) {
        for (const i of [...new Set(group)].sort((a, b) => a - b)) put(i);
      }
    } else {
      for (let i = first; i < last; i++) put(i);
    }
    if (!this.spec.marks) return pen.path;
    return pen.path + pen.points.map(([x, y]) => `M${x - 3} ${y}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0`).join("");
  }

  /** Where the logarithm of zero is drawn; nothing is lower. */
  foot() { return this.spec.log ? this.view.y[0] - 1 : -Infinity; }

  visibleRange(x) {
    return [Math.max(0, lowerBound(x, this.view.x[0]) - 1), Math.min(x.length, lowerBound(x, this.view.x[1]) + 2)];
  }

  // Reading.

  /** The time under the pointer, else that of the animation. */
  shownTime() { return this.hovered ?? (this.times ? clock.time : NaN); }

  /** Moves cursor, dots and values to the sample nearest to a time (or abscissa of a figure). */
  showAt(time) {
    const isShown = Number.isFinite(time) && this.box;
    const abscissae = this.times ?? (this.isPlane ? this.rawX : this.curves[0]?.x) ?? [];
    const index = isShown ? nearest(abscissae, time) : -1;
    const at = index >= 0 ? (this.isPortrait || this.isPlane ? NaN : this.toX(time)) : NaN;
    finish(this.cursor, Number.isFinite(at)
      ? { x1: at, x2: at, y1: this.box.top, y2: this.box.height - this.box.bottom, visibility: "visible" }
      : { visibility: "hidden" });
    for (const curve of this.curves) {
      // A thinned curve has times of its own.
      const place = index >= 0 && curve.times ? nearest(curve.x, time) : index;
      const [x, y] = [curve.x[place], curve.y[place]];
      const isVisible = place >= 0 && curve.visible && Number.isFinite(x) && Number.isFinite(y);
      finish(curve.dot, isVisible ? { cx: this.toX(x), cy: this.toY(y), visibility: "visible" } : { visibility: "hidden" });
      if (curve.value) curve.value.textContent = place < 0 ? "" : this.isPlane ? this.pairText(x, y) : readable(curve.raw[place]);
    }
    if (this.position) this.position.textContent = index >= 0 && this.hovered !== undefined ? this.placeText(index) : "";
    if (this.readout) this.readout.textContent = index >= 0 ? this.portraitText(index) : " ";
  }

  /** The two parts of a place in the plane. */
  pairText(x, y) { return `(${readable(x, 4)}, ${readable(y, 4)})`; }

  placeText(index) {
    if (this.isPlane) return `${plainName(this.spec.own.name)} = ${readable(this.rawX[index], 4)}`;
    return this.times ? `t = ${readable(this.times[index])}` : readable(this.rawX[index]);
  }

  portraitText(index) {
    const part = ({ label, unit, y }) => `${plainName(label)} = ${readable(y[index], 4)}${unit ? ` ${unit}` : ""}`;
    return `t = ${readable(this.times[index], 4)},  ${this.parts.map(part).join(",  ")}`;
  }

  // Acting.

  listen() {
    if (this.overTime) timePlots.push(this);
    new ResizeObserver(() => this.paint()).observe(this.figure);
    this.inView = false;
    new IntersectionObserver((entries) => {
      this.inView = entries.at(-1).isIntersecting;
      if (this.inView && this.box) this.showAt(this.shownTime());
    }).observe(this.figure);
    if (this.times) clock.listeners.push(() => { if (this.inView && this.hovered === undefined) this.showAt(clock.time); });
    this.listenToPointer();
    this.svg.addEventListener("dblclick", () => this.unzoom());
    this.svg.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== this.svg) return;
      event.preventDefault();
      this.zoomAbout(this.place(event), Math.exp(Math.max(-1, Math.min(1, event.deltaY / 300))));
    }, { passive: false });
    this.svg.addEventListener("keydown", (event) => this.key(event));
    const button = make("button", { type: "button", class: "unzoom" }, this.figure, words.resetZoom);
    button.addEventListener("click", () => this.unzoom());
  }

  /** Position of an event in the units of the drawing. */
  place(event) {
    const frame = this.svg.getBoundingClientRect();
    const scale = this.box.width / frame.width;
    return [(event.clientX - frame.left) * scale, (event.clientY - frame.top) * scale];
  }

  zoomAbout([px, py], factor) {
    const about = (interval, center) => interval.map((v) => center + (v - center) * factor);
    this.zoom(about(this.shown.x, this.fromX(px)), this.overTime ? null : about(this.shown.y, this.fromY(py)));
  }

  listenToPointer() {
    let down = null;
    this.svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      down = { at: this.place(event), touch: event.pointerType === "touch", moved: false };
      this.hover(down.at);
      if (!down.touch) this.svg.setPointerCapture(event.pointerId);
    });
    this.svg.addEventListener("pointermove", (event) => {
      const at = this.place(event);
      if (down && !down.touch) {
        down.moved ||= Math.hypot(at[0] - down.at[0], at[1] - down.at[1]) > 5;
        if (down.moved) this.select(down.at, at);
      }
      this.hover(at);
      if (down?.touch && this.times) clock.set(this.hovered);
    });
    this.svg.addEventListener("pointerup", (event) => {
      const at = this.place(event);
      if (down?.moved) this.zoomTo(down.at, at);
      else if (down && this.times && Number.isFinite(this.hovered)) clock.set(this.hovered);
      down = null;
      this.selection.setAttribute("visibility", "hidden");
    });
    const leave = () => {
      down = null;
      this.hovered = undefined;
      this.selection.setAttribute("visibility", "hidden");
      this.showAt(this.shownTime());
    };
    this.svg.addEventListener("pointerleave", leave);
    this.svg.addEventListener("pointercancel", leave);
  }

  hover([px, py]) {
    if (this.isPortrait) {
      const i = this.nearestPoint(px, py, this.curves[0]).best;
      this.hovered = i < 0 ? undefined : this.times[i];
    } else if (this.isPlane) {
      const found = this.curves.filter((c) => c.visible).map((curve) => this.nearestPoint(px, py, curve));
      const best = found.reduce((a, b) => (b.least < a.least ? b : a), { best: -1, least: Infinity }).best;
      this.hovered = best < 0 ? undefined : this.rawX[best];
    } else {
      const x = this.curves[0]?.x ?? [];
      const i = nearest(x, this.fromX(px));
      this.hovered = i < 0 ? undefined : x[i];
    }
    this.showAt(this.shownTime());
  }

  nearestPoint(px, py, { x, y }) {
    let [best, least] = [-1, Infinity];
    for (let i = 0; i < x.length; i++) {
      const distance = (this.toX(x[i]) - px) ** 2 + (this.toY(y[i]) - py) ** 2;
      if (distance < least) [best, least] = [i, distance];
    }
    return { best, least };
  }

  /** The part of the plot between two corners; a flat selection takes the whole height. */
  between(a, b) {
    const { left, top, inner } = this.box;
    const clamp = (v, low, size) => Math.max(low, Math.min(low + size, v));
    const xs = [a[0], b[0]].map((v) => clamp(v, left, inner[0])).sort((p, q) => p - q);
    let ys = [a[1], b[1]].map((v) => clamp(v, top, inner[1])).sort((p, q) => p - q);
    const flat = ys[1] - ys[0] < 12;
    if (flat) ys = [top, top + inner[1]];
    return { xs, ys, flat };
  }

  select(a, b) {
    const { xs, ys } = this.between(a, b);
    finish(this.selection, { x: xs[0], y: ys[0], width: xs[1] - xs[0], height: ys[1] - ys[0], visibility: "visible" });
  }

  zoomTo(a, b) {
    const { xs, ys, flat } = this.between(a, b);
    const x = xs[1] - xs[0] > 5 ? xs.map((v) => this.fromX(v)) : null;
    this.zoom(x, flat ? null : [this.fromY(ys[1]), this.fromY(ys[0])]);
  }

  key(event) {
    const middle = [this.box.left + this.box.inner[0] / 2, this.box.top + this.box.inner[1] / 2];
    const steps = { ArrowLeft: -1, ArrowRight: 1 };
    if (event.key in steps && this.times) {
      const span = this.overTime ? this.shown.x : [this.times[0], this.times.at(-1)];
      const from = Number.isFinite(clock.time) ? clock.time : span[0];
      const to = from + steps[event.key] * (span[1] - span[0]) / (event.shiftKey ? 20 : 200);
      clock.set(Math.max(this.times[0], Math.min(this.times.at(-1), to)));
    } else if (event.key === "+" || event.key === "=") this.zoomAbout(middle, 0.7);
    else if (event.key === "-") this.zoomAbout(middle, 1 / 0.7);
    else if (event.key === "0" || event.key === "Escape") this.unzoom();
    else return;
    event.preventDefault();
  }
}

/** Writes the path of a line that may have gaps and points that coincide on the screen. */
class Pen {
  constructor() {
    this.parts = [];
    this.points = [];
    this.isDown = false;
    this.last = [NaN, NaN];
  }

  get path() { return this.parts.join(""); }

  to(x, y) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) { this.isDown = false; return; }
    const [px, py] = [Math.round(x * 10) / 10, Math.round(y * 10) / 10];
    if (this.isDown && Math.abs(px - this.last[0]) < 0.35 && Math.abs(py - this.last[1]) < 0.35) return;
    this.parts.push(`${this.isDown ? "L" : "M"}${px} ${py}`);
    this.points.push([px, py]);
    this.last = [px, py];
    this.isDown = true;
  }
}

/** Indices of first, lowest, highest and last sample in each column of the screen. */
function groups(curve, first, last, column) {
  const found = [];
  let at = NaN;
  let group;
  for (let i = first; i < last; i++) {
    const here = column(curve.x[i]);
    if (here !== at) {
      at = here;
      found.push(group = [i, i, i, i]);
    }
    if (!(curve.y[i] >= curve.y[group[1]])) group[1] = i;
    if (!(curve.y[i] <= curve.y[group[2]])) group[2] = i;
    group[3] = i;
  }
  return found;
}

/** Keeps places far outside the screen from overflowing the drawing; what is not a number stays. */
const within = (px) => Math.max(-1e5, Math.min(1e5, px));

/** Least and greatest finite value of several arrays. */
function range(arrays) {
  let [low, high] = [Infinity, -Infinity];
  for (const values of arrays) {
    for (const value of values) {
      if (value < low && value > -Infinity) low = value;
      if (value > high && value < Infinity) high = value;
    }
  }
  return [low, high];
}

/** First index whose value is not less, in an increasing array. */
function lowerBound(values, value) {
  let [low, high] = [0, values.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Index of the nearest value in an increasing array, −1 if it is empty. */
function nearest(values, value) {
  if (!values.length) return -1;
  const i = Math.min(lowerBound(values, value), values.length - 1);
  return i > 0 && value - values[i - 1] < values[i] - value ? i - 1 : i;
}

/** Labels at round values. */
function linear(low, high, count) {
  const step = niceStep(low, high, count);
  const values = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9 && values.length < 50; i++) values.push(i * step);
  return labelled(values, step);
}

/** Labels at powers of ten. */
function decades(low, high, count) {
  const step = Math.max(1, Math.ceil((high - low) / count));
  const list = [];
  for (let at = Math.ceil(low / step) * step; at <= high; at += step) {
    list.push({ at, text: at >= -2 && at <= 3 ? readable(10 ** at) : `10${raised(at)}` });
  }
  return list;
}

/** Labels that stay short: a common offset and a common power of ten go to the head. */
function labelled(values, step) {
  if (!values.length) return { list: [], head: "" };
  const size = Math.max(...values.map(Math.abs));
  const hasOffset = size / step > 1e5;
  const offset = hasOffset ? values[Math.floor(values.length / 2)] : 0;
  const rest = values.map((v) => Math.round((v - offset) / step) * step);
  const largest = Math.max(...rest.map(Math.abs), step);
  let power = Math.floor(Math.log10(largest) + 1e-9);
  if (power > -4 && power < 5) power = 0;
  const decimals = Math.max(0, power - Math.floor(Math.log10(step) + 1e-9));
  const text = (v) => (v / 10 ** power).toFixed(decimals).replace(/^-/, "−").replace(/^−(0(\.0+)?)$/, "$1");
  const list = values.map((at, i) => ({ at, text: hasOffset && rest[i] > 0 ? `+${text(rest[i])}` : text(rest[i]) }));
  const head = [power ? `× 10${raised(power)}` : "", hasOffset ? `+ ${readable(offset, 15)}` : ""].filter(Boolean).join(" ");
  return { list, head };
}

