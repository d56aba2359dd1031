// The page: what is typed goes to the worker, what comes back is shown.

import "./style.css";
import { Ask, type Offered } from "./ask";
import { Assembly } from "./assembly";
import { Editor, fixName, type Name, type Problem } from "./editor";
import { Engine, NoAnswer, type Known } from "./engine";
import { Gallery } from "./gallery";
import { ReportView } from "./report";
import { galleryName, pack, unpack } from "./share";
import { Sliders, type Slider } from "./sliders";
import type { Studied } from "./worker";

/** What the check of a text gives. */
interface Checked {
  diagnostics: Problem[];
  hasErrors: boolean;
  isFunctional: boolean;
  title: string | null;
  names: Name[] | null;
  sliders: Slider[] | null;
  offered: Offered | null;
}

interface Claim { id: string; group: string; title: string; verdict: string; detail: string }

/** Milliseconds after the last key before equations are asked for, and after those before claims are. */
const PAUSE = 90;
const CLAIMS_PAUSE = 700;
const KEPT = "chetaev-text";
const NONE = "gallery/playground/model.toml";

const FIRST = `# A sleigh that may slide only along its blade. Change anything.

name = "sleigh"
coordinates = ["x", "y", "phi"]
assumptions = ["m > 0", "J > 0"]
parameters = { m = 1.5, J = 0.4, a = 0.25 }
lagrangian = "1/2 m ((x' - a phi' sin(phi))^2 + (y' + a phi' cos(phi))^2) + 1/2 J phi'^2"
constraints = { blade = "y' cos(phi) = x' sin(phi)" }
quasi_velocities = { u = "x' cos(phi) + y' sin(phi)", w = "phi'" }
initial = { "phi'" = 2 }
simulation = { t_end = 10 }
`;

const get = <T extends HTMLElement = HTMLElement>(id: string) => document.getElementById(id) as T;
const store = {
  get(key: string): string | null { try { return localStorage.getItem(key); } catch { return null; } },
  set(key: string, value: string) { try { localStorage.setItem(key, value); } catch { /* private mode, or full */ } },
};

class Playground {
  private readonly engine = new Engine();
  private readonly report = new ReportView(get("page"));
  private readonly sliders = new Sliders((s, t) => this.drag(s, t), (s, t) => this.release(s, t));
  private readonly questions = new Ask(
    this.engine, () => ({ path: this.path, text: this.editor.text, name: this.shownModel }), (content, name, type) => this.save(content, name, type));
  private readonly assembly = new Assembly(() => this.editor.text, (text) => this.assemble(text));
  private readonly editor: Editor;
  private known: Known | null = null;
  private gallery: Gallery | null = null;
  private path = NONE;
  private generation = 0;
  private timer = 0;
  private shownModel = "";
  private studied: Studied | null = null;
  private claims: Claim[] = [];
  private nextDrag: string | null = null;
  private dragging = false;
  private problems: Problem[] = [];

  constructor(text: string) {
    this.editor = new Editor(get("editor"), text, () => this.edited());
    this.listen();
    void this.start();
  }

  private async start() {
    try {
      this.known = await this.engine.known;
    } catch (problem) {
      this.say(`The playground could not be loaded: ${problem instanceof Error ? problem.message : problem}`);
      return;
    }
    const ids = this.known.vocabulary.claims.map((claim) => claim.id);
    this.editor.know(null, ids);
    this.questions.know(this.known);
    this.assembly.know(this.known);
    this.gallery = new Gallery(this.engine, this.known, (name) => this.take(name), () => { if (this.engine.busy) this.engine.end(); });
    await this.openAddress();
    void this.update();
  }

  /** The model that the address names or holds. */
  private async openAddress() {
    const name = galleryName(location.hash);
    if (name !== null && this.known?.texts[name] !== undefined) {
      this.put(`gallery/${name}/model.toml`, this.known.texts[name]);
      return;
    }
    try {
      const text = await unpack(location.hash);
      if (text !== null) {
        this.put(NONE, text);
      }
    } catch {
      this.say("The link holds no model that could be read.");
    }
  }

  /** Another model. */
  private put(path: string, text: string) {
    this.path = path;
    this.editor.replace(text);
    this.questions.forget();
  }

