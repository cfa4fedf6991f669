// The bar of phases: borders that are dragged, phases that are added and taken away, and their laws.
"use strict";

// A border is drawn to whole steps of five degrees from so near [degrees].
const MAGNET = 0.7;

// What becomes of two neighbours when the border after phase k is moved to so many degrees from the start.
function borderChanges(phases, k, degrees, fine = false) {
  const start = phases.slice(0, k).reduce((sum, phase) => sum + phase.angle, 0);
  const sum = phases[k].angle + phases[k + 1].angle;
  const five = 5 * Math.round(degrees / 5), step = fine ? 0.1 : 1;
  const near = !fine && Math.abs(five - degrees) < MAGNET ? five : Math.round(degrees / step) * step;
  const angle = Math.max(1, Math.min(sum - 1, Math.round((near - start) * 1e6) / 1e6));
  return { [`motion.phases[${k}].angle`]: angle, [`motion.phases[${k + 1}].angle`]: Math.round((sum - angle) * 1e6) / 1e6 };
}

// A phase's angle that is typed: the next one gives or takes, of the last one that before it.
function angleChanges(phases, k, angle) {
  const other = k < phases.length - 1 ? k + 1 : k - 1;
  const rest = Math.round((phases[k].angle + phases[other].angle - angle) * 1e6) / 1e6;
  return { [`motion.phases[${k}].angle`]: angle, [`motion.phases[${other}].angle`]: rest };
}

