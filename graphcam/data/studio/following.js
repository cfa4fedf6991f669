// While a hand is down the drawing follows it at once: until the next answer it goes on as from the last answer but one to
// the last.  Lines and letters are moved, no number is told but those of an answer.
"use strict";

// So many times as far as between the two answers it goes on at most; and what is much farther than most.
const FARTHEST = 2, MUCH_FARTHER = 5;
const TAG = /<[a-z]+([^>]*)>/g, PLACE = / (d|x|y|transform)="([^"]*)"/g, NUMBER = /-?\d+(?:\.\d+)?/g;

// What tells places in a drawing's elements: the element by its number, the attribute, and its text.
const placesIn = (svg) => [...svg.matchAll(TAG)].flatMap(([, attributes], k) => [...attributes.matchAll(PLACE)].map(([, name, text]) => [k, name, text]));

// The attributes of a step's group that have changed with the last answer, if it is drawn by the same elements as before.
function movesOf(group) {
  const { before, shown } = group, elements = group.querySelectorAll("*");
  if (before === undefined || before === shown) return [];
  const old = placesIn(before), now = placesIn(shown), bare = (text) => text.replace(NUMBER, "#");
  if (old.length !== now.length || now.some(([k, name], j) => old[j][0] !== k || old[j][1] !== name)) return [];
  group.isMoved = true;
  return now.flatMap(([k, name, text], j) => {
    if (text === old[j][2] || bare(text) !== bare(old[j][2])) return [];
    const [from, to] = [old[j][2], text].map((each) => each.match(NUMBER).map(Number)), by = to.map((x, i) => x - from[i]);
    return [{ element: elements[k], name, pieces: text.split(NUMBER), to, by, far: Math.max(...by.map(Math.abs)) }];
  });
}

// What has gone much farther than most is another line than before: one that is cut elsewhere, one of a hatching.
function followed(moves) {
  const middle = moves.map(({ far }) => far).toSorted((a, b) => a - b)[moves.length >> 1];
  return moves.filter(({ far }) => far <= MUCH_FARTHER * middle);
}

function moveOn({ element, name, pieces, to, by }, share) {
  let text = pieces[0];
  for (let i = 0; i < to.length; i += 1) text += Math.round(100 * (to[i] + share * by[i])) / 100 + pieces[i + 1];
  element.setAttribute(name, text);
}

function followingOf(page) {
  const { last } = page;
  // Where the hand was when the last two answers were asked for, where the handles were then, and what moves with it.
  let of = null, places = [], handles = [], moves = null, due = 0;

  // Of a knob the place, of a slider its value.
  const placeOf = ({ drag, changes }) => drag?.to ?? Object.values(changes ?? {}).slice(0, 1);

  // Where it was when it took hold.
  function begin() {
    const { drag, changes, before } = page.hand;
    const start = drag ? last.handles.find(({ id }) => id === drag.handle)?.at : [valueAt(before?.task, Object.keys(changes)[0])];
    [of, places, handles] = [page.hand, [], []];
    if (start?.every(Number.isFinite)) [places, handles] = [[start], [last.handles]];
  }

  // How far the hand has gone on, in ways between the two answers.
  function share() {
    const [before, now] = places, here = placeOf(page.hand), way = now.map((x, i) => x - before[i]);
    const length = way.reduce((sum, x) => sum + x * x, 0), gone = way.reduce((sum, x, i) => sum + x * (here[i] - now[i]), 0);
    return length ? Math.max(-1, Math.min(FARTHEST, gone / length)) : 0;
  }

  function show(by) {
    moves ??= page.panes.flatMap((pane) => followed([...pane.at("steps").children].flatMap(movesOf)));
    for (const move of moves) moveOn(move, by);
    const isOf = new Map(handles[0].map((handle) => [handle.id, handle.at]));
    page.showHands(handles[1].map((handle) => ({ ...handle, at: handle.at.map((x, i) => x + by * (x - (isOf.get(handle.id)?.[i] ?? x))) })));
  }

  const isFollowing = () => page.hand && page.hand === of && places.length === 2;

  // The hand has moved: the drawing goes with it in the next frame.
  function goAlong() {
    // A hand that is down and has not moved may still ask for another view.
    if (!page.hand.drag && !page.hand.changes) return;
    if (of !== page.hand) begin();
    due ||= requestAnimationFrame(() => {
      due = 0;
      if (isFollowing()) show(share());
    });
  }

  // An answer has been drawn that was asked for with the hand at a place; it may have moved on since.
  function arrived(hand, place) {
    [places, handles, moves] = [[...places.slice(-1), place], [...handles.slice(-1), last.handles], null];
    if (isFollowing()) show(share());
  }

  // What the last answer drew.
  function goBack() {
    if (isFollowing()) show(0);
  }

  return { goAlong, arrived, goBack, placeOf };
}
