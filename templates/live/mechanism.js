// The mechanism of the report, which here changes while a slider moves: what stays is not made anew, and the picture keeps its scale.

/** Largest share of the picture that may be empty before it is fitted again. */
const ROOM = 1.3;

function mechanism(cam, index) {
  const svg = makeSvg("svg", { role: "img", preserveAspectRatio: "xMidYMid meet" });
  const caption = make("figcaption");
  const figure = make("figure", {}, svg, caption);
  let moving = [];
  let shownView = null;
  let shape = "";
  /** What is seen of the machine, and the size of the picture on the screen. */
  let picture = null;
  let [width, height] = [0, 0];
  let pixel = 1;
  const paint = index === 0 ? outlinePaint() : null;
  const sizes = index === 0 ? dimensionBoxes() : null;
  if (sizes) svg.after(sizes.layer);
  let paintedGroup = null;

  /** The parts of a view in the place of those before; only what differs is changed. */
  function build(view) {
    shownView = view;
    const now = JSON.stringify(view.parts.map(({ role, name }) => [role, name?.[0]]));
    if (now !== shape) {
      shape = now;
      moving = view.parts.map(({ role, name }) => {
        const path = makeSvg("path");
        const group = makeSvg("g", { class: `part ${role}` });
        group.append(path);
        const text = name && makeSvg("text");
        if (text) text.textContent = name[0];
        return { group, path, name: text, room: 0 };
      });
      svg.replaceChildren(...moving.map(({ group }) => group), ...moving.map(({ name }) => name).filter(Boolean));
      picture = null;
      paintedGroup = paint ? moving[view.parts.findIndex(({ role }) => role === "cam")]?.group ?? null : null;
      paintedGroup?.append(paint.group);
      if (paintedGroup) svg.append(paint.bead);
    }
    if (paintedGroup) paint.take(view);
    view.parts.forEach((part, at) => {
      const one = moving[at];
      one.part = part;
      one.range = pressuresOf(part);
      put(one.path, "d", part.path);
    });
    fit(view.box);
    put(svg, "aria-label", `Mechanism of ${cam.title}`);
    const words = captionOf(cam, index);
    if (caption.textContent !== words) caption.textContent = words;
  }

  /** The picture keeps its scale while everything is in it, so that what grows is seen to grow; it is fitted again at rest. */
  function fit([x, y, wide, high]) {
    if (!picture) picture = [x, y, wide, high];
    const inside = x >= picture[0] && y >= picture[1] && x + wide <= picture[0] + picture[2] && y + high <= picture[1] + picture[3];
    if (!inside) {
      const [left, top] = [Math.min(x, picture[0]), Math.min(y, picture[1])];
      picture = [left, top, Math.max(x + wide, picture[0] + picture[2]) - left, Math.max(y + high, picture[1] + picture[3]) - top];
    }
    put(svg, "viewBox", seenBox().join(" "));
    scale();
  }

  /** What is seen of the picture: all of it, or a part around a point. */
  let zoom = 1;
  let centre = [0, 0];
  function seenBox() {
    const [x, y, wide, high] = picture;
    return zoom === 1 ? picture : [centre[0] - wide / zoom / 2, centre[1] - high / zoom / 2, wide / zoom, high / zoom];
  }

  /** Shows the picture larger or smaller around a point of it; a factor of 0 fits it again. */
  function zoomBy(factor, around = null) {
    if (!picture) return;
    const [x, y, wide, high] = seenBox();
    const [middleX, middleY] = [x + wide / 2, y + high / 2];
    const next = factor === 0 ? 1 : Math.min(40, Math.max(1, zoom * factor));
    const point = around ?? [middleX, middleY];
    const share = 1 - zoom / next;
    centre = [middleX + (point[0] - middleX) * share, middleY + (point[1] - middleY) * share];
    zoom = next;
    put(svg, "viewBox", seenBox().join(" "));
    scale();
    measureNames(moving);
    draw();
  }

  /** A point of the window in the coordinates of the picture. */
  function pointOf(event) {
    const box = svg.getBoundingClientRect();
    const [x, y, wide, high] = seenBox();
    const size = Math.max(wide / box.width, high / box.height);
    return [x + wide / 2 + (event.clientX - box.left - box.width / 2) * size, y + high / 2 + (event.clientY - box.top - box.height / 2) * size];
  }

  /** A position of the machine on the screen, in pixels of the picture. */
  function onScreen([x, y]) {
    const [left, top, wide, high] = seenBox();
    return [width / 2 + (x - left - wide / 2) / pixel, height / 2 + (-y - top - high / 2) / pixel];
  }

  // With Ctrl, as maps do: without it the wheel scrolls the page.
  svg.addEventListener("wheel", (event) => {
    if (!event.ctrlKey || !picture) return;
    event.preventDefault();
    zoomBy(event.deltaY < 0 ? 1.25 : 0.8, pointOf(event));
  }, { passive: false });
  svg.addEventListener("dblclick", (event) => picture && (zoom === 1 ? zoomBy(4, pointOf(event)) : zoomBy(0)));
  let held = null;
  svg.addEventListener("pointerdown", (event) => {
    if (zoom === 1) return;
    held = pointOf(event);
    svg.setPointerCapture(event.pointerId);
  });
  svg.addEventListener("pointermove", (event) => {
    if (!held) return;
    const now = pointOf(event);
    centre = [centre[0] + held[0] - now[0], centre[1] + held[1] - now[1]];
    put(svg, "viewBox", seenBox().join(" "));
  });
  for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, () => (held = null));

  /** Fits the picture again where it has become much too large. */
  function rest() {
    const [, , wide, high] = shownView.box;
    if (picture && Math.max(picture[2] / wide, picture[3] / high) > ROOM && Math.min(picture[2] / wide, picture[3] / high) > 1.02) picture = null;
    if (!picture) fit(shownView.box);
    measureNames(moving);
    sizes?.anew(shownView);
    draw();
  }

  /** Text keeps its size on the screen, independent of the size of the machine. */
  function scale() {
    if (!picture) return;
    const [, , wide, high] = seenBox();
    pixel = width > 0 ? Math.max(wide / width, high / height) : wide / 1000;
    const size = String(pixel);
    if (svg.style.getPropertyValue("--scale") !== size) svg.style.setProperty("--scale", size);
  }

  /** Every part at its place; names are kept apart where there is time for it. */
  function draw(isQuick = state.playing) {
    const view = viewOf(cam);
    if (view !== shownView) build(view);
    placeParts(moving, view, seenBox());
    if (paintedGroup) {
      paint.place(view, paintedGroup.getAttribute("transform"), pixel);
      scaleMark(view);
    }
    sizes?.place(view, onScreen, pixel, [width, height]);
    if (!isQuick) unravel(moving, pixel);
  }

  new ResizeObserver(([{ contentRect }]) => {
    [width, height] = [contentRect.width, contentRect.height];
    if (!shownView) return;
    scale();
    measureNames(moving);
    draw();
  }).observe(svg);
  /** The outline in the colours of another quantity. */
  function paintAnew() {
    if (paintedGroup) paint.take(shownView);
    draw();
  }
  return { figure, draw, rest, paintAnew, zoomBy };
}
