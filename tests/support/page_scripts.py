"""JavaScript that a reader of the tests runs in the pages of the book."""

FIGURES = "document.querySelectorAll('simulation-figure')"
LIVE = f"[...{FIGURES}].every((figure) => figure.dataset.state === 'live')"

SILENT_WORKER = """globalThis.Worker = class extends EventTarget {
  postMessage() {}
  terminate() {}
};"""
"""Python that never answers: figures keep their stills and their controls."""

FRUGAL = """Object.defineProperty(navigator, 'connection', {value: {saveData: true}});
sessionStorage.setItem('image-formation:asked', 'yes')"""
"""Python is asked for, but nothing is fetched or computed for a page that may come."""

WATCH_SHIFTS = """
window.shifts = [];
new PerformanceObserver((list) => window.shifts.push(...list.getEntries()
    .filter((entry) => !entry.hadRecentInput)
    .map((entry) => ({value: entry.value,
                      moved: entry.sources.map((source) => source.node?.className ?? '')}))))
  .observe({type: 'layout-shift', buffered: true});
"""

BRING = """async (element) => {
  element.scrollIntoView({block: 'center', inline: 'center', behavior: 'instant'});
  for (let still = 0, last = ''; still < 5; ) {
    await new Promise(requestAnimationFrame);
    const {x, y} = element.getBoundingClientRect();
    still = `${x} ${y}` === last ? still + 1 : 0;
    last = `${x} ${y}`;
  }
}"""
"""A strip of panels snaps to the nearest one, and a touch is led to what was painted last."""

FOLLOW = """(url) => {
  if (location.href === url) document.getElementById('main').focus();
  else [...document.querySelectorAll('a[href]')].find((link) => link.href === url).click();
}"""

OFFER = """(url) => {
  const link = document.createElement('a');
  link.href = url;
  document.getElementById('main').append(link);
}"""

SETTLE = """async (figure) => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  const frame = () => new Promise(requestAnimationFrame);
  for (let quiet = 0, frames = figure.dataset.frames; quiet < 2; ) {
    for (const play of figure.querySelectorAll('button[data-state="1"]')) {
      const effect = JSON.parse(figure.querySelector('script.schema').textContent).controls
        .find((control) => control.name === play.name).effect;
      if (effect === 'play') play.click();
    }
    await frame();
    await frame(); // what moves has moved
    await runtime.call('forget', {figure: ''}, () => -1); // answered after all that waits, as pulls
    const still = figure.rests && figure.dataset.frames === frames;
    quiet = still && !('moving' in figure.dataset) ? quiet + 1 : 0;
    frames = figure.dataset.frames;
  }
}"""

PUT_BACK = """async (figure) => {
  const {moveControls} = (await customElements.whenDefined('simulation-figure')).inside;
  const {controls, values} = JSON.parse(figure.querySelector('script.schema').textContent);
  moveControls(figure.querySelector('form.controls'), controls, values, 'change');
}"""

SHOWN = """async (figure) => ({
  pixels: await Promise.all([...figure.querySelectorAll('canvas.live, img.still')].map(
   async (shown) => {
    if (shown instanceof HTMLImageElement) {
      shown.loading = 'eager'; // far down the page it has not been fetched yet
      await shown.decode();
    }
    const canvas = shown instanceof HTMLCanvasElement ? shown : document.createElement('canvas');
    if (canvas !== shown) {
      [canvas.width, canvas.height] = [shown.naturalWidth, shown.naturalHeight];
      canvas.getContext('2d').drawImage(shown, 0, 0);
    }
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 1) sum = (sum * 31 + data[i]) | 0;
    return sum;
  })),
  drawings: [...figure.querySelectorAll('svg.overlay')].map((svg) => svg.innerHTML),
  readouts: [...figure.querySelectorAll('output')].map((output) => output.textContent),
})"""
