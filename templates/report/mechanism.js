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
      moving.push({ part, group, name, range: pressuresOf(part), room: 0 });
    }
    svg.append(...names);
    caption.textContent = captionOf(cam, index);
    requestAnimationFrame(scale);
  }

  /** Text keeps its size on the screen, independent of the size of the machine. */
  function scale() {
    const [, , width, height] = shownView.box;
    const box = svg.getBoundingClientRect();
    pixel = box.width > 0 ? Math.max(width / box.width, height / box.height) : width / 1000;
    svg.style.setProperty("--scale", pixel);
    measureNames(moving);
    draw();
  }

  function draw() {
    const view = viewOf(cam);
    if (view !== shownView) build(view);
    placeParts(moving, view, view.box);
    if (!state.playing) unravel(moving, pixel);
  }

  new ResizeObserver(() => shownView && scale()).observe(svg);
  return { figure, draw };
}

