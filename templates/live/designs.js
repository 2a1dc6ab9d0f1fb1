// The embedded designs with their pictures, and what the program that serves the page can do.

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

/** Disc cams come first, then other bodies, presses last. */
const FIRST_DESIGNS = ["lever", "feeder", "valve", "conjugate", "groove", "yoke", "barrel", "indexer", "wedge"];
const rankOf = ({ name, commands }) => (FIRST_DESIGNS.includes(name) ? FIRST_DESIGNS.indexOf(name) : FIRST_DESIGNS.length + (commands.includes("make") ? 0 : 1));

/** The designs in the binary, once they were asked for, and their cards. */
let designs = null;
async function gallery() {
  byId("gallery").hidden = false;
  byId("gallery").scrollIntoView();
  if (formsOf !== language) newCam();
  if (designs) return;
  ({ designs } = await engine({ task: "designs" }));
  designs.sort((a, b) => rankOf(a) - rankOf(b));
  const cards = designs.flatMap((design) => design.commands.map((command) => ({ design, command, card: make("button", { type: "button", "data-design": `${design.name}-${command}` }, make("strong", {}, design.title), make("span", { className: "muted" }, `${design.name}, ${command}`)) })));
  for (const { design, command, card } of cards) card.addEventListener("click", () => {
    byId("gallery").hidden = true;
    openDesign({ ...design, command });
  });
  byId("cards").replaceChildren(...cards.map(({ card }) => card));
  // The pictures come one by one.
  for (const { design, command, card } of cards) {
    const made = await engine({ name: design.name, toml: design.toml, command, page: 24, tolerance: DRAFT }).catch(() => ({}));
    if (made.cam?.views) card.prepend(thumbnail(made.cam));
    // What cannot be made as it is begins nobody's work.
    else card.remove();
  }
  document.documentElement.dataset.gallery = "";
}

function startDesigns() {
  byId("designs").addEventListener("click", () => {
    if (byId("gallery").hidden) gallery();
    else byId("gallery").hidden = true;
  });
  listenToTabs();
  listenToLaws();
  listenToMeasured();
  if (!live.token) return;
  const button = (id, act) => {
    const made = make("button", { type: "button", id, "data-text": id }, text(id));
    // What is written is the state in which the changes before it leave the design.
    made.addEventListener("click", () => {
      const own = doc;
      afterChanges(() => act(own).catch((error) => refuse([{ message: error.message }])));
    });
    return made;
  };
  // Without a list of formats: those that the cam has.
  const buttons = [button("write", async (own) => {
    const done = await servedJson("/write", requestOf({ tolerance: own.tolerance }, own));
    if (done.faults) return refuse(done.faults);
    own.handedOut = own.now.toml;
    say("written", { files: done.written.join(", ") });
    if (own !== doc) return;
    const names = done.written.map((path) => path.split(/[\\/]/).pop());
    byId("files-note").textContent = text("written", { files: done.written[0].slice(0, -names[0].length) || "." });
    fileNames(names.map((name) => [name, () => takeFiles(name.split(".").pop(), (files) => files.filter((file) => file.name === name).forEach((file) => save(name, file.bytes)))]));
  })];
  if (docs.some(({ file }) => file)) {
    buttons.unshift(button("save", async (own) => {
      const { toml } = own.now;
      const done = await servedJson("/save", { design: own.index ?? -1, toml, before: own.onDisk });
      if (done.faults) return refuse(done.faults);
      own.onDisk = own.handedOut = toml;
      own.saved = performance.now();
      say("written", { files: own.file });
      tabs();
    }));
    watchFiles();
  } else gallery();
  byId("served").replaceChildren(...buttons);
}

/** An answer of that program that has no files. */
const servedJson = async (path, body) => JSON.parse(new TextDecoder().decode(await served(path, body)));

/** The files on the disk, once a second: another text is read again. */
async function watchFiles() {
  for (;;) {
    try {
      const asked = performance.now();
      const { designs: onDisk } = await servedJson("/files", {});
      // A text that was asked for before this page has written its own is an old one.
      docs.forEach((one) => one.file && onDisk[one.index] && !(one.saved > asked) && readAgain(one, onDisk[one.index]));
    } catch {
      say("lost");
    }
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
}

/** Takes another text of the disk, with the texts of the files that it names. */
function readAgain(one, { toml, files, fault }) {
  if (fault !== undefined) return one === doc && say("unread", { file: one.file });
  const others = JSON.stringify(files) !== JSON.stringify(one.filesOnDisk ?? one.files);
  const changed = (toml !== one.onDisk && toml !== one.now.toml) || others;
  const unsaved = one.now.toml !== one.onDisk;
  one.filesOnDisk = files;
  if (others) one.files = { ...one.files, ...files };
  one.onDisk = toml;
  if (!changed) return;
  if (one === doc) commit([], { toml }, unsaved ? "changedOverYours" : "changedOnDisk");
  else changeTo(one, { ...one.now, toml });
}
