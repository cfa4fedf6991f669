// The teaching modes by their names: each is {enter(), leave()}, and what changed(names) while it is on.
"use strict";

const studioModes = {};

// --- what their cards are made of ------------------------------------------------------------------------------------

const wordOf = (name) => studio.words[name] ?? name;
const modeCard = (mode, inside) => html`<section class="mode-card" aria-label=${wordOf(mode)}>${inside}</section>`;
const modeButton = (id, name, act, isMain = false) =>
  html`<button type="button" class=${isMain ? "main" : nothing} id=${id} @click=${act}>${wordOf(name)}</button>`;
const focusOn = (id) => document.getElementById(id)?.focus({ preventScroll: true });
