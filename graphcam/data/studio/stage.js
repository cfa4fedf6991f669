// A stage: the steps of a view as groups of SVG, the frame through which they are seen, millimetres and pixels.
"use strict";

// How long the frame glides to another one [ms]; what fills less of it than this is looked at more closely.
const GLIDE = 300, TOO_SMALL = 0.6;

// Of several views one under another so many are looked at, from the top, as are seen no smaller than this [pixels for a
// millimetre].
const LEGIBLE = 0.7;

// How many times as large as all of it a detail may be seen.
const CLOSEST = 20;

// --- the groups of a view's steps ------------------------------------------------------------------------------------------

// What each view looked like when it was drawn last: its steps by their ids, to which answers bring only what is new.
function galleryOf() {
  const views = new Map();

  function take(answer, told) {
    const before = views.get(answer.name), steps = {};
    for (const id of answer.order) {
      const old = before?.steps[id], now = answer.steps[id] || {};
      // While a size is moved nothing is told: the words stay those of before.
      steps[id] = { ...old, ...now, svg: now.svg ?? old?.svg ?? "", parts: (told && now.parts) || old?.parts || [] };
    }
    const view = { ...before, ...answer, steps };
    views.set(answer.name, view);
    return view;
  }

  const have = (name) =>
    Object.fromEntries(Object.entries(views.get(name)?.steps || {}).map(([id, step]) => [id, step.hash]));

  return { take, have, view: (name) => views.get(name), forget: () => views.clear() };
}

// The groups of the steps in `parent`; only those are made anew that changed.
function fillSteps(parent, view, wanted = () => true) {
  const old = new Map([...parent.children].map((group) => [group.dataset.group, group]));
  let changed = 0;
  const groups = view.order.filter(wanted).map((id) => {
    const step = view.steps[id];
    const group = old.get(id) || drawSvg("g", "step", { "data-group": id }, parent);
    group.before = group.shown;
    // A hand may have moved what was drawn.
    if (group.shown !== step.svg || group.isMoved) {
      // The engine's own drawing: it escapes what a user wrote.
      group.innerHTML = step.svg;
      Object.assign(group, { shown: step.svg, isMoved: false });
      changed += 1;
    }
    if (group.down !== step.down) group.setAttribute("transform", `translate(0 ${group.down = step.down})`);
    old.delete(id);
    return group;
  });
  for (const group of old.values()) group.remove();
  const inOrder = groups.every((group, k) => parent.children[k] === group);
  if (!inOrder) parent.replaceChildren(...groups);
  return changed + old.size;
}

// --- several views as one, one under another ---------------------------------------------------------------------------------

const GAP = 7;

// How far down each stands [mm], and a frame about all.
function stackOf(views) {
  const left = Math.min(...views.map(({ frame }) => frame[0])), right = Math.max(...views.map(({ frame }) => frame[0] + frame[2]));
  const top = views[0].frame[1], order = [], steps = {}, down = {}, ends = [];
  let end = top - GAP;
  for (const { name, frame, ...view } of views) {
    down[name] = end + GAP - frame[1];
    end = down[name] + frame[1] + frame[3];
    ends.push(end + GAP);
    for (const id of view.order) {
      order.push(`${name}/${id}`);
      steps[`${name}/${id}`] = { ...view.steps[id], down: down[name] };
    }
  }
  const name = views.map((view) => view.name).join("+"), title = views.map((view) => view.title).join("; ");
  return { name, title, views, order, steps, down, ends, frame: [left, top, right - left, end - top] };
}

