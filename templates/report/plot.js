const plotOf = (panel, width, height) => diagramOf(panel, plottedOf(curvesOf(panel)), [width, height]);

/** Words of the strip and the stack; the live page has them in each language. */
const PHRASES = {
  verdictPass: "PASS", verdictFail: "FAIL", verdictWarn: "WARN", verdictRefused: "REFUSED", verdictInfo: "SHOWN",
  checksPassed: "{passed} of {all}", provenFile: "proved on the written file", noLimits: "nothing to judge",
  asCut: "As cut, filled on purpose", moreChecks: "{count} more, all with room", allChecks: "all checks", ofLimit: "{value} {side} {limit}", atPlace: "at {place}", used: "{used} %",
  atMost: "of at most", atLeast: "of at least", otherSide: "limit",
  margins: "Tightest margins", loads: "Motion and loads", moreCurves: "+ curves",
};
phrase = (name, values = {}) => PHRASES[name].replace(/\{(\w+)\}/g, (_, key) => values[key]);
