// Steady motions, linear equations, stability and branches: questions of a form, answered beside the report by a worker of their own.

import { Engine, NoAnswer, type Known } from "./engine";
import type { Answered } from "./worker";

/** What can be asked, as the module lists it: the name of the command, its title, what it gives, and the fields that it heeds. */
export interface Asking {
  name: string;
  title: string;
  gives: string;
  fields: string[];
}

/** What a model offers to ask about. */
export interface Offered {
  motions: string[];
  parameters: { name: string; low: number; high: number }[];
}

/** A model as it stands. */
export interface Text { path: string; text: string; name: string }

const ENDINGS: Record<string, string> = {
  txt: "text", json: "JSON", svg: "picture, SVG", tex: "LaTeX", npz: "NumPy", mat: "MATLAB", py: "Python",
};
const TYPES: Record<string, string> = { svg: "image/svg+xml", json: "application/json", npz: "application/octet-stream", mat: "application/octet-stream" };

const get = <T extends HTMLElement = HTMLElement>(id: string) => document.getElementById(id) as T;
const input = (id: string) => get<HTMLInputElement>(id);

export class Ask {
  private engine: Engine | null = null;
  private questions: Asking[] = [];
  private generation = 0;
  private asked: string | null = null;
  /** Numbers of motions that were found, for the model as it was then. */
  private found: string[] = [];
  /** The parameter that was written into the form, by nobody. */
  private suggested = "";
  private offered: Offered = { motions: [], parameters: [] };

  /** `reading` is the model that is asked about, `shared` the engine of the report, `save` writes a file. */
  constructor(
    private readonly shared: Engine,
    private readonly reading: () => Text,
    private readonly save: (content: Uint8Array<ArrayBuffer>, name: string, type: string) => void,
  ) {
    get("ask-form").addEventListener("submit", (event) => {
      event.preventDefault();
      void this.ask();
    });
    get("ask-stop").addEventListener("click", () => this.stop());
    get("ask-what").addEventListener("change", () => this.fields());
    for (const [own, place] of [["ask-parameter", "ask"], ["ask-second", "ask-second"]]) input(own).addEventListener("input", () => this.range(own, place));
  }

  know(known: Known) {
    this.questions = known.vocabulary.questions;
    get("ask-what").replaceChildren(...this.questions.map(({ name, title }) => new Option(title, name)));
    this.fields();
  }

  /** What the model offers to ask about. */
  offer(offered: Offered) {
    this.offered = offered;
    this.motions();
    get("ask-parameters").replaceChildren(...offered.parameters.map(({ name }) => new Option("", name)));
    const own = input("ask-parameter").value;
    const isOffered = offered.parameters.some(({ name }) => name === own);
    if (!own || (own === this.suggested && !isOffered)) this.suggest();
  }

  /** What was answered is about the text before. */
  edited() {
    const isOld = this.asked !== null && this.asked !== this.reading().text;
    get("answer").classList.toggle("stale", isOld);
    get("ask-old").hidden = !isOld;
  }

  /** Another model takes the place of the one that was asked about. */
  forget() {
    this.stop();
    this.asked = null;
    this.found = [];
    get("answer").replaceChildren();
    for (const id of ["ask-parameter", "ask-from", "ask-to", "ask-second", "ask-second-from", "ask-second-to", "ask-at", "ask-period"]) input(id).value = "";
    this.edited();
    this.say("");
  }

  private motions() {
    const select = get<HTMLSelectElement>("ask-about");
    const before = select.value;
    const own = this.offered.motions;
    const unnamed = own.length === 1 ? `as the model says: ${own[0]}` : "the start, where it is steady";
    const options = [
      // Of several one is chosen.
      ...own.length > 1 ? [] : [new Option(unnamed, "")],
      ...own.map((name) => new Option(name, name)),
      ...this.found.map((name) => new Option(`motion ${name} of those found`, name)),
      new Option("rest, at the initial positions", "rest"),
      new Option("start, the initial state", "start"),
    ];
    select.replaceChildren(...options);
    if (options.some((option) => option.value === before)) select.value = before;
  }

  /** The fields of the question that is chosen. */
  private fields() {
    const chosen = this.questions.find(({ name }) => name === get<HTMLSelectElement>("ask-what").value);
    for (const element of get("ask-form").querySelectorAll<HTMLElement>("[data-field]")) element.hidden = !chosen?.fields.includes(element.dataset.field ?? "");
    get("ask-gives").textContent = chosen?.gives ?? "";
  }

  /** The first parameter of which a range is stated. */
  private suggest() {
    const [first] = this.offered.parameters;
    this.suggested = first?.name ?? "";
    for (const id of ["ask-parameter", "ask-from", "ask-to"]) input(id).value = "";
    input("ask-parameter").value = this.suggested;
    this.range("ask-parameter", "ask");
  }

  /** The range of a parameter that is named. */
  private range(own: string, place: string) {
    const found = this.offered.parameters.find(({ name }) => name === input(own).value.trim());
    if (!found) return;
    input(`${place}-from`).value = short(found.low);
    input(`${place}-to`).value = short(found.high);
  }

  private over(): string | undefined {
    const named = (own: string, place: string) => {
      const name = input(own).value.trim();
      return name ? `${name}=${input(`${place}-from`).value.trim()}:${input(`${place}-to`).value.trim()}` : "";
    };
    return [named("ask-parameter", "ask"), named("ask-second", "ask-second")].filter(Boolean).join(",") || undefined;
  }

