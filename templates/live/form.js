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

/** Keys of whole numbers: their sliders step from one to the next. */
const WHOLE = new Set(["motion.repeat", "cam.rollers", "cam.advance", "limits.continuity", "cutting.decimals", "cutting.tool", "cutting.program", "as_made.draw"]);
const isWhole = (path) => WHOLE.has(path) || path.endsWith(".degree");

/** One significant digit, downwards or upwards: the ends of a slider are round. */
function roundEnd(value, isUp) {
  if (value === 0) return 0;
  const power = 10 ** Math.floor(Math.log10(Math.abs(value)));
  const digits = Number((value / power).toPrecision(6));
  return Number(((isUp ? Math.ceil(digits) : Math.floor(digits)) * power).toPrecision(12));
}

/** Round ends around a value, within the range of its key. */
function endsAround(value, range, size, example) {
  const reach = Math.abs(value) || example;
  const low = range.low < 0 && value <= 0 ? -roundEnd(2.2 * reach, true) : value > 0 ? roundEnd(value / 3, false) : 0;
  const high = value > 0 ? roundEnd(2.2 * value, true) : value < 0 || range.low < 0 ? roundEnd(2.2 * reach, true) : roundEnd(reach, true);
  return { low: Math.max(range.low / size, low), high: Math.min(range.high / size, high) };
}

/** Ends and step of the slider of a value. The ends of a key stay, and are widened only where its value goes beyond. */
function sliderOf(key, typed, path) {
  const found = quantityOf(typed);
  if (!found || !key.ranges) return null;
  const sizeIn = (range) => (range.dimension === null ? (found.unit === "" ? 1 : found.unit === "%" ? 0.01 : null) : keyTable.units[range.dimension][found.unit] ?? null);
  const range = key.ranges.find((one) => sizeIn(one) !== null);
  if (!range) return null;
  const value = found.number;
  const id = `${path} ${found.unit}`;
  const around = endsAround(value, range, sizeIn(range), Math.abs(quantityOf(key.example)?.number || 1));
  const before = doc.ends.get(id);
  const ends = !before ? around : value >= before.low && value <= before.high ? before : { low: Math.min(before.low, around.low), high: Math.max(before.high, around.high) };
  doc.ends.set(id, ends);
  const step = isWhole(path) ? 1 : 10 ** (Math.floor(Math.log10(Math.max(Math.abs(ends.low), Math.abs(ends.high)) || 1)) - 2);
  // Whole steps away from the value: a browser moves a value between two steps to one of them.
  const round = (end) => Number((value + Math.trunc(Number(((end - value) / step).toPrecision(12))) * step).toPrecision(12));
  return { low: round(ends.low), high: round(ends.high), step, unit: found.unit, value, ends };
}

/** Whether a slider can stay as it is for another value: it is between its ends, on a whole step. */
function isOn({ low, high, step, unit }, found) {
  if (!found || found.unit !== unit || found.number < low || found.number > high) return false;
  const steps = (found.number - low) / step;
  return Math.abs(steps - Math.round(steps)) < 1e-6;
}

// ---- the keys that are changed most often

/** They come first, in this order; of each line the first that the design has. */
const OFTEN = [
  ["motion.rpm"], ["follower.swinging-roller.arm"], ["follower.swinging-roller.pivot_distance", "follower.swinging-flat.pivot_distance"], ["cam.turret_distance"], ["cam.arm"], ["lift"],
  ["follower.roller.offset", "follower.flat.offset", "follower.knife.offset", "follower.swinging-flat.face_offset"],
  ["follower.roller.radius", "follower.roller.diameter", "follower.swinging-roller.radius", "follower.swinging-roller.diameter"],
  ["cam.base_radius", "cam.base_diameter", "cam.outer_radius", "cam.outer_diameter", "cam.run_in"], ["spring.preload"], ["cam.clearance"], ["cam.counter.radius", "cam.counter.diameter"], ["cam.groove_depth"],
  ["cam.roller_distance"], ["cam.roller_height"], ["spring.rate"], ["cam.thickness"], ["limits.pressure_angle"],
];
const MOST_OFTEN = 6;

/** The key of the segment that rises highest. */
function liftKey(answer) {
  const segments = answer.motion?.segments ?? [];
  const highest = segments.reduce((best, { position }, index) => (best < 0 || position[1] > segments[best].position[1] + 1e-9 ? index : best), -1);
  return ["to", "by"].map((name) => `motion.segment[${highest}].${name}`).find((path) => answer.given.includes(path)) ?? null;
}

/** The paths of the keys that are shown with a slider beside the cam. */
function oftenChanged(answer, known) {
  const has = (path) => path !== null && known.has(path) && (quantityOf((answer.values ?? {})[path]) !== null || (answer.values ?? {})[path] === "auto");
  const listed = OFTEN.map((names) => names.map((name) => (name === "lift" ? liftKey(answer) : name)).find(has)).filter(Boolean);
  const rest = answer.given.filter((path) => has(path) && /^(follower|cam|spring|press|bed|air|buffer|limits)/.test(path) && !listed.includes(path));
  return [...listed, ...rest].slice(0, MOST_OFTEN);
}