  /** The model of the form. */
  private assemble(text: string) {
    this.path = NONE;
    this.editor.replace(text);
    history.replaceState(null, "", location.pathname);
  }

  // What a person does.

  private edited() {
    store.set(KEPT, JSON.stringify({ path: this.path, text: this.editor.text }));
    clearTimeout(this.timer);
    this.generation++;
    this.report.stale = true;
    this.questions.edited();
    this.assembly.compare();
    this.timer = window.setTimeout(() => void this.update(), PAUSE);
  }

  private take(name: string) {
    const text = this.known?.texts[name];
    if (text === undefined) return;
    this.put(`gallery/${name}/model.toml`, text);
    history.replaceState(null, "", `#gallery=${name}`);
    this.select("report");
  }

  private drag(slider: Slider, value: string) {
    const text = this.editor.text;
    this.nextDrag = text.slice(0, slider.from) + value + text.slice(slider.to);
    if (!this.dragging) void this.follow();
  }

  /** Motions for where the slider is, one after the other; positions that were passed are left out. */
  private async follow() {
    this.dragging = true;
    clearTimeout(this.timer);
    this.generation++;
    this.engine.end();
    while (this.nextDrag !== null) {
      const text = this.nextDrag;
      this.nextDrag = null;
      try {
        const asked = { claims: "motion-only", coarse: true, tolerance: 1e-6 };
        const found = await this.engine.call<Studied>({ kind: "study", path: this.path, text, asked }, () => {}, 20);
        if (this.dragging) await this.report.move(found.page);
      } catch (problem) {
        if (problem instanceof NoAnswer && problem.reason !== "ended") this.say(problem.message);
      }
    }
    this.dragging = false;
  }

  private release(slider: Slider, value: string) {
    this.nextDrag = null;
    this.dragging = false;
    this.engine.end();
    this.editor.change(slider.from, slider.to, value);
  }

  // What is computed.

  private async update() {
    const own = ++this.generation;
    const isOwn = () => own === this.generation;
    const text = this.editor.text;
    this.engine.end();
    this.studied = null;
    get("go").hidden = true;
    try {
      const checked = await this.engine.call<Checked>({ kind: "check", path: this.path, text }, () => {}, 60);
      if (!isOwn()) return;
      this.heed(checked);
      if (checked.hasErrors) return;
      const stays = checked.title !== null && checked.title === this.shownModel;
      this.shownModel = checked.title ?? "";
      this.questions.offer(checked.offered ?? { motions: [], parameters: [] });
      await this.look(text, { claims: "none", still: true }, stays, isOwn);
      if (!isOwn()) return;
      performance.mark("equations");
      if (!checked.isFunctional) await this.look(text, { claims: "motion-only", coarse: true }, true, isOwn);
      if (!isOwn()) return;
      performance.mark("motion");
      await new Promise((resolve) => setTimeout(resolve, CLAIMS_PAUSE));
      if (isOwn()) await this.decide(text, isOwn);
    } catch (problem) {
      if (isOwn()) this.fail(problem);
    }
  }

  private async look(text: string, asked: object, stays: boolean, isOwn: () => boolean) {
    const found = await this.engine.call<Studied>({ kind: "study", path: this.path, text, asked });
    if (!isOwn()) return;
    await this.report.show(found.page, stays);
    this.report.stale = false;
    this.say("");
  }

  /** All claims, one after the other. */
  private async decide(text: string, isOwn: () => boolean) {
    this.claims = [];
    this.listClaims();
    get("stop").hidden = false;
    try {
      const told = (kind: string, said: string) => {
        if (!isOwn()) return;
        if (kind === "doing") this.say(`Deciding ${said} …`);
        if (kind === "decided") {
          this.claims.push(JSON.parse(said));
          this.listClaims();
        }
      };
      const found = await this.engine.call<Studied>({ kind: "study", path: this.path, text, asked: {}, whole: true }, told);
      if (!isOwn()) return;
      this.studied = found;
      await this.report.show(found.page, true);
      this.say(this.claims.length ? `All ${this.claims.length} claims are decided.` : "Everything is decided.");
      performance.mark("claims");
    } finally {
      if (isOwn()) get("stop").hidden = true;
    }
  }

  private stop() {
    this.generation++;
    this.engine.end();
    get("stop").hidden = true;
    get("go").hidden = false;
    this.say(`Stopped; ${this.claims.length} claims were decided.`);
  }

