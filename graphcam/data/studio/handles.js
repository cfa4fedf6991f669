// Handles: knobs in pixels over the drawing, each with a slider for every size that it moves.
"use strict";

// A pointer that moved less was a click [pixels].
const STILL = 3;

// The arrows by the axis of the screen along which they move.
const ARROWS = { ArrowRight: ["x", 1], ArrowLeft: ["x", -1], ArrowUp: ["y", 1], ArrowDown: ["y", -1] };

// The next value by a key, within the ends; undefined for keys that move nothing.
function valueByKey(axis, key, fine) {
  const { value, min, max, step, coarse, sign = 1, up = sign } = axis;
  const by = fine ? axis.fine ?? step / 5 : step;
  const next = {
    ArrowRight: value + sign * by, ArrowUp: value + up * by, ArrowLeft: value - sign * by, ArrowDown: value - up * by,
    PageUp: value + (coarse ?? 5 * step), PageDown: value - (coarse ?? 5 * step), Home: min, End: max,
  }[key];
  if (next === undefined) return undefined;
  const inside = Math.max(min, Math.min(max, key === "Home" || key === "End" ? next : Math.round(next / by) * by));
  return Math.round(inside * 1e9) / 1e9;
}

const tidy = (value) => Math.round(value * 1e12) / 1e12;

// What is changed with a size: what must stand in the task before, what is the rest of a sum, and what goes with it: such
// a part of it, beyond something that stays.
const changesOf = ({ path, first, sum, with: shares = {}, beyond = {} }, value) => ({
  ...first, [path]: value, ...(sum ? { [sum.path]: Math.round((sum.total - value) * 1e9) / 1e9 } : {}),
  ...Object.fromEntries(Object.entries(shares).map(([other, share]) => [other, tidy((beyond[other] ?? 0) + value * share)])),
});

// The axis that an arrow moves: of two, the one that goes its way on the screen.
function axisOfKey(axes, key, focused) {
  const way = ARROWS[key]?.[0];
  const found = way ? axes.findIndex((axis) => axis.screen === way) : -1;
  return axes.length > 1 && found >= 0 ? found : focused;
}

