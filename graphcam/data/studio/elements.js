// Elements of the page are rendered by lit-html from what they show; texts go in with their indices set lower.
"use strict";

const { html, svg, render, nothing, live, repeat } = lit;

// φ_у and φ_д.с have indices that Unicode lacks the letters for.
const INDEXED = /(?<![\p{L}\p{N}_])([Α-Ωα-ω])_([\p{L}\p{N}]+(?:\.[\p{L}\p{N}]+)*)/u;

// A text between its indices: of three pieces the last is one.
const letters = (text) =>
  String(text).split(INDEXED).map((piece, k) => (k % 3 === 2 ? html`<sub>${piece.normalize("NFKC")}</sub>` : piece));

// What a list offers, [[value, text], ...]; each has an element of its own, for Chromium makes a list as wide as the
// texts that came with their elements.
const options = (all, isChosen) => repeat(all, ([value]) => value, ([value, text], k) =>
  html`<option value=${value} .selected=${isChosen(value, k)}>${letters(text)}</option>`);

// A number as short as it is exact to a hundredth of its step, with the minus sign of print.
function shortNumber(value, decimal = ".") {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  return String(Math.round(value * 1e6) / 1e6).replace("-", "−").replace(".", decimal);
}

// What was typed as a number; NaN if it is none.
function typedNumber(text) {
  const plain = text.trim().replace("−", "-").replace(",", ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}

// Whether a word would not go into so wide a box [pixels], by the width of a small letter.
const isTight = (word, wide) => wide < 6.6 * word.length + 6;
