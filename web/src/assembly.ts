// A model put together in a form: bodies, joints and contacts, for those who do not write.

import { compose, type Kind, type Mechanism, type Part } from "./compose";
import type { Known } from "./engine";

const STORE = "chetaev-form";

const get = <T extends HTMLElement = HTMLElement>(id: string) => document.getElementById(id) as T;

/** Models to begin with. */
const BEGINNINGS: Record<string, { title: string; own: Omit<Mechanism, "gravity" | "duration"> }> = {
  cart: {
    title: "A cart on two wheels with a swinging rod",
    own: {
      name: "cart",
      bodies: [
        { name: "chassis", shape: "", mass: "5", center: "0.05, 0, 0.1", inertia: "0.1, 0.2, 0.3" },
        { name: "left", shape: "disc", mass: "0.5", radius: "0.1" },
        { name: "right", shape: "disc", mass: "0.5", radius: "0.1" },
        { name: "rod", shape: "rod", mass: "0.3", length: "0.4", axis: "z", center: "0, 0, -rod_length/2" },
      ],
      joints: [
        { name: "plane", type: "planar", parent: "", child: "chassis", coordinates: "x, y, heading" },
        { name: "left_hub", type: "revolute", parent: "chassis", child: "left", axis: "y", at: "0, 0.2, left_radius" },
        { name: "right_hub", type: "revolute", parent: "chassis", child: "right", axis: "y", at: "0, -0.2, right_radius" },
        { name: "swing", type: "revolute", parent: "chassis", child: "rod", axis: "y", at: "0.1, 0, 0.6" },
      ],
      contacts: [{ name: "left", type: "rolling", body: "left" }, { name: "right", type: "rolling", body: "right" }],
      initial: { "swing": "0.5", "left_hub'": "4", "right_hub'": "4" },
    },
  },
  disc: {
    title: "A disc that rolls on the ground",
    own: {
      name: "rolling-disc",
      bodies: [{ name: "disc", shape: "disc", mass: "2", radius: "0.3" }],
      joints: [],
      contacts: [{ name: "rim", type: "rolling", body: "disc", coordinates: "x, y, heading, lean, roll" }],
      initial: { lean: "0.25", "roll'": "7" },
    },
  },
  pendulum: {
    title: "A double pendulum of rods",
    own: {
      name: "pendulum",
      bodies: [
        { name: "upper", shape: "rod", mass: "1", length: "0.5", axis: "z", center: "0, 0, -upper_length/2" },
        { name: "lower", shape: "rod", mass: "1", length: "0.5", axis: "z", center: "0, 0, -lower_length/2" },
      ],
      joints: [
        { name: "shoulder", type: "revolute", parent: "", child: "upper", axis: "-y" },
        { name: "elbow", type: "revolute", parent: "upper", child: "lower", axis: "-y", at: "0, 0, -upper_length" },
      ],
      contacts: [],
      initial: { shoulder: "1", elbow: "-1.5" },
    },
  },
  sled: {
    title: "A sled on one blade",
    own: {
      name: "sled",
      bodies: [{ name: "sled", shape: "", mass: "1.5", center: "0.25, 0, 0", inertia: "0.4" }],
      joints: [{ name: "plane", type: "planar", parent: "", child: "sled", coordinates: "x, y, heading" }],
      contacts: [{ name: "blade", type: "blade", body: "sled" }],
      initial: { "heading'": "2" },
    },
  },
  nothing: { title: "Nothing", own: { name: "mechanism", bodies: [], joints: [], contacts: [], initial: {} } },
};

/** Sections of the form: the title, the word for one part, and what is said of it. */
const SECTIONS = {
  bodies: { title: "Bodies", one: "body", about: "Numbers are in SI units, or carry their unit: 85 kg, 30 cm. Each is a parameter of its own name, as left_radius, and stands in expressions." },
  joints: { title: "Joints", one: "joint", about: "A joint places its child on its parent. Places are three components in the axes of the body, apart by commas: numbers or expressions." },
  contacts: { title: "Contacts with the ground", one: "contact", about: "The ground is the plane z = 0, z up. A body that only touches needs no joint." },
} as const;

type Section = keyof typeof SECTIONS;

/** A field; `bodies` is what stands for no body in a list of them. */
interface Field { name: string; label: string; options?: [string, string][]; bodies?: string; hint?: string }

const LABELS: Record<string, string> = {
  radius: "Radius", tube: "Radius of the tube", length: "Length", size: "Edges", semiaxes: "Semi-axes", axis: "Axis", sequence: "Axes, in turn",
};

export class Assembly {
  private own: Mechanism;
  private kinds: Pick<Known["vocabulary"], "solids" | "joints" | "contacts"> = { solids: [], joints: [], contacts: [] };
  private coordinates: string[] = [];
  /** Lists of bodies to choose from, which follow the names. */
  private choices: { control: HTMLSelectElement; part: Part; field: Field }[] = [];

