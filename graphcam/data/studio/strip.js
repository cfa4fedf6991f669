// The views, small: a strip of them above the drawing, and a board of all of them.
"use strict";

function stripOf(at, open) {
  const cards = { strip: new Map(), board: new Map() };
  let names = [], turned = new Map();

  function cardOf(place, { name, title, short }) {
    const mechanism = name === "mechanism";
    const card = make("button", {
      type: "button", class: "view", "data-open": name, title, "aria-label": title, "data-key": `${place}/${name}`,
      ...(place === "strip" ? { role: "tab", id: `view-${name}`, "aria-controls": "canvas", "aria-selected": "false" } : {}),
    });
    card.picture = drawSvg("svg", mechanism ? "scene" : "page", { "aria-hidden": "true", viewBox: "0 0 1 1" }, card);
    if (!mechanism) card.steps = drawSvg("g", "steps", {}, card.picture);
    card.append(make("span", { text: place === "strip" ? short : title }), make("i"));
    return card;
  }

  function build(found) {
    const same = JSON.stringify(found) === JSON.stringify(names);
    names = found;
    if (same) return;
    for (const place of ["strip", "board"]) {
      cards[place] = new Map(found.map((each) => [each.name, cardOf(place, each)]));
      keepingFocus(at(place), () => at(place).replaceChildren(...cards[place].values()));
    }
    turned = new Map();
  }

  // A view in its small picture, on the strip or on the board; what changed has a point beside it for a while.
  function draw(place, view) {
    const card = cards[place].get(view.name);
    if (!card) return;
    const first = !card.steps.childElementCount, changed = fillSteps(card.steps, view);
    const [, , wide, high] = view.frame, { clientWidth, clientHeight } = card.picture;
    card.picture.setAttribute("viewBox", view.frame.join(" "));
    card.picture.style.setProperty("--pixel", `${Math.max(wide / (clientWidth || 70), high / (clientHeight || 46))}px`);
    if (changed && !first) point(card);
  }

  function point(card) {
    card.classList.add("changed");
    requestAnimationFrame(() => requestAnimationFrame(() => card.classList.remove("changed")));
  }

  function mechanism(data, phi) {
    for (const place of ["strip", "board"]) {
      const card = cards[place].get("mechanism");
      if (!card) continue;
      if (card.data !== data) {
        turned.set(place, mechanismOf(card.picture, data));
        card.picture.setAttribute("viewBox", data.box.join(" "));
        card.data = data;
      }
      const scene = turned.get(place);
      scene.show(scene.placeAt(phi));
    }
  }

  // The view that is large; none is while all are on the board, but one is there for the keys.
  function select(name, beside, boarding, locked) {
    const moved = !boarding && cards.strip.get(name)?.getAttribute("aria-selected") === "false";
    for (const [own, card] of cards.strip) {
      card.setAttribute("aria-selected", own === name && !boarding);
      card.classList.toggle("beside", beside.includes(own));
      card.tabIndex = own === name ? 0 : -1;
      card.disabled = cards.board.get(own).disabled = locked(own);
    }
    if (moved) cards.strip.get(name).scrollIntoView({ block: "nearest", inline: "center" });
  }

  tabsOf(at("strip"), (tab) => open(tab.dataset.open));
  at("board").addEventListener("click", (event) => {
    const card = event.target.closest("[data-open]");
    if (card) open(card.dataset.open);
  });

  // Pixels for a millimetre that a view of this frame gets there.
  function scale(place, name, frame) {
    const picture = cards[place].get(name)?.picture;
    if (!picture || !frame) return place === "board" ? 0.9 : 0.2;
    return Math.min((picture.clientWidth || 70) / frame[2], (picture.clientHeight || 46) / frame[3]);
  }

  return { build, draw, mechanism, select, scale, names: () => names };
}
