// The mechanism: every position was computed before.  Here arrays are looked up at the cam angle, and the cam is turned.
// Lengths are in mm with y up, so the scene stands on its head.
"use strict";
(() => {
  const { mechanism, words } = JSON.parse(document.getElementById("data").textContent);
  const at = (id) => document.getElementById(id);
  const { arrays, sizes, step } = mechanism;
  const last = arrays.trace.length - 1;
  const scene = document.createElementNS("http://www.w3.org/2000/svg", "g");
  scene.setAttribute("transform", "scale(1 -1)");
  at("scene").append(scene);

  function draw(kind, name, attributes, parent = scene) {
    const element = document.createElementNS("http://www.w3.org/2000/svg", kind);
    element.setAttribute("class", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    parent.append(element);
    return element;
  }
  const set = (element, attributes) => {
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  };
  const path = (points, closed = false) => `M${points.map((p) => p.join(" ")).join("L")}${closed ? "Z" : ""}`;
  const along = ([x, y], degrees, length) => {
    const angle = degrees * Math.PI / 180;
    return [x + length * Math.cos(angle), y + length * Math.sin(angle)];
  };
  const line = (a, b) => ({ d: path([a, b]) });

  // --- what stands, what turns, what follows -----------------------------------------------------------------------

  const unit = sizes.unit;  // so long is a small thing of this mechanism
  for (const mark of mechanism.ground) draw("path", mark.kind, { d: path(mark.points, mark.closed) });
  const cam = draw("g", "cam", { id: "cam" });
  draw("path", "body", { d: path(mechanism.profile, true) }, cam);
  if (mechanism.pitch) draw("path", "pitch", { d: path(mechanism.pitch, true) }, cam);
  draw("path", "mark", line([0, 0], mechanism.mark), cam);
  draw("circle", "hub", { cx: 0, cy: 0, r: unit });
  draw("circle", "hole", { cx: 0, cy: 0, r: unit / 3 });

  const rod = draw("path", "rod", { id: "rod" });
  const roller = draw("circle", "roller", { id: "roller", r: sizes.roller || unit / 3 });
  if (!sizes.roller) roller.classList.add("pin");
  const motion = draw("path", "motion", { id: "motion" });
  const normal = draw("path", "normal", { id: "normal" });
  const arc = draw("path", "arc", {});
  const contact = draw("circle", "contact", { id: "contact", r: unit / 3 });
  const alpha = draw("text", "alpha", { id: "alpha", transform: "scale(1 -1)", "font-size": 2.4 * unit });

  // --- the diagrams beside it --------------------------------------------------------------------------------------

  const cursors = mechanism.live.map((name) => {
    const values = arrays[name], spark = at(`spark-${name}`);
    const known = values.filter((value) => value !== null);
    const low = Math.min(0, ...known), high = Math.max(0, ...known), span = high - low || 1;
    const y = (value) => 56 - 52 * (value - low) / span;
    const points = values.flatMap((value, k) => (value === null ? [] : [[k * step, y(value).toFixed(1)]]));
    draw("path", "axis", { d: `M0 ${y(0)}H360` }, spark);
    draw("path", "curve", { d: path(points) }, spark);
    const cursor = draw("path", "cursor", {}, spark);
    return (k) => cursor.setAttribute("d", `M${k * step} 0V60`);
  });

  // --- the position at a cam angle -----------------------------------------------------------------------------------

  const written = (value, digits, unitName) =>
    value === null ? "–" : value.toFixed(digits).replace("-", "−").replace(".", mechanism.decimal) + unitName;

  function show(k) {
    const trace = arrays.trace[k], touch = arrays.contact[k], phi = k * step;
    const direction = arrays.motion[k], steep = arrays.normal[k], reach = sizes.reach;
    cam.setAttribute("transform", `rotate(${mechanism.sigma * phi})`);
    set(roller, { cx: trace[0], cy: trace[1] });
    set(contact, { cx: touch[0], cy: touch[1] });
    if (mechanism.kind === "arm") set(rod, line(mechanism.pivot, trace));
    if (mechanism.kind === "stem") set(rod, line(trace, along(trace, direction, sizes.stem)));
    if (mechanism.kind === "face") {
      const [left, right] = sizes.face;
      set(rod, { d: path([[left, trace[1]], [right, trace[1]]]) + path([[0, trace[1]], [0, trace[1] + sizes.stem]]) });
    }
    set(motion, line(along(trace, direction, -0.3 * reach), along(trace, direction, reach)));
    set(normal, line(touch, along(touch, steep, sizes.roller + reach)));
    const angle = arrays.pressure_angle[k];
    const from = along(trace, direction, 0.72 * reach), to = along(trace, steep, 0.72 * reach);
    const turn = ((steep - direction + 540) % 360) - 180;
    set(arc, { d: `M${from.join(" ")}A${0.72 * reach} ${0.72 * reach} 0 0 ${turn > 0 ? 1 : 0} ${to.join(" ")}` });
    // Beside the end of the normal, on the side away from the motion.
    const [x, y] = along(touch, steep, sizes.roller + reach), side = turn > 0 ? -1 : 1;
    set(alpha, { x: x + side * unit, y: -y, "text-anchor": side > 0 ? "start" : "end" });
    alpha.textContent = `α = ${written(angle, 1, "°")}`;
    at("live-phi").textContent = written(phi, 1, "°");
    for (const name of mechanism.live) at(`live-${name}`).textContent = written(arrays[name][k], mechanism.digits[name], mechanism.units[name]);
    cursors.forEach((move) => move(k));
    const phase = mechanism.phases.findLast((one) => one.start <= phi) || mechanism.phases[0];
    at("phase").innerHTML = phase.heading;
    document.querySelectorAll("#mechanism .chapters span").forEach((bar, j) => bar.classList.toggle("here", mechanism.phases[j] === phase));
    at("phi").value = phi;
    at("phi").setAttribute("aria-valuetext", `φ = ${written(phi, 1, "°")}, α = ${written(angle, 1, "°")}`);
  }

  // --- time ------------------------------------------------------------------------------------------------------------

  let phi = 0, turning = false, before = null;

  function tick(now) {
    if (!turning) return;
    if (before !== null) phi = (phi + (now - before) * Number(at("speed").value) * 360 / 60000) % 360;
    before = now;
    show(Math.round(phi / step) % last);
    requestAnimationFrame(tick);
  }

  function turn(on) {
    turning = on;
    before = null;
    document.body.classList.toggle("turning", on);
    for (const name of ["title", "aria-label"]) at("play").setAttribute(name, on ? words.pause : words.play);
    if (on) requestAnimationFrame(tick);
  }

  function to(degrees) {
    turn(false);
    phi = (degrees + 360) % 360;
    show(degrees === 360 ? last : Math.round(phi / step));
  }

  at("play").addEventListener("click", () => turn(!turning));
  at("phi").addEventListener("input", () => to(Number(at("phi").value)));
  document.addEventListener("shown", (event) => {
    if (event.detail !== "mechanism") turn(false);
  });
  document.addEventListener("keydown", (event) => {
    if (at("mechanism").hidden || event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select, .words, [role=tablist]")) return;
    const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 15, PageDown: -15 }[event.key];
    if (by) to(Math.round(phi) + by);
    else if (event.key === "Home") to(0);
    else if (event.key === "End") to(360);
    else if (event.key === " " && !event.target.closest("button")) turn(!turning);
    else return;
    event.preventDefault();
  });
  show(0);
})();
