// One stack of curves over one axis: position, velocity, acceleration, jerk, pressure angle and torque, with the value at the cursor beside each.

/** Diagrams in the order in which a designer reads them, with the letter of their quantity. */
const LANES = [["lift", "s"], ["velocity", "v"], ["acceleration", "a"], ["jerk", "j"], ["pressure-angle", "α"], ["torque", "T"], ["residual", "F"], ["force", "F"], ["balance", "F"], ["press", "x"], ["profile-curvature", "1/ρ"], ["pitch-curvature", "1/ρ"]];
const MOST_LANES = 6;
/** Room for names at the left and values at the right, px; on a narrow screen names stand above their curves. */
const STACK = { left: 114, right: 78, narrow: 430, head: 8, foot: 34, gap: 7 };
/** The largest share of the height of a lane between two samples of a curve that is continuous: a larger one is a step. */
const STEP = 0.3;

/** What the live page has its own of: the names of lanes, words in its language, curves behind those of the present cam, and what is above the curves. */
let laneName = ({ title }) => title;
let inWords = (said) => said;
let curvesBehind = () => [];
let drawAbove = () => {};

/** Whether the curves are stacked: those of one mechanism with a motion. The live page always has its stack; of two cams and other analyses the legends are needed. */
const usesStack = () => Boolean(byId("loads")) || (cams.length === 1 && first().parts.length > 0 && first().panels.filter(({ id }) => LANES.some(([known]) => known === id)).length > 2);

/** The lanes that the person added or, on a narrow screen, the one that is shown. */
const stackChoice = { added: new Set(), only: "pressure-angle" };

