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

// The task in it has been drawn by the engine: what is only wanted, see changing.js, is no state yet.
function stateOf(initial) {
  const state = { ...initial }, watching = [], past = [], future = [];
  let burst = 0;

  function set(changes) {
    const changed = Object.keys(changes).filter((name) => state[name] !== changes[name]);
    if (!changed.length) return;
    Object.assign(state, changes);
    for (const watch of watching) watch(changed);
  }

  const entry = () => ({ task: state.task, name: state.name });
  const travelled = () => {
    for (const watch of watching) watch(["past"]);
  };

  // The entry before a change that is done, if it changed anything; of a burst of keys the first.  `keys` says when the
  // first and the last key came.
  function remember(before, keys = null) {
    if (alike(before.task, state.task)) return;
    const goesOn = keys?.first < burst;
    burst = keys ? keys.last + BURST : 0;
    if (goesOn) return;
    past.push(before);
    if (past.length > REMEMBERED) past.shift();
    future.length = 0;
    travelled();
  }

  function travel(from, to) {
    burst = 0;
    while (from.length && alike(from.at(-1).task, state.task)) from.pop();
    if (!from.length) return travelled();
    to.push(entry());
    set(from.pop());
    travelled();
  }

  // Back to before the burst, if one is going on.
  function escapeBurst() {
    if (performance.now() >= burst || !past.length) return;
    burst = 0;
    set(past.pop());
    travelled();
  }

  return {
    get: () => state, set, entry, remember, escapeBurst,
    subscribe: (watch) => watching.push(watch),
    undo: () => travel(past, future), redo: () => travel(future, past),
    past: () => past.length, future: () => future.length,
  };
}

// --- the queue of questions -----------------------------------------------------------------------------------------------

// One question at a time is with the engine.  Changes are asked one after the other, in their order; of those for the
// picture one waits, and the newest takes its place; what else is asked comes when no picture is due.  Whatever comes
// back, or nothing, is an answer; one to a picture that is older than the newest shown is dropped.
function queueOf(ask, stats = []) {
  const changes = [], others = [];
  let seq = 0, shown = 0, running = null, waiting = null;

  function due() {
    const job = changes.shift() || waiting || others.shift();
    if (job === waiting) waiting = null;
    return job;
  }

  async function answered(job) {
    try {
      const answer = await ask({ ...job.request(), seq: job.seq });
      if (typeof answer?.ok === "boolean") return { ...answer, seq: answer.seq ?? job.seq };
      throw new Error(String(answer?.error?.message || "nothing"));
    } catch (error) {
      return { seq: job.seq, ok: false, lost: true, error: { field: null, message: String(error.message || error), remedy: "" } };
    }
  }

  async function next() {
    const job = running ? null : due();
    if (!job) return;
    if (job.act) {
      job.act();
      return next();
    }
    running = job;
    const began = performance.now(), answer = await answered(job);
    running = null;
    stats.push({ seq: job.seq, ms: performance.now() - began });
    if (stats.length > 500) stats.shift();
    try {
      if (!job.picture || answer.seq >= shown) {
        if (job.picture) shown = answer.seq;
        job.done(answer);
      }
    } finally {
      next();
    }
  }

  // A request is made when its turn comes: it then knows what the page has.
  function picture(request, done) {
    waiting = { request, done, seq: ++seq, picture: true };
    next();
  }

  function put(jobs, job) {
    job.seq = ++seq;
    jobs.push(job);
    next();
    return job;
  }

  return {
    picture, change: (request, done) => put(changes, { request, done, change: true }),
    question: (request) => new Promise((done) => put(others, { request: () => request, done })),
    // What is done when no change is asked about any more.
    after: (act) => (changes.length || running?.change ? changes.push({ act }) : act()),
    isDue: (job) => changes.includes(job),
    busy: () => Boolean(running || waiting || changes.length), waiting: () => (waiting ? 1 : 0),
  };
}
