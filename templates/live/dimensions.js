// Dimensions in the picture of the cam, in boxes: a click to type, a drag to change.

/** Sizes on the screen, px: of a box, of the distance of a line from its part, of an arrow head, and the least travel that is a drag. */
const DIMENSION = { wide: 56, high: 22, away: 30, arrow: 6, drag: 3 };
/** Narrower pictures have no dimensions: their boxes would lie on the cam. */
const LEAST_PICTURE = 300;

/** The figure of the report with a name, mm. */
function sizeInReport(label) {
  const values = (cams[0].metric ?? cams[0]).sections?.find(({ key }) => key === "cam")?.values ?? [];
  const found = values.find(([name]) => name === label)?.[1];
  return typeof found === "number" ? found : null;
}

/** The dimensions that a design has: the path of the key, what is measured, and the letter in front. */
function dimensionsOf(view) {
  if (cams.length > 1 || !view.parts.some(({ role }) => role === "cam") || view.place !== "cam_deg") return [];
  const has = (path) => fields.has(path) && (doc.last?.given ?? []).includes(path);
  const given = (pattern) => (doc.last?.given ?? []).find((path) => pattern.test(path) && fields.has(path));
  const base = ["cam.base_diameter", "cam.base_radius"].find(has);
  const roller = given(/^follower\.[a-z-]+\.(radius|diameter)$/);
  const found = [];
  const add = (kind, path) => path && found.push({ kind, path, isDiameter: path.endsWith("diameter") });
  if (sizeInReport("base radius") !== null) add("base", base);
  if (view.parts.some(({ role }) => role === "roller")) add("roller", roller);
  if (view.parts.some(({ role }) => role === "roller")) add("arm", given(/^follower\.swinging-roller\.arm$/));
  add("pivot", given(/^follower\.swinging-[a-z]+\.pivot_distance$/));
  return found;
}

