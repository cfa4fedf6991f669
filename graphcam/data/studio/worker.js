// The engine in WebAssembly.  Requests come as {id, request}, answers go as {id, response}; while it starts {state} goes,
// then {ready}.  What it is made of comes from the page where all is in one file, else from beside this script.
"use strict";

const LIBRARY = ["pyodide.asm.js", "pyodide.js"];
const NEEDED = [...LIBRARY, "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json", "numpy.zip", "graphcam.zip"];
const TYPES = { js: "text/javascript", wasm: "application/wasm", json: "application/json", zip: "application/zip" };
// Nothing is ever asked there: it is what Pyodide takes for its own place.
const NOWHERE = "https://nowhere.invalid/";
const READ = `
import json
from graphcam.studio.engine import answer
lambda text: json.dumps(answer(json.loads(text)), allow_nan=False)
`;
const typeOf = (name) => TYPES[name.split(".").pop()];

// --- the parts ---------------------------------------------------------------------------------------------------------

const heard = new Promise((done) => addEventListener("message", ({ data }) => data.parts && done(data.parts)));

// How many bytes they are, a colon, and for thirteen bits two digits of 91, see lettered() in worker_page.py.
function bytesOf(letters) {
  const first = letters.indexOf(":") + 1, bytes = new Uint8Array(Number(letters.slice(0, first - 1)));
  const digit = (k) => (letters.charCodeAt(k) === 33 ? 60 : letters.charCodeAt(k)) - 35;
  let held = 0, bits = 0, end = 0;
  for (let k = first; k < letters.length; k += 2) {
    held = (held << 13) | (91 * digit(k) + digit(k + 1));
    for (bits += 13; bits >= 8; held &= (1 << bits) - 1) bytes[end++] = held >> (bits -= 8);
  }
  return bytes;
}

async function besides(name) {
  const answer = await fetch(`${location.href.replace(/worker\.js.*$/, "")}${name}.gz`);
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return new Uint8Array(await answer.arrayBuffer());
}

// Some servers take the compression off on the way.
function unpacked(bytes) {
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes.buffer;
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

async function gathered() {
  const carried = location.protocol === "blob:" ? await heard : null;
  const parts = NEEDED.map(async (name) => [name, await unpacked(carried ? bytesOf(carried[name]) : await besides(name))]);
  return new Map(await Promise.all(parts));
}

// --- starting ------------------------------------------------------------------------------------------------------------

function answersFrom(parts) {
  return async (address) => {
    const name = String(address.url || address).split("/").pop(), part = parts.get(name);
    return new Response(part || null, { status: part ? 200 : 404, headers: { "Content-Type": typeOf(name) || "text/plain" } });
  };
}

async function started() {
  const parts = await gathered();
  postMessage({ state: "Python" });
  for (const name of LIBRARY) importScripts(URL.createObjectURL(new Blob([parts.get(name)], { type: typeOf(name) })));
  self.fetch = answersFrom(parts);
  const python = await loadPyodide({ indexURL: NOWHERE });
  // NumPy asks who calls, before it reuses the memory of a large array, and takes 0 for an answer; a NumPy for other
  // loaders of WebAssembly stops for good where there is no such function.
  python._module.mergeLibSymbols({ backtrace: () => 0 }, "backtrace");
  const folder = python.runPython("import site; site.getsitepackages()[0]");
  for (const name of ["numpy.zip", "graphcam.zip"]) python.unpackArchive(parts.get(name), "zip", { extractDir: folder });
  parts.clear();
  postMessage({ state: "NumPy" });
  python.runPython("import numpy");
  postMessage({ state: "graphcam" });
  return python.runPython(READ);
}

// --- answering -----------------------------------------------------------------------------------------------------------

function answered(engine, request) {
  try {
    return JSON.parse(engine(JSON.stringify(request)));
  } catch (error) {
    const last = String(error.message || error).trim().split("\n").pop();
    return { seq: request.seq, ok: false, error: { field: "", message: last, remedy: "" } };
  }
}

// An error while it starts is the worker's own, which the page hears of.
const engine = started().catch((error) => new Promise(() => setTimeout(() => { throw error; })));
engine.then(() => postMessage({ ready: true }));
addEventListener("message", async ({ data }) => {
  if (data.request) postMessage({ id: data.id, response: answered(await engine, data.request) });
});
