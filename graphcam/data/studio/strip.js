// The views, small: a strip of them above the drawing, and a board of all of them.
"use strict";

function stripOf({ at, open }) {
  const PLACES = ["strip", "board"];
  let names = [], shown = { beside: [], locked: () => false }, brought = null;

  const cardAt = (place, name) => at(place).querySelector(`[data-open="${name}"]`);
  const pictureAt = (place, name) => cardAt(place, name)?.querySelector("svg");

  // What is drawn in a card stays there.
  function cardOf(place, { name, title, short }) {
    const { view, beside, boarding, locked } = shown, isTab = place === "strip", isLarge = name === view;
    return html`<button type="button" class="view${isTab && beside.includes(name) ? " beside" : ""}" data-open=${name}
      data-key="${place}/${name}" title=${title} aria-label=${title} ?disabled=${locked(name)}
      id=${isTab ? `view-${name}` : nothing} role=${isTab ? "tab" : nothing} aria-controls=${isTab ? "canvas" : nothing}
      aria-selected=${isTab ? isLarge && !boarding : nothing} tabindex=${isTab ? isLarge - 1 : nothing}>
      <svg class=${name === "mechanism" ? "scene" : "page"} aria-hidden="true" viewBox="0 0 1 1"></svg>
      <span>${letters(isTab ? short : title)}</span><i></i></button>`;
  }

  function show() {
    for (const place of PLACES) render(repeat(names, ({ name }) => name, (each) => cardOf(place, each)), at(place));
  }

  function build(found) {
    if (!alike(found, names)) brought = null;
    names = found;
    show();
  }

  // A view in its small picture, on the strip or on the board; what changed has a point beside it for a while.
  function draw(place, view) {
    const picture = pictureAt(place, view.name);
    if (!picture) return;
    const isFirst = !picture.childElementCount, steps = picture.firstElementChild || drawSvg("g", "steps", {}, picture);
    const changed = fillSteps(steps, view), [, , wide, high] = view.frame, { clientWidth, clientHeight } = picture;
    picture.setAttribute("viewBox", view.frame.join(" "));
    picture.style.setProperty("--pixel", `${Math.max(wide / (clientWidth || 70), high / (clientHeight || 46))}px`);
    if (changed && !isFirst) point(cardAt(place, view.name));
  }

  function point(card) {
    card.classList.add("changed");
    requestAnimationFrame(() => requestAnimationFrame(() => card.classList.remove("changed")));
  }

  function mechanism(data, phi) {
    for (const picture of PLACES.map((place) => pictureAt(place, "mechanism")).filter(Boolean)) {
      if (picture.turned?.data !== data) {
        picture.turned = { data, ...mechanismOf(picture, data) };
        picture.setAttribute("viewBox", data.box.join(" "));
      }
      picture.turned.show(picture.turned.placeAt(phi));
    }
  }

  // The view that is large; none is while all are on the board, but one is there for the keys.
  function select(view, beside, boarding, locked) {
    shown = { view, beside, boarding, locked };
    show();
    if (!boarding && brought !== view) cardAt("strip", view)?.scrollIntoView({ block: "nearest", inline: "center" });
    brought = boarding ? null : view;
  }

  tabsOf(at("strip"), (tab) => open(tab.dataset.open));
  at("board").addEventListener("click", (event) => {
    const card = event.target.closest("[data-open]");
    if (card) open(card.dataset.open);
  });

  // Pixels for a millimetre that a view of this frame gets there.
  function scale(place, name, frame) {
    const picture = pictureAt(place, name);
    if (!picture || !frame) return place === "board" ? 0.9 : 0.2;
    return Math.min((picture.clientWidth || 70) / frame[2], (picture.clientHeight || 46) / frame[3]);
  }

  return { build, draw, mechanism, select, scale, names: () => names };
}
