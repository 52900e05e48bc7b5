"""A chart and a trial of which it is known how they must look, in the place of a report's first ones.

Usage: made_up.py REPORT SCREENSHOT; one report is enough, as nothing but its scripts is looked at.
"""
import json
import pathlib
import re
import sys

from selenium.webdriver.common.by import By

from browser import actions, curve_ink, enter, expect, expect_no_complaints, has_live_pictures, opened, send, skip_part
from layouts import expect_heads_apart, open_tables, set_width
from texts import lower_labels, marks, texts, touching

WIDTH = 380        # pixels of a narrow window
ARROW = 24         # ... of a limit's arrow
STRANGE = "\\x8a"  # a character as it is written that was not to be read
LONG = "disturbance.ballast.irradiance_w_per_m2"


def point(x, y, is_limit=False):
    return {"x": x, "y": y, "low": y, "high": y, "is_limit": is_limit}


def curve(name, colour, points, kind="measured"):
    return {"name": name, "colour": colour, "kind": kind, "points": points}


# The limit lies at the foot of the axis that would be enough for all else.
CHART = {
    "x": {"label": "x", "title": "words, x", "logarithmic": False, "is_count": True},
    "y": {"label": "y", "title": "y", "logarithmic": True, "is_count": False,
          "level": {"at": 0.3, "text": "30 %"}},
    "curves": [curve("broken", 1, [point(0, 0.5), point(2, 0.5), point(4, 0.1, True), point(6, 0.5), point(8, 0.5)]),
               curve("between", 0, [point(x, 1) for x in (1, 3, 5, 7)]),
               curve("third", 2, [point(1, 1)]), curve("fourth", 3, [point(1, 1)]),
               *(curve(f"theory {colour}", colour, [point(1, 1)], "theory") for colour in (0, 2, 3))],
    "labels": []}


# Two decades of room for marks between powers of ten; the level is far below all points, whose theory is one alone.
LOGARITHMIC = {**CHART, "x": {**CHART["x"], "logarithmic": True},
               "y": {**CHART["y"], "level": {"at": 0.01, "text": "1 %"}},
               "curves": [curve("c", 1, [point(0.2, 0.5), point(20, 1)]), curve("law", 1, [point(20, 1)], "theory")]}


# Two curves of a colour, and grey ones between them.
HEIGHTS = {"above": 1, "upper grey": 0.1, "lower grey": 0.01, "below": 1e-3}
GREY = {**CHART, "y": {"label": "y", "title": "y", "logarithmic": True, "is_count": False},
        "curves": [curve(name, None if "grey" in name else len(name) % 2, [point(x, y) for x in (1, 2, 3)])
                   for name, y in HEIGHTS.items()]}


# A name halfway from a point to the next, left of the curve and above it.
NAMED = {**GREY, "labels": [{"name": "above", "curve": 0, "point": 1, "along": 0.5, "is_left": True, "is_above": True}]}


# One abscissa, below the least of a linear axis.
SINGLE = {**CHART, "x": {**CHART["x"], "logarithmic": True}, "curves": [curve("c", 1, [point(0.1, 0.5), ])]}


def with_long_heads(html):
    """All columns have such a name."""
    return re.sub('(<th scope="col">)[^<]*', rf"\g<1>{LONG}", html)


def with_first(html, kind, change):
    """The page with its first chart or trial changed."""
    begin = html.index(f'id="{kind}s">') + len(f'id="{kind}s">')
    end = html.index("</script>", begin)
    data = json.loads(html[begin:end])
    if data:
        data[0] = change(data[0])
    return html[:begin] + json.dumps(data) + html[end:]


