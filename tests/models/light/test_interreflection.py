"""Light between two planes: SciPy's integrals, closed forms at the edge, and conservation."""

import numpy as np
import pytest
from scipy.integrate import quad

from simulations.models.light.interreflection import (
    CELLS,
    EDGES,
    bounced,
    edge_factor,
    exchange,
    lamp_light,
    mean_lamp_light,
    seen_of,
    shadow_end,
)

OPENINGS = [np.radians(angle) for angle in (40.0, 90.0, 140.0)]
PLACES = np.array([0.02, 0.3, 1.0])


@pytest.mark.parametrize("opening", OPENINGS)
def test_form_factors_are_integrals_of_both_cosines_over_the_distance(opening: float) -> None:
    """Of endless strips: cos θ cos θ′ / (2 r) per length."""

    def kernel(there: float, here: float) -> float:
        square = here**2 + there**2 - 2 * here * there * np.cos(opening)
        return float(np.sin(opening) ** 2 * here * there / (2 * square**1.5))

    for i, place in enumerate(PLACES):
        for j in (0, 7, CELLS - 1):
            whole = quad(kernel, EDGES[j], EDGES[j + 1], args=(place,))[0]
            assert seen_of(PLACES, opening)[i, j] == pytest.approx(whole, rel=1e-8, abs=1e-13)


@pytest.mark.parametrize("opening", OPENINGS)
def test_crossed_strings_are_the_mean_of_what_a_strip_sees(opening: float) -> None:
    for i in (0, 11, CELLS - 1):
        inside = np.linspace(EDGES[i], EDGES[i + 1], 4001)
        middles = 0.5 * (inside[1:] + inside[:-1])
        mean = seen_of(middles, opening).mean(axis=0)
        np.testing.assert_allclose(exchange(opening)[i], mean, atol=2e-5)


@pytest.mark.parametrize("opening", OPENINGS)
@pytest.mark.parametrize("albedo", [0.0, 0.5, 0.9])
def test_the_edge_of_two_planes_alike_is_brighter_by_the_closed_form(
    opening: float, albedo: float
) -> None:
    lit = bounced(np.ones((2, CELLS)), [albedo, albedo], opening, None)
    expected = albedo * edge_factor(albedo, opening)
    np.testing.assert_allclose(lit[:, 0], expected, rtol=0.03)
    np.testing.assert_allclose(lit[0], lit[1])


def test_bounce_after_bounce_comes_to_what_the_linear_system_says() -> None:
    lamp = np.random.default_rng(3).random((2, CELLS))
    for opening in OPENINGS:
        endless = bounced(lamp, [0.8, 0.6], opening, None)
        np.testing.assert_allclose(bounced(lamp, [0.8, 0.6], opening, 60), endless, rtol=1e-8)
        alone = bounced(lamp, [0.8, 0.6], opening, 0)
        np.testing.assert_allclose(alone, np.array([[0.8], [0.6]]) * lamp)
        before = bounced(lamp, [0.8, 0.6], opening, 3)
        after = bounced(lamp, [0.8, 0.6], opening, 4)
        assert (before < after).all()
        assert (after < endless).all()


def test_the_lamps_light_goes_as_the_cosine_and_stops_at_the_shadow() -> None:
    places, opening = np.linspace(0.0, 1.0, 11), np.radians(90.0)
    np.testing.assert_allclose(lamp_light(places, np.radians(30.0), opening), 0.5)
    light = np.radians(135.0)
    assert shadow_end(light, opening) == pytest.approx(1.0)
    assert shadow_end(np.radians(110.0), opening) == pytest.approx(1 / np.tan(np.radians(70.0)))
    found = lamp_light(places, np.radians(110.0), opening)
    np.testing.assert_allclose(found, np.where(places > 0.364, np.sin(np.radians(110.0)), 0.0))
    for beneath in (0.0, -0.5, -3.0):
        assert not lamp_light(places, beneath, opening).any()


@pytest.mark.parametrize("angle", [20.0, 95.0, 110.0, 150.0, 179.0])
def test_the_strips_have_the_mean_of_their_places(angle: float) -> None:
    light, opening = np.radians(angle), np.radians(90.0)
    fine = (np.arange(400_000) + 0.5) / 400_000
    sums = np.histogram(fine, EDGES, weights=lamp_light(fine, light, opening))[0]
    counts = np.histogram(fine, EDGES)[0]
    np.testing.assert_allclose(mean_lamp_light(light, opening), sums / counts, atol=5e-3)


def test_the_shadow_of_a_leaning_wall_ends_where_the_ray_over_its_rim_does() -> None:
    light, opening = np.radians(130.0), np.radians(100.0)
    rim = np.array([np.cos(opening), np.sin(opening)])
    way = np.array([np.cos(light), np.sin(light)])
    end = rim[0] - way[0] * rim[1] / way[1]
    assert shadow_end(light, opening) == pytest.approx(end)
