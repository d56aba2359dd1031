// Tests one after the other, each with a page of its own, and what they share.

import assert from "node:assert/strict";
import { launch, serve } from "./browser.mjs";

/** What the tests find that is worth a number. */
export const numbers = {};

export class Sheet {
  constructor(page, url) { Object.assign(this, { page, url, outside: [], problems: [] }); }

  async open(fragment = "") {
    await this.page.goto(this.url + fragment);
    await this.page.evaluate(() => {
      globalThis.longest = 0;
      new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) globalThis.longest = Math.max(globalThis.longest, entry.duration);
      }).observe({ type: "longtask" });
    });
  }

  /** Waits for a mark that is set after this moment of the page's clock. */
  async mark(name, since = 0, seconds = 60) {
    const found = await this.page.waitForFunction(
      ([name, since]) => performance.getEntriesByName(name).find((mark) => mark.startTime > since)?.startTime,
      [name, since], { timeout: 1000 * seconds, polling: 50 });
    return found.jsonValue();
  }

  now() { return this.page.evaluate(() => performance.now()); }
  said() { return this.page.textContent("#said"); }
  longest() { return this.page.evaluate(() => globalThis.longest); }
  text() { return this.page.evaluate(() => [...document.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\n")); }
  kept() { return this.page.evaluate(() => JSON.parse(localStorage.getItem("chetaev-text")).text); }
  /** The report that is shown. */
  async frame() {
    const handle = await this.page.waitForSelector("#page iframe:not(.next)");
    return handle.contentFrame();
  }

  /** Another text, as if pasted over the whole. */
  async paste(text) {
    await this.page.click(".cm-content");
    await this.page.keyboard.press("Control+a");
    await this.page.keyboard.insertText(text);
  }
}

export async function run(tests, chosen) {
  const server = await serve();
  const browser = await launch();
  let failed = 0;
  for (const [name, test, options = {}] of tests) {
    if (chosen.length && !chosen.some((word) => name.includes(word))) continue;
    const context = await browser.newContext({
      viewport: { width: 1300, height: 850 }, permissions: ["clipboard-read", "clipboard-write"], acceptDownloads: true, reducedMotion: "reduce", ...options,
    });
    const page = await context.newPage();
    const sheet = new Sheet(page, server.url);
    context.on("request", (request) => {
      if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(server.url)) sheet.outside.push(request.url());
    });
    page.on("pageerror", (problem) => sheet.problems.push(problem.message));
    page.on("console", (message) => { if (message.type() === "error") sheet.problems.push(message.text()); });
    const began = Date.now();
    try {
      await test(sheet, context);
      assert.deepEqual(sheet.outside, [], "requests that leave the page");
      assert.deepEqual(sheet.problems, [], "errors of the page");
      console.log(`ok      ${name} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
    } catch (problem) {
      failed += 1;
      console.log(`FAILED  ${name}: ${problem.message.split("\n").slice(0, 12).join("\n        ")}`);
    }
    await context.close();
  }
  await browser.close();
  server.stop();
  return failed;
}
