// A guess on the drawing: a dashed amber knob that moves on a polyline, or freely in a box, in the view's millimetres.
"use strict";

// --- a polyline by the length along it -----------------------------------------------------------------------------------

function wayOf(points) {
  const ends = [0];
  points.slice(1).forEach(([x, y], k) => ends.push(ends[k] + Math.hypot(x - points[k][0], y - points[k][1])));
  const length = ends.at(-1);

  function placeAt(along) {
    const k = Math.max(0, Math.min(points.length - 2, ends.findLastIndex((end) => end <= along)));
    const part = (along - ends[k]) / (ends[k + 1] - ends[k] || 1);
    return points[k].map((x, j) => x + (points[k + 1][j] - x) * Math.max(0, Math.min(1, part)));
  }

  // How far along the place lies that is nearest to another one.
  function nearest([x, y]) {
    let found = 0, least = Infinity;
    points.slice(1).forEach(([bx, by], k) => {
      const [ax, ay] = points[k], dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy || 1;
      const part = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / square));
      const far = Math.hypot(ax + part * dx - x, ay + part * dy - y);
      if (far < least) [found, least] = [ends[k] + part * Math.sqrt(square), far];
    });
    return found;
  }

  return { length, placeAt, nearest };
}

// --- where the guess is: one number along a way, or two in a box ------------------------------------------------------------

function placesOf({ way, free }, words) {
  const round = (mm) => Math.round(mm * 100) / 100;
  if (!free) {
    const line = wayOf(way);
    const axis = { name: words.guess_along, min: 0, max: round(line.length), arrows: { ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1, ArrowDown: 1 } };
    return { axes: [axis], place: ([along]) => line.placeAt(along), values: (place) => [round(line.nearest(place))] };
  }
  const [[x1, y1], [x2, y2]] = way;
  const axes = [
    { name: words.guess_across, min: Math.min(x1, x2), max: Math.max(x1, x2), arrows: { ArrowRight: 1, ArrowLeft: -1 } },
    { name: words.guess_down, min: Math.min(y1, y2), max: Math.max(y1, y2), arrows: { ArrowDown: 1, ArrowUp: -1 } },
  ];
  const within = (value, { min, max }) => Math.max(min, Math.min(max, value));
  return { axes, place: (values) => values, values: (place) => place.map((mm, k) => round(within(mm, axes[k]))) };
}

// --- the knob ------------------------------------------------------------------------------------------------------------------

