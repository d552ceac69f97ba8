"""The chart of a ladder: the front joined, the beaten grey."""

import re

from support.toy_ladder import toy_measurements

from site_builder.charts.pareto import pareto_chart


def test_what_has_no_error_stands_in_a_row_of_its_own() -> None:
    chart = pareto_chart(toy_measurements().find("toy"))
    assert chart.error.none is not None
    smallest = chart.error.position(0.02)
    assert chart.error.position(0.0) == chart.error.none > smallest + 10.0


def test_a_chart_joins_the_front_and_greys_what_is_beaten() -> None:
    chart = pareto_chart(toy_measurements().find("toy"))
    native, browser = re.findall(
        r'<polyline class="image faint(?: dashed)?" points="([^"]*)"', chart.marks
    )
    assert len(native.split()) == len(browser.split()) == 3
    assert chart.marks.count('class="muted solid"') == 1
    assert chart.marks.count('class="muted hollow"') == 1
    assert "Clearly beaten: Waste." in chart.description
