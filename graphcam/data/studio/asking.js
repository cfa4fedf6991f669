// What the engine is asked, and what is done with its answers.
"use strict";

// The small views are drawn when nothing was moved for so long; the address follows as late [ms].
const REST = 120;
// A view is lettered anew if it turns out so much larger or smaller than it was asked for.
const OTHER_SIZE = 1.12;

function askingOf(page) {
  const { at, config, word, state, queue, large, small, last, stage, strip, sizes } = page, now = state.get;
  const lettered = new Set();
  let round = 0, resting = 0, unanswered = null;

  // --- the picture -----------------------------------------------------------------------------------------------------------

  // Pixels for a millimetre; before the first answer about as many as most views get.
  function scaleOf(name) {
    const frame = large.view(name)?.frame;
    return frame ? stage.scale(frame) : Math.min(at("canvas").clientWidth / 190, at("canvas").clientHeight / 180) || 1.5;
  }

  // Letters grow with the stage: on a phone they can just be read, on a projector from afar [pixels].
  const letterHeight = () => Math.round(Math.max(10, Math.min(24, at("canvas").clientWidth / 66, at("canvas").clientHeight / 50)));

  function viewsAsked(aim = {}) {
    const name = page.view(aim.view);
    if (!name || page.turns() || now().board) return [];
    return [{ name, px_per_mm: page.hand?.scale || scaleOf(name), letter_px: letterHeight(), have: aim.forget ? {} : large.have(name) }];
  }

  // At rest all is told; while a hand is down only what is seen of it.
  function pictureRequest(aim, hand) {
    const { task, phi, station, upto, panel } = { ...now(), ...aim };
    return {
      ask: "views", language: page.config.language, upto, views: viewsAsked(aim), task, phi, station,
      ...(aim.drag && { drag: aim.drag }),
      hold: hand ? hand.hold : null, told: !hand, form: !hand, warnings: !hand, values: !hand || panel === "values",
      mechanism: !last.mechanism || page.turns(),
    };
  }

  // The picture of the state, of what a hand that is down makes of it, or of what is wanted of it, see changing.js.
  function ask(wanted = null) {
    const question = { wanted };
    const request = () => {
      question.hand = wanted ? null : page.hand;
      question.aim = wanted ? wanted.aim() : page.hand ? page.aimOf(page.hand) : {};
      question.request = pictureRequest(question.aim, question.hand);
      return question.request;
    };
    rest();
    return queue[wanted ? "change" : "picture"](request, (answer) => take(answer, question));
  }

  function take(answer, question) {
    const { request, hand, aim, wanted } = question;
    // What a hand asked that has let go is asked again.
    if (hand && hand !== page.hand) return;
    if (!answer.ok) return refuse(answer, question);
    if (wanted || hand?.changes || !sizes.refused()) page.failed = null;
    page.notice(null);
    unanswered = null;
    if (aim.forget) page.forget();
    // What was not asked for stays what it was.
    for (const key of ["values", "form", "warnings", "mechanism"]) if (request[key]) last[key] = answer[key];
    if (request.mechanism && !request.drag) last.turned = request.task;
    for (const key of ["names", "sizes", "handles", "hold"]) if (answer[key]) last[key] = answer[key];
    Object.assign(page.shown, answer);
    page.shown.error = null;
    if (hand && request.hold) hand.hold = answer.hold;
    for (const one of answer.views) large.take(one, request.told);
    accept(answer, question);
    strip.build(page.viewNames());
    if (request.form) showForm(answer);
    if (request.told) page.showAll();
    else page.showAnswer();
    if (request.values && !request.told) page.showValueTables();
    askAgain(request.views[0]);
  }

  // What was drawn is the state.
  function accept({ changes = {} }, { aim: { drag, forget, ...aim }, wanted }) {
    const before = wanted?.before?.() || state.entry(), { phi, station, ...ofTask } = changes;
    if (drag) {
      Object.assign(aim, { task: withChanges(aim.task, ofTask) }, phi !== undefined && { phi }, station !== undefined && { station });
      sizes.follow(ofTask);
    }
    page.accepting = true;
    state.set(aim);
    page.accepting = false;
    if (!wanted) return;
    state.remember(before, wanted.keys);
    wanted.done?.(true);
    if (!forget) queueMicrotask(() => page.announceChange(before.task));
  }

  function showForm({ form, swept = [] }) {
    page.whatIf.offer(swept);
    // Of inert sizes those that the task gives: what was found is an answer.
    if (!page.hand) sizes.show(now().inert ? form.filter((field) => field.value !== null) : form);
  }

  // The first answer says which views there are, and a later one that there are others; and a frame may turn out another one than was thought.
  function askAgain(asked) {
    const own = asked && large.view(asked.name), frame = own?.frame.join();
    if (!own) {
      if (page.view() && !page.turns() && !now().board && !page.drawn()) ask();
      return;
    }
    const ratio = page.hand || lettered.has(frame) ? 1 : stage.scale(own.frame) / asked.px_per_mm;
    if (ratio < OTHER_SIZE && ratio > 1 / OTHER_SIZE) return;
    lettered.add(frame);
    ask();
  }

  // The last good picture stays, paler, and so does the state; the value stays in its field as it was typed.
  function refuse(answer, { aim, wanted, hand }) {
    if (answer.lost) return lost(answer, aim, wanted);
    const { message, remedy } = answer.error, said = [message, remedy].filter(Boolean).join("; ");
    const beside = !aim.forget && sizes.showError(answer.error, Object.keys(wanted?.changes || hand?.changes || {}));
    if (!beside) page.announce(said);
    page.failed = beside ? word("not_drawn") : said;
    page.shown.error = answer.error;
    page.showAll();
    wanted?.done?.(false);
    rest();
    // An address, a file: there is no field for it, and what was there is drawn.
    if (aim.forget && !page.drawn()) ask();
  }

  // No answer: it is asked for again, and what was wanted is kept in the address.
  function lost({ error }, aim, wanted) {
    const before = Boolean(unanswered);
    unanswered = aim && !aim.drag ? aim : {};
    writeAddress();
    page.failed = word("lost");
    page.showStatus();
    const again = () => (config.transport === "server" ? ask(wanted) : location.reload());
    page.notice([word("lost"), error.message, before && word("ended")].filter(Boolean).join(" "), make("button", { type: "button", class: "main", text: word("again"), onclick: again }));
  }

  // --- at rest: the address, the small views, the pinned cam ------------------------------------------------------------------

  function rest() {
    round += 1;
    clearTimeout(resting);
    const later = () => {
      if (page.hand || page.turning()) return;
      if (queue.busy()) resting = setTimeout(later, REST);
      else drawSmall(round);
    };
    resting = setTimeout(later, REST);
  }

  async function drawSmall(own) {
    const { task, phi, upto } = now(), base = { ask: "views", language: page.config.language, task, phi, upto, told: false, hold: null };
    const goesOn = () => own === round && !page.failed;
    writeAddress();
    if (!goesOn()) return;
    if (last.turned !== task) await askMechanism(base, goesOn);
    if (goesOn()) await drawPinned(goesOn);
    // What was drawn of this task stays.
    const place = now().board ? "board" : "strip", isDrawn = (name) => small[place].view(name)?.of === `${upto} ${JSON.stringify(task)}`;
    for (const { name } of last.names.filter((each) => !now().hidden.includes(each.name))) {
      if (goesOn() && !isDrawn(name)) await drawOne(place, name, base, goesOn);
    }
  }

  async function askMechanism(base, goesOn) {
    const answer = await queue.question({ ...base, views: [], mechanism: true });
    if (!goesOn() || !answer.ok) return;
    Object.assign(last, { mechanism: answer.mechanism ?? null, turned: base.task });
    strip.build(page.viewNames());
    page.showPhi();
    if (page.turns()) page.showDrawing();
  }

  async function drawOne(place, name, base, goesOn) {
    const gallery = small[place], frame = (gallery.view(name) || small.strip.view(name))?.frame;
    const views = [{ name, px_per_mm: strip.scale(place, name, frame), have: gallery.have(name) }];
    const answer = await queue.question({ ...base, views });
    if (!goesOn() || !answer.ok) return;
    for (const one of answer.views) strip.draw(place, gallery.take({ ...one, of: `${base.upto} ${JSON.stringify(base.task)}` }, false));
  }

  async function drawPinned(goesOn) {
    const { pin, phi } = now(), name = page.view(), views = viewsAsked().map((view) => ({ ...view, have: {} }));
    if (!pin) return;
    // With the scales of the present cam, or the two could not be compared.
    const answer = await queue.question({ ask: "views", language: page.config.language, task: pin, phi, views, values: true, told: false, hold: last.hold });
    if (!goesOn() || answer.lost) return;
    // What cannot be drawn cannot be pinned.
    if (!answer.ok) return state.set({ pin: null });
    page.pinned = { name, values: answer.values, view: answer.views[0] };
    page.showPinned();
    page.showValueTables();
  }

  async function writeAddress() {
    const hash = await page.address.write({ ...now(), ...unanswered });
    try {
      if (hash && hash !== location.hash) history.replaceState(null, "", hash);
    } catch { /* a page in a frame may not */ }
  }

  return { ask, take, rest, writeAddress, scaleOf };
}
