// What the page shows of the state and of the last answer.
"use strict";

// So much larger two panes are seen in the other arrangement before it is taken; and how often it is for the same views.
const MUCH_BETTER = 1.2, MOST_CHANGES = 2;

// So wide must a small window be for two panes side by side [pixels].
const SIDE_BY_SIDE = 600;

function pictureOf(page) {
  const { at, word, state, last, strip, sizes } = page, now = state.get;
  let place = "", changes = 0;

  // --- the drawing and its handles ---------------------------------------------------------------------------------------

  // What is drawn in a pane: a view, or several one under another.
  function picture(pane) {
    const views = pane.names().map(pane.gallery.view).filter(Boolean);
    if (pane === page.panes[0]) return page.drawn();
    if (views.length < 2) return views[0];
    if (pane.stack?.parts.length !== views.length || views.some((view, k) => view !== pane.stack.parts[k])) pane.stack = { parts: views, ...stackOf(views) };
    return pane.stack;
  }

  function showDrawing() {
    const names = page.beside();
    at("board").hidden = !now().board;
    document.body.classList.toggle("boarding", now().board);
    document.body.classList.toggle("turnable", page.turns());
    at("all").setAttribute("aria-pressed", now().board);
    for (const id of ["closer", "farther", "fit"]) at(id).disabled = now().board;
    strip.select(page.view(), names, now().board, (each) => now().hidden.includes(each));
    showPanes(names);
    page.panes.forEach(showPane);
    showStep();
    showHands();
  }

  // Side by side or one above the other, as both are seen larger; a hand that is down finds them as they were.  Letters are
  // as high where a view is smaller, so its frame grows, and each arrangement may call for the other: it changes for something
  // much better, and back, and then stays for these views in this window.  Before a view has come what is still there counts.
  function showPanes(names) {
    if (page.hand) return;
    const { clientWidth, clientHeight, dataset } = at("desk"), frames = page.panes.map((pane) => (pane.names().includes("mechanism") ? last.mechanism?.box : picture(pane)?.frame) || pane.stage.whole() || [0, 0, ...pane.usual]);
    const seen = (wide, high) => Math.min(...frames.map(([, , w, h]) => Math.min(wide / w, high / h)));
    const better = { rows: MUCH_BETTER, columns: 1 / MUCH_BETTER }[dataset.split] || 1;
    const split = !names.length ? "" : (page.phone.matches && clientWidth < SIDE_BY_SIDE) || better * seen(clientWidth, clientHeight / 2) > seen(clientWidth / 2, clientHeight) ? "rows" : "columns";
    const here = [clientWidth, clientHeight, ...page.panes.map((pane) => pane.names())].join();
    if (place !== here) [place, changes] = [here, 0];
    if (dataset.split !== split && changes < MOST_CHANGES) {
      changes += 1;
      dataset.split = split;
      for (const pane of page.panes) pane.stage.resized();
    }
    at("panes").setAttribute("aria-pressed", names.length > 0);
    at("panes").disabled = now().board;
    chooseBeside();
  }

  function chooseBeside() {
    const views = page.viewNames().filter(({ name }) => name !== page.view() && !now().hidden.includes(name));
    const more = [["", word("beside_usual")], ["diagrams", word("beside_diagrams")]];
    const all = [...more, ...views.map(({ name, title }) => [name, title])];
    render(options(all, (value) => value === (now().beside ?? "")), at("beside"));
  }

  function showPane(pane, k) {
    const held = Boolean(page.hand), [name] = pane.names(), own = picture(pane);
    if (name === "mechanism") return page.showScene(pane);
    if (!own) return;
    pane.stage.look(own, { held });
    const current = k ? own.order.length - 1 : page.currentStep(), step = own.steps[own.order[current]];
    // A scale that is found by drawing is told from the step on that finds it.
    pane.stage.fill(own, step?.heading || own.title || page.titleOf(name), (!k && step?.title) || "");
    if (!k) pane.stage.show(current, now().part);
  }

  function showHands(handles = last.handles || []) {
    const found = now().board || now().inert ? [] : handles;
    for (const pane of page.panes) {
      const wanted = [...page.handlesIn(pane, found), ...(page.guess && pane === page.panes[0] ? [page.guess.handle] : [])];
      pane.hands.show(wanted);
      pane.hands.away(Boolean(page.failed));
      page.showCursor(pane, wanted);
    }
  }

  // The pinned cam stands behind where it is drawn in these views.
  function showPinned() {
    page.panes.forEach((pane, k) => {
      const names = pane.names(), views = (now().pin && page.pinned?.views.filter((view) => view.pane === k && names.includes(view.name))) || [];
      pane.stage.pin(views.length > 1 ? stackOf(views) : views[0], picture(pane));
    });
  }

  // --- the step ------------------------------------------------------------------------------------------------------------

  function showStep() {
    const own = page.drawn(), k = page.currentStep(), still = page.turns() || k < 0;
    if (still) {
      for (const id of ["slider", "previous", "next"]) at(id).disabled = true;
      showPips(0);
      at("counter").textContent = "";
      if (page.turns()) page.showLive();
      return;
    }
    const step = own.steps[own.order[k]], { part } = now(), parts = page.counts(), last = own.order.length - 1;
    page.stepPanel.show(step, part);
    showPips(own.order.length, k);
    Object.assign(at("slider"), { disabled: false, max: last + 1, value: k + 1 });
    const place = part === null ? word("step_of").replace("{step}", k + 1).replace("{steps}", last + 1)
      : word("part_of").replace("{part}", part + 1).replace("{parts}", parts[k]);
    at("slider").setAttribute("aria-valuetext", `${step.number || ""} ${step.title || ""}, ${place}`);
    at("counter").textContent = `${k + 1}${part === null ? "" : `.${part + 1}`} / ${last + 1}`;
    at("previous").disabled = k === 0 && (part ?? (parts[0] > 1)) == 0;
    at("next").disabled = k === last && (part === null || part === parts[k] - 1);
  }

  function showPips(count, here) {
    const kindOf = (k) => (k === here ? "here" : k < here ? "done" : nothing);
    const pipOf = (_, k) => html`<span data-step=${k} class=${kindOf(k)}></span>`;
    render(Array.from({ length: count }, pipOf), at("pips"));
  }

  // --- the line under the drawing ----------------------------------------------------------------------------------------

  function showStatus() {
    const line = at("told-limits"), found = now().hidden.includes("warnings") ? [] : last.warnings || [], first = found.find((each) => each.limit) || found[0];
    line.className = page.failed || first?.limit ? "over" : first ? "noted" : "kept";
    const more = found.length > 1 ? ` +${found.length - 1}` : "";
    const kept = word(now().hidden.includes("warnings") ? "locked" : "limits_kept");
    render(letters(page.failed || (first ? first.text + more : kept)), line);
    line.title = page.failed || found.map((each) => each.text).join("\n");
    document.body.classList.toggle("stale", Boolean(page.failed));
    showPin();
    at("undo").disabled = now().inert || !(state.past() || page.failed || sizes.refused());
    at("redo").disabled = now().inert || !state.future();
  }

  function showPin() {
    const { pin } = now();
    at("pin").setAttribute("aria-pressed", Boolean(pin));
    for (const name of ["title", "aria-label"]) at("pin").setAttribute(name, word(pin ? "unpin" : "pin"));
    at("told-pin").hidden = !pin;
    if (pin) render(letters(word("pinned_cam").replace("{sizes}", sizesSaid(pin))), at("told-pin"));
  }

  // What of a task differs from the present one, in few words.
  function sizesSaid(task) {
    const own = sizes.fields().filter((field) => !alike(valueAt(task, field.path), valueAt(now().task, field.path)));
    return own.slice(0, 2).map((field) => sizes.said(field, task)).join(", ") || word("now");
  }

  // --- the panels ------------------------------------------------------------------------------------------------------------

  function showPanels() {
    const wide = page.wide.matches, home = wide ? at("sizes-side") : at("panel-sizes");
    if (!home.contains(at("sizes"))) home.append(at("sizes"));
    at("sizes-side").hidden = !wide;
    at("tab-sizes").hidden = wide;
    const shown = wide && now().panel === "sizes" ? "step" : now().panel;
    markTab(at("panels"), at(`tab-${shown}`));
    for (const name of ["sizes", "step", "values", "what-if"]) at(`panel-${name}`).hidden = name !== shown;
    for (const name of ["values", "what-if"]) at(`tab-${name}`).disabled = now().hidden.includes(name);
    at("sizes").inert = now().inert;
    at("all").disabled = at("pin").disabled = now().hidden.includes("board");
    if (shown === "what-if") page.whatIf.update();
  }

  function showValueTables() {
    page.showValues();
    page.whatIf.draw();
  }

  // What changes with every answer, also while a hand is down.
  function showAnswer() {
    showDrawing();
    showPinned();
    showStatus();
    if (now().panel === "what-if") page.whatIf.draw();
  }

  function showAll() {
    showAnswer();
    page.showPhi();
    showPanels();
    showValueTables();
    if (at("builtin")) at("builtin").value = now().name;
    at("task-title").textContent = now().task.title?.name || "";
  }

  // --- notices ---------------------------------------------------------------------------------------------------------------

  function notice(text, more = nothing) {
    at("notice").hidden = !text;
    render(text ? html`<p>${letters(text)}</p>${more}` : nothing, at("notice"));
  }

  const announce = (text) => (at("announcement").textContent = text);

  return { picture, showDrawing, showHands, showPinned, showStatus, showPanels, showValueTables, showAnswer, showAll, notice, announce };
}
