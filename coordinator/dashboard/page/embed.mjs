// Writes a folder's files as C++: node embed.mjs FOLDER OUT_CPP.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { extname, join } from "node:path";

const [, , folder, out] = process.argv;
const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".svg": "image/svg+xml",
  ".woff2": "font/woff2",
};
const files = readdirSync(folder, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
  .sort();
let arrays = "";
let table = "";
files.forEach((file, i) => {
  const type = types[extname(file)];
  if (!type) throw new Error(`${file}: no content type is known for it`);
  arrays += `constexpr std::uint8_t kFile${i}[] = {${[...readFileSync(file)].join(",")}};\n`;
  table += `    {"/${file.slice(folder.length + 1)}", "${type}", kFile${i}},\n`;
});
writeFileSync(
  out,
  `#include "coordinator/dashboard/page_assets.hpp"
namespace lifeline::dashboard {
namespace {
${arrays}
constexpr Asset kAssets[] = {
${table}};
}  // namespace
std::span<const Asset> page_assets() { return kAssets; }
}  // namespace lifeline::dashboard
`,
);
