// Elements of the page: texts go in as texts, with their indices set lower.
"use strict";

function make(kind, attributes = {}, ...inside) {
  const element = document.createElement(kind);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") lettered(element, value);
    else if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...inside.flat().filter((one) => one !== null && one !== undefined && one !== false));
  return element;
}

// φ_у and φ_д.с have indices that Unicode lacks the letters for.
function lettered(element, text) {
  element.replaceChildren();
  let end = 0;
  for (const found of String(text).matchAll(/(?<![\p{L}\p{N}_])([Α-Ωα-ω])_([\p{L}\p{N}]+(?:\.[\p{L}\p{N}]+)*)/gu)) {
    element.append(text.slice(end, found.index), found[1]);
    const index = document.createElement("sub");
    index.textContent = found[2].normalize("NFKC");
    element.append(index);
    end = found.index + found[0].length;
  }
  element.append(String(text).slice(end));
  return element;
}

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

// Elements made anew keep the focus where it was, by the key that they bear.
function keepingFocus(parent, remake) {
  const key = parent.contains(document.activeElement) ? document.activeElement.dataset.key : undefined;
  remake();
  if (key !== undefined) parent.querySelector(`[data-key="${CSS.escape(key)}"]`)?.focus({ preventScroll: true });
}
