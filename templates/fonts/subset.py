"""Makes the rule with the font that is embedded in sheets, sheet-font.css, from LiberationSans-Regular.ttf.

A changed font may not keep the reserved name, so it gets one of its own. Needs fontTools.

usage: subset.py  (in this directory)
"""
from base64 import b64encode
from io import BytesIO
from pathlib import Path

from fontTools import subset

# Basic Latin to Latin Extended-A, Greek, dashes, quotes, arrows, operators.
RANGES = "20-7E,A0-17F,370-3FF,2010-2027,2030,2032-2033,2070-2089,20AC,2126,2190-2193,2202,2206,2211-2212,221A,221E,2248,2260,2264-2265"
NAMES = {1: "Sheet Sans", 3: "Sheet Sans; subset of Liberation Sans 2", 4: "Sheet Sans", 6: "SheetSans"}

options = subset.Options()
options.flavor, options.hinting, options.layout_features = "woff", False, []
font = subset.load_font("LiberationSans-Regular.ttf", options)
subsetter = subset.Subsetter(options)
subsetter.populate(unicodes=subset.parse_unicodes(RANGES))
subsetter.subset(font)
for record in font["name"].names:
    if record.nameID in NAMES:
        record.string = NAMES[record.nameID]
font["head"].modified = font["head"].created
font.recalcTimestamp = False
data = BytesIO()
subset.save_font(font, data, options)
rule = '@font-face { font-family: "Sheet Sans"; src: url(data:font/woff;base64,%s); }\n'
Path("sheet-font.css").write_text(rule % b64encode(data.getvalue()).decode())
