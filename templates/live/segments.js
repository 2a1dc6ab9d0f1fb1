// Segments of the motion above the curves, with handles at their borders.

STACK.head = 34;
laneName = ({ id, title }) => (languages[language].page[`lane_${id}`] ? text(`lane_${id}`) : spoken(title));
inWords = spoken;
curvesBehind = (panel) => (cams.length === 1 && (doc.past.length || isDragging) ? ghostsOf(panel, curvesOf(panel)) : []);
drawAbove = () => isDragging || segmentsAnew(doc.last);

/** The border that is being dragged. */
let heldHandle = null;
function segmentsAnew(answer) {
  if (heldHandle !== null) return;
  const { scale } = stack.layout();
  const focused = stack.above.contains(document.activeElement) ? document.activeElement.dataset.handle : null;
  stack.above.replaceChildren();
  if (!scale || !answer?.motion || cams.length > 1 || !isProgram(answer)) return;
  const { segments, units } = answer.motion;
  const begin = segments[0].at[0];
  const xOf = (at) => scale.xOf(scale.begin + at - begin);
  segments.forEach((segment, index) => {
    const [x, wide] = [xOf(segment.at[0]), xOf(segment.at[1]) - xOf(segment.at[0])];
    const [from, to] = segment.position;
    const kind = from === to ? "dwell" : to > from ? "rise" : "return";
    const area = makeSvg("rect", { class: from === to ? "piece rests" : "piece", x, y: 2, width: Math.max(0, wide), height: STACK.head - 8 });
    area.append(makeSvg("title"));
    area.lastChild.textContent = `${text("segment")} ${index + 1}: ${segment.law}`;
    area.addEventListener("click", () => chooseSegment(index));
    const travel = from === to ? "" : ` ${inPage(Math.abs(to - from), units[1])}`;
    const width_ = inPage(segment.at[1] - segment.at[0], units[0]);
    const names = [`${width_} ${segment.law.replace(/-/g, " ")}`, `${width_} ${segment.law.replace(/-/g, " ").replace("modified", "mod.").replace("trapezoid", "trap.")}`, width_];
    const fitting = (list, size) => list.find((name) => name.length * size + 18 < wide) ?? "";
    const [upper, lower] = [stack.written("piece-name", x + wide / 2, 13, fitting([`${text(`piece_${kind}`)}${travel}`, text(`piece_${kind}`)], 7)), stack.written("piece-note", x + wide / 2, 25, fitting(from === to ? [width_] : names, 6.2))];
    stack.above.append(area, upper, lower);
  });
  segments.slice(0, -1).forEach((segment, index) => stack.above.append(handleOf(segment, index, segments, units, xOf)));
  if (focused) stack.above.querySelector(`[data-handle="${focused}"]`)?.focus();
}

/** The border behind a segment: dragged, or moved by the arrow keys. */
function handleOf(segment, index, segments, units, xOf) {
  const { scale, height } = stack.layout();
  const handle = makeSvg("g", { class: "handle", tabindex: index ? -1 : 0, role: "slider", "data-handle": index, "aria-label": `${text("segment")} ${index + 1}, ${text("until")}`, "aria-valuenow": cleaned(segment.at[1]), "aria-valuemin": segment.at[0], "aria-valuemax": segments[index + 1].at[1], "aria-valuetext": withUnit(inNumber(segment.at[1], units[0]), unitName(units[0])) });
  const guide = makeSvg("path", { class: "guide", d: `M0 ${STACK.head - 6}V${height - STACK.foot}` });
  handle.append(guide, makeSvg("rect", { x: -5, y: 2, width: 10, height: STACK.head - 8, rx: 4 }), makeSvg("path", { class: "grip", d: `M-1.5 10v${STACK.head - 24}M1.5 10v${STACK.head - 24}` }));
  const moveTo = (at) => handle.setAttribute("transform", `translate(${xOf(at)} 0)`);
  moveTo(segment.at[1]);
  const held = { from: null, changes: null };
  const at = (event) => {
    const box_ = stack.svg.getBoundingClientRect();
    const place = ((event.clientX - box_.left - scale.left) / scale.wide) * (scale.end - scale.begin) + segments[0].at[0];
    return Math.round(2 * Math.min(segments[index + 1].at[1] - 0.5, Math.max(segment.at[0] + 0.5, place))) / 2;
  };
  handle.addEventListener("pointerdown", (event) => {
    handle.setPointerCapture(event.pointerId);
    Object.assign(held, { from: event.clientX, changes: null });
    heldHandle = index;
    event.preventDefault();
    event.stopPropagation();
    handle.focus();
  });
  handle.addEventListener("pointermove", (event) => {
    if (held.from === null || Math.abs(event.clientX - held.from) < 3) return;
    held.changes = nodeMoved(doc.last, index, at(event), null);
    moveTo(at(event));
    if (held.changes.length) draft(held.changes);
  });
  for (const name of ["pointerup", "pointercancel"]) handle.addEventListener(name, () => {
    const { changes } = held;
    Object.assign(held, { from: null, changes: null });
    heldHandle = null;
    if (changes?.length) commit(changes);
    else segmentsAnew(doc.last);
  });
  handle.addEventListener("keydown", (event) => {
    // One stop for the keyboard: up and down go to the other borders.
    const other = stack.above.querySelector(`[data-handle="${index + ({ ArrowUp: -1, ArrowDown: 1 }[event.key] ?? NaN)}"]`);
    if (other) {
      event.preventDefault();
      event.stopPropagation();
      for (const one of stack.above.querySelectorAll(".handle")) one.setAttribute("tabindex", one === other ? 0 : -1);
      return other.focus();
    }
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const changes = nodeMoved(doc.last, index, segment.at[1] + step * (event.shiftKey ? 10 : 1), null);
    if (changes.length) commit(changes);
  });
  return handle;
}

/** Chooses a segment in the editor of the motion, and goes there. */
function chooseSegment(index) {
  doc.chosen = index;
  motionEditor(doc.last);
  openMore("motion");
}