const stack = (() => {
  const svg = makeSvg("svg", { class: "stack", role: "group" });
  const flag = make("output", { className: "flag" });
  const box = byId("stack");
  const lettersBox = make("div", { className: "letters control", role: "group", hidden: true });
  box.append(lettersBox, svg, flag);
  let [width, height] = [0, 0];
  let shape = "";
  let lanes = [];
  let scale = null;
  const cursor = makeSvg("line", { class: "cursor" });
  const above = makeSvg("g", { class: "segments" });

  const isNarrow = () => width < STACK.narrow;
  const leftOf = () => (isNarrow() ? 8 : STACK.left);
  const rightOf = () => (isNarrow() ? 8 : STACK.right);

  /** The panels that are shown, of those of the first cam. */
  function panelsShown(view) {
    const known = LANES.map(([id]) => view.panels.find((panel) => panel.id === id)).filter(Boolean);
    const all = [...known, ...view.panels.filter((panel) => !known.includes(panel))];
    const usual = known.slice(0, MOST_LANES);
    const shownPanels = all.filter((panel) => usual.includes(panel) !== stackChoice.added.has(panel.id));
    if (!isNarrow()) return { all, shownPanels };
    const one = all.find(({ id }) => id === stackChoice.only) ?? all[0];
    return { all, shownPanels: one ? [one] : [] };
  }

  const letterOf = ({ id }) => LANES.find(([known]) => known === id)?.[1] ?? "";

  /** The least and the largest value of all curves of a lane, and the room around them; of angles with limits the limits too. */
  function rangeOf(curves) {
    let [low, high] = [Infinity, -Infinity];
    for (const { values } of curves) for (const value of values) if (value !== null && value !== undefined && Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)];
    if (low > high) return [-1, 1];
    [low, high] = [Math.min(low, 0), Math.max(high, 0)];
    if (high - low < 1e-9) return [-1, 1];
    const room = 0.24 * (high - low);
    return [low < 0 ? low - room : low - 0.25 * room, high > 0 ? high + room : high + 0.25 * room];
  }

  /** A curve as a path, and its steps as another one. Nothing is rounded to pixels. */
  function pathsOf({ places, values }, yOf, high) {
    let [path, steps, isOpen] = ["", "", false];
    let before = null;
    for (let at = 0; at < values.length; at += 1) {
      const value = values[at];
      if (value === null || value === undefined || !Number.isFinite(value)) {
        isOpen = false;
        continue;
      }
      const [x, y] = [scale.xOf(places[at]), yOf(value)];
      const isStep = isOpen && Math.abs(y - before[1]) > STEP * high;
      if (isStep) steps += `M${before[0].toFixed(3)} ${before[1].toFixed(3)}L${x.toFixed(3)} ${y.toFixed(3)}`;
      path += `${isOpen && !isStep ? "L" : "M"}${x.toFixed(3)} ${y.toFixed(3)}`;
      before = [x, y];
      isOpen = true;
    }
    return [path, steps];
  }

  /** The extremes of a curve that are worth a label: the largest and the smallest value, at the middle of the places that have it. */
  function extremesOf(curve, [low, high]) {
    const { places, values } = curve;
    const found = [];
    for (const sign of [1, -1]) {
      let best = -1;
      for (let at = 0; at < values.length; at += 1) if (values[at] !== null && (best < 0 || sign * values[at] > sign * values[best] + 1e-12 * Math.abs(values[best]))) best = at;
      if (best < 0 || sign * values[best] <= 0.02 * (high - low)) continue;
      let last = best;
      while (last + 1 < values.length && Math.abs(values[last + 1] - values[best]) < 1e-6 * (high - low)) last += 1;
      const middle = { place: (places[best] + places[last]) / 2, value: values[best] };
      const { place, value } = last - best > 1 ? middle : peakNear(curve, best, sign) ?? middle;
      found.push({ sign, place, value: asReported(value, curve) });
    }
    return found;
  }

  /** Everything that does not change with the values: frames, names, grid. */
  function build(view, shownPanels, curvesOfLane) {
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const [left, right] = [leftOf(), rightOf()];
    const places = view.columns[view.place];
    const [begin, end] = [places[0], places.at(-1)];
    const wide = width - left - right;
    scale = { begin, end, left, wide, xOf: (at) => left + ((at - begin) / (end - begin || 1)) * wide };
    const top = STACK.head;
    const each = (height - top - STACK.foot - STACK.gap * (shownPanels.length - 1)) / shownPanels.length;
    const axis = makeSvg("g", { class: "axis" });
    svg.append(axis);
    const [scaled, unit] = inLengths(view.kinds[view.place][1]);
    const tick = tickOf(begin * scaled, end * scaled, isNarrow() ? 4 : 6) / scaled;
    const ticks = [];
    for (let at = Math.ceil(begin / tick - 1e-9) * tick; at <= end + 1e-9; at += tick) ticks.push(at);
    for (const at of ticks) {
      const label = makeSvg("text", { class: "tick", x: scale.xOf(at), y: height - STACK.foot + 18 });
      label.textContent = `${shown(at * scaled)}${unit === "°" ? "°" : ""}`;
      axis.append(label);
    }
    if (!isNarrow()) axis.append(written("axis-name", 2, height - STACK.foot + 18, `${inWords(view.kinds[view.place][0])}${unit === "°" ? "" : `, ${unit}`}`));
    lanes = shownPanels.map((panel, index) => {
      const y = top + index * (each + STACK.gap);
      const lane = { panel, y, high: each, curves: curvesOfLane[index], group: makeSvg("g", { class: "lane" }) };
      lane.group.append(makeSvg("rect", { class: "frame", x: left, y, width: wide, height: each }));
      for (const at of ticks) lane.group.append(makeSvg("path", { class: "grid", d: `M${scale.xOf(at)} ${y}v${each}` }));
      lane.limits = makeSvg("g");
      lane.zero = makeSvg("path", { class: "zero" });
      lane.drawn = makeSvg("g");
      lane.labels = makeSvg("g");
      lane.group.append(lane.limits, lane.zero, lane.drawn, lane.labels);
      lane.bead = makeSvg("circle", { class: "bead", r: 4.5 });
      lane.value = written("value", width - 4, y + each / 2 + 5, "");
      if (isNarrow()) lane.value.setAttribute("y", y + 14);
      else {
        const name = laneName(panel);
        const lines = name.length > 15 && name.includes(" ") ? [name.slice(0, name.lastIndexOf(" ", 15) > 0 ? name.lastIndexOf(" ", 15) : name.indexOf(" ")), name.slice((name.lastIndexOf(" ", 15) > 0 ? name.lastIndexOf(" ", 15) : name.indexOf(" ")) + 1)] : [name];
        lines.forEach((line, at) => lane.group.append(written("lane-name", 2, y + each / 2 - 4 + 14 * (at - (lines.length - 1)), line)));
        lane.unit = written("lane-unit", 2, y + each / 2 + 13, "");
        lane.group.append(lane.unit);
      }
      svg.append(lane.group, lane.value);
      return lane;
    });
    svg.append(cursor, ...lanes.map(({ bead }) => bead));
    cursor.setAttribute("y1", top - 4);
    cursor.setAttribute("y2", height - STACK.foot + 2);
  }

  function written(name, x, y, words_) {
    const label = makeSvg("text", { class: name, x, y });
    label.textContent = words_;
    return label;
  }

  /** Round distances of ticks. */
  function tickOf(begin, end, most) {
    const span = end - begin;
    const fine = span > 90 ? [10, 15, 30, 60, 90, 120, 180, 360] : [1, 2, 5].flatMap((one) => [0.001, 0.01, 0.1, 1, 10].map((power) => one * power)).sort((a, b) => a - b);
    return fine.find((tick) => span / tick <= most + 0.01) ?? span;
  }

  /** A power of a thousand that makes large values short, in the unit of the lane. */
  function scaledBy(curves) {
    let most = 0;
    for (const { values } of curves) for (const value of values) if (value !== null && Math.abs(value) > most) most = Math.abs(value);
    return most < 1e5 || !Number.isFinite(most) ? 0 : 3 * Math.floor(Math.log10(most / 1e2) / 3);
  }

  /** Elements of a group that are taken again one after the other: while a slider moves none is made anew. */
  function slots(group) {
    let at = 0;
    return {
      take(tag, attributes, words_) {
        let element = group.children[at];
        if (element?.tagName !== tag) {
          const made = makeSvg(tag);
          if (element) element.replaceWith(made);
          else group.append(made);
          element = made;
        }
        at += 1;
        for (const [name, value] of Object.entries(attributes)) put(element, name, String(value));
        if (words_ !== undefined && element.textContent !== words_) element.textContent = words_;
      },
      end() {
        while (group.children.length > at) group.lastChild.remove();
      },
    };
  }

  /** Curves, limits and labels of the present cam. */
  function fill(lane, curves) {
    lane.curves = curves;
    lane.power = scaledBy(curves);
    const own = curves.filter(({ limit, ghost }) => limit === undefined && !ghost);
    const limits = curves.filter(({ limit }) => limit !== undefined);
    const ghosts = curves.filter(({ ghost }) => ghost);
    // A limit far beyond the values is not drawn: it would flatten the curve.
    const [bare, withLimits] = [rangeOf([...own, ...ghosts]), rangeOf([...own, ...ghosts, ...limits])];
    const range = withLimits[1] - withLimits[0] < 3.5 * (bare[1] - bare[0]) ? withLimits : bare;
    const yOf = (value) => lane.y + lane.high - ((value - range[0]) / (range[1] - range[0])) * lane.high;
    lane.yOf = yOf;
    put(lane.zero, "d", `M${scale.left} ${yOf(0).toFixed(2)}h${scale.wide}`);
    const boundaries = limits.filter(({ limit }) => limit > range[0] && limit < range[1]);
    const tints = slots(lane.limits);
    for (const { limit } of boundaries) {
      const y = yOf(limit);
      const [top, high] = limit > 0 ? [lane.y, y - lane.y] : [y, lane.y + lane.high - y];
      tints.take("rect", { class: "beyond", x: scale.left, y: top, width: scale.wide, height: Math.max(0, high) });
      tints.take("path", { class: "limit", d: `M${scale.left} ${y}h${scale.wide}` });
    }
    tints.end();
    const drawn = slots(lane.drawn);
    const isSecond = ({ colour: name }) => cams.length > 1 && name === "two";
    // What a diagram shows besides its quantity is thin; of two cams each has its own colour.
    const isOther = (curve) => (cams.length > 1 ? curve.dash.length > 0 : curve !== own[0]);
    for (const curve of own.filter(isOther)) drawn.take("path", { class: "minor", d: pathsOf(curve, yOf, lane.high).join("") });
    for (const ghost of ghosts.slice(0, 1)) drawn.take("path", { class: "ghost", d: pathsOf(ghost, yOf, lane.high)[0] });
    for (const curve of own.filter((one) => !isOther(one))) {
      const [path, steps] = pathsOf(curve, yOf, lane.high);
      drawn.take("path", { class: isSecond(curve) ? "curve second" : "curve", d: path });
      drawn.take("path", { class: isSecond(curve) ? "jump second" : "jump", d: steps });
    }
    drawn.end();
    const notes = slots(lane.labels);
    const named = boundaries.find(({ limit }) => limit > 0) ?? boundaries[0];
    if (named) {
      const line = yOf(named.limit);
      const above = named.limit > 0 && line - lane.y >= 14;
      notes.take("text", { class: "limit-label", x: scale.left + scale.wide - 4, y: above ? line - 4 : line + 13 }, `${phrase("otherSide")} ${withUnit(Math.abs(named.limit), named.unit === "°" ? "°" : "")}`);
    }
    const main = own[0];
    if (main) for (const { sign, place, value } of extremesOf(main, range)) {
      const [x, y] = [scale.xOf(place), yOf(value)];
      notes.take("circle", { class: "extreme", cx: x, cy: y, r: 3 });
      // Next to a limit with the digits that tell them apart.
      const held = boundaries.find(({ limit }) => Math.sign(limit) === sign)?.limit;
      const words_ = held !== undefined && lane.power === 0 ? nextTo(held, value) : shown(value / 10 ** lane.power);
      // Above a peak and below a valley, within the lane.
      const room = 3.75 * words_.length + 4;
      const inside = Math.min(scale.left + scale.wide - room, Math.max(scale.left + room, x));
      const above = sign > 0 ? y - 6 : y + 14;
      const fits = above - 11 > lane.y - 8 && above < lane.y + lane.high + 4;
      notes.take("text", { class: "extreme-label", x: fits ? inside : x > scale.left + scale.wide / 2 ? x - room - 4 : x + room + 4, y: fits ? above : sign > 0 ? y + 12 : y - 4 }, words_);
    }
    notes.end();
    if (lane.unit) {
      const letter_ = letterOf(lane.panel);
      const unit_ = `${lane.power ? `${powerOfTen(lane.power).slice(1)} ` : ""}${main?.unit ?? ""}`;
      if (lane.said !== letter_ + unit_) {
        lane.said = letter_ + unit_;
        const italic = makeSvg("tspan", { class: "letter" });
        italic.textContent = letter_;
        lane.unit.replaceChildren(...(letter_ ? [italic, `, ${unit_}`] : [unit_]));
      }
    }
  }

  /** Letters of the curves on a narrow screen: one curve at a time. */
  function lettersAnew(all) {
    lettersBox.hidden = !isNarrow();
    if (!isNarrow()) return;
    lettersBox.setAttribute("aria-label", phrase("loads"));
    lettersBox.replaceChildren(...all.slice(0, 7).map((panel) => {
      const isChosen = panel.id === lanes[0]?.panel.id;
      const button = make("button", { type: "button", "aria-pressed": String(isChosen), "aria-label": laneName(panel) }, letterOf(panel) || laneName(panel).split(" ")[0]);
      button.addEventListener("click", () => {
        stackChoice.only = panel.id;
        anew();
      });
      return button;
    }));
  }

  /** Draws the curves of the present cam. */
  function anew() {
    if (!width || !height || !first().panels.length) return;
    const view = first();
    const { all, shownPanels } = panelsShown(view);
    const curves = shownPanels.map((panel) => [...curvesBehind(panel), ...curvesOf(panel)]);
    const now = JSON.stringify([width, height, document.documentElement.lang, view.place, view.columns[view.place][0], view.columns[view.place].at(-1), state.rate, lengthUnit, shownPanels.map(({ id, unit }) => [id, unit])]);
    if (now !== shape) {
      shape = now;
      build(view, shownPanels, curves);
      svg.append(above, cursor, ...lanes.map(({ bead }) => bead));
      lettersAnew(all);
      choicesAnew(all, shownPanels);
    }
    lanes.forEach((lane, index) => fill(lane, curves[index]));
    drawAbove();
    draw();
  }

  /** Diagrams that can be added to the stack or taken from it. */
  function choicesAnew(all, shownPanels) {
    const list = byId("more-curves");
    list.replaceChildren(make("option", { value: "" }, phrase("moreCurves")), ...all.map((panel) => make("option", { value: panel.id }, `${shownPanels.includes(panel) ? "✓" : "+"} ${inWords(panel.title)}`)));
    list.value = "";
  }

  /** The cursor, its values and its beads. */
  function draw() {
    if (!scale || !lanes.length) return;
    const view = first();
    const at = placeOf(view);
    const x = scale.xOf(at);
    put(cursor, "x1", x.toFixed(2));
    put(cursor, "x2", x.toFixed(2));
    const [scaled, unit] = inLengths(view.kinds[view.place][1]);
    const words_ = `${scaled === 1 ? steady1(at) : steady(at * scaled)}${unit === "°" ? "°" : ` ${unit}`}`;
    if (flag.textContent !== words_) flag.textContent = words_;
    flag.style.left = `${Math.min(width - 30, Math.max(30, x))}px`;
    flag.style.top = `${(lettersBox.hidden ? 0 : lettersBox.offsetHeight + 4) + height - STACK.foot + 3}px`;
    for (const lane of lanes) {
      const main = lane.curves.find(({ limit, ghost }) => limit === undefined && !ghost);
      const found = main ? valueAt(main) : null;
      const value = steady(found === null ? null : found / 10 ** lane.power);
      if (lane.value.textContent !== value) lane.value.textContent = value;
      const y = found === null ? NaN : lane.yOf(found);
      put(lane.bead, "visibility", y >= lane.y - 1 && y <= lane.y + lane.high + 1 ? "visible" : "hidden");
      if (!(y >= 0)) continue;
      put(lane.bead, "cx", x.toFixed(2));
      put(lane.bead, "cy", y.toFixed(2));
    }
  }
  /** A place with one decimal, which does not jump. */
  const steady1 = (value) => (Math.abs(value) < 0.05 ? 0 : value).toFixed(1).replace("-", "−");

  /** Pressing on the curves moves the mechanism there, and dragging takes it along. */
  function goTo(event) {
    const box_ = svg.getBoundingClientRect();
    const place = scale.begin + ((event.clientX - box_.left - scale.left) / scale.wide) * (scale.end - scale.begin);
    goToPlace(Math.min(scale.end, Math.max(scale.begin, place)));
  }
  svg.addEventListener("pointerdown", (event) => {
    const box_ = svg.getBoundingClientRect();
    if (!scale || event.clientY - box_.top < STACK.head || event.clientX - box_.left < scale.left - 6 || event.clientX - box_.left > scale.left + scale.wide + 6) return;
    svg.setPointerCapture(event.pointerId);
    svg.dataset.moving = "";
    play(false);
    goTo(event);
  });
  svg.addEventListener("pointermove", (event) => "moving" in svg.dataset && goTo(event));
  for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, () => delete svg.dataset.moving);

  new ResizeObserver(() => {
    const box_ = box.getBoundingClientRect();
    const letters = lettersBox.hidden ? 0 : lettersBox.offsetHeight + 4;
    const size = [Math.round(box_.width), Math.round(Math.max(180, box_.height - letters))];
    if (size[0] === width && size[1] === height) return;
    [width, height] = size;
    Object.assign(svg.style, { width: `${width}px`, height: `${height}px` });
    anew();
  }).observe(box);

  byId("more-curves").addEventListener("change", ({ target }) => {
    if (!target.value) return;
    if (stackChoice.added.has(target.value)) stackChoice.added.delete(target.value);
    else stackChoice.added.add(target.value);
    anew();
  });
  return { anew, draw, svg, above, written, layout: () => ({ scale, height }) };
})();
