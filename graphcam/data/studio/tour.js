// Tours: cards in the panel with a question, which choosing answers, and doing as well.
"use strict";

// How long a size must have reached a goal before the card notices [ms]: a hand may only pass by.
const NOTICED = 350;

const GOALS = {
  "<=": (size, value) => size <= value + 1e-9, ">=": (size, value) => size >= value - 1e-9,
  "==": (size, value) => Math.abs(size - value) < 1e-9, "<": (size, value) => size < value, ">": (size, value) => size > value,
};

// Whether the state has reached a goal: a size of the task, or the cam angle; what is open has not.
function isReached(goal, { task, phi }) {
  const size = goal.path === "phi" ? phi : valueAt(task, goal.path);
  return typeof size === "number" && GOALS[goal.operator](size, goal.value);
}

studioModes.tour = (() => {
  let studio = null, tours = null, tour = null, place = 0, answered = new Set(), timer = 0, watching = false;
  const seen = new Set();

  const word = (name) => studio.words[name] ?? name;
  const section = (...inside) => make("section", { class: "mode-card", "aria-label": word("tour") }, ...inside);
  const focus = (id) => document.getElementById(id)?.focus({ preventScroll: true });

  // --- all tours -----------------------------------------------------------------------------------------------------------

  function showAll() {
    tour = null;
    const items = tours.map((each) => make("li", {}, make("button", { type: "button", "data-tour": each.id, onclick: () => start(each) },
      make("b", { text: each.title }), make("span", { text: each.about + (seen.has(each.id) ? ` (${word("seen")})` : "") }))));
    studio.panel.card(section(make("h2", { id: "tours-title", tabindex: "-1", text: word("tours") }), make("ul", { class: "tour-list" }, items)));
  }

  function start(each) {
    tour = each;
    answered = new Set();
    go(0);
  }

  // --- a card --------------------------------------------------------------------------------------------------------------

  function go(k) {
    place = k;
    const card = tour.cards[k];
    // The view's last step is shown by no name, so that what comes after a change is its last step too.
    studio.load(card.task, tour.name, { view: card.view, step: card.step, part: null, board: false, phi: card.phi, panel: "step" });
    showCard();
    focus("card-title");
    studio.announce(`${placeSaid()}. ${card.ask}`);
  }

  const placeSaid = () => word("card_of").replace("{card}", place + 1).replace("{cards}", tour.cards.length);

  function progress() {
    return make("div", { class: "progress", "aria-hidden": "true" }, tour.cards.map((_, k) => make("i", {
      class: k === place ? "here" : answered.has(k) ? "done" : null,
    })));
  }

  function choicesOf(card) {
    if (!card.choices) return [];
    const done = answered.has(place);
    const buttons = card.choices.map((choice, k) => make("button", {
      type: "button", "data-choice": k, text: choice, disabled: done, "data-state": done && k === card.answer ? "right" : null, onclick: () => choose(k),
    }));
    return [make("div", { class: "choices", role: "group", "aria-label": card.ask }, buttons)];
  }

  function showCard() {
    const card = tour.cards[place], done = answered.has(place), last = place === tour.cards.length - 1;
    studio.panel.card(section(
      make("h2", { id: "card-title", tabindex: "-1", text: tour.title }),
      make("p", { class: "hint", text: placeSaid() }), progress(),
      make("p", { class: "question", text: card.ask }),
      choicesOf(card),
      !done && card.goal && make("p", { class: "hint", text: word(card.choices ? "do_it" : "do_it_only") }),
      make("p", { id: "card-told", text: done ? `${word(card.choices ? "right" : "done_it")} ${card.why}` : "" }),
      make("div", { class: "rows" },
        place > 0 && make("button", { type: "button", id: "card-back", text: word("previous_card"), onclick: () => go(place - 1) }),
        make("button", { type: "button", class: done ? "main" : null, id: "card-next", text: word(last ? "finish_tour" : "next_card"), onclick: on }),
        make("button", { type: "button", id: "tours-all", text: word("all_tours"), onclick: () => (showAll(), focus("tours-title")) }))));
  }

  function on() {
    if (place < tour.cards.length - 1) return go(place + 1);
    seen.add(tour.id);
    showAll();
    focus("tours-title");
  }

  // --- answers ---------------------------------------------------------------------------------------------------------------

  function choose(k) {
    const card = tour.cards[place];
    if (k === card.answer) return answer("right");
    const button = document.querySelector(`#card [data-choice="${k}"]`);
    button.dataset.state = "wrong";
    document.getElementById("card-told").textContent = word("not_right");
    showTold();
    studio.announce(word("not_right"));
  }

  const showTold = () => document.getElementById("card-told").scrollIntoView({ block: "nearest" });

  function answer(how) {
    answered.add(place);
    const here = document.getElementById("card").contains(document.activeElement);
    showCard();
    if (here) focus("card-next");
    showTold();
    studio.announce(`${word(how)} ${tour.cards[place].why}`);
  }

  function changed(names) {
    if (!tour || studio.state.get().mode !== "tour" || !(names.includes("task") || names.includes("phi"))) return;
    const { goal } = tour.cards[place], here = place;
    clearTimeout(timer);
    if (!goal || answered.has(place)) return;
    timer = setTimeout(() => {
      if (tour && here === place && isReached(goal, studio.state.get())) answer("done_it");
    }, NOTICED);
  }

  // --- the mode ----------------------------------------------------------------------------------------------------------------

  async function enter(page) {
    studio = page;
    if (!watching) studio.state.subscribe(changed);
    watching = true;
    if (!tours) {
      const found = await studio.ask({ ask: "tours", language: studio.config.language });
      if (!found.ok) return;
      ({ tours } = found);
    }
    if (studio.state.get().mode === "tour") showAll();
  }

  function leave() {
    clearTimeout(timer);
    tour = null;
  }

  return { enter, leave };
})();
