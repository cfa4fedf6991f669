// The form of sizes: a slider and a number field for each, choices, and what is left open to be found.
"use strict";

function sizesOf(page) {
  const { at, word, decimal } = page;
  // What the engine said last; what is moved since, by paths; what stands in a field and is no value yet, by keys; what
  // is refused; the field that was changed last: of a lift there may be two, that of all phases and of the chosen one.
  let fields = [], moved = {}, drafts = {}, wrong = null, edited = null;
  const isRefused = () => wrong !== null;
  const phases = phasesOf(page, { change, draw, rowOf, errorOf, valueOf, isRefused });

  // What is seldom moved is closed at first.
  const SELDOM = /^(drawing|pencil|spring|material)/;
  // What is moved most stands first: on a phone it lies under the thumb.
  const FIRST = /^(follower\.(offset|arm)|arcs)/;
  const keyOf = ({ key, path }) => key ?? path;
  const idOf = (field) => `size-${keyOf(field).replace(/\W+/g, "-")}`;
  const sizes = () => fields.filter(({ kind }) => kind !== "phases");
  const bar = () => fields.find(({ kind }) => kind === "phases");
  const wrongAt = (field) => wrong?.key === keyOf(field);

  // While a size is moved its numbers follow at once.
  function valueOf({ path, value }) {
    return path in moved ? moved[path] : value;
  }
  const textOf = (field) => shortNumber(valueOf(field), decimal());

  // --- one field -------------------------------------------------------------------------------------------------------

  function change(changes, byKey = false) {
    page.change(changes, byKey);
    draw();
  }

  function commit(field, { value }) {
    const number = typedNumber(value), isOld = value === textOf(field);
    if (!isOld && Number.isNaN(number)) return refuseText(field);
    delete drafts[keyOf(field)];
    edited = keyOf(field);
    // Back at what is drawn: what was refused is left.
    if (wrongAt(field) && value === shortNumber(field.value, decimal())) page.leave();
    else if (isOld) draw();
    else change(changesOf(field, number));
  }

  function pressed(field, event) {
    const { key, target, shiftKey } = event, value = typedNumber(target.value);
    if (key === "Enter") commit(field, target);
    if (key === "Escape" && target.value !== textOf(field)) {
      event.stopPropagation();
      delete drafts[keyOf(field)];
      draw();
      page.leave();
    }
    if (!/^Arrow(Up|Down)$/.test(key) || Number.isNaN(value)) return;
    event.preventDefault();
    delete drafts[keyOf(field)];
    change(changesOf(field, valueByKey({ ...field, value }, key, shiftKey)), true);
  }

  function typed(field, text) {
    drafts[keyOf(field)] = text;
    draw();
  }

  function slid(field, { value }) {
    edited = keyOf(field);
    page.slide(changesOf(field, Number(value)));
  }

  function openSwitch(field, isOpen) {
    const pick = (given) =>
      change(given ? changesOf(field, field.adopted ?? field.min) : { [field.open || field.path]: null });
    const button = (given, name) => html`<button type="button" role="radio" data-key="${field.path}/${given}"
      data-given=${given} aria-checked=${given !== isOpen} tabindex=${given === isOpen ? -1 : 0}
      @click=${() => pick(given)}>${word(name)}</button>`;
    const turned = (event) => {
      if (!/^Arrow/.test(event.key)) return;
      event.preventDefault();
      event.stopPropagation();
      const other = event.currentTarget.querySelector("[aria-checked=false]");
      other.focus();
      other.click();
    };
    const adopted = `${shortNumber(field.adopted && Math.round(field.adopted * 1000) / 1000, decimal())} ${field.unit}`;
    return html`<div class="choice" role="radiogroup" aria-label=${field.name} @keydown=${turned}>${
      button(false, field.adopted === null ? "none" : "found")}${button(true, "given")}</div>
      <p class="found" ?hidden=${!isOpen || field.adopted === null}>${letters(`${word("found")}: ${adopted}`)}</p>`;
  }

  function numberOf(field) {
    const key = keyOf(field), id = idOf(field), { kind, name, unit, min, max, step } = field, value = valueOf(field);
    const isOpen = kind === "open-number" && value === null, there = value ?? field.adopted, isWrong = wrongAt(field);
    return html`<div class="size${isOpen ? " open" : ""}${isWrong ? " wrong" : ""}">
      <div class="row"><label for=${id}>${letters(name)}</label>
        <input type="text" inputmode="decimal" id=${id} data-key=${key} autocomplete="off" ?hidden=${isOpen}
          aria-describedby="${id}-error" aria-invalid=${isWrong || nothing} .value=${live(drafts[key] ?? textOf(field))}
          @input=${({ target }) => typed(field, target.value)} @change=${({ target }) => commit(field, target)}
          @keydown=${(event) => pressed(field, event)}>
        <span class="unit" ?hidden=${isOpen}>${letters(unit)}</span></div>
      ${kind === "open-number" ? openSwitch(field, isOpen) : nothing}
      <input type="range" data-key="${key}/range" aria-label=${name} ?hidden=${isOpen}
        aria-valuetext=${`${shortNumber(there, decimal())} ${unit}`.trim()} min=${min} max=${max} step=${step}
        .value=${live(String(there ?? min))} @input=${({ target }) => slid(field, target)}>
      ${errorOf(isWrong, `${id}-error`)}</div>`;
  }

  function choiceOf(field) {
    const key = keyOf(field), id = idOf(field), isWrong = wrongAt(field), { path, name, choices, value } = field;
    const isChosen = (each, k) => (key in drafts ? drafts[key] === k : each === value);
    const chosen = ({ target: { selectedIndex: k } }) => {
      drafts[key] = k;
      change(choices[k].changes || { [path]: choices[k].value });
    };
    return html`<div class="size choosing${isWrong ? " wrong" : ""}"><label for=${id}>${letters(name)}</label>
      <select id=${id} data-key=${key} aria-invalid=${isWrong || nothing} @change=${chosen}>${
        options(choices.map((each) => [each.value, each.name]), isChosen)}</select>
      ${errorOf(isWrong, `${id}-error`)}</div>`;
  }

  function errorOf(isWrong, id) {
    const message = isWrong ? letters(wrong.message) : nothing;
    return html`<p class="error" id=${id} role="alert" ?hidden=${!isWrong}>${message}</p>`;
  }

  function rowOf(field) {
    return field.kind === "choice" ? choiceOf(field) : numberOf(field);
  }

  // --- the whole form ------------------------------------------------------------------------------------------------------

  function sectionOf(group) {
    const own = fields.filter((field) => field.group === group);
    const inside = repeat(own, keyOf, (field) => (field.kind === "phases" ? phases.barOf(field, wrong) : rowOf(field)));
    const isSeldom = own.every(({ path }) => SELDOM.test(path));
    return isSeldom ? html`<details><summary>${letters(group)}</summary>${inside}</details>`
      : html`<section><h2>${letters(group)}</h2>${inside}</section>`;
  }

  function draw() {
    const groups = [...new Set(fields.map(({ group }) => group))];
    const first = new Set(fields.filter(({ path }) => FIRST.test(path)).map(({ group }) => group));
    render(repeat([...first, ...groups.filter((group) => !first.has(group))], (group) => group, sectionOf), at("form"));
  }

  // All fields say again what is drawn; of what is being typed the text stays.
  function restore(typing = {}) {
    [wrong, moved, drafts] = [null, {}, typing];
    draw();
  }

  function show(found) {
    // Of the same sizes again: what was refused stays in its field.
    if (wrong && alike(found, fields)) return;
    const { type, dataset: { key } } = document.activeElement;
    fields = found;
    restore(type === "text" && key in drafts && key !== wrong?.key ? { [key]: drafts[key] } : {});
  }

  function follow(changes) {
    Object.assign(moved, changes);
    draw();
  }

  // --- errors -----------------------------------------------------------------------------------------------------------------

  function refuse(found) {
    wrong = found;
    draw();
    const said = at("form").querySelector(".error:not([hidden])"), folded = said.closest("details");
    if (folded) folded.open = true;
    // On a phone it may lie below the edge of the panel.
    said.scrollIntoView({ block: "nearest" });
  }

  function refuseText(field) {
    refuse({ key: keyOf(field), message: word("no_number") });
    page.showStatus();
  }

  function keyAt(path) {
    const found = [...sizes(), ...phases.fieldsOf(bar())].filter((field) => field.path === path).map(keyOf);
    const ofPhases = path?.startsWith("motion.phases") && bar() ? phases.key : undefined;
    return found.includes(edited) ? edited : found[0] ?? ofPhases;
  }

  // Whether there is a field for the error; the value stays as it was typed.  It is told there if that was changed, else
  // beside what was: a value that is refused lives in its own field alone.
  function showError({ field, message, remedy }, changed) {
    const own = keyAt(field), all = changed.map(keyAt).filter(Boolean);
    const key = own !== phases.key && all.includes(own) ? own : all[0] || own;
    // A knob of the drawing has moved a border of the bar.
    const border = keysOf(changed[0] ?? "")[2];
    if (key) refuse({ key, message: [message, remedy].filter(Boolean).join("; "), border });
    return Boolean(own);
  }

  at("form").addEventListener("submit", (event) => event.preventDefault());

  // What a task has of a size, in words.
  function said({ path, name, unit, choices }, task) {
    const value = valueAt(task, path), number = typeof value === "number" && shortNumber(value, decimal());
    const chosen = choices?.find((choice) => alike(choice.value, value))?.name;
    return `${name} ${number ? `${number} ${unit}`.trim() : chosen ?? word("found")}`;
  }

  return { show, follow, showError, restore, said, refused: isRefused, fields: sizes };
}