  private async go() {
    const own = ++this.generation;
    get("go").hidden = true;
    try {
      await this.decide(this.editor.text, () => own === this.generation);
    } catch (problem) {
      if (own === this.generation) this.fail(problem);
    }
  }

  private fail(problem: unknown) {
    if (problem instanceof NoAnswer && problem.reason === "ended") return;
    this.say(problem instanceof Error ? problem.message : String(problem));
  }

  // What is shown.

  private say(words: string) { get("said").textContent = words; }

  private heed(checked: Checked) {
    this.editor.know(checked.names, this.known?.vocabulary.claims.map((claim) => claim.id) ?? []);
    this.editor.show(checked.diagnostics, this.path);
    if (checked.sliders && !this.sliders.isHeld) this.sliders.show(checked.sliders);
    this.problems = checked.diagnostics;
    this.listProblems();
    const coordinates = checked.names?.filter(({ kind }) => kind === "coordinate");
    if (coordinates) this.assembly.offer(coordinates.map(({ name }) => name));
    const errors = checked.diagnostics.filter((problem) => problem.severity === "error").length;
    if (checked.hasErrors) this.say(errors === 1 ? "One problem; the report is of the text before." : `${errors} problems; the report is of the text before.`);
  }

  private listProblems() {
    const box = get("problems");
    box.hidden = this.problems.length === 0;
    box.replaceChildren(...this.problems.slice(0, 50).map((problem) => {
      const row = document.createElement("div");
      row.className = `problem ${problem.severity}`;
      const place = row.appendChild(document.createElement("button"));
      place.type = "button";
      place.className = "plain";
      place.textContent = `${problem.severity}, line ${problem.line}`;
      place.addEventListener("click", () => {
        this.write("text");
        this.editor.go(problem.from);
      });
      row.append(` ${problem.message}`);
      for (const hint of problem.hints) row.appendChild(document.createElement("small")).textContent = hint;
      const { fix } = problem;
      if (fix) {
        const button = row.appendChild(document.createElement("button"));
        button.type = "button";
        button.className = "fix";
        button.textContent = fixName(fix);
        button.addEventListener("click", () => this.editor.apply(fix));
      }
      return row;
    }));
  }

  private listClaims() {
    const box = get<HTMLDetailsElement>("claims");
    box.hidden = this.claims.length === 0;
    const counts = new Map<string, number>();
    for (const { verdict } of this.claims) counts.set(verdict, (counts.get(verdict) ?? 0) + 1);
    get("claim-counts").textContent = [...counts].map(([verdict, count]) => `${count} ${verdict}`).join(", ");
    const list = get("claim-list");
    if (list.children.length > this.claims.length) list.replaceChildren();
    for (const claim of this.claims.slice(list.children.length)) {
      const item = list.appendChild(document.createElement("li"));
      const chip = item.appendChild(document.createElement("b"));
      chip.textContent = claim.verdict;
      chip.dataset.verdict = claim.verdict;
      item.append(` ${claim.title} `);
      item.appendChild(document.createElement("code")).textContent = claim.id;
    }
  }

  private select(which: "model" | "report") {
    document.body.dataset.shown = which;
    get("show-model").setAttribute("aria-pressed", String(which === "model"));
    get("show-report").setAttribute("aria-pressed", String(which === "report"));
  }

  /** How the model is written, on the left. */
  private write(how: "text" | "form") {
    get("model").dataset.view = how;
    get("view-text").setAttribute("aria-pressed", String(how === "text"));
    get("view-form").setAttribute("aria-pressed", String(how === "form"));
    if (how === "form") this.assembly.open();
  }

  /** What is on the right: the report, or the questions on steady motions. */
  private view(which: "page" | "ask") {
    get("report").dataset.view = which;
    get("view-page").setAttribute("aria-pressed", String(which === "page"));
    get("view-ask").setAttribute("aria-pressed", String(which === "ask"));
  }

  // Files and links.

