// A board: what a pane shows of the drawing at a part of a step, and how strongly.  What an act left is named by it and,
// where it is drawn in parts, by the places: [act, [place, ...]], or [act, null] for all of it.
"use strict";

function boardOf(pane, steps) {
  const groups = steps.map((step) => pane.querySelector(`[data-group="${step.group}"]`));
  // The title of a view appears with the first step in it, and what it tells of a scale with the step that finds it.
  const titles = [...pane.querySelectorAll("[data-view]")]
    .map((title) => [title, Math.max(title.dataset.since ?? 0, steps.findIndex((step) => step.view === title.dataset.view))]);
  const pieces = new Map();
  for (const piece of pane.querySelectorAll(".step [data-act]")) {
    const { act } = piece.dataset;
    pieces.set(act, [...(pieces.get(act) || []), piece]);
  }
  const viewOf = (piece) => steps[groups.indexOf(piece.closest(".step"))].view;
  let marked = [], beside = new Set();

  const at = (piece) => (piece.dataset.at === undefined ? null : Number(piece.dataset.at));

  // The pieces of those places, for every name; what is not drawn in parts is lit as a whole, if nothing else is.
  function piecesOf(names) {
    const all = names.map(([act]) => pieces.get(String(act)) || []);
    const own = names.map(([, places], k) => (places ? all[k].filter((piece) => places.includes(at(piece))) : all[k]));
    return own.some((found) => found.length) ? own : all.map((some) => some.filter((piece) => at(piece) === null));
  }

  // The part with which a piece appears: the first that draws its place, of what is not drawn in parts the last.  What
  // no part draws, as a number that is read off, appears with the last part that does its act, else with the first.
  function partOf(piece, parts) {
    const { act } = piece.dataset, place = at(piece);
    const draws = ([drawn, places]) => String(drawn) === act && (place === null || !places || places.includes(place));
    const drawing = parts.map((part, k) => (part.draws.some(draws) ? k : -1)).filter((k) => k >= 0);
    if (drawing.length) return drawing.at(place === null ? -1 : 0);
    return Math.max(0, parts.findLastIndex((part) => part.moves.some(([done]) => String(done) === act)));
  }

  // A step whole (part null), or as far as a part of it.
  function show(current, part) {
    groups.forEach((group, j) => {
      group.classList.toggle("later", j > current);
      group.classList.toggle("former", j < current);
      group.classList.toggle("current", j === current);
    });
    titles.forEach(([title, first]) => title.classList.toggle("later", first > current));
    marked.forEach((piece) => piece.classList.remove("later", "done", "now", "lit"));
    const { parts } = steps[current];
    marked = part === null ? [] : [...groups[current].children];
    for (const piece of marked) {
      const own = partOf(piece, parts);
      piece.classList.add(own > part ? "later" : own < part ? "done" : "now");
    }
    // Of a step in parts that is shown whole all would be lit.
    const told = parts[part ?? 0], sources = part === null && parts.length > 1 ? [] : piecesOf(told.lit);
    beside = new Set(sources.map((found) => viewBeside(steps[current].view, found)));
    for (const piece of sources.flat()) {
      piece.classList.add("lit");
      marked.push(piece);
    }
  }

  // The other view in which pieces are seen, if none of them is seen in the own one.
  function viewBeside(own, found) {
    const seen = found.filter((piece) => !piece.closest(".later")).map(viewOf);
    return seen.includes(own) ? undefined : seen[0];
  }

  function point(names) {
    for (const piece of pane.querySelectorAll(".pointed")) piece.classList.remove("pointed");
    for (const piece of piecesOf(names).flat()) piece.classList.add("pointed");
    pane.classList.toggle("pointing", names.length > 0);
  }

  function putAway(step, away) {
    groups[step].classList.toggle("away", away);
  }

  // The box about what is drawn now and what is lit beside it on the page of a step, in millimetres.
  function focus() {
    const boxes = [...pane.querySelectorAll("svg.page:not(.away) :is(.now, .lit):not(.later)")]
      .map((piece) => piece.getBBox());
    return boxes.length ? around(boxes.map((box) => [box.x, box.y, box.width, box.height])) : null;
  }

  return { show, point, putAway, focus, beside: () => [...beside].filter(Boolean) };
}

// The box about boxes: left, top, width, height.
function around(boxes) {
  const left = Math.min(...boxes.map((box) => box[0])), right = Math.max(...boxes.map((box) => box[0] + box[2]));
  const top = Math.min(...boxes.map((box) => box[1])), bottom = Math.max(...boxes.map((box) => box[1] + box[3]));
  return [left, top, right - left, bottom - top];
}
