// The steps: which are drawn, what is said of them, and where the reader looks.  No names leave this function.
"use strict";
(() => {
  const { steps, words } = JSON.parse(document.getElementById("data").textContent);
  const at = (id) => document.getElementById(id);
  const stage = at("stage");
  const pages = [...document.querySelectorAll("svg.page")];
  const slides = steps.map((_, k) => at(`slide-${k}`));
  const groups = steps.map((step) => at(step.group));
  // The title of a view appears with the first step in it.
  const titles = [...document.querySelectorAll("[data-view]")]
    .map((title) => [title, steps.findIndex((step) => step.view === title.dataset.view)]);
  const starts = [...document.querySelectorAll(".breakpoint > button")].map((button) => Number(button.dataset.step));
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  let current = 0, shown = 0, follow = true;

  // --- steps -----------------------------------------------------------------------------------------------------

  function go(k) {
    current = Math.max(0, Math.min(steps.length - 1, k));
    groups.forEach((group, j) => {
      group.classList.toggle("later", j > current);
      group.classList.toggle("former", j < current);
      group.classList.toggle("current", j === current);
    });
    titles.forEach(([title, first]) => title.classList.toggle("later", first > current));
    slides.forEach((slide, j) => (slide.hidden = j !== current));
    document.body.classList.toggle("finished", current === steps.length - 1);
    const slide = slides[current], count = `${current + 1} / ${steps.length}`;
    at("slider").value = current + 1;
    at("slider").setAttribute("aria-valuetext", `${count}: ${slide.querySelector("h2").textContent}`);
    at("counter").textContent = count;
    at("announcement").textContent = ["h2", ".caption"].map((part) => slide.querySelector(part).textContent).join(". ");
    for (const id of ["first", "previous"]) at(id).disabled = current === 0;
    for (const id of ["next", "last"]) at(id).disabled = current === steps.length - 1;
    markContents();
    turnTo(steps[current].page);
    look(follow ? steps[current].box : null);
    try { history.replaceState(null, "", `#${current + 1}`); } catch { /* a page in a frame may not */ }
  }

  const chapterOf = (k) => starts.filter((start) => start <= k).length - 1;

  function goToChapter(by) {
    const here = chapterOf(current), inside = current > starts[here];
    const chapter = Math.max(0, Math.min(starts.length - 1, here + by + (by < 0 && inside ? 1 : 0)));
    go(starts[chapter]);
  }

  function markContents() {
    const chapter = chapterOf(current);
    document.querySelectorAll(".breakpoint").forEach((item, k) => item.classList.toggle("here", k === chapter));
    document.querySelectorAll("#construction .chapters span").forEach((bar, k) => {
      bar.classList.toggle("here", k === chapter);
      bar.classList.toggle("done", k < chapter);
    });
    for (const button of document.querySelectorAll("nav .to-step")) {
      if (Number(button.dataset.step) === current) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    }
  }

  function turnTo(number) {
    shown = number;
    pages.forEach((page, k) => page.classList.toggle("away", k !== number));
    document.querySelectorAll("[data-page]").forEach((button, k) => button.setAttribute("aria-pressed", k === number));
  }

  // --- where the reader looks: a scale and a shift of the page, in its millimetres -------------------------------

  const camera = { zoom: 1, x: 0, y: 0 };
  const sheet = () => pages[shown].viewBox.baseVal;

  function place() {
    const { zoom, x, y } = camera, size = sheet();
    const fit = Math.min(stage.clientWidth / size.width, stage.clientHeight / size.height);
    for (const page of pages) {
      page.querySelector(".camera").style.transform = `translate(${x}px, ${y}px) scale(${zoom})`;
      // How many millimetres a pixel is: no line is drawn thinner than can be seen.
      page.style.setProperty("--pixel", `${1 / (fit * zoom || 1)}px`);
    }
  }

  // A box of the page, or all of it, below the tools; the window need not have the shape of the page.
  function look(box) {
    const { width, height } = sheet();
    const [left, top, wide, high] = box || [0, 0, width, height];
    const fit = Math.min(stage.clientWidth / width, stage.clientHeight / height) || 1;
    const tools = document.querySelector(".zoom").getBoundingClientRect();
    const above = (tools.bottom - stage.getBoundingClientRect().top + 4) / fit;
    camera.zoom = Math.min(stage.clientWidth / fit / wide, (stage.clientHeight / fit - above) / high, 8);
    camera.x = width / 2 - camera.zoom * (left + wide / 2);
    camera.y = (height + above) / 2 - camera.zoom * (top + high / 2);
    place();
  }

  // Client coordinates in the page's millimetres, before the camera.
  function onPage(x, y) {
    const matrix = pages[shown].getScreenCTM().inverse();
    return new DOMPoint(x, y).matrixTransform(matrix);
  }

  function zoomAbout(factor, centre) {
    const zoom = Math.max(0.4, Math.min(40, camera.zoom * factor)), ratio = zoom / camera.zoom;
    camera.x = centre.x - ratio * (centre.x - camera.x);
    camera.y = centre.y - ratio * (centre.y - camera.y);
    camera.zoom = zoom;
    place();
  }

  function zoomFromMiddle(factor) {
    const box = stage.getBoundingClientRect();
    zoomAbout(factor, onPage(box.left + box.width / 2, box.top + box.height / 2));
  }

  function setFollow(on) {
    follow = on;
    at("follow").setAttribute("aria-pressed", on);
    turnTo(steps[current].page);
    look(on ? steps[current].box : null);
  }

  const touching = new Map();

  function spread() {
    const [a, b] = [...touching.values()];
    return { length: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  }

  stage.addEventListener("pointerdown", (event) => {
    if (event.target.closest("button")) return;
    touching.set(event.pointerId, { x: event.clientX, y: event.clientY });
    stage.setPointerCapture(event.pointerId);
    stage.classList.add("dragged");
  });
  stage.addEventListener("pointermove", (event) => {
    const before = touching.get(event.pointerId);
    if (!before) return;
    const pinch = touching.size === 2 ? spread() : null;
    const from = onPage(before.x, before.y), to = onPage(event.clientX, event.clientY);
    touching.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pinch) {
      const now = spread();
      zoomAbout(now.length / (pinch.length || 1), onPage(now.x, now.y));
    }
    camera.x += (to.x - from.x) / touching.size;
    camera.y += (to.y - from.y) / touching.size;
    place();
  });
  for (const end of ["pointerup", "pointercancel"]) {
    stage.addEventListener(end, (event) => {
      touching.delete(event.pointerId);
      if (!touching.size) stage.classList.remove("dragged");
    });
  }
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomAbout(Math.exp(-event.deltaY / 400), onPage(event.clientX, event.clientY));
  }, { passive: false });

  // --- keys and buttons ------------------------------------------------------------------------------------------

  const keys = {
    ArrowRight: () => go(current + 1), ArrowDown: () => go(current + 1),
    ArrowLeft: () => go(current - 1), ArrowUp: () => go(current - 1),
    Home: () => go(0), End: () => go(steps.length - 1),
    PageDown: () => goToChapter(1), PageUp: () => goToChapter(-1),
    "+": () => zoomFromMiddle(1.25), "=": () => zoomFromMiddle(1.25), "-": () => zoomFromMiddle(0.8),
    0: () => setFollow(false), f: () => setFollow(!follow), F: () => setFollow(!follow),
  };
  const tabs = [...document.querySelectorAll("[role=tab]")];

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select, [role=tablist]")) return;
    if (tabs.length && /^m$/i.test(event.key)) return show(tabs.findIndex((tab) => tab.ariaSelected !== "true"));
    if (at("construction").hidden || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });

  const clicks = {
    first: () => go(0), previous: () => go(current - 1), next: () => go(current + 1), last: () => go(steps.length - 1),
    closer: () => zoomFromMiddle(1.25), farther: () => zoomFromMiddle(0.8), whole: () => setFollow(false),
    follow: () => setFollow(!follow), print: () => print(), theme: switchTheme,
  };
  for (const [id, act] of Object.entries(clicks)) at(id).addEventListener("click", act);
  at("slider").addEventListener("input", () => go(Number(at("slider").value) - 1));
  document.addEventListener("click", (event) => {
    const to = event.target.closest("[data-step]"), page = event.target.closest("[data-page]");
    if (to) go(Number(to.dataset.step));
    if (page) { turnTo(Number(page.dataset.page)); look(null); }
  });

  // --- construction or mechanism, light or dark ------------------------------------------------------------------

  function show(number) {
    tabs.forEach((tab, k) => {
      tab.ariaSelected = String(k === number);
      tab.tabIndex = k === number ? 0 : -1;
      at(tab.getAttribute("aria-controls")).hidden = k !== number;
    });
    document.dispatchEvent(new CustomEvent("shown", { detail: tabs[number].getAttribute("aria-controls") }));
    if (number === 0) look(follow ? steps[current].box : null);
  }

  tabs.forEach((tab, k) => {
    tab.addEventListener("click", () => show(k));
    tab.addEventListener("keydown", (event) => {
      if (!/^Arrow(Left|Right)$/.test(event.key)) return;
      show(1 - k);
      tabs[1 - k].focus();
    });
  });

  function switchTheme() {
    const dark = document.documentElement.dataset.theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    document.documentElement.dataset.theme = dark === "dark" ? "light" : "dark";
  }

  new ResizeObserver(() => stage.clientWidth && look(follow ? steps[current].box : null)).observe(stage);
  document.body.classList.add("running");
  document.body.classList.toggle("calm", calm.matches);
  calm.addEventListener("change", () => document.body.classList.toggle("calm", calm.matches));
  go((Number(location.hash.slice(1)) || 1) - 1);
  addEventListener("hashchange", () => go((Number(location.hash.slice(1)) || 1) - 1));
})();
