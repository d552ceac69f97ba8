"""How long a reader waits in Firefox and WebKitGTK for a figure that lives, and for its answer to a
slider, beside plain Pyodide.

``PYTHONPATH=tests python -m bench.engines``, with a built book in ``build/site``: the pages of
`bench.start`, in each engine that is there. Runs take turns, each with a profile of its own (cold);
the page is then opened again (warm), and a slider is moved there.
"""

import argparse
import tempfile
import time
from pathlib import Path
from statistics import median

from bench.start import KEPT, PLAIN, REST_MS, SITE, Run, laid_out
from support.engines import ENGINES
from support.engines.engine import wait_for

PAGES = {"book": "lens-distortion/", "plain": PLAIN}
LIVED = """() => new Promise((resolve) => {
  const look = () => {
    const lives = document.querySelector('simulation-figure[data-state=live]');
    const lived = globalThis.lived ?? (lives ? performance.now() : null);
    if (lived === null) setTimeout(look, 5);
    else resolve(lived);
  };
  look();
})"""
"""Milliseconds until the first figure of a page lives."""
VALUES = [step / 25 - 0.3 for step in range(20)]
DRAG = """async (values) => {
  const next = () => new Promise(requestAnimationFrame);
  const figure = document.querySelector('simulation-figure');
  const slider = figure?.querySelector('[name=k1]');
  const times = [];
  for (const value of values) {
    await next();
    const begun = performance.now();
    if (globalThis.draw) draw('k1', value);
    else {
      const {frames} = figure.dataset;
      slider.value = value;
      slider.dispatchEvent(new Event('input', {bubbles: true}));
      while (figure.dataset.frames === frames) await new Promise((done) => setTimeout(done));
    }
    await next();
    times.push(performance.now() - begun);
  }
  return times;
}"""
"""Milliseconds from a move of a slider to the animation frame after its answer."""


def main() -> None:
    parser = argparse.ArgumentParser(prog="bench.engines", description=__doc__)
    parser.add_argument("--site", type=Path, default=SITE)
    parser.add_argument("--rounds", type=int, default=3)
    given = parser.parse_args()
    with laid_out(given.site) as address:
        for name in ENGINES:
            runs = [run for _ in range(given.rounds) if (run := measure(name, address))]
            found = {kind: median(run[kind] for run in runs) for kind in runs[0]} if runs else {}
            print(name, " ".join(f"{kind} {ms:.0f}" for kind, ms in found.items()), flush=True)


def measure(name: str, address: str) -> Run:
    """One round; nothing where the engine is not there."""
    run: Run = {}
    for page, place in PAGES.items():
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            opened = ENGINES[name](Path(folder))
            if opened is None:
                return {}
            with opened as engine:
                engine.open(address + place)
                run[f"{page} cold"] = engine.ask(LIVED)
                if page == "book":
                    wait_for(engine, f"() => {KEPT}")
                time.sleep(REST_MS / 1000)
                engine.open("about:blank")
                engine.open(address + place)
                run[f"{page} warm"] = engine.ask(LIVED)
                time.sleep(REST_MS / 1000)
                run[f"{page} drag"] = median(engine.ask(DRAG, VALUES))
    return run


if __name__ == "__main__":
    main()
