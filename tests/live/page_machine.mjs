// Runs the machine of a page without a browser: node page_machine.mjs PAGE.html SCRIPT.json OUT.csv
// The script is a list of messages of the page; {"ticks": n} does n single ticks. Writes the table of all frames, and prints the last status.
import { readFileSync, writeFileSync } from "node:fs";
import vm from "node:vm";
import { inflateSync } from "node:zlib";

const [page, script, out] = process.argv.slice(2);
const html = readFileSync(page, "utf8");
const part = (name) => inflateSync(Buffer.from(html.match(new RegExp(`id="${name}">([^<]*)<`))[1], "base64"));
const bytes = (name) => new Uint8Array(part(name));
const heard = [];
const self = { postMessage: (message) => heard.push(message) };
// time stands still: only what the script says happens
const space = vm.createContext({ self, WebAssembly, performance: { now: () => 0 }, setInterval: () => 0, TextEncoder, console });
vm.runInContext(part("program").toString(), space);
self.onmessage({ data: { machine: JSON.parse(part("machine")), memory: bytes("memory"), kernels: bytes("kernels"), package: bytes("package") } });
const say = (message) => self.onmessage({ data: JSON.stringify(message) });
for (const message of JSON.parse(readFileSync(script, "utf8"))) {
  if ("ticks" in message) for (let k = 0; k < message.ticks; k++) say({ type: "command", word: "step", number: 0 });
  else say(message);
}
say({ type: "command", word: "table", number: 0 });
const TABLE = 5;
const tables = heard.filter((each) => typeof each !== "string" && each.byteLength > 4 && new DataView(each).getUint32(0, true) === TABLE);
writeFileSync(out, Buffer.from(tables.at(-1)).subarray(4));
const words = heard.filter((each) => typeof each === "string").map((each) => JSON.parse(each));
console.log(JSON.stringify(words.filter((each) => each.type === "status").at(-1)));
