// The mechanism: every position was computed before.  Here arrays are looked up at the cam angle, and the cam is turned.
// Lengths are in mm with y up, so the scene stands on its head.
"use strict";

// A number as the language writes it, with its unit; a dash where there is none.
function writtenBy(decimal) {
  return (value, digits, unit) =>
    (value === null ? "–" : value.toFixed(digits).replace("-", "−").replace(".", decimal) + unit);
}

function drawSvg(kind, name, attributes, parent) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", kind);
  element.setAttribute("class", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  parent.append(element);
  return element;
}

const pathOf = (points, closed = false) => `M${points.map((p) => p.join(" ")).join("L")}${closed ? "Z" : ""}`;

// The mechanism in a picture of SVG; what it had is replaced.
function mechanismOf(picture, mechanism) {
  const { arrays, sizes, step } = mechanism;
  const last = arrays.trace.length - 1;
  const scene = drawSvg("g", "upright", { transform: "scale(1 -1)" }, picture);
  for (const before of picture.querySelectorAll(".upright")) if (before !== scene) before.remove();

  const draw = (kind, name, attributes, parent = scene) => drawSvg(kind, name, attributes, parent);
  const set = (element, attributes) => {
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  };
  const along = ([x, y], degrees, length) => {
    const angle = degrees * Math.PI / 180;
    return [x + length * Math.cos(angle), y + length * Math.sin(angle)];
  };
  const line = (a, b) => ({ d: pathOf([a, b]) });
  const written = writtenBy(mechanism.decimal);

  // --- what stands, what turns, what follows -----------------------------------------------------------------------

  const unit = sizes.unit;  // so long is a small thing of this mechanism
  for (const mark of mechanism.ground) draw("path", mark.kind, { d: pathOf(mark.points, mark.closed) });
  const cam = draw("g", "cam", {});
  draw("path", "body", { d: pathOf(mechanism.profile, true) }, cam);
  if (mechanism.pitch) draw("path", "pitch", { d: pathOf(mechanism.pitch, true) }, cam);
  draw("path", "mark", line([0, 0], mechanism.mark), cam);
  draw("circle", "hub", { cx: 0, cy: 0, r: unit });
  draw("circle", "hole", { cx: 0, cy: 0, r: unit / 3 });

  const rod = draw("path", "rod", {});
  const roller = draw("circle", sizes.roller ? "roller" : "roller pin", { r: sizes.roller || unit / 3 });
  const motion = draw("path", "motion", {});
  const velocity = draw("path", "velocity", {}), centre = draw("circle", "instant", { r: unit / 2.5 });
  const centreName = draw("text", "instant-name", { transform: "scale(1 -1)", "font-size": 1.9 * unit });
  const normal = draw("path", "normal", {});
  const arc = draw("path", "arc", {});
  const contact = draw("circle", "contact", { r: unit / 3 });
  const alpha = draw("text", "alpha", { transform: "scale(1 -1)", "font-size": 2.4 * unit });

  // --- the position at a cam angle -----------------------------------------------------------------------------------

  // At the place of the arrays that is nearest to so many degrees.
  const placeAt = (degrees) => Math.max(0, Math.min(last, Math.round(degrees / step)));
  const phaseAt = (degrees) => mechanism.phases.findLast((one) => one.start <= degrees) || mechanism.phases[0];

  function follower(trace, direction, normal) {
    if (mechanism.kind === "arm") set(rod, line(mechanism.pivot, trace));
    if (mechanism.kind === "stem") set(rod, line(trace, along(trace, direction, sizes.stem)));
    if (mechanism.kind === "face") {
      const [left, right] = sizes.face;
      set(rod, { d: pathOf([[left, trace[1]], [right, trace[1]]]) + pathOf([[0, trace[1]], [0, trace[1] + sizes.stem]]) });
    }
    if (mechanism.kind === "blade") {
      // From the pivot square to the face to its foot on it, and along the face to its end.
      const angle = (normal + 90) * Math.PI / 180, way = [Math.cos(angle), Math.sin(angle)], pivot = mechanism.pivot;
      const from = (pivot[0] - trace[0]) * way[0] + (pivot[1] - trace[1]) * way[1];
      const foot = [trace[0] + from * way[0], trace[1] + from * way[1]];
      set(rod, { d: pathOf([pivot, foot, along(foot, normal + 90, sizes.face[1])]) });
    }
  }

  // The instant centre of cam and follower lies on the normal and on the line of centres, or of a stem on that through the
  // cam centre square to its motion: there both have one velocity, and its distance from the cam centre is v.
  function instantCentre([x, y], steep, direction) {
    const turn = (degrees) => [Math.cos(degrees * Math.PI / 180), Math.sin(degrees * Math.PI / 180)], n = turn(steep);
    const [ax, ay] = mechanism.pivot[0] || mechanism.pivot[1] ? [-mechanism.pivot[1], mechanism.pivot[0]] : turn(direction);
    const far = -(x * ax + y * ay) / (n[0] * ax + n[1] * ay);
    return [x + far * n[0], y + far * n[1]];
  }

  function show(k) {
    const trace = arrays.trace[k], touch = arrays.contact[k], phi = k * step;
    const direction = arrays.motion[k], steep = arrays.normal[k], reach = sizes.reach;
    cam.setAttribute("transform", `rotate(${mechanism.sigma * phi})`);
    set(roller, { cx: trace[0], cy: trace[1] });
    set(contact, { cx: touch[0], cy: touch[1] });
    follower(trace, direction, steep);
    set(motion, line(along(trace, direction, -0.3 * reach), along(trace, direction, reach)));
    set(normal, line(touch, along(touch, steep, sizes.roller + reach)));
    const [px, py] = instantCentre(touch, steep, direction), isFar = !(Math.hypot(px, py) < 4 * reach);
    set(velocity, { d: isFar ? "" : pathOf([[0, 0], [px, py]]) + pathOf([touch, [px, py]]) });
    set(centre, isFar ? { visibility: "hidden" } : { visibility: "visible", cx: px, cy: py });
    set(centreName, { x: px + 0.7 * unit, y: -py + 2.2 * unit, visibility: isFar ? "hidden" : "visible" });
    centreName.textContent = "P";
    const from = along(trace, direction, 0.72 * reach), to = along(trace, steep, 0.72 * reach);
    const turn = ((steep - direction + 540) % 360) - 180;
    set(arc, { d: `M${from.join(" ")}A${0.72 * reach} ${0.72 * reach} 0 0 ${turn > 0 ? 1 : 0} ${to.join(" ")}` });
    // Beside the end of the normal, on the side away from the motion.
    const [x, y] = along(touch, steep, sizes.roller + reach), side = turn > 0 ? -1 : 1;
    set(alpha, { x: x + side * unit, y: -y, "text-anchor": side > 0 ? "start" : "end" });
    if (arrays.pressure_angle) {
      const angle = arrays.pressure_angle[k];
      alpha.textContent = `α = ${written(angle, 1, "°")}`;
    }
  }

  // What is read off there, written.
  const read = (name, k) => written(arrays[name][k], mechanism.digits[name], mechanism.units[name]);
  const readPhi = (k) => written(k * step, 1, "°");

  return { cam, show, placeAt, phaseAt, read, readPhi, last };
}

// The course of a quantity over a turn, in a picture 360 wide and 60 high; moves its cursor to a place.
function sparkOf(picture, mechanism, name) {
  const values = mechanism.arrays[name], { step } = mechanism;
  const known = values.filter((value) => value !== null);
  const low = Math.min(0, ...known), high = Math.max(0, ...known), span = high - low || 1;
  const y = (value) => 56 - 52 * (value - low) / span;
  const points = values.flatMap((value, k) => (value === null ? [] : [[k * step, y(value).toFixed(1)]]));
  picture.replaceChildren();
  drawSvg("path", "axis", { d: `M0 ${y(0)}H360` }, picture);
  drawSvg("path", "curve", { d: pathOf(points) }, picture);
  const cursor = drawSvg("path", "cursor", {}, picture);
  return (k) => cursor.setAttribute("d", `M${k * step} 0V60`);
}
