#!/usr/bin/env python3
"""Opens a report in headless Chromium and uses it as a person would.

Usage: open_report.py REPORT.html SCREENSHOT.png; exits 1 saying what is wrong.
"""
import pathlib
import sys

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

FEWEST_PIXELS = 2000  # axes, labels and a curve have many more


def browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1100,1400"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options)


def expect(condition, what):
    if not condition:
        sys.exit(f"open_report: {what}")


def drawn_pixels(driver, canvas):
    return driver.execute_script(
        """const {width, height} = arguments[0];
           const {data} = arguments[0].getContext('2d').getImageData(0, 0, width, height);
           return data.filter((value, i) => i % 4 === 3 && value > 0).length;""", canvas)


def image(driver, canvas):
    return driver.execute_script("return arguments[0].toDataURL()", canvas)


def drag_over(driver, plot):
    width = plot.size["width"]
    ActionChains(driver).move_to_element_with_offset(plot, -width // 4, 0).click_and_hold() \
        .move_by_offset(width // 3, 0).release().perform()


def use_chart(driver, chart):
    canvas = chart.find_element(By.TAG_NAME, "canvas")
    plot = chart.find_element(By.CLASS_NAME, "u-over")
    expect(drawn_pixels(driver, canvas) > FEWEST_PIXELS, "a chart has nothing on it")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'}); arguments[0].focus()", chart)
    whole = image(driver, canvas)
    for keys, back in (("+", "0"), (Keys.ARROW_RIGHT, "0")):
        ActionChains(driver).send_keys(keys).perform()
        expect(image(driver, canvas) != whole, f"the key {keys!r} does not move a chart")
        ActionChains(driver).send_keys(back).perform()
        expect(image(driver, canvas) == whole, "the key 0 does not show the whole chart again")
    drag_over(driver, plot)
    expect(image(driver, canvas) != whole, "the mouse does not zoom a chart")
    ActionChains(driver).double_click(plot).perform()


def use_trial(driver, trial):
    """Whatever is done in one of its plots is done in all."""
    canvases = trial.find_elements(By.TAG_NAME, "canvas")
    expect(len(canvases) >= 2, "a trial has no taps")
    for canvas in canvases:
        expect(drawn_pixels(driver, canvas) > FEWEST_PIXELS, "a tap has nothing on it")
    buttons = trial.find_elements(By.XPATH, "preceding-sibling::p[@class='views']/button")
    expect(len(buttons) == 3, "a trial has not three views")
    images = lambda: [image(driver, canvas) for canvas in canvases]
    views = []
    for button in buttons:
        driver.execute_script("arguments[0].click()", button)
        views.append(images())
    for one, other in ((0, 1), (1, 2), (0, 2)):
        expect(all(a != b for a, b in zip(views[one], views[other])), "two views are the same")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'}); arguments[0].focus()", trial)
    ActionChains(driver).send_keys("0").perform()
    expect(images() == views[0], "the key 0 does not show the whole trial")
    for act in (lambda: ActionChains(driver).send_keys("+").perform(),
                lambda: drag_over(driver, trial.find_elements(By.CLASS_NAME, "u-over")[1])):
        act()
        expect(all(a != b for a, b in zip(images(), views[0])), "plots do not zoom together")
        driver.execute_script("arguments[0].click()", buttons[0])
        expect(images() == views[0], "the whole frame does not come back")


def column(driver, table, index):
    """Its numbers, or None where one is none."""
    texts = driver.execute_script(
        "return [...arguments[0].tBodies[0].rows].map((row) => row.cells[arguments[1]].textContent)",
        table, index)
    try:
        return [float(text.lstrip("<> ").split()[0]) for text in texts]
    except ValueError:
        return None


def use_table(driver, table):
    buttons = table.find_elements(By.CSS_SELECTOR, "th button")
    indices = [i for i in range(len(buttons)) if column(driver, table, i) is not None]
    expect(indices, "a table has no column of numbers")
    for index in indices:
        before = column(driver, table, index)
        for descending in (False, True):
            driver.execute_script("arguments[0].click()", buttons[index])
            values = column(driver, table, index)
            expect(values == sorted(before, reverse=descending), "a table is not sorted by its column")


def main(report, screenshot):
    driver = browser()
    driver.get(pathlib.Path(report).resolve().as_uri())
    charts = driver.find_elements(By.CLASS_NAME, "chart")
    expect(charts, "there is no chart")
    if driver.execute_script("return typeof uPlot === 'undefined'"):
        print("built without uPlot: charts stand still")
        expect(all(chart.find_element(By.TAG_NAME, "svg").is_displayed() for chart in charts),
               "a still picture is not shown")
    else:
        for chart in charts:
            use_chart(driver, chart)
        for trial in driver.find_elements(By.CLASS_NAME, "trial"):
            use_trial(driver, trial)
    tables = driver.find_elements(By.CSS_SELECTOR, "table.numbers")
    expect(tables, "there is no table of numbers")
    for table in tables:
        use_table(driver, table)
    expect(driver.execute_script("return performance.getEntriesByType('resource').length") == 0,
           "it loads something")
    wrong = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    expect(not wrong, f"the browser complains: {wrong}")
    driver.execute_script("window.scrollTo(0, 0)")
    driver.save_screenshot(screenshot)
    driver.quit()


main(*sys.argv[1:])