/** The boxes over the picture of a mechanism. */
function dimensionBoxes() {
  const lines = makeSvg("svg", { "aria-hidden": "true" });
  const [circle, thin, heads] = [makeSvg("circle", { class: "base" }), makeSvg("path"), makeSvg("path", { class: "heads" })];
  lines.append(circle, thin, heads);
  const layer = make("div", { className: "dimensions control" }, lines);
  let shape = "";
  let boxes = [];

  /** The value in the box: that of the field, without its unit; of "auto" what was found. */
  function valueIn({ path, kind }) {
    const field = fields.get(path);
    const typed = field?.input.value ?? "";
    const found = quantityOf(typed === "auto" ? chosenValue(path) || (kind === "base" ? `${sizeInReport("base radius")} mm` : "") : typed);
    return found ? { ...found, unit: found.unit || lengthUnit } : null;
  }

  /** Takes the dimensions of a design; boxes of the same ones stay. */
  function anew(view) {
    const all = dimensionsOf(view);
    const now = JSON.stringify([all, language]);
    if (now === shape) return;
    shape = now;
    for (const { input } of boxes) input.remove();
    boxes = all.map((one) => ({ ...one, input: boxOf(one), along: [1, 0] }));
    layer.append(...boxes.map(({ input }) => input));
    layer.parentElement?.classList.toggle("dimensioned", boxes.length > 0 && view.parts.every(({ name }) => !name || ["cam", "roller"].includes(name[0])));
  }

  function boxOf({ path, kind, isDiameter }) {
    const name = oftenName(path, fields.get(path).key);
    const input = make("input", { type: "text", autocomplete: "off", tabIndex: -1, "aria-label": `${name}, ${path.split(".")[0]}`, title: `${name}: ${text("dimensionHelp")}`, "data-dimension": kind });
    const held = { from: null, start: null, moved: false };
    const change = (value) => [{ set: { key: path, to: value } }];
    input.addEventListener("change", () => {
      const value = input.value.trim().replace(/^R\s*/i, "").replace(",", ".");
      const before = valueIn({ path, kind });
      input.blur();
      if (value) commit(change(withFormerUnit(value.replace(/^Ø\s*/, isDiameter ? "" : "Ø"), `1 ${before?.unit ?? "mm"}`, fields.get(path).key)));
    });
    input.addEventListener("keydown", (event) => {
      if (event.key === "Escape") input.blur();
    });
    input.addEventListener("pointerdown", (event) => {
      if (document.activeElement === input) return;
      event.preventDefault();
      input.setPointerCapture(event.pointerId);
      Object.assign(held, { from: [event.clientX, event.clientY], start: valueIn({ path, kind }), moved: false });
    });
    input.addEventListener("pointermove", (event) => {
      if (!held.from || !held.start) return;
      const [x, y] = [event.clientX - held.from[0], event.clientY - held.from[1]];
      if (!held.moved && Math.hypot(x, y) < DIMENSION.drag) return;
      held.moved = true;
      const { along, pixel } = boxes.find((one) => one.input === input);
      const perPixel = (pixel * inNumber(1, "mm") * (isDiameter ? 2 : 1)) / (held.start.unit === lengthUnit ? 1 : lengthSize(held.start.unit) / lengthSize(lengthUnit));
      // Whole steps, of which a pixel is about one.
      const step = 10 ** Math.ceil(Math.log10(perPixel) - 0.3);
      const value = Math.max(step, Math.round((held.start.number + (x * along[0] + y * along[1]) * perPixel) / step) * step);
      held.value = `${Number(value.toPrecision(10))} ${held.start.unit}`;
      const field = fields.get(path);
      field.filled = null;
      field.input.value = held.value;
      if (field.range && field.slider) field.range.value = value;
      write(boxes.find((one) => one.input === input));
      draft(change(held.value));
    });
    for (const event_ of ["pointerup", "pointercancel"]) input.addEventListener(event_, () => {
      const { from, moved, value } = held;
      Object.assign(held, { from: null, value: null, moved: false });
      if (moved && value) commit(change(value));
      else if (from) {
        input.focus();
        input.select();
      }
    });
    return input;
  }

  function write({ input, kind, path, isDiameter }) {
    if (document.activeElement === input) return;
    const value = valueIn({ path, kind });
    const words_ = value ? `${kind === "base" || kind === "roller" ? (isDiameter ? "Ø" : "R") : ""}${shown(value.number)}` : "–";
    if (input.value !== words_) input.value = words_;
  }

  /** Lines and boxes at their places: positions of the machine become those of the screen. */
  function place(view, toScreen, pixel, [width, height]) {
    const isShown = boxes.length > 0 && width >= LEAST_PICTURE && !isPrinting();
    layer.hidden = !isShown;
    if (!isShown) return;
    const sample = locate(view.turn, turnOf(view));
    const of = (track) => (Array.isArray(track) ? between(track, sample) : track);
    const at = (role) => {
      const part = view.parts.find((one) => one.role === role);
      return part ? [of(part.x), of(part.y)] : null;
    };
    const [centre, pivot, roller] = [toScreen([0, 0]), at("follower") && toScreen(at("follower")), at("roller") && toScreen(at("roller"))];
    let [path, arrows] = ["", ""];
    const line = (a, b) => (path += `M${a[0].toFixed(1)} ${a[1].toFixed(1)}L${b[0].toFixed(1)} ${b[1].toFixed(1)}`);
    const arrow = ([x, y], [dx, dy]) => {
      const { arrow: size } = DIMENSION;
      arrows += `M${x.toFixed(1)} ${y.toFixed(1)}l${(-size * dx - 0.35 * size * dy).toFixed(1)} ${(-size * dy + 0.35 * size * dx).toFixed(1)}l${(0.7 * size * dy).toFixed(1)} ${(-0.7 * size * dx).toFixed(1)}z`;
    };
    const taken = [];
    /** Puts a box at a point, within the picture and beside those before. */
    const put_ = (one, [x, y], along) => {
      Object.assign(one, { along, pixel });
      const box = [Math.min(width - DIMENSION.wide / 2 - 4, Math.max(DIMENSION.wide / 2 + 2, x)), Math.min(height - DIMENSION.high / 2 - 2, Math.max(DIMENSION.high / 2 + 2, y))];
      for (const other of taken) if (Math.abs(other[0] - box[0]) < DIMENSION.wide + 4 && Math.abs(other[1] - box[1]) < DIMENSION.high + 4) box[1] = other[1] + Math.sign(box[1] - other[1] || 1) * (DIMENSION.high + 4);
      taken.push(box);
      one.input.style.transform = `translate(${(box[0] - DIMENSION.wide / 2).toFixed(1)}px, ${(box[1] - DIMENSION.high / 2).toFixed(1)}px)`;
      write(one);
      return box;
    };
    /** A length between two points, on a line beside them. */
    const length = (one, a, b, [nx, ny], away) => {
      const size = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
      const along = [(b[0] - a[0]) / size, (b[1] - a[1]) / size];
      const beside = (point) => [point[0] + away * nx, point[1] + away * ny];
      const [from, to] = [beside(a), beside(b)];
      line(a, [from[0] + 5 * nx, from[1] + 5 * ny]);
      line(b, [to[0] + 5 * nx, to[1] + 5 * ny]);
      line(from, to);
      arrow(from, [-along[0], -along[1]]);
      arrow(to, along);
      put_(one, [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2], along);
    };
    circle.style.display = "none";
    for (const one of boxes) {
      if (one.kind === "pivot" && pivot) length(one, centre, pivot, [-1, 0], centre[0] - Math.max(DIMENSION.wide / 2 + 4, Math.min(toScreen([view.box[0], 0])[0] - 12, centre[0] - 60)));
      if (one.kind === "arm" && pivot && roller) {
        const size = Math.hypot(roller[0] - pivot[0], roller[1] - pivot[1]) || 1;
        const side = roller[0] >= pivot[0] ? 1 : -1;
        const normal = [(-side * (pivot[1] - roller[1])) / size, (side * (pivot[0] - roller[0])) / size];
        length(one, pivot, roller, normal[0] * side > 0 ? normal : [-normal[0], -normal[1]], DIMENSION.away);
      }
      if (one.kind === "roller" && roller) {
        const radius = sizeInReport("roller radius") / pixel;
        const side = roller[0] >= centre[0] ? 1 : -1;
        const way = [side * 0.94, 0.34];
        const edge = [roller[0] + radius * way[0], roller[1] + radius * way[1]];
        const box = put_(one, [edge[0] + side * (DIMENSION.wide / 2 + 22), edge[1] + 14], way);
        line([box[0] - (side * DIMENSION.wide) / 2, box[1]], edge);
        arrow(edge, [-way[0], -way[1]]);
      }
      if (one.kind === "base") {
        const radius = sizeInReport("base radius") / pixel;
        circle.style.display = "";
        put(circle, "cx", centre[0].toFixed(2));
        put(circle, "cy", centre[1].toFixed(2));
        put(circle, "r", radius.toFixed(2));
        const way = [Math.SQRT1_2, Math.SQRT1_2];
        const edge = [centre[0] + radius * way[0], centre[1] + radius * way[1]];
        const box = put_(one, [edge[0] + 46, edge[1] + 40], way);
        line([box[0] - 12, box[1] - DIMENSION.high / 2], edge);
        arrow(edge, [-way[0], -way[1]]);
      }
    }
    put(thin, "d", path);
    put(heads, "d", arrows);
  }
  return { layer, anew, place };
}
