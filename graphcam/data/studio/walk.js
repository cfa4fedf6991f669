// Where one is: the view, the step in it and its part.
"use strict";

function walkOf(page) {
  const { state, large, last, word } = page, now = state.get;
  // The steps among which the current one was last seen.
  let order = [];

  const named = (name) => last.names?.some((each) => each.name === name);
  const usualView = () => ["combined", "region", "profile"].find(named) || last.names?.[0]?.name;
  const viewNames = () => [...(last.names || []), ...(last.mechanism ? [{ name: "mechanism", title: word("mechanism"), short: word("mechanism") }] : [])];
  const view = (wanted = now().view) => (wanted === "mechanism" || named(wanted) ? wanted : usualView());
  const titleOf = (name) => viewNames().find((each) => each.name === name)?.title || "";
  const drawn = () => shownOf(large.view(view()));
  const shownOf = (own) => (own && now().only ? { ...own, order: own.order.filter((id) => now().only.includes(id)) } : own);
  const turns = () => view() === "mechanism";

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

  function open(name) {
    state.set({ view: name === usualView() ? null : name, step: null, part: null, board: false });
  }

  return { viewNames, view, titleOf, drawn, turns, currentStep, counts, go, on, back, wholeOn, wholeBack, open };
}
