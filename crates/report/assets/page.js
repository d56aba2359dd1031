// The page: elements, numbers, the shared clock, theme, copying, claims, printing.

const data = JSON.parse(document.getElementById("data").textContent);
const words = data.words;

/** The first element that matches. */
const find = (selector, root = document) => root.querySelector(selector);
/** All elements that match. */
const findAll = (selector, root = document) => [...root.querySelectorAll(selector)];

/** A new HTML element; texts are set as text, never as markup. */
function make(tag, attributes = {}, parent = null, text = null) {
  return finish(document.createElement(tag), attributes, parent, text);
}

/** A new SVG element. */
function draw(tag, attributes = {}, parent = null, text = null) {
  return finish(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, parent, text);
}

function finish(element, attributes, parent, text) {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== null) element.textContent = text;
  if (parent) parent.append(element);
  return element;
}

/** The parts of a name such as `λ_{blade}`: letters, and whether they are a subscript or one letter, set in italics. */
function nameParts(text) {
  return text.split(/_\{([^}]*)\}/).flatMap((part, i) => {
    if (i % 2 === 1) return [{ text: part, isBelow: true, isLetter: false }];
    // A letter may be followed by its unit.
    const [, letter, rest] = part.match(/^(\p{L}\p{M}*)(?=$| )(.*)$/u) ?? [null, "", part];
    return [{ text: letter, isBelow: false, isLetter: true }, { text: rest, isBelow: false, isLetter: false }];
  }).filter((part) => part.text);
}

/** A name as plain text, for labels that only speak. */
const plainName = (text) => text.replace(/_\{([^}]*)\}/g, " $1");

/** Sets a name in an element of HTML. */
function setName(element, text) {
  for (const part of nameParts(text)) {
    if (part.isBelow || part.isLetter) make(part.isBelow ? "sub" : "i", {}, element, part.text);
    else element.append(part.text);
  }
}

/** A template of the table of words with its places filled in. */
function fill(template, ...values) {
  return template.replace(/\{\}/g, () => values.shift() ?? "");
}

/** Numbers of the data; what was not finite is NaN. */
function numbers(values) {
  return Float64Array.from(values, (value) => (value === null ? NaN : value));
}

const raised = (exponent) => String(exponent).replace(/./g, (c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻");

/** A number as people read it. */
function readable(value, digits = 6) {
  if (!Number.isFinite(value)) return "—";
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const trim = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
  const power = Number(exponent);
  const text = power >= -4 && power < digits
    ? trim(value.toFixed(Math.max(0, digits - 1 - power)))
    : `${trim(mantissa)} × 10${raised(power)}`;
  return text.replace("-", "−").replace(/^(−?)1 × /, "$1");
}

/** Round steps (1, 2, 5 times a power of ten) that cover an interval with about `count` parts. */
function niceStep(low, high, count) {
  const rough = (high - low) / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5].find((factor) => factor * power >= rough * 0.999) ?? 10);
}

/** The time that the animation and the cursors of all plots share. */
const clock = newClock();

/** A time with those who follow it. */
function newClock() {
  return {
    time: NaN,
    listeners: [],
    set(time) {
      this.time = time;
      for (const listener of this.listeners) listener(time);
    },
  };
}

/** What must be drawn again when the colors change. */
const themed = [];

function setUpTheme() {
  const root = document.documentElement;
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const store = (value) => { try { localStorage.setItem("chetaev-theme", value); } catch { /* private mode */ } };
  const stored = () => { try { return localStorage.getItem("chetaev-theme"); } catch { return null; } };
  const repaint = () => themed.forEach((paint) => paint());
  if (["light", "dark"].includes(stored())) root.dataset.theme = stored();
  find("#theme").addEventListener("click", () => {
    const isDark = root.dataset.theme ? root.dataset.theme === "dark" : dark.matches;
    root.dataset.theme = isDark ? "light" : "dark";
    store(root.dataset.theme);
    repaint();
  });
  dark.addEventListener("change", repaint);
}

function setUpCopying() {
  document.addEventListener("click", async (event) => {
    const button = event.target.closest("[data-copy], [data-copy-all]");
    if (!button) return;
    const text = button.dataset.copy ?? asLatex(button.closest(".equations"));
    const before = button.dataset.label ?? button.textContent;
    button.dataset.label = before;
    button.textContent = (await copy(text)) ? words.copied : words.copyFailed;
    setTimeout(() => { button.textContent = before; }, 1500);
  });
}

/** The formulas of a section as one numbered, aligned display of LaTeX; its definitions follow. */
function asLatex(section) {
  const lines = findAll(".equation [data-copy]", section).map((button) => button.dataset.copy);
  const aligned = lines.map((line) => "  " + line.replace(/ = /, " &= "));
  return `\\begin{align}\n${aligned.join(" \\\\\n")}\n\\end{align}\n`;
}

/** Copies; where the clipboard is closed to the page (some browsers, for files), the old way. */
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = make("textarea", { readonly: "", class: "offscreen" }, document.body);
    area.value = text;
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

/** What is folded becomes part of the page when it is opened for the first time: formulas are most of a page. */
function unfold(details) {
  const template = find(":scope > template", details);
  if (!template) return;
  template.replaceWith(template.content);
  lookAtFormulas(details);
}

/** Opens what is folded, with everything that it stands in. */
function openUp(details) {
  for (let outer = details; outer; outer = outer.parentElement?.closest("details")) {
    unfold(outer);
    outer.open = true;
  }
}

