// The motion program as a diagram: nodes that can be dragged, moved by keys and typed; laws, dwells and returns.

/** The segment that is chosen. */
let chosen = 0;

const EDITOR = { width: 720, heights: [190, 80, 80, 80], left: 56, right: 14, gap: 30, top: 24 };
const CURVES = [["lift", /^lift_/], ["velocity", /^velocity_(?!cut)/], ["acceleration", /^acceleration_(?!cut)/], ["jerk", /^jerk_/]];

const cleaned = (value) => Number(value.toFixed(4));

/** The changes that put the end of a segment to a place and a position: the segment behind it keeps its own end. */
function nodeMoved(answer, index, at, position) {
  const { segments, units } = answer.motion;
  const of = (segment, name) => `motion.segment[${segment}].${name}`;
  const given = (segment, name) => answer.given.includes(of(segment, name));
  const set = (key, value, unit) => ({ set: { key, to: `${cleaned(value)} ${unit}` } });
  const changes = [];
  if (at !== null) {
    if (given(index, "until")) changes.push(set(of(index, "until"), at, units[0]));
    else changes.push(set(of(index, "over"), at - segments[index].at[0], units[0]));
    if (given(index + 1, "over")) changes.push(set(of(index + 1, "over"), segments[index + 1].at[1] - at, units[0]));
  }
  if (position !== null && given(index, "by")) changes.push(set(of(index, "by"), position - segments[index].position[0], units[1]));
  else if (position !== null && given(index, "to")) changes.push(set(of(index, "to"), position, units[1]));
  return changes;
}

/** Whether nodes of this motion can be moved: it is a program of segments. */
const isProgram = (answer) => Boolean(answer.motion?.segments.length) && answer.given.some((path) => path.startsWith("motion.segment[")) && !answer.motion.segments.some(({ whole }) => whole);

function motionEditor(answer) {
  byId("motion").hidden = !isProgram(answer);
  if (byId("motion").hidden) return;
  chosen = Math.min(chosen, answer.motion.segments.length - 1);
  motionDiagram(answer);
  motionTools(answer);
  motionRows(answer);
}

