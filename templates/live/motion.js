// The motion program as a diagram: nodes that can be dragged, moved by keys and typed; laws, dwells and returns.

const EDITOR = { width: 720, heights: [190, 80, 80, 80], left: 56, right: 14, gap: 30, top: 24 };
const CURVES = [["lift", /^lift_/], ["velocity", /^velocity_(?!cut)/], ["acceleration", /^acceleration_(?!cut)/], ["jerk", /^jerk_/]];

const cleaned = (value) => Number(value.toFixed(4));

/** The changes that put the end of a segment to a place and a position: the segment behind it keeps its own end. */
function nodeMoved(answer, index, at, position) {
  const { segments, units } = answer.motion;
  const of = (segment, name) => `motion.segment[${segment}].${name}`;
  const given = (segment, name) => answer.given.includes(of(segment, name));
  const set = (key, value, unit) => ({ set: { key, to: typedLength(value, unit) } });
  const changes = [];
  if (at !== null) {
    if (given(index, "until")) changes.push(set(of(index, "until"), at, units[0]));
    else changes.push(set(of(index, "over"), at - segments[index].at[0], units[0]), ...slopeFreed(answer, index));
    if (given(index + 1, "over")) changes.push(set(of(index + 1, "over"), segments[index + 1].at[1] - at, units[0]));
  }
  if (position !== null && given(index, "by")) changes.push(set(of(index, "by"), position - segments[index].position[0], units[1]));
  else if (position !== null && given(index, "to")) changes.push(set(of(index, "to"), position, units[1]));
  return changes;
}

/** A straight line between two positions over an angle has the velocity that follows: one that is given is taken away. */
function slopeFreed(answer, index) {
  const given = (name) => answer.given.includes(`motion.segment[${index}].${name}`);
  const isLine = ["line", "constant-velocity", "poly1"].includes(answer.motion.segments[index].law);
  return isLine && given("velocity") && (given("to") || given("by")) ? [{ remove: `motion.segment[${index}].velocity` }] : [];
}

/** Whether nodes of this motion can be moved: it is a program of segments. */
const isProgram = (answer) => Boolean(answer.motion?.segments.length) && answer.given.some((path) => path.startsWith("motion.segment[")) && !answer.motion.segments.some(({ whole: all }) => all);

function motionEditor(answer) {
  byId("motion").hidden = byId("to-motion").hidden = !isProgram(answer);
  if (byId("motion").hidden) {
    diagram = null;
    return;
  }
  doc.chosen = Math.min(doc.chosen, answer.motion.segments.length - 1);
  motionDiagram(answer);
  motionTools(answer);
  motionRows(answer);
  measuredShown();
}

/** The diagram that is shown: its lanes, the places of its nodes, and how places and positions become coordinates. */
let diagram = null;

/** A curve as the path of an SVG, missing values left out. */
function pathOf(places, values, xOf, yOf) {
  let isOpen = false;
  let path = "";
  for (let index = 0; index < values.length; index += 1) {
    const value = values[index];
    const has = value !== null && value !== undefined;
    if (has) path += `${isOpen ? "L" : "M"}${fine(xOf(places[index]))} ${fine(yOf(value))}`;
    isOpen = has;
  }
  return path;
}
/** Coordinates to a thousandth: a curve that is rounded to pixels has steps. */
const fine = (value) => Math.round(1000 * value) / 1000;

const ends = (...lists) => {
  let [low, high] = [0, 0];
  for (const list of lists) for (const value of list) if (value !== null && value !== undefined) [low, high] = [Math.min(low, value), Math.max(high, value)];
  return [low, high];
};

/** The lanes of a view: name, column, unit. */
function lanesOf(view) {
  const names = Object.keys(view.columns);
  return CURVES.map(([name, pattern]) => [name, names.find((column) => pattern.test(column))]).filter(([, column]) => column).map(([name, column]) => ({ name, column }));
}

