// `node tests/run.mjs [--full] [NAME…]`: drives web/dist as a person would.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { numbers, run } from "./harness.mjs";

const ROOT = resolve(import.meta.dirname, "../..");
const DIST = join(ROOT, "web/dist");
const words = process.argv.slice(2);
const isFull = words.includes("--full");
const chosen = words.filter((word) => !word.startsWith("--"));

/** The sleigh of the README. */
const README = readFileSync(join(ROOT, "README.md"), "utf8");
const SLEIGH = /```toml\n([\s\S]*?)```/.exec(README)[1];

/** Models whose claims take few seconds; `--full` takes all of them. */
const SHORT = ["chaplygin-sleigh", "skate-level", "vertical-rolling-disc", "particle-y-dx"];

/** What the command says: verdicts by claim, and the trajectory by the interpreter. */
function command(model) {
  const out = mkdtempSync(join(tmpdir(), "chetaev-web-"));
  const built = process.env.CARGO_TARGET_DIR ?? join(ROOT, "target");
  const path = `gallery/${model}/model.toml`;
  try {
    execFileSync(join(built, "debug/chetaev"), ["study", path, "--out", out], { cwd: ROOT, env: { ...process.env, CHETAEV_BACKEND: "interpreter" }, stdio: "pipe" });
  } catch (problem) {
    // Expectations that are not met are told by the status.
    if (problem.status !== 1) throw problem;
  }
  const read = (name) => { try { return readFileSync(join(out, name), "utf8"); } catch { return ""; } };
  const found = { record: JSON.parse(read("study.json")), csv: read("trajectory.csv") };
  rmSync(out, { recursive: true });
  return found;
}

const verdicts = (record) => Object.fromEntries(record.verdicts.map((own) => [own.id ?? own.claim + (own.subject ? `#${own.subject}` : ""), own.verdict]));

async function downloaded(sheet, what) {
  const [file] = await Promise.all([sheet.page.waitForEvent("download"), sheet.page.selectOption("#download", what)]);
  return readFileSync(await file.path(), "utf8");
}

/** Every number is the same to its last bit: elementary functions are the same everywhere. */
function same(text, other, model) {
  const [a, b] = [text.trim().split("\n"), other.trim().split("\n")];
  assert.equal(a.length, b.length, model);
  const first = a.findIndex((line, i) => line !== b[i]);
  assert.equal(first, -1, `${model}: line ${first + 1}: ${a[first]} and ${b[first]}`);
}

