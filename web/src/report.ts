// The report in its frame: the page that the command writes, with the script of the command, shown again at every change.

/** Characters of a page that are read in one go: some ten milliseconds. */
const SLICE = 60_000;

/** A page as a document without scripts, read in slices, so that the page around it answers in between. */
async function read(page: string): Promise<Document> {
  const found = document.implementation.createHTMLDocument();
  found.open();
  for (let at = 0; at < page.length; at += SLICE) {
    found.write(page.slice(at, at + SLICE));
    await pause();
  }
  found.close();
  return found;
}

/** Elements that are laid out in one go: some ten milliseconds. */
const PART = 400;

/** Moves what an element holds into another one, and stops after every part. */
function* moved(from: Element, to: Element): Generator<void> {
  let count = 0;
  for (let node = from.firstChild; node; node = from.firstChild) {
    const size = node instanceof Element ? node.querySelectorAll("*").length : 0;
    if (node instanceof Element && size > PART && node.localName !== "math" && node.localName !== "svg") {
      const shell = to.appendChild(to.ownerDocument.importNode(node, false)) as Element;
      yield* moved(node, shell);
      node.remove();
      continue;
    }
    to.append(to.ownerDocument.adoptNode(node));
    count += size + 1;
    if (count > PART) {
      count = 0;
      yield;
    }
  }
  yield;
}

/** Lets other tasks go first. */
function pause(): Promise<void> {
  const { scheduler } = globalThis as { scheduler?: { yield?: () => Promise<void> } };
  return scheduler?.yield?.() ?? new Promise((resolve) => { setTimeout(resolve); });
}

interface Shown {
  state(): unknown;
  resume(state: unknown): void;
  move(other: Document, data: unknown): void;
}

type FrameWindow = Window & { begin?: () => (() => void)[]; shown?: Shown };

export class ReportView {
  private frame: HTMLIFrameElement | null = null;
  private showing = 0;

  constructor(private readonly place: HTMLElement) {}

  private get window(): FrameWindow | null { return (this.frame?.contentWindow as FrameWindow) ?? null; }

  /** Shows a page; where the reader is stays, if `stays`. */
  async show(page: string, stays: boolean): Promise<void> {
    const own = ++this.showing;
    const parsed = await read(page);
    if (own !== this.showing) return;
    const next = document.createElement("iframe");
    next.title = "Report";
    next.className = "next";
    const ready = new Promise<void>((resolve) => {
      const listen = (event: MessageEvent) => {
        if (event.source !== next.contentWindow || event.data !== "report-ready") return;
        removeEventListener("message", listen);
        resolve();
      };
      addEventListener("message", listen);
    });
    next.src = "./report.html";
    this.place.append(next);
    await ready;
    if (own !== this.showing) { next.remove(); return; }
    const inside = next.contentDocument as Document;
    for (const script of parsed.querySelectorAll("script:not([type='application/json'])")) script.remove();
    inside.title = parsed.title;
    inside.documentElement.dataset.theme = document.documentElement.dataset.theme ?? "";
    inside.body.replaceWith(inside.adoptNode(parsed.body.cloneNode(false)));
    for (const _ of moved(parsed.body, inside.body)) {
      // What has been moved is laid out now, and not together with all that follows.
      void inside.body.offsetHeight;
      await pause();
      if (own !== this.showing) { next.remove(); return; }
    }
    for (const step of (next.contentWindow as FrameWindow).begin?.() ?? []) {
      step();
      await pause();
      if (own !== this.showing) { next.remove(); return; }
    }
    const state = stays ? this.window?.shown?.state() : undefined;
    if (state) (next.contentWindow as FrameWindow).shown?.resume(state);
    const old = this.frame;
    this.frame = next;
    next.className = "";
    old?.remove();
  }

  /** Shows the motion of another page of the same model. */
  async move(page: string) {
    const own = this.showing;
    const parsed = await read(page);
    if (own !== this.showing) return;
    const data = JSON.parse(parsed.getElementById("data")?.textContent ?? "null");
    if (data?.trajectory && this.window?.shown) this.window.shown.move(parsed, data);
  }

  /** The theme of the page around it. */
  theme(theme: string) {
    const root = this.frame?.contentDocument?.documentElement;
    if (root) root.dataset.theme = theme;
  }

  set stale(stale: boolean) { this.place.classList.toggle("stale", stale); }
}
