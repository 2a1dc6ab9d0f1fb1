// Dimensions in the picture of the cam, in boxes: a click to type, a drag to change.

/** Sizes on the screen, px: of a box, the distance of a line from an arm, an arrow head, the least travel that is a drag, and the least picture that has dimensions. */
const DIMENSION = { wide: 62, high: 22, away: 30, arrow: 6, drag: 3, picture: 300 };

/** The figure of the report with a name, mm. */
function sizeInReport(label) {
  const values = (cams[0].metric ?? cams[0]).sections?.find(({ key }) => key === "cam")?.values ?? [];
  const found = values.find(([name]) => name === label)?.[1];
  return typeof found === "number" ? found : null;
}

/** The dimensions that a design has: what is measured, by the path of its key. */
function dimensionsOf(view) {
  if (cams.length > 1 || view.place !== "cam_deg" || !view.parts.some(({ role }) => role === "cam")) return [];
  const rolls = view.parts.some(({ role }) => role === "roller");
  const kinds = [["base", /^cam\.base_(radius|diameter)$/, sizeInReport("base radius") !== null], ["roller", /^follower\.[a-z-]+\.(radius|diameter)$/, rolls],
    ["arm", /^follower\.swinging-roller\.arm$/, rolls], ["pivot", /^follower\.swinging-[a-z]+\.pivot_distance$/, true]];
  return kinds.flatMap(([kind, pattern, isThere]) => {
    const path = isThere && (doc.last?.given ?? []).find((one) => pattern.test(one) && fields.has(one));
    return path ? [{ kind, path, letter_: kind === "base" || kind === "roller" ? (path.endsWith("diameter") ? "Ø" : "R") : "" }] : [];
  });
}

