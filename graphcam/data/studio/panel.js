// The panel beside the drawing: what is done in the step, and the values drawn beside the exact ones.
"use strict";

// --- the step -----------------------------------------------------------------------------------------------------------

const lights = (lit) => (lit?.length ? { tabindex: "0", "data-lit": JSON.stringify(lit) } : {});

function readingOf(reading, words) {
  const table = reading.table?.length > 0 && make("details", {},
    make("summary", { text: `${words.all_values} (${reading.table.length})` }),
    make("table", {},
      make("thead", {}, make("tr", {}, ["place", "paper", "value"].map((name) => make("th", { scope: "col", text: words[name] })))),
      make("tbody", {}, reading.table.map((row) => make("tr", lights(row.lit),
        make("th", { scope: "row", text: row.place }), make("td", { text: row.paper }), make("td", { text: row.value }))))));
  return make("div", lights(reading.lit),
    make("dt", { text: reading.title }),
    make("dd", {}, reading.taken && make("span", { class: "taken", text: `${reading.taken} =` }), " ",
      make("strong", { text: reading.value }), table));
}

function stepPanelOf(element, words, go) {
  let told = null;

  const partButton = (k, ...inside) => make("button", { type: "button", "data-part": k, "data-key": `part/${k}`, onclick: () => go(k) }, ...inside);
  const toolsOf = ({ tools }) => tools.length > 0 && [" ", make("span", { class: "tools-set", text: tools.join(" · ") })];

  // A run is told once, with a table of its places.
  function runItem({ caption, first, head, rows, tools, widest }, parts) {
    return make("li", { class: "run" },
      make("p", { class: "sentences" }, make("span", { class: "said", text: caption }), toolsOf({ tools })),
      head && make("p", { class: "head", "aria-hidden": "true", text: head }),
      make("ol", { class: "row-table", style: `--row: ${widest}` }, rows.map(([name, setting], k) => make("li", {}, partButton(first + k,
        make("span", { class: "unseen done-here", text: parts[first + k].caption }),
        make("b", { "aria-hidden": "true", text: name }), setting && [" ", make("span", { "aria-hidden": "true", text: setting })])))));
  }

  function partsOf({ parts, runs }) {
    if (parts.length < 2) return [];
    const inRun = (k) => runs?.find(({ first, rows }) => first <= k && k < first + rows.length);
    const items = parts.map((part, k) => {
      const run = inRun(k);
      if (run) return run.first === k && runItem(run, parts);
      return make("li", {}, partButton(k, make("span", { class: "at", text: k + 1 }), " ", make("span", { class: "said done-here", text: part.caption }), toolsOf(part)));
    });
    return [
      make("div", { class: "part-by-part" }, make("h3", { id: "parts-title", text: words.part_by_part }),
        make("button", { type: "button", class: "whole-step", "data-key": "whole", text: words.whole_step, onclick: () => go(null) })),
      make("ol", { class: "parts", "aria-labelledby": "parts-title" }, items),
    ];
  }

  function articleOf(step) {
    return make("article", {},
      make("p", { class: "chapter", text: step.chapter || "" }),
      step.opens && make("p", { class: "purpose", text: step.opens }),
      make("h2", {}, make("span", { class: "number", text: step.number || "" }), " ", make("span", { class: "name", text: step.title || "" })),
      step.caption && make("p", { class: "caption", text: step.caption }),
      partsOf(step),
      step.why && make("p", { class: "reason" }, make("strong", { text: words.why }), " ", make("span", { text: step.why })),
      step.readings?.length > 0 && [make("h3", { text: words.readings }), make("dl", {}, step.readings.map((reading) => readingOf(reading, words)))]);
  }

  // The step is told anew only if something else is said of it.
  function show(step, part) {
    const { svg, hash, ...said } = step, news = JSON.stringify(said);
    if (news !== told) keepingFocus(element, () => element.replaceChildren(articleOf(step)));
    told = news;
    element.querySelector(".whole-step")?.setAttribute("aria-pressed", part === null);
    const items = itemsOf(element);
    markParts(items, part);
    if (part) items[part]?.scrollIntoView({ block: "nearest" });
  }

  function tell(...elements) {
    told = null;
    element.replaceChildren(...elements);
  }

  return { show, tell };
}

// --- the values -----------------------------------------------------------------------------------------------------------

// A column is its name, its class, and what it says of a value.
const pinnedColumn = (pinned) => ["pinned", "pin", ({ id }) => pinned.find((value) => value.id === id)?.said.drawn ?? "–"];

function valuesTable(values, columns, words) {
  const head = [["quantity", null], ...columns].map(([name, kind]) => make("th", { scope: "col", class: kind === "pin" ? kind : null, text: words[name] }));
  const rowOf = (value) => make("tr", {}, make("th", { scope: "row", text: value.title }), columns.map(([, kind, said]) => make("td", { class: kind, text: said(value) })));
  return make("table", { class: "compare" }, make("thead", {}, make("tr", {}, head)), make("tbody", {}, values.map(rowOf)));
}

function valuesPanelOf(element, words) {
  const place = make("div", { class: "scrolled", tabindex: "0", role: "region", "aria-label": words.values });
  element.append(place, make("p", { class: "hint", text: words.values_about }));
  const columns = [["drawn", "now", ({ said }) => said.drawn], ["exact", null, ({ said }) => said.exact]];
  const bound = ["bound", "bound", ({ said }) => said.bound ?? ""];
  return (values, pinned) => place.replaceChildren(valuesTable(values, [...columns, pinned ? pinnedColumn(pinned) : bound], words));
}
