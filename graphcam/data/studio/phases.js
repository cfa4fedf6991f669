// The bar of phases: borders that are dragged, phases that are added and taken away, and the fields of the chosen one.
"use strict";

// A border is drawn to whole steps of five degrees from so near [degrees].
const MAGNET = 0.7;

// What becomes of two neighbours when the border after phase k is moved to so many degrees from the start.
function borderChanges(phases, k, degrees, fine = false) {
  const start = phases.slice(0, k).reduce((sum, phase) => sum + phase.angle, 0), sum = phases[k].angle + phases[k + 1].angle;
  const five = 5 * Math.round(degrees / 5), step = fine ? 0.1 : 1;
  const near = !fine && Math.abs(five - degrees) < MAGNET ? five : Math.round(degrees / step) * step;
  const path = `motion.phases[${k}].angle`, other = { path: `motion.phases[${k + 1}].angle`, total: sum };
  return changesOf({ path, sum: other }, Math.max(1, Math.min(sum - 1, Math.round((near - start) * 1e6) / 1e6)));
}

// `showFields` makes the rows of the fields of a phase, or brings them up to date.
function phasesOf({ change, slide, showFields, isRefused, word, decimal }) {
  const bar = make("div", { class: "phase-bar" });
  const editor = make("div", { class: "phase-editor" });
  const error = make("p", { class: "error", id: "phases-error", role: "alert", hidden: true });
  const element = make("div", { class: "size phases", role: "group", "aria-label": word("phases") }, bar, editor, error);
  const row = { element, error, input: null };
  let field = null, phases = [], chosen = null, built = "";

  const total = () => phases.reduce((sum, phase) => sum + phase.angle, 0) || 360;
  const start = (k) => phases.slice(0, k).reduce((sum, phase) => sum + phase.angle, 0);

  // The phases to which something is done: what was refused is none of them.
  const standing = () => (isRefused() ? field.phases : phases);

  // --- the bar ------------------------------------------------------------------------------------------------------------

  function segmentOf(phase, k) {
    return make("button", {
      type: "button", class: phase.kind === "dwell" ? "dwell" : "moves", "data-key": `phase/${k}`, "aria-pressed": String(k === chosen),
      onclick: () => { chosen = chosen === k ? null : k; show(field); },
    }, make("b"), make("span", { text: phase.name }));
  }

  function borderOf(k) {
    const input = make("input", {
      type: "range", class: "unseen", step: "any", "data-key": `border/${k}`,
      "aria-label": `${word("border")} ${phases[k].symbol} ${phases[k + 1].symbol}`,
    });
    input.addEventListener("keydown", (event) => {
      const axis = { value: start(k + 1), min: start(k) + 1, max: start(k + 2) - 1, step: 1, fine: 0.1, coarse: 5 };
      const value = valueByKey(axis, event.key, event.shiftKey);
      if (value === undefined) return;
      event.preventDefault();
      change(borderChanges(standing(), k, value, event.shiftKey), true);
    });
    input.addEventListener("input", () => change(borderChanges(standing(), k, Number(input.value)), true));
    const border = make("div", { class: "border", "data-border": k }, input);
    border.addEventListener("pointerdown", (event) => drag(event, border, k));
    return border;
  }

  function drag(event, border, k) {
    if (event.button) return;
    event.preventDefault();
    const box = bar.getBoundingClientRect(), turn = total(), before = standing();
    border.setPointerCapture(event.pointerId);
    border.firstChild.focus({ preventScroll: true });
    const move = (now) => slide(borderChanges(before, k, (now.clientX - box.left) / box.width * turn, now.shiftKey));
    border.addEventListener("pointermove", move);
    border.addEventListener("lostpointercapture", () => border.removeEventListener("pointermove", move), { once: true });
  }

  function place() {
    const turn = total();
    bar.querySelectorAll("button").forEach((segment, k) => {
      const { angle, symbol, name } = phases[k], said = `${shortNumber(angle, decimal())}°`, wide = angle / turn * (bar.clientWidth || 240);
      segment.style.flexGrow = angle;
      segment.classList.toggle("narrow", isTight(name, wide));
      segment.classList.toggle("tiny", isTight(`${angle}°`, wide));
      segment.firstChild.textContent = said;
      segment.setAttribute("aria-label", `${symbol} ${name} ${said}`);
    });
    bar.querySelectorAll(".border").forEach((border, k) => {
      border.style.left = `${100 * start(k + 1) / turn}%`;
      Object.assign(border.firstChild, { min: start(k) + 1, max: start(k + 2) - 1, value: start(k + 1) });
      border.firstChild.setAttribute("aria-valuetext", `${shortNumber(start(k + 1), decimal())}°`);
    });
  }

  // --- the phase that is chosen ---------------------------------------------------------------------------------------------

  function headAndEdits({ symbol, name, edits }) {
    const edit = (what) => edits[what] && make("button", {
      type: "button", "data-key": `edit-${what}`, text: word(`phase_${what}`), onclick: () => change({ "motion.phases": field.phases[chosen].edits[what] }),
    });
    return [make("p", { class: "label", text: `${symbol} ${name}` }), make("div", { class: "rows" }, edit("dwell"), edit("step"), edit("remove"))];
  }

  function show(now) {
    field = now;
    phases = now.phases;
    if (chosen !== null) chosen = Math.min(chosen, phases.length - 1);
    const own = phases[chosen], shape = JSON.stringify([chosen, phases.map(({ name, symbol }) => [name, symbol]), Object.keys(own?.edits || {}).filter((what) => own.edits[what])]);
    const same = shape === built;
    built = shape;
    keepingFocus(element, () => {
      if (!same) {
        bar.replaceChildren(...phases.map(segmentOf), ...phases.slice(1).map((_, k) => borderOf(k)));
        editor.classList.toggle("hint", !own);
        editor.replaceChildren(...(own ? headAndEdits(own) : [word("choose_a_phase")]));
      }
      showFields(own?.fields || [], editor);
    });
    place();
  }

  function follow(changes) {
    if (!field) return;
    phases = field.phases.map((phase, k) => ({ ...phase, angle: changes[`motion.phases[${k}].angle`] ?? phase.angle }));
    place();
  }

  return { element, row, show, follow, borderAt: (path) => bar.querySelector(`[data-key="border/${keysOf(path ?? "")[2]}"]`) };
}
