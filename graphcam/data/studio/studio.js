// The studio: its parts put together, what follows a change of the state, keys and modes.
"use strict";
(async () => {
  const config = JSON.parse(document.getElementById("config").textContent);
  const { words } = config;
  const at = (id) => document.getElementById(id);
  const word = (name) => words[name] ?? name;
  const phone = matchMedia("(max-width: 51.99rem)");

  const state = stateOf({
    name: config.name, task: config.task, view: config.view ?? null, beside: config.beside ?? null, swept: null, step: null, part: null, phi: USUAL_PHI, station: null, colour: null,
    pin: null, mode: "play", panel: phone.matches ? "sizes" : "step", board: false,
    // For the modes: the last construction that is shown, whether sizes are moved, which views and panels are locked.
    upto: config.exercise?.upto || null, inert: false, hidden: [],
    // Which steps are shown, all if null; and what is asked of a student.
    only: null, exercise: config.exercise,
    // In a mode that shows other tasks: what the person was at before.
    own: null, language: config.language,
  });
  const now = state.get, stats = [];
  const wire = openWire(config, (text) => page.notice(word("starting").replace("{state}", text)));
  // Two panes of one kind, what is looked at and what stands beside it: how wide and high a picture usually is [mm], and
  // how many letters go beside one another.
  const paneOf = (suffix, names, more) => {
    const own = (id) => at(id + suffix);
    return { at: own, stage: stageOf(own), gallery: galleryOf(), names, ...more };
  };
  const panes = [
    paneOf("", (main = page.view()) => [main], { usual: [190, 180], letters: 44 }),
    paneOf("-beside", (main) => page.beside(main), { usual: [390, 520], letters: 40 }),
  ];
  const page = {
    config, words, at, word, state, wire, stats, phone, panes, shown: {}, last: {}, hand: null, guess: null, pinned: null, failed: null,
    queue: queueOf(wire.ask, stats), address: addressOf(config), wide: matchMedia("(min-width: 70rem)"),
    large: panes[0].gallery, small: { strip: galleryOf(), board: galleryOf() }, stage: panes[0].stage,
    decimal: () => page.last.mechanism?.decimal || ".",
    forget() {
      for (const { gallery, stage } of panes) {
        gallery.forget();
        stage.forget();
      }
    },
  };

  // What one part asks of another goes through the page, for the parts ask it of each other in turns.
  Object.assign(page, walkOf(page));
  Object.assign(page, {
    strip: stripOf(page), sizes: sizesOf(page), stepPanel: stepPanelOf(page), showValues: valuesPanelOf(page),
    whatIf: whatIfOf(page),
  });
  Object.assign(page, camAngleOf(page), askingOf(page), followingOf(page));
  Object.assign(page, changingOf(page));
  const moved = (changes, byKey = false) => Object.keys(changes)[0]?.startsWith("guess") ? page.guess.change(changes) : page.changeAny(changes, byKey);
  for (const pane of panes) {
    // A hand knows nothing of what stands above its view.
    const drag = ({ handle, to: [x, y], ...more }) => handle === "guess" ? page.guess.drag([x, y]) : page.drag({ handle, to: [x, y - (page.picture(pane)?.down?.[handle.split("/")[0]] || 0)], ...more });
    pane.hands = handsOf(pane.at, pane.stage, {
      grab: ({ id }) => id === "guess" || page.grab(), drag, drop: (cancelled, id) => id === "guess" || page.drop(cancelled), key: (changes) => moved(changes, true), word,
      written: (axis) => `${shortNumber(axis.value, page.decimal())} ${axis.unit}`.replace(" °", "°").trim(),
      type: (handle, knob) => typeNumbers(pane.at("typed"), handle, knob, words, page.decimal(), moved),
    });
  }
  page.heldHands = () => panes.map(({ hands }) => hands).find((hands) => hands.held());
  Object.assign(page, pictureOf(page), filesOf(page));

  // --- what follows a change of the state --------------------------------------------------------------------------------

  state.subscribe((changed) => {
    const is = (...names) => names.some((name) => changed.includes(name));
    if (is("past", "hidden")) page.showStatus();
    if (is("step", "part", "board", "view", "beside", "inert", "hidden", "only")) page.showDrawing();
    if (is("phi", "view")) page.showPhi();
    if (is("phi", "colour")) page.follow();
    if (is("phi") && !is("task", "station")) page.followPlan();
    if (is("panel", "inert", "hidden")) page.showPanels();
    if (is("pin")) {
      page.pinned = null;
      page.showPinned();
      page.showStatus();
      page.showValueTables();
    }
    if (wire.tell && is("task", "view")) wire.tell({ task: now().task, view: now().view });
    if (page.hand?.drag || page.accepting) return;
    if (is("task", "view", "beside", "board", "upto", "station", "inert") || (is("phi") && !page.turning())) page.ask();
    else if (is("step", "part", "pin", "mode", "hidden", "panel", "swept", "colour")) page.rest();
  });

  function togglePin() {
    state.set({ pin: now().pin ? null : now().task });
    if (now().pin && !phone.matches && now().panel === "step") state.set({ panel: "values" });
  }

  const fit = () => panes.forEach(({ stage }) => stage.whole() && stage.lookAnew());

  const zoom = (factor) => page.hand || now().board || !page.stage.frame() || page.stage.zoomFromMiddle(factor);
  for (const { at: own, stage } of panes) {
    gesturesOf(own("stage"), {
      onDrawing: (x, y) => {
        const [right, down] = stage.toDrawing(x, y);
        return { x: right, y: down };
      },
      zoomAbout: stage.zoomAbout, shift: stage.shift,
      // The wheel is meant over a knob too; a page around this one is scrolled with it.
      wanted: ({ type, target, ctrlKey }) => !page.hand && !now().board && stage.frame()
        && (type === "wheel" ? target.closest(".canvas, .hands") && (ctrlKey || config.transport !== "parent") : target.closest(".canvas")),
    });
  }

  // --- buttons and keys ----------------------------------------------------------------------------------------------------

  const clicks = {
    undo: () => page.travel("undo"), redo: () => page.travel("redo"), pin: togglePin, theme: switchTheme, fit,
    closer: () => zoom(1.25), farther: () => zoom(0.8), panes: () => now().board || state.set({ beside: page.beside().length ? "" : now().beside === null ? "diagrams" : null }),
    all: () => now().hidden.includes("board") || state.set({ board: !now().board }), previous: page.back, next: page.on, play: page.turn,
  };
  for (const [id, act] of Object.entries(clicks)) at(id).addEventListener("click", () => act());
  at("beside").addEventListener("change", () => state.set({ beside: at("beside").value || null }));
  at("slider").addEventListener("input", () => page.go(Number(at("slider").value) - 1));
  at("pips").addEventListener("click", ({ target }) => target.dataset.step && page.go(Number(target.dataset.step)));
  at("phi").addEventListener("input", () => {
    page.still();
    state.set({ phi: Number(at("phi").value) });
  });
  tabsOf(at("panels"), (tab) => state.set({ panel: tab.dataset.panel }));
  at("modes").addEventListener("click", ({ target }) => target.dataset.mode && setMode(target.dataset.mode));
  lightEachOther(at("panel-step"), at("stage"), () => at("panel-step"), page.stage.point);

  const keys = {
    ArrowRight: page.on, ArrowLeft: page.back, Home: () => page.go(0), End: () => page.go(Infinity),
    a: clicks.all, b: clicks.panes, p: togglePin, 0: fit, "+": clicks.closer, "=": clicks.closer, "-": clicks.farther, " ": page.turn,
  };
  const shifted = { ArrowRight: page.wholeOn, ArrowLeft: page.wholeBack };

  // Fields and lists have keys of their own.
  function isTaken({ target, key }) {
    if (target.closest("input:not([type=range]), select, textarea")) return true;
    if (/^(Arrow|Home|End|Page)/.test(key)) return target.closest("input, [role=tablist], [role=radiogroup]") || (!/^Arrow[LR]/.test(key) && target.closest(".words, .sizes"));
    return key === " " && target.closest("button, summary");
  }

  function actOf({ key, shiftKey }) {
    const letter = key.length === 1 ? key.toLowerCase() : key, view = /^[1-9]$/.test(key) && page.viewNames()[Number(key) - 1];
    if (view) return now().hidden.includes(view.name) ? null : () => page.open(view.name);
    return (shiftKey && shifted[key]) || keys[letter];
  }

  document.addEventListener("keydown", (event) => {
    const { ctrlKey, metaKey, altKey, shiftKey, key, target } = event;
    if ((ctrlKey || metaKey) && key.toLowerCase() === "z" && !target.matches("input[type=text]")) {
      event.preventDefault();
      return page.travel(shiftKey ? "redo" : "undo");
    }
    if (key === "Escape") return page.escape();
    const act = ctrlKey || metaKey || altKey || isTaken(event) ? null : actOf(event);
    if (!act) return;
    event.preventDefault();
    act();
  });

  // --- modes -------------------------------------------------------------------------------------------------------------------

  // Where an exercise is given the other modes would show what is asked.
  const isOpen = (name) => (name === "play" || studioModes[name]) && (!now().exercise || name === "exercise");

  function setMode(name) {
    if (name === now().mode || !isOpen(name)) return;
    page.still();
    studioModes[now().mode]?.leave();
    studio.panel.card(nothing);
    // What the person was at before is given back.
    const { task, name: called, view, step, part, phi, own } = now(), mine = own || { task, name: called, view, step, part, phi };
    state.set({ mode: name, own: name === "predict" || name === "tour" ? mine : null });
    if (task !== mine.task) wantWhole(mine);
    showModes();
    studioModes[name]?.enter();
  }

  const changed = (names) => studioModes[now().mode]?.changed?.(names);
  state.subscribe(changed);
  page.stage.onMove(() => changed([]));

  function showModes() {
    for (const button of at("modes").children) {
      button.setAttribute("aria-pressed", button.dataset.mode === now().mode);
      button.disabled = !isOpen(button.dataset.mode);
    }
  }

  const studio = {
    config, words, state, stats, shown: page.shown, stage: page.stage, panes, ask: page.queue.question, setMode,
    announce: page.announce, open: page.open, go: page.go, load: page.load, draw: page.showAll, change: page.changeAny,
    panel: {
      // What is new is read from its beginning.
      card(content, { stays = false } = {}) {
        render(content, at("card"));
        if (!stays) at("panel").scrollTop = 0;
      },
    },
    setGuess(guess) {
      page.guess = guess;
      page.showHands();
    },
    quiet: () => !page.queue.busy(),
    // Nothing is asked, nothing waits to be, and nothing glides.
    isAtRest: () => !page.queue.busy() && page.isResting() && panes.every(({ stage }) => stage.isStill()),
  };
  window.studio = studio;

  // --- beginning -----------------------------------------------------------------------------------------------------------------

  // Another state as a whole, from an address, a file or the page around this one: resolves to whether it can be drawn.
  const wantWhole = (whole) => new Promise((done) => {
    const { task, name } = now(), anew = { view: null, beside: null, step: null, part: null, phi: USUAL_PHI, station: null, swept: null, colour: null };
    page.want(() => ({ forget: true, task, name, ...anew, ...whole, ...(whole.exercise && { upto: whole.exercise.upto || null }) })).done = done;
  });
  page.wantWhole = wantWhole;

  // What the address says, and the page in its language; once it is drawn it is made anew for another one.
  async function read() {
    const { language, ...found } = (await page.address.read(location.hash)) || {};
    if (!language || language === config.language || !config.spoken[language]) return found;
    if (page.last.names) location.reload();
    else {
      speak(config, language);
      state.set({ language });
    }
    return found;
  }

  async function fromAddress() {
    const { mode, ...rest } = await read();
    if (!rest.task) return;
    if (await wantWhole(rest)) setMode(mode);
  }

  // The page around this one moves sizes too; what it has heard from here comes back, and is passed over.
  function fromAround(heard) {
    if (heard.task && !alike(heard.task, now().task)) page.want(() => ({ task: heard.task, view: "view" in heard ? heard.view : now().view }));
    else if ("view" in heard) state.set({ view: heard.view });
  }

  function resized() {
    for (const { stage } of panes) stage.resized();
    page.showPanels();
    page.showDrawing();
    if (!page.hand && page.last.names) page.ask();
  }

  if (at("builtin")) at("builtin").value = config.name;
  const { mode, ...found } = await read();
  if (config.first && !found.task) {
    const asked = { views: config.first.views.map((view) => ({ ...view, pane: Number(view.plain), px_per_mm: 1 })), told: true, values: true, form: true, warnings: true, mechanism: true };
    page.take({ ok: true, views: [], ...config.first }, { request: asked, hand: null, aim: {} });
  }
  page.showPanels();
  page.showStatus();
  const answered = new Promise((done) => Object.assign(page, { answered: done }));
  const isShown = found.task ? wantWhole(found) : page.ask() || true;
  const sized = new ResizeObserver(resized);
  for (const pane of panes) sized.observe(pane.at("canvas"));
  addEventListener("hashchange", fromAddress);
  wire.hear?.(fromAround);
  showModes();
  await isShown;
  setMode(now().exercise ? "exercise" : mode || "play");
  showModes();
  // The page opens with a cam that turns, where nobody asked for an angle or for less motion.  Until the engine has answered
  // the processor is the engine's.
  await answered;
  const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches || page.hand || now().phi !== USUAL_PHI;
  if (now().mode === "play" && found.phi === undefined && !isCalm && panes.some((pane) => pane.names().includes("mechanism"))) page.turn();
})();
