# SPDX-License-Identifier: MIT
import math

import pytest
from tricue.evaluation import tables
from tricue.evaluation.report.sequences import MAX_PICTURED

PHONE, DESK = 375, 1280
OPEN_ALL = "document.querySelectorAll('details').forEach(each => each.open = true)"


@pytest.fixture(scope="module", params=[PHONE, DESK], ids=["phone", "desk"])
def page(request, chromium, report):
    """The report in a window of a phone's and of a desk's width, everything unfolded."""
    page = chromium.open(report, request.param)
    page.evaluate(OPEN_ALL)
    return page


def test_console_is_empty(page):
    """The console stays empty: no error, no warning, nothing blocked by the page's own policy."""
    page.evaluate("new Promise(done => setTimeout(done, 200))")
    assert page.events("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded") == []
    assert page.events("Network.loadingFailed") == []
    assert page.events("Page.javascriptDialogOpening") == []


def test_nothing_is_loaded(page, report):
    """The file itself is the only request."""
    addresses = [each["request"]["url"] for each in page.events("Network.requestWillBeSent")]
    assert [each for each in addresses if not each.startswith("data:")] == [report.as_uri()]


def test_the_page_does_not_scroll_sideways(page):
    """Wide tables and filmstrips scroll in their own frames; all else ends inside the window."""
    wide = page.evaluate("[document.documentElement.scrollWidth, window.innerWidth]")
    assert wide[0] <= wide[1]
    assert wide[1] in (PHONE, DESK)
    outside = """[...document.querySelectorAll('main *')].filter(each =>
        !each.closest('.scroll, .film, svg') && each.getBoundingClientRect().right > innerWidth + 0.5
    ).map(each => each.outerHTML.slice(0, 200))"""
    assert page.evaluate(outside) == []


def test_letters_are_large_enough_to_read(page):
    """No text is smaller than 10 px on a phone, 11 px on a desk; in plots letters grow with the plot."""
    script = """Math.min(...[...document.querySelectorAll('main *')].filter(
        each => [...each.childNodes].some(child => child.nodeType === 3 && child.data.trim())
            && each.checkVisibility()
    ).map(each => parseFloat(getComputedStyle(each).fontSize)
        * (each.closest('svg') ? each.closest('svg').getScreenCTM().a : 1)))"""
    assert page.evaluate(script) >= (10 if page.evaluate("innerWidth") == PHONE else 11)


def test_every_picture_is_decoded(page, evaluation):
    """Timelines, filmstrips and plots are there: all images have a size, each sequence has its filmstrip."""
    sizes = page.evaluate(
        "Promise.all([...document.images].map(each => each.decode().then(() => each.naturalWidth)))"
    )
    assert min(sizes) > 0
    assert page.evaluate("document.querySelectorAll('.film').length") == len(evaluation.opened) < MAX_PICTURED
    assert page.evaluate("document.querySelectorAll('.still img').length") >= 3 * len(evaluation.opened)
    assert page.evaluate("[...document.images].every(each => each.alt)")
    groups = len(evaluation.groups)
    assert page.evaluate("document.querySelectorAll('svg.plot path').length") > 20 * groups
    assert page.evaluate("document.querySelectorAll('svg.plot').length") == 6 * groups


def test_tables_hold_the_numbers_of_the_summary(page, evaluation):
    """Every number in a table is that of summary.csv or the speeds, rounded; NaN is a dash."""
    cells = page.evaluate("""[...document.querySelectorAll('table.sortable')].map(table =>
        [...table.tBodies[0].rows].map(row => [
            row.cells[0].querySelector('.who').innerText,
            ...[...row.cells].slice(1).map(cell => [cell.innerText, cell.dataset.value ?? ''])]))""")
    heads = page.evaluate("""[...document.querySelectorAll('table.sortable')].map(table =>
        [...table.tHead.rows[0].cells].slice(1).map(head => head.innerText.slice(0, -1).trim()))""")
    keys = {"AUC": "auc", "P20": "precision", "AUROC": "auroc", "TNR": "true_negative", "frames/s": "fps",
            "failures": "failures", "accuracy": "accuracy", "mean IoU": "iou", "F": "f_score"}  # fmt: skip
    both = zip(tables.summary(evaluation), tables.speeds(evaluation), strict=True)
    lines = [{**line, **speed} for line, speed in both]
    shown = [(table, head) for table, head in zip(cells, heads, strict=True)]
    assert [row[0] for table, _ in shown for row in table] == [line["tracker"] for line in lines]
    rows = [(row[1:], head) for table, head in shown for row in table]
    checked = 0
    for (row, head), line in zip(rows, lines, strict=True):
        for (text, value), name in zip(row, head, strict=True):
            if name in keys:
                true = line[keys[name]]
                checked += 1
                assert (value == "" and text == "\N{EN DASH}") if math.isnan(true) else float(value) == true
                assert math.isnan(true) or abs(float(text.replace(",", "")) - true) <= 0.5
    assert checked > 30


