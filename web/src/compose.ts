// The text of a model that was put together in the form.

/** A kind of solid, joint or contact, as the module lists it: its word, what it is, the keys of its own, and what the key is where it is left out. */
export interface Kind { word: string; says: string; keys: string[]; usual: string }

/** A row of the form: the fields of one body, joint or contact, by key. */
export type Part = Record<string, string>;

export interface Mechanism {
  name: string;
  gravity: string;
  duration: string;
  bodies: Part[];
  joints: Part[];
  contacts: Part[];
  /** Values at the start by coordinate, those of the rate under the name with a stroke. */
  initial: Part;
}

/** Keys whose values are three components, apart by commas. */
const VECTORS = new Set(["center", "size", "semiaxes", "at", "child_at"]);
const LISTS = new Set(["coordinates"]);
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

export function compose(own: Mechanism): string {
  const lines = [`name = ${quoted(own.name || "mechanism")}`];
  if (own.gravity.trim() && own.gravity.trim() !== "9.81") lines.push(`gravity = ${value(own.gravity)}`);
  const section = (title: string, parts: Part[]) => {
    const rows = parts.filter((part) => part.name.trim());
    if (!rows.length) return;
    lines.push("", `[${title}]`);
    for (const part of rows) lines.push(`${key(part.name)} = ${table(part)}`);
  };
  section("bodies", own.bodies);
  section("joints", own.joints);
  section("contacts", own.contacts);
  const initial = Object.entries(own.initial).filter(([, given]) => given.trim());
  if (initial.length) lines.push("", "[initial]", ...initial.map(([name, given]) => `${key(name)} = ${value(given)}`));
  if (own.duration.trim()) lines.push("", "[simulation]", `t_end = ${value(own.duration)}`);
  return `${lines.join("\n")}\n`;
}

function table(part: Part): string {
  const fields = Object.entries(part).filter(([name, given]) => name !== "name" && given.trim());
  if (!fields.length) return "{}";
  return `{ ${fields.map(([name, given]) => `${name} = ${of(name, given)}`).join(", ")} }`;
}

function of(name: string, given: string): string {
  const parts = given.split(",").map((one) => one.trim()).filter(Boolean);
  const isList = VECTORS.has(name) || LISTS.has(name) || (name === "inertia" && parts.length > 1);
  // A word stays one, though it looks like a number.
  const one = LISTS.has(name) ? quoted : value;
  return isList ? `[${parts.map(one).join(", ")}]` : WORDS.has(name) ? quoted(given.trim()) : value(given);
}

/** Keys whose values are words. */
const WORDS = new Set(["shape", "type", "axis", "sequence", "parent", "child", "body", "coordinate"]);

/** A number as it is, an expression or a number with its unit between quotation marks. */
function value(given: string): string {
  const text = given.trim();
  if (!NUMBER.test(text)) return quoted(text);
  return String(Number(text));
}

const key = (name: string) => (/^[A-Za-z0-9_-]+$/.test(name.trim()) ? name.trim() : quoted(name.trim()));

/** A string of TOML, which takes what JSON writes; the last control character is written out too. */
const quoted = (text: string) => JSON.stringify(text).replace(/\x7f/g, "\\u007f");