def misread(trial):
    """With a wide mark amid the characters that were read."""
    middle = trial["read"][len(trial["read"]) // 2]
    middle[1:] = [STRANGE, True]
    return trial


def look_at_line(driver, chart):
    """It goes on where it has no point, and breaks at the limit, whose arrow is seen whole."""
    over = chart.find_element(By.CLASS_NAME, "u-over")
    ink = curve_ink(driver, chart.find_element(By.TAG_NAME, "canvas"), over)
    at = lambda x: round((x + 0.16) / 8.32 * len(ink))  # 2 % are beyond the first and the last
    for x in (0.5, 1.5, 6.5, 7.5):
        expect(ink[at(x)], f"at {x} a line has a gap where other curves alone have points")
    for x in (2.5, 3.5, 4.5, 5.5):
        expect(not ink[at(x)], f"at {x} a line goes through a limit")
    top, bottom = ink[at(4)] or ink[at(4) - 1]
    expect(bottom - top >= ARROW - 2 and bottom < over.size["height"] - 1, f"an arrow goes from {top} to {bottom}")


def look_at_legend(driver, chart):
    """Curves look different, and none is dashed; of several theories one line tells."""
    looks = driver.execute_script(
        """return [...arguments[0].querySelectorAll('.u-series:not(.folded) .u-marker svg')].map((svg) => [
             svg.innerHTML, [...svg.querySelectorAll('line')].map((line) => getComputedStyle(line).strokeDasharray)])""",
        chart)
    measured = [one for one in CHART["curves"] if one["kind"] == "measured"]
    expect(len({look for look, _ in looks}) == len(measured), f"curves look the same in the legend: {looks}")
    lines = [dashes for _, dashes in looks]
    expect(lines == [["none"], [], [], []], f"the legend has lines over theories, or dashes what was measured: {lines}")
    expect(chart.find_element(By.CLASS_NAME, "dashed").text == "dashed: theory", "it is not said what is dashed")
    actions(driver).move_to_element(chart.find_element(By.CLASS_NAME, "u-over")).perform()
    values = [value.text for value in chart.find_elements(By.CLASS_NAME, "u-value")]
    expect(values == ["4", "< 0.1", "-", "-", "-", "", "", ""], f"at a limit the legend says {values}")


def look_at_whole_marks(driver, chart):
    """Abscissae are counts: there are no marks between them, however near one looks."""
    send(driver, "+", "+")
    labels = lower_labels(texts(driver, chart.find_element(By.TAG_NAME, "canvas")))
    expect(labels == ["3", "4", "5"], f"about 4, marks of whole numbers are {labels}")


def look_at_narrow_legends(driver):
    torn = driver.execute_script(
        """const within = (part, whole) => {
             const a = part.getBoundingClientRect(), b = whole.getBoundingClientRect(), y = (a.top + a.bottom) / 2;
             return y > b.top && y < b.bottom;
           };
           return [...document.querySelectorAll('.u-series:not(.folded)')].filter((row) => {
             const label = row.querySelector('.u-label');
             return ![...row.querySelectorAll('.u-marker:has(line, circle), .u-value')].every((part) => within(part, label));
           }).map((row) => row.textContent);""")
    expect(not torn, f"in a narrow window these fall apart: {torn}")


def look_at_narrow_marks(driver):
    for trial in driver.find_elements(By.CLASS_NAME, "trial"):
        written = [marks(texts(driver, canvas)) for canvas in trial.find_elements(By.TAG_NAME, "canvas")]
        expect(any(one["text"] == f"[{STRANGE}]" for one in written[-1]), "what was misread is not marked")
        for line in written:
            expect(not touching(line), f"in a narrow window marks overlap: {touching(line)}")


def look_at_words(driver, chart):
    written = [one["text"] for one in texts(driver, chart.find_element(By.TAG_NAME, "canvas"))]
    for words in ("words, x", "30 %"):
        expect(words in written, f"a chart says nowhere {words}, but {written}")


def look_at_long_heads(driver):
    """They go on in the next line, and none in the middle of a word."""
    open_tables(driver, True)
    expect_heads_apart(driver)
    expect(driver.execute_script("return document.querySelector('th wbr.needed') !== null"), "no head goes on")


def look_at_logarithmic_marks(driver, report):
    chart = open_changed(driver, report, LOGARITHMIC)
    canvas = chart.find_element(By.TAG_NAME, "canvas")
    ink = curve_ink(driver, canvas, chart.find_element(By.CLASS_NAME, "u-over"))
    expect(any(ink) and not ink[len(ink) // 2], "points of a theory have a line over it")
    written = texts(driver, canvas)
    expect("1 %" in [one["text"] for one in written], "a level below all points is not seen")
    labels = lower_labels(written)
    expect(labels == ["0.2", "0.5", "1", "2", "5", "10", "20"], f"two decades are marked {labels}")
    enter(driver, chart)
    send(driver, *"++++++")
    labels = [float(label) for label in lower_labels(texts(driver, chart.find_element(By.TAG_NAME, "canvas")))]
    steps = [after - before for before, after in zip(labels, labels[1:])]
    expect(len(steps) >= 2 and max(steps) < 1.01 * min(steps), f"a part of a decade is marked {labels}")


def look_at_grey_curves(driver, report):
    """The one that is pointed at has a name; the others have none, and none is left when another is."""
    chart = open_changed(driver, report, GREY)
    over = chart.find_element(By.CLASS_NAME, "u-over")
    expect(chart.find_element(By.CLASS_NAME, "greyed").text.startswith("2 more curves are grey"), "nobody says of them")
    enter(driver, chart)
    for name, part in (("upper grey", 1 / 3), ("lower grey", 2 / 3), ("upper grey", 1 / 3)):
        down = round((part - 0.5) * over.size["height"])
        actions(driver).move_to_element_with_offset(over, 0, down).perform()
        rows = [row.text.split("\n")[0] for row in chart.find_elements(By.CSS_SELECTOR, ".u-series:not(.folded)")]
        expect(rows[1:] == [one for one in HEIGHTS if "grey" not in one or one == name],
               f"at {name} the legend has {rows}")


def look_at_names(driver, report):
    """They stand at their curves while these are shown, while all is shown, and where there is room."""
    chart = open_changed(driver, report, NAMED)
    over, name = (chart.find_element(By.CSS_SELECTOR, selector) for selector in (".u-over", ".name"))
    top = over.rect["y"]  # a curve of ones lies at the upper end
    at = over.rect["x"] + over.rect["width"] * (0.5 + 0.25 / 1.04)  # 1 to 3 with margins of a fiftieth
    expect(name.is_displayed() and name.text == "above", f"a curve's name is {name.text!r}")
    right, foot = name.rect["x"] + name.rect["width"], name.rect["y"] + name.rect["height"]
    expect(0 < at - right < 10, f"a name ends at {right}, left of {at}")
    expect(0 < top - foot < 10, f"a name has its foot at {foot}, above {top}")
    hide = chart.find_elements(By.CSS_SELECTOR, ".u-series th")[1]
    for press, is_shown in ((hide.click, False), (hide.click, True), (lambda: send(driver, "+"), False),
                            (lambda: send(driver, "0"), True), (lambda: set_width(driver, WIDTH), False)):
        press()
        expect(name.is_displayed() == is_shown, "a name is shown without its curve, or hidden beside it")
    set_width(driver, 1100)


def look_at_single_point(driver, report):
    """It is in the middle, whatever key is pressed."""
    chart = open_changed(driver, report, SINGLE)
    canvas, over = chart.find_element(By.TAG_NAME, "canvas"), chart.find_element(By.CLASS_NAME, "u-over")
    enter(driver, chart)
    for keys in ("", "+", "0"):
        send(driver, *keys)
        ink = curve_ink(driver, canvas, over)
        middle = ink[len(ink) // 2 - 4:len(ink) // 2 + 5]
        expect(any(middle), f"after the key {keys!r} a single point is not in the middle")


def look_at_failing_chart(driver, report):
    """Of data that nothing can be drawn of; the next is drawn."""
    chart = open_changed(driver, report, None)
    expect(chart.find_element(By.TAG_NAME, "svg").is_displayed(), "where drawing fails the still picture is hidden")
    expect(not chart.find_elements(By.TAG_NAME, "canvas"), "of a drawing that failed there is a rest")
    others = driver.find_elements(By.CSS_SELECTOR, ".chart, .trial")[1:]
    expect(all(other.find_elements(By.TAG_NAME, "canvas") for other in others), "one that fails takes others along")
    complaints = [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    expect(len(complaints) == 1, f"the console should have one complaint: {complaints}")


def open_changed(driver, report, first):
    """The report with that in the place of its first chart, which is given back."""
    html = with_first(pathlib.Path(report).read_text(), "chart", lambda _: first)
    changed = pathlib.Path(report).with_name("made_up.html")
    changed.write_text(with_long_heads(with_first(html, "trial", misread)))
    driver.get(changed.resolve().as_uri())
    return driver.find_element(By.CLASS_NAME, "chart")


def look_at_made_up(driver, report):
    set_width(driver, 1100)
    expect_no_complaints(driver)
    look_at_failing_chart(driver, report)
    look_at_single_point(driver, report)
    look_at_grey_curves(driver, report)
    look_at_names(driver, report)
    look_at_logarithmic_marks(driver, report)
    chart = open_changed(driver, report, CHART)
    look_at_words(driver, chart)
    look_at_long_heads(driver)
    enter(driver, chart)
    look_at_line(driver, chart)
    look_at_legend(driver, chart)
    look_at_whole_marks(driver, chart)
    set_width(driver, WIDTH)
    look_at_narrow_legends(driver)
    look_at_long_heads(driver)
    look_at_narrow_marks(driver)


def main(report, screenshot):
    driver = opened(report)
    if has_live_pictures(driver):
        look_at_made_up(driver, report)
        driver.save_screenshot(screenshot)
    else:
        skip_part("browser.made_up", "built without uPlot, which npm fetches (Debian: npm), so charts stand still")
    expect_no_complaints(driver)
    driver.quit()


main(*sys.argv[1:])
