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
