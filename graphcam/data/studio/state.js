// What the page shows, what it showed before, and the queue of what the engine is asked.
"use strict";

// --- a task and the paths into it: "motion.phases[0].angle" ----------------------------------------------------------

const keysOf = (path) => path.split(/[.[\]]+/).filter(Boolean).map((key) => (/^\d+$/.test(key) ? Number(key) : key));

const valueAt = (task, path) => keysOf(path).reduce((inside, key) => inside?.[key], task);

// A copy with values in those places; null leaves a size open.
function withChanges(task, changes) {
  const copy = structuredClone(task);
  for (const [path, value] of Object.entries(changes)) {
    const keys = keysOf(path), last = keys.pop();
    const inside = keys.reduce((table, key) => (table[key] ??= {}), copy);
    if (value === null) delete inside[last];
    else inside[last] = structuredClone(value);
  }
  return copy;
}

const alike = (a, b) => JSON.stringify(a) === JSON.stringify(b);

// --- the state ---------------------------------------------------------------------------------------------------------

// So many tasks are remembered; keys in so quick a row are one change [ms].
const REMEMBERED = 200, BURST = 500;

function stateOf(initial) {
  const state = { ...initial }, watching = [], past = [], future = [], wrong = new Set();
  let burst = null;

  function set(changes) {
    const changed = Object.keys(changes).filter((name) => state[name] !== changes[name]);
    if (!changed.length) return;
    Object.assign(state, changes);
    for (const watch of watching) watch(changed);
  }

  // The task before a change that is done: one entry, if it changed anything.
  function remember(before) {
    if (alike(before, state.task)) return;
    past.push(before);
    if (past.length > REMEMBERED) past.shift();
    future.length = 0;
    for (const watch of watching) watch(["past"]);
  }

  // Keys come in bursts: the task before the first of them is remembered.
  function changeByKey(changes) {
    const before = burst?.before || state.task;
    clearTimeout(burst?.timer);
    burst = { before, timer: setTimeout(endBurst, BURST) };
    set({ task: withChanges(state.task, changes) });
  }

  function endBurst() {
    if (!burst) return;
    const { before, timer } = burst;
    clearTimeout(timer);
    burst = null;
    remember(before);
  }

  // Back to before the burst, if one is going on.
  function escapeBurst() {
    if (!burst) return false;
    clearTimeout(burst.timer);
    set({ task: burst.before });
    burst = null;
    return true;
  }

  function change(changes) {
    endBurst();
    const before = state.task;
    set({ task: withChanges(before, changes) });
    remember(before);
  }

  // What the engine refused is no place to come back to.
  function travel(from, to) {
    endBurst();
    while (from.length && wrong.has(JSON.stringify(from.at(-1)))) from.pop();
    if (!from.length) return;
    if (!wrong.has(JSON.stringify(state.task))) to.push(state.task);
    const task = from.pop();
    set({ task });
    for (const watch of watching) watch(["past"]);
  }

  return {
    get: () => state, set, change, changeByKey, endBurst, escapeBurst, remember,
    subscribe: (watch) => watching.push(watch),
    refuse: (task) => wrong.add(JSON.stringify(task)),
    undo: () => travel(past, future), redo: () => travel(future, past),
    past: () => past.length + (burst ? 1 : 0), future: () => future.length,
  };
}

// --- the queue of questions -----------------------------------------------------------------------------------------------

// One question at a time is with the engine.  Of those for the picture one waits, and the newest takes its place; what
// else is asked comes when no picture is due.  An answer older than the newest shown is dropped.
function queueOf(ask, stats = []) {
  const others = [];
  let seq = 0, shown = 0, running = false, waiting = null;

  async function next() {
    const job = running ? null : waiting || others.shift();
    if (!job) return;
    if (job === waiting) waiting = null;
    running = true;
    const began = performance.now();
    let answer;
    try {
      answer = await ask({ ...job.request(), seq: job.seq });
    } catch (error) {
      answer = { seq: job.seq, ok: false, lost: true, error: { field: null, message: String(error.message || error), remedy: "" } };
    }
    running = false;
    stats.push({ seq: job.seq, ms: performance.now() - began });
    if (stats.length > 500) stats.shift();
    if (!job.picture) job.done(answer);
    else if (answer.seq >= shown) {
      shown = answer.seq;
      job.done(answer);
    }
    next();
  }

  // A request is made when its turn comes: it then knows what the page has.
  function picture(request, done) {
    waiting = { request, done, seq: ++seq, picture: true };
    next();
  }

  const question = (request) => new Promise((done) => {
    others.push({ request: () => request, done, seq: ++seq });
    next();
  });

  return { picture, question, busy: () => running || Boolean(waiting), waiting: () => (waiting ? 1 : 0) };
}
