#!/usr/bin/env python3
"""Opens a report in headless Chromium and uses it as a person would.

Usage: open_report.py REPORT.html SCREENSHOT.png; exits 1 saying what is wrong.
"""
import sys

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import actions, drag_over, drag_with_shift, enter, expect, expect_no_complaints, has_live_pictures, image
from browser import opened, press, save_whole_page, send, send_with_control, skip_part
from layouts import look_at_layouts, look_without_scripts
from tables import use_tables
from texts import marks, texts, touching, upright_labels

FEWEST_PIXELS = 100   # of a curve's colour; axes, labels and lines across are grey
FEWEST_BITS = 8       # of those about one byte
ROOM = 4              # pixels between labels and what stands beside them


def coloured_pixels(driver, canvas):
    """Those of curves."""
    return driver.execute_script(
        """const {width, height} = arguments[0];
           const {data} = arguments[0].getContext('2d').getImageData(0, 0, width, height);
           let count = 0;
           for (let i = 0; i < data.length; i += 4) {
             const red = data[i], green = data[i + 1], blue = data[i + 2];
             if (data[i + 3] > 100 && Math.max(red, green, blue) - Math.min(red, green, blue) > 60) ++count;
           }
           return count;""", canvas)


def expect_labels_apart(driver, canvas):
    """Also from the title beside them."""
    written = texts(driver, canvas)
    labels = [one["text"] for one in upright_labels(written)]
    expect(labels and len(set(labels)) == len(labels), f"marks have the same label: {labels}")
    expect(not touching(written, ROOM), f"these texts touch: {touching(written, ROOM)}")


def use_chart(driver, chart):
    canvas = chart.find_element(By.TAG_NAME, "canvas")
    plot = chart.find_element(By.CLASS_NAME, "u-over")
    expect(coloured_pixels(driver, canvas) > FEWEST_PIXELS, "a chart has nothing on it")
    expect_labels_apart(driver, canvas)
    enter(driver, chart)
    whole = image(driver, canvas)
    send(driver, Keys.ARROW_RIGHT, "-")
    expect(image(driver, canvas) == whole, "a chart can be moved away from its curves")
    send_with_control(driver, "+")
    expect(image(driver, canvas) == whole, "a chart takes the key by which the browser zooms")
    send(driver, "+")
    zoomed = image(driver, canvas)
    expect(zoomed != whole, "the key + does not zoom a chart")
    expect(" to " in told_of(chart), "it is not said what is shown")
    send(driver, Keys.ARROW_RIGHT)
    expect(image(driver, canvas) not in (zoomed, whole), "an arrow does not move a chart")
    right = image(driver, canvas)
    drag_with_shift(driver, plot)
    expect(image(driver, canvas) not in (right, whole), "the mouse with Shift does not move a chart")
    send(driver, *(9 * [Keys.ARROW_RIGHT]))
    end = image(driver, canvas)
    send(driver, Keys.ARROW_RIGHT)
    expect(image(driver, canvas) == end, "arrows move a chart beyond its curves")
    send(driver, "0")
    for back in ("0", "--"):
        send(driver, "+", *back)
        expect(image(driver, canvas) == whole, f"{back} does not show the whole chart again")
    drag_over(driver, plot)
    expect(image(driver, canvas) != whole, "the mouse does not zoom a chart")
    actions(driver).double_click(plot).perform()


def use_legend(driver, chart):
    """By the keyboard: each curve is hidden and comes back."""
    canvas = chart.find_element(By.TAG_NAME, "canvas")
    for name in chart.find_elements(By.CSS_SELECTOR, ".u-series:not(.folded) th[role=button]"):
        whole = image(driver, canvas)
        enter(driver, name)
        send(driver, Keys.ENTER)
        expect(name.get_attribute("aria-pressed") == "false", "a curve that was hidden is not said to be")
        expect(image(driver, canvas) != whole, "Enter does not hide a curve")
        send(driver, " ")
        expect(image(driver, canvas) == whole, "a space does not bring a curve back")