  private listen() {
    get("stop").addEventListener("click", () => this.stop());
    get("go").addEventListener("click", () => void this.go());
    get("show-model").addEventListener("click", () => this.select("model"));
    get("show-report").addEventListener("click", () => this.select("report"));
    get("view-text").addEventListener("click", () => this.write("text"));
    get("view-form").addEventListener("click", () => this.write("form"));
    get("view-page").addEventListener("click", () => this.view("page"));
    get("view-ask").addEventListener("click", () => this.view("ask"));
    get("gallery-button").addEventListener("click", () => this.openGallery());
    get("open-button").addEventListener("click", () => get("file").click());
    get("file").addEventListener("change", () => void this.openFile());
    get("save-button").addEventListener("click", () => this.save(this.editor.text, `${this.shownModel || "model"}.toml`, "text/plain"));
    get("share-button").addEventListener("click", () => void this.share());
    get("theme-button").addEventListener("click", () => this.changeTheme());
    const download = get<HTMLSelectElement>("download");
    download.addEventListener("change", () => {
      const what = download.value;
      download.value = "";
      void this.download(what);
    });
    addEventListener("hashchange", () => void this.openAddress());
    addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      if (event.key === "s") this.save(this.editor.text, `${this.shownModel || "model"}.toml`, "text/plain");
      else if (event.key === "o") get("file").click();
      else return;
      event.preventDefault();
    });
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      const file = event.dataTransfer?.files[0];
      if (!file) return;
      event.preventDefault();
      void this.read(file);
    });
    this.select("model");
    this.write("text");
    this.view("page");
  }

  private openGallery() {
    if (!this.gallery) return;
    this.generation++;
    this.engine.end();
    get("stop").hidden = true;
    this.gallery.open();
    get("gallery").addEventListener("close", () => void this.update(), { once: true });
  }

  private async openFile() {
    const input = get<HTMLInputElement>("file");
    const file = input.files?.[0];
    input.value = "";
    if (file) await this.read(file);
  }

  private async read(file: File) {
    if (file.size > 1 << 20) { this.say("The file is longer than a megabyte, which no model is."); return; }
    this.put(NONE, await file.text());
    history.replaceState(null, "", location.pathname);
  }

  private async share() {
    const link = new URL(await pack(this.editor.text), location.href).href;
    history.replaceState(null, "", link);
    try {
      await navigator.clipboard.writeText(link);
      this.say("The link is in the clipboard; it holds the whole model.");
    } catch {
      this.say("The link is in the address bar; it holds the whole model.");
    }
  }

  private save(content: string | Uint8Array<ArrayBuffer>, name: string, type: string) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([content], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  private async download(what: string) {
    const name = this.shownModel || "model";
    const notations: Record<string, [string, string]> = { python: ["sympy", "py"], c: ["c", "c"], latex: ["latex", "tex"] };
    try {
      if (notations[what]) {
        const [notation, ending] = notations[what];
        if (this.engine.busy) this.stop();
        const text = await this.engine.call<string>({ kind: "derive", path: this.path, text: this.editor.text, forms: "routh,maggi", notation });
        this.save(text, `${name}.${ending}`, "text/plain");
        return;
      }
      const found = this.studied;
      if (!found) { this.say("This can be had when all claims are decided."); return; }
      if (what === "report") this.save(found.page, `${name}.html`, "text/html");
      if (what === "record" && found.record) this.save(found.record, "study.json", "application/json");
      if (what === "csv" && found.csv) this.save(found.csv, "trajectory.csv", "text/csv");
      if (what === "npz" && found.npz?.length) this.save(found.npz, "trajectory.npz", "application/octet-stream");
      if ((what === "csv" && !found.csv) || (what === "npz" && !found.npz?.length)) this.say("This model has no motion.");
    } catch (problem) {
      this.fail(problem);
    }
  }

  private changeTheme() {
    const root = document.documentElement;
    const isDark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = isDark ? "light" : "dark";
    store.set("chetaev-theme", root.dataset.theme);
    this.report.theme(root.dataset.theme);
  }
}

function first(): string {
  const kept = store.get(KEPT);
  if (location.hash || kept === null) return FIRST;
  try { return JSON.parse(kept).text || FIRST; } catch { return FIRST; }
}

const theme = store.get("chetaev-theme");
if (theme === "light" || theme === "dark") document.documentElement.dataset.theme = theme;
new Playground(first());
if ("serviceWorker" in navigator && location.protocol !== "file:") navigator.serviceWorker.register("./offline.js").catch(() => {});
