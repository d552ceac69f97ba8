"""Chapter 0: from a speck of paint to 149."""

import tomllib
from math import hypot

import numpy as np
from support.worked_numbers import CONTENT, Says, source

from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.projection.pinhole import intrinsics, project
from simulations.models.sampling.aliasing import alias_frequency, box_mtf
from simulations.scenes.formation_pipeline.stations import stations, travel

CHAPTER = "00-why-image-formation"
K = intrinsics(800.0, (320.0, 240.0))
LENS = Distortion(k1=-0.2)
SPELT: dict[float, str] = {4: "four", 7: "Seven"}


def pixel_of(x_m: float, y_m: float, depth_m: float) -> tuple[float, float]:
    bent = distort(np.array([x_m, y_m]) / depth_m, LENS)
    pixel, _ = project([*bent, 1.0], K)
    return float(pixel[0]), float(pixel[1])


def one_list_of_links() -> Says:
    """Prose, table, worked example and figure have the same links in the same order."""
    scene, *links = [station.title for station in stations(travel(4.0, 0.6, 0))]
    assert scene == "Scene"
    yield f"{SPELT[len(links)]} links lie between"
    text = (CONTENT / f"{CHAPTER}.md").read_text(encoding="utf-8").replace("&shy;", "")
    prose, example = text.split(":::{example}")
    for part, mark in ((prose, "\n\n**{}.** "), (prose, "\n| {} | "), (example, "\n**{}.** ")):
        places = [part.index(mark.format(link)) for link in links]
        assert places == sorted(places), mark


def from_a_speck_to_its_place() -> Says:
    x, y, z = np.subtract((0.4, -0.3, 3.0), (0.0, 0.0, -1.0))
    yield rf"in camera coordinates the speck is at $({x:g}, {y:g}, {z:.1f})$ m"
    yield rf"$x = {x:g}/{z:g} = {x / z:g}$ and $y = {y:g}/{z:g} = {y / z:g}$"
    squared = (x / z) ** 2 + (y / z) ** 2
    factor = 1 - 0.2 * squared
    yield rf"$r^2 = 0.1^2 + 0.075^2 = {squared:.6f}$ and the factor is {factor:.6f}"
    bent = distort([x / z, y / z], LENS)
    yield rf"moves to $({bent[0]:.5f}, {bent[1]:.5f})$"
    u, v = pixel_of(x, y, z)
    yield rf"$320 + 800 \cdot {bent[0]:.5f} = {u:.2f}$"
    yield rf"$240 - 800 \cdot {-bent[1]:.5f} = {v:.2f}$"
    yield f"The nearest cell is column {round(u)}, row {round(v)}."
    straight, _ = project([x, y, z], K)
    yield rf"the place would have been $({straight[0]:.0f}, {straight[1]:.0f})$ exactly"
    assert 0.3 < hypot(u - straight[0], v - straight[1]) < 0.35, "about a third of a pixel"


def stripes_finer_than_the_grid() -> Says:
    """Five on four pixels: the average over a cell, and what the grid makes of the rest."""
    frequency = 5 / 4
    yield f"{100 * float(box_mtf(frequency, 1.0)):.0f} % of their contrast, the difference"
    period = 1 / abs(float(alias_frequency(frequency, 1.0)))
    yield f"one broad stripe every {SPELT[period]} pixels"


def the_point_at_twice_the_distance() -> Says:
    u, v = pixel_of(0.4, -0.3, 8.0)
    yield f"The place moves to $({u:.2f}, {v:.2f})$"
    yield f"not to {149 / 2 + 0.5:.0f}, because of the sRGB curve"
    near, far = (hypot(x - 320, y - 240) for x, y in (pixel_of(0.4, -0.3, 4.0), (u, v)))
    assert 0.49 < far / near < 0.51, "about half as far from the centre"


def specks_on_one_ray() -> Says:
    """Of the four answers only the key has the image of the speck that is asked about."""
    x, y = 0.5 / 2.0, -0.2 / 2.0
    yield f"the same $({x:g}, {y:g})$"
    wrong = ((0.5, -0.2, 4.0), (2.5, 1.8, 4.0), (0.25, -0.1, 4.0))
    for X, Y, Z in (*wrong, (1.0, -0.4, 4.0)):
        assert np.allclose((X / Z, Y / Z), (x, y)) == ((X, Y, Z) not in wrong)
        yield f"{Y:g}, {Z:.1f})$ m"


def where_models_break() -> Says:
    yield "Every chapter has a section on where its model breaks."
    for name in tomllib.loads((CONTENT / "book.toml").read_text(encoding="utf-8"))["chapters"]:
        headings = [line for line in source(name).splitlines() if line[:3] == "## "]
        assert any("breaks" in heading for heading in headings), name


WORKED = (
    one_list_of_links,
    from_a_speck_to_its_place,
    stripes_finer_than_the_grid,
    the_point_at_twice_the_distance,
    specks_on_one_ray,
    where_models_break,
)
