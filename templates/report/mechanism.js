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

/** The pressure in the air of a view, where there is one. */
function pressureOf(view) {
  const air = view.parts.find((part) => part.pressure !== null);
  return air ? between(air.pressure, locate(view.turn, turnOf(view))) : null;
}

/** The values at the cursor. */
function readout(cam, index) {
  const list = make("dl", { className: "readout", "aria-live": "off" });
  const box = make("div", {}, cams.length > 1 ? make("h3", {}, `${letter(index)}: ${cam.title}`) : null, list);
  const hidden = ["profile_x_mm", "profile_y_mm", "contact_x_mm", "contact_y_mm", "contact_z_mm", "z_mm", "rpm"];
  let entries = [];
  let shownView = null;

  function build(view) {
    shownView = view;
    const names = Object.keys(view.columns).filter((name) => !hidden.includes(name));
    entries = names.map((name) => ({ name, value: make("span"), unit: make("span", { className: "unit" }) }));
    const row = (label, value, unit) => make("div", {}, make("dt", {}, label), make("dd", {}, value, unit));
    const rows = entries.map(({ name, value, unit }) => row(view.kinds[name][0], value, unit));
    if (pressureOf(view) !== null) {
      const [value, unit] = [make("span"), make("span", { className: "unit" }, "bar")];
      entries.push({ name: null, value, unit });
      rows.push(row("air, absolute pressure", value, unit));
    }
    list.replaceChildren(...rows);
  }

  function draw() {
    const view = viewOf(cam);
    if (view !== shownView) build(view);
    const places = view.columns[view.place];
    const place = placeOf(view);
    // A plate has a run-in before the first row of its table.
    const inTable = place >= places[0] - 1e-9;
    const sample = locate(places, place);
    for (const { name, value, unit } of entries) {
      if (name === null) {
        value.textContent = steady(pressureOf(view));
        continue;
      }
      const [, kind, order] = view.kinds[name];
      const [factor, words] = inRates(view, kind, order);
      const at = name === view.place ? place : inTable ? between(view.columns[name], sample) : null;
      value.textContent = steady(at === null ? null : at * factor);
      unit.textContent = words;
    }
  }

  return { box, draw };
}