/** What such a key is called: its own name may mean anything without its table. */
function oftenName(path, key) {
  const id = path.startsWith("motion.segment[") ? "key_lift" : `key_${path.replace(/^follower\.[a-z-]+\./, "follower.")}`;
  if (languages[language].page[id]) return text(id);
  const name = key.name.replace(/_/g, " ");
  return name[0].toUpperCase() + name.slice(1);
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
function fieldOf(path, key, answer, isOften = false) {
  const isGiven = answer.given.includes(path);
  const typed = (answer.values ?? {})[path] ?? "";
  const id = `key-${path}`;
  const box = make("div", { className: isGiven ? "field" : "field absent" });
  const label = make("label", { htmlFor: id, title: `${path}: ${key.about}` }, isOften ? oftenName(path, key) : key.name.replace(/_/g, " "));
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
      const value = withFormerUnit(one.input.value.trim(), one.seen, key);
      commit([value === "" ? { remove: path } : { set: { key: path, to: value } }]);
    });
  }
  one.input.setAttribute("aria-describedby", `${id}-why`);
  why.id = `${id}-why`;
  box.append(label, one.input);
  if (key.ranges && key.words?.includes("auto")) {
    // A chip: moving the slider switches it off, a click switches it on again.
    one.auto = make("button", { type: "button", className: "auto", "aria-pressed": "false", title: key.about }, "auto");
    one.auto.addEventListener("click", () => commit([{ set: { key: path, to: one.typed === "auto" ? chosenValue(path) || key.example : "auto" } }]));
    box.append(one.auto);
  }
  if (key.ranges) {
    one.range = make("input", { type: "range", "aria-label": isOften ? label.textContent : `${path.replace(/[._]/g, " ")}`, tabIndex: 0 });
    one.range.addEventListener("input", () => {
      one.filled = null;
      one.input.value = typedOf(one.range.value, one.slider);
      draft([{ set: { key: path, to: one.input.value } }]);
    });
    one.range.addEventListener("change", () => commit([{ set: { key: path, to: one.input.value } }]));
    one.ends = make("span", { className: "ends", "aria-hidden": "true" }, make("span"), make("span"), make("span"));
    one.zones = make("span", { className: "zones", "aria-hidden": "true" });
    box.append(one.range, one.zones, one.ends);
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
  one.seen = typedInUnits(typed, one.key, answer);
  if (one.input.tagName === "SELECT") select(one.input, typed);
  else if (one.input.value !== one.seen && document.activeElement !== one.input) one.input.value = one.seen;
  const usual = (answer.usual ?? {})[one.path];
  one.input.placeholder = typed ? "" : usual ? typedInUnits(usual, one.key, answer) : text("example", { value: one.key.example });
  one.box.classList.toggle("changed", typed !== (doc.sent.values?.[one.path] ?? ""));
  if (!one.range) return;
  if (one.filled === one.seen && typed !== "auto") return;
  one.filled = one.seen;
  const found = typed === "auto" ? chosenValue(one.path) : one.seen;
  if (!one.slider || !isOn(one.slider, quantityOf(found))) one.slider = sliderOf(one.key, found, one.path);
  one.range.hidden = one.ends.hidden = one.zones.hidden = !one.slider;
  one.auto?.setAttribute("aria-pressed", String(typed === "auto"));
  if (!one.slider) return;
  const notes = [shown(one.slider.ends.low), typed === "auto" ? `auto: ${shown(quantityOf(found).number)} ${quantityOf(found).unit}` : "", shown(one.slider.ends.high)];
  [...one.ends.children].forEach((end, at) => end.textContent !== notes[at] && (end.textContent = notes[at]));
  Object.assign(one.range, { min: one.slider.low, max: one.slider.high, step: one.slider.step });
  one.range.value = quantityOf(found).number;
  one.range.setAttribute("aria-valuetext", found);
}

/** What was found for a key that is left to camgen. */
function chosenValue(path) {
  const name = { "cam.base_radius": "base radius", "cam.outer_radius": "outer radius" }[path];
  if (!name) return "";
  const values = cams[0].sections?.find((section) => section.key === "cam")?.values ?? [];
  const found = values.find(([label]) => label === name);
  return found ? `${found[1]} ${found[2]}` : "";
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
    const known = new Map(all.flatMap(([, , given, absent, of]) => [...given, ...absent].map((key) => [of(key), key])));
    const often = oftenChanged(answer, known);
    byId("chosen").replaceChildren(...often.map((path) => fieldOf(path, known.get(path), answer, true)));
    const isElsewhere = (of) => (key) => !often.includes(of(key));
    const boxOf = ([path, section, given, absent, of]) => {
      const number = /\[(\d+)\]$/.exec(path);
      const name = path ? path.replace(/\[(\d+)\]/g, (_, index) => ` ${Number(index) + 1}`).replace(/[._-]/g, " ") : text("design");
      const more = absent.length ? make("details", { className: "more" }, make("summary", {}, text("add")), ...absent.filter(isElsewhere(of)).map((key) => fieldOf(of(key), key, answer))) : null;
      if (more) more.dataset.path = `${path}+`;
      const box = make("details", { open: isFirst ? /^(follower|cam|limits)/.test(path) && given.length > 0 : false },
        make("summary", { title: section.about }, name, number ? make("span", { className: "muted" }, ` ${(answer.values ?? {})[`${path}.law`] ?? ""}`) : null), ...given.filter(isElsewhere(of)).map((key) => fieldOf(of(key), key, answer)), more);
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
  if (wanted.length) byId("all-keys").open = true;
  for (const box of byId("fields").querySelectorAll("details")) {
    const left = box.querySelector(".field:not([hidden])");
    box.hidden = wanted.length > 0 && !left;
    if (wanted.length && left) box.open = true;
  }
}
