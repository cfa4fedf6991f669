// A guess on the drawing: a dashed amber handle that moves on a polyline, or freely in a box, in the view's millimetres.
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

// As the axes of a handle: going down is going on.
function placesOf({ way, free }, words) {
  const round = (mm) => Math.round(mm * 100) / 100, keys = { unit: words.mm, step: 1, fine: 0.2, coarse: 10 };
  if (!free) {
    const line = wayOf(way), axis = { ...keys, path: "guess", name: words.guess_along, min: 0, max: round(line.length), screen: "x", up: -1 };
    return { axes: [axis], place: ([along]) => line.placeAt(along), values: (place) => [round(line.nearest(place))] };
  }
  const axes = [0, 1].map((k) => ({
    ...keys, path: `guess[${k}]`, name: [words.guess_across, words.guess_down][k], screen: "xy"[k], sign: [1, -1][k],
    min: Math.min(way[0][k], way[1][k]), max: Math.max(way[0][k], way[1][k]),
  }));
  const within = (value, { min, max }) => Math.max(min, Math.min(max, value));
  return { axes, place: (values) => values, values: (place) => place.map((mm, k) => round(within(mm, axes[k]))) };
}

// --- the guess -----------------------------------------------------------------------------------------------------------------

// It is a handle among those of the drawing; `moved` is told of every move, its marks are drawn in the drawing itself.
function guessOf(studio, asked, letter, moved) {
  const { words, stage } = studio, view = () => studio.state.get().view;
  const places = placesOf(asked, words), layer = drawSvg("g", "guesses", { "aria-hidden": "true" }, stage.layers.drawing);
  let values = places.values(asked.start), still = false, marks = null, touched = false;

  const place = () => places.place(values);
  // What guess and answer look like in the view that is shown; null where they are not seen.
  const shown = () => (marks ? marks[view() ?? asked.view] || null : (view() ?? asked.view) === asked.view ? { guess: place(), answer: null } : null);

  function set(next) {
    if (still) return;
    touched = true;
    values = next.map((value, k) => Math.max(places.axes[k].min, Math.min(places.axes[k].max, value)));
    show();
    moved(values);
  }

  // Before it is moved it lies where it is seen: the frame is known only when the view is drawn.  The answer lies near the
  // lower end of what is seen.
  function comeInSight() {
    const frame = stage.frame(), seen = ([x, y]) => x > frame[0] && x < frame[0] + frame[2] && y > frame[1] && y < frame[1] + frame[3];
    if (touched || still || asked.free || !frame || view() !== asked.view || seen(place())) return;
    const { max } = places.axes[0], found = Array.from({ length: 41 }, (_, k) => (max * (40 - k)) / 40).find((along) => seen(places.place([along])));
    if (found === undefined) return;
    values = [Math.round(0.5 * found)];
    moved(values);
  }

  function show() {
    comeInSight();
    const at = shown();
    render(at ? marksAt(at) : nothing, layer);
    studio.setGuess(at && {
      handle: { id: "guess", view: asked.view, name: words.guess, letter, at: at.guess, axes: places.axes.map((axis, k) => ({ ...axis, value: values[k] })) },
      drag: (to) => set(places.values(to)), change: (changes) => set(places.axes.map(({ path }, k) => changes[path] ?? values[k])),
    });
  }

  function marksAt({ guess, answer }) {
    const line = (name, ...points) => svg`<path class=${name} d=${pathOf(points)}></path>`, { pole, way, free } = asked;
    const round = ([x, y], r) => svg`<circle class="answer" cx=${x} cy=${y} r=${r}></circle>`;
    const rays = () => [line("ray", pole, guess), answer ? line("found-ray", pole, answer) : nothing];
    return [
      pole && view() === asked.view ? rays() : !marks && !free ? line("way", ...way) : nothing,
      answer ? line("apart", guess, answer) : nothing,
      answer ? round(answer, 7 / stage.scale({ frame: stage.frame() })) : nothing,
    ];
  }

  show();
  return {
    axes: places.axes, values: () => values, place, set, show,
    // No longer moved: where guess and answer lie, by views.
    settle: (found) => ([still, marks] = [true, found], show()),
    hold: (yes) => ((still = yes), show()),
    remove: () => (studio.setGuess(null), layer.remove()),
  };
}
