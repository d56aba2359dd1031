// The worker: one module, one question at a time.

import init, * as chetaev from "../pkg/chetaev.js";

/** What is asked of the worker. */
export type Question =
  | { kind: "begin"; module: WebAssembly.Module }
  | { kind: "check"; path: string; text: string }
  | { kind: "derive"; path: string; text: string; forms: string; notation: string }
  | { kind: "study"; path: string; text: string; asked: object; whole?: boolean }
  | { kind: "ask"; path: string; text: string; what: string; asked: object }
  | { kind: "film"; path: string; text: string; width: number; height: number; still: boolean }
  | { kind: "columns"; path: string; text: string; asked: object };

/** What a study gives. */
export interface Studied {
  page: string;
  summary: string;
  notices: string[];
  record?: string;
  csv?: string;
  npz?: Uint8Array<ArrayBuffer>;
}

/** What a question on steady motions gives. */
export interface Answered {
  text: string;
  picture: string;
  /** Names of the motions that were found, where they were sought. */
  motions: string[] | null;
  files: { ending: string; content: Uint8Array<ArrayBuffer> }[];
}

const post = (message: unknown, moved: Transferable[] = []) => (self as unknown as Worker).postMessage(message, moved);

async function answer(question: Question): Promise<unknown> {
  switch (question.kind) {
    case "begin": {
      await init({ module_or_path: question.module });
      chetaev.begin();
      return { version: chetaev.version(), vocabulary: JSON.parse(chetaev.vocabulary()), gallery: JSON.parse(chetaev.gallery()), texts: texts() };
    }
    case "check":
      return JSON.parse(chetaev.check(question.path, question.text));
    case "derive":
      return chetaev.derive(question.path, question.text, question.forms, question.notation);
    case "study":
      return studied(question);
    case "ask":
      return answered(question);
    case "film": {
      const found = chetaev.study(question.path, question.text, JSON.stringify({ claims: "motion-only", coarse: true }), { told() {} });
      const drawn = question.still ? found.picture(question.width, question.height) : found.film(question.width, question.height, 4);
      found.free();
      return drawn;
    }
    case "columns": {
      const found = chetaev.study(question.path, question.text, JSON.stringify(question.asked), { told() {} });
      const columns = { names: JSON.parse(found.columnNames()), values: found.columns() };
      found.free();
      return columns;
    }
  }
}

/** All models of the gallery with their texts. */
function texts(): Record<string, string> {
  const models: { name: string }[] = JSON.parse(chetaev.gallery());
  return Object.fromEntries(models.map(({ name }) => [name, chetaev.galleryText(name, "model.toml")]));
}

function studied(question: Question & { kind: "study" }): Studied {
  const told = (kind: string, text: string) => post({ told: kind, text });
  const found = chetaev.study(question.path, question.text, JSON.stringify(question.asked), { told });
  const result: Studied = { page: found.page(), summary: found.summary(), notices: JSON.parse(found.notices()) };
  if (question.whole) {
    result.record = found.record();
    result.csv = found.csv();
    result.npz = found.npz() as Uint8Array<ArrayBuffer>;
  }
  found.free();
  return result;
}

function answered(question: Question & { kind: "ask" }): Answered {
  const told = (kind: string, text: string) => post({ told: kind, text });
  const found = chetaev.ask(question.path, question.text, question.what, JSON.stringify(question.asked), { told });
  const endings: string[] = JSON.parse(found.endings());
  const files = endings.map((ending, i) => ({ ending, content: found.file(i) as Uint8Array<ArrayBuffer> }));
  const result = { text: found.text(), picture: found.picture(), motions: JSON.parse(found.motions()), files };
  found.free();
  return result;
}

self.addEventListener("message", async (event: MessageEvent<Question>) => {
  try {
    post({ done: await answer(event.data) });
  } catch (problem) {
    const words = (globalThis as { chetaevPanic?: string }).chetaevPanic;
    const isTrap = problem instanceof WebAssembly.RuntimeError || problem instanceof RangeError || words !== undefined;
    post({ failed: isTrap ? words ?? String(problem) : String(problem), isTrap });
  }
});
