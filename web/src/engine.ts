// One worker at a time does the work of an engine; another one stands ready, so that ending the work means ending the worker.

import { XzReadableStream } from "xz-decompress";
import type { Asking } from "./ask";
import type { Kind } from "./compose";
import type { Question } from "./worker";

/** Why there is no answer. */
export class NoAnswer extends Error {
  constructor(message: string, readonly reason: "refused" | "ended" | "broken") { super(message); }
}

export interface Known {
  version: string;
  vocabulary: { forms: { name: string; title: string }[]; claims: { id: string; group: string }[]; questions: Asking[]; solids: Kind[]; joints: Kind[]; contacts: Kind[] };
  gallery: { name: string; title: string; files: string[] }[];
  texts: Record<string, string>;
}

interface Slot {
  worker: Worker;
  ready: Promise<Known>;
  fail?: (problem: NoAnswer) => void;
}

export type Told = (kind: string, text: string) => void;

/** Seconds after which a question is given up. */
const LONGEST = 300;

/** The module, unpacked while it is loaded and compiled while it is unpacked. */
async function load(): Promise<WebAssembly.Module> {
  const response = await fetch(new URL("./engine.bin", document.baseURI));
  if (!response.ok || !response.body) throw new Error(`engine.bin: ${response.status}`);
  const body = new XzReadableStream(response.body) as ReadableStream<Uint8Array<ArrayBuffer>>;
  return WebAssembly.compileStreaming(new Response(body, { headers: { "content-type": "application/wasm" } }));
}

export class Engine {
  private active: Slot;
  private spare: Slot | null = null;
  readonly known: Promise<Known>;

  /** Another engine may share the module. */
  constructor(readonly module: Promise<WebAssembly.Module> = load()) {
    this.active = this.slot();
    this.known = this.active.ready;
  }

  private slot(): Slot {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    const slot: Slot = { worker, ready: Promise.resolve() as unknown as Promise<Known> };
    slot.ready = this.module.then((module) => this.ask<Known>(slot, { kind: "begin", module }, () => {}, LONGEST));
    slot.ready.catch(() => {});
    return slot;
  }

  private ask<T>(slot: Slot, question: Question, told: Told, seconds: number): Promise<T> {
    return new Promise<T>((resolve, reject) => {
      const finish = (end: () => void) => {
        clearTimeout(timer);
        slot.worker.onmessage = slot.worker.onerror = null;
        slot.fail = undefined;
        end();
      };
      const timer = setTimeout(() => {
        finish(() => reject(new NoAnswer(`It took more than ${seconds} seconds and was ended.`, "broken")));
        this.replace(slot);
      }, 1000 * seconds);
      slot.fail = (problem) => finish(() => reject(problem));
      slot.worker.onmessage = ({ data }) => {
        if (data.told !== undefined) told(data.told, data.text);
        else if (data.failed === undefined) finish(() => resolve(data.done));
        else {
          finish(() => reject(new NoAnswer(data.isTrap ? broken(data.failed) : data.failed, data.isTrap ? "broken" : "refused")));
          if (data.isTrap) this.replace(slot);
        }
      };
      slot.worker.onerror = (event) => {
        finish(() => reject(new NoAnswer(broken(event.message), "broken")));
        this.replace(slot);
      };
      slot.worker.postMessage(question);
    });
  }

  /** Ends a worker; the one that stands ready takes its place. */
  private replace(slot: Slot) {
    slot.worker.terminate();
    if (slot !== this.active) return;
    this.active = this.spare ?? this.slot();
    this.spare = null;
  }

  /** Whether it is at work. */
  get busy(): boolean { return this.active.fail !== undefined; }

  /** Ends what is being done, if anything is. */
  end() {
    const slot = this.active;
    const fail = slot.fail;
    if (!fail) return;
    this.replace(slot);
    fail(new NoAnswer("ended", "ended"));
  }

  /** Asks; whoever asks has waited for the answer before, or ended it. */
  async call<T>(question: Question, told: Told = () => {}, seconds = LONGEST): Promise<T> {
    const slot = this.active;
    await slot.ready;
    if (slot !== this.active || slot.fail) throw new NoAnswer("ended", "ended");
    const answer = this.ask<T>(slot, question, told, seconds);
    this.spare ??= this.slot();
    return answer;
  }
}

function broken(words: string): string {
  const isMemory = /memory|allocation|capacity|grow/i.test(words);
  return isMemory
    ? "This needs more memory than the playground allows; the command line has no such bound."
    : `Something went wrong inside Chetaev, and it was started again; the text is as you left it. (${words.split("\n")[0].slice(0, 200)})`;
}
