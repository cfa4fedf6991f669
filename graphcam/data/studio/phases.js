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

// A lift that is typed: those of the other sense follow in proportion, so that the cam closes.
function liftChanges(phases, k, lift) {
  const lifts = phases.map((phase, j) => (j === k ? lift : phase.lift || 0)), { kind } = phases[k];
  const sum = (wanted) => phases.reduce((total, phase, j) => total + (wanted(phase.kind) ? lifts[j] : 0), 0);
  const other = (one) => one !== kind && one !== "dwell", by = sum((one) => one === kind) / sum(other);
  return Object.fromEntries(phases.map((phase, j) => [`motion.phases[${j}].lift`, other(phase.kind) ? tidy(by * lifts[j]) : lifts[j]])
    .filter((_, j) => j === k || other(phases[j].kind)));
}

function phasesOf({ change, slide, refuse, isRefused, word, decimal }) {
  const bar = make("div", { class: "phase-bar" });
  const editor = make("div", { class: "phase-editor" });
  const error = make("p", { class: "error", id: "phases-error", role: "alert", hidden: true });
  const element = make("div", { class: "size phases", role: "group", "aria-label": word("phases") }, bar, editor, error);
  const row = { element, error, input: null };
  let field = null, phases = [], chosen = null;

  const total = () => phases.reduce((sum, phase) => sum + phase.angle, 0) || 360;
  const start = (k) => phases.slice(0, k).reduce((sum, phase) => sum + phase.angle, 0);

  // The phases to which something is done: what was refused is none of them.
  const standing = () => (phases = isRefused() ? field.phases : phases);

  // --- the bar ------------------------------------------------------------------------------------------------------------

  function segmentOf(phase, k) {
    return make("button", {
      type: "button", class: phase.kind === "dwell" ? "dwell" : "moves", "data-key": `phase/${k}`,
      "aria-pressed": String(k === chosen), "aria-label": `${phase.symbol} ${phase.name} ${shortNumber(phase.angle, decimal())}°`,
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
      row.input = input;
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
    row.input = border.querySelector("input");
    row.input.focus({ preventScroll: true });
    const move = (now) => slide(borderChanges(before, k, (now.clientX - box.left) / box.width * turn, now.shiftKey));
    border.addEventListener("pointermove", move);
    border.addEventListener("lostpointercapture", () => border.removeEventListener("pointermove", move), { once: true });
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
      row.input = input;
      if (Number.isNaN(typed)) refuse();
      else change(changes(typed));
    });
    input.addEventListener("keydown", (event) => {
      if (event.key === "Escape") input.value = shortNumber(value, decimal());
    });
    return make("label", { class: "row" }, make("span", { class: "label", text: word(name) }), input, make("span", { class: "unit", text: unit }));
  }

  function lawOf(phase, path) {
    const select = make("select", { "data-key": "phase-law" }, field.laws.map((law) =>
      make("option", { value: law.value, text: law.name, selected: law.value === phase.law })));
    const { ratio } = field;
    // Only some laws have parts whose ratio is chosen.
    select.addEventListener("change", () => (row.input = select) && change({
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
    row.input = null;
    keepingFocus(element, () => {
      bar.replaceChildren(...phases.map(segmentOf), ...phases.slice(1).map((_, k) => borderOf(k)));
      editor.classList.toggle("hint", chosen === null);
      editor.replaceChildren(...(chosen === null ? [word("choose_a_phase")] : fieldsOf(phases[chosen])));
    });
    place();
  }

  function fieldsOf(phase) {
    const path = `motion.phases[${chosen}]`, { ratio } = field, blends = phase.blends ?? field.blends?.usual;
    return [
      make("p", { class: "label", text: `${phase.symbol} ${phase.name}` }),
      phases.length > 1 && numberOf("angle_of_phase", phase.angle, "°", (angle) => angleChanges(standing(), chosen, angle)),
      phase.kind !== "dwell" && numberOf("lift", phase.lift, field.lift?.unit || "", (lift) => liftChanges(standing(), chosen, lift)),
      phase.kind !== "dwell" && lawOf(phase, path),
      ratio?.laws.includes(phase.law) && numberOf("ratio", phase.ratio ?? 1, "", (value) => ({ [`${path}.ratio`]: value })),
      ...(phase.law === field.blends?.law ? ["first_blend", "second_blend"].map((name, k) =>
        numberOf(name, blends[k], "", (value) => ({ [`${path}.blends`]: blends.map((blend, at) => at === k ? value : blend) }))) : []),
      editButtons(phase),
    ].filter(Boolean);
  }

  function show(now) {
    const same = field && JSON.stringify(field) === JSON.stringify(now);
    field = now;
    phases = now.phases;
    // What somebody is typing stays.
    if (same && editor.contains(document.activeElement)) place();
    else build();
  }

  function follow(changes) {
    const moved = (k, name) => changes[`motion.phases[${k}].${name}`];
    if (!field || !phases.some((_, k) => moved(k, "angle") ?? moved(k, "lift"))) return;
    phases = field.phases.map((phase, k) => ({
      ...phase, angle: moved(k, "angle") ?? phase.angle, ...(moved(k, "lift") !== undefined && { lift: moved(k, "lift") }),
    }));
    for (const [key, name] of [["angle_of_phase", "angle"], ["lift", "lift"]]) {
      const input = chosen !== null && editor.querySelector(`[data-key='phase-${key}']`);
      if (input && input !== document.activeElement) input.value = shortNumber(phases[chosen][name], decimal());
    }
    place();
  }

  // As the task has them.
  function reset() {
    if (!field) return;
    phases = field.phases;
    build();
  }

  return {
    element, row, show, follow, reset, borderAt: (path) => bar.querySelector(`[data-key="border/${keysOf(path ?? "")[2]}"]`), isThere: () => element.isConnected,
    isEdited: (path) => Boolean(path?.startsWith("motion.phases") && row.input?.isConnected),
  };
}
