// The gallery as cards; a picture is computed when its card comes into view, and moves unless stillness is preferred.

import type { Engine, Known } from "./engine";

const STORE = "chetaev-films";

export class Gallery {
  private readonly dialog = document.getElementById("gallery") as HTMLDialogElement;
  private readonly list = document.getElementById("cards") as HTMLUListElement;
  private readonly waiting: { name: string; picture: HTMLImageElement }[] = [];
  private working = false;

  constructor(private readonly engine: Engine, private readonly known: Known, private readonly pick: (name: string) => void, private readonly closed: () => void) {
    this.build();
    document.getElementById("gallery-close")?.addEventListener("click", () => this.dialog.close());
    this.dialog.addEventListener("close", () => {
      this.waiting.length = 0;
      this.closed();
    });
    const search = document.getElementById("gallery-search") as HTMLInputElement;
    search.addEventListener("input", () => {
      const words = search.value.toLowerCase().split(/\s+/);
      for (const card of this.list.children as HTMLCollectionOf<HTMLElement>) {
        card.hidden = !words.every((word) => card.textContent?.toLowerCase().includes(word));
      }
    });
  }

  open() { this.dialog.showModal(); }

  get isOpen(): boolean { return this.dialog.open; }

  private build() {
    const seen = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        if (!entry.isIntersecting) continue;
        seen.unobserve(entry.target);
        const picture = entry.target as HTMLImageElement;
        this.waiting.push({ name: picture.dataset.name ?? "", picture });
      }
      void this.work();
    }, { root: this.dialog });
    for (const { name, title } of this.known.gallery) {
      const item = this.list.appendChild(document.createElement("li"));
      const card = item.appendChild(document.createElement("button"));
      card.type = "button";
      card.dataset.model = name;
      const picture = card.appendChild(document.createElement("img"));
      picture.alt = "";
      picture.width = 240;
      picture.height = 150;
      picture.dataset.name = name;
      // Functionals have fields, which no film shows.
      if (!/^(elasticity|fields)\//.test(name)) seen.observe(picture);
      const words = card.appendChild(document.createElement("span"));
      words.appendChild(document.createElement("strong")).textContent = title;
      words.appendChild(document.createElement("small")).textContent = name;
      card.addEventListener("click", () => {
        this.dialog.close();
        this.pick(name);
      });
    }
  }

  private async work() {
    if (this.working) return;
    this.working = true;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    for (let next = this.waiting.shift(); next && this.dialog.open; next = this.waiting.shift()) {
      try {
        const blob = await this.film(next.name, still);
        if (blob) next.picture.src = URL.createObjectURL(blob);
      } catch {
        // A card without a picture.
      }
    }
    this.working = false;
  }

  private async film(name: string, still: boolean): Promise<Blob | null> {
    const key = `./film/${this.known.version}/${still ? "still" : "moving"}/${encodeURIComponent(name)}`;
    const store = await caches.open(STORE).catch(() => null);
    const kept = await store?.match(key);
    if (kept) return kept.blob();
    const question = { kind: "film", path: `gallery/${name}/model.toml`, text: this.known.texts[name], width: 240, height: 150, still } as const;
    const drawn = await this.engine.call<Uint8Array<ArrayBuffer> | string>(question, () => {}, 30);
    if (!drawn.length) return null;
    const blob = new Blob([drawn], { type: still ? "image/svg+xml" : "image/gif" });
    await store?.put(key, new Response(blob)).catch(() => {});
    return blob;
  }
}