/** The boxes over the picture of a mechanism. */
function dimensionBoxes() {
  const lines = makeSvg("svg", { "aria-hidden": "true" });
  const [circle, thin, heads] = [makeSvg("circle", { class: "base" }), makeSvg("path"), makeSvg("path", { class: "heads" })];
  lines.append(circle, thin, heads);
  const layer = make("div", { className: "dimensions control" }, lines);
  let shape = "";
  let boxes = [];

  /** The number and the unit of the field; of "auto" what was found. */
  function valueOf({ path }) {
    const typed = fields.get(path)?.input.value;
    const found = quantityOf(typed === "auto" ? chosenValue(path) : typed);
    return found && { ...found, unit: found.unit || lengthUnit };
  }

  /** Takes the dimensions of a design; boxes of the same ones stay. */
  function anew(view) {
    const all = dimensionsOf(view);
    const now = JSON.stringify([all, language]);
    if (now === shape) return;
    shape = now;
    for (const { input } of boxes) input.remove();
    boxes = all.map(boxOf);
    layer.append(...boxes.map(({ input }) => input));
    layer.parentElement.classList.toggle("dimensioned", boxes.length > 0 && view.parts.every(({ name }) => !name || ["cam", "roller"].includes(name[0])));
  }

  function boxOf(one) {
    const { path, kind, letter_ } = one;
    const name = oftenName(path, fields.get(path).key);
    const input = make("input", { type: "text", autocomplete: "off", tabIndex: -1, "aria-label": `${name}, ${path.split(".")[0]}`, title: `${name}: ${text("dimensionHelp")}`, "data-dimension": kind });
    const box = { ...one, input };
    let held = null;
    const change = (value) => [{ set: { key: path, to: value } }];
    input.addEventListener("change", () => {
      const value = input.value.trim().replace(/^R\s*/i, "").replace(/^Ø\s*/, letter_ === "Ø" ? "" : "Ø").replace(",", ".");
      input.blur();
      if (value) commit(change(withFormerUnit(value, `1 ${valueOf(one)?.unit ?? lengthUnit}`, fields.get(path).key)));
    });
    input.addEventListener("keydown", ({ key }) => key === "Escape" && input.blur());
    input.addEventListener("pointerdown", (event) => {
      if (document.activeElement === input) return;
      event.preventDefault();
      input.setPointerCapture(event.pointerId);
      held = { from: [event.clientX, event.clientY], start: valueOf(one), value: null };
    });
    input.addEventListener("pointermove", (event) => {
      if (!held?.start) return;
      const [x, y] = [event.clientX - held.from[0], event.clientY - held.from[1]];
      if (held.value === null && Math.hypot(x, y) < DIMENSION.drag) return;
      const { number, unit } = held.start;
      const perPixel = ((box.pixel / 1000) * (letter_ === "Ø" ? 2 : 1)) / lengthSize(unit);
      // Whole steps, of which a pixel is about one.
      const step = 10 ** Math.ceil(Math.log10(perPixel) - 0.3);
      const value = Math.max(step, Math.round((number + (x * box.along[0] + y * box.along[1]) * perPixel) / step) * step);
      held.value = `${Number(value.toPrecision(10))} ${unit}`;
      const field = fields.get(path);
      field.filled = null;
      field.input.value = held.value;
      if (field.slider) field.range.value = value;
      write(box);
      draft(change(held.value));
    });
    for (const event_ of ["pointerup", "pointercancel"]) input.addEventListener(event_, () => {
      if (held?.value) commit(change(held.value));
      else if (held) input.select();
      held = null;
    });
    return box;
  }

  function write(one) {
    if (document.activeElement === one.input) return;
    const value = valueOf(one);
    const words_ = value ? `${one.letter_}${shown(value.number)}` : "–";
    if (one.input.value !== words_) one.input.value = words_;
  }

  /** Lines and boxes at their places: positions of the machine become those of the screen. */
  function place(view, toScreen, pixel, [width, height]) {
    layer.hidden = !boxes.length || width < DIMENSION.picture || isPrinting();
    if (layer.hidden) return;
    const sample = locate(view.turn, turnOf(view));
    const of = (track) => (Array.isArray(track) ? between(track, sample) : track);
    const at = (role) => view.parts.filter((part) => part.role === role).map(({ x, y }) => toScreen([of(x), of(y)]))[0];
    const [centre, pivot, roller] = [toScreen([0, 0]), at("follower"), at("roller")];
    const { wide, high, arrow: size } = DIMENSION;
    let [path, arrows] = ["", ""];
    const line = (...points) => (path += `M${points.map((point) => point.map((value) => value.toFixed(1)).join(" ")).join("L")}`);
    const arrow = ([x, y], [dx, dy]) => (arrows += `M${x} ${y}l${-size * dx - 0.35 * size * dy} ${-size * dy + 0.35 * size * dx}l${0.7 * size * dy} ${-0.7 * size * dx}z`);
    const taken = [];
    /** Puts a box at a point, within the picture and beside those before. */
    const put_ = (one, x, y, along) => {
      Object.assign(one, { along, pixel });
      const box = [Math.min(width - wide / 2 - 4, Math.max(wide / 2 + 2, x)), Math.min(height - high / 2 - 2, Math.max(high / 2 + 2, y))];
      for (const other of taken) if (Math.abs(other[0] - box[0]) < wide + 4 && Math.abs(other[1] - box[1]) < high + 4) box[1] = other[1] + Math.sign(box[1] - other[1] || 1) * (high + 4);
      taken.push(box);
      one.input.style.transform = `translate(${box[0] - wide / 2}px, ${box[1] - high / 2}px)`;
      write(one);
      return box;
    };
    /** A length between two points, on a line beside them. */
    const length = (one, a, b, [nx, ny], away) => {
      const reach = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
      const along = [(b[0] - a[0]) / reach, (b[1] - a[1]) / reach];
      const beside_ = ([x, y], far) => [x + far * nx, y + far * ny];
      const [from, to] = [beside_(a, away), beside_(b, away)];
      line(a, beside_(a, away + 5));
      line(b, beside_(b, away + 5));
      line(from, to);
      arrow(from, along.map((part) => -part));
      arrow(to, along);
      put_(one, (from[0] + to[0]) / 2, (from[1] + to[1]) / 2, along);
    };
    /** A radius or diameter, with a line from its circle to the box. */
    const round = (one, middle, radius, way, [x, y]) => {
      const edge = [middle[0] + radius * way[0], middle[1] + radius * way[1]];
      line(put_(one, edge[0] + x, edge[1] + y, way), edge);
      arrow(edge, way.map((part) => -part));
    };
    const radiusOf = (label) => sizeInReport(label) / pixel;
    put(circle, "r", "0");
    for (const one of boxes) {
      // Until the fields of another design are there, a box may measure what it has not.
      one.input.hidden = { base: [], roller: [roller], arm: [pivot, roller], pivot: [pivot] }[one.kind].includes(undefined);
      if (one.input.hidden) continue;
      const side = roller && roller[0] < centre[0] ? -1 : 1;
      if (one.kind === "pivot") length(one, centre, pivot, [-1, 0], centre[0] - Math.max(wide / 2 + 4, Math.min(toScreen([view.box[0], 0])[0] - 12, centre[0] - 60)));
      if (one.kind === "arm") {
        const reach = Math.hypot(roller[0] - pivot[0], roller[1] - pivot[1]) || 1;
        const way = roller[0] < pivot[0] ? -1 : 1;
        length(one, pivot, roller, [(way * (roller[1] - pivot[1])) / reach, (way * (pivot[0] - roller[0])) / reach], DIMENSION.away);
      }
      if (one.kind === "roller") round(one, roller, radiusOf("roller radius"), [side * 0.94, 0.34], [side * (wide / 2 + 22), 14]);
      if (one.kind === "base") {
        const radius = radiusOf("base radius");
        for (const [name, value] of [["cx", centre[0]], ["cy", centre[1]], ["r", radius]]) put(circle, name, String(value));
        round(one, centre, radius, [Math.SQRT1_2, Math.SQRT1_2], [46, 40]);
      }
    }
    put(thin, "d", path);
    put(heads, "d", arrows);
  }
  return { layer, anew, place };
}