function motionDiagram(answer) {
  const { segments, units } = answer.motion;
  const view = first();
  const names = Object.keys(view.columns);
  const lanes = CURVES.map(([name, pattern]) => [name, names.find((column) => pattern.test(column))]).filter(([, column]) => column);
  const height = EDITOR.top + lanes.reduce((sum, _, index) => sum + EDITOR.heights[index] + EDITOR.gap, 0);
  const svg = makeSvg("svg", { viewBox: `0 0 ${EDITOR.width} ${height}`, role: "group", "aria-label": text("motion") });
  const [begin, end] = [segments[0].at[0], segments.at(-1).at[1]];
  const wide = EDITOR.width - EDITOR.left - EDITOR.right;
  const xOf = (at) => EDITOR.left + ((at - begin) / (end - begin || 1)) * wide;
  const places = view.columns[view.place];
  let top = EDITOR.top;
  let lift = null;
  lanes.forEach(([name, column], lane) => {
    const high = EDITOR.heights[lane];
    const values = view.columns[column];
    const numbers = values.filter((value) => value !== null);
    const [low, most] = [Math.min(...numbers, 0), Math.max(...numbers, 0)];
    const from = top;
    const yOf = (value) => from + high - ((value - low) / (most - low || 1)) * high;
    svg.append(makeSvg("line", { class: "grid", x1: EDITOR.left, x2: EDITOR.left + wide, y1: yOf(0), y2: yOf(0) }));
    const path = values.map((value, index) => (value === null ? "" : `${index && values[index - 1] !== null ? "L" : "M"}${xOf(begin + places[index] - places[0]).toFixed(2)} ${yOf(value).toFixed(2)}`)).join("");
    svg.append(makeSvg("path", { class: "curve", d: path }));
    const label = makeSvg("text", { x: 0, y: top - 10 });
    label.textContent = `${text(name)}, ${view.kinds[column][1]}: ${shown(low, 4)} … ${shown(most, 4)}`;
    svg.append(label);
    if (lane === 0) lift = { top, high, low, most, yOf };
    top += high + EDITOR.gap;
  });
  segments.forEach((segment, index) => {
    const area = makeSvg("rect", { class: index === chosen ? "segment chosen" : "segment", x: xOf(segment.at[0]), width: Math.max(1, xOf(segment.at[1]) - xOf(segment.at[0])), y: EDITOR.top, height: height - EDITOR.top });
    area.addEventListener("click", () => {
      chosen = index;
      motionEditor(last);
    });
    svg.append(area);
  });
  const least = Math.min(...segments.flatMap(({ position }) => position));
  segments.forEach((segment, index) => {
    const isLast = index === segments.length - 1;
    const node = makeSvg("circle", { class: "node", r: 7, cx: xOf(segment.at[1]), cy: lift.yOf(segment.position[1] - least), tabindex: 0, role: "slider", "data-node": index,
      "aria-label": `${text("segment")} ${index + 1}, ${segment.law}: ${text("until")}, ${text("position")}`, "aria-valuenow": segment.position[1], "aria-valuetext": `${shown(segment.at[1])} ${units[0]}, ${shown(segment.position[1])} ${units[1]}` });
    let moving = null;
    const placeOfPointer = (event) => {
      const box = svg.getBoundingClientRect();
      const [x, y] = [((event.clientX - box.left) / box.width) * EDITOR.width, ((event.clientY - box.top) / box.height) * height];
      const at = begin + ((x - EDITOR.left) / wide) * (end - begin);
      const up = least + lift.low + ((lift.top + lift.high - y) / lift.high) * (lift.most - lift.low);
      const limit = isLast ? end : segments[index + 1].at[1] - 0.5;
      return [isLast ? null : Math.round(2 * Math.min(limit, Math.max(segment.at[0] + 0.5, at))) / 2, segment.position[1] === segment.position[0] ? null : Math.round(10 * up) / 10];
    };
    node.addEventListener("pointerdown", (event) => {
      node.setPointerCapture(event.pointerId);
      chosen = index;
      moving = { from: [event.clientX, event.clientY], changes: null };
      event.preventDefault();
      node.focus();
    });
    node.addEventListener("pointermove", (event) => {
      if (!moving || Math.hypot(event.clientX - moving.from[0], event.clientY - moving.from[1]) < 3) return;
      const [at, position] = placeOfPointer(event);
      // Along the larger of the two movements alone, so that an angle changes without the position.
      const sideways = Math.abs(event.clientX - moving.from[0]) > Math.abs(event.clientY - moving.from[1]);
      moving.changes = nodeMoved(last, index, sideways ? at : null, sideways ? null : position);
      node.setAttribute("cx", sideways && at !== null ? xOf(at) : xOf(segment.at[1]));
      node.setAttribute("cy", !sideways && position !== null ? lift.yOf(position - least) : lift.yOf(segment.position[1] - least));
      if (moving.changes.length) draft(moving.changes);
    });
    for (const name of ["pointerup", "pointercancel"]) node.addEventListener(name, () => {
      if (moving?.changes?.length) commit(moving.changes);
      moving = null;
    });
    node.addEventListener("keydown", (event) => {
      const by = event.shiftKey ? 10 : 1;
      const step = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] }[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation();
      const changes = nodeMoved(last, index, step[0] && !isLast ? segment.at[1] + step[0] : null, step[1] ? segment.position[1] + step[1] : null);
      refocus = index;
      if (changes.length) commit(changes);
    });
    svg.append(node);
  });
  byId("motion-diagram").replaceChildren(svg, make("p", { className: "muted" }, text("nodeHelp")));
  if (refocus !== null) svg.querySelector(`[data-node="${refocus}"]`)?.focus();
  refocus = null;
}
/** The node that has the focus again after the diagram is drawn anew. */
let refocus = null;

