// Readings and the pieces of the drawing that they were read off light each other; light and dark; tabs.
"use strict";

// --- a reading and its marks ----------------------------------------------------------------------------------------

// Lines are thin: the nearest piece a few pixels about the pointer is meant too.
const ABOUT = [0, 1.5, 3, 4.5, 6].flatMap((far) => [0, 45, 90, 135, 180, 225, 270, 315].map((degrees) => {
  const angle = degrees * Math.PI / 180;
  return [far * Math.cos(angle), far * Math.sin(angle)];
}));

function pieceNear({ clientX, clientY }) {
  for (const [dx, dy] of ABOUT) {
    const found = document.elementFromPoint(clientX + dx, clientY + dy)?.closest("[data-act]");
    if (found) return found;
  }
  return null;
}

// Readings stand in `words`, those of what is shown in `slide()`; their marks are on `desk`, lit by `point(names)`.
function lightEachOther(words, desk, slide, point) {
  const namesOf = (element) => JSON.parse(element.dataset.lit || "[]");

  function pointFrom(event) {
    const reading = event.target.closest?.("[data-lit]");
    point(reading ? namesOf(reading) : []);
  }
  for (const event of ["pointerover", "focusin"]) words.addEventListener(event, pointFrom);
  words.addEventListener("pointerleave", () => point([]));
  words.addEventListener("focusout", () => point([]));

  function lightReadings(piece) {
    const { act, at: place } = piece?.dataset || {};
    const bears = ([named, places]) =>
      String(named) === act && (!places || place === undefined || places.includes(Number(place)));
    for (const reading of slide().querySelectorAll("[data-lit]")) {
      reading.classList.toggle("lit", Boolean(piece) && namesOf(reading).some(bears));
    }
  }
  desk.addEventListener("pointermove", (event) => event.buttons || lightReadings(pieceNear(event)));
  desk.addEventListener("pointerleave", () => lightReadings(null));
}

// --- steps and their parts ------------------------------------------------------------------------------------------

// Where one comes to from a step and its part, null where it is shown whole; `counts` are the numbers of parts.
function placeAfter([step, part], counts) {
  if (part !== null && part < counts[step] - 1) return [step, part + 1];
  return step < counts.length - 1 ? [step + 1, 0] : [step, part];
}

function placeBefore([step, part], counts) {
  if (part === null && counts[step] > 1) return [step, counts[step] - 1];
  if (part) return [step, part - 1];
  return step ? [step - 1, null] : [step, part];
}

// The parts of a step stand in a list; those of a run in a list of its own, under what is said of all of them.
const itemsOf = (slide) => [...slide.querySelectorAll("[data-part]")];
const runOf = (item) => item?.closest(".run");
// What is said of a place of a run stands in its table in short, and as a whole in the name of its button.
const lineOf = (item) => item.getAttribute("aria-label") ?? item.querySelector(".done-here").textContent;

// What is said of a whole step in parts, where it has no caption of its own.
const wholeOf = (slide) => (slide.querySelector(".caption") ? [] : [...slide.querySelectorAll(".said")].map((said) => said.textContent));

// What is new with a part: a run is told when it begins.
function newsOf(items, part, before) {
  const run = runOf(items[part]), goesOn = run && before !== null && run === runOf(items[before]);
  return [...(run && !goesOn ? [run.querySelector(".said").textContent] : []), lineOf(items[part])];
}

function markParts(items, part) {
  items.forEach((item, k) => {
    item.classList.toggle("later", part !== null && k > part);
    if (k === part) item.setAttribute("aria-current", "step");
    else item.removeAttribute("aria-current");
  });
  for (const item of items) {
    const run = runOf(item);
    if (run && items[items.indexOf(item) - 1]?.closest(".run") !== run) run.classList.toggle("later", item.matches(".later"));
  }
}

// --- light and dark, tabs -------------------------------------------------------------------------------------------

function switchTheme() {
  const dark = document.documentElement.dataset.theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  document.documentElement.dataset.theme = dark === "dark" ? "light" : "dark";
}

// Arrows go from tab to tab of a list; `show` is given the tab.
function tabsOf(list, show) {
  const tabs = () => [...list.querySelectorAll("[role=tab]")].filter((tab) => tab.offsetParent && !tab.disabled);
  list.addEventListener("click", (event) => {
    const tab = event.target.closest("[role=tab]");
    if (tab) show(tab);
  });
  list.addEventListener("keydown", (event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const shown = tabs(), k = shown.indexOf(event.target.closest("[role=tab]"));
    if (!by || k < 0) return;
    event.preventDefault();
    const next = shown[(k + by + shown.length) % shown.length];
    show(next);
    next.focus();
  });
}

function markTab(list, chosen) {
  for (const tab of list.querySelectorAll("[role=tab]")) {
    tab.setAttribute("aria-selected", tab === chosen);
    tab.tabIndex = tab === chosen ? 0 : -1;
  }
}
