"""The report in a real browser: the mesh can be rotated, cut and coloured, and no network is used."""

import re
from dataclasses import replace

import numpy as np
import pytest

from hexmend.quality import METRICS, measure, rank_worst
from hexmend_app.picture import Page, Scene
from hexmend_app.report.figure_set import Style
from hexmend_app.report.page import draw_chapter, page, write_report
from hexmend_app.scene.render.colour_count import count_colours

pytestmark = pytest.mark.slow

STYLE = Style(Scene(page=Page(dpi=72)))


def chapter(*args, **options):
    """Return a chapter of a report."""
    steps = draw_chapter(*args, **options)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


@pytest.fixture(scope="module")
def written(case, tmp_path_factory):
    from hexmend_app.scene.render.graphics import prepare_off_screen

    prepare_off_screen()
    path = tmp_path_factory.mktemp("report") / "report.html"
    write_report(
        path,
        page("Report", [chapter(case, STYLE, interactive=True)], "hexmend report", interactive=True),
    )
    return path


@pytest.fixture(scope="module")
def report(browser, written):
    with browser() as opened:
        opened.open(written)
        yield opened


@pytest.fixture
def fresh(report):
    """The opened page."""
    report.control("reset").click()
    report.drawn()
    return report


def colours(picture):
    """Return the number of distinguishable colours."""
    return len(count_colours(pixels(picture) // 16)[0])


def share(picture, red, green, blue, near=40):
    """Return the share of a picture with nearly this colour."""
    return float((np.abs(pixels(picture).astype(int) - (red, green, blue)).max(axis=1) < near).mean())


def pixels(picture):
    return np.frombuffer(picture, np.uint8).reshape(-1, 3)


@pytest.mark.slow
def test_it_opens_without_errors_or_requests(fresh, written):
    assert colours(fresh.canvas()) > 20
    assert fresh.complaints == []
    assert fresh.asked == [written.as_uri()]


@pytest.mark.parametrize(("act", "control", "value"), [
    ("select_option", "axis", "1"), ("select_option", "metric", "Scaled Jacobian"), ("select_option", "map", "inferno"),
    ("fill", "between", "0"), ("fill", "between", "0.4"), ("fill", "low", "0.8"), ("fill", "high", "0.6"),
])  # fmt: skip
def test_a_control_changes_the_picture(fresh, act, control, value):
    fresh.control("method").select_option("mend")
    before = fresh.canvas()
    getattr(fresh.control(control), act)(value)
    assert fresh.canvas() != before


def test_reset_restores_the_first_picture(fresh):
    first = fresh.canvas()
    fresh.control("axis").select_option("0")
    fresh.control("metric").select_option("Skew")
    fresh.page.get_by_role("button", name="X", exact=True).click()
    assert fresh.canvas() != first
    fresh.control("reset").click()
    fresh.page.mouse.move(0, 0)
    assert fresh.canvas() == first


@pytest.mark.slow
def test_mouse_and_keys_rotate_the_mesh(fresh):
    seen = {fresh.canvas()}
    box = fresh.control("canvas").bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    for button in ("left", "right"):
        fresh.page.mouse.move(*middle)
        fresh.page.mouse.down(button=button)
        fresh.page.mouse.move(middle[0] + 60, middle[1] + 20, steps=3)
        fresh.page.mouse.up(button=button)
        seen.add(fresh.canvas())
    fresh.control("canvas").focus()
    keys = ("ArrowLeft", "ArrowUp", "+", "Shift+ArrowDown", "Shift+ArrowLeft", "x", "y", "z")
    for key in keys:
        fresh.page.keyboard.press(key)
        seen.add(fresh.canvas())
    fresh.page.keyboard.press("Enter")
    assert fresh.text("told").startswith("Hex ")
    fresh.page.mouse.move(*middle)
    fresh.page.mouse.wheel(0, 200)
    seen.add(fresh.canvas())
    assert len(seen) == 4 + len(keys)


def test_more_hexes_are_inverted_before_than_after(fresh):
    """Inverted hexes are magenta: there are some before the run and none after."""
    magenta = 231, 25, 138
    assert fresh.control("between").input_value() == "0"  # the page opens on the mesh before the run
    fresh.control("method").select_option("mend")
    fresh.control("high").fill("0.5")  # what lies inside is seen
    after = share(fresh.canvas(), *magenta)
    fresh.control("between").fill("0")
    assert share(fresh.canvas(), *magenta) > 0.02 > after


def test_a_click_shows_the_hex_and_its_values(fresh, case):
    fresh.control("method").select_option("mend")
    fresh.control("axis").select_option("1")
    fresh.drawn()
    box = fresh.control("canvas").bounding_box()
    fresh.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    number, before, after = re.search(
        r"Hex ([\d,]+) – .*?q\(H\) ([\d.]+).*q\(H\) ([\d.]+)", fresh.text("told")
    ).groups()
    hex = int(number.replace(",", ""))
    for version, said in ((case.versions[0], before), (case.versions[-1], after)):
        assert float(said) == pytest.approx(measure(version.mesh.points, version.mesh.hexes).q[hex], abs=1e-4)


def test_the_table_links_to_the_worst_hexes(fresh, case):
    hex = int(rank_worst(case.initial.quality.q, case.initial.quality, 1)[0])
    before = fresh.canvas()
    fresh.page.locator('[data-version="0"] button').first.click()
    assert fresh.text("told").startswith(f"Hex {hex:,} – initial: q(H) ")
    assert fresh.text("moment") == "initial"
    assert fresh.text("count").startswith("1 of")
    assert fresh.canvas() != before
    fresh.control("axis").select_option("0")
    assert not fresh.text("count").startswith("1 of")


def test_it_counts_visible_hexes(fresh, case):
    first, mended = case.versions[0], case.versions[-1]
    fresh.control("method").select_option("mend")
    fresh.control("high").fill("0.7")
    assert fresh.text("count") == f"{int((mended.quality.q <= 0.7).sum()):,} of {first.mesh.n_hexes:,} hexes"
    fresh.control("between").fill("0")
    apart = first.quality.invalid
    assert fresh.text("count").startswith(f"{int((apart | (first.quality.q <= 0.7)).sum()):,} of")
    fresh.control("invalid").uncheck()
    assert fresh.text("count").startswith(f"{int((~apart & (first.quality.q <= 0.7)).sum()):,} of")


@pytest.mark.slow
def test_touch_rotates_and_zooms(browser, written):
    with browser(has_touch=True) as opened:
        opened.open(written)
        seen = {opened.canvas()}
        tell = opened.page.context.new_cdp_session(opened.page)
        box = opened.control("canvas").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        for fingers in ([[(x, y)], [(x + 60, y)]], [[(x - 30, y), (x + 30, y)], [(x - 90, y), (x + 90, y)]]):
            for kind, places in zip(("touchStart", "touchMove"), fingers, strict=True):
                points = [{"x": px, "y": py, "id": k} for k, (px, py) in enumerate(places)]
                tell.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
            tell.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
            seen.add(opened.canvas())
        assert len(seen) == 3


@pytest.mark.slow
def test_without_webgl_the_picture_is_shown_instead(browser, written):
    with browser(("--disable-3d-apis",)) as opened:
        opened.open(written, alive=False)
        assert "cannot be rotated here: WebGL 2 is not available" in opened.page.locator(".viewer .cannot").inner_text()
        assert opened.page.locator(".viewer > figure img").is_visible()
        assert not opened.control("canvas").is_visible()


@pytest.mark.slow
def test_the_contents_link_to_all_sections(browser, case, tmp_path):
    path = tmp_path / "report.html"
    told = [chapter(case, STYLE, interactive=False, place=place) for place in ("mesh-1", "mesh-2")]
    write_report(path, page("Two", told, "hexmend report", interactive=False))
    with browser() as opened:
        opened.page.goto(path.as_uri())
        links = opened.page.locator("nav a")
        places = [links.nth(k).get_attribute("href") for k in range(links.count())]
        assert len(places) == len(set(places)) == 2 + 2 * len(told[0].sections)
        assert all(opened.page.locator(place).count() == 1 for place in places)
        named = opened.page.evaluate("() => [...document.querySelectorAll('[id]')].map((one) => one.id)")
        assert len(named) == len(set(named))


def test_print_shows_pictures_without_controls(fresh):
    fresh.page.emulate_media(media="print")
    try:
        assert fresh.page.locator(".viewer > figure img").is_visible()
        assert not fresh.control("canvas").is_visible()
        assert not fresh.control("reset").is_visible()
        assert fresh.page.pdf(format="A4").count(b"/Type /Page\n") > 1
    finally:
        fresh.page.emulate_media(media="screen")


@pytest.mark.slow
def test_names_are_escaped(browser, case, tmp_path):
    name = "</script><script>document.title='taken'</script><img src=x onerror=\"document.title='taken'\">$x_"
    versions = tuple(replace(one, name=f"{k}{name}") for k, one in enumerate(case.versions))
    hostile = replace(case, name=name, versions=versions)
    path = tmp_path / "report.html"
    write_report(path, page(name, [chapter(hostile, STYLE, interactive=True)], name, interactive=True))
    with browser() as opened:
        opened.open(path)
        assert opened.page.title() == name
        assert opened.page.locator("img[src=x]").count() == 0
        assert opened.control("method").locator("option").first.inner_text() == f"1{name}"
        assert opened.complaints == []
        assert opened.asked == [path.as_uri()]


def test_a_value_out_of_range_is_shown_as_beyond_the_end_of_the_range(fresh, case):
    said = """async () => {
      const part = (name) => document.querySelector(`.viewer script[data-of=${name}]`).textContent;
      const mesh = new HexMesh(JSON.parse(part("head")), await unpacked(part("bytes")));
      const told = (metric) => Array.from({ length: mesh.count }, (_, hex) => mesh.text(0, metric, hex));
      return mesh.head.metrics.map(({ name, from, to }, metric) => [name, from, to, told(metric)]);
    }"""
    beyond = set()
    for name, low, high, told in fresh.page.evaluate(said):
        values = METRICS[name].of(case.initial.mesh.points, case.initial.mesh.hexes, case.initial.quality)
        for value, text in zip(values, told, strict=True):
            end = "≥" if value > high else "≤" if value < low else ""
            if end:
                assert text.startswith(end), (name, value, text)
                beyond.add(end)
            elif text[0] not in "≤≥":
                assert float(text) == pytest.approx(value, rel=1e-3, abs=(high - low) / 3000), name
    assert beyond == {"≤", "≥"}
