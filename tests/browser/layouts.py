"""A report on paper, in the dark, in a narrow window, and for who does not see it."""
import pathlib
import re

from browser import expect

NARROW = 390    # pixels
A4 = 680        # ... within margins of 15 mm
LEAST_CONTRAST = 4.5  # of letters (WCAG 2.2, 1.4.3)
LEAST_TEXT = 8  # ... of a still picture's letters
SCROLLING = ".table, .still, pre"

IS_SHOWN = "(element) => element.checkVisibility() && element.getClientRects().length > 0"


def shown(driver, selector):
    """How many are, of how many."""
    return driver.execute_script(
        f"""const all = [...document.querySelectorAll(arguments[0])], isShown = {IS_SHOWN};
            return [all.filter(isShown).length, all.length];""", selector)


def set_media(driver, medium, scheme):
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "media": medium, "features": [{"name": "prefers-color-scheme", "value": scheme}]})


def set_width(driver, width):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 1400, "deviceScaleFactor": 1, "mobile": False})
    driver.execute_async_script(  # charts follow when the page is next drawn
        "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()));")


def channels(driver, selector, name):
    """Red, green and blue of a colour that is used."""
    colour = driver.execute_script(
        "return getComputedStyle(document.querySelector(arguments[0]))[arguments[1]]", selector, name)
    return [float(part) for part in colour[colour.index("(") + 1:-1].split(",")][:3]


def expect_nothing_wide(driver, width, scrolling):
    """Nothing reaches beyond the window but what is in a box that scrolls."""
    wide = driver.execute_script(
        f"""const isShown = {IS_SHOWN};
            return [...document.querySelectorAll('body *')].filter((element) =>
              isShown(element) && element.getBoundingClientRect().right > arguments[0] + 1 &&
              !(arguments[1] && element.closest(arguments[1]) !== element && element.closest(arguments[1])))
              .map((element) => element.outerHTML.slice(0, 200));""", width, scrolling)
    page = driver.execute_script("return document.documentElement.scrollWidth")
    expect(page <= width, f"the page is {page} pixels wide in a window of {width}")
    expect(not wide, f"at {width} pixels there is more than fits: {wide[:2]}")


def open_tables(driver, are_open):
    driver.execute_script(
        "document.querySelectorAll('details').forEach((one) => { one.open = arguments[0]; })", are_open)


def expect_heads_apart(driver):
    cut = driver.execute_script(
        """return [...document.querySelectorAll('table.numbers th')].filter((head) =>
             head.scrollWidth > head.clientWidth + 1).map((head) => head.textContent)""")
    expect(not cut, f"heads of tables reach into their neighbours: {cut}")


def expect_scenario_last(driver):
    """It is printed open."""
    headings = driver.execute_script(
        "return [...document.querySelectorAll('section > h2')].map((heading) => heading.textContent)")
    expect(headings[-1].endswith("The scenario"), f"behind the scenario comes more: {headings}")
    driver.execute_script("window.dispatchEvent(new Event('beforeprint'))")
    expect(shown(driver, "pre")[0] > 0, "the scenario is printed closed")


def look_at_paper(driver):
    expect_scenario_last(driver)
    open_tables(driver, False)
    set_media(driver, "print", "dark")
    set_width(driver, A4)
    for selector in ("canvas", ".copy", ".views", ".hint", "nav"):
        expect(shown(driver, selector)[0] == 0, f"{selector} is printed")
    stills = shown(driver, ".still")
    expect(stills[0] == stills[1], f"of {stills[1]} still pictures {stills[0]} are printed")
    rows = shown(driver, "section:not(:has(figure)) table.numbers tr")
    expect(rows[0] == rows[1] > 0, f"of {rows[1]} rows of the numbers {rows[0]} are printed")
    open_tables(driver, True)
    expect_nothing_wide(driver, A4, "")
    expect_heads_apart(driver)
    for selector in ("body", "svg"):
        expect(min(channels(driver, selector, "backgroundColor")) > 250, f"{selector} is printed dark")
        expect(max(channels(driver, selector, "color")) < 50, f"text of {selector} is printed faint")


def faint_texts(driver):
    """Letters whose luminance is too near to that of what is behind them, a text of each kind."""
    return driver.execute_script(
        f"""const isShown = {IS_SHOWN};
            const parts = (colour) => colour.match(/[\\d.]+/g).map(Number);
            const linear = (part) => part <= 0.04045 * 255 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4;
            const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
            const paperOf = (element) => {{
              for (let one = element; one; one = one.parentElement) {{
                const colour = parts(getComputedStyle(one).backgroundColor);
                if (colour.length < 4 || colour[3] > 0) return colour;
              }}
              return [255, 255, 255];
            }};
            const hasText = (element) => [...element.childNodes].some(
              (node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
            const faint = new Map();
            for (const element of document.querySelectorAll('body *')) {{
              if (!isShown(element) || !hasText(element) || element.closest('script, style, title, desc')) continue;
              const style = getComputedStyle(element), isDrawn = element.closest('svg') !== null;
              const ink = parts(isDrawn ? style.fill : style.color), paper = paperOf(element);
              const [dark, light] = [luminance(ink), luminance(paper)].sort((one, other) => one - other);
              const contrast = (light + 0.05) / (dark + 0.05);
              if (contrast < arguments[0]) faint.set(`${{element.tagName}} ${{ink}} on ${{paper}}`,
                                                     `${{contrast.toFixed(2)}}: ${{element.outerHTML.slice(0, 120)}}`);
            }}
            return [...faint.values()];""", LEAST_CONTRAST)