// `moved` is told of every move; the layer is drawn under the knobs, in the drawing itself.
function guessOf(studio, asked, letter, moved) {
  const { words, stage } = studio, hands = document.getElementById("hands");
  const places = placesOf(asked, words), layer = drawSvg("g", "guesses", { "aria-hidden": "true" }, stage.layers.drawing);
  let values = places.values(asked.start), still = false, off = null, marks = null, touched = false;

  const knob = make("div", { class: "hand guess", role: places.axes.length > 1 ? "group" : null, "aria-label": places.axes.length > 1 ? words.guess : null });
  const picture = drawSvg("svg", "knob", { viewBox: "-22 -22 44 44", "aria-hidden": "true" }, knob);
  drawSvg("circle", "halo", { r: 15 }, picture);
  drawSvg("circle", "ring", { r: 9 }, picture);
  drawSvg("text", "letter", { y: 4.5 }, picture).textContent = letter;
  const inputs = places.axes.map(({ name, min, max }, k) => make("input", {
    type: "range", class: "unseen", step: "any", min, max, "aria-label": name, tabindex: k ? -1 : 0, "data-guess": k,
  }));
  knob.append(...inputs);
  hands.append(knob);

  const place = () => places.place(values);
  // What guess and answer look like in the view that is shown; null where they are not seen.
  const shown = () => {
    const own = (studio.state.get().view ?? asked.view), [guess, answer] = [place(), null];
    if (marks) return marks[own] || null;
    return own === asked.view ? { guess, answer } : null;
  };

  function set(next) {
    if (still) return;
    touched = true;
    values = next.map((value, k) => Math.max(places.axes[k].min, Math.min(places.axes[k].max, value)));
    show();
    moved(values);
  }

  // Before it is moved it lies where it is seen: the frame is known only when the view is drawn.
  function comeInSight() {
    const frame = stage.frame(), seen = ([x, y]) => x > frame[0] && x < frame[0] + frame[2] && y > frame[1] && y < frame[1] + frame[3];
    if (touched || still || asked.free || !frame || studio.state.get().view !== asked.view || seen(place())) return;
    const { max } = places.axes[0], found = Array.from({ length: 41 }, (_, k) => (max * (40 - k)) / 40).find((along) => seen(places.place([along])));
    if (found === undefined) return;
    values = [Math.round(0.9 * found)];
    moved(values);
  }

  function show() {
    comeInSight();
    const at = shown();
    layer.replaceChildren();
    knob.hidden = !at;
    inputs.forEach((input, k) => {
      input.value = values[k];
      input.setAttribute("aria-valuetext", `${values[k].toFixed(1)} mm`);
      input.disabled = still;
    });
    if (!at) return;
    const [x, y] = stage.toScreen(at.guess);
    knob.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    const line = (from, to, kind) => drawSvg("path", kind, { d: `M${from.join(" ")}L${to.join(" ")}` }, layer);
    if (asked.pole && studio.state.get().view === asked.view) {
      line(asked.pole, at.guess, "ray");
      if (at.answer) line(asked.pole, at.answer, "found-ray");
    } else if (!marks && !asked.free) drawSvg("path", "way", { d: `M${asked.way.map((point) => point.join(" ")).join("L")}` }, layer);
    if (!at.answer) return;
    line(at.guess, at.answer, "apart");
    drawSvg("circle", "answer", { cx: at.answer[0], cy: at.answer[1], r: 7 / stage.scale({ frame: stage.frame() }) }, layer);
  }

  // --- hand and keys

  const box = () => hands.getBoundingClientRect();
  knob.addEventListener("pointerdown", (event) => {
    if (event.button || still) return;
    event.preventDefault();
    event.stopPropagation();
    const [x, y] = stage.toScreen(place());
    off = [box().left + x - event.clientX, box().top + y - event.clientY];
    knob.setPointerCapture(event.pointerId);
    inputs[0].focus({ preventScroll: true });
  });
  knob.addEventListener("pointermove", (event) => {
    if (!off) return;
    event.stopPropagation();
    set(places.values(stage.toDrawing(event.clientX + off[0], event.clientY + off[1])));
  });
  for (const name of ["pointerup", "pointercancel"]) knob.addEventListener(name, () => (off = null));

  function pressed(event, focused) {
    const { key, shiftKey, ctrlKey, metaKey, altKey } = event;
    if (ctrlKey || metaKey || altKey || still) return;
    const k = Math.max(places.axes.findIndex((axis) => axis.arrows[key]), key.startsWith("Arrow") ? -1 : focused);
    if (k < 0) return;
    const axis = places.axes[k], by = shiftKey ? 0.2 : 1;
    const steps = { ...axis.arrows, PageUp: 10 / by, PageDown: -10 / by };
    const next = key === "Home" ? axis.min : key === "End" ? axis.max : values[k] + by * (steps[key] ?? NaN);
    if (Number.isNaN(next)) return;
    event.preventDefault();
    event.stopPropagation();
    inputs[k].focus({ preventScroll: true });
    set(values.map((value, j) => (j === k ? next : value)));
  }
  inputs.forEach((input, k) => {
    input.addEventListener("keydown", (event) => pressed(event, k));
    input.addEventListener("input", () => set(values.map((value, j) => (j === k ? Number(input.value) : value))));
  });

  show();
  return {
    axes: places.axes, values: () => values, place, set, show,
    // No longer moved: where guess and answer lie, by views.
    settle: (found) => ([still, marks] = [true, found], show()),
    hold: (yes) => ((still = yes), show()),
    focus: () => inputs[0].focus(),
    remove: () => (knob.remove(), layer.remove()),
  };
}
