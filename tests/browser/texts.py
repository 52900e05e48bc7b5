"""What is written on canvases, and where."""

# Each canvas keeps the texts that were written since it was last cleared, with their boxes.
RECORDER = """
const {fillText, clearRect} = CanvasRenderingContext2D.prototype;
CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
  const size = this.measureText(text), at = this.getTransform();
  const corners = [[x - size.actualBoundingBoxLeft, y - size.actualBoundingBoxAscent],
                   [x + size.actualBoundingBoxRight, y + size.actualBoundingBoxDescent]]
    .map(([u, v]) => at.transformPoint({x: u, y: v}));
  const [left, right] = corners.map((point) => point.x).sort((a, b) => a - b);
  const [top, bottom] = corners.map((point) => point.y).sort((a, b) => a - b);
  (this.canvas.texts ??= []).push({text, left, right, top, bottom, align: this.textAlign, font: this.font});
  return fillText.apply(this, arguments);
};
CanvasRenderingContext2D.prototype.clearRect = function () {
  this.canvas.texts = [];
  return clearRect.apply(this, arguments);
};
"""


def record_texts(driver):
    """Of the pages that are opened from now on."""
    driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": RECORDER})


def texts(driver, canvas):
    return [one for one in driver.execute_script("return arguments[0].texts", canvas) if one["text"].strip()]


def upright_labels(written):
    """At the marks of the upright axis."""
    return [one for one in written if one["align"] == "right"]


def lower_labels(written):
    """What is written at the marks of the lower axis."""
    return [one["text"] for one in written if one["align"] == "center" and one["text"][-1].isdigit()]


def marks(written):
    """Along the top of a trial's plot, from left to right."""
    return sorted((one for one in written if "monospace" in one["font"]), key=lambda one: one["left"])


def touching(written, gap=0):
    """Pairs of texts that are nearer to each other than a gap in pixels."""
    return [(a["text"], b["text"]) for i, a in enumerate(written) for b in written[:i]
            if a["left"] < b["right"] + gap and b["left"] < a["right"] + gap
            and a["top"] < b["bottom"] and b["top"] < a["bottom"]]
