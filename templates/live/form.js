// Fields and sliders from the table of keys, grouped as in the machine file.

let keyTable = null;
/** The fields as they are shown, by the paths of their keys. */
let fields = new Map();
let formOf = "";

/** The table of keys, with keys that are added to a table in that table. */
function mergedKeys(table) {
  const sections = [];
  for (const section of table.sections) {
    const before = sections.find((one) => one.path === section.path && one.repeated === section.repeated);
    if (before) before.keys.push(...section.keys);
    else sections.push(section);
  }
  return { ...table, sections };
}

/** A number and its unit in a value as typed; null where it is none. */
function quantityOf(typed) {
  const match = /^(Ø?)\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$/.exec(String(typed ?? "").trim());
  return match ? { number: Number(match[2]), unit: match[3] } : null;
}

/** Ends and step of the slider of a value: around it in whole steps, within the range of its key. */
function sliderOf(key, typed) {
  const found = quantityOf(typed);
  if (!found || !key.ranges) return null;
  const sizeIn = (range) => (range.dimension === null ? (found.unit === "" ? 1 : found.unit === "%" ? 0.01 : null) : keyTable.units[range.dimension][found.unit] ?? null);
  const range = key.ranges.find((one) => sizeIn(one) !== null);
  if (!range) return null;
  const size = sizeIn(range);
  const example = Math.abs(quantityOf(key.example)?.number || 1);
  const span = Math.abs(found.number) || example;
  const step = 10 ** (Math.floor(Math.log10(span)) - 2);
  const low = Math.max(range.low / size, found.number > 0 && range.low >= 0 ? found.number / 4 : found.number - span);
  const high = Math.min(range.high / size, found.number + span);
  // Whole steps away from the value: a browser moves a value between two steps to one of them.
  const round = (end) => Number((found.number + Math.trunc((end - found.number) / step) * step).toPrecision(12));
  return { low: round(low), high: round(high), step, unit: found.unit, value: found.number };
}

/** Whether a slider can stay as it is for another value: it is between its ends, on a whole step. */
function isOn({ low, high, step, unit }, found) {
  if (!found || found.unit !== unit || found.number <= low || found.number >= high) return false;
  const steps = (found.number - low) / step;
  return Math.abs(steps - Math.round(steps)) < 1e-6;
}

/** A value of a slider as typed, with the unit that the value had. */
function typedOf(value, slider) {
  return `${Number(Number(value).toPrecision(12))}${slider.unit ? (slider.unit === "%" ? slider.unit : ` ${slider.unit}`) : ""}`;
}

/** The paths of the tables of a section in this design: one, or one for each element of a list. */
function pathsOf(section, answer) {
  if (!section.repeated) return [section.path];
  const heads = [...answer.given].map((path) => path.slice(0, path.lastIndexOf("."))).filter((path) => path.replace(/\[\d+\]/g, "[]") === `${section.path}[]`);
  return [...new Set(heads)];
}

/** One key: its label, a field, and a slider where its value is a number. */
function fieldOf(path, key, answer) {
  const isGiven = answer.given.includes(path);
  const typed = (answer.values ?? {})[path] ?? "";
  const id = `key-${path}`;
  const box = make("div", { className: isGiven ? "field" : "field absent" });
  const label = make("label", { htmlFor: id, title: key.about }, key.name.replace(/_/g, " "));
  const why = make("div", { className: "why", lang: "en" }, key.about);
  const one = { path, key, box, typed, slider: null, range: null };
  if (key.words && !key.ranges) {
    one.input = make("select", { id }, ...(isGiven || key.presence === "default" ? [] : [make("option", { value: "" }, "–")]), ...key.words.map((word) => make("option", { value: word }, word)));
    one.input.addEventListener("change", () => commit([one.input.value === "" ? { remove: path } : { set: { key: path, to: one.input.value } }]));
  } else if (key.file) {
    one.input = fileField(id, path, typed);
  } else {
    one.input = make("input", { id, type: "text", autocomplete: "off" });
    if (key.words) {
      const list = make("datalist", { id: `${id}-words` }, ...key.words.map((word) => make("option", { value: word })));
      one.input.setAttribute("list", list.id);
      box.append(list);
    }
    one.input.addEventListener("change", () => {
      const value = one.input.value.trim();
      commit([value === "" ? { remove: path } : { set: { key: path, to: value } }]);
    });
  }
  one.input.setAttribute("aria-describedby", `${id}-why`);
  why.id = `${id}-why`;
  box.append(label, one.input);
  if (key.ranges) {
    one.range = make("input", { type: "range", "aria-label": key.about, tabIndex: 0 });
    one.range.addEventListener("input", () => {
      one.filled = null;
      one.input.value = typedOf(one.range.value, one.slider);
      draft([{ set: { key: path, to: one.input.value } }]);
    });
    one.range.addEventListener("change", () => commit([{ set: { key: path, to: one.input.value } }]));
    box.append(one.range);
  }
  box.append(why);
  fields.set(path, one);
  return box;
}

/** The file that a key names: one that is in the page, or one of this computer, which is read into the page. */
const CHOOSE = "\u0000choose";
function fileField(id, path) {
  const names = Object.keys(doc.files);
  const list = make("select", { id }, make("option", { value: "" }, "–"), ...names.map((name) => make("option", { value: name }, name)), make("option", { value: CHOOSE }, text("chooseFile")));
  list.addEventListener("change", () => {
    if (list.value !== CHOOSE) return commit([list.value ? { set: { key: path, to: list.value } } : { remove: path }]);
    select(list, doc.last?.values?.[path] ?? "");
    pickFile(".csv,.txt,.tsv,.dat", async (file) => {
      doc.files = { ...doc.files, [file.name]: await file.text() };
      formOf = "";
      commit([{ set: { key: path, to: file.name } }]);
    });
  });
  return list;
}

