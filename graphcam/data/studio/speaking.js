// The page in the language for which an address asks: it knows its own words in all of them.
"use strict";

function speak(config, name) {
  const { words, remark } = config.spoken[name];
  const other = new Map(Object.entries(config.words).map(([key, text]) => [text, words[key]]));
  // What stands in the page already, without the key that is named behind it.
  const translated = (text) => text.replace(/\S.*?(?= \([+−]\)$|\s*$)/s, (found) => other.get(found) ?? found);
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { currentNode: text } = texts;
    if (!text.parentElement.closest("script, style")) text.data = translated(text.data);
  }
  for (const attribute of ["title", "aria-label"]) {
    for (const element of document.querySelectorAll(`[${attribute}]`)) element.setAttribute(attribute, translated(element.getAttribute(attribute)));
  }
  document.title = translated(document.title);
  document.documentElement.lang = config.language = name;
  Object.assign(document.getElementById("remark"), { textContent: remark, hidden: !remark });
  Object.assign(config.words, words);
}
