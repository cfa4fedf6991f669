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
  let studio = null;

  const word = (name) => studio.words[name] ?? name;
  const rowOf = (name) => document.querySelector(`#card [data-answer="${CSS.escape(name)}"]`);

  function askedOf(asked) {
    if (asked.drawn) return make("li", {}, make("p", { text: asked.text }), make("p", { class: "sentence", text: word("draw_it") }));
    return make("li", { "data-answer": asked.name }, make("label", {}, make("span", { text: asked.text }),
      make("input", { type: "text", inputmode: "decimal", name: asked.name, autocomplete: "off", "aria-describedby": `told-${asked.name}` }),
      make("span", { class: "unit", text: asked.unit }), make("span", { class: "hint", text: word("decimals").replace("{count}", asked.decimals) })),
    make("p", { id: `told-${asked.name}` }, make("span", { class: "verdict" }), " ", make("span", { class: "sentence" })));
  }

  // What was typed is kept in this browser, by the exercise.
  const keyOf = ({ title, salt, answers }) => `answers ${title || ""} ${salt || JSON.stringify(answers.map((asked) => asked.text))}`;
  const fields = () => [...document.querySelectorAll("#card [data-answer] input")];

  function keep(exercise) {
    try {
      localStorage.setItem(keyOf(exercise), JSON.stringify(Object.fromEntries(fields().map((field) => [field.name, field.value]))));
    } catch { /* a browser may forbid it */ }
  }

  function restore(exercise) {
    try {
      const kept = JSON.parse(localStorage.getItem(keyOf(exercise)) || "{}");
      for (const field of fields()) field.value = kept[field.name] ?? "";
    } catch { /* as above */ }
  }

  function showCard(exercise) {
    const checks = exercise.answers.some((asked) => asked.check);
    studio.panel.card(make("form", { class: "mode-card", "aria-label": word("exercise"), novalidate: true, onsubmit: check, oninput: () => keep(exercise) },
      make("h2", { text: exercise.title || word("exercise") }),
      exercise.text && make("p", { text: exercise.text }),
      make("ol", { class: "asked", "aria-label": word("answers") }, exercise.answers.map(askedOf)),
      checks && make("div", { class: "rows" }, make("button", { type: "submit", class: "main", id: "check", text: word("check") })),
      make("p", { id: "checked", role: "status" }),
      make("p", { class: "hint", text: word(checks ? "practice" : "no_checks") })));
  }

  function tell(name, kind, text, sentence = "") {
    const row = rowOf(name), verdict = row.querySelector(".verdict");
    verdict.className = `verdict ${kind}`;
    verdict.textContent = text;
    lettered(row.querySelector(".sentence"), sentence);
    if (kind === "wrong") row.querySelector("input").setAttribute("aria-invalid", "true");
    else row.querySelector("input").removeAttribute("aria-invalid");
  }

  // What was typed, as numbers; what is none is told so.
  function numbersGiven(exercise) {
    const given = {};
    for (const { name, drawn } of exercise.answers) {
      if (drawn) continue;
      const typed = rowOf(name).querySelector("input").value, value = typedNumber(typed);
      tell(name, "", "");
      if (!typed.trim()) continue;
      if (Number.isNaN(value)) tell(name, "wrong", word("not_a_number"));
      else given[name] = value;
    }
    return given;
  }

  async function check(event) {
    event.preventDefault();
    const { exercise } = studio.state.get(), given = numbersGiven(exercise), button = document.getElementById("check");
    if (!button || button.disabled) return;
    button.disabled = true;
    try {
      const found = await checkAnswers(exercise, given, studio.ask);
      for (const [name, { right, hint }] of Object.entries(found)) {
        tell(name, right ? "right" : "wrong", word(right ? "answer_right" : "answer_wrong"), exercise.hints?.[hint] || "");
      }
      const all = Object.values(found);
      document.getElementById("checked").textContent = word("checked").replace("{right}", all.filter((each) => each.right).length).replace("{checked}", all.length);
    } finally {
      button.disabled = false;
    }
  }

  // Only what is given is drawn, and nothing tells more.
  function enter(own) {
    studio = own;
    const { exercise } = studio.state.get();
    if (!exercise || !Array.isArray(exercise.answers)) return studio.panel.card(make("p", { text: word("no_exercise") }));
    studio.state.set({
      upto: exercise.upto || null, inert: true, pin: null, board: false, panel: "step", view: null, step: null, part: null,
      hidden: ["mechanism", "values", "what-if", "warnings", "board"],
    });
    showCard(exercise);
    restore(exercise);
    studio.announce(exercise.title || word("exercise"));
    showLastGiven();
  }

  // The last diagram that is given is what the exercise goes on from.
  async function showLastGiven() {
    const { task, upto } = studio.state.get();
    const { names } = await studio.ask({ ask: "views", language: studio.config.language, task, upto, views: [] });
    if (names?.length && studio.state.get().mode === "exercise") studio.state.set({ view: names.at(-1).name });
  }

  function leave() {
    studio.state.set({ upto: null, inert: false, hidden: [] });
  }

  return { enter, leave };
})();
