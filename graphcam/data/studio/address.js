// The state in the address: "#1." and what differs from the built-in task, as JSON, deflated, in base64url.
"use strict";

const LONGEST_ADDRESS = 2000;
// The cam angle where the address says none [degrees].
const USUAL_PHI = 30;

// --- what differs between two tasks, by paths; null is what only the first has ------------------------------------------

const isTable = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
// Of a list of tables or of rows each is told by itself, of one of numbers all.
const isRows = (value) => Array.isArray(value) && value.length > 0 && value.every((one) => isTable(one) || Array.isArray(one));

function differences(base, task, path = "", found = {}) {
  for (const key of new Set([...Object.keys(base), ...Object.keys(task)])) {
    const at = path ? `${path}.${key}` : key, [before, now] = [base[key], task[key]];
    if (now === undefined) found[at] = null;
    else if (isTable(now) && isTable(before)) differences(before, now, at, found);
    else if (isRows(now) && isRows(before) && now.length === before.length) {
      now.forEach((row, k) => {
        if (isTable(row) && isTable(before[k])) differences(before[k], row, `${at}[${k}]`, found);
        else if (!alike(row, before[k])) found[`${at}[${k}]`] = row;
      });
    } else if (!alike(now, before)) found[at] = now;
  }
  return found;
}

// --- letters -----------------------------------------------------------------------------------------------------------------

// Base64 as it may stand in an address.
const base64Of = (bytes) => btoa(String.fromCharCode(...bytes)).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const bytesOf = (letters) => Uint8Array.from(atob(letters.replace(/-/g, "+").replace(/_/g, "/")), (letter) => letter.charCodeAt(0));

async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function packed(data) {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(data)), new CompressionStream("deflate-raw"));
  return base64Of(bytes);
}

async function unpacked(letters) {
  return JSON.parse(new TextDecoder().decode(await through(bytesOf(letters), new DecompressionStream("deflate-raw"))));
}

// --- state and address ---------------------------------------------------------------------------------------------------

// By the declaration of what an address says besides the task: [key, name, kind, values that are left out].
function addressOf(config) {
  const base = config.builtin[config.name] ? config.name : Object.keys(config.builtin)[0];
  const isOf = (kind, value) => (kind === "task" || kind === "object" ? isTable(value) : typeof value === kind);

  // In a tour it is the person's own task that is kept.
  async function write({ own, ...shown }) {
    const { task, name, ...state } = { ...shown, ...own };
    const from = config.builtin[name] ? name : base;
    const d = differences(config.builtin[from], task), data = { b: from };
    if (Object.keys(d).length) data.d = d;
    for (const [key, field, kind, usual] of config.address) {
      const value = state[field];
      if (isOf(kind, value) && !usual.includes(value)) data[key] = kind === "task" ? differences(config.builtin[from], value) : value;
    }
    const hash = `#1.${await packed(data)}`;
    return hash.length > LONGEST_ADDRESS ? null : hash;
  }

  // What an address says, or null; unknown keys and what cannot be read are passed over.
  async function read(hash) {
    if (!hash.startsWith("#1.")) return null;
    try {
      const data = await unpacked(hash.slice(3)), from = config.builtin[data.b];
      if (!from) return null;
      const state = { name: data.b, task: withChanges(from, data.d || {}), view: "", mode: "play", pin: null };
      for (const [key, field, kind] of config.address) if (isOf(kind, data[key])) state[field] = kind === "task" ? withChanges(from, data[key]) : data[key];
      return state;
    } catch {
      return null;
    }
  }

  return { write, read };
}