/** Finds nothing serious, in the page and in the report. */
async function accessible(sheet, frames) {
  const source = readFileSync(join(ROOT, "web/node_modules/axe-core/axe.min.js"), "utf8");
  for (const frame of frames ?? [sheet.page.mainFrame(), await sheet.frame()]) {
    await frame.evaluate(source);
    const { violations } = await frame.evaluate(() => axe.run(document, { iframes: false, resultTypes: ["violations"] }));
    const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
    assert.deepEqual(serious.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`), []);
  }
}

/** A model of the gallery with the questions on steady motions beside it. */
async function asking(sheet, model) {
  await sheet.open(`#gallery=${model}`);
  await sheet.mark("equations");
  if (await sheet.page.isVisible("#show-report")) await sheet.page.click("#show-report");
  await sheet.page.click("#view-ask");
}

/** Asks what the form says and gives the words of the answer. */
async function answered(sheet, what, fields = {}, seconds = 120) {
  const { page } = sheet;
  await page.selectOption("#ask-what", what);
  for (const [id, value] of Object.entries(fields)) {
    if (await page.evaluate((id) => document.getElementById(id).tagName === "SELECT", id)) await page.selectOption(`#${id}`, value);
    else await page.fill(`#${id}`, value);
  }
  const since = await sheet.now();
  await page.click("#ask-go");
  const took = Math.round(await sheet.mark("answer", since, seconds) - since);
  numbers[`${what}Milliseconds`] = Math.max(took, numbers[`${what}Milliseconds`] ?? 0);
  return page.textContent("#answer pre");
}

/** The same where there is no answer. */
async function refused(sheet, what, fields) {
  await sheet.page.selectOption("#ask-what", what);
  for (const [id, value] of Object.entries(fields)) await sheet.page.fill(`#${id}`, value);
  const since = await sheet.now();
  await sheet.page.click("#ask-go");
  await sheet.mark("refusal", since);
  return sheet.page.textContent("#answer .refused");
}

const tests = [
  ["the first load is small and the first equations come soon", async (sheet) => {
    let packed = 0;
    const { gzipSync } = await import("node:zlib");
    const walk = (folder) => {
      for (const name of readdirSync(folder)) {
        const path = join(folder, name);
        if (statSync(path).isDirectory()) walk(path);
        else packed += name.endsWith(".bin") ? statSync(path).size : gzipSync(readFileSync(path)).length;
      }
    };
    walk(DIST);
    await sheet.open();
    numbers.firstLoadBytes = packed;
    numbers.firstEquationsMilliseconds = Math.round(await sheet.mark("equations"));
    assert.ok(packed <= 3e6, `${packed} bytes`);
    assert.ok(numbers.firstEquationsMilliseconds <= 2000, `${numbers.firstEquationsMilliseconds} ms`);
  }],

  ["the sleigh of the README is typed letter by letter", async (sheet) => {
    await sheet.open();
    await sheet.mark("equations");
    await sheet.page.click(".cm-content");
    await sheet.page.keyboard.press("Control+a");
    await sheet.page.keyboard.press("Delete");
    await sheet.page.keyboard.type(SLEIGH, { delay: 4 });
    const since = await sheet.now();
    numbers.equationsAfterTypingMilliseconds = Math.round(await sheet.mark("equations", since) - since);
    assert.equal(await sheet.kept(), SLEIGH);
    await sheet.mark("motion", since);
    const frame = await sheet.frame();
    assert.equal(await frame.textContent("h1"), "Sleigh");
    assert.ok(await frame.locator("#equations math").count() > 3);
    await sheet.mark("claims", since);
    assert.match(await sheet.said(), /claims are decided/);
    numbers.claimsOfSleighMilliseconds = Math.round(await sheet.mark("claims", since) - since);
    numbers.longestTaskWhileTypingMilliseconds = Math.round(await sheet.longest());
    assert.ok(numbers.longestTaskWhileTypingMilliseconds <= 100, `a task of ${numbers.longestTaskWhileTypingMilliseconds} ms`);
  }],

  ["a slip is underlined and mended by the quick fix", async (sheet) => {
    await sheet.open();
    await sheet.mark("motion");
    await sheet.paste(SLEIGH.replace("phi' sin(phi))^2", "phi' sin(phj))^2"));
    await sheet.page.waitForSelector(".cm-lintRange-error");
    const since = await sheet.now();
    await sheet.page.click("#problems .fix");
    await sheet.mark("equations", since);
    assert.equal(await sheet.kept(), SLEIGH);
    assert.equal(await sheet.page.locator(".cm-lintRange-error").count(), 0);
    // The same from the keyboard.
    await sheet.paste(SLEIGH.replace("coordinates", "coordinats"));
    await sheet.page.waitForSelector(".cm-lintRange-error");
    await sheet.page.keyboard.press("Control+Home");
    await sheet.page.keyboard.press("Control+.");
    await sheet.mark("equations", await sheet.now());
    assert.equal(await sheet.kept(), SLEIGH);
  }],

  ["a slider moves the motion and the text", async (sheet) => {
    await sheet.open();
    await sheet.mark("motion");
    await sheet.page.click("#sliders > summary");
    const slider = sheet.page.locator("input[type=range][data-name=a]");
    const path = async () => (await sheet.frame()).evaluate(() => shown.state().time);
    await slider.scrollIntoViewIfNeeded();
    const box = await slider.boundingBox();
    await sheet.page.mouse.move(box.x + box.width * 0.6, box.y + box.height / 2);
    await sheet.page.mouse.down();
    for (let i = 0; i < 12; i++) {
      await sheet.page.mouse.move(box.x + box.width * (0.6 + 0.02 * i), box.y + box.height / 2);
      await sheet.page.waitForTimeout(30);
    }
    await path();
    const since = await sheet.now();
    await sheet.page.mouse.up();
    await sheet.mark("motion", since);
    const moved = /a = ([-\d.]+)/.exec(await sheet.kept());
    assert.notEqual(Number(moved[1]), 0.25);
    assert.ok(Number(moved[1]) > 0.25);
  }],

  ["the motion plays", async (sheet) => {
    await sheet.open();
    await sheet.mark("motion");
    const frame = await sheet.frame();
    await frame.click("#animation .play");
    await sheet.page.waitForTimeout(600);
    await frame.click("#animation .play");
    assert.ok(await frame.evaluate(() => shown.state().time) > 0.2);
  }],

  ["verdicts are the words of the command, and trajectories its numbers", async (sheet) => {
    await sheet.open();
    await sheet.mark("equations");
    const all = await sheet.page.evaluate(async () => [...document.querySelectorAll("[data-model]")].map((card) => card.dataset.model));
    for (const model of isFull ? all : SHORT) {
      const since = await sheet.now();
      await sheet.page.click("#gallery-button");
      await sheet.page.click(`[data-model="${model}"]`);
      await sheet.mark("claims", since, 280);
      const page = JSON.parse(await downloaded(sheet, "record"));
      const own = command(model);
      if (!own.record.verdicts) continue;
      assert.deepEqual(verdicts(page), verdicts(own.record), model);
      if (own.csv) same(await downloaded(sheet, "csv"), own.csv, model);
    }
  }],

  ["every model of the gallery opens", async (sheet) => {
    await sheet.open();
    await sheet.mark("equations");
    const all = await sheet.page.evaluate(() => [...document.querySelectorAll("[data-model]")].map((card) => card.dataset.model));
    assert.ok(all.length > 60);
    const step = isFull ? 1 : 7;
    for (const model of all.filter((_, i) => i % step === 0)) {
      const since = await sheet.now();
      await sheet.page.click("#gallery-button");
      await sheet.page.click(`[data-model="${model}"]`);
      const took = await sheet.mark("equations", since, 60) - since;
      if (took > (numbers.slowestEquationsMilliseconds ?? 0)) Object.assign(numbers, { slowestEquationsMilliseconds: Math.round(took), slowestEquations: model });
    }
  }],

  ["it works offline", async (sheet, context) => {
    await sheet.open();
    await sheet.mark("motion");
    await sheet.page.evaluate(() => navigator.serviceWorker.ready);
    await sheet.page.waitForFunction(async () => (await caches.keys()).some((name) => name.startsWith("chetaev-")));
    await sheet.page.reload();
    await sheet.mark("equations");
    await context.setOffline(true);
    await sheet.page.reload();
    await sheet.mark("motion");
    assert.ok(await (await sheet.frame()).locator("math").count() > 3);
  }],

  ["a link holds the model", async (sheet, context) => {
    await sheet.open();
    await sheet.mark("motion");
    await sheet.paste(SLEIGH.replace('name = "sleigh"', 'name = "<b>fräulein</b>"'));
    await sheet.mark("motion", await sheet.now());
    await sheet.page.click("#share-button");
    await sheet.page.waitForFunction(() => location.hash.startsWith("#m="));
    const link = await sheet.page.evaluate(() => navigator.clipboard.readText());
    const other = await context.newPage();
    await other.goto(link);
    await other.waitForFunction(() => performance.getEntriesByName("motion").length > 0, null, { timeout: 30000 });
    const frame = await (await other.waitForSelector("#page iframe:not(.next)")).contentFrame();
    // A hostile name is text.
    assert.equal(await frame.locator("b", { hasText: /^fräulein$/ }).count(), 0);
    assert.match(await frame.textContent("h1"), /fräulein/i);
    await other.close();
  }],

  ["a hostile link ends with a sentence", async (sheet) => {
    const bomb = Buffer.from((await import("node:zlib")).deflateRawSync(Buffer.alloc(50 << 20, 32))).toString("base64url");
    await sheet.open(`#m=${bomb}`);
    await sheet.page.waitForFunction(() => performance.getEntriesByName("motion").length > 0);
    await sheet.page.goto("about:blank");
    await sheet.open("#m=%%%");
    await sheet.page.waitForFunction(() => performance.getEntriesByName("motion").length > 0);
  }],

  ["LaTeX is copied", async (sheet) => {
    await sheet.open();
    await sheet.mark("motion");
    const frame = await sheet.frame();
    const button = frame.locator(".equation .copy").first();
    await button.scrollIntoViewIfNeeded();
    await button.focus();
    await sheet.page.keyboard.press("Enter");
    await sheet.page.waitForFunction(async () => (await navigator.clipboard.readText()).length > 3);
    assert.match(await sheet.page.evaluate(() => navigator.clipboard.readText()), /[\\=]/);
    assert.match(await downloaded(sheet, "python"), /sympy/);
    assert.match(await downloaded(sheet, "c"), /double/);
  }],

  ["a disc that rolls is put together in the form", async (sheet) => {
    const { page } = sheet;
    await sheet.open();
    await sheet.mark("motion");
    const before = await sheet.kept().catch(() => null);
    await page.click("#view-form");
    assert.ok(await page.isVisible("#form-other"), "the text is another model");
    await page.selectOption("#form-begin", "nothing");
    await page.click("#form-add-bodies");
    assert.equal(await page.evaluate(() => document.activeElement.id), "form-bodies-0-name");
    await page.fill("#form-bodies-0-name", "coin");
    await page.selectOption("#form-bodies-0-shape", "disc");
    await page.fill("#form-bodies-0-radius", "3 cm");
    await page.fill("#form-bodies-0-mass", "0.01");
    await page.click("#form-add-contacts");
    assert.equal(await page.inputValue("#form-contacts-0-body"), "coin");
    await page.fill("#form-contacts-0-coordinates", "x, y, heading, lean, roll");
    // The contact follows the name of the body.
    await page.fill("#form-bodies-0-name", "disc");
    assert.equal(await page.inputValue("#form-contacts-0-body"), "disc");
    await page.fill("#form-initial-lean", "0.2");
    const since = await sheet.now();
    await page.fill("#form-initial-roll-rate", "40");
    await sheet.mark("motion", since);
    const wanted = `name = "mechanism"

[bodies]
disc = { shape = "disc", mass = 0.01, radius = "3 cm" }

[contacts]
contact_1 = { type = "rolling", body = "disc", coordinates = ["x", "y", "heading", "lean", "roll"] }

[initial]
lean = 0.2
"roll'" = 40

[simulation]
t_end = 5
`;
    assert.equal(await sheet.kept(), wanted);
    assert.ok(await (await sheet.frame()).locator("#equations math").count() > 3);
    await accessible(sheet);
    // What is wrong is said beneath the form, and leads to the text.
    await page.fill("#form-bodies-0-mass", "-1");
    await page.waitForSelector("#problems .problem.error");
    await page.click("#problems .problem.error > button");
    assert.ok(await page.isVisible(".cm-content"));
    // Undoing brings the sleigh back.
    for (let i = 0; i < 200 && (await sheet.text()).includes("[bodies]"); i++) await page.keyboard.press("Control+z");
    assert.match(await sheet.text(), /blade = /);
    assert.ok(before === null || before.includes("blade"));
  }],

  ["every beginning of the form is a model without faults", async (sheet) => {
    await sheet.open();
    await sheet.mark("motion");
    await sheet.page.click("#view-form");
    const all = await sheet.page.evaluate(() => [...document.querySelectorAll("#form-begin option")].map(({ value }) => value).filter((value) => value && value !== "nothing"));
    assert.ok(all.length >= 3);
    for (const beginning of all) {
      const since = await sheet.now();
      await sheet.page.selectOption("#form-begin", beginning);
      await sheet.mark("motion", since);
      assert.ok(await sheet.page.isHidden("#problems"), beginning);
      assert.ok(await sheet.page.isHidden("#form-other"), beginning);
    }
  }],

  ["a phone", async (sheet) => {
    await sheet.open();
    await sheet.mark("claims");
    await sheet.page.click("#show-report");
    await sheet.page.waitForTimeout(300);
    const wide = () => document.documentElement.scrollWidth - innerWidth;
    assert.ok(await sheet.page.evaluate(wide) <= 0);
    assert.ok(await (await sheet.frame()).evaluate(wide) <= 0);
    await accessible(sheet);
    await sheet.page.click("#show-model");
    assert.ok(await sheet.page.isVisible(".cm-content"));
    await sheet.page.click("#view-form");
    assert.ok(await sheet.page.evaluate(wide) <= 0);
    await sheet.page.click("#gallery-button");
    assert.ok(await sheet.page.evaluate(wide) <= 0);
  }, { viewport: { width: 390, height: 800 } }],

  ["with the keyboard only", async (sheet) => {
    await sheet.open();
    await sheet.mark("equations");
    const { keyboard } = sheet.page;
    const focused = () => sheet.page.evaluate(() => document.activeElement?.id || document.activeElement?.className || "");
    const tabTo = async (wanted) => {
      for (let i = 0; i < 60; i++) {
        await keyboard.press("Tab");
        if ((await focused()).includes(wanted)) return;
      }
      assert.fail(`${wanted} cannot be reached`);
    };
    await tabTo("gallery-button");
    await keyboard.press("Enter");
    await sheet.page.waitForSelector("#gallery[open]");
    await sheet.page.waitForTimeout(100);
    if (!(await focused()).includes("gallery-search")) await tabTo("gallery-search");
    await keyboard.type("skate on a level");
    for (let i = 0; i < 20 && !(await sheet.page.evaluate(() => document.activeElement?.dataset.model)); i++) await keyboard.press("Tab");
    const since = await sheet.now();
    await keyboard.press("Enter");
    await sheet.mark("equations", since);
    // Into the editor and out of it again.
    await tabTo("cm-content");
    await keyboard.press("Escape");
    await keyboard.press("Tab");
    assert.notEqual(await focused(), "cm-content");
  }],

  ["nothing serious for those who do not see", async (sheet) => {
    await sheet.open();
    await sheet.mark("claims");
    await sheet.page.click("#claims > summary");
    await sheet.page.click("#sliders > summary");
    await accessible(sheet);
    await sheet.page.click("#theme-button");
    await accessible(sheet);
  }],

  ["the bicycle is stable between two speeds", async (sheet) => {
    await asking(sheet, "whipple-bicycle");
    assert.equal(await sheet.page.inputValue("#ask-parameter"), "v");
    // The report of the bicycle is large; asking takes nothing of the page's own thread.
    await sheet.mark("motion", 0, 120);
    await sheet.page.waitForTimeout(500);
    await sheet.page.evaluate(() => { globalThis.longest = 0; });
    const words = await answered(sheet, "stability", { "ask-from": "0", "ask-to": "10" });
    assert.match(words, /4\.29238253634110\d* < v < 6\.02426201538835\d*: stable/);
    assert.match(await sheet.page.textContent("#answer svg"), /4\.292383[^]*6\.024262/);
    assert.ok(await sheet.longest() <= 100, `a task of ${await sheet.longest()} ms`);
    await accessible(sheet, [sheet.page.mainFrame()]);
    await sheet.page.click("#theme-button");
    await accessible(sheet, [sheet.page.mainFrame()]);
    const [file] = await Promise.all([sheet.page.waitForEvent("download"), sheet.page.click("#answer .files button:has-text('JSON')")]);
    const { critical } = JSON.parse(readFileSync(await file.path(), "utf8"));
    assert.deepEqual(critical.map(({ kind, value }) => [kind, value.toFixed(6)]), [["pair", "4.292383"], ["zero", "6.024262"]]);
    // Over the trail too, coarsely.
    const map = await answered(sheet, "stability", { "ask-second": "c", "ask-second-from": "0.02", "ask-second-to": "0.14", "ask-side": "12" });
    assert.match(map, /boundary from .*a pair of eigenvalues passes the axis/);
    assert.ok(await sheet.page.locator("#answer svg polyline").count() >= 2);
    // What is computed for long is stopped.
    await sheet.page.fill("#ask-side", "200");
    await sheet.page.click("#ask-go");
    await sheet.page.waitForFunction(() => /%/.test(document.getElementById("ask-said").textContent));
    await sheet.page.click("#ask-stop");
    assert.equal(await sheet.page.textContent("#ask-said"), "Stopped.");
    assert.match(await refused(sheet, "stability", { "ask-parameter": "speed", "ask-second": "" }), /`speed` is no parameter of the model; its parameters are .*\bv\b/);
  }],

  ["the steady motions of the rolling disc", async (sheet) => {
    await asking(sheet, "falling-rolling-disc");
    const words = await answered(sheet, "steady");
    assert.match(words, /a family with 2 parameters\n\s+theta = theta_0, free/);
    assert.match(words, /These are all/);
    const about = await sheet.page.evaluate(() => [...document.querySelectorAll("#ask-about option")].map((option) => option.value));
    assert.ok(["1", "2", "3"].every((name) => about.includes(name)), about.join());
  }],

  ["the frequencies of the double pendulum, and words at the place of a mistake", async (sheet) => {
    await asking(sheet, "double-pendulum");
    await answered(sheet, "steady");
    const words = await answered(sheet, "linearize", { "ask-about": "1" });
    assert.match(words, /0\.000000\+5\.787351i/);
    assert.match(words, /0\.000000\+2\.397199i/);
    assert.match(await sheet.page.textContent("#answer .files"), /LaTeX.*MATLAB/);
    await sheet.page.selectOption("#ask-about", "rest");
    assert.match(await refused(sheet, "linearize", {}), /the motion `rest` is not steady/);
    // An answer is about the text that was asked about.
    await answered(sheet, "steady");
    await sheet.paste(SLEIGH);
    assert.ok(await sheet.page.isVisible("#ask-old"));
    await answered(sheet, "steady");
    assert.ok(!(await sheet.page.isVisible("#ask-old")));
    await sheet.paste(SLEIGH.replace("phi' sin(phi))^2", "phi' sin(phj))^2"));
    assert.ok(await sheet.page.isVisible("#ask-old"));
    assert.match(await refused(sheet, "steady", {}), /model\.toml:\d+:\d+/);
  }],

  ["the governor is followed to its Hopf point, on a phone too", async (sheet) => {
    await asking(sheet, "watt-governor");
    const words = await answered(sheet, "follow", { "ask-parameter": "eps", "ask-from": "0.1", "ask-to": "1" });
    assert.match(words, /eps = 0\.464758\d*: Hopf point/);
    assert.match(await sheet.page.textContent("#answer svg"), /Hopf 0\.464758/);
    assert.ok(await sheet.page.evaluate(() => document.documentElement.scrollWidth - innerWidth) <= 0);
    assert.ok(await sheet.page.evaluate(() => { const box = document.getElementById("ask"); return box.scrollWidth - box.clientWidth; }) <= 0);
    await accessible(sheet, [sheet.page.mainFrame()]);
  }, { viewport: { width: 390, height: 800 } }],

  ["mutated models", async (sheet) => {
    await sheet.open();
    await sheet.mark("equations");
    let seed = 12345;
    const random = (n) => { seed = (Math.imul(seed, 1103515245) + 12345) >>> 0; return Math.floor((seed / 2 ** 32) * n); };
    const folders = readdirSync(join(ROOT, "gallery")).filter((name) => { try { return statSync(join(ROOT, "gallery", name, "model.toml")).isFile(); } catch { return false; } });
    const texts = folders.map((name) => readFileSync(join(ROOT, "gallery", name, "model.toml"), "utf8"));
    const pieces = ["'", "\"", "^2", "^-9", "[", "]", "=", "1e308", "0", "sqrt(", ")", "/0", "phi", "{", "}", "\u0000", "∞", "\n", "sum(i = 1..9999, x)", "#"];
    const count = isFull ? 2000 : 200;
    for (let i = 0; i < count; i++) {
      let text = texts[random(texts.length)];
      for (let k = 0; k <= random(4); k++) {
        const at = random(text.length);
        const cut = random(3) === 0 ? random(12) : 0;
        text = text.slice(0, at) + pieces[random(pieces.length)] + text.slice(at + cut);
      }
      text = text.replaceAll("\u0000", " ").replaceAll("\r", "");
      await sheet.paste(text);
      await sheet.page.waitForTimeout(isFull ? 250 : 60 + random(150));
      assert.equal(await sheet.kept(), text, `mutant ${i}`);
    }
    const memory = await sheet.page.evaluate(() => performance.memory?.usedJSHeapSize ?? 0);
    numbers.longestTaskOfMutantsMilliseconds = Math.round(await sheet.longest());
    assert.ok(memory <= 1e9, `${memory} bytes`);
    assert.ok(numbers.longestTaskOfMutantsMilliseconds <= 100, `a task of ${numbers.longestTaskOfMutantsMilliseconds} ms`);
    // It still answers.
    const since = await sheet.now();
    await sheet.paste(SLEIGH);
    await sheet.mark("motion", since, 60);
  }],
];

const failed = await run(tests, chosen);
console.log(JSON.stringify(numbers, null, 2));
const out = process.env.CHETAEV_NUMBERS;
if (out) writeFileSync(out, `${JSON.stringify(numbers, null, 2)}\n`);
process.exitCode = failed === 0 ? 0 : 1;
