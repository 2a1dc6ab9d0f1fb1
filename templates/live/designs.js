// The embedded designs with their pictures, and a new cam by a few numbers.

/** The outline of a cam as a small picture. */
function thumbnail(cam) {
  const view = cam.views.at(-1);
  const svg = makeSvg("svg", { "aria-hidden": "true" });
  const own = view.parts.filter(({ role }) => role === "cam");
  for (const part of own.length ? own : view.parts.filter(({ role }) => !["normal", "arrow"].includes(role))) svg.append(makeSvg("path", { d: part.path }));
  byId("cards").append(svg);
  const box = svg.getBBox();
  svg.setAttribute("viewBox", [box.x, box.y, box.width, box.height].join(" "));
  svg.remove();
  return svg;
}

let designs = null;
async function gallery() {
  byId("gallery").hidden = false;
  byId("gallery").scrollIntoView();
  if (designs) return;
  ({ designs } = await engine({ task: "designs" }));
  byId("cards").replaceChildren(newCam());
  for (const design of designs) {
    for (const command of design.commands) {
      const card = make("button", { type: "button", "data-design": `${design.name}-${command}` }, make("strong", {}, design.title), make("span", { className: "muted" }, `${design.name}, ${command}`));
      card.addEventListener("click", () => {
        byId("gallery").hidden = true;
        openDesign({ name: design.name, toml: design.toml, command, commands: design.commands });
      });
      byId("cards").append(card);
      const made = await engine({ name: design.name, toml: design.toml, command, page: 24, tolerance: DRAFT });
      if (made.cam?.views) card.prepend(thumbnail(made.cam));
      // What cannot be made as it is begins nobody's work.
      else card.remove();
    }
  }
  document.documentElement.dataset.gallery = "";
}

const FOLLOWERS = { roller: ['radius = "12 mm"', "mm"], "swinging-roller": ['radius = "12 mm"\narm = "110 mm"\npivot_distance = "140 mm"', "deg"], flat: ["", "mm"] };

/** The text of a machine file for a rise, a dwell and a return. */
function textOfNew({ follower, body, rise, riseOver, dwellOver, returnOver, rpm }) {
  const [keys, unit] = FOLLOWERS[follower];
  const dwell = dwellOver > 0 ? `[[motion.segment]]\nlaw = "dwell"\nover = "${dwellOver} deg"\n\n` : "";
  const rest = riseOver + dwellOver + returnOver < 360 ? '\n[[motion.segment]]\nlaw = "dwell"                         # the rest of the turn\n' : "";
  // An arm swings by the angle whose arc is the rise.
  const top = follower === "swinging-roller" ? Number(((rise / 110) * (180 / Math.PI)).toFixed(3)) : rise;
  return `# A cam begun in the live page of camgen.\n\nname = "New cam"\n\n[motion]\nrpm = ${rpm}\nstart = "0 ${unit}"\n\n[[motion.segment]]\nlaw = "modified-sine"\nover = "${riseOver} deg"\nto = "${top} ${unit}"\n\n${dwell}[[motion.segment]]\nlaw = "modified-sine"\nover = "${returnOver} deg"\nto = "0 ${unit}"\n${rest}\n[follower.${follower}]\n${keys}\n\n[cam]\nbody = "${body}"\nbase_radius = "auto"\nthickness = "15 mm"\nbore_radius = "10 mm"\nmaterial = "steel"\n\n[limits]\n`;
}

function newCam() {
  const select = (id, options) => make("label", {}, `${text(id)} `, make("select", { id: `new-${id}` }, ...options.map(([value, name]) => make("option", { value }, name))));
  const number = (id, value) => make("label", {}, `${text(id)} `, make("input", { id: `new-${id}`, type: "text", inputMode: "decimal", value: String(value), size: 6 }));
  const go = make("button", { type: "button", id: "new-make" }, text("make"));
  go.addEventListener("click", () => {
    const value = (id) => byId(`new-${id}`).value;
    const toml = textOfNew({ follower: value("follower"), body: value("body"), rise: Number(value("rise")), riseOver: Number(value("riseOver")), dwellOver: Number(value("dwellOver")), returnOver: Number(value("returnOver")), rpm: Number(value("rpm")) });
    byId("gallery").hidden = true;
    openDesign({ name: "new-cam", toml, command: "make", commands: ["make"] });
  });
  return make("div", { className: "new" }, make("strong", {}, text("newCam")), select("follower", Object.keys(FOLLOWERS).map((name) => [name, text(name)])), select("body", ["disc", "groove", "ring", "conjugate"].map((name) => [name, name])),
    number("rise", 30), number("riseOver", 120), number("dwellOver", 60), number("returnOver", 100), number("rpm", 250), go);
}

/** What only the program that serves the page can do: write the machine file and the cam's files, and see the file change. */
function startDesigns() {
  byId("designs").addEventListener("click", () => {
    if (byId("gallery").hidden) gallery();
    else byId("gallery").hidden = true;
  });
  if (!live.served) return;
  const button = (id, act) => {
    const made = make("button", { type: "button", id, "data-text": id }, text(id));
    made.addEventListener("click", () => act().catch((error) => complain([{ message: error.message }])));
    return made;
  };
  const told = async (path, body) => JSON.parse(new TextDecoder().decode(await served(path, body)));
  const buttons = [button("write", async () => {
    const done = await told("/write", requestOf({ tolerance: live.tolerance, formats: ["dxf", "svg", "step", "csv"] }));
    if (done.faults) complain(done.faults);
    else byId("state").textContent = text("written", { files: done.written.join(", ") });
  })];
  if (live.served.file) {
    buttons.unshift(button("save", async () => {
      const done = await told("/save", { toml: now.toml, before: onDisk });
      if (done.faults) complain(done.faults);
      else byId("state").textContent = text("written", { files: live.served.file });
    }));
    watchFile(told);
  } else gallery();
  byId("downloads").append(make("p", { className: "row" }, ...buttons));
}

/** The text of the machine file as it was last seen on the disk. */
let onDisk = live.toml;

/** The file on the disk, once a second: another text is read again. */
async function watchFile(told) {
  for (;;) {
    try {
      const { toml } = await told("/file", {});
      if (toml === undefined) throw new Error("no file");
      if (toml !== onDisk && toml !== now.toml) commit([], { toml }, "changedOnDisk");
      onDisk = toml;
    } catch {
      byId("state").textContent = text("lost");
    }
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
}
