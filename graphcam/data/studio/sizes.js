// The form of sizes: a slider and a number field for each, choices, and what is left open to be found.
"use strict";

function sizesOf(at, acts) {
  const { change, slide, leave, refused, word, decimal } = acts;
  const rows = new Map(), phases = phasesOf({ ...acts, showFields, isRefused: () => errorAt !== null });
  let shape = "", shown = "", errorAt = null, ofPhase = "", edited = null;

  // What is seldom moved is closed at first.
  const SELDOM = /^(drawing|pencil|spring|material)/;
  // What is moved most stands first: on a phone it lies under the thumb.
  const FIRST = /^(follower\.(offset|arm)|arcs)/;
  const keyOf = ({ key, path }) => key ?? path;
  const idOf = (field) => `size-${keyOf(field).replace(/\W+/g, "-")}`;

  // --- one field -------------------------------------------------------------------------------------------------------

  function numberInput(field, row) {
    const input = make("input", {
      type: "text", inputmode: "decimal", id: idOf(field), "data-key": keyOf(field), autocomplete: "off",
      "aria-describedby": `${idOf(field)}-error`,
    });
    const commit = () => {
      if (input.value === input.shown) return;
      const value = typedNumber(input.value);
      if (Number.isNaN(value)) return refuseText(row);
      input.shown = input.value;
      edited = row;
      change(changesOf(row.field, value));
    };
    input.addEventListener("change", commit);
    input.addEventListener("keydown", (event) => {
      if (event.key === "Enter") commit();
      if (event.key === "Escape" && input.value !== input.shown) {
        event.stopPropagation();
        input.value = input.shown;
        leave();
      }
      const by = { ArrowUp: 1, ArrowDown: -1 }[event.key], value = typedNumber(input.value);
      if (!by || Number.isNaN(value)) return;
      event.preventDefault();
      const axis = { ...row.field, value };
      change(changesOf(row.field, valueByKey(axis, event.key, event.shiftKey)), true);
    });
    return input;
  }

  function rangeInput(field, row) {
    const input = make("input", { type: "range", "data-key": `${keyOf(field)}/range`, "aria-label": field.name });
    input.addEventListener("input", () => slide(changesOf((edited = row).field, Number(input.value))));
    return input;
  }

  function openSwitch(field, row) {
    const pick = (given) => change(given ? changesOf(row.field, row.field.adopted ?? row.field.min)
      : { [row.field.open || row.field.path]: null });
    const button = (given) => make("button", {
      type: "button", role: "radio", "data-key": `${field.path}/${given}`, "data-given": String(given),
      text: word(given ? "given" : field.adopted === null ? "none" : "found"), onclick: () => pick(given),
    });
    const group = make("div", { class: "choice", role: "radiogroup", "aria-label": field.name }, button(false), button(true));
    group.addEventListener("keydown", (event) => {
      if (!/^Arrow/.test(event.key)) return;
      event.preventDefault();
      event.stopPropagation();
      const other = group.querySelector("[aria-checked=false]");
      other.focus();
      other.click();
    });
    return group;
  }

  function choiceInput(field, row) {
    const select = make("select", { id: idOf(field), "data-key": keyOf(field) }, field.choices.map((choice) =>
      make("option", { value: choice.value, text: choice.name })));
    select.addEventListener("change", () => {
      const chosen = row.field.choices[select.selectedIndex];
      change(chosen.changes || { [field.path]: chosen.value });
    });
    return select;
  }

  function rowOf(field) {
    const row = { field };
    const error = make("p", { class: "error", id: `${idOf(field)}-error`, role: "alert", hidden: true });
    const label = make("label", { for: idOf(field), text: field.name });
    if (field.kind === "choice") {
      row.input = choiceInput(field, row);
      row.element = make("div", { class: "size choosing" }, label, row.input, error);
    } else {
      row.input = numberInput(field, row);
      row.range = rangeInput(field, row);
      row.open = field.kind === "open-number" ? openSwitch(field, row) : null;
      row.found = row.open ? make("p", { class: "found" }) : null;
      row.line = make("div", { class: "row" }, label, row.input, make("span", { class: "unit", text: field.unit }));
      row.element = make("div", { class: "size" }, row.line, row.open, row.found, row.range, error);
    }
    row.error = error;
    return row;
  }

  // --- values ------------------------------------------------------------------------------------------------------------

  function setNumber(row, field) {
    const open = field.value === null, value = field.value ?? field.adopted;
    const shown = shortNumber(field.value, decimal());
    if (document.activeElement !== row.input || row.input.value === row.input.shown || row.input.shown === undefined) row.input.value = shown;
    row.input.shown = shown;
    Object.assign(row.range, { min: field.min, max: field.max, step: field.step });
    row.range.value = value ?? field.min;
    row.range.setAttribute("aria-valuetext", `${shortNumber(value, decimal())} ${field.unit}`.trim());
    if (!row.open) return;
    row.element.classList.toggle("open", open);
    row.input.hidden = row.range.hidden = open;
    row.line.querySelector(".unit").hidden = open;
    for (const button of row.open.children) {
      const chosen = (button.dataset.given === "true") !== open;
      button.setAttribute("aria-checked", chosen);
      button.tabIndex = chosen ? 0 : -1;
    }
    row.found.hidden = !open || field.adopted === null;
    lettered(row.found, `${word("found")}: ${shortNumber(field.adopted === null ? null : Math.round(field.adopted * 1000) / 1000, decimal())} ${field.unit}`);
  }

  function setRow(row, field) {
    row.field = field;
    if (field.kind === "choice") row.input.selectedIndex = field.choices.findIndex((choice) => choice.value === field.value);
    else setNumber(row, field);
  }

  // --- the whole form ------------------------------------------------------------------------------------------------------

  const shapeOf = (fields) => JSON.stringify(fields.map((field) =>
    [field.path, field.kind, field.name, field.unit, field.adopted === null, field.choices?.map((choice) => choice.name)]));

  function addRow(field) {
    rows.set(keyOf(field), rowOf(field));
    return rows.get(keyOf(field)).element;
  }

  // The fields of the chosen phase, before the buttons that change the phases.
  function showFields(fields, editor) {
    const paths = shapeOf(fields);
    if (paths !== ofPhase || fields.some(({ key }) => !editor.contains(rows.get(key)?.element))) {
      for (const [key, { field }] of rows) if (field.key) rows.delete(key);
      for (const old of editor.querySelectorAll(".size")) old.remove();
      editor.lastElementChild?.before(...fields.map(addRow));
    }
    ofPhase = paths;
    for (const field of fields) setRow(rows.get(field.key), field);
  }

  function rebuild(fields) {
    rows.clear();
    const isFirst = (group) => fields.some((field) => field.group === group && FIRST.test(field.path));
    const every = [...new Set(fields.map((field) => field.group))], groups = [...every.filter(isFirst), ...every.filter((group) => !isFirst(group))];
    const sections = groups.map((group) => {
      const inside = fields.filter((field) => field.group === group).map((field) => {
        return field.kind === "phases" ? phases.element : addRow(field);
      });
      return fields.every((field) => field.group !== group || SELDOM.test(field.path)) ? make("details", {}, make("summary", { text: group }), inside)
        : make("section", {}, make("h2", { text: group }), inside);
    });
    keepingFocus(at("form"), () => at("form").replaceChildren(...sections));
  }

  function show(fields) {
    const news = JSON.stringify(fields);
    // Of the same sizes again: what was refused stays in its field.
    if (news === shown && errorAt) return;
    shown = news;
    if (errorAt) forgive(errorAt);
    if (shapeOf(fields) !== shape) rebuild(fields);
    shape = shapeOf(fields);
    for (const field of fields) {
      if (field.kind === "phases") phases.show(field);
      else setRow(rows.get(keyOf(field)), field);
    }
  }

  // All fields say again what is drawn.
  function restore() {
    if (errorAt) forgive(errorAt);
    phases.follow({});
    for (const row of rows.values()) {
      row.input.shown = row.input.value;
      setRow(row, row.field);
    }
  }

  // While a size is moved its numbers follow at once.
  function follow(changes) {
    for (const row of rows.values()) {
      const { path, kind } = row.field;
      if (path in changes && kind !== "choice") setNumber(row, { ...row.field, value: changes[path] });
    }
    phases.follow(changes);
  }

  // --- errors -----------------------------------------------------------------------------------------------------------------

  function refuse(row, message) {
    if (errorAt && errorAt !== row) forgive(errorAt);
    errorAt = row;
    lettered(row.error, message);
    row.error.hidden = false;
    row.element.classList.add("wrong");
    row.input?.setAttribute("aria-invalid", "true");
    const folded = row.element.closest("details");
    if (folded) folded.open = true;
    // On a phone it may lie below the edge of the panel.
    row.error.scrollIntoView({ block: "nearest" });
  }

  function refuseText(row) {
    refuse(row, word("no_number"));
    refused();
  }

  function forgive(row) {
    errorAt = null;
    row.error.hidden = true;
    row.element.classList.remove("wrong");
    for (const input of row.element.querySelectorAll("[aria-invalid]")) input.removeAttribute("aria-invalid");
  }

  // Of a lift there may be two: that of all phases, and that of the chosen one.
  function rowOn(path) {
    const found = [...rows.values()].filter(({ field }) => field.path === path);
    return found.includes(edited) ? edited : found[0];
  }

  // Whether there is a field for the error; the value stays as it was typed.  It is told there if that was changed, else
  // beside what was: a value that is refused lives in its own field alone.
  function showError({ field, message, remedy }, changed) {
    const rowAt = (path) => rowOn(path) || (path?.startsWith("motion.phases") && phases.element.isConnected ? phases.row : undefined);
    const own = rowAt(field), moved = changed.map(rowAt).filter(Boolean), there = own !== phases.row && moved.includes(own) ? own : moved[0] || own;
    // A knob of the drawing has moved a border of the bar.
    if (there === phases.row) there.input = phases.borderAt(changed[0]);
    if (there) refuse(there, [message, remedy].filter(Boolean).join("; "));
    return Boolean(own);
  }

  at("form").addEventListener("submit", (event) => event.preventDefault());

  // What a task has of a size, in words.
  function said({ path, name, unit, choices }, task) {
    const value = valueAt(task, path), number = typeof value === "number" && shortNumber(value, decimal());
    const chosen = choices?.find((choice) => alike(choice.value, value))?.name;
    return `${name} ${number ? `${number} ${unit}`.trim() : chosen ?? word("found")}`;
  }

  return { show, follow, showError, restore, said, refused: () => errorAt !== null, fields: () => [...rows.values()].map((row) => row.field).filter((field) => !field.key) };
}
