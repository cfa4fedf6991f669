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

// A part of the form, which changes the task, knows what is moved and refused, and renders fields and errors.
function phasesOf(page, { change, draw, rowOf, errorOf, valueOf, isRefused }) {
  const { at, word, decimal } = page;
  const key = "phases";
  let given = [], phases = [], chosen = null, wide = 240;

  const start = (k) => phases.slice(0, k).reduce((sum, phase) => sum + phase.angle, 0);
  const total = () => start(phases.length) || 360;
  // The phases to which something is done: what was refused is none of them.
  const standing = () => (isRefused() ? given : phases);
  const said = (degrees) => `${shortNumber(degrees, decimal())}°`;

  // --- the bar ------------------------------------------------------------------------------------------------------------

  function segmentOf({ kind, angle, symbol, name }, k, wide) {
    const tight = `${isTight(name, wide) ? " narrow" : ""}${isTight(`${angle}°`, wide) ? " tiny" : ""}`;
    const choose = () => {
      chosen = chosen === k ? null : k;
      draw();
    };
    return html`<button type="button" class="${kind === "dwell" ? kind : "moves"}${tight}" data-key="phase/${k}"
      aria-pressed=${k === chosen} aria-label="${symbol} ${name} ${said(angle)}" style="flex-grow: ${angle}"
      @click=${choose}><b>${said(angle)}</b><span>${letters(name)}</span></button>`;
  }

  function borderOf(k, isWrong) {
    const value = start(k + 1), min = start(k) + 1, max = start(k + 2) - 1;
    const pressed = (event) => {
      const next = valueByKey({ value, min, max, step: 1, fine: 0.1, coarse: 5 }, event.key, event.shiftKey);
      if (next === undefined) return;
      event.preventDefault();
      change(borderChanges(standing(), k, next, event.shiftKey), true);
    };
    const moved = ({ target }) => change(borderChanges(standing(), k, Number(target.value)), true);
    return html`<div class="border" data-border=${k} style="left: ${100 * value / total()}%"
      @pointerdown=${(event) => drag(event, k)}><input type="range" class="unseen" step="any" data-key="border/${k}"
        aria-label="${word("border")} ${phases[k].symbol} ${phases[k + 1].symbol}" aria-valuetext=${said(value)}
        aria-invalid=${isWrong || nothing} min=${min} max=${max} .value=${live(String(value))}
        @keydown=${pressed} @input=${moved}></div>`;
  }

  function drag(event, k) {
    if (event.button) return;
    event.preventDefault();
    const border = event.currentTarget, box = border.parentElement.getBoundingClientRect();
    const turn = total(), before = standing();
    border.setPointerCapture(event.pointerId);
    border.firstElementChild.focus({ preventScroll: true });
    const move = ({ clientX, shiftKey }) =>
      page.slide(borderChanges(before, k, (clientX - box.left) / box.width * turn, shiftKey));
    border.addEventListener("pointermove", move);
    border.addEventListener("lostpointercapture", () => border.removeEventListener("pointermove", move), { once: true });
  }

  // --- the phase that is chosen ---------------------------------------------------------------------------------------------

  function editorOf({ symbol, name, fields, edits }) {
    const edit = (what) => html`<button type="button" data-key="edit-${what}"
      @click=${() => change({ "motion.phases": edits[what] })}>${word(`phase_${what}`)}</button>`;
    return html`<p class="label">${letters(`${symbol} ${name}`)}</p>${repeat(fields, (field) => field.key, rowOf)}
      <div class="rows">${["dwell", "step", "remove"].filter((what) => edits[what]).map(edit)}</div>`;
  }

  function barOf(field, wrong) {
    given = field.phases;
    const angleOf = ({ angle }, k) => valueOf({ path: `motion.phases[${k}].angle`, value: angle });
    phases = given.map((phase, k) => ({ ...phase, angle: angleOf(phase, k) }));
    if (chosen !== null) chosen = Math.min(chosen, phases.length - 1);
    const own = phases[chosen], isWrong = wrong?.key === key;
    // To ask lays the page out; while a hand is down the form stays as wide.
    if (!page.hand) wide = (at("form").clientWidth || 242) - 2;
    return html`<div class="size phases${isWrong ? " wrong" : ""}" role="group" aria-label=${word("phases")}>
      <div class="phase-bar">${phases.map((phase, k) => segmentOf(phase, k, phase.angle / total() * wide))}${
        phases.slice(1).map((_, k) => borderOf(k, isWrong && wrong.border === k))}</div>
      <div class="phase-editor${own ? "" : " hint"}">${own ? editorOf(own) : word("choose_a_phase")}</div>
      ${errorOf(isWrong, "phases-error")}</div>`;
  }

  return { key, barOf, fieldsOf: (field) => field?.phases[chosen]?.fields || [] };
}
