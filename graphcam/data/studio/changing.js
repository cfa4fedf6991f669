// What is changed: by a field, by keys, by a hand that is down; one entry of undo for each.
"use strict";

function changingOf(page) {
  const { state, sizes, last, decimal } = page, now = state.get;

  function change(changes, byKey = false) {
    if (page.hand || now().inert) return;
    const before = now().task;
    if (byKey) state.changeByKey(changes);
    else {
      state.change(changes);
      page.ask(announced(before));
    }
    sizes.follow(changes);
  }

  // Of a handle: sizes, the cam angle or a station.
  function changeAny(changes, byKey = false) {
    const { phi, station, ...ofTask } = changes;
    if (phi !== undefined) state.set({ phi });
    if (station !== undefined) state.set({ station });
    if (Object.keys(ofTask).length) change(ofTask, byKey);
  }

  function travel(way) {
    if (!page.hand && !now().inert) state[way]();
  }

  // --- a hand that is down ----------------------------------------------------------------------------------------------------

  function takeHold() {
    const { task, phi, station } = now();
    state.endBurst();
    page.still();
    page.hand = { before: task, phi, station, hold: last.hold || null, scale: page.scaleOf(page.view()), drag: null };
    document.body.classList.add("held");
  }

  function letGo() {
    const own = page.hand;
    page.hand = null;
    document.body.classList.remove("held");
    return own;
  }

  function grab() {
    if (page.hand || now().inert) return false;
    takeHold();
    return true;
  }

  function drag(to) {
    page.hand.drag = to;
    if (page.turns()) page.turnTo(to.to);
    else page.ask();
  }

  // What a drag came to, as the engine says.
  function follow({ phi, station, ...ofTask }) {
    const { hand } = page;
    if (!hand.drag) return;
    if (phi !== undefined) state.set({ phi });
    if (station !== undefined) state.set({ station });
    state.set({ task: withChanges(hand.before, ofTask) });
    sizes.follow(ofTask);
  }

  function drop(cancelled) {
    if (cancelled) {
      const { before, phi, station } = letGo();
      state.set({ task: before, phi, station });
      page.ask();
    } else if (page.turns()) {
      letGo();
      page.ask();
    } else {
      page.hand.released = true;
      page.ask(comeToRest);
    }
  }

  function comeToRest(answer) {
    const { before } = letGo();
    state.remember(before);
    if (answer.ok) sizes.show(answer.form);
    page.showAll();
    announced(before)();
    page.rest();
  }

  // --- a slider that is moved ---------------------------------------------------------------------------------------------------

  function slide(changes) {
    if (now().inert || page.hand?.drag) return;
    if (!page.hand) {
      takeHold();
      letGoWithThePointer();
    }
    sizes.follow(changes);
    state.set({ task: withChanges(page.hand.before, changes) });
  }

  // A slider that ends where it began tells of no change, and one that is gone from the page tells nothing.
  function letGoWithThePointer() {
    const { hand } = page, ends = ["pointerup", "pointercancel", "blur"];
    const over = () => {
      for (const end of ends) removeEventListener(end, over, true);
      // After what the slider itself still tells.
      setTimeout(() => page.hand === hand && release());
    };
    for (const end of ends) addEventListener(end, over, true);
  }

  function release(cancelled = false) {
    if (!page.hand || page.hand.drag) return;
    const { before } = letGo();
    if (cancelled) state.set({ task: before });
    else state.remember(before);
    page.ask(announced(before));
  }

  // --- what is said of it ---------------------------------------------------------------------------------------------------------

  const phasesSaid = () => (last.form?.find((field) => field.kind === "phases")?.phases || [])
    .map((phase, k) => ({ path: `motion.phases[${k}].angle`, name: `${phase.symbol} ${phase.name}`, unit: "°" }));

  // One sentence when something came to rest.
  const announced = (before) => () => {
    const isMoved = ({ path }) => !alike(valueAt(before, path), valueAt(now().task, path));
    const moved = [...phasesSaid(), ...sizes.fields()].filter(isMoved);
    if (page.failed || !moved.length) return;
    const said = moved.slice(0, 3).map(({ path, name, unit }) => `${name} ${shortNumber(valueAt(now().task, path), decimal())} ${unit}`.trim());
    const found = (last.values || []).filter((value) => /radius|pressure/.test(value.id)).slice(0, 2);
    const warned = (last.warnings || []).slice(0, 1).map((each) => each.text);
    page.announce([...said, ...found.map((value) => `${value.title} ${value.said.drawn}`), ...warned].join(", "));
  };

  return { change, changeAny, travel, grab, drag, follow, drop, slide, release };
}
