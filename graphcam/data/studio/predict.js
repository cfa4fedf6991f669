// Predict: an amber mark is moved to where the construction is expected to come; then it answers, step by step.
"use strict";

// Between two steps of the construction [ms].
const STEP_BY_STEP = 550;

studioModes.predict = (() => {
  let studio = null, asked = null, guess = null, round = 0, seed = 0, timer = 0, going = null, kind = null, task = null;
  let watching = false;

  const word = (name) => studio.words[name] ?? name;
  const letter = { centre: "A?", angle: "α?", steepest: "φ?", sharpest: "ρ?" };

  // --- the question -------------------------------------------------------------------------------------------------------

  async function begin(more = {}) {
    const asking = (round += 1);
    stop();
    guess?.remove();
    guess = null;
    const answer = await studio.ask({ ask: "predict", language: studio.config.language, task: studio.state.get().task, kind, ...more });
    if (asking !== round) return;
    if (!answer.ok && kind) {
      kind = null;
      return begin(more);
    }
    if (!answer.ok) return studio.panel.card(make("p", { text: word("nothing_to_predict") }));
    asked = answer;
    kind = answer.kind;
    task = answer.task;
    if (more.seed) await studio.load(answer.task, answer.name);
    if (asking !== round) return;
    hideAnswers();
    guess = guessOf(studio, asked, letter[kind], told);
    showCard();
    studio.announce(asked.question);
  }

  // Only what is given is drawn, and nothing else tells the answer.
  function hideAnswers() {
    const others = (studio.shown.names || []).map((each) => each.name).filter((name) => name !== asked.view);
    studio.state.set({
      view: asked.view, step: null, part: null, board: false, panel: "step", pin: null, inert: true,
      only: [...asked.given], hidden: [...others, "mechanism", "values", "what-if", "warnings", "board"],
    });
  }

  // --- the card ----------------------------------------------------------------------------------------------------------

  function kindsOf() {
    const options = asked.kinds.map((each) => make("option", { value: each.kind, selected: each.kind === kind, text: each.title }));
    return make("label", { class: "kinds" }, make("span", { text: word("predict_what") }), make("select", {
      id: "predict-kind", onchange: ({ target }) => {
        kind = target.value;
        begin();
      },
    }, options));
  }

  function fieldsOf() {
    return guess.axes.map((axis, k) => make("label", { class: "guess-field" }, make("span", { text: axis.name }),
      make("input", { type: "number", step: 0.5, min: Math.ceil(axis.min), max: Math.floor(axis.max), "data-field": k, value: guess.values()[k].toFixed(1), onchange: ({ target }) => {
        const typed = Number(target.value);
        if (target.value !== "" && Number.isFinite(typed)) guess.set(guess.values().map((value, j) => (j === k ? typed : value)));
      } }), make("span", { class: "unit", text: "mm" })));
  }

  // The fields follow the hand.
  function told(values) {
    document.querySelectorAll("#card [data-field]").forEach((field, k) => {
      if (field !== document.activeElement) field.value = values[k].toFixed(1);
    });
  }

  function showCard() {
    studio.panel.card(make("section", { class: "mode-card", "aria-label": word("predict") },
      kindsOf(),
      make("p", { class: "question", text: asked.question }),
      make("p", { class: "hint", text: word("predict_how") }),
      fieldsOf(),
      make("div", { class: "rows" },
        make("button", { type: "button", class: "main", id: "construct", text: word("construct"), onclick: construct }),
        make("button", { type: "button", id: "next-variant", text: word("next_variant"), onclick: nextVariant }))));
  }

  function showJudged({ said, why, paper_said, machine_said, quantity }) {
    studio.panel.card(make("section", { class: "mode-card", "aria-label": word("predict") },
      make("p", { class: "question", text: asked.question }),
      make("p", { class: "said", id: "judged", tabindex: "-1" }, make("strong", { text: said })),
      make("dl", { class: "differences" },
        make("div", {}, make("dt", { text: word("on_paper") }), make("dd", { text: paper_said })),
        machine_said && make("div", {}, make("dt", { text: `${word("of_the_machine")}: ${quantity}` }), make("dd", { text: machine_said }))),
      make("p", { text: why }),
      make("div", { class: "rows" },
        make("button", { type: "button", class: "main", id: "next-variant", text: word("next_variant"), onclick: nextVariant }),
        make("button", { type: "button", id: "try-again", text: word("try_again"), onclick: () => begin() }))));
    document.getElementById("judged").focus({ preventScroll: true });
    studio.announce(`${said} ${why}`);
  }

  // --- the construction --------------------------------------------------------------------------------------------------

  async function construct() {
    const asking = round, [x, y] = guess.place();
    guess.hold(true);
    const answer = await studio.ask({ ask: "predict", language: studio.config.language, task, kind, guess: [x, y] });
    if (asking !== round || !answer.ok) return guess?.hold(false);
    going = { steps: [...answer.construct], judged: answer.judged };
    showGoing();
    next();
  }

  function showGoing() {
    studio.panel.card(make("section", { class: "mode-card", "aria-label": word("predict") },
      make("p", { class: "question", text: asked.question }),
      make("p", { id: "going", role: "status" }),
      make("button", { type: "button", id: "construct-next", text: word("construct_next"), onclick: next })));
    document.getElementById("construct-next").focus({ preventScroll: true });
  }

  function next() {
    clearTimeout(timer);
    if (!going) return;
    const one = going.steps.shift();
    if (!one) return finish();
    const { only, hidden } = studio.state.get();
    studio.state.set({ view: one.view, step: null, part: null, only: [...only, one.step], hidden: hidden.filter((name) => name !== one.view) });
    guess.show();
    lettered(document.getElementById("going"), word("constructing").replace("{step}", one.title));
    timer = setTimeout(next, STEP_BY_STEP);
  }

  function finish() {
    const { judged } = going, at = Object.keys(judged.at), here = studio.state.get().view;
    going = null;
    if (!at.includes(here)) studio.state.set({ view: asked.view, step: null, part: null });
    guess.settle(judged.at);
    showJudged(judged);
  }

  function nextVariant() {
    seed += 1;
    begin({ seed });
  }

  function stop() {
    clearTimeout(timer);
    going = null;
  }

  // While it is constructed the arrow asks for the next step.
  function pressed(event) {
    if (!going || event.key !== "ArrowRight") return;
    event.preventDefault();
    event.stopPropagation();
    next();
  }

  function changed(names) {
    if (!guess) return;
    if (names.includes("task") && studio.state.get().mode === "predict" && JSON.stringify(studio.state.get().task) !== JSON.stringify(task)) begin();
    else guess.show();
  }

  function enter(page) {
    studio = page;
    if (!watching) {
      studio.state.subscribe((names) => changed(names));
      studio.stage.onMove(() => guess?.show());
      watching = true;
    }
    document.body.classList.add("guessing");
    document.addEventListener("keydown", pressed, true);
    begin();
  }

  function leave() {
    round += 1;
    stop();
    guess?.remove();
    guess = null;
    document.body.classList.remove("guessing");
    document.removeEventListener("keydown", pressed, true);
    studio.state.set({ only: null, inert: false, hidden: [], step: null, part: null });
  }

  return { enter, leave };
})();
