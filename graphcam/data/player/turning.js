// The player's mechanism: its slider, its keys, its time.
"use strict";
(() => {
  const { mechanism, words } = JSON.parse(document.getElementById("data").textContent);
  const at = (id) => document.getElementById(id);
  const { step } = mechanism;
  const turned = mechanismOf(at("scene"), mechanism), { last } = turned;
  const cursors = mechanism.live.map((name) => sparkOf(at(`spark-${name}`), mechanism, name));

  function show(k) {
    turned.show(k);
    at("live-phi").textContent = turned.readPhi(k);
    for (const name of mechanism.live) at(`live-${name}`).textContent = turned.read(name, k);
    cursors.forEach((move) => move(k));
    const phase = turned.phaseAt(k * step);
    at("phase").innerHTML = phase.heading;
    document.querySelectorAll("#mechanism .chapters span").forEach((bar, j) => bar.classList.toggle("here", mechanism.phases[j] === phase));
    at("phi").value = k * step;
    const told = [`φ = ${turned.readPhi(k)}`, at("scene").querySelector(".alpha").textContent];
    at("phi").setAttribute("aria-valuetext", told.filter(Boolean).join(", "));
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
