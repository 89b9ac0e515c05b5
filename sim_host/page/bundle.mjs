// node bundle.mjs PAGE NODE_MODULES OUT.cpp
// Makes one C++ source of a page: its HTML with styles, modules and libraries in it, and a gap for the data.
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [page, modules, target] = process.argv.slice(2);
const folder = join(dirname(fileURLToPath(import.meta.url)), page);
const { buildSync } = createRequire(join(modules, "any.js"))("esbuild");

// Compilers need not take longer literals than this.
const LITERAL_BYTES = 12000;
const DATA_GAP = "<!-- data -->";

function bundle() {
  const { outputFiles } = buildSync({
    entryPoints: [join(folder, "main.js")],
    outdir: "out",
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    legalComments: "inline",
    nodePaths: [modules],
    logLevel: "warning",
  });
  const textOf = (ending) => outputFiles.find((file) => file.path.endsWith(ending))?.text ?? "";
  return { script: textOf(".js"), style: textOf(".css") };
}

/** A raw string may not be longer than a compiler takes, and must not hold its own end. */
function literal(text) {
  const pieces = [];
  for (let at = 0; at < text.length; at += LITERAL_BYTES) pieces.push(text.slice(at, at + LITERAL_BYTES));
  if (text.includes(')PAGE"')) throw new Error("the page holds the end of its own literal");
  return pieces.map((piece) => `R"PAGE(${piece})PAGE"`).join("\n") || '""';
}

const { script, style } = bundle();
const html = readFileSync(join(folder, "page.html"), "utf8");
const [head, tail] = html.split(DATA_GAP);
if (tail === undefined) throw new Error(`${page}/page.html has no ${DATA_GAP}`);
const before = head.replace("</head>", () => `<style>${style}</style>\n</head>`);
const after = tail.replace("</body>", () => `<script>${script}</script>\n</body>`);
writeFileSync(
  target,
  `#include "sim_host/page/page.hpp"\n\nnamespace morepro::host {\n\n` +
    `const PageParts k_${page}_page{"${page}",\n${literal(before)},\n${literal(after)}, {}};\n\n}\n`,
);
