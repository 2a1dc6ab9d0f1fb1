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
    }
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
    put(svg, "viewBox", picture.join(" "));
    scale();
  }

  /** Fits the picture again where it has become much too large. */
  function rest() {
    const [, , wide, high] = shownView.box;
    if (picture && Math.max(picture[2] / wide, picture[3] / high) > ROOM && Math.min(picture[2] / wide, picture[3] / high) > 1.02) picture = null;
    if (!picture) fit(shownView.box);
    measureNames(moving);
    draw();
  }

  /** Text keeps its size on the screen, independent of the size of the machine. */
  function scale() {
    if (!picture) return;
    pixel = width > 0 ? Math.max(picture[2] / width, picture[3] / height) : picture[2] / 1000;
    const size = String(pixel);
    if (svg.style.getPropertyValue("--scale") !== size) svg.style.setProperty("--scale", size);
  }

  /** Every part at its place; names are kept apart where there is time for it. */
  function draw(isQuick = state.playing) {
    const view = viewOf(cam);
    if (view !== shownView) build(view);
    placeParts(moving, view, picture);
    if (!isQuick) unravel(moving, pixel);
  }

  new ResizeObserver(([{ contentRect }]) => {
    [width, height] = [contentRect.width, contentRect.height];
    if (!shownView) return;
    scale();
    measureNames(moving);
    draw();
  }).observe(svg);
  return { figure, draw, rest };
}