function motionDiagram(answer) {
  const { segments, units } = answer.motion;
  const view = first();
  const lanes = lanesOf(view);
  const height = EDITOR.top + lanes.reduce((sum, _, index) => sum + EDITOR.heights[index] + EDITOR.gap, 0);
  const svg = makeSvg("svg", { viewBox: `0 0 ${EDITOR.width} ${height}`, role: "group", "aria-label": text("motion") });
  const [begin, end] = [segments[0].at[0], segments.at(-1).at[1]];
  const wide = EDITOR.width - EDITOR.left - EDITOR.right;
  const least = Math.min(...segments.flatMap(({ position }) => position));
  diagram = { isSeen: true, waiting: null, draw() {}, update: motionCurves, svg, lanes, begin, end, wide, least, height, nodes: [], xOf: (at) => EDITOR.left + ((at - begin) / (end - begin || 1)) * wide };
  let top = EDITOR.top;
  lanes.forEach((lane, index) => {
    Object.assign(lane, { top, high: EDITOR.heights[index], label: makeSvg("text", { x: 0, y: top - 10 }) });
    for (const name of ["grid", "ghost", "measured", "curve"]) svg.append((lane[name] = makeSvg("path", { class: name })));
    svg.append(lane.label);
    top += lane.high + EDITOR.gap;
  });
  segments.forEach((segment, index) => {
    const x = diagram.xOf(segment.at[0]);
    const area = makeSvg("rect", { class: index === doc.chosen ? "segment chosen" : "segment", x, width: Math.max(1, diagram.xOf(segment.at[1]) - x), y: EDITOR.top, height: height - EDITOR.top });
    area.addEventListener("click", () => {
      doc.chosen = index;
      motionEditor(doc.last);
    });
    svg.append(area);
  });
  segments.forEach((segment, index) => svg.append(nodeOf(segment, index, segments, units)));
  motionCurves(answer);
  svg.camgenPlot = diagram;
  seen.observe(svg);
  byId("motion-diagram").replaceChildren(svg);
  if (refocus !== null) svg.querySelector(`[data-node="${refocus}"]`)?.focus();
  refocus = null;
}
/** The node that has the focus again after the diagram is drawn anew. */
let refocus = null;

/** The curves of the diagram, those of the design as sent and of a measured table; while a node is dragged too. */
function motionCurves(answer) {
  if (!diagram || !answer.motion) return false;
  const view = first();
  const before = cams.length === 1 && doc.past.length ? ghostOf(view) : null;
  const place = (of) => (at) => diagram.xOf(diagram.begin + at - of.columns[of.place][0]);
  diagram.lanes.forEach((lane, index) => {
    const values = view.columns[lane.column];
    if (!values) return;
    const old = before?.columns[lane.column] ?? [];
    const points = index === 0 && doc.measured ? doc.measured.points : [];
    const [low, most] = ends(values, old, points.map(([, lift]) => lift));
    const yOf = (value) => lane.top + lane.high - ((value - low) / (most - low || 1)) * lane.high;
    Object.assign(lane, { low, most, yOf });
    const write = (name, path) => lane[name].getAttribute("d") !== path && lane[name].setAttribute("d", path);
    write("grid", `M${EDITOR.left} ${yOf(0).toFixed(1)}H${EDITOR.left + diagram.wide}`);
    write("ghost", before ? pathOf(before.columns[before.place], old, place(before), yOf) : "");
    write("measured", points.map(([at, lift]) => `M${place(view)(at).toFixed(1)} ${yOf(lift).toFixed(1)}h0`).join(""));
    write("curve", pathOf(view.columns[view.place], values, place(view), yOf));
    const [factor, unit] = inLengths(view.kinds[lane.column][1]);
    const [own, largest] = ends(values).map((value) => value * factor);
    const words = `${text(lane.name)}, ${unit}: ${shown(own, 4)} … ${shown(largest, 4)}`;
    if (lane.label.textContent !== words) lane.label.textContent = words;
  });
  answer.motion.segments.forEach((segment, index) => {
    const node = diagram.nodes[index];
    if (!node || node.held) return;
    node.element.setAttribute("cx", diagram.xOf(segment.at[1]));
    node.element.setAttribute("cy", diagram.lanes[0].yOf(segment.position[1] - diagram.least));
  });
  return true;
}

