"""Headless Chromium, as a person uses it, for the scripts beside."""
import base64
import pathlib
import subprocess
import sys

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from texts import record_texts


def opened(report):
    """A browser with a report in it."""
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1100,1400"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options)
    record_texts(driver)
    driver.get(pathlib.Path(report).resolve().as_uri())
    return driver


# In the colour of the first curve, #d55e00.
INK = """const [canvas, over] = arguments;
  const left = over ? over.offsetLeft : 0, top = over ? over.offsetTop : 0;
  const width = over ? over.clientWidth : canvas.width, height = over ? over.clientHeight : canvas.height;
  const {data} = canvas.getContext('2d').getImageData(left, top, width, height);
  return Array.from({length: width}, (_, x) => {
    let ends = null;
    for (let y = 0; y < height; ++y) {
      const i = 4 * (y * width + x);
      const isInk = data[i + 3] > 100 && data[i] > 170 && Math.abs(data[i + 1] - 94) < 30 && data[i + 2] < 60;
      if (isInk) ends = ends ? [ends[0], y] : [y, y];
    }
    return ends;
  });"""


def curve_ink(driver, canvas, over=None):
    """Of the first curve, the rows of ink in each column of a canvas, or of a plot on it: [least, greatest] or None."""
    return driver.execute_script(INK, canvas, over)


def has_live_pictures(driver):
    return driver.execute_script("return typeof uPlot !== 'undefined'")


def skip_part(name, reason):
    """The rest of a test goes on without this part, or ends as failed in the gate (skip.sh)."""
    script = pathlib.Path(__file__).parent.parent / "skip.sh"
    if subprocess.run([script, name, reason], check=False).returncode == 1:
        sys.exit(f"{name} is skipped: {reason}")


def expect(condition, what):
    if not condition:
        sys.exit(f"{pathlib.Path(sys.argv[0]).stem}: {what}")


def press(driver, button):
    """Also where it is not seen at the moment."""
    driver.execute_script("arguments[0].click()", button)


def actions(driver):
    """A mouse takes a moment for a way, but not the usual quarter of a second."""
    return ActionChains(driver, duration=20)


def send(driver, *keys):
    actions(driver).send_keys(*keys).perform()


def send_with_control(driver, key):
    actions(driver).key_down(Keys.CONTROL).send_keys(key).key_up(Keys.CONTROL).perform()


def enter(driver, element):
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'}); arguments[0].focus()", element)


def image(driver, canvas):
    return driver.execute_script("return arguments[0].toDataURL()", canvas)


def drag_over(driver, plot):
    width = plot.size["width"]
    actions(driver).move_to_element_with_offset(plot, -width // 4, 0).click_and_hold() \
        .move_by_offset(width // 3, 0).release().perform()


def drag_with_shift(driver, plot):
    width = plot.size["width"]
    actions(driver).move_to_element_with_offset(plot, width // 4, 0).key_down(Keys.SHIFT).click_and_hold() \
        .move_by_offset(-width // 8, 0).release().key_up(Keys.SHIFT).perform()


def save_whole_page(driver, screenshot):
    """Also what is below the window."""
    size = driver.execute_cdp_cmd("Page.getLayoutMetrics", {})["cssContentSize"]
    png = driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": {**size, "scale": 1}})
    pathlib.Path(screenshot).write_bytes(base64.b64decode(png["data"]))


def expect_no_complaints(driver):
    wrong = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    expect(not wrong, f"the browser complains: {wrong}")
