// What is changed: by a field, by keys, by a hand that is down; one entry of undo for each.
"use strict";

function changingOf(page) {
  const { state, sizes, last, queue } = page, now = state.get;
  let newest = null;

  // What is wanted is asked of the engine first, and becomes the state with its answer, as one entry of undo: `aim` is made
  // when its turn comes, of the state to which it is a change.  It may be {drag} too, of which the engine says what it is.
  function want(aim, { keys = null, before } = {}) {
    const wanted = { aim, keys, before };
    wanted.job = page.ask(wanted);
    return wanted;
  }

  function change(changes, byKey = false) {
    if (page.hand || now().inert) return;
    sizes.follow(changes);
    const time = performance.now(), all = { ...changes };
    // Keys that come while the engine is at work are one change.
    if (byKey && newest?.keys && queue.isDue(newest.job)) {
      newest.keys.last = time;
      Object.assign(newest.changes, changes);
      return;
    }
    newest = want(() => ({ task: withChanges(now().task, all) }), { keys: byKey ? { first: time, last: time } : null });
    newest.changes = all;
  }

  // Of a handle: sizes, the cam angle or a station.
  function changeAny(changes, byKey = false) {
    const { phi, station, ...ofTask } = changes;
    if (phi !== undefined) state.set({ phi });
    if (station !== undefined) state.set({ station });
    if (Object.keys(ofTask).length) change(ofTask, byKey);
  }

  // What was refused is left first: it stands in its field alone.
  function leave() {
    if (!page.failed && !sizes.refused()) return false;
    page.failed = null;
    sizes.restore();
    page.showAll();
    page.ask();
    return true;
  }

  function travel(way) {
    if (page.hand || now().inert) return;
    queue.after(() => leave() || state[way]());
  }

  function escape() {
    const held = page.heldHands();
    if (held) held.cancel();
    else if (page.hand) release(true);
    else queue.after(() => leave() || state.escapeBurst());
  }

  // --- a hand that is down ----------------------------------------------------------------------------------------------------

  // It is at work on what the page has when it is first asked about: what is wanted before is decided by then.
  function begun(hand) {
    if (!hand.before) Object.assign(hand, { before: state.entry(), phi: now().phi, station: now().station, hold: last.hold || null });
    return hand;
  }

  function takeHold() {
    page.still();
    page.hand = { before: null, scales: Object.fromEntries(page.viewsAsked().map((view) => [view.name, view.px_per_mm])), drag: null, changes: null };
    if (!queue.busy()) begun(page.hand);
    document.body.classList.add("held");
  }

  // What a hand makes of the task at which it took hold.
  function aimOf(hand) {
    const { before, phi, station, drag, changes } = begun(hand);
    return drag && !page.isOwn(drag.handle) ? { task: before.task, drag, phi, station } : { task: changes ? withChanges(before.task, changes) : before.task };
  }

  // It ends with the pointer, not with an answer.
  function letGo(cancelled) {
    const { hand } = page;
    page.hand = null;
    document.body.classList.remove("held");
    if (!cancelled) return Object.assign(want(() => aimOf(hand), { before: () => hand.before }), { changes: hand.changes });
    const { before, phi, station } = hand;
    if (before) state.set({ ...before, phi, station });
    page.failed = null;
    page.ask();
  }

  function grab() {
    if (page.hand || now().inert) return false;
    takeHold();
    return true;
  }

  // The cam angle is moved by the page; what else goes with it is asked for.
  function drag(to) {
    page.hand.drag = to;
    if (page.isOwn(to.handle)) {
      begun(page.hand);
      page.turnTo(to);
      if (!page.showsPlan() && !last.handles.some((handle) => handle.axes[0].path === "phi" && !page.isOwn(handle.id))) return;
    }
    page.ask();
  }

  function drop(cancelled) {
    if (page.isOwn(page.hand.drag?.handle)) page.hand.drag = null;
    letGo(cancelled);
  }

  // --- a slider that is moved: by a pointer that is down, else by keys -----------------------------------------------------------

  const UP = ["pointerup", "pointercancel", "lostpointercapture", "blur"];
  let pressed = false;

  function slide(changes) {
    if (!pressed) return change(changes, true);
    if (now().inert || page.hand?.drag) return;
    if (!page.hand) takeHold();
    page.hand.changes = changes;
    sizes.follow(changes);
    page.ask();
  }

  function release(cancelled = false) {
    if (page.hand?.changes) letGo(cancelled);
  }

  addEventListener("pointerdown", () => (pressed = true), true);
  for (const end of UP) {
    addEventListener(end, ({ type, target }) => {
      if (type === "blur" && target !== window) return;
      // After what the slider itself still tells.
      setTimeout(() => {
        pressed = false;
        release(type === "pointercancel");
      });
    }, true);
  }

  // --- what is said of it ---------------------------------------------------------------------------------------------------------

  function phasesSaid() {
    const { phases = [] } = last.form?.find((field) => field.kind === "phases") || {};
    const isSaid = ({ path }, k) => path.endsWith(".angle") || (k && path.endsWith(".lift"));
    return phases.flatMap(({ symbol, name, fields }, k) => fields.filter((field) => isSaid(field, k)).map((field) => ({ ...field, name: `${symbol} ${name}` })));
  }

  // One sentence when something came to rest.
  function announceChange(before) {
    const isMoved = ({ path }) => !alike(valueAt(before, path), valueAt(now().task, path));
    const moved = [...phasesSaid(), ...sizes.fields()].filter(isMoved);
    if (page.failed || !moved.length) return;
    const said = moved.slice(0, 3).map((field) => sizes.said(field, now().task));
    const found = (last.values || []).filter((value) => /radius|pressure/.test(value.id)).slice(0, 2);
    const warned = (last.warnings || []).slice(0, 1).map((each) => each.text);
    page.announce([...said, ...found.map((value) => `${value.title} ${value.said.drawn}`), ...warned].join(", "));
  }

  return { want, change, changeAny, leave, travel, escape, grab, drag, drop, slide, aimOf, announceChange };
}