/** The node at the end of a segment: it is dragged, or moved by the arrow keys. */
function nodeOf(segment, index, segments, units) {
  const isLast = index === segments.length - 1;
  const rests = segment.position[0] === segment.position[1];
  const node = makeSvg("circle", { class: "node", r: 7, tabindex: 0, role: "slider", "data-node": index, "aria-orientation": "horizontal",
    "aria-label": `${text("segment")} ${index + 1}, ${segment.law}: ${text("until")}, ${text("position")}`, "aria-valuenow": cleaned(segment.at[1]), "aria-valuemin": segments[0].at[0], "aria-valuemax": segments.at(-1).at[1], "aria-valuetext": [0, 1].map((which) => withUnit(inNumber((which ? segment.position : segment.at)[1], units[which]), unitName(units[which]))).join(", ") });
  const one = { element: node, held: null };
  diagram.nodes.push(one);
  const placeOfPointer = (event) => {
    const box = diagram.svg.getBoundingClientRect();
    const [x, y] = [((event.clientX - box.left) / box.width) * EDITOR.width, ((event.clientY - box.top) / box.height) * diagram.height];
    const at = diagram.begin + ((x - EDITOR.left) / diagram.wide) * (diagram.end - diagram.begin);
    const lift = diagram.lanes[0];
    const up = diagram.least + lift.low + ((lift.top + lift.high - y) / lift.high) * (lift.most - lift.low);
    const limit = isLast ? diagram.end : segments[index + 1].at[1] - 0.5;
    return [isLast ? null : Math.round(2 * Math.min(limit, Math.max(segment.at[0] + 0.5, at))) / 2, rests ? null : Math.round(10 * up) / 10];
  };
  node.addEventListener("pointerdown", (event) => {
    node.setPointerCapture(event.pointerId);
    doc.chosen = index;
    one.held = { from: [event.clientX, event.clientY], changes: null };
    event.preventDefault();
    node.focus();
  });
  node.addEventListener("pointermove", (event) => {
    const { held } = one;
    if (!held || Math.hypot(event.clientX - held.from[0], event.clientY - held.from[1]) < 3) return;
    const [at, position] = placeOfPointer(event);
    // Along the larger of the two movements alone, so that an angle changes without the position.
    const sideways = Math.abs(event.clientX - held.from[0]) > Math.abs(event.clientY - held.from[1]);
    held.changes = nodeMoved(doc.last, index, sideways ? at : null, sideways ? null : position);
    node.setAttribute("cx", diagram.xOf(sideways && at !== null ? at : segment.at[1]));
    node.setAttribute("cy", diagram.lanes[0].yOf((!sideways && position !== null ? position : segment.position[1]) - diagram.least));
    if (held.changes.length) draft(held.changes);
  });
  for (const name of ["pointerup", "pointercancel"]) node.addEventListener(name, () => {
    const { held } = one;
    one.held = null;
    if (held?.changes?.length) commit(held.changes);
    else if (held) motionEditor(doc.last);
  });
  node.addEventListener("keydown", (event) => {
    const by = event.shiftKey ? 10 : 1;
    const step = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const changes = nodeMoved(doc.last, index, step[0] && !isLast ? segment.at[1] + step[0] : null, step[1] ? segment.position[1] + step[1] : null);
    refocus = index;
    if (changes.length) commit(changes);
  });
  return node;
}

/** What can be done with the chosen segment: law, insertion, removal. */
function motionTools(answer) {
  const { segments, units } = answer.motion;
  const segment = segments[doc.chosen];
  const own = `motion.segment[${doc.chosen}]`;
  const button = (name, act) => {
    const made = make("button", { type: "button", id: name }, text(name));
    made.addEventListener("click", act);
    return made;
  };
  // A new segment takes half of the chosen one's angle.
  const inserted = (kind, position) => {
    const width = cleaned((segment.at[1] - segment.at[0]) / 2);
    const at = doc.chosen + 1;
    const path = `motion.segment[${at}]`;
    const given = (name) => answer.given.includes(`${own}.${name}`);
    const shortened = given("until") ? { set: { key: `${own}.until`, to: `${cleaned(segment.at[0] + width)} ${units[0]}` } } : { set: { key: `${own}.over`, to: `${width} ${units[0]}` } };
    const isLast = doc.chosen === segments.length - 1;
    const over = isLast && !given("over") && !given("until") ? [] : [{ set: { key: `${path}.over`, to: `${width} ${units[0]}` } }];
    const freed = given("until") ? [] : slopeFreed(answer, doc.chosen);
    commit([shortened, ...freed, { insert: path }, { set: { key: `${path}.law`, to: kind } }, ...over, ...(position === null ? [] : [{ set: { key: `${path}.to`, to: `${cleaned(position)} ${units[1]}` } }])]);
    doc.chosen = at;
  };
  const positions = segments.flatMap(({ position }) => position);
  const [low, high] = [Math.min(...positions), Math.max(...positions)];
  const removal = () => {
    const follows = segments[doc.chosen + 1];
    const grown = follows && answer.given.includes(`motion.segment[${doc.chosen + 1}].over`) ? [{ set: { key: `motion.segment[${doc.chosen + 1}].over`, to: `${cleaned(follows.at[1] - segment.at[0])} ${units[0]}` } }] : [];
    commit([...grown, { remove: own }]);
  };
  byId("motion-tools").replaceChildren(make("strong", {}, `${text("segment")} ${doc.chosen + 1}: ${segment.law}`),
    button("addRise", () => inserted("modified-sine", segment.position[1] < high ? high : high + (high - low || 10) / 2)), button("addDwell", () => inserted("dwell", null)), button("addReturn", () => inserted("modified-sine", low)), button("removeSegment", removal));
  byId("removeSegment").disabled = segments.length < 2;
  lawPictures(answer);
}

/** Keys of the state at the end of a segment, and the laws that keep every state of both ends. */
const END_KEYS = ["velocity", "acceleration", "end", "inflection", "start"];
const BY_STATES = ["polynomial", "spline"];

