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

  function partsOf(step) {
    if (step.parts.length < 2) return [];
    const items = step.parts.map((part, k) => make("li", {}, make("button", {
      type: "button", "data-part": k, "data-key": `part/${k}`, onclick: () => go(k),
    }, make("span", { class: "done-here", text: part.caption }), part.tools.length > 0 && make("span", { class: "tools-set", text: part.tools.join(" · ") }))));
    return [
      make("div", { class: "part-by-part" }, make("h3", { id: "parts-title", text: words.part_by_part }),
        make("button", { type: "button", class: "whole-step", "data-key": "whole", text: words.whole_step, onclick: () => go(null) })),
      make("ol", { class: "parts", "aria-labelledby": "parts-title" }, items),
    ];
  }

  function articleOf(step) {
    return make("article", {},
      make("p", { class: "chapter", text: step.chapter || "" }),
      step.why && make("p", { class: "purpose", text: step.why }),
      make("h2", {}, make("span", { class: "number", text: step.number || "" }), " ", make("span", { class: "name", text: step.title || "" })),
      make("p", { class: "caption", text: step.caption || "" }),
      step.reason && make("p", { class: "reason" }, make("strong", { text: words.why }), " ", make("span", { text: step.reason })),
      partsOf(step),
      step.readings?.length > 0 && [make("h3", { text: words.readings }), make("dl", {}, step.readings.map((reading) => readingOf(reading, words)))]);
  }

  // The step is told anew only if something else is said of it.
  function show(step, part) {
    const { svg, hash, ...said } = step, news = JSON.stringify(said);
    if (news !== told) keepingFocus(element, () => element.replaceChildren(articleOf(step)));
    told = news;
    element.querySelector(".whole-step")?.setAttribute("aria-pressed", part === null);
    element.querySelectorAll(".parts li").forEach((item, k) => {
      item.classList.toggle("later", part !== null && k > part);
      if (k === part) item.firstElementChild.setAttribute("aria-current", "step");
      else item.firstElementChild.removeAttribute("aria-current");
    });
    if (part) element.querySelectorAll(".parts li")[part]?.scrollIntoView({ block: "nearest" });
  }

  function tell(...elements) {
    told = null;
    element.replaceChildren(...elements);
  }

  return { show, tell };
}

// --- the values -----------------------------------------------------------------------------------------------------------

function valuesTable(values, pinned, words) {
  const other = new Map((pinned || []).map((value) => [value.id, value]));
  const head = ["quantity", "drawn", "exact", pinned ? "pinned" : "bound"];
  return make("table", { class: "compare" },
    make("thead", {}, make("tr", {}, head.map((name) => make("th", { scope: "col", class: name === "pinned" ? "pin" : null, text: words[name] })))),
    make("tbody", {}, values.map((value) => make("tr", {},
      make("th", { scope: "row", text: value.title }),
      make("td", { class: "now", text: value.said.drawn }),
      make("td", { text: value.said.exact }),
      pinned ? make("td", { class: "pin", text: other.get(value.id)?.said.drawn ?? "–" })
        : make("td", { class: "bound", text: value.said.bound ?? "" })))));
}

function valuesPanelOf(element, words) {
  const place = make("div", { class: "scrolled", tabindex: "0", role: "region", "aria-label": words.values });
  element.append(place, make("p", { class: "hint", text: words.values_about }));
  return (values, pinned) => place.replaceChildren(valuesTable(values, pinned, words));
}
