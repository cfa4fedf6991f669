// What the engine is asked, and what is done with its answers.
"use strict";

// The small views are drawn when nothing was moved for so long; the address follows as late [ms].
const REST = 120;
// The engine letters for no more pixels for a millimetre: a drawing of which little could be found is small.
const MOST_SCALE = 40;
// A view is lettered anew if it turns out so much larger or smaller than it was asked for.
const OTHER_SIZE = 1.12;

function askingOf(page) {
  const { config, word, state, queue, small, last, strip, sizes } = page, now = state.get;
  const lettered = new Set();
  let round = 0, resting = 0, unanswered = null, told = true;

  // --- the picture -----------------------------------------------------------------------------------------------------------

  // Pixels for a millimetre; before the first answer about as many as most views get.
  function scaleOf({ stage, usual }, picture) {
    const scale = picture ? stage.scale(picture) : Math.min(...stage.size().map((each, k) => each / usual[k]));
    // A pane that is not shown yet has no size.
    return scale < 0.01 ? 1.5 : Math.min(MOST_SCALE, scale);
  }

  // Letters grow with the stage: on a phone they can just be read, on a projector from afar [pixels].
  function letterHeight({ stage, letters }) {
    const [wide, high] = stage.size();
    return Math.round(Math.max(10, Math.min(24, wide / letters, high / 36)));
  }

  // Several views in one pane stand there without their construction.
  function viewsAsked(aim = {}) {
    const main = page.view(aim.view), { scales } = page.hand || {};
    if (now().board) return [];
    return page.panes.flatMap((pane, k) => {
      const names = pane.names(main).filter((name) => name && name !== "mechanism"), scale = scaleOf(pane, page.picture(pane)), letters = letterHeight(pane);
      return names.map((name) => ({
        name, pane: k, plain: names.length > 1, px_per_mm: scales?.[name] || scale, letter_px: letters, have: aim.forget ? {} : pane.gallery.have(name),
      }));
    });
  }

  // At rest all is told; while a hand is down only what is seen of it.
  function pictureRequest(aim, hand) {
    const { task, phi, station, upto, panel } = { ...now(), ...aim };
    return {
      ask: "views", language: page.config.language, upto, views: viewsAsked(aim), task, phi, station,
      ...(aim.drag && { drag: aim.drag }),
      hold: hand ? hand.hold : null, told: !hand, form: !hand, warnings: !hand, values: !hand || panel === "values" || panel === "what-if",
      mechanism: !last.mechanism || page.panes.some((pane) => pane.names().includes("mechanism")),
    };
  }

  // The picture of the state, of what a hand that is down makes of it, or of what is wanted of it, see changing.js;
  // `failing` where it is that of before what has just been refused.
  function ask(wanted = null, failing = false) {
    const question = { wanted, failing };
    const request = () => {
      question.hand = wanted ? null : page.hand;
      question.aim = wanted ? wanted.aim() : page.hand ? page.aimOf(page.hand) : {};
      question.place = question.hand && page.placeOf(question.hand);
      question.request = pictureRequest(question.aim, question.hand);
      return question.request;
    };
    rest();
    if (page.hand && !wanted) page.goAlong();
    return queue[wanted ? "change" : "picture"](request, (answer) => take(answer, question));
  }

  function take(answer, question) {
    const { request, hand, aim, wanted } = question;
    // What a hand asked that has let go is asked again.
    if (hand && hand !== page.hand) return;
    if (!answer.ok) return refuse(answer, question);
    told = request.told;
    if (!question.failing && (wanted || hand?.changes || !sizes.refused())) page.failed = null;
    page.notice(null);
    unanswered = null;
    if (aim.forget) page.forget();
    // What was not asked for stays what it was.
    for (const key of ["values", "form", "warnings", "mechanism"]) if (request[key]) last[key] = answer[key];
    if (request.mechanism && !request.drag) last.turned = request.task;
    for (const key of ["names", "sizes", "handles", "hold", "degrees_per_mm", "stations"]) if (answer[key]) last[key] = answer[key];
    Object.assign(page.shown, answer);
    page.shown.error = null;
    if (hand && request.hold) hand.hold = answer.hold;
    for (const one of answer.views) page.panes[request.views.find(({ name }) => name === one.name)?.pane ?? 0].gallery.take(one, request.told);
    accept(answer, question);
    strip.build(page.viewNames());
    if (request.form) showForm(answer);
    if (request.told) page.showAll();
    else page.showAnswer();
    if (hand) page.arrived(hand, question.place);
    if (request.values && !request.told) page.showValueTables();
    page.answered?.();
    askAgain(request.views);
  }

  // What was drawn is the state.
  function accept({ changes = {} }, { aim: { drag, forget, ...aim }, wanted }) {
    const before = wanted?.before?.() || state.entry(), { phi, station, ...ofTask } = changes;
    if (drag) {
      Object.assign(aim, { task: withChanges(aim.task, ofTask) }, phi !== undefined && { phi }, station !== undefined && { station });
      // Where the cam is turned by it the plan goes on to another station, see followPlan.
      if (phi !== undefined && station === undefined) delete aim.station;
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
    if (page.hand) return;
    const wanted = viewsAsked(), isNew = ({ name, pane }) => !asked.some((each) => each.name === name && each.pane === pane);
    for (const view of wanted) {
      const before = asked.find(({ name, pane }) => name === view.name && pane === view.pane), ratio = view.px_per_mm / (before?.px_per_mm ?? NaN);
      const frame = `${view.name} ${page.picture(page.panes[view.pane])?.frame}`;
      if (!isNew(view) && (lettered.has(frame) || (ratio < OTHER_SIZE && ratio > 1 / OTHER_SIZE))) continue;
      lettered.add(frame);
      return ask();
    }
  }

  // The last good picture stays, paler, and so does the state; the value stays in its field as it was typed.
  function refuse(answer, { aim, wanted, hand, failing }) {
    if (answer.lost) return lost(answer, aim, wanted);
    const { message, remedy } = answer.error, said = [message, remedy].filter(Boolean).join("; ");
    const beside = !aim.forget && sizes.showError(answer.error, Object.keys(wanted?.changes || hand?.changes || {}));
    if (!beside) page.announce(said);
    page.failed = beside ? word("not_drawn") : said;
    page.shown.error = answer.error;
    page.goBack();
    page.showAll();
    wanted?.done?.(false);
    rest();
    // An address, a file: there is no field for it, and what was there is drawn.
    if (aim.forget && !page.drawn()) ask();
    // What a hand made of it before the refusal is the state, and was drawn without its words and values.
    else if (!told && !page.hand && !failing) ask(null, true);
  }

  // No answer: it is asked for again, and what was wanted is kept in the address.
  function lost({ error }, aim, wanted) {
    const before = Boolean(unanswered);
    unanswered = aim && !aim.drag ? aim : {};
    writeAddress();
    page.failed = word("lost");
    page.showStatus();
    const again = () => (config.transport === "server" ? ask(wanted) : location.reload());
    const button = html`<button type="button" class="main" @click=${again}>${word("again")}</button>`;
    page.notice([word("lost"), error.message, before && word("ended")].filter(Boolean).join(" "), button);
  }

  // --- at rest: the address, the small views, the pinned cam ------------------------------------------------------------------

  function rest() {
    const own = ++round;
    clearTimeout(resting);
    const later = () => {
      // A hand that lets go asks, and so comes back here.
      if (page.hand) resting = 0;
      else if (queue.busy()) resting = setTimeout(later, REST);
      else drawSmall(own).finally(() => own === round && (resting = 0));
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
    page.showDrawing();
  }

  async function drawOne(place, name, base, goesOn) {
    const gallery = small[place], frame = (gallery.view(name) || small.strip.view(name))?.frame;
    const views = [{ name, px_per_mm: strip.scale(place, name, frame), have: gallery.have(name) }];
    const answer = await queue.question({ ...base, views });
    if (!goesOn() || !answer.ok) return;
    for (const one of answer.views) strip.draw(place, gallery.take({ ...one, of: `${base.upto} ${JSON.stringify(base.task)}` }, false));
  }

  async function drawPinned(goesOn) {
    const { pin, phi } = now(), views = viewsAsked().map((view) => ({ ...view, have: {} }));
    if (!pin) return;
    // With the scales of the present cam, or the two could not be compared.
    const answer = await queue.question({ ask: "views", language: page.config.language, task: pin, phi, views, values: true, told: false, hold: last.hold });
    if (!goesOn() || answer.lost) return;
    // What cannot be drawn cannot be pinned.
    if (!answer.ok) return state.set({ pin: null });
    page.pinned = { views: answer.views.map((view) => ({ ...view, pane: views.find(({ name }) => name === view.name).pane })), values: answer.values };
    page.showPinned();
    page.showValueTables();
  }

  async function writeAddress() {
    const hash = await page.address.write(page.place(unanswered));
    try {
      if (hash && hash !== location.hash) history.replaceState(null, "", hash);
    } catch { /* a page in a frame may not */ }
  }

  return { ask, take, rest, writeAddress, viewsAsked, isResting: () => !resting };
}
