// Builds the page: one HTML file with its style, code and Draco's decoder, and room for a set.
//
//   node build.mjs [--modules FOLDER] [--out FILE] [--cpp FILE]
//
// modules: where `npm ci` put node_modules; cpp: the page as a C++ function (page.h).
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

function option(name, otherwise) {
  const at = process.argv.indexOf(`--${name}`);
  return at > 0 ? resolve(process.argv[at + 1]) : otherwise;
}

const modules = join(option("modules", here), "node_modules");
const out = option("out", join(here, "view.html"));
const { build } = createRequire(join(modules, "here.js"))("esbuild");

async function bundle(entry) {
  const made = await build({
    entryPoints: [join(here, "src", entry)],
    bundle: true, minify: true, write: false, format: "iife", target: "es2020",
    platform: "browser", charset: "utf8", legalComments: "none",
    nodePaths: [modules], external: ["fs", "path"],
    loader: { ".wasm": "binary" },
  });
  return made.outputFiles[0].text;
}

/** As the text of a script element, which must hold neither of these. */
function embedded(text) {
  if (/<\/script|<!--/i.test(text)) throw new Error("the code would end its own script element");
  return text;
}

const source = (name) => readFileSync(join(here, "src", name), "utf8");
const [decoder, script] = await Promise.all([bundle("decoder.ts"), bundle("main.ts")]);
const whole = source("page.html")
  .replace("/*STYLE*/", () => source("style.css").replace(/\n\s*/g, "\n"))
  .replace("/*DECODER*/", () => embedded(decoder))
  .replace("/*SCRIPT*/", () => embedded(script));

/** As string literals: printable characters, short enough for every compiler. */
function asCpp(bytes) {
  const pieces = [];
  for (let at = 0; at < bytes.length; at += 8000) {
    const text = Array.from(bytes.subarray(at, at + 8000), (byte) =>
      byte >= 32 && byte < 127 && byte !== 34 && byte !== 92 && byte !== 63
        ? String.fromCharCode(byte) : `\\${byte.toString(8).padStart(3, "0")}`).join("");
    pieces.push(`    "${text}"sv,\n`);
  }
  return `// Made by viewer/build.mjs.
#include "viewer/page.h"

#include <array>
#include <string_view>

namespace nacre {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::array<std::string_view, ${pieces.length}> kPieces{{
${pieces.join("")}}};

}  // namespace

std::string viewer_page() {
  std::string page;
  for (const std::string_view piece : kPieces) page += piece;
  return page;
}

}  // namespace nacre
`;
}

mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, whole);
const cpp = option("cpp", null);
if (cpp) writeFileSync(cpp, asCpp(Buffer.from(whole)));
console.log(`${out}: ${whole.length} bytes (decoder ${decoder.length}, page's code ${script.length})`);
