// Where one is: the view, what stands beside it, the step in it and its part.
"use strict";

// Beside what moves stand the diagrams over the cam angle, beside a construction that from which it is drawn.
const DIAGRAMS = ["acceleration", "velocity", "displacement", "angle"];
const SOURCES = {
  acceleration: ["mechanism"], velocity: ["acceleration"], displacement: ["velocity"], angle: ["plan"], "arm angles": ["region"],
  curvature: ["profile"], roller: ["arcs"], accelerations: ["plan"], "measured velocity": ["measured displacement"],
  "measured acceleration": ["measured velocity"],
};

function walkOf(page) {
  const { state, large, last, word, config } = page, now = state.get;
  // The steps among which the current one was last seen.
  let order = [];

  const named = (name) => last.names?.some((each) => each.name === name);
  const isThere = (name) => !now().hidden.includes(name) && (name === "mechanism" ? Boolean(last.mechanism) : named(name));
  const mainConstruction = () => ["combined", "region", "profile"].find(named) || last.names?.[0]?.name;
  // Before the first answer it is taken for granted that something moves.
  const usualView = () => (config.opening !== "construction" && (last.names ? isThere("mechanism") : !now().upto) ? "mechanism" : mainConstruction());
  const viewNames = () => [...(last.names || []), ...(last.mechanism ? [{ name: "mechanism", title: word("mechanism"), short: word("mechanism") }] : [])];
  const view = (wanted = now().view) => (wanted === "mechanism" || named(wanted) ? wanted : wanted === "" ? mainConstruction() : usualView());
  const titleOf = (name) => viewNames().find((each) => each.name === name)?.title || "";
  const drawn = () => shownOf(large.view(view()));
  const shownOf = (own) => (own && now().only ? { ...own, order: own.order.filter((id) => now().only.includes(id)) } : own);
  const turns = () => view() === "mechanism";

  // Names of the views beside one, none where it stands alone: as chosen, or as belongs to it.
  function beside(main = view()) {
    const { beside: chosen, board } = now();
    // On a phone a construction has all of the room, until something is chosen.
    if (!main || board || chosen === "" || (chosen === null && page.phone.matches && main !== "mechanism")) return [];
    const there = (names) => names.filter((name) => name !== main && (last.names ? isThere(name) : name !== "mechanism"));
    const wanted = [chosen === "diagrams" ? DIAGRAMS : chosen ? [chosen] : [], SOURCES[main] || DIAGRAMS, DIAGRAMS].map(there);
    return wanted.find((names) => names.length) || [];
  }

  // The step that is shown: that of the state, else the last one.  One that vanished leaves its place to the one before.
  function currentStep() {
    const own = drawn()?.order || [], { step } = now();
    if (step === null || own.includes(step)) return step === null ? own.length - 1 : own.indexOf(step);
    const before = order.slice(0, order.indexOf(step) + 1).findLast((id) => own.includes(id));
    return before ? own.indexOf(before) : own.length - 1;
  }
  const counts = () => drawn().order.map((id) => Math.max(1, drawn().steps[id].parts.length));

  function go(step, part = null) {
    if (!drawn() || turns()) return;
    order = drawn().order;
    const k = Math.max(0, Math.min(order.length - 1, step)), parts = counts()[k];
    const own = part === null || parts === 1 ? null : Math.min(parts - 1, part);
    state.set({ step: k === order.length - 1 && own === null ? null : order[k], part: own });
  }

  const here = () => [currentStep(), now().part];
  const on = () => drawn() && go(...placeAfter(here(), counts()));
  const back = () => drawn() && go(...placeBefore(here(), counts()));
  const wholeOn = () => go(now().part === null ? currentStep() + 1 : currentStep());
  const wholeBack = () => go(currentStep() - 1);

  // What an address says: of the view that moves, too, and of a cam that turns a round angle.
  const place = (more) => {
    const { phi, own, ...shown } = { ...now(), ...more }, first = usualView() === "mechanism" ? "mechanism" : "";
    const withView = (state) => ({ ...state, view: state.view ?? first });
    return { ...withView(shown), own: own && withView(own), phi: Math.round(10 * phi) / 10 };
  };

  function open(name) {
    state.set({ view: name === usualView() ? null : name, step: null, part: null, board: false });
  }

  return { viewNames, view, beside, place, titleOf, drawn, turns, currentStep, counts, go, on, back, wholeOn, wholeBack, open };
}