def told_of(figure):
    """To who does not see it."""
    return figure.find_element(By.CSS_SELECTOR, "[aria-live]").get_attribute("textContent")


def compare_bits(driver, light, pin):
    """Those that were sent stand above the light; the pin's are marked where they are others."""
    sent, read = ([one["text"] for one in marks(texts(driver, canvas))] for canvas in (light, pin))
    expect(min(len(sent), len(read)) >= FEWEST_BITS and set(sent) <= {"0", "1"}, f"above the light of a byte is {sent}")
    agrees = lambda bits, pin: all(there in (bit, f"[{1 - int(bit)}]") for bit, there in zip(bits, pin))
    expect(agrees(sent, read) or agrees(sent, read[1:]),  # the pin is up to a bit later
           f"of the bits {sent} the pin's are marked as {read}")


def expect_words(trial):
    """Of the colours, and of what is shown after a key."""
    titles = [title.text for title in trial.find_elements(By.CLASS_NAME, "u-title")]
    expect(all("threshold of" not in title or "; thick: threshold of" in title for title in titles),
           f"which curve is the threshold is not said: {titles}")
    told = told_of(trial)
    expect(told.startswith("ms: ") and " to " in told, f"it is told that {told!r} is shown")
    begin, end = (float(word) for word in told[len("ms: "):].split(" to "))
    expect(end - begin > 10, f"from {begin} to {end} ms is a part of no message")


def use_trial(driver, trial):
    """Whatever is done in one of its plots is done in all."""
    canvases = trial.find_elements(By.TAG_NAME, "canvas")
    expect(len(canvases) >= 2, "a trial has no taps")
    for canvas in canvases:
        expect(coloured_pixels(driver, canvas) > FEWEST_PIXELS, "a tap has nothing on it")
    buttons = trial.find_elements(By.XPATH, "preceding-sibling::p[@class='views']/button")
    expect(len(buttons) == 3, "a trial has not three views")
    images = lambda: [image(driver, canvas) for canvas in canvases]
    views = []
    for button in buttons:
        press(driver, button)
        expect(" to " in told_of(trial), "it is not said what a view shows")
        views.append(images())
        if len(views) == 2:
            compare_bits(driver, canvases[0], canvases[-1])
    for one, other in ((0, 1), (1, 2), (0, 2)):
        expect(all(a != b for a, b in zip(views[one], views[other])), "two views are the same")
    enter(driver, trial)
    send(driver, "0")
    expect(images() == views[0], "the key 0 does not show the whole trial")
    send(driver, "+")
    expect_words(trial)
    send(driver, "0")
    plot = trial.find_elements(By.CLASS_NAME, "u-over")[1]
    for act in (lambda: send(driver, "+"),
                lambda: drag_over(driver, plot),
                lambda: (send(driver, "++"), drag_with_shift(driver, plot))):
        act()
        expect(all(a != b for a, b in zip(images(), views[0])), "plots do not zoom together")
        press(driver, buttons[0])
        expect(images() == views[0], "the whole frame does not come back")


def use_pictures(driver):
    charts = driver.find_elements(By.CLASS_NAME, "chart")
    expect(charts, "there is no chart")
    if not has_live_pictures(driver):
        skip_part("browser.charts", "built without uPlot, which npm fetches (Debian: npm), so charts stand still")
        expect(all(chart.find_element(By.TAG_NAME, "svg").is_displayed() for chart in charts),
               "a still picture is not shown")
        return
    for chart in charts:
        use_chart(driver, chart)
        use_legend(driver, chart)
    for trial in driver.find_elements(By.CLASS_NAME, "trial"):
        use_trial(driver, trial)


def main(report, screenshot):
    driver = opened(report)
    use_pictures(driver)
    use_tables(driver)
    driver.execute_script("window.scrollTo(0, 0)")
    save_whole_page(driver, screenshot)
    look_at_layouts(driver)
    expect(driver.execute_script("return performance.getEntriesByType('resource').length") == 0,
           "it loads something")
    look_without_scripts(driver, report)
    expect_no_complaints(driver)
    driver.quit()


main(*sys.argv[1:])
