// The wire to the engine, which is a server's, a worker's or that of the page around this one: {ready, ask, write}.
"use strict";

function openWire(config, told = () => {}) {
  return { server: wireToServer, worker: wireToWorker, parent: wireToParent }[config.transport](config, told);
}

// What is sent with a number, and what is answered to it.
function lettersOf() {
  const waiting = new Map();
  let last = 0;
  return {
    send: (put) => new Promise((done, failed) => {
      waiting.set(++last, { done, failed });
      put(last);
    }),
    arrived(id, answer) {
      waiting.get(id)?.done(answer);
      waiting.delete(id);
    },
    lost(error) {
      for (const { failed } of waiting.values()) failed(error);
      waiting.clear();
    },
  };
}

// --- a server on this machine --------------------------------------------------------------------------------------

// The token stands in the address that was opened, and is taken out of it; what follows it is the state of the page.
function tokenOfServer() {
  const found = /^#t=([^&]*)&?(.*)$/s.exec(location.hash);
  if (found) {
    // Of a server of its own each: other tabs of this browser may know it, for a link is opened in one.
    localStorage.setItem("token", found[1]);
    history.replaceState(null, "", found[2] ? `#${found[2]}` : location.pathname + location.search);
  }
  return localStorage.getItem("token") || "";
}

// A server that has not answered for so long will not [ms]; it gives up its engine sooner.
const PATIENCE = 15000;

function wireToServer() {
  const headers = { "Authorization": `Bearer ${tokenOfServer()}`, "Content-Type": "application/json" };
  const post = (to, body, more = {}) =>
    fetch(to, { method: "POST", headers, body: JSON.stringify(body), cache: "no-store", ...more });

  async function read(to, body, more) {
    const answer = await post(to, body, more);
    if (!answer.ok && answer.headers.get("Content-Type") !== "application/json") throw new Error(`${answer.status}`);
    const said = await answer.json();
    if (answer.status === 401) throw new Error(said.error.message);
    return said;
  }
  const tab = crypto.randomUUID();
  const alive = (to) => post(to, tab, { keepalive: true }).catch(() => {});
  const living = () => alive("/alive");
  setInterval(living, 3000);
  // It comes again out of the browser's memory too.
  addEventListener("pageshow", living);
  addEventListener("pagehide", () => alive("/alive?end"));
  return {
    ready: Promise.resolve(),
    ask: (request) => read("/engine", request, { signal: AbortSignal.timeout(PATIENCE) }),
    write: (kind, task, replace) => read("/write", { kind, task, replace }),
  };
}

// --- a worker --------------------------------------------------------------------------------------------------------

function wireToWorker(config, told) {
  const letters = lettersOf();
  // A page in one file makes the worker from what it carries.
  const worker = window.startEngine ? window.startEngine(config) : new Worker(config.worker || "worker.js");
  const ready = new Promise((done, failed) => {
    worker.addEventListener("message", ({ data }) => {
      if (data.ready) done();
      else if (data.state) told(data.state);
      else letters.arrived(data.id, data.response);
    });
    worker.addEventListener("error", (event) => {
      const error = new Error(event.message);
      failed(error);
      letters.lost(error);
    });
  });
  return {
    ready,
    ask: async (request) => {
      await ready;
      return letters.send((id) => worker.postMessage({ id, request }));
    },
    write: unwritten,
  };
}

// --- the page around this one ----------------------------------------------------------------------------------------

function wireToParent(config) {
  const letters = lettersOf(), studio = config.id;
  addEventListener("message", ({ source, data }) => {
    if (source === window.parent && data?.studio === studio && data.response) letters.arrived(data.id, data.response);
  });
  const post = (body) => window.parent.postMessage({ studio, ...body }, "*");
  return {
    ready: Promise.resolve(),
    ask: (request) => letters.send((id) => post({ id, request })),
    write: unwritten,
    // What the page around this one is told without being asked, and tells.
    tell: (state) => post({ state }),
    hear(heard) {
      addEventListener("message", ({ source, data }) => {
        if (source === window.parent && data?.studio === studio && data.state) heard(data.state);
      });
      // It is told that somebody hears.
      post({ state: {} });
    },
  };
}

const unwritten = () => Promise.reject(new Error("nothing can be written from here"));