/** Lets the person choose a file of this computer. */
function pickFile(accept, take) {
  const input = make("input", { type: "file", accept });
  input.addEventListener("change", () => input.files.length && take(input.files[0]));
  input.click();
}

/** Shows a value in a list: its words are the same in capitals; one that is not in the list is added to it. */
function select(list, typed) {
  const same = [...list.options].find(({ value }) => value.toLowerCase() === typed.trim().toLowerCase());
  if (!same) list.append(make("option", { value: typed }, typed || "–"));
  list.value = same ? same.value : typed;
}

/** What a field shows: the value as typed; of "auto" the slider starts from what was found. */
function fillField(one, answer) {
  const typed = (answer.values ?? {})[one.path] ?? "";
  one.typed = typed;
  if (one.input.tagName === "SELECT") select(one.input, typed);
  else if (one.input.value !== typed && document.activeElement !== one.input) one.input.value = typed;
  one.input.placeholder = typed ? "" : (answer.usual ?? {})[one.path] ?? text("example", { value: one.key.example });
  one.box.classList.toggle("changed", typed !== (doc.sent.values?.[one.path] ?? ""));
  if (!one.range) return;
  if (one.filled === typed && typed !== "auto") return;
  one.filled = typed;
  const found = typed === "auto" ? chosenValue(one.path) : typed;
  if (!one.slider || !isOn(one.slider, quantityOf(found))) one.slider = sliderOf(one.key, found);
  one.range.hidden = !one.slider;
  if (!one.slider) return;
  Object.assign(one.range, { min: one.slider.low, max: one.slider.high, step: one.slider.step });
  one.range.value = quantityOf(found).number;
  one.range.setAttribute("aria-valuetext", found);
}

/** What was found for a key that is left to camgen. */
function chosenValue(path) {
  if (path !== "cam.base_radius") return "";
  const values = cams[0].sections?.find((section) => section.key === "cam")?.values ?? [];
  const found = values.find(([label]) => label === "base radius");
  return found ? `${found[1]} mm` : "";
}

/** The form of a design: its tables, the keys that are given first, the others behind a line. */
function form(answer) {
  byId("english").hidden = language === "en";
  const shape = JSON.stringify([doc.name, answer.kind, answer.given, language]);
  if (shape !== formOf) {
    formOf = shape;
    const open = new Set([...byId("fields").querySelectorAll("details[open]")].map((box) => box.dataset.path));
    const isFirst = fields.size === 0;
    fields = new Map();
    const tablesOf = (section) => pathsOf(section, answer).flatMap((path) => {
      const has = section.keys.filter((key) => !key.cams.length || key.cams.includes(answer.kind));
      const of = (key) => (path ? `${path}.${key.name}` : key.name);
      const [given, absent] = [true, false].map((wanted) => has.filter((key) => answer.given.includes(of(key)) === wanted));
      if (!given.length) return absent.length && !section.repeated ? [[path, section, [], absent, of]] : [];
      return [[path, section, given, absent, of]];
    });
    const all = keyTable.sections.flatMap(tablesOf);
    const boxOf = ([path, section, given, absent, of]) => {
      const number = /\[(\d+)\]$/.exec(path);
      const name = path ? path.replace(/\[(\d+)\]/g, (_, index) => ` ${Number(index) + 1}`).replace(/[._-]/g, " ") : text("design");
      const more = absent.length ? make("details", { className: "more" }, make("summary", {}, text("add")), ...absent.map((key) => fieldOf(of(key), key, answer))) : null;
      if (more) more.dataset.path = `${path}+`;
      const box = make("details", { open: isFirst ? /^(follower|cam|limits)/.test(path) && given.length > 0 : false },
        make("summary", { title: section.about }, name, number ? make("span", { className: "muted" }, ` ${(answer.values ?? {})[`${path}.law`] ?? ""}`) : null), ...given.map((key) => fieldOf(of(key), key, answer)), more);
      box.dataset.path = path;
      if (open.has(path)) box.open = true;
      if (more && open.has(more.dataset.path)) more.open = true;
      return box;
    };
    const [has, lacks] = [true, false].map((wanted) => all.filter(([, , given]) => (given.length > 0) === wanted).map(boxOf));
    const rest = make("details", {}, make("summary", {}, text("addTable")), ...lacks);
    rest.dataset.path = "+";
    rest.open = open.has("+");
    byId("fields").replaceChildren(...has, rest);
  }
  for (const one of fields.values()) fillField(one, answer);
  search();
}

/** Shows only the keys whose names or meanings have the words that are looked for. */
function search() {
  const wanted = byId("find").value.trim().toLowerCase().split(/\s+/).filter(Boolean);
  for (const { path, key, box } of fields.values()) {
    const has = `${path} ${path.replace(/_/g, " ")} ${key.about}`.toLowerCase();
    box.hidden = !wanted.every((word) => has.includes(word));
  }
  for (const box of byId("fields").querySelectorAll("details")) {
    const left = box.querySelector(".field:not([hidden])");
    box.hidden = wanted.length > 0 && !left;
    if (wanted.length && left) box.open = true;
  }
}
