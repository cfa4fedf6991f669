// What the engine is asked, and what is done with its answers.
"use strict";

// The small views are drawn when nothing was moved for so long; the address follows as late [ms].
const REST = 120;
// A view is lettered anew if it turns out so much larger or smaller than it was asked for.
const OTHER_SIZE = 1.12;

function askingOf(page) {
  const { at, word, state, queue, large, small, last, stage, strip, sizes } = page, now = state.get;
  const lettered = new Set();
  let round = 0, resting = 0;

  // --- the picture -----------------------------------------------------------------------------------------------------------

  // Pixels for a millimetre; before the first answer about as many as most views get.
  function scaleOf(name) {
    const frame = large.view(name)?.frame;
    return frame ? stage.scale(frame) : Math.min(at("canvas").clientWidth / 190, at("canvas").clientHeight / 180) || 1.5;
  }

  function viewsAsked() {
    const name = page.view();
    if (!name || page.turns() || now().board) return [];
    return [{ name, px_per_mm: page.hand?.scale || scaleOf(name), have: large.have(name) }];
  }

  // At rest all is told; while a hand is down only what is seen of it.
  function pictureRequest() {
    const { task, phi, station, upto, panel } = now(), { hand } = page, held = Boolean(hand && !hand.released);
    return {
      ask: "views", language: page.config.language, upto, views: viewsAsked(), warnings: true,
      ...(hand?.drag ? { task: hand.before, drag: hand.drag, phi: hand.phi, station: hand.station } : { task, phi, station }),
      hold: held ? hand.hold : null, told: !held, form: !held, values: !held || panel === "values",
      mechanism: !last.mechanism || page.turns(),
    };
  }

  function ask(done = () => {}) {
    const question = {};
    const build = () => {
      question.request = pictureRequest();
      question.hand = page.hand;
      return question.request;
    };
    queue.picture(build, (answer) => {
      take(answer, question);
      done(answer);
    });
    rest();
  }

  function take(answer, { request, hand }) {
    if (!answer.ok) return refuse(answer, request);
    page.failed = null;
    page.notice(null);
    // What was not asked for stays what it was.
    for (const key of ["values", "form", "warnings", "mechanism"]) if (request[key]) last[key] = answer[key];
    if (request.mechanism && !request.drag) last.turned = request.task;
    for (const key of ["names", "sizes", "handles", "hold"]) if (answer[key]) last[key] = answer[key];
    Object.assign(page.shown, answer);
    if (hand && request.hold) hand.hold = answer.hold;
    for (const one of answer.views) large.take(one, request.told);
    if (hand && hand === page.hand) page.follow(answer.changes || {});
    strip.build(page.viewNames());
    if (request.form) showForm(answer.form);
    if (request.told) page.showAll();
    else page.showAnswer();
    if (request.values && !request.told) page.showValueTables();
    askAgain(request.views[0]);
  }

  function showForm(form) {
    page.whatIf.offer(form);
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

  // The last good picture stays, paler; the value stays as it was typed.
  function refuse(answer, request) {
    if (answer.lost) return lost();
    const { message, remedy } = answer.error, beside = sizes.showError(answer.error);
    if (!request.drag) state.refuse(request.task);
    if (!beside) page.announce(message);
    page.failed = beside ? word("not_drawn") : [message, remedy].filter(Boolean).join("; ");
    page.shown.error = answer.error;
    page.showAll();
  }

  function lost() {
    writeAddress();
    page.notice(word("lost"), make("button", { type: "button", class: "main", text: word("again"), onclick: () => location.reload() }));
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
    if (!goesOn()) return;
    page.pinned = answer.ok ? { name, values: answer.values, view: answer.views[0] } : null;
    page.showPinned();
    page.showValueTables();
  }

  async function writeAddress() {
    const hash = await page.address.write(now());
    try {
      if (hash && hash !== location.hash) history.replaceState(null, "", hash);
    } catch { /* a page in a frame may not */ }
  }

  return { ask, take, rest, writeAddress, scaleOf };
}
