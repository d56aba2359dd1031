import { readFileSync, readdirSync, statSync, writeFileSync, existsSync } from "node:fs";
import { createHash } from "node:crypto";
import { join, relative, resolve } from "node:path";
import { defineConfig, type Plugin } from "vite";

const ASSETS = resolve(import.meta.dirname, "../crates/report/assets");
const PACKAGE = resolve(import.meta.dirname, "pkg");

/** The style and the script of the report, from the crate that renders it, so that the page shows what the command writes. */
function report(): Plugin {
  const read = (name: string) => readFileSync(join(ASSETS, name), "utf8");
  const script = () => {
    const parts = ["page.js", "plot.js", "scene.js", "animate.js"].map(read).join("\n");
    const frame = readFileSync(resolve(import.meta.dirname, "src/frame.js"), "utf8");
    return `"use strict";\nfunction begin() {\n${parts}\n${frame}\nreturn steps();\n}\nparent.postMessage("report-ready", location.origin);\n`;
  };
  return {
    name: "report",
    generateBundle() {
      const page = readFileSync(resolve(import.meta.dirname, "src/report.html"), "utf8");
      this.emitFile({ type: "asset", fileName: "report.html", source: page });
      this.emitFile({ type: "asset", fileName: "report.css", source: read("page.css") });
      this.emitFile({ type: "asset", fileName: "report.js", source: script() });
    },
  };
}

/** The module, packed, so that it is small from every plain folder; the page unpacks it. */
function engine(): Plugin {
  return {
    name: "engine",
    generateBundle() {
      const path = join(PACKAGE, "chetaev_bg.wasm.xz");
      if (!existsSync(path)) this.error("pkg/chetaev_bg.wasm.xz is missing: `cargo xtask web` builds it");
      this.emitFile({ type: "asset", fileName: "engine.bin", source: readFileSync(path) });
    },
  };
}

/** The service worker knows every file of the folder, and by their digest whether they are new. */
function offline(): Plugin {
  let out = "";
  return {
    name: "offline",
    configResolved(config) { out = resolve(config.root, config.build.outDir); },
    closeBundle() {
      const files: string[] = [];
      const walk = (folder: string) => {
        for (const name of readdirSync(folder)) {
          const path = join(folder, name);
          if (statSync(path).isDirectory()) walk(path);
          else if (name !== "offline.js") files.push(relative(out, path).replaceAll("\\", "/"));
        }
      };
      walk(out);
      files.sort();
      const digest = createHash("sha256");
      for (const file of files) digest.update(file).update(readFileSync(join(out, file)));
      const source = readFileSync(resolve(import.meta.dirname, "src/offline.js"), "utf8");
      const head = `const VERSION = "${digest.digest("hex").slice(0, 16)}";\nconst FILES = ${JSON.stringify(["./", ...files])};\n`;
      writeFileSync(join(out, "offline.js"), head + source);
    },
  };
}

export default defineConfig({
  base: "./",
  build: {
    outDir: "dist",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: false,
    assetsInlineLimit: 0,
  },
  worker: { format: "es" },
  plugins: [report(), engine(), offline()],
});
