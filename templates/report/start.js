/** Where the curves are stacked, the diagrams with all their curves and legends are folded. */
function foldDiagrams() {
  if (!usesStack()) return;
  byId("moving").classList.add("stacked");
  byId("curves-choice").hidden = false;
  allDiagrams = make("details", {}, make("summary", {}, byId("curves-title")), byId("plots"));
  byId("curves").append(allDiagrams);
  allDiagrams.addEventListener("toggle", () => isPrinting() || drawPlots());
}

foldDiagrams();
start();
