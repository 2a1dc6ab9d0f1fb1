const plotOf = (panel, width, height) => diagramOf(panel, plottedOf(curvesOf(panel)), [width, height]);

