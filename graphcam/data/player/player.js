// The steps: which is shown as far as which part, what is said of it, and how one goes on.
"use strict";
(() => {
  const { steps, views, words } = JSON.parse(document.getElementById("data").textContent);
  const at = (id) => document.getElementById(id);
  const panes = [paneOf(at("stage"))];
  const slides = steps.map((_, k) => at(`slide-${k}`));
  const starts = [...document.querySelectorAll(".breakpoint > button")].map((button) => Number(button.dataset.step));
  const last = steps.length - 1;
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  // The part is null where the step is shown whole.
  let current = 0, part = null, follow = true;

  // --- steps and their parts -------------------------------------------------------------------------------------

  const partsOf = (step) => steps[step].parts.length;
  const atEnd = () => current === last && (part === null || part === partsOf(last) - 1);
  const atStart = () => current === 0 && (part ?? (partsOf(0) > 1)) == 0;

  function go(step, toPart = null) {
    const before = [current, part];
    current = Math.max(0, Math.min(last, step));
    part = toPart === null || partsOf(current) === 1 ? null : Math.max(0, Math.min(partsOf(current) - 1, toPart));
    for (const { board } of panes) board.show(current, part);
    document.body.classList.toggle("finished", atEnd());
    slides.forEach((slide, j) => (slide.hidden = j !== current));
    markContents();
    tell(...before);
    look();
    point([]);
    try { history.replaceState(null, "", `#${address()}`); } catch { /* a page in a frame may not */ }
  }

  const counts = steps.map((step) => step.parts.length);
  const on = () => go(...placeAfter([current, part], counts));
  const back = () => go(...placeBefore([current, part], counts));

  const wholeOn = () => go(part === null ? current + 1 : current);
  const wholeBack = () => go(current - 1);

  const chapterOf = (k) => starts.filter((start) => start <= k).length - 1;

  function goToChapter(by) {
    const here = chapterOf(current), inside = current > starts[here] || part;
    const chapter = Math.max(0, Math.min(starts.length - 1, here + by + (by < 0 && inside ? 1 : 0)));
    go(starts[chapter], 0);
  }

  // "3.2" is a step, "3.2/4" its fourth part, "3" a construction.
  const address = () => steps[current].number + (part === null ? "" : `/${part + 1}`);

  function goToAddress() {
    const [number, which] = location.hash.slice(1).split("/");
    const step = steps.findIndex((one) => one.number === number || one.number.startsWith(`${number}.`));
    if (step < 0) go(0, 0);
    else go(step, /^[1-9]\d*$/.test(which) && which <= partsOf(step) ? which - 1 : null);
  }

  // --- what is said ----------------------------------------------------------------------------------------------

  function tell(stepBefore, partBefore) {
    const slide = slides[current], said = (name) => slide.querySelector(name)?.textContent || "";
    const isNew = current !== stepBefore, items = itemsOf(slide);
    const place = part === null
      ? words.step_of.replace("{step}", current + 1).replace("{steps}", steps.length)
      : words.part_of.replace("{part}", part + 1).replace("{parts}", partsOf(current));
    at("number").textContent = steps[current].number;
    at("place").textContent = place;
    at("slider").value = current + 1;
    at("slider").setAttribute("aria-valuetext", `${steps[current].number} ${said(".name")}, ${place}`);
    at("announcement").textContent = sentences([
      ...(part === null || isNew ? [said(".name"), said(".caption")] : []),
      ...(part === null ? wholeOf(slide) : newsOf(items, part, isNew ? null : partBefore)),
    ]);
    at("previous").disabled = atStart();
    at("whole-back").disabled = current === 0;
    at("next").disabled = at("whole-on").disabled = atEnd();
    slide.querySelector(".whole-step")?.setAttribute("aria-pressed", part === null);
    markParts(items, part);
    if (isNew) at("words").scrollTop = 0;
    // The first part leaves the caption in sight.
    if (part !== null && (part || !isNew)) {
      if (runOf(items[part])) bringIntoSight(runOf(items[part]).firstElementChild);
      bringIntoSight(items[part]);
    }
  }

  // Titles have no full stop of their own, most captions have one.
  function sentences(texts) {
    const stop = texts.some((text) => text.endsWith("。")) ? "。" : ".";
    return texts.filter(Boolean).map((text) => (/[.。?？!！:：…]$/.test(text) ? text : text + stop)).join(" ");
  }

  // In the player's own boxes alone: in a frame scrollIntoView would move the page around it too.
  function bringIntoSight(item) {
    for (let box = item.parentElement; box !== document.body; box = box.parentElement) {
      const room = parseFloat(getComputedStyle(box).scrollPaddingTop) || 0;
      const own = item.getBoundingClientRect(), around = box.getBoundingClientRect();
      const above = own.top - around.top - room, below = own.bottom - around.bottom + room;
      if (above < 0) box.scrollTop += above;
      else if (below > 0) box.scrollTop += Math.min(above, below);
    }
  }

  function markContents() {
    const chapter = chapterOf(current);
    document.querySelectorAll(".breakpoint").forEach((item, k) => item.classList.toggle("here", k === chapter));
    document.querySelectorAll("#construction .chapters span").forEach((bar, k) => {
      bar.classList.toggle("here", k === chapter);
      bar.classList.toggle("done", k < chapter);
    });
    for (const button of document.querySelectorAll(".to-step")) {
      if (Number(button.dataset.step) === current) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    }
    const row = document.querySelector("#protocol tr.here");
    row?.classList.remove("here");
    at(`row-${current}`).classList.add("here");
    if (!at("protocol").hidden) bringIntoSight(at(`row-${current}`));
  }

  // --- where the reader looks ------------------------------------------------------------------------------------

  function paneOf(stage) {
    return { stage, board: boardOf(stage, steps), camera: cameraOf(stage) };
  }

  // A second pane for what is lit in another view: the same sheets once more.
  function besidePane() {
    if (panes.length === 1) {
      const copy = at("stage").cloneNode(true);
      for (const element of [copy, ...copy.querySelectorAll("[id]")]) element.removeAttribute("id");
      for (const name of ["tabindex", "role", "aria-label"]) copy.removeAttribute(name);
      copy.setAttribute("aria-hidden", "true");
      at("desk").append(copy);
      panes.push(paneOf(copy));
      panes[1].board.show(current, part);
    }
    return panes[1];
  }

  // The view of the step, and the others in which something is lit: on its page, or on one other.
  function placesLookedAt() {
    const step = steps[current], others = panes[0].board.beside().map((name) => views[name]);
    const beside = others.filter((view) => view.page === others[0].page);
    return [step, beside.length ? { page: beside[0].page, box: around(beside.map((view) => view.box)) } : null];
  }

  function look() {
    const desk = at("desk"), wide = desk.clientWidth, high = desk.clientHeight;
    const [own, other] = follow ? placesLookedAt() : [{ page: steps[current].page, box: null }, null];
    const zoom = (box, across, up) => Math.min(wide / across / box[2], high / up / box[3]);
    let box = own.box, split = "";
    if (other) {
      const least = (across, up) => Math.min(zoom(own.box, across, up), zoom(other.box, across, up));
      const columns = least(2, 1), rows = least(1, 2), both = around([own.box, other.box]);
      // Two views of a page are one picture, unless that costs much.
      if (other.page === own.page && zoom(both, 1, 1) > 0.75 * Math.max(columns, rows)) box = both;
      else split = columns > rows ? "columns" : "rows";
    }
    desk.dataset.split = split;
    desk.classList.toggle("lettered", follow);
    if (split) besidePane().camera.look(other.page, other.box);
    panes[0].camera.turnTo(own.page);
    panes[0].camera.look(own.page, part === null || !box ? box : closer(box));
    markSheet(own.page);
  }

  // Where a view is too small to be read (a phone), what is drawn now and its surroundings.
  function closer([left, top, wide, high]) {
    const { clientWidth, clientHeight } = at("stage");
    const whole = Math.min(clientWidth / wide, clientHeight / high), drawn = panes[0].board.focus();
    if (whole >= 1.4 || !drawn) return [left, top, wide, high];
    const [x, y, w, h] = drawn;
    const own = Math.min(3, clientWidth / (w + 20), clientHeight / (h + 20)), zoom = Math.max(whole, own);
    const size = [clientWidth / zoom, clientHeight / zoom];
    const inside = (middle, extent, start, length) => {
      const rest = length - extent;
      return start + (rest < 0 ? rest / 2 : Math.max(0, Math.min(rest, middle - extent / 2 - start)));
    };
    return [inside(x + w / 2, size[0], left, wide), inside(y + h / 2, size[1], top, high), ...size];
  }

  function markSheet(number) {
    document.querySelectorAll("[data-page]").forEach((button, k) => button.setAttribute("aria-pressed", k === number));
  }

  function setFollow(yes) {
    follow = yes;
    at("follow").setAttribute("aria-pressed", yes);
    look();
  }

  const zoom = (factor) => panes.forEach(({ stage, camera }) => stage.clientWidth && camera.zoomFromMiddle(factor));

  // --- a reading and its marks light each other ----------------------------------------------------------------------

  function point(names) {
    for (const { board } of panes) board.point(names);
  }
  lightEachOther(at("words"), at("desk"), () => slides[current], point);

  // --- the steps by themselves ---------------------------------------------------------------------------------------

  // How long a reader needs for a letter [ms], besides a look at the drawing, which takes as long as 25.
  const letter = 45;
  let timer = 0;

  function rest() {
    const letters = at("announcement").textContent.length;
    timer = setTimeout(() => {
      on();
      if (atEnd()) halt();
      else rest();
    }, letter * (25 + letters) / Number(at("pace").value));
  }

  function run() {
    if (atEnd()) go(0, 0);
    mark(true);
    rest();
  }

  function halt() {
    clearTimeout(timer);
    timer = 0;
    mark(false);
  }

  function mark(running) {
    document.body.classList.toggle("playing", running);
    for (const name of ["title", "aria-label"]) at("run").setAttribute(name, running ? words.halt : words.run);
  }

  // Who does something else reads at an own pace.
  for (const act of ["pointerdown", "keydown", "wheel"]) {
    document.addEventListener(act, (event) => {
      if (timer && event.key !== " " && !event.target.closest?.("#run, #pace")) halt();
    }, { capture: true, passive: true });
  }

  // --- the protocol --------------------------------------------------------------------------------------------------

  function showProtocol(open) {
    at("protocol").hidden = !open;
    at("words").hidden = open;
    document.body.classList.toggle("listing", open);
    at("list").setAttribute("aria-expanded", open);
    if (open) bringIntoSight(at(`row-${current}`));
  }
  at("protocol").addEventListener("change", ({ target }) => {
    for (const { board } of panes) board.putAway(Number(target.dataset.shows), !target.checked);
  });

  // --- keys and buttons ------------------------------------------------------------------------------------------

  const keys = {
    ArrowRight: on, ArrowDown: on, ArrowLeft: back, ArrowUp: back, Home: () => go(0, 0), End: () => go(last),
    PageDown: () => goToChapter(1), PageUp: () => goToChapter(-1),
    "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), 0: () => setFollow(false),
    f: () => setFollow(!follow), p: () => showProtocol(at("protocol").hidden), " ": () => (timer ? halt() : run()),
  };
  const shifted = { ArrowRight: wholeOn, ArrowDown: wholeOn, ArrowLeft: wholeBack, ArrowUp: wholeBack };
  const tabs = [...document.querySelectorAll("[role=tab]")];

  document.addEventListener("keydown", (event) => {
    const { target, key } = event, lower = key.length === 1 ? key.toLowerCase() : key;
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest("select, [role=tablist]")) return;
    if (tabs.length && lower === "m") return show(tabs.findIndex((tab) => tab.ariaSelected !== "true"));
    if (at("construction").hidden) return;
    if (key === "Escape" && !at("protocol").hidden) {
      showProtocol(false);
      at("list").focus();
    }
    if (key === " " && target.closest("button, summary, input")) return;
    // Who is in the words scrolls them.
    if (/^(ArrowUp|ArrowDown|PageUp|PageDown|Home|End| )$/.test(key) && target.closest(".words")) return;
    const act = (event.shiftKey && shifted[key]) || keys[lower];
    if (!act) return;
    event.preventDefault();
    act();
  });

  const clicks = {
    "whole-back": wholeBack, previous: back, next: on, "whole-on": wholeOn, run: () => (timer ? halt() : run()),
    closer: () => zoom(1.25), farther: () => zoom(0.8), whole: () => setFollow(false), follow: () => setFollow(!follow),
    list: () => showProtocol(at("protocol").hidden), close: () => { showProtocol(false); at("list").focus(); },
    print: () => print(), "print-list": () => print(), theme: switchTheme,
  };
  for (const [id, act] of Object.entries(clicks)) at(id).addEventListener("click", act);
  at("slider").addEventListener("input", () => go(Number(at("slider").value) - 1));
  document.addEventListener("click", ({ target }) => {
    const to = target.closest("[data-step]"), row = target.closest("#protocol tbody tr");
    const page = target.closest("[data-page]"), place = target.closest("[data-part]");
    if (place) go(current, Number(place.dataset.part));
    else if (target.closest(".whole-step")) go(current);
    else if (row && !target.closest("label")) go(Number(row.dataset.row));
    else if (to) go(Number(to.dataset.step), 0);
    if (page) {
      at("desk").dataset.split = "";
      panes[0].camera.look(Number(page.dataset.page), null);
      markSheet(Number(page.dataset.page));
    }
  });

  // --- construction or mechanism, light or dark ------------------------------------------------------------------

  function show(number) {
    markTab(tablist, tabs[number]);
    tabs.forEach((tab, k) => (at(tab.getAttribute("aria-controls")).hidden = k !== number));
    document.dispatchEvent(new CustomEvent("shown", { detail: tabs[number].getAttribute("aria-controls") }));
    if (number === 0) look();
  }

  const tablist = document.querySelector("[role=tablist]");
  if (tablist) tabsOf(tablist, (tab) => show(tabs.indexOf(tab)));

  new ResizeObserver(() => at("desk").clientWidth && look()).observe(at("desk"));
  document.body.classList.add("running");
  document.body.classList.toggle("calm", calm.matches);
  calm.addEventListener("change", () => document.body.classList.toggle("calm", calm.matches));
  goToAddress();
  addEventListener("hashchange", goToAddress);
})();