  /** `text` is what the editor holds, `write` puts another in its place. */
  constructor(private readonly text: () => string, private readonly write: (text: string) => void) {
    this.own = kept() ?? begun("cart");
    const begin = get<HTMLSelectElement>("form-begin");
    begin.append(...Object.entries(BEGINNINGS).map(([word, { title }]) => new Option(title, word)));
    begin.addEventListener("change", () => {
      if (!begin.value) return;
      this.own = begun(begin.value);
      begin.value = "";
      this.coordinates = [];
      this.render();
      this.put();
    });
    get("form-write").addEventListener("click", () => this.put());
    get("form").addEventListener("submit", (event) => event.preventDefault());
  }

  know(known: Known) {
    this.kinds = known.vocabulary;
  }

  open() {
    this.render();
    this.compare();
  }

  /** The coordinates that follow from the parts: values at the start can be stated for them. */
  offer(coordinates: string[]) {
    if (this.text() !== compose(this.own) || String(coordinates) === String(this.coordinates)) return;
    this.coordinates = coordinates;
    this.renderInitial();
  }

  /** Whether the text is still that of the form. */
  compare() {
    get("form-other").hidden = this.text() === compose(this.own);
  }

  private put() {
    try { localStorage.setItem(STORE, JSON.stringify(this.own)); } catch { /* private mode, or full */ }
    this.write(compose(this.own));
    this.compare();
  }

  private render() {
    const focused = document.activeElement?.id;
    this.choices = [];
    const general = get("form-general");
    general.replaceChildren(
      this.input(this.own as unknown as Part, { name: "name", label: "Name" }, "form-name"),
      this.input(this.own as unknown as Part, { name: "gravity", label: "Gravity, m/s² downwards", hint: "0 for none" }, "form-gravity"),
      this.input(this.own as unknown as Part, { name: "duration", label: "Seconds shown" }, "form-duration"),
    );
    get("form-parts").replaceChildren(...(Object.keys(SECTIONS) as Section[]).map((section) => this.section(section)));
    this.renderInitial();
    if (focused) document.getElementById(focused)?.focus();
  }

  private section(section: Section): HTMLElement {
    const { title, one, about } = SECTIONS[section];
    const box = document.createElement("section");
    box.appendChild(document.createElement("h3")).textContent = title;
    box.appendChild(document.createElement("p")).textContent = about;
    this.own[section].forEach((part, i) => box.append(this.part(section, part, i)));
    const add = box.appendChild(button(`Add a ${one}`, `form-add-${section}`));
    add.addEventListener("click", () => {
      this.own[section].push(this.fresh(section));
      this.render();
      get(`form-${section}-${this.own[section].length - 1}-name`).focus();
      this.put();
    });
    return box;
  }

  private part(section: Section, part: Part, i: number): HTMLElement {
    const box = document.createElement("fieldset");
    const legend = box.appendChild(document.createElement("legend"));
    legend.textContent = part.name || `a ${SECTIONS[section].one} without a name`;
    for (const field of this.fields(section, part)) box.append(this.input(part, field, `form-${section}-${i}-${field.name}`));
    box.querySelector("input")?.addEventListener("input", () => { legend.textContent = part.name; });
    const remove = box.appendChild(button("Remove", `form-${section}-${i}-remove`));
    remove.setAttribute("aria-label", `Remove ${part.name || SECTIONS[section].one}`);
    remove.addEventListener("click", () => {
      this.own[section].splice(i, 1);
      this.render();
      get(`form-add-${section}`).focus();
      this.put();
    });
    return box;
  }

  private fields(section: Section, part: Part): Field[] {
    const kinds = (list: Kind[]) => list.map(({ word, says }): [string, string] => [word, `${word}: ${says}`]);
    const keysOf = (list: Kind[], word: string) => {
      const kind = list.find((own) => own.word === word);
      return (kind?.keys ?? []).map((name) => ({ name, label: LABELS[name] ?? name, hint: name === "axis" || name === "sequence" ? kind?.usual : name === "size" || name === "semiaxes" ? "0.1, 0.2, 0.3" : undefined }));
    };
    const name = { name: "name", label: "Name" };
    const place = (key: string, label: string) => ({ name: key, label, hint: "0, 0, 0" });
    if (section === "bodies") {
      const isSolid = Boolean(part.shape);
      return [
        name,
        { name: "shape", label: "Shape", options: [["", "none"], ...kinds(this.kinds.solids)] },
        { name: "mass", label: "Mass", hint: "kg" },
        ...keysOf(this.kinds.solids, part.shape),
        ...isSolid ? [{ name: "axis", label: "Axis of the shape", hint: "as usual" }] : [],
        { name: "inertia", label: "Central inertia", hint: isSolid ? "of the shape" : "xx, yy, zz" },
        place("center", "Centre of mass"),
      ];
    }
    if (section === "joints") {
      return [
        name,
        { name: "type", label: "Kind", options: kinds(this.kinds.joints) },
        { name: "parent", label: "Parent", bodies: "the ground" },
        { name: "child", label: "Child", bodies: "–" },
        ...keysOf(this.kinds.joints, part.type),
        place("at", "Place on the parent"),
        place("child_at", "Place on the child"),
        { name: "coordinates", label: "Names of the coordinates", hint: "made up" },
        ...["revolute", "prismatic"].includes(part.type) ? [
          { name: "spring", label: "Stiffness of a spring" },
          { name: "damper", label: "Damping" },
          { name: part.type === "revolute" ? "torque" : "force", label: part.type === "revolute" ? "Torque" : "Force", hint: "any expression" },
        ] : [],
      ];
    }
    return [
      name,
      { name: "type", label: "Kind", options: kinds(this.kinds.contacts) },
      { name: "body", label: "Body", bodies: "–" },
      ...part.type === "roller" ? [{ name: "angle", label: "Angle to the axle", hint: "45 deg" }] : [],
      { name: "coordinates", label: "Names of the coordinates", hint: "made up" },
    ];
  }

