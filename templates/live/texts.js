// The texts of the page, in the language that is chosen.

const languages = JSON.parse(byId("texts").textContent);
let language = (navigator.languages ?? ["en"]).map((name) => name.slice(0, 2)).find((name) => name in languages) ?? "en";

/** A text by its name, with values in the places of {names}. */
function text(name, values = {}) {
  const found = languages[language].page[name] ?? languages.en.page[name];
  return found.replace(/\{(\w+)\}/g, (_, key) => values[key]);
}

// The strip speaks the language of the page, and names checks as people do.
phrase = text;
checkName = (check) => (check.disc ? `${check.disc}: ` : "") + (languages[language].page[`check_${check.check}`] ?? words(check.check));

/** Words of the report in the chosen language, where it has them: as a whole, or by the patterns of lines with numbers in them. */
function spoken(words) {
  const { report, patterns } = languages[language];
  if (words in report) return report[words];
  if (!/[a-z]{2}/.test(words)) return words;
  return patterns.reduce((line, [pattern, german]) => line.replace(new RegExp(pattern, "g"), german), words);
}

/** The words of a text of the page in the chosen language; what was there before is kept for another. */
function translatedText(node) {
  if (node.data === node.camgenSaid) return;
  node.camgenEnglish = node.data;
  const line = node.data.trim();
  const said = line && spoken(line);
  if (!line || said === line || node.parentElement?.closest("[data-text], #strip, #stack, #scale-bar, #paint, #formats, .field, textarea, #cards, #new, #laws, #tabs, .note, #verdict tbody th, #fields > details > summary, #results tbody th, #differences tbody th, #differences h3, #results p, #results h3, #missing li")) return;
  node.camgenSaid = node.data.replace(line, () => said);
  node.data = node.camgenSaid;
}

const textsOf = (area) => {
  const walk = document.createTreeWalker(area, NodeFilter.SHOW_TEXT);
  const found = [];
  while (walk.nextNode()) found.push(walk.currentNode);
  return found;
};

/** What the report writes is translated as it is written. */
const listener = new MutationObserver((changes) => {
  if (language === "en") return;
  for (const { type, target, addedNodes } of changes) {
    if (type === "characterData") translatedText(target);
    else for (const node of addedNodes) (node.nodeType === Node.TEXT_NODE ? [node] : textsOf(node)).forEach(translatedText);
  }
});
const spokenAreas = () => [byId("main"), document.querySelector("footer")];

/** Every text of the page itself, and what the report says. */
function speak() {
  document.documentElement.lang = language;
  byId("language").value = language;
  for (const element of document.querySelectorAll("[data-text]")) element.textContent = text(element.dataset.text);
  for (const element of document.querySelectorAll("[data-placeholder]")) element.placeholder = text(element.dataset.placeholder);
  for (const element of document.querySelectorAll("[data-label]")) element.setAttribute("aria-label", text(element.dataset.label));
  themed();
  listener.disconnect();
  for (const node of spokenAreas().flatMap(textsOf)) {
    if (node.camgenSaid !== undefined && node.data === node.camgenSaid) node.data = node.camgenEnglish;
    node.camgenSaid = undefined;
    if (language !== "en") translatedText(node);
  }
  for (const area of spokenAreas()) if (language !== "en") listener.observe(area, { childList: true, characterData: true, subtree: true });
}

/** The button of the report that chooses light or dark, in the chosen language. */
function themed() {
  byId("look").textContent = text(byId("theme").textContent === "Dark" ? "dark" : "light");
}
