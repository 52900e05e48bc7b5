"""Tables of a report: sorted by their heads, copied as CSV in whatever way the browser allows."""
import csv
import io
import re

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import enter, expect, send, send_with_control

AWKWARD = ['"one"', "two, three", "four\nfive"]  # what CSV must quote, each by itself


def cells(driver, table):
    return driver.execute_script(
        "return [...arguments[0].rows].map((row) => [...row.cells].map((cell) => cell.textContent))", table)


def numbers(texts):
    """Of the cells of a column: whether they are more than a bound first, and None for each that is no number."""
    number = re.compile(r"(?:[<>]|between|below|above|beyond|short of)?\s*(-?\d[\d.]*(?:e[+-]?\d+)?)")
    return [(not text.startswith("<"), float(found[1])) if (found := number.match(text)) else None for text in texts]


def press_head(driver, table, index):
    """Gives what the column below is then."""
    return driver.execute_script(
        """const [table, index] = arguments;
           table.querySelectorAll('th button')[index].click();
           return [...table.rows].slice(1).map((row) => row.cells[index].textContent);""", table, index)


def expect_sorted(driver, table, index, before):
    """By a press upward, by another downward; what is no number stays last."""
    sortable = [one for one in before if one]
    for descending in (False, True):
        values = numbers(press_head(driver, table, index))
        expect(values == sorted(sortable, reverse=descending) + [None] * (len(before) - len(sortable)),
               f"a table is not sorted by its column: {values}")


def sort_columns(driver, table):
    """Ends with one in descending order."""
    columns = [numbers(texts[1:]) for texts in zip(*cells(driver, table))]
    expect(any(map(any, columns)), "a table has no column of numbers")
    for index, column in enumerate(columns):
        if any(column):
            expect_sorted(driver, table, index, column)


def sort_words(driver, table):
    """As the places where loss passes 1 % are written."""
    words = ["between 10 and 11 m", "9.2 m", "-", "beyond 64", "between 2.15 and 2.2 m", "< 0.1", "short of 0.5",
             "below 8 m: too few frames", "above 3 m"]
    driver.execute_script(
        """const [table, words] = arguments, body = table.tBodies[0], row = body.rows[0];
           body.replaceChildren(...words.map((text) => {
             const copy = row.cloneNode(true);
             copy.cells[0].textContent = text;
             return copy;
           }));""", table, words)
    expect_sorted(driver, table, 0, numbers(words))


def set_clipboard(driver, setting):
    for name in ("clipboard-read", "clipboard-write"):
        driver.execute_cdp_cmd("Browser.setPermission", {"permission": {"name": name}, "setting": setting})


def clipboard(driver):
    """What lies there, in the way of a person who pastes."""
    set_clipboard(driver, "granted")
    return driver.execute_async_script(
        "delete navigator.clipboard; navigator.clipboard.readText().then(arguments[0])")


def forget(driver):
    set_clipboard(driver, "granted")
    driver.execute_async_script("navigator.clipboard.writeText('').then(arguments[0])")


def press_copy(driver, table):
    """What the page then says of it."""
    line = table.find_element(By.XPATH, "ancestor::details/div[@class='copy']")
    driver.execute_script("arguments[0].closest('details').open = true", line)
    button = line.find_element(By.TAG_NAME, "button")
    enter(driver, button)
    send(driver, Keys.ENTER)
    told = line.find_element(By.CSS_SELECTOR, "[aria-live=polite]")
    return driver.execute_async_script(
        """const look = () => (arguments[0].textContent ? arguments[1](arguments[0].textContent) : setTimeout(look, 5));
           look();""", told)


def as_columns(rows):
    """Rows of a table with three columns for each of estimates, as they are copied."""
    def parts(cell):
        interval = re.fullmatch(r"(\S+) \[(\S+), (\S+)\]", cell)
        if interval:
            return list(interval.groups())
        return ["0", "0", cell[2:]] if re.fullmatch(r"< [0-9.e+-]+", cell) else None

    columns = []
    for head, *cells_below in zip(*rows):
        if any(map(parts, cells_below)):
            columns += zip(*([head, head + " low", head + " high"],
                             *(parts(cell) or [cell, "", ""] for cell in cells_below)))
        else:
            columns.append((head, *cells_below))
    return [list(row) for row in zip(*columns)]


def expect_copied(driver, table, how):
    expected = as_columns(cells(driver, table))
    text = clipboard(driver)
    expect(list(csv.reader(io.StringIO(text, newline=""))) == expected, f"{how}, CSV is not the table: {text!r}")
    expect(text.count("\r\n") == len(expected), f"{how}, lines of CSV do not end in CR LF: {text!r}")


def copy(driver, table, how):
    told = press_copy(driver, table)
    expect(told == f"Copied, rows: {len(cells(driver, table)) - 1}", f"{how}, the page says {told!r}")
    expect(not table.find_elements(By.XPATH, "ancestor::details//textarea"), f"{how}, the text is left over")
    expect_copied(driver, table, how)


def copy_by_hand(driver, table):
    told = press_copy(driver, table)
    expect("Ctrl+C" in told, f"where nothing copies, the page says {told!r}")
    driver.execute_script("delete document.execCommand")
    send_with_control(driver, "c")
    rows = list(csv.reader(io.StringIO(clipboard(driver), newline="")))
    expect(rows == as_columns(cells(driver, table)), f"what is selected to be copied is not the table: {rows}")


def copy_in_all_ways(driver, table):
    driver.execute_script(
        "arguments[1].forEach((text, i) => { arguments[0].tBodies[0].rows[0].cells[i].textContent = text; })",
        table, AWKWARD)
    copy(driver, table, "by the clipboard")
    forget(driver)
    set_clipboard(driver, "denied")
    copy(driver, table, "where the clipboard is refused")
    forget(driver)
    driver.execute_script("Object.defineProperty(navigator, 'clipboard', {value: undefined, configurable: true})")
    copy(driver, table, "without a clipboard")
    forget(driver)
    driver.execute_script("""navigator.clipboard.writeText = () => Promise.reject(new Error('refused'));
        document.execCommand = () => false""")
    copy_by_hand(driver, table)


def use_tables(driver):
    tables = driver.find_elements(By.CSS_SELECTOR, "table.numbers")
    expect(tables, "there is no table of numbers")
    for table in tables:
        sort_columns(driver, table)
    copy_in_all_ways(driver, tables[-1])
    sort_words(driver, tables[0])