  private input(part: Part, field: Field, id: string): HTMLElement {
    const label = document.createElement("label");
    label.append(field.label);
    const control = label.appendChild(document.createElement(field.options || field.bodies ? "select" : "input"));
    control.id = id;
    if (control instanceof HTMLSelectElement) {
      this.choose(control, part, field);
      if (field.options === undefined) this.choices.push({ control, part, field });
    } else {
      control.value = part[field.name] ?? "";
      control.placeholder = field.hint ?? "";
      control.autocomplete = "off";
      control.spellcheck = false;
      control.setAttribute("autocapitalize", "off");
    }
    control.addEventListener("input", () => {
      if (field.name === "name" && this.own.bodies.includes(part)) this.rename(part, control.value);
      part[field.name] = control.value;
      if (field.options) {
        // Another kind has other fields.
        this.forget(part);
        this.render();
      }
      this.put();
    });
    return label;
  }

  private choose(control: HTMLSelectElement, part: Part, field: Field) {
    const bodies = this.own.bodies.map(({ name }): [string, string] => [name, name]);
    const options = field.options ?? [["", field.bodies ?? ""], ...bodies];
    control.replaceChildren(...options.map(([word, title]) => new Option(title, word)));
    control.value = part[field.name] ?? "";
  }

  /** What refers to a body follows its name. */
  private rename(body: Part, name: string) {
    const before = body.name;
    body.name = name;
    for (const part of [...this.own.joints, ...this.own.contacts]) {
      for (const key of ["parent", "child", "body"]) if (before && part[key] === before) part[key] = name;
    }
    for (const { control, part, field } of this.choices) this.choose(control, part, field);
  }

  /** Fields that the kind that is chosen does not have. */
  private forget(part: Part) {
    for (const section of Object.keys(SECTIONS) as Section[]) {
      if (!this.own[section].includes(part)) continue;
      const names = new Set(this.fields(section, part).map(({ name }) => name));
      for (const name of Object.keys(part)) if (!names.has(name)) delete part[name];
    }
  }

  private fresh(section: Section): Part {
    const names = new Set(this.own[section].map(({ name }) => name));
    const named = (word: string) => {
      let i = 1;
      while (names.has(`${word}_${i}`)) i++;
      return `${word}_${i}`;
    };
    const last = this.own.bodies.at(-1)?.name ?? "";
    if (section === "bodies") return { name: named("body"), shape: "ball", mass: "1", radius: "0.1" };
    if (section === "joints") return { name: named("joint"), type: "revolute", parent: "", child: last };
    return { name: named("contact"), type: "rolling", body: last };
  }

  private renderInitial() {
    const box = get("form-initial");
    box.hidden = this.coordinates.length === 0;
    box.replaceChildren();
    if (box.hidden) return;
    box.appendChild(document.createElement("h3")).textContent = "Start";
    box.appendChild(document.createElement("p")).textContent = "What is left out is 0, or follows from the constraints.";
    for (const name of this.coordinates) {
      box.append(
        this.input(this.own.initial, { name, label: name, hint: "0" }, `form-initial-${name}`),
        this.input(this.own.initial, { name: `${name}'`, label: `${name}′, its rate`, hint: "0" }, `form-initial-${name}-rate`),
      );
    }
  }
}

function button(title: string, id: string): HTMLButtonElement {
  const own = document.createElement("button");
  own.type = "button";
  own.id = id;
  own.textContent = title;
  return own;
}

function begun(word: string): Mechanism {
  return { gravity: "9.81", duration: "5", ...structuredClone(BEGINNINGS[word].own) };
}

/** What was put together before, where it is whole. */
function kept(): Mechanism | null {
  try {
    const found = JSON.parse(localStorage.getItem(STORE) ?? "null");
    const isWhole = found && typeof found.name === "string" && ["bodies", "joints", "contacts"].every((section) => Array.isArray(found[section])) && typeof found.initial === "object";
    if (!isWhole) return null;
    compose(found);
    return found;
  } catch {
    return null;
  }
}
