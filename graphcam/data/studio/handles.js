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

const ALONG_X = "M-15-4l-4 4 4 4M15-4l4 4-4 4", ALONG_Y = "M-4-15l4-4 4 4M-4 15l4 4 4-4";
const WAYS = { x: ALONG_X, y: ALONG_Y, xy: ALONG_X + ALONG_Y, along: ALONG_X, turn: ALONG_X };

function handsOf(at, stage, acts) {
  const { grab, drag, drop, key, type, written, word } = acts;
  // Of a handle with two axes one is a tab stop: that which was used last.
  const stops = new Map();
  let handles = [], held = null;

  // --- a knob -------------------------------------------------------------------------------------------------------

  const current = (id) => handles.find((one) => one.id === id);
  const knobAt = (id) => at("hands").querySelector(`[data-id="${id}"]`);
  const turnOf = ({ along }) => (along ? Math.atan2(along[1], along[0]) * 180 / Math.PI : 0).toFixed(1);

  function sliderOf({ id, axes }, k) {
    const { name, screen, min, max, value } = axes[k];
    // A reader of the screen moves the slider itself.
    const moved = ({ target }) => key(changesOf(current(id).axes[k], Number(target.value)));
    return html`<input type="range" class="unseen" step="any" data-axis=${k} data-key="${id}/${k}" aria-label=${name}
      tabindex=${k === (stops.get(id) ?? 0) ? 0 : -1} aria-orientation=${screen === "y" ? "vertical" : nothing}
      aria-valuetext="${name} ${written(axes[k])}" min=${min} max=${max} .value=${live(String(value))}
      @keydown=${(event) => pressed(event, id, k)} @input=${moved}>`;
  }

  function knobOf(handle) {
    const { id, name, letter, limit, axes, shape } = handle, [x, y] = stage.toScreen(handle.at);
    const isTwo = axes.length > 1;
    const kind = `${letter ? " guess" : ""}${held?.id === id ? " down" : ""}${limit ? " over" : ""}`;
    return html`<div class="hand${kind}" data-id=${id} title=${name} role=${isTwo ? "group" : nothing}
      aria-label=${isTwo ? name : nothing} aria-roledescription=${isTwo ? word("slider_2d") : nothing}
      style="transform: translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)"
      @pointerdown=${down} @dblclick=${() => type(current(id), knobAt(id))}>
      <svg class="knob" viewBox="-22 -22 44 44" aria-hidden="true">
        <circle class="halo" r="15"></circle><circle class="ring" r="8"></circle>
        <path class="ways" d=${WAYS[shape] ?? ""} transform="rotate(${turnOf(handle)})"></path>
        ${letter ? svg`<text class="letter" y="4.5">${letter}</text>` : nothing}</svg>${
      axes.map((_, k) => sliderOf(handle, k))}</div>`;
  }

  function show(found = handles) {
    handles = found;
    render(repeat(handles, ({ id }) => id, knobOf), at("hands"));
    chip();
  }

  // What the held handle is set to, beside it.
  function chip() {
    const handle = held?.moved && current(held.id), label = at("chip");
    label.hidden = !handle;
    if (!handle) return;
    render(letters(handle.axes.map((axis) => `${axis.name} ${written(axis)}`).join(" · ")), label);
    const [x, y] = stage.toScreen(handle.at), half = label.offsetWidth / 2 + 6, wide = at("stage").clientWidth;
    const above = y - (held.touch ? 56 : 30);
    label.style.left = `${Math.max(half, Math.min(wide - half, x))}px`;
    label.style.top = `${above - label.offsetHeight < 4 ? y + label.offsetHeight + 30 : above}px`;
  }

  // --- the hand -----------------------------------------------------------------------------------------------------

  // Of knobs that lie on one another the nearest is meant, not the one on top.
  function nearest({ clientX, clientY }, { left, top }) {
    const far = ({ at: mark }) => {
      const [x, y] = stage.toScreen(mark);
      return Math.hypot(left + x - clientX, top + y - clientY);
    };
    return handles.reduce((found, handle) => (far(handle) < far(found) ? handle : found));
  }

  function down(event) {
    if (event.button || held || !handles.length) return;
    event.preventDefault();
    const box = at("hands").getBoundingClientRect(), handle = nearest(event, box), { id } = handle;
    const [x, y] = stage.toScreen(handle.at);
    if (!grab(handle)) return;
    const knob = knobAt(id);
    held = {
      id, moved: false, touch: event.pointerType === "touch", pointer: event.pointerId,
      from: [event.clientX, event.clientY], off: [box.left + x - event.clientX, box.top + y - event.clientY],
    };
    knob.setPointerCapture(event.pointerId);
    (knob.querySelector("input[tabindex='0']") || knob.querySelector("input")).focus({ preventScroll: true });
    show();
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
    show();
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
    if (event.key === "Enter") return type(handle, knobAt(id));
    const k = axisOfKey(handle.axes, event.key, focused), axis = handle.axes[k];
    const value = valueByKey(axis, event.key, event.shiftKey);
    if (value === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    stops.set(id, k);
    // The next key counts on, also before the engine has answered.
    axis.value = value;
    show();
    knobAt(id).querySelectorAll("input")[k].focus({ preventScroll: true });
    key(changesOf(axis, value));
  }

  stage.onMove(() => show());

  return {
    show, cancel: () => up(null, true), held: () => held, away: (yes) => at("hands").classList.toggle("away", yes),
    ids: () => handles.map((handle) => handle.id),
  };
}

// --- numbers typed at a handle ---------------------------------------------------------------------------------------

// A small form beside the knob, with a field for every size; `done` is given what was typed.
function typeNumbers(form, handle, beside, words, decimal, done) {
  const close = () => {
    form.hidden = true;
    beside.querySelector("input[tabindex='0']")?.focus();
  };
  const fieldOf = ({ name, path, unit, value }) => html`<label><span>${letters(name)}</span>
    <input type="text" inputmode="decimal" value=${shortNumber(value, decimal)} data-path=${path}>
    <span class="unit">${letters(unit)}</span></label>`;
  // What was typed at another knob is gone.
  render(nothing, form);
  render(html`${handle.axes.map(fieldOf)}<button class="main">${words.ok}</button>`, form);
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
