// Sliders for the numbers of the text: parameters and initial values.

export interface Slider {
  kind: "parameter" | "initial";
  name: string;
  about: string;
  unit: string | null;
  value: number;
  low: number;
  high: number;
  from: number;
  to: number;
  quoted: boolean;
}

/** A number as it is written in a model: four digits of the width of the slider. */
export function written(value: number, slider: Slider): string {
  const step = (slider.high - slider.low) / 400;
  const digits = Math.max(0, Math.min(12, Math.ceil(-Math.log10(step)) + 1));
  const text = String(Number(value.toFixed(digits)));
  return slider.quoted ? `"${text}"` : text;
}

export class Sliders {
  private readonly box = document.getElementById("sliders") as HTMLDetailsElement;
  private readonly list = document.getElementById("slider-list") as HTMLElement;
  private shown = "";
  private held = false;

  /** `moved` hears every move, `left` the last one. */
  constructor(private readonly moved: (slider: Slider, text: string) => void, private readonly left: (slider: Slider, text: string) => void) {}

  /** Whether one is held. */
  get isHeld(): boolean { return this.held; }

  show(sliders: Slider[]) {
    this.box.hidden = sliders.length === 0;
    const same = JSON.stringify(sliders.map(({ kind, name }) => [kind, name]));
    if (same === this.shown) {
      sliders.forEach((slider, i) => this.update(this.list.children[i] as HTMLElement, slider));
      return;
    }
    this.shown = same;
    this.list.replaceChildren(...sliders.map((slider) => this.row(slider)));
  }

  private update(row: HTMLElement, slider: Slider) {
    const input = row.querySelector("input") as HTMLInputElement;
    Object.assign((row as HTMLElement & { slider: Slider }).slider, { value: slider.value, from: slider.from, to: slider.to, quoted: slider.quoted });
    if (document.activeElement === input && this.held) return;
    if (slider.value < Number(input.min) || slider.value > Number(input.max)) {
      input.min = String(slider.low);
      input.max = String(slider.high);
    }
    input.value = String(slider.value);
    (row.querySelector("output") as HTMLOutputElement).value = String(slider.value);
  }

  private row(slider: Slider): HTMLElement {
    const row = document.createElement("label") as unknown as HTMLElement & { slider: Slider };
    row.slider = slider;
    const name = row.appendChild(document.createElement("span"));
    name.textContent = slider.kind === "initial" ? `${slider.name} at the start` : slider.name;
    if (slider.about) name.title = slider.about;
    const input = row.appendChild(document.createElement("input"));
    Object.assign(input, { type: "range", min: slider.low, max: slider.high, step: (slider.high - slider.low) / 400 || "any", value: slider.value });
    input.dataset.name = slider.name;
    input.dataset.kind = slider.kind;
    const value = row.appendChild(document.createElement("output"));
    value.value = String(slider.value);
    const unit = slider.unit ? ` ${slider.unit}` : "";
    input.addEventListener("input", () => {
      this.held = true;
      const text = written(Number(input.value), slider);
      value.value = text.replaceAll('"', "") + unit;
      this.moved(slider, text);
    });
    input.addEventListener("change", () => {
      this.held = false;
      this.left(slider, written(Number(input.value), slider));
    });
    return row;
  }
}
