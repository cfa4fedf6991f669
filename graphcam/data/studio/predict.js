// Predict: an amber mark is moved to where the construction is expected to come; then it answers, step by step.
"use strict";

// Between two steps of the construction [ms].
const STEP_BY_STEP = 550;

studioModes.predict = (() => {
  let asked = null, guess = null, round = 0, seed = 0, timer = 0, going = null, kind = null, task = null;
  let judged = null;

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
    if (!answer.ok) return studio.panel.card(html`<p>${wordOf("nothing_to_predict")}</p>`);
    asked = answer;
    kind = answer.kind;
    task = answer.task;
    if (more.seed) await studio.load(answer.task, answer.name);
    if (asking !== round) return;
    hideAnswers();
    judged = null;
    guess = guessOf(studio, asked, letter[kind], () => guess && showCard({ stays: true }));
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

  function fieldOf({ name, min, max }, k) {
    const values = guess.values();
    const typed = ({ target: { value } }) => value && guess.set(values.with(k, Number(value)));
    return html`<label class="guess-field"><span>${name}</span>
      <input type="number" step="0.5" min=${Math.ceil(min)} max=${Math.floor(max)} data-field=${k}
        .value=${live(values[k].toFixed(1))} @change=${typed}><span class="unit">${wordOf("mm")}</span></label>`;
  }

  function askedOf() {
    const chosen = ({ target }) => {
      kind = target.value;
      begin();
    };
    const kinds = options(asked.kinds.map((each) => [each.kind, each.title]), (each) => each === kind);
    return html`<label class="kinds"><span>${wordOf("predict_what")}</span>
        <select id="predict-kind" @change=${chosen}>${kinds}</select></label>
      <p class="question">${letters(asked.question)}</p>
      <p class="hint">${wordOf("predict_how")}</p>
      ${guess.axes.map(fieldOf)}
      <div class="rows">${modeButton("construct", "construct", construct, true)}${
        modeButton("next-variant", "next_variant", nextVariant)}</div>`;
  }

  const goingOf = ({ title }) => html`<p class="question">${letters(asked.question)}</p>
    <p id="going" role="status">${letters(wordOf("constructing").replace("{step}", title))}</p>
    ${modeButton("construct-next", "construct_next", next)}`;

  const rowOf = (name, text) => html`<div><dt>${letters(name)}</dt><dd>${text}</dd></div>`;
  const judgedOf = ({ said, why, paper_said, machine_said, quantity }) => html`
    <p class="question">${letters(asked.question)}</p>
    <p class="said" id="judged" tabindex="-1"><strong>${letters(said)}</strong></p>
    <dl class="differences">${rowOf(wordOf("on_paper"), paper_said)}${
      machine_said ? rowOf(`${wordOf("of_the_machine")}: ${quantity}`, machine_said) : nothing}</dl>
    <p>${letters(why)}</p>
    <div class="rows">${modeButton("next-variant", "next_variant", nextVariant, true)}${
      modeButton("try-again", "try_again", () => begin())}</div>`;

  function showCard(more) {
    const inside = going ? goingOf(going) : judged ? judgedOf(judged) : askedOf();
    studio.panel.card(modeCard("predict", inside), more);
  }

  // --- the construction --------------------------------------------------------------------------------------------------

  async function construct() {
    const asking = round, [x, y] = guess.place();
    guess.hold(true);
    const answer = await studio.ask({ ask: "predict", language: studio.config.language, task, kind, guess: [x, y] });
    if (asking !== round || !answer.ok) return guess?.hold(false);
    going = { steps: [...answer.construct], judged: answer.judged, title: "" };
    next();
    showCard();
    focusOn("construct-next");
  }

  function next() {
    clearTimeout(timer);
    if (!going) return;
    const one = going.steps.shift();
    if (!one) return finish();
    const { only, hidden } = studio.state.get();
    studio.state.set({ view: one.view, step: null, part: null, only: [...only, one.step], hidden: hidden.filter((name) => name !== one.view) });
    guess.show();
    going.title = one.title;
    showCard({ stays: true });
    timer = setTimeout(next, STEP_BY_STEP);
  }

  function finish() {
    ({ judged } = going);
    going = null;
    if (!(studio.state.get().view in judged.at)) studio.state.set({ view: asked.view, step: null, part: null });
    guess.settle(judged.at);
    showCard();
    focusOn("judged");
    studio.announce(`${judged.said} ${judged.why}`);
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
    if (names.includes("task") && !alike(studio.state.get().task, task)) begin();
    else guess.show();
  }

  function enter() {
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

  return { enter, leave, changed };
})();
