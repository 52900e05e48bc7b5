#!/usr/bin/env python3
"""What a report's content policy keeps from being executed, each beside a page without that policy, where it must be.

Usage: policy.py REPORT.html SCREENSHOT.png
"""
import pathlib
import re
import sys
import time

from browser import expect, expect_no_complaints, has_live_pictures, opened

POLICY = re.compile('<meta http-equiv="Content-Security-Policy"[^>]*>')
PATIENCE_S = 10

# What somebody might get into a page, which then says so in its title.
INJECTED = {
    "script element": "<script>document.title = 'executed'</script>",
    "script from elsewhere": """<script src="data:text/javascript,document.title='executed'"></script>""",
    "handler": """<img src="nowhere" onerror="document.title = 'executed'">""",
    "picture from elsewhere": """<img src="data:image/gif;base64,R0lGODlhAQABAAAAACwAAAAAAQABAAACAkQBADs="
                                 id="loaded">""",
}
LOADED = "const one = document.getElementById('loaded'); return one !== null && one.naturalWidth > 0"


def is_executed(driver):
    return driver.title == "executed" or driver.execute_script(LOADED)


def waits_to_be_executed(driver):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end and not is_executed(driver):
        time.sleep(0.05)
    return is_executed(driver)


def open_with(driver, page, html, injected):
    """The page with something more in it, fully loaded."""
    page.write_text(html.replace("<main>", "<main>" + injected, 1), encoding="utf-8")
    driver.get(page.as_uri())


def main():
    report = pathlib.Path(sys.argv[1]).resolve()
    html = report.read_text(encoding="utf-8")
    without = POLICY.sub("", html)
    expect(without != html, "a report has no content policy")
    driver = opened(report)
    try:
        expect_no_complaints(driver)
        expect(has_live_pictures(driver) or "uPlot" not in html, "the policy stops the page's own scripts")
        page = report.with_name("injected.html")
        for name, injected in INJECTED.items():
            open_with(driver, page, without, injected)
            expect(waits_to_be_executed(driver), f"without a policy the {name} does nothing: it shows nothing here")
            open_with(driver, page, html, injected)
            expect(not is_executed(driver), f"a {name} got through the policy")
    finally:
        driver.quit()


main()
