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
  let tours = null, tour = null, place = 0, answered = new Set(), tried = new Set(), timer = 0;
  const seen = new Set();

  // --- all tours -----------------------------------------------------------------------------------------------------------

  function showAll(focused = false) {
    tour = null;
    const seenSaid = ({ id }) => (seen.has(id) ? ` (${wordOf("seen")})` : "");
    const itemOf = (each) => html`<li><button type="button" data-tour=${each.id} @click=${() => start(each)}>
      <b>${letters(each.title)}</b><span>${letters(each.about + seenSaid(each))}</span></button></li>`;
    studio.panel.card(modeCard("tour", html`<h2 id="tours-title" tabindex="-1">${wordOf("tours")}</h2>
      <ul class="tour-list">${tours.map(itemOf)}</ul>`));
    if (focused) focusOn("tours-title");
  }

  function start(each) {
    tour = each;
    answered = new Set();
    go(0);
  }

  // --- a card --------------------------------------------------------------------------------------------------------------

  function go(k) {
    place = k;
    tried.clear();
    const card = tour.cards[k];
    // The view's last step is shown by no name, so that what comes after a change is its last step too.
    studio.load(card.task, tour.name, { view: card.view, step: card.step, part: null, board: false, phi: card.phi, panel: "step" });
    showCard();
    focusOn("card-title");
    studio.announce(`${placeSaid()}. ${card.ask}`);
  }

  const placeSaid = () => wordOf("card_of").replace("{card}", place + 1).replace("{cards}", tour.cards.length);

  function choicesOf({ ask, choices, answer }, isDone) {
    const stateOf = (k) => (isDone ? k === answer && "right" : tried.has(k) && "wrong") || nothing;
    const buttonOf = (choice, k) => html`<button type="button" data-choice=${k} data-state=${stateOf(k)}
      ?disabled=${isDone} @click=${() => choose(k)}>${letters(choice)}</button>`;
    return html`<div class="choices" role="group" aria-label=${ask}>${choices.map(buttonOf)}</div>`;
  }

  // Why the choice that was tried last is not right.
  const wrongSaid = ({ wrong }) => (tried.size ? `${wordOf("not_right")} ${wrong[[...tried].at(-1)]}` : "");

  function showCard(more) {
    const card = tour.cards[place], { choices, goal, ask, why } = card;
    const isDone = answered.has(place), isLast = place === tour.cards.length - 1;
    const told = isDone ? `${wordOf(choices ? "right" : "done_it")} ${why}` : wrongSaid(card);
    const progressOf = (_, k) => html`<i class=${k === place ? "here" : answered.has(k) ? "done" : nothing}></i>`;
    studio.panel.card(modeCard("tour", html`<h2 id="card-title" tabindex="-1">${letters(tour.title)}</h2>
      <p class="hint">${placeSaid()}</p>
      <div class="progress" aria-hidden="true">${tour.cards.map(progressOf)}</div>
      <p class="question">${letters(ask)}</p>
      ${choices ? choicesOf(card, isDone) : nothing}
      ${!isDone && goal ? html`<p class="hint">${wordOf(choices ? "do_it" : "do_it_only")}</p>` : nothing}
      <p id="card-told">${letters(told)}</p>
      <div class="rows">${place > 0 ? modeButton("card-back", "previous_card", () => go(place - 1)) : nothing}${
        modeButton("card-next", isLast ? "finish_tour" : "next_card", on, isDone)}${
        modeButton("tours-all", "all_tours", () => showAll(true))}</div>`), more);
  }

  function on() {
    if (place < tour.cards.length - 1) return go(place + 1);
    seen.add(tour.id);
    showAll(true);
  }

  // --- answers ---------------------------------------------------------------------------------------------------------------

  function choose(k) {
    if (k === tour.cards[place].answer) return answer("right");
    tried.delete(k);
    tried.add(k);
    showCard({ stays: true });
    showTold();
    studio.announce(wrongSaid(tour.cards[place]));
  }

  const showTold = () => document.getElementById("card-told").scrollIntoView({ block: "nearest" });

  function answer(how) {
    answered.add(place);
    const here = document.getElementById("card").contains(document.activeElement);
    showCard();
    if (here) focusOn("card-next");
    showTold();
    studio.announce(`${wordOf(how)} ${tour.cards[place].why}`);
  }

  function changed(names) {
    if (!tour || !(names.includes("task") || names.includes("phi"))) return;
    const { goal } = tour.cards[place], here = place;
    clearTimeout(timer);
    if (!goal || answered.has(place)) return;
    timer = setTimeout(() => {
      if (tour && here === place && isReached(goal, studio.state.get())) answer("done_it");
    }, NOTICED);
  }

  // --- the mode ----------------------------------------------------------------------------------------------------------------

  async function enter() {
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

  return { enter, leave, changed };
})();
