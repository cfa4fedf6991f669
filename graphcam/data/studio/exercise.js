// Exercise: what is given is drawn and no more; answers are typed, and held against salted hashes if there are any.
//
// The hashes hide the key from a look, not from a program, see graphcam/studio/exercise_checks.py: marks are given for
// what is handed in, not here.
"use strict";

// --- right or wrong ------------------------------------------------------------------------------------------------------

// Bits of a hash that are kept, as many as the engine keeps.
const HASH_BITS = 48;

// The hash of the cell that an answer falls into.
async function hashOfAnswer(name, answer, { offset, width }, salt, iterations) {
  const cell = Math.floor((answer - offset) / width);
  const key = await crypto.subtle.importKey("raw", new TextEncoder().encode(`${name}:${cell}`), "PBKDF2", false, ["deriveBits"]);
  const bits = await crypto.subtle.deriveBits({ name: "PBKDF2", hash: "SHA-256", salt, iterations }, key, HASH_BITS);
  return base64Of(new Uint8Array(bits));
}

// By the answers' names {right, hint}, for all that are numbers; without WebCrypto the engine does it.
async function checkAnswers(exercise, given, ask) {
  if (!globalThis.crypto?.subtle) return (await ask({ ask: "exercise", exercise, given })).checked || {};
  const salt = bytesOf(exercise.salt), found = {};
  for (const { name, check } of exercise.answers) {
    if (!check || !(name in given)) continue;
    const hash = await hashOfAnswer(name, given[name], check, salt, exercise.iterations);
    found[name] = { right: hash === check.right, hint: check.hints?.[hash] ?? null };
  }
  return found;
}

// --- the mode ----------------------------------------------------------------------------------------------------------------

studioModes.exercise = (() => {
  // What was typed and what is told of it, by the answers' names.
  let exercise = null, sample = null, typed = {}, told = {}, result = "", checking = false;

  const isChecked = () => exercise.answers.some((asked) => asked.check);

  // What was typed is kept in this browser, by the exercise.
  const key = () =>
    `answers ${exercise.title || ""} ${exercise.salt || JSON.stringify(exercise.answers.map((asked) => asked.text))}`;

  function keep({ target: { name, value } }) {
    typed[name] = value;
    try {
      localStorage.setItem(key(), JSON.stringify(typed));
    } catch { /* a browser may forbid it */ }
  }

  function kept() {
    try {
      return JSON.parse(localStorage.getItem(key()) || "{}");
    } catch {
      return {};
    }
  }

  // --- the card ------------------------------------------------------------------------------------------------------

  function askedOf({ name, text, unit, decimals, drawn }) {
    if (drawn) return html`<li><p>${letters(text)}</p><p class="sentence">${wordOf("draw_it")}</p></li>`;
    const { kind = "", verdict = "", sentence = "" } = told[name] || {};
    return html`<li data-answer=${name}>
      <label><span>${letters(text)}</span><input type="text" inputmode="decimal" name=${name} autocomplete="off"
        aria-describedby="told-${name}" aria-invalid=${kind === "wrong" || nothing} .value=${live(typed[name] ?? "")}>
        <span class="unit">${letters(unit)}</span>
        <span class="hint">${wordOf("decimals").replace("{count}", decimals)}</span></label>
      <p id="told-${name}"><span class="verdict ${kind}">${verdict}</span>
        <span class="sentence">${letters(sentence)}</span></p></li>`;
  }

  function showCard(more) {
    const { title, text, answers } = exercise, checks = isChecked(), name = wordOf("exercise");
    const button = html`<button class="main" id="check" ?disabled=${checking}>${wordOf("check")}</button>`;
    studio.panel.card(html`<form class="mode-card" aria-label=${name} novalidate @submit=${check} @input=${keep}>
      <h2>${letters(title || name)}</h2>
      ${text ? html`<p>${letters(text)}</p>` : nothing}
      <ol class="asked" aria-label=${wordOf("answers")}>${answers.map(askedOf)}</ol>
      ${checks ? html`<div class="rows">${button}</div>` : nothing}
      <p id="checked" role="status">${result}</p>
      <p class="hint">${wordOf(checks ? "practice" : "no_checks")}</p></form>`, more);
  }

  // What was typed, as numbers; what is none is told so.
  function numbersGiven() {
    const written = exercise.answers.filter(({ name, drawn }) => !drawn && typed[name]?.trim());
    const isNumber = ({ name }) => !Number.isNaN(typedNumber(typed[name]));
    const wrong = { kind: "wrong", verdict: wordOf("not_a_number") };
    told = Object.fromEntries(written.filter((asked) => !isNumber(asked)).map(({ name }) => [name, wrong]));
    return Object.fromEntries(written.filter(isNumber).map(({ name }) => [name, typedNumber(typed[name])]));
  }

  async function check(event) {
    event.preventDefault();
    if (checking || !isChecked()) return;
    const given = numbersGiven();
    checking = true;
    showCard({ stays: true });
    try {
      const found = await checkAnswers(exercise, given, studio.ask), all = Object.values(found);
      for (const [name, { right, hint }] of Object.entries(found)) {
        const verdict = wordOf(right ? "answer_right" : "answer_wrong"), sentence = exercise.hints?.[hint] || "";
        told[name] = { kind: right ? "right" : "wrong", verdict, sentence };
      }
      const count = all.filter((each) => each.right).length;
      result = wordOf("checked").replace("{right}", count).replace("{checked}", all.length);
    } finally {
      checking = false;
      showCard({ stays: true });
    }
  }

  // Only what is given is drawn, and nothing tells more.
  function enter() {
    exercise = studio.state.get().exercise ?? sample;
    if (!exercise || !Array.isArray(exercise.answers)) {
      return studio.panel.card(modeCard("exercise", html`<p>${wordOf("no_exercise")}</p>
        <div class="rows">${modeButton("try-exercise", "try_exercise", begin, true)}</div>`));
    }
    studio.state.set({
      upto: exercise.upto || null, inert: true, pin: null, board: false, panel: "step", view: null, step: null, part: null,
      hidden: ["mechanism", "values", "what-if", "warnings", "board"],
    });
    [typed, told, result] = [kept(), {}, ""];
    showCard();
    studio.announce(exercise.title || wordOf("exercise"));
    showLastGiven();
  }

  // The last diagram that is given is what the exercise goes on from.
  async function showLastGiven() {
    const { task, upto } = studio.state.get();
    const { names } = await studio.ask({ ask: "views", language: studio.config.language, task, upto, views: [] });
    if (names?.length && studio.state.get().mode === "exercise") studio.state.set({ view: names.at(-1).name });
  }

  // One about the cam that is shown, for who has none; it is forgotten with the mode.
  async function begin() {
    const answer = await studio.ask({ ask: "sample_exercise", language: studio.config.language, task: studio.state.get().task });
    if (studio.state.get().mode !== "exercise") return;
    sample = answer.exercise;
    if (sample) enter();
    else studio.announce(answer.error.message);
  }

  function leave() {
    sample = null;
    studio.state.set({ upto: null, inert: false, hidden: [] });
  }

  return { enter, leave };
})();
