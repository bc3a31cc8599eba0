// Bundles the page into the Python package: one script, one style sheet, the notices of what is inside.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";

const out = "../src/nivel/view/page";
const notice = (name) => `${name}\n\n${readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim()}\n`;

const bundle = (entryPoints, banner) =>
  build({
    entryPoints,
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    loader: { ".css": "css" },
    banner: { js: banner },
    outdir: out,
    logLevel: "info",
  });
await bundle({ viewer: "src/main.ts" }, "/* three.js, uPlot and dagre: MIT licence, see NOTICE */");
await bundle({ program: "src/local/program.ts" }, "");
await bundle({ diagram: "src/report.ts" }, "/* dagre: MIT licence */");
writeFileSync(`${out}/NOTICE`, ["three", "uplot", "@dagrejs/dagre"].map(notice).join("\n---\n\n"));
writeFileSync(`${out}/DAGRE`, notice("@dagrejs/dagre"));

// what the bundle was made from: tests compare
const files = readdirSync("src", { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => `${entry.parentPath ?? entry.path}/${entry.name}`.replaceAll("\\", "/"))
  .sort();
const digest = createHash("sha256");
for (const file of [...files, "build.mjs", "package-lock.json"]) digest.update(readFileSync(file));
writeFileSync(`${out}/SOURCES`, `${digest.digest("hex")}\n`);