// The lines for which a view was drawn, as points; y downwards.
function curvesOf(view) {
  const paths = view.order.flatMap((id) => [...view.steps[id].svg.matchAll(/class="line result"[^>]* d="([^"]*)"/g)]);
  return paths.flatMap(([, path]) => path.split("M").slice(1).map((part) => part.split("L").map((point) => point.split(" ").map(Number))));
}

// How high they are over a place of a common axis; the later ones are drawn over the earlier ones.
function heightAt(curves, x) {
  for (const points of curves.toReversed()) {
    const k = points.findIndex(([end], j) => j && points[j - 1][0] <= x && x <= end && points[j - 1][0] < end);
    if (k < 0) continue;
    const [[x1, y1], [x2, y2]] = [points[k - 1], points[k]];
    return y1 + (y2 - y1) * (x - x1) / (x2 - x1);
  }
  return 0;
}

const WHOLE = { caption: "", tools: [], draws: [], lit: [], moves: [] };

// What the player's board wants to know of the steps.
const boardSteps = (view) => view.order.map((id) => {
  const { parts } = view.steps[id];
  return { group: id, view: view.name, parts: parts.length ? parts : [WHOLE] };
});

// --- frames ---------------------------------------------------------------------------------------------------------------------

const inside = ([left, top, wide, high], [x, y, w, h], by = 1.5) =>
  left >= x - by && top >= y - by && left + wide <= x + w + by && top + high <= y + h + by;

// Whether a frame must change to show another one: it leaves it, or would be small in it.
const mustMove = (shown, wanted) =>
  !inside(wanted, shown) || Math.max(wanted[2] / shown[2], wanted[3] / shown[3]) < TOO_SMALL;

function stageOf(at) {
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const frames = new Map(), wholes = new Map(), firsts = new Map(), details = new Set(), watching = [];
  let shown = null, filled = null, board = null, gliding = 0, several = 1, kept = null;

  const svg = () => (shown === "mechanism" ? at("scene") : at("drawing"));
  // To ask lays the page out; while a hand is down the size stays.
  const measured = () => {
    const { clientWidth, clientHeight, offsetLeft, offsetTop, clientLeft, clientTop } = at("canvas");
    return { size: [clientWidth || 1, clientHeight || 1], inset: [offsetLeft + clientLeft, offsetTop + clientTop] };
  };
  const size = () => (kept || measured()).size;

  // Pixels for a millimetre, and where the upper left corner of the frame stands.
  function fit(frame = frames.get(shown)) {
    if (!frame) return { scale: 1, left: 0, top: 0 };
    const [wide, high] = size(), [x, y, w, h] = frame, scale = Math.min(wide / w, high / h);
    return { scale, left: (wide - scale * w) / 2 - scale * x, top: (high - scale * h) / 2 - scale * y };
  }

  function toScreen([x, y]) {
    const { scale, left, top } = fit(), [dx, dy] = (kept || measured()).inset;
    return [left + scale * x + dx, top + scale * y + dy];
  }
  function toDrawing(clientX, clientY) {
    const box = at("canvas").getBoundingClientRect(), { scale, left, top } = fit();
    return [(clientX - box.left - at("canvas").clientLeft - left) / scale, (clientY - box.top - at("canvas").clientTop - top) / scale];
  }

  function setFrame(frame) {
    frames.set(shown, frame);
    at("stage").classList.toggle("detailed", details.has(shown));
    svg().setAttribute("viewBox", frame.join(" "));
    // Nothing is drawn thinner than can be seen.
    const { scale } = fit(frame), [wide, high] = size(), letter = Math.max(12, Math.min(24, wide / 36, high / (8 + 12 * several)));
    svg().style.setProperty("--pixel", `${1 / scale}px`);
    svg().style.setProperty("--letter", `${letter / scale}px`);
    for (const moved of watching) moved();
  }

  function stopGliding() {
    cancelAnimationFrame(gliding);
    gliding = 0;
  }

  function glideTo(frame) {
    const from = frames.get(shown), name = shown, start = performance.now();
    stopGliding();
    if (!from || calm.matches) return setFrame(frame);
    const tick = (now) => {
      if (shown !== name) return stopGliding();
      const part = Math.min(1, Math.max(0, (now - start) / GLIDE)), eased = 1 - (1 - part) ** 3;
      setFrame(from.map((x, k) => x + (frame[k] - x) * eased));
      gliding = part < 1 ? requestAnimationFrame(tick) : 0;
    };
    gliding = requestAnimationFrame(tick);
  }

  // --- a detail: a part of a view, chosen by hand, that stays until all of it is looked at again ---------------------------

  function zoomAbout(factor, { x, y }) {
    const [left, top, wide, high] = frames.get(shown), whole = fit(wholes.get(shown)).scale, { scale } = fit();
    const by = Math.min(factor, CLOSEST * whole / scale);
    stopGliding();
    if (factor > 1) details.add(shown);
    if (factor < 1 && scale * by <= whole) {
      if (details.delete(shown)) setFrame(wholes.get(shown));
    } else setFrame([x - (x - left) / by, y - (y - top) / by, wide / by, high / by]);
  }

  function zoomFromMiddle(factor) {
    const [x, y, w, h] = frames.get(shown);
    zoomAbout(factor, { x: x + w / 2, y: y + h / 2 });
  }

  // Its middle stays over the drawing.
  function shift(by) {
    if (!details.has(shown)) return;
    const [x, y, w, h] = frames.get(shown), [left, top, wide, high] = wholes.get(shown);
    const within = (middle, from, length) => Math.max(from, Math.min(from + length, middle));
    setFrame([within(x - by.x + w / 2, left, wide) - w / 2, within(y - by.y + h / 2, top, high) - h / 2, w, h]);
  }

  // What is seen first of a picture: all of it, or of several views the first ones, none of them cut.
  function firstOf({ frame, ends = [] }) {
    const [wide, high] = size(), [x, y, w] = frame, least = Math.min(LEGIBLE, wide / w);
    const end = ends.findLast((bottom) => high / (bottom - y) >= least) ?? ends[0];
    return ends.length ? [x, y, w, end - y] : frame;
  }

  // A view through its frame, which stays while a hand is down, and else as long as it serves.
  function look(picture, { held = false, anew = false } = {}) {
    const { name, frame: wanted, ends } = picture, other = shown !== name;
    kept = held ? kept || measured() : null;
    shown = name;
    several = ends?.length || 1;
    wholes.set(name, wanted);
    // What is seen first is found again for other views or another size of the window, until the hand has moved it.
    const isFirst = details.has(name) && !held && frames.get(name) === firsts.get(name);
    if (anew || isFirst) details.delete(name);
    at("drawing").toggleAttribute("hidden", name === "mechanism");
    at("scene").toggleAttribute("hidden", name !== "mechanism");
    const frame = isFirst ? undefined : frames.get(name), first = firstOf(picture);
    if (!frame && !alike(first, wanted)) {
      details.add(name);
      firsts.set(name, first);
      setFrame(first);
    } else if (details.has(name)) setFrame(frame);
    else if (!frame || (other && !held && mustMove(frame, wanted))) setFrame(wanted);
    else if (anew || (!held && mustMove(frame, wanted))) glideTo(wanted);
    else setFrame(frame);
  }

  function fill(view, title, step) {
    at("drawing-title").textContent = title;
    at("drawing-step").textContent = step;
    if (view === filled) return;
    filled = view;
    fillSteps(at("steps"), view);
    // What stays of the former picture bears no marks of it.
    for (const piece of at("steps").querySelectorAll(":is(.later, .done, .now, .lit)")) piece.classList.remove("later", "done", "now", "lit");
    board = boardOf(at("steps"), boardSteps(view));
  }

  // The pinned cam behind: only its curves and results, and only of steps that differ from the present ones.
  function pin(view, present) {
    fillSteps(at("pinned"), view || { order: [], steps: {} }, (id) => view.steps[id].svg !== present?.steps[id]?.svg);
  }

  const lookAnew = () => look({ name: shown, frame: wholes.get(shown) }, { anew: true });
  const resized = () => {
    kept = null;
    if (frames.get(shown)) setFrame(frames.get(shown));
  };

  return {
    size, look, lookAnew, fill, pin, toScreen, toDrawing, resized, zoomAbout, zoomFromMiddle, shift,
    show: (current, part) => board?.show(current, part),
    point: (names) => board?.point(names),
    onMove: (moved) => watching.push(moved),
    scale: (picture) => fit(firstOf(picture)).scale,
    frame: () => frames.get(shown),
    whole: () => wholes.get(shown),
    isStill: () => !gliding,
    forget() {
      frames.clear();
      details.clear();
    },
    layers: { drawing: at("drawing"), scene: at("scene"), cursors: at("cursors") },
  };
}
