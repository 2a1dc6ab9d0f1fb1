// The texts of the page, in the language that is chosen.

const languages = JSON.parse(byId("texts").textContent);
let language = (navigator.languages ?? ["en"]).map((name) => name.slice(0, 2)).find((name) => name in languages) ?? "en";

/** A text by its name, with values in the places of {names}. */
function text(name, values = {}) {
  const found = languages[language].page[name] ?? languages.en.page[name];
  return found.replace(/\{(\w+)\}/g, (_, key) => values[key]);
}

/** The words of the report that a language has, in the place of the English ones. */
function translated(area) {
  const walk = document.createTreeWalker(area, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const node = walk.currentNode;
    const english = node.camgenEnglish ?? node.data;
    const words = english.trim();
    const wanted = words && words in languages[language].report ? english.replace(words, languages[language].report[words]) : english;
    if (node.data === wanted || node.parentElement.closest("[data-text], .field, textarea")) continue;
    node.camgenEnglish = english;
    node.data = wanted;
  }
}

/** Every text of the page itself, and what the report says. */
function speak() {
  document.documentElement.lang = language;
  byId("language").value = language;
  for (const element of document.querySelectorAll("[data-text]")) element.textContent = text(element.dataset.text);
  for (const element of document.querySelectorAll("[data-placeholder]")) element.placeholder = text(element.dataset.placeholder);
  translated(byId("main"));
}