def look_in_the_dark(driver):
    for scheme, is_dark in (("dark", True), ("light", False)):
        set_media(driver, "", scheme)
        for selector in ("body", "svg"):
            paper, ink = (sum(channels(driver, selector, name)) / 3 for name in ("backgroundColor", "color"))
            expect(paper < 60 < 200 < ink if is_dark else ink < 60 < 200 < paper,
                   f"{selector} has ink {ink} on paper {paper} where it is to be {scheme}")
        faint = faint_texts(driver)
        expect(not faint, f"these texts are faint where it is {scheme}: {faint}")


def look_narrowly(driver):
    set_width(driver, NARROW)
    expect_nothing_wide(driver, NARROW, SCROLLING)
    boxes = driver.execute_script(
        """return [...document.querySelectorAll(arguments[0])].filter((box) => box.scrollWidth > box.clientWidth)
             .map((box) => box.tabIndex);""", SCROLLING)
    expect(boxes and all(index == 0 for index in boxes), f"no keyboard reaches what scrolls: {boxes}")


def look_without_scripts(driver, report):
    """The still pictures alone, in a narrow window."""
    still = pathlib.Path(report).with_name("still.html")
    still.write_text(re.sub("<script.*?</script>", "", pathlib.Path(report).read_text(), flags=re.DOTALL))
    driver.get(still.resolve().as_uri())
    expect_nothing_wide(driver, NARROW, SCROLLING)
    stills = shown(driver, ".still")
    expect(stills[0] == stills[1] > 0, f"of {stills[1]} still pictures {stills[0]} are seen")
    least = driver.execute_script(
        """return Math.min(...[...document.querySelectorAll('.still text')].map((text) =>
             parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a));""")
    expect(least >= LEAST_TEXT, f"text of a picture is {least} pixels high")


def expect_names(driver):
    expect(driver.execute_script("return document.documentElement.lang") == "en", "it has no language")
    levels = driver.execute_script("return [...document.querySelectorAll('h1, h2, h3, h4')].map((h) => +h.tagName[1])")
    expect(levels[0] == 1 and levels.count(1) == 1 and
           all(after <= before + 1 for before, after in zip(levels, levels[1:])),
           f"headings are not in order: {levels}")
    unnamed = driver.execute_script(
        """return [...document.querySelectorAll('.live, table.numbers')].filter((element) =>
             !element.getAttribute('aria-label')).map((element) => element.outerHTML.slice(0, 200))""")
    expect(not unnamed, f"these have no name: {unnamed}")
    spoken = driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
    roles = [node["role"]["value"] for node in spoken if not node["ignored"]]
    expect("button" in roles and "image" in roles, f"a screen reader finds {set(roles)} alone")
    nameless = [node for node in spoken if not node["ignored"] and not node["name"]["value"] and
                node["role"]["value"] in ("button", "image", "region")]
    expect(not nameless, f"a screen reader has no name for {nameless[:2]}")


def expect_contents(driver):
    """Links that lead to all sections, each by its heading."""
    links, headings = driver.execute_script(
        """const headingOf = (link) => document.querySelector(link.getAttribute('href') + ' > h2').textContent;
           return [[...document.querySelectorAll('nav a')].map((link) => [link.textContent, headingOf(link)]),
                   [...document.querySelectorAll('h2')].map((heading) => heading.textContent)];""")
    expect(links == [[heading, heading] for heading in headings], f"the contents are {links}, the headings {headings}")


def expect_focus_is_seen(driver):
    unseen = driver.execute_script(
        """return [...document.querySelectorAll('.live, button, summary')].filter((element) => {
             element.focus({focusVisible: true});
             const {outlineStyle, outlineWidth} = getComputedStyle(element);
             return element.checkVisibility() && (document.activeElement !== element || outlineStyle === 'none' ||
                                                  parseFloat(outlineWidth) < 2);
           }).map((element) => element.outerHTML.slice(0, 200));""")
    expect(not unseen, f"it is not seen that the keyboard is here: {unseen}")


def look_at_layouts(driver):
    expect_names(driver)
    expect_contents(driver)
    expect_focus_is_seen(driver)
    look_at_paper(driver)
    look_in_the_dark(driver)
    look_narrowly(driver)
