"""A fall in steps: better rules and more steps leave less."""

import numpy as np

from simulations.ladders.falling_steps import LADDER, TIME_S, exact

WORKLOAD = LADDER.prepare()
TRUTH = LADDER.reference(WORKLOAD)


def test_the_reference_is_the_formula() -> None:
    expected = WORKLOAD * np.tanh(9.81 * TIME_S / WORKLOAD)
    np.testing.assert_allclose(exact(WORKLOAD), expected, rtol=1e-14)


def test_a_better_rule_leaves_less_and_so_do_more_steps() -> None:
    errors = {
        tier.id: LADDER.metrics[0].measure(tier.run(WORKLOAD), TRUTH, WORKLOAD)
        for tier in LADDER.tiers
    }
    assert errors["euler-64"] > errors["euler-1024"] > errors["middle-64"] > errors["classic-64"]
