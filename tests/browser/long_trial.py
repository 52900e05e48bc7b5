#!/usr/bin/env python3
"""A trial of ten million samples in headless Chromium: no spike of one value is lost however far one zooms, and
single cycles of the carrier have their shape.

Usage: long_trial.py REPORT.html SCREENSHOT.png; exits 1 saying what is wrong. Writes beside the report.
"""
import array
import base64
import json
import pathlib
import sys

from selenium.webdriver.common.by import By

from browser import actions, curve_ink, enter, expect, expect_no_complaints, has_live_pictures, opened, press, skip_part

FEWEST_SAMPLES = 10_000_000
BEGIN, END = '<script type="application/json" id="trials">', "</script>"
GREATEST = 65535
SPIKE_HEIGHT = 60  # pixels, of 80
HALF, STEPS = 30, 6  # pixels to each side are zoomed to, so often
CYCLES = 25  # that the third view shows of light


def trials_in(html):
    """Their place in the text, and what they are."""
    begin = html.index(BEGIN) + len(BEGIN)
    end = html.index(END, begin)
    return begin, end, json.loads(html[begin:end])


def values_of(tap):
    values = array.array("H", base64.b64decode(tap["values"]))
    if sys.byteorder == "big":
        values.byteswap()
    return values


def with_spike(report, spiked):
    """Of the light, all values in the lower half of the range, but for one."""
    html = pathlib.Path(report).read_text()
    begin, end, trials = trials_in(html)
    trial, light = trials[0], trials[0]["taps"][0]
    values = values_of(light)
    samples = len(values) * trial["stretch"] // 2
    expect(samples >= FEWEST_SAMPLES, f"the trial has {samples} samples alone")
    halved = array.array("H", (value // 2 for value in values))
    halved[len(halved) * 3 // 4] = GREATEST
    light["values"] = base64.b64encode(halved.tobytes()).decode()
    spiked.write_text(html[:begin] + json.dumps(trials) + html[end:])


def drag_about(driver, plot, column, half):
    """Zooms to the pixels about one of a plot."""
    left = column - plot.size["width"] // 2
    actions(driver).move_to_element_with_offset(plot, left - half, 0).click_and_hold() \
        .move_by_offset(2 * half, 0).release().perform()


def expect_spike(columns, about):
    """Which columns it is in. All else is in the lower half."""
    drawn = [ends for ends in columns if ends]
    high, low = min(ends[0] for ends in drawn), max(ends[1] for ends in drawn)
    expect(low - high > SPIKE_HEIGHT, f"{about} there is no spike to {high} from {low}")
    return [x for x, ends in enumerate(columns) if ends and ends[0] < high + (low - high) // 4]


def follow_spike(driver):
    """From the whole trial to the narrowest view."""
    trial = driver.find_element(By.CLASS_NAME, "trial")
    canvas, plot = trial.find_element(By.TAG_NAME, "canvas"), trial.find_element(By.CLASS_NAME, "u-over")
    enter(driver, trial)
    offset = plot.location["x"] - canvas.location["x"]
    for step in range(STEPS):
        columns = curve_ink(driver, canvas)
        spike = expect_spike(columns, f"after {step} steps")
        expect(len(spike) <= 3 or step >= STEPS - 3, f"after {step} steps the spike is {len(spike)} pixels wide")
        expect(sum(map(bool, columns)) > 0.95 * plot.size["width"] or step >= STEPS - 3,
               f"after {step} steps the curve has gaps")
        drag_about(driver, plot, spike[len(spike) // 2] - offset, HALF)
    expect_spike(curve_ink(driver, canvas), "in the narrowest view")


def crossings(columns):
    """How often a curve passes the middle of its height."""
    drawn = [ends for ends in columns if ends]
    middle = (min(ends[0] for ends in drawn) + max(ends[1] for ends in drawn)) / 2
    passes = [bool(ends) and ends[0] <= middle <= ends[1] for ends in columns]
    return sum(now and not before for before, now in zip(passes, passes[1:]))


def count_cycles(driver):
    trial = driver.find_element(By.CLASS_NAME, "trial")
    press(driver, driver.find_elements(By.CSS_SELECTOR, ".views button")[2])
    count = crossings(curve_ink(driver, trial.find_element(By.TAG_NAME, "canvas")))
    expect(abs(count - 2 * CYCLES) <= 2, f"{CYCLES} cycles of light pass their middle {count} times")


def main(report, screenshot):
    spiked = pathlib.Path(report).with_name("spiked.html")
    with_spike(report, spiked)
    driver = opened(spiked)
    if not has_live_pictures(driver):
        skip_part("browser.long_trial", "built without uPlot, which npm fetches (Debian: npm), so charts stand still")
        driver.quit()
        return
    follow_spike(driver)
    driver.get(pathlib.Path(report).resolve().as_uri())
    count_cycles(driver)
    driver.save_screenshot(screenshot)
    expect_no_complaints(driver)
    driver.quit()


main(*sys.argv[1:])