/** What can be done with the chosen segment: law, insertion, removal. */
function motionTools(answer) {
  const { segments, units } = answer.motion;
  const segment = segments[chosen];
  const own = `motion.segment[${chosen}]`;
  const laws = keyTable.laws;
  const rests = segment.position[0] === segment.position[1];
  const law = make("select", { id: "law", disabled: rests }, ...(laws.some(({ name }) => name === segment.law) ? [] : [make("option", { value: segment.law }, segment.law)]), ...laws.map(({ name, peaks }) => make("option", { value: name }, `${name} (v ${shown(peaks[0], 3)}, a ${shown(peaks[1], 3)}, j ${peaks[2] === null ? "∞" : shown(peaks[2], 3)})`)));
  law.value = segment.law;
  law.addEventListener("change", () => commit([{ set: { key: `${own}.law`, to: law.value } }]));
  const button = (name, act) => {
    const made = make("button", { type: "button", id: name }, text(name));
    made.addEventListener("click", act);
    return made;
  };
  // A new segment takes half of the chosen one's angle.
  const inserted = (kind, position) => {
    const width = cleaned((segment.at[1] - segment.at[0]) / 2);
    const at = chosen + 1;
    const path = `motion.segment[${at}]`;
    const given = (name) => answer.given.includes(`${own}.${name}`);
    const shortened = given("until") ? { set: { key: `${own}.until`, to: `${cleaned(segment.at[0] + width)} ${units[0]}` } } : { set: { key: `${own}.over`, to: `${width} ${units[0]}` } };
    const isLast = chosen === segments.length - 1;
    const over = isLast && !given("over") && !given("until") ? [] : [{ set: { key: `${path}.over`, to: `${width} ${units[0]}` } }];
    commit([shortened, { insert: path }, { set: { key: `${path}.law`, to: kind } }, ...over, ...(position === null ? [] : [{ set: { key: `${path}.to`, to: `${cleaned(position)} ${units[1]}` } }])]);
    chosen = at;
  };
  const positions = segments.flatMap(({ position }) => position);
  const [low, high] = [Math.min(...positions), Math.max(...positions)];
  const removal = () => {
    const follows = segments[chosen + 1];
    const grown = follows && answer.given.includes(`motion.segment[${chosen + 1}].over`) ? [{ set: { key: `motion.segment[${chosen + 1}].over`, to: `${cleaned(follows.at[1] - segment.at[0])} ${units[0]}` } }] : [];
    commit([...grown, { remove: own }]);
  };
  byId("motion-tools").replaceChildren(make("label", {}, `${text("segment")} ${chosen + 1}: ${text("law")} `, law),
    button("addRise", () => inserted("modified-sine", segment.position[1] < high ? high : high + (high - low || 10) / 2)), button("addDwell", () => inserted("dwell", null)), button("addReturn", () => inserted("modified-sine", low)), button("removeSegment", removal));
  byId("removeSegment").disabled = segments.length < 2;
}

/** Every node as numbers that can be typed. */
function motionRows(answer) {
  const { segments, units } = answer.motion;
  const field = (index, which) => {
    const segment = segments[index];
    const value = which === 0 ? segment.at[1] : segment.position[1];
    const input = make("input", { type: "text", inputMode: "decimal", value: String(cleaned(value)), "data-row": `${index}-${which}`, "aria-label": `${text("segment")} ${index + 1}: ${text(which === 0 ? "until" : "position")}, ${units[which]}`, disabled: which === 0 ? index === segments.length - 1 : segment.position[0] === segment.position[1] });
    input.addEventListener("change", () => {
      const typed = Number(input.value);
      const changes = Number.isFinite(typed) ? nodeMoved(last, index, which === 0 ? typed : null, which === 1 ? typed : null) : [];
      if (changes.length) commit(changes);
    });
    return input;
  };
  const rows = segments.map((segment, index) => make("tr", {}, make("th", { scope: "row" }, `${index + 1}`), make("td", {}, segment.law), make("td", { className: "number" }, shown(segment.at[0])), make("td", {}, field(index, 0)), make("td", {}, field(index, 1))));
  const heads = [text("segment"), text("law"), `${text("from")}, ${units[0]}`, `${text("until")}, ${units[0]}`, `${text("position")}, ${units[1]}`];
  byId("motion-rows").replaceChildren(make("div", { className: "wide" }, make("table", {}, make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))), make("tbody", {}, ...rows))));
}