/** The element of an id, also where it is folded. */
function byId(id) {
  const found = document.getElementById(id);
  if (found) return found;
  for (const template of findAll("template")) {
    if (!template.content.getElementById(id)) continue;
    openUp(template.parentElement);
    return document.getElementById(id);
  }
  return null;
}

function setUpFolding() {
  document.addEventListener("toggle", (event) => {
    if (event.target.open) unfold(event.target);
  }, true);
  const reveal = () => {
    let id = location.hash.slice(1);
    try { id = decodeURIComponent(id); } catch { /* shown as it is */ }
    const target = id && byId(id);
    const details = target?.closest?.("details") ?? target?.querySelector?.(":scope > details.folded");
    if (!details) return;
    if (details.hidden) showClaims("", "");
    openUp(details);
    target.scrollIntoView();
  };
  addEventListener("hashchange", reveal);
  reveal();
}

/** Everything that a claim says, for the search. */
const said = (claim) =>
  (claim.textContent + (find(":scope > template", claim)?.content.textContent ?? "")).toLowerCase();

/** Shows the claims of a verdict that contain all words; none for all. */
function showClaims(verdict, sought) {
  const words = sought.toLowerCase().split(/\s+/).filter(Boolean);
  for (const button of findAll("[data-filter]")) button.setAttribute("aria-pressed", button.dataset.filter === verdict);
  for (const claim of findAll("details.claim")) {
    const isOther = verdict !== "" && claim.dataset.verdict !== verdict;
    claim.hidden = isOther || !words.every((word) => said(claim).includes(word));
  }
  for (const group of findAll(".claim-group")) {
    group.hidden = !find(".claim:not([hidden])", group);
    if (verdict !== "" || words.length > 0) group.open = !group.hidden;
  }
}

function setUpClaims() {
  const search = find("#search");
  let verdict = "";
  for (const button of findAll("[data-filter]")) {
    button.addEventListener("click", () => {
      verdict = button.dataset.filter;
      showClaims(verdict, search?.value ?? "");
    });
  }
  search?.addEventListener("input", () => showClaims(verdict, search.value));
  const all = find("#expand-claims");
  all?.addEventListener("click", () => {
    const isOpen = all.getAttribute("aria-pressed") !== "true";
    for (const details of findAll(".claim-group, details.claim")) {
      if (isOpen) unfold(details);
      details.open = isOpen;
    }
    all.setAttribute("aria-pressed", isOpen);
    all.textContent = isOpen ? words.collapse : words.expand;
  });
}

/** Formulas wider than the page scroll; those that do can be reached with the keyboard. */
function lookAtFormulas(root = document) {
  // All are measured before one is changed: a change between two measures has the whole page laid out again.
  const measured = findAll(".formula, .where li, .scroll, .listing", root).map((box) => [box, box.scrollWidth > box.clientWidth + 1]);
  for (const [box, isWide] of measured) {
    box.classList.toggle("wide", isWide);
    if (isWide) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
  }
}

function setUpFormulas() {
  addEventListener("resize", () => lookAtFormulas());
  lookAtFormulas();
}

/** The entry of the contents for what is in view. */
function setUpContents() {
  const links = new Map(findAll("nav ol a").map((link) => [decodeURIComponent(link.hash.slice(1)), link]));
  const targets = [...links.keys()].map((id) => document.getElementById(id)).filter(Boolean);
  const mark = () => {
    let current = targets[0];
    for (const target of targets) if (target.getBoundingClientRect().top < innerHeight * 0.3) current = target;
    for (const [id, link] of links) {
      if (id === current?.id) {
        link.setAttribute("aria-current", "true");
        // The list scrolls along; the page does not.
        const list = link.closest("nav");
        const [own, frame] = [link.getBoundingClientRect(), list.getBoundingClientRect()];
        if (own.top < frame.top || own.bottom > frame.bottom) {
          list.scrollTop += own.top - frame.top - frame.height / 2;
        }
      } else link.removeAttribute("aria-current");
    }
  };
  let waiting = false;
  addEventListener("scroll", () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; mark(); });
  }, { passive: true });
  mark();
}

/** Paper cannot scroll: formulas wider than it are set smaller, down to a third. */
function fitFormulas() {
  const room = 480;
  for (const formula of findAll(".formula math")) {
    const width = formula.getBoundingClientRect().width;
    if (width > room) formula.style.fontSize = `${Math.max(0.33, room / width)}em`;
  }
}

/** Paper shows all evidence, in light colors. */
function setUpPrinting() {
  let opened = [];
  let theme;
  addEventListener("beforeprint", () => {
    for (const details of findAll("details")) unfold(details);
    opened = findAll("details:not([open])");
    for (const details of opened) details.open = true;
    theme = document.documentElement.dataset.theme;
    document.documentElement.dataset.theme = "light";
    fitFormulas();
    themed.forEach((paint) => paint());
  });
  addEventListener("afterprint", () => {
    for (const details of opened) details.open = false;
    for (const formula of findAll(".formula math")) formula.style.fontSize = "";
    if (theme) document.documentElement.dataset.theme = theme;
    else delete document.documentElement.dataset.theme;
    themed.forEach((paint) => paint());
  });
}

/** What makes a page of the elements, in order; the playground lets other tasks go between. */
const steps = () => [
  setUpTheme, setUpCopying, setUpFolding, setUpClaims, setUpFormulas, setUpContents, setUpPrinting, setUpPlots, setUpAnimation, setUpAlbums,
];

function start() {
  for (const step of steps()) step();
}

