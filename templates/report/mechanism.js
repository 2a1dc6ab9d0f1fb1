// The mechanism: rigid parts at the places of their samples.

function mechanism(cam, index) {
  const svg = makeSvg("svg", { role: "img", preserveAspectRatio: "xMidYMid meet" });
  const caption = make("figcaption");
  const figure = make("figure", {}, svg, caption);
  let moving = [];
  let shownView = null;
  /** Size of a pixel of the screen, mm. */
  let pixel = 1;

  function build(view) {
    shownView = view;
    svg.replaceChildren();
    svg.setAttribute("viewBox", view.box.join(" "));
    svg.setAttribute("aria-label", `Mechanism of ${cam.title}`);
    moving = [];
    const names = [];
    for (const part of view.parts) {
      const group = makeSvg("g", { class: `part ${part.role}` });
      group.append(makeSvg("path", { d: part.path }));
      svg.append(group);
      let name = null;
      if (part.name) {
        name = makeSvg("text");
        name.textContent = part.name[0];
        names.push(name);
      }
      const range = Array.isArray(part.pressure) ? [Math.min(...part.pressure), Math.max(...part.pressure)] : null;
      moving.push({ part, group, name, range, room: 0 });
    }
    svg.append(...names);
    const words = [letter(index) && `${letter(index)}: ${cam.title}.`, ...cam.pictureNotes].filter(Boolean);
    caption.textContent = words.join(" ");
    requestAnimationFrame(scale);
  }

  /** Text keeps its size on the screen, independent of the size of the machine. */
  function scale() {
    const [, , width, height] = shownView.box;
    const box = svg.getBoundingClientRect();
    pixel = box.width > 0 ? Math.max(width / box.width, height / box.height) : width / 1000;
    svg.style.setProperty("--scale", pixel);
    for (const one of moving) if (one.name) one.room = one.name.getBBox().width / 2;
    draw();
  }

  /** Of names that would overlap or touch the first is kept. */
  function unravel() {
    const kept = [];
    for (const { name } of moving) {
      if (!name) continue;
      const own = name.getBBox();
      const gap = 5 * pixel;
      const over = (other) => own.x < other.x + other.width + gap && other.x < own.x + own.width + gap && own.y < other.y + other.height && other.y < own.y + own.height;
      const hidden = kept.some(over);
      name.style.visibility = hidden ? "hidden" : "";
      if (!hidden) kept.push(own);
    }
  }

  function draw() {
    const view = viewOf(cam);
    if (view !== shownView) build(view);
    const sample = locate(view.turn, turnOf(view));
    const of = (track) => (Array.isArray(track) ? between(track, sample) : track);
    const [left, , wide] = view.box;
    // Names are larger on paper.
    if ("printing" in document.documentElement.dataset) for (const one of moving) if (one.name) one.room = one.name.getBBox().width / 2;
    for (const { part, group, name, range, room } of moving) {
      const [x, y] = [of(part.x), -of(part.y)];
      group.setAttribute("transform", `translate(${x} ${y}) rotate(${-of(part.turn)}) scale(${of(part.stretch)} ${of(part.height ?? 1)})`);
      if (name) {
        // A name at the edge is not cut.
        name.setAttribute("x", Math.max(left + room, Math.min(left + wide - room, x + part.name[1])));
        name.setAttribute("y", y + part.name[2]);
      }
      // Pale at ambient pressure, deep at the largest.
      if (range) group.style.fillOpacity = 0.1 + 0.75 * ((of(part.pressure) - range[0]) / (range[1] - range[0] || 1));
    }
    if (!state.playing) unravel();
  }

  new ResizeObserver(() => shownView && scale()).observe(svg);
  return { figure, draw };
}

