// The panel beside the drawing: what is done in the step, and the values drawn beside the exact ones.
"use strict";

// --- the step -----------------------------------------------------------------------------------------------------------

const tabStop = (lit) => (lit?.length ? "0" : nothing);
const lights = (lit) => (lit?.length ? JSON.stringify(lit) : nothing);

function readingOf({ title, taken, value, lit, table = [] }, words) {
  const head = () => ["place", "paper", "value"].map((name) => html`<th scope="col">${words[name]}</th>`);
  const rowOf = ({ place, paper, value, lit }) => html`<tr tabindex=${tabStop(lit)} data-lit=${lights(lit)}>
    <th scope="row">${letters(place)}</th><td>${letters(paper)}</td><td>${letters(value)}</td></tr>`;
  const places = () => html`<details><summary>${words.all_values} (${table.length})</summary>
    <table><thead><tr>${head()}</tr></thead><tbody>${table.map(rowOf)}</tbody></table></details>`;
  return html`<div tabindex=${tabStop(lit)} data-lit=${lights(lit)}><dt>${letters(title)}</dt><dd>${
    taken ? html`<span class="taken">${letters(taken)} =</span>` : nothing} <strong>${letters(value)}</strong>${
    table.length ? places() : nothing}</dd></div>`;
}

function stepPanelOf({ at, words, go, currentStep }) {
  const element = at("panel-step");
  const goTo = (part) => () => go(currentStep(), part);
  const partButton = (k, inside) =>
    html`<button type="button" data-part=${k} data-key="part/${k}" @click=${goTo(k)}>${inside}</button>`;
  const toolsOf = ({ tools }) =>
    (tools.length ? html` <span class="tools-set">${letters(tools.join(" · "))}</span>` : nothing);

  // A run is told once, with a table of its places.
  function runItem({ caption, first, head, rows, tools, widest }, parts) {
    const rowOf = ([name, setting], k) => html`<li>${partButton(first + k, html`<span class="unseen done-here">${
      letters(parts[first + k].caption)}</span><b aria-hidden="true">${letters(name)}</b>${
      setting ? html` <span aria-hidden="true">${letters(setting)}</span>` : nothing}`)}</li>`;
    return html`<li class="run">
      <p class="sentences"><span class="said">${letters(caption)}</span>${toolsOf({ tools })}</p>
      ${head ? html`<p class="head" aria-hidden="true">${letters(head)}</p>` : nothing}
      <ol class="row-table" style="--row: ${widest}">${rows.map(rowOf)}</ol></li>`;
  }

  function itemOf(part, k, { parts, runs }) {
    const run = runs?.find(({ first, rows }) => first <= k && k < first + rows.length);
    if (run) return run.first === k ? runItem(run, parts) : nothing;
    return html`<li>${partButton(k, html`<span class="at">${k + 1}</span> <span class="said done-here">${
      letters(part.caption)}</span>${toolsOf(part)}`)}</li>`;
  }

  const partsOf = (step, isWhole) => html`
    <div class="part-by-part"><h3 id="parts-title">${words.part_by_part}</h3>
      <button type="button" class="whole-step" data-key="whole" aria-pressed=${isWhole}
        @click=${goTo(null)}>${words.whole_step}</button></div>
    <ol class="parts" aria-labelledby="parts-title">${step.parts.map((part, k) => itemOf(part, k, step))}</ol>`;

  const articleOf = (step, isWhole) => html`<article>
    <p class="chapter">${letters(step.chapter || "")}</p>
    ${step.opens ? html`<p class="purpose">${letters(step.opens)}</p>` : nothing}
    <h2><span class="number">${step.number || ""}</span> <span class="name">${letters(step.title || "")}</span></h2>
    ${step.caption ? html`<p class="caption">${letters(step.caption)}</p>` : nothing}
    ${step.parts.length > 1 ? partsOf(step, isWhole) : nothing}
    ${step.why ? html`<p class="reason"><strong>${words.why}</strong> <span>${letters(step.why)}</span></p>` : nothing}
    ${step.readings?.length ? html`<h3>${words.readings}</h3>
      <dl>${step.readings.map((reading) => readingOf(reading, words))}</dl>` : nothing}</article>`;

  // Another step is told in elements of its own: what was unfolded in one is not in the next.
  function show(step, part) {
    render(repeat([step], ({ number, title }) => `${number} ${title}`, () => articleOf(step, part === null)), element);
    const items = itemsOf(element);
    markParts(items, part);
    if (part) items[part]?.scrollIntoView({ block: "nearest" });
  }

  return { show, tell: (said) => render(said, element) };
}

// --- the values -----------------------------------------------------------------------------------------------------------

// The values of the pinned cam, none until they are there; null where none is pinned.
const pinnedValues = ({ state, pinned }) => (state.get().pin ? pinned?.values || [] : null);

// A column is its name, its class, and what it says of a value.
const pinnedColumn = (pinned) => ["pinned", "pin", ({ id }) => pinned.find((value) => value.id === id)?.said.drawn ?? "–"];

function valuesTable({ values }, columns, words) {
  const headOf = ([name, kind]) => html`<th scope="col" class=${kind === "pin" ? kind : nothing}>${words[name]}</th>`;
  const rowOf = (value) => html`<tr><th scope="row">${letters(value.title)}</th>${columns.map(([, kind, said]) =>
    html`<td class=${kind ?? nothing}>${letters(said(value))}</td>`)}</tr>`;
  return html`<table class="compare"><thead><tr>${[["quantity", null], ...columns].map(headOf)}</tr></thead>
    <tbody>${values?.map(rowOf)}</tbody></table>`;
}

function valuesPanelOf(page) {
  const { at, words, last } = page;
  const columns = [["drawn", "now", ({ said }) => said.drawn], ["exact", null, ({ said }) => said.exact]];
  const bound = ["bound", "bound", ({ said }) => said.bound ?? ""];
  return () => {
    const pinned = pinnedValues(page), lastColumn = pinned ? pinnedColumn(pinned) : bound;
    const table = valuesTable(last, [...columns, lastColumn], words);
    render(html`<div class="scrolled" tabindex="0" role="region" aria-label=${words.values}>${table}</div>
      <p class="hint">${letters(words.drawn_about)}${pinned ? nothing : ` ${words.bound_about}`}</p>`, at("panel-values"));
  };
}