  private async ask() {
    const what = get<HTMLSelectElement>("ask-what").value;
    const question = this.questions.find(({ name }) => name === what);
    if (!question) return;
    const own = ++this.generation;
    const model = this.reading();
    const value = (id: string) => input(id).value.trim() || undefined;
    const all: Record<string, unknown> = {
      about: get<HTMLSelectElement>("ask-about").value || undefined,
      at: value("ask-at"),
      symbolic: input("ask-symbolic").checked || undefined,
      orbit: input("ask-orbit").checked || undefined,
      period: input("ask-orbit").checked ? value("ask-period") : undefined,
      side: input("ask-second").value.trim() ? Number(value("ask-side")) || undefined : undefined,
    };
    // The second parameter is one of `over`.
    const isHeeded = (field: string) => question.fields.includes(field);
    const over = isHeeded("side") ? this.over() : this.over()?.split(",")[0];
    const asked = Object.fromEntries(Object.entries({ ...all, over }).filter(([field]) => isHeeded(field)));
    this.end();
    this.busy(true);
    const began = performance.now();
    const seconds = () => `${Math.round((performance.now() - began) / 1000)} s`;
    let part = "";
    const tell = () => this.say(`${question.title} …${part} (${seconds()})`);
    const clock = window.setInterval(tell, 1000);
    this.say(`${question.title} …`);
    try {
      this.engine ??= new Engine(this.shared.module);
      const told = (kind: string, said: string) => {
        if (kind !== "part" || own !== this.generation) return;
        part = ` ${Math.round(100 * Number(said))} %`;
        tell();
      };
      const found = await this.engine.call<Answered>({ kind: "ask", path: model.path, text: model.text, what, asked }, told);
      if (own !== this.generation) return;
      this.show(found, question, model);
      this.say(`Answered in ${((performance.now() - began) / 1000).toFixed(1)} s.`);
      performance.mark("answer");
    } catch (problem) {
      if (own !== this.generation) return;
      this.refuse(problem);
    } finally {
      clearInterval(clock);
      if (own === this.generation) this.busy(false);
    }
  }

  private refuse(problem: unknown) {
    if (problem instanceof NoAnswer && problem.reason === "ended") return;
    const words = problem instanceof Error ? problem.message : String(problem);
    this.asked = null;
    this.edited();
    this.say("There is no answer.");
    const said = document.createElement("pre");
    said.className = "refused";
    said.setAttribute("role", "alert");
    said.textContent = words;
    get("answer").replaceChildren(said);
    performance.mark("refusal");
  }

  private stop() {
    if (!this.end()) return;
    this.generation++;
    this.busy(false);
    this.say("Stopped.");
  }

  private end(): boolean {
    if (!this.engine?.busy) return false;
    this.engine.end();
    return true;
  }

  private busy(isBusy: boolean) {
    get("ask-stop").hidden = !isBusy;
    get("ask-go").textContent = isBusy ? "Ask again" : "Ask";
    get("answer").setAttribute("aria-busy", String(isBusy));
  }

  private say(words: string) { get("ask-said").textContent = words; }

  private show(found: Answered, question: Asking, model: Text) {
    const box = get("answer");
    box.replaceChildren();
    if (found.picture) {
      const drawn = new DOMParser().parseFromString(found.picture, "image/svg+xml").documentElement;
      const frame = box.appendChild(document.createElement("figure"));
      frame.append(document.adoptNode(drawn));
    }
    const words = box.appendChild(document.createElement("pre"));
    words.append(...blocks(found.text));
    words.tabIndex = 0;
    words.setAttribute("role", "region");
    words.setAttribute("aria-label", question.title);
    const row = box.appendChild(document.createElement("p"));
    row.className = "files";
    row.append("Save as ");
    for (const { ending, content } of found.files) {
      const button = row.appendChild(document.createElement("button"));
      button.type = "button";
      button.textContent = ENDINGS[ending] ?? ending;
      button.addEventListener("click", () => this.save(content, `${model.name || "model"}-${question.name}.${ending}`, TYPES[ending] ?? "text/plain"));
    }
    this.asked = model.text;
    this.edited();
    // Where the form fills the height, as on a phone, the answer is brought into view.
    const pane = get("ask").getBoundingClientRect();
    if (box.getBoundingClientRect().top > pane.top + 0.6 * pane.height) box.scrollIntoView();
    if (found.motions) {
      this.found = found.motions.filter((name) => !this.offered.motions.includes(name));
      this.motions();
    }
  }
}

/** Columns, a row of a matrix, a row of a map. */
const ROW = /\S {2}|^\s*(\S+ = )?\[|[#.]{5}/;

/** Sentences, which are wrapped, and rows of matrices and tables, which are not. */
function blocks(text: string): HTMLElement[] {
  const found: HTMLElement[] = [];
  for (const line of text.split(/(?<=\n)/)) {
    const kind = line === "\n" ? found.at(-1)?.className : ROW.test(line) ? "rows" : "words";
    if (!found.length || found[found.length - 1].className !== kind) {
      found.push(document.createElement("span"));
      found[found.length - 1].className = kind ?? "words";
    }
    found[found.length - 1].append(line);
  }
  return found;
}

/** A number without the digits of rounding. */
function short(value: number): string { return String(Number(value.toPrecision(12))); }