function phasesOf({ change, slide, release, word, decimal }) {
  const bar = make("div", { class: "phase-bar" });
  const editor = make("div", { class: "phase-editor" });
  const error = make("p", { class: "error", id: "phases-error", role: "alert", hidden: true });
  const element = make("div", { class: "size phases", role: "group", "aria-label": word("phases") }, bar, editor, error);
  const row = { element, error, input: null };
  let field = null, phases = [], chosen = null;

  const total = () => phases.reduce((sum, phase) => sum + phase.angle, 0) || 360;
  const start = (k) => phases.slice(0, k).reduce((sum, phase) => sum + phase.angle, 0);

  // --- the bar ------------------------------------------------------------------------------------------------------------

  function segmentOf(phase, k) {
    return make("button", {
      type: "button", class: phase.kind === "dwell" ? "dwell" : "moves", "data-key": `phase/${k}`,
      "aria-pressed": k === chosen, "aria-label": `${phase.symbol} ${phase.name} ${shortNumber(phase.angle, decimal())}°`,
      onclick: () => { chosen = chosen === k ? null : k; build(); },
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
      change(borderChanges(phases, k, value, event.shiftKey), true);
    });
    input.addEventListener("input", () => change(borderChanges(phases, k, Number(input.value)), true));
    const border = make("div", { class: "border", "data-border": k }, input);
    border.addEventListener("pointerdown", (event) => drag(event, border, k));
    return border;
  }

  function drag(event, border, k) {
    if (event.button) return;
    event.preventDefault();
    const box = bar.getBoundingClientRect(), turn = total(), before = phases;
    border.setPointerCapture(event.pointerId);
    border.querySelector("input").focus({ preventScroll: true });
    const move = (now) => slide(borderChanges(before, k, (now.clientX - box.left) / box.width * turn, now.shiftKey));
    const end = (cancelled) => {
      border.removeEventListener("pointermove", move);
      border.onpointerup = border.onpointercancel = border.onkeydown = null;
      release(cancelled);
    };
    border.addEventListener("pointermove", move);
    border.onpointerup = () => end(false);
    border.onpointercancel = () => end(true);
    border.onkeydown = (key) => key.key === "Escape" && end(true);
  }

  function place() {
    const turn = total();
    bar.querySelectorAll("button").forEach((segment, k) => {
      segment.style.flexGrow = phases[k].angle;
      const wide = phases[k].angle / turn * (bar.clientWidth || 240);
      segment.classList.toggle("narrow", isTight(phases[k].name, wide));
      segment.classList.toggle("tiny", isTight(`${phases[k].angle}°`, wide));
      segment.firstChild.textContent = `${shortNumber(phases[k].angle, decimal())}°`;
    });
    bar.querySelectorAll(".border").forEach((border, k) => {
      border.style.left = `${100 * start(k + 1) / turn}%`;
      Object.assign(border.firstChild, { min: start(k) + 1, max: start(k + 2) - 1, value: start(k + 1) });
      border.firstChild.setAttribute("aria-valuetext", `${shortNumber(start(k + 1), decimal())}°`);
    });
  }

  // --- the phase that is chosen ---------------------------------------------------------------------------------------------

  function numberOf(name, value, unit, changes) {
    const input = make("input", { type: "text", inputmode: "decimal", value: shortNumber(value, decimal()), "data-key": `phase-${name}`, autocomplete: "off" });
    input.addEventListener("change", () => {
      const typed = typedNumber(input.value);
      if (Number.isNaN(typed)) input.setAttribute("aria-invalid", "true");
      else change(changes(typed));
    });
    return make("label", { class: "row" }, make("span", { class: "label", text: word(name) }), input, make("span", { class: "unit", text: unit }));
  }

  function lawOf(phase, path) {
    const select = make("select", { "data-key": "phase-law" }, field.laws.map((law) =>
      make("option", { value: law.value, text: law.name, selected: law.value === phase.law })));
    const { ratio } = field;
    // Only some laws have parts whose ratio is chosen.
    select.addEventListener("change", () => change({
      [`${path}.law`]: select.value, ...(phase.ratio !== undefined && !ratio?.laws.includes(select.value) ? { [`${path}.ratio`]: null } : {}),
      // Only one has blends.
      ...(phase.blends !== undefined && select.value !== "constant-velocity" ? { [`${path}.blends`]: null } : {}),
    }));
    return make("label", { class: "row" }, make("span", { class: "label", text: word("law") }), select);
  }

  function editButtons(phase) {
    const edit = (name) => phase.edits?.[name] && make("button", {
      type: "button", "data-key": `edit-${name}`, text: word(`phase_${name}`), onclick: () => change({ "motion.phases": phase.edits[name] }),
    });
    return make("div", { class: "rows" }, edit("dwell"), edit("step"), edit("remove"));
  }

  function build() {
    if (chosen !== null) chosen = Math.min(chosen, phases.length - 1);
    keepingFocus(element, () => {
      bar.replaceChildren(...phases.map(segmentOf), ...phases.slice(1).map((_, k) => borderOf(k)));
      editor.classList.toggle("hint", chosen === null);
      editor.replaceChildren(...(chosen === null ? [word("choose_a_phase")] : fieldsOf(phases[chosen])));
    });
    place();
  }

  function fieldsOf(phase) {
    const path = `motion.phases[${chosen}]`, { ratio } = field;
    return [
      make("p", { class: "label", text: `${phase.symbol} ${phase.name}` }),
      phases.length > 1 && numberOf("angle_of_phase", phase.angle, "°", (angle) => angleChanges(phases, chosen, angle)),
      phase.kind !== "dwell" && numberOf("lift", phase.lift, field.lift?.unit || "", (lift) => ({ [`${path}.lift`]: lift })),
      phase.kind !== "dwell" && lawOf(phase, path),
      ratio?.laws.includes(phase.law) && numberOf("ratio", phase.ratio ?? 1, "", (value) => ({ [`${path}.ratio`]: value })),
      editButtons(phase),
    ].filter(Boolean);
  }

  function show(now) {
    const same = field && JSON.stringify(field) === JSON.stringify(now);
    field = now;
    phases = now.phases;
    if (same) place();
    else build();
  }

  function follow(changes) {
    const moved = Object.entries(changes).map(([path, value]) => [/^motion\.phases\[(\d+)\]\.angle$/.exec(path), value]).filter(([found]) => found);
    if (!moved.length || !field) return;
    phases = field.phases.map((phase, k) => ({ ...phase, angle: moved.find(([found]) => Number(found[1]) === k)?.[1] ?? phase.angle }));
    const angle = editor.querySelector("[data-key='phase-angle_of_phase']");
    if (angle) angle.value = shortNumber(phases[chosen].angle, decimal());
    place();
  }

  return { element, row, show, follow };
}