/** What sets a state at the end of a segment: a velocity makes it moving, and rest or a turn have none of their own. */
function stateChanges(answer, index, name, value) {
  const path = (key) => `motion.segment[${index}].${key}`;
  const without = (...keys) => keys.map(path).filter((key) => answer.given.includes(key)).map((key) => ({ remove: key }));
  if (!value) return without(name);
  const others = name === "velocity" ? ["end"] : name === "end" && value !== "moving" ? ["velocity", ...(value === "rest" ? ["acceleration"] : [])] : [];
  return [...without(...others), { set: { key: path(name), to: value } }];
}

/** Fields of the state at the end of each segment, with the choices of their keys. */
function statesOf(answer) {
  const { segments, units } = answer.motion;
  const view = first();
  const column = view.columns[lanesOf(view).find(({ name }) => name === "velocity")?.column];
  const [along, above] = units.map(unitName);
  const unit = { velocity: `${above}/${along}`, acceleration: `${above}/${along === "deg" ? "rad" : along}2` };
  const keys = keyTable.sections.find(({ path }) => path === "motion.segment").keys;
  // The velocity that the end has now, per degree.
  const present = ({ at }) => {
    const places = view.columns[view.place];
    const value = column && between(column, locate(places, places[0] + at[1] - segments[0].at[0]));
    return typeof value === "number" ? `${shown(inNumber(value, units[1]) * (along === "deg" && units[1] === "mm" ? Math.PI / 180 : 1), 3)} ${unit.velocity}` : "";
  };
  return (index, name) => {
    const path = `motion.segment[${index}].${name}`;
    const { about, words: list } = keys.find((one) => one.name === name);
    const isGiven = answer.given.includes(path);
    const typed = isGiven ? answer.values?.[path] ?? "" : "";
    const { law } = segments[index];
    // A dwell rests, and only some laws continue what was before.
    const same = { "aria-label": `${text("segment")} ${index + 1}: ${text(`end_${name}`)}`, title: about, "data-end": `${index}-${name}`, disabled: !isGiven && (law === "dwell" || (name === "start" && !BY_STATES.includes(law))) };
    const input = list ? make("select", same, ...["", ...list].map((word_) => make("option", { value: word_ }, word_ || "–"))) : make("input", { ...same, type: "text", placeholder: name === "velocity" ? present(segments[index]) : "" });
    input.value = list ? typed.toLowerCase() : typed;
    if (!list) {
      const words_ = `end-words-${name}`;
      input.setAttribute("list", words_);
      if (!byId(words_)) byId("motion").append(make("datalist", { id: words_ }, ...(name === "inflection" ? ["smooth", "match"] : ["auto"]).map((value) => make("option", { value }))));
    }
    input.addEventListener("change", () => {
      const value = input.value.trim().replace(/^([+-]?[\d.]*),(\d+)$/, "$1.$2");
      commit(stateChanges(doc.last, index, name, unit[name] && value !== "" && Number.isFinite(Number(value)) ? `${value} ${unit[name]}` : value));
    });
    return input;
  };
}

/** Every node as numbers that can be typed. */
function motionRows(answer) {
  const { segments, units } = answer.motion;
  const field = (index, which) => {
    const segment = segments[index];
    const value = which === 0 ? segment.at[1] : segment.position[1];
    const input = make("input", { type: "text", inputMode: "decimal", value: String(cleaned(inNumber(value, units[which]))), "data-row": `${index}-${which}`, "aria-label": `${text("segment")} ${index + 1}: ${text(which === 0 ? "until" : "position")}, ${unitName(units[which])}`, disabled: which === 0 ? index === segments.length - 1 : segment.position[0] === segment.position[1] });
    input.addEventListener("change", () => {
      const typed = Number(input.value.replace(",", "."));
      const value = typed / inNumber(1, units[which]);
      const changes = Number.isFinite(value) ? nodeMoved(doc.last, index, which === 0 ? value : null, which === 1 ? value : null) : [];
      if (changes.length) commit(changes);
    });
    return input;
  };
  const states = statesOf(answer);
  const rows = segments.map((segment, index) => make("tr", {}, make("th", { scope: "row" }, `${index + 1}`), make("td", {}, segment.law), make("td", { className: "number" }, shown(inNumber(segment.at[0], units[0]))), make("td", {}, field(index, 0)), make("td", {}, field(index, 1)), ...END_KEYS.map((name) => make("td", {}, states(index, name)))));
  const heads = [text("segment"), text("law"), `${text("from")}, ${unitName(units[0])}`, `${text("until")}, ${unitName(units[0])}`, `${text("position")}, ${unitName(units[1])}`, ...END_KEYS.map((name) => text(`end_${name}`))];
  byId("motion-rows").replaceChildren(make("div", { className: "wide", tabIndex: 0, role: "region", "aria-label": text("motionRows") }, make("table", {}, make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))), make("tbody", {}, ...rows))));
}