def test_names_from_outside_are_text(page, hostile):
    """A sequence named like a script is shown as it is named, and adds no element."""
    names = page.evaluate("[...document.querySelectorAll('.sequence .name')].map(each => each.textContent)")
    assert hostile in names
    assert page.evaluate("document.scripts.length") == 1


def test_violations_would_be_noticed(chromium, report, tmp_path):
    """What the tests above look for is noticed: an error, a script, a foreign image, a broken one, width."""
    bad = (
        "<p style='width: 2000px'>wide</p><script>console.error(1)</script>"
        "<img src='http://localhost:1/a.png' alt=''><img src='data:image/png;base64,AAAA' alt=''>"
    )
    place = tmp_path / "bad.html"
    place.write_text(report.read_text(encoding="utf-8").replace("<main>", f"<main>{bad}"), encoding="utf-8")
    page = chromium.open(place, PHONE)
    refused = [each["entry"]["text"] for each in page.events("Log.entryAdded")]
    assert any("script" in text for text in refused)
    assert any("a.png" in text for text in refused)
    assert page.evaluate("document.documentElement.scrollWidth") > PHONE
    assert page.evaluate("[...document.images].some(each => each.naturalWidth === 0)")
    page.evaluate("console.error('late error')")
    page.evaluate("setTimeout(() => { throw new Error('late') })")
    page.evaluate("new Promise(done => setTimeout(done, 50))")
    assert page.events("Runtime.consoleAPICalled")
    assert page.events("Runtime.exceptionThrown")


def test_a_click_on_a_heading_sorts(chromium, report):
    """The best come first, then the worst; where there is no number it stays last."""
    page = chromium.open(report, DESK)
    table = "document.querySelector('table.sortable')"
    column = f"[...{table}.tBodies[0].rows].map(row => row.cells[1].dataset.value ?? null)"
    click = f"{table}.tHead.rows[0].cells[1].querySelector('button').click()"
    before = page.evaluate(column)
    page.evaluate(click)
    falling = page.evaluate(column)
    assert falling == sorted(before, key=float, reverse=True)
    page.evaluate(click)
    assert page.evaluate(column) == falling[::-1]
    assert page.evaluate(f"{table}.tHead.rows[0].cells[1].ariaSort") == "ascending"


LOW_CONTRAST = """(() => {
      const parts = color => color.match(/[\\d.]+/g).map(Number);
      const light = ([r, g, b]) => [r, g, b].map(c => c / 255).map(
        c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4
      ).reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
      const ground = each => {
        for (; each; each = each.parentElement) {
          const color = parts(getComputedStyle(each).backgroundColor);
          if (color.length < 4 || color[3] === 1) return color;
        }
        return [255, 255, 255];
      };
      return [...document.querySelectorAll('main *')].filter(each => !each.closest('svg')
        && [...each.childNodes].some(child => child.nodeType === 3 && child.data.trim())
      ).filter(each => {
        const [a, b] = [light(parts(getComputedStyle(each).color)), light(ground(each))];
        return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5;
      }).map(each => each.outerHTML.slice(0, 100));
    })()"""


def test_text_has_contrast(page):
    """Text on its background has a contrast of 4.5 or more (WCAG AA), but inside pictures and plots."""
    assert page.evaluate(LOW_CONTRAST) == []


def test_text_has_contrast_in_the_dark(chromium, report):
    """The same where the browser is dark, and the page is, too."""
    page = chromium.open(report, DESK)
    dark = {"name": "prefers-color-scheme", "value": "dark"}
    page.call("Emulation.setEmulatedMedia", features=[dark])
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(23, 27, 33)"
    assert page.evaluate(LOW_CONTRAST) == []