function handsOf(at, stage, acts) {
  const { grab, drag, drop, key, type, written, word } = acts;
  const knobs = new Map();
  let handles = [], held = null;

  // --- a knob -------------------------------------------------------------------------------------------------------

  const WAYS = { x: "M-15-4l-4 4 4 4M15-4l4 4-4 4", y: "M-4-15l4-4 4 4M-4 15l4 4 4-4" };
  const waysOf = (handle) =>
    ({ x: WAYS.x, y: WAYS.y, xy: WAYS.x + WAYS.y, along: WAYS.x, turn: WAYS.x })[handle.shape] || "";
  const turnOf = (handle) =>
    (handle.along ? Math.atan2(handle.along[1], handle.along[0]) * 180 / Math.PI : 0);

  function sliderOf(handle, k) {
    const input = make("input", {
      type: "range", class: "unseen", step: "any", "data-axis": k, "data-key": `${handle.id}/${k}`,
      tabindex: k ? -1 : 0, "aria-label": handle.axes[k].name,
      "aria-orientation": handle.axes[k].screen === "y" ? "vertical" : null,
    });
    input.addEventListener("keydown", (event) => pressed(event, handle.id, k));
    // A reader of the screen moves the slider itself.
    input.addEventListener("input", () => key(changesOf(current(handle.id).axes[k], Number(input.value))));
    return input;
  }

  function knobOf(handle) {
    const two = handle.axes.length > 1;
    const knob = make("div", {
      class: handle.letter ? "hand guess" : "hand", "data-id": handle.id, title: handle.name, role: two ? "group" : null, "aria-label": two ? handle.name : null,
      "aria-roledescription": two ? word("slider_2d") : null,
    });
    const picture = drawSvg("svg", "knob", { viewBox: "-22 -22 44 44", "aria-hidden": "true" }, knob);
    drawSvg("circle", "halo", { r: 15 }, picture);
    drawSvg("circle", "ring", { r: 8 }, picture);
    drawSvg("path", "ways", {}, picture);
    if (handle.letter) drawSvg("text", "letter", { y: 4.5 }, picture).textContent = handle.letter;
    knob.append(...handle.axes.map((_, k) => sliderOf(handle, k)));
    knob.addEventListener("pointerdown", (event) => down(event, handle.id));
    knob.addEventListener("dblclick", () => type(current(handle.id), knob));
    at("hands").append(knob);
    return knob;
  }

  const current = (id) => handles.find((one) => one.id === id);
  const shapeOf = (handle) => JSON.stringify([handle.axes.map((axis) => axis.path), handle.name, handle.letter]);

  function place(handle, [x, y] = stage.toScreen(handle.at)) {
    const knob = knobs.get(handle.id);
    knob.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    const ways = knob.querySelector(".ways");
    ways.setAttribute("d", waysOf(handle));
    ways.setAttribute("transform", `rotate(${turnOf(handle).toFixed(1)})`);
    knob.classList.toggle("down", held?.id === handle.id);
    knob.classList.toggle("over", Boolean(handle.limit));
    handle.axes.forEach((axis, k) => {
      const input = knob.querySelectorAll("input")[k];
      Object.assign(input, { min: axis.min, max: axis.max, value: axis.value });
      input.setAttribute("aria-valuetext", `${axis.name} ${written(axis)}`);
    });
  }

  function show(found) {
    handles = found;
    const kept = new Map(found.map((handle) => [handle.id, shapeOf(handle)]));
    for (const [id, knob] of knobs) {
      if (kept.get(id) === knob.shape) continue;
      knob.remove();
      knobs.delete(id);
    }
    for (const handle of found) {
      if (knobs.has(handle.id)) continue;
      knobs.set(handle.id, knobOf(handle));
      knobs.get(handle.id).shape = shapeOf(handle);
    }
    placeAll();
  }

  // All places are reckoned before one is written: each writing lets the browser lay out the page anew for the next.
  function placeAll() {
    const there = handles.filter(({ id }) => knobs.has(id)), places = there.map(({ at: mark }) => stage.toScreen(mark));
    there.forEach((handle, k) => place(handle, places[k]));
    chip();
  }

  // What the held handle is set to, beside it.
  function chip() {
    const handle = held?.moved && current(held.id), label = at("chip");
    label.hidden = !handle;
    if (!handle) return;
    lettered(label, handle.axes.map((axis) => `${axis.name} ${written(axis)}`).join(" · "));
    const [x, y] = stage.toScreen(handle.at), half = label.offsetWidth / 2 + 6, wide = at("stage").clientWidth;
    const above = y - (held.touch ? 56 : 30);
    label.style.left = `${Math.max(half, Math.min(wide - half, x))}px`;
    label.style.top = `${above - label.offsetHeight < 4 ? y + label.offsetHeight + 30 : above}px`;
  }

  // --- the hand -----------------------------------------------------------------------------------------------------

  function down(event, id) {
    const handle = current(id);
    if (event.button || held || !handle) return;
    event.preventDefault();
    const [x, y] = stage.toScreen(handle.at), box = at("hands").getBoundingClientRect();
    if (!grab(handle)) return;
    const knob = knobs.get(id);
    held = {
      id, moved: false, touch: event.pointerType === "touch", pointer: event.pointerId,
      from: [event.clientX, event.clientY], off: [box.left + x - event.clientX, box.top + y - event.clientY],
    };
    knob.setPointerCapture(event.pointerId);
    (knob.querySelector("input[tabindex='0']") || knob.querySelector("input")).focus({ preventScroll: true });
    place(handle);
  }

  function move(event) {
    if (!held || event.pointerId !== held.pointer) return;
    const far = Math.hypot(event.clientX - held.from[0], event.clientY - held.from[1]);
    if (!held.moved && far < STILL) return;
    held.moved = true;
    const to = stage.toDrawing(event.clientX + held.off[0], event.clientY + held.off[1]);
    drag({ handle: held.id, to: to.map((mm) => Math.round(mm * 1000) / 1000), fine: event.shiftKey });
  }

  function up(event, cancelled = false) {
    if (!held || (event && event.pointerId !== held.pointer)) return;
    const { id, moved } = held;
    held = null;
    knobs.get(id)?.classList.remove("down");
    chip();
    drop(cancelled || !moved, id);
  }

  at("hands").addEventListener("pointermove", move);
  // Anywhere: a knob that is drawn anew while it is held has lost the pointer.
  addEventListener("pointerup", (event) => up(event));
  addEventListener("pointercancel", (event) => up(event, true));

  // --- keys ---------------------------------------------------------------------------------------------------------

  function pressed(event, id, focused) {
    const handle = current(id);
    if (!handle || held || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Enter") return type(handle, knobs.get(id));
    const k = axisOfKey(handle.axes, event.key, focused), axis = handle.axes[k];
    const value = valueByKey(axis, event.key, event.shiftKey);
    if (value === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    focusAxis(knobs.get(id), k);
    // The next key counts on, also before the engine has answered.
    axis.value = value;
    key(changesOf(axis, value));
  }

  // One tab stop for all axes: that which was used last.
  function focusAxis(knob, k) {
    knob.querySelectorAll("input").forEach((input, j) => (input.tabIndex = j === k ? 0 : -1));
    knob.querySelectorAll("input")[k].focus({ preventScroll: true });
  }

  stage.onMove(placeAll);

  return {
    show, cancel: () => up(null, true), held: () => held, away: (yes) => at("hands").classList.toggle("away", yes),
    ids: () => handles.map((handle) => handle.id),
  };
}

// --- numbers typed at a handle ---------------------------------------------------------------------------------------

// A small form beside the knob, with a field for every size; `done` is given what was typed.
function typeNumbers(form, handle, beside, words, decimal, done) {
  const fields = handle.axes.map((axis) => {
    const input = make("input", { type: "text", inputmode: "decimal", value: shortNumber(axis.value, decimal), "data-path": axis.path });
    return make("label", {}, lettered(make("span"), axis.name), input, make("span", { class: "unit", text: axis.unit }));
  });
  const close = () => {
    form.hidden = true;
    beside.querySelector("input[tabindex='0']")?.focus();
  };
  form.replaceChildren(...fields, make("button", { class: "main", text: words.ok }));
  form.hidden = false;
  const [x, y] = beside.style.transform.match(/-?[\d.]+(?=px)/g).map(Number), room = form.parentElement;
  form.style.left = `${Math.max(8, Math.min(room.clientWidth - form.offsetWidth - 8, x - form.offsetWidth / 2))}px`;
  form.style.top = `${Math.max(8, Math.min(room.clientHeight - form.offsetHeight - 8, y + 26))}px`;
  form.onsubmit = (event) => {
    event.preventDefault();
    const inputs = [...form.querySelectorAll("input")];
    const wrong = inputs.find((input) => Number.isNaN(typedNumber(input.value)));
    for (const input of inputs) input.toggleAttribute("aria-invalid", input === wrong);
    if (wrong) return wrong.focus();
    close();
    const typed = handle.axes.map((axis, k) => [axis, typedNumber(inputs[k].value)]).filter(([axis, value]) => value !== axis.value);
    done(Object.assign({}, ...typed.map(([axis, value]) => changesOf(axis, value))));
  };
  form.onkeydown = (event) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    close();
  };
  form.onfocusout = (event) => form.contains(event.relatedTarget) || (form.hidden = true);
  form.querySelector("input").select();
}
