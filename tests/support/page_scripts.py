"""JavaScript that tests run in the pages of the book."""

FIGURES = "document.querySelectorAll('simulation-figure:not(details:not([open]) *)')"
LIVE = f"[...{FIGURES}].every((figure) => figure.dataset.state === 'live')"

SILENT_WORKER = """globalThis.Worker = class extends EventTarget {
  postMessage({id}) { setInterval(() => this.onmessage?.({data: {id, waits: ''}}), 1000); }
  terminate() {}
};"""
"""Python that never starts: figures keep their stills and their controls."""

UNFOLDED = "try { localStorage.setItem('image-formation:everything', 'true'); } catch {}"
"""The stored preference for open deeper sections."""

SAVE_DATA = """Object.defineProperty(navigator, 'connection', {value: {saveData: true}});
sessionStorage.setItem('image-formation:asked', 'yes')"""
"""Python starts, but nothing is fetched or computed in advance for other pages."""

WATCH_SHIFTS = """
window.shifts = [];
new PerformanceObserver((list) => window.shifts.push(...list.getEntries()
    .filter((entry) => !entry.hadRecentInput)
    .map((entry) => ({value: entry.value,
                      moved: entry.sources.map((source) => source.node?.className ?? '')}))))
  .observe({type: 'layout-shift', buffered: true});
"""

SLOWED = """(figure, ms) => {
  const {live} = figure, {runtime} = live;
  live.runtime = Object.create(runtime, {call: {value: async (name, request, urgency) => {
    const reply = await runtime.call(name, request, urgency);
    const late = name === 'render' ? ms[request.tier] ?? 0 : 0;
    await new Promise((done) => setTimeout(done, late));
    return reply;
  }}});
  figure.unslowed = () => { live.runtime = runtime; };
  figure.levels = [];
  figure.addEventListener('painted', () => figure.levels.push(figure.dataset.level));
}"""
"""Have frames of some levels come so many milliseconds later, and note the level of each."""

SCROLL_TO = """async (element) => {
  const middle = () => {
    const {x, y, height} = element.getBoundingClientRect();
    return [x, y, Math.abs(y + height / 2 - innerHeight / 2)];
  };
  for (let still = 0, last = '', away = 0; still < 5; ) {
    if (!still) {
      element.scrollIntoView({block: 'center', inline: 'center', behavior: 'instant'});
      away = middle()[2];
    }
    await new Promise(requestAnimationFrame);
    const place = middle();
    still = `${place}` === last && place[2] <= away + 1 ? still + 1 : 0;
    last = `${place}`;
  }
}"""
"""Wait until the element is at rest: a strip of panels snaps to the nearest one, a touch goes to
the element painted last, and a smooth scroll under way (after a key on a distant element) goes on
after the jump."""

FOLLOW = """(url) => {
  if (location.href === url) document.getElementById('main').focus();
  else [...document.querySelectorAll('a[href]')].find((link) => link.href === url).click();
}"""

ADD_LINK = """(url) => {
  const link = document.createElement('a');
  link.href = url;
  document.getElementById('main').append(link);
}"""

SETTLE = """async (figure) => {
  const {internals} = await customElements.whenDefined('simulation-figure');
  const runtime = internals.sharedRuntime();
  const frame = () => new Promise(requestAnimationFrame);
  for (let quiet = 0, frames = figure.dataset.frames; quiet < 2; ) {
    for (const play of figure.querySelectorAll('button[data-state="1"]')) {
      const effect = JSON.parse(figure.querySelector('script.schema').textContent).controls
        .find((control) => control.name === play.name).effect;
      if (effect === 'play') play.click();
    }
    await frame();
    await frame(); // motion due in this frame is done
    await runtime.call('forget', {figure: ''}, () => -1); // answered after all requests, as drags
    const still = figure.rests && figure.dataset.frames === frames;
    quiet = still && !('moving' in figure.dataset) ? quiet + 1 : 0;
    frames = figure.dataset.frames;
  }
}"""

RESTORE = """async (figure) => {
  const {moveControls} = (await customElements.whenDefined('simulation-figure')).internals;
  const {controls, values} = JSON.parse(figure.querySelector('script.schema').textContent);
  moveControls(figure.querySelector('form.controls'), controls, values, 'change');
}"""

CONTENT = """async (figure) => ({
  pixels: await Promise.all([...figure.querySelectorAll('canvas.live, img.still')].map(
   async (picture) => {
    if (picture instanceof HTMLImageElement) {
      picture.loading = 'eager'; // far down the page it has not been fetched yet
      await picture.decode();
    }
    const isCanvas = picture instanceof HTMLCanvasElement;
    const canvas = isCanvas ? picture : document.createElement('canvas');
    if (!isCanvas) {
      [canvas.width, canvas.height] = [picture.naturalWidth, picture.naturalHeight];
      canvas.getContext('2d').drawImage(picture, 0, 0);
    }
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 1) sum = (sum * 31 + data[i]) | 0;
    return sum;
  })),
  drawings: [...figure.querySelectorAll('svg.overlay')].map((svg) => svg.innerHTML),
  readouts: [...figure.querySelectorAll('output')].map((output) => output.textContent),
})"""

TRY_CONTROLS = """async (figure, controls) => {
  const frame = () => new Promise(requestAnimationFrame);
  const count = () => Number(figure.dataset.frames);
  const put = {
    slider(input, attempt) {
      const [min, max] = [Number(input.min), Number(input.max)];
      input.value = attempt % 2 ? max - 0.2 * (max - min) : min + 0.2 * (max - min);
    },
    choice(menu) { menu.selectedIndex = (menu.selectedIndex + 1) % menu.options.length; },
    toggle(box) { box.checked = !box.checked; },
  };
  const results = [];
  for (const {name, kind, effect} of controls) {
    const element = figure.querySelector(`.controls [name="${name}"]`);
    for (let fold = element; (fold = fold.parentElement.closest('details')); ) fold.open = true;
    element.scrollIntoView({block: 'center', behavior: 'instant'});
    const {x, y, width, height} = element.getBoundingClientRect();
    const top = document.elementFromPoint(x + width / 2, y + height / 2);
    element.focus({preventScroll: true});
    const focused = document.activeElement === element && !element.disabled;
    const frames = count();
    for (let attempt = 0; attempt < 4 && count() === frames; attempt += 1) {
      if (kind === 'action') {
        element.click();
        if (effect === 'play' || effect === 'set') {
          for (let waited = 0; count() === frames && waited < 300; waited += 1) await frame();
          if (element.dataset.state === '1') element.click();
        }
      } else {
        put[kind](element, attempt);
        for (const type of ['input', 'change']) {
          element.dispatchEvent(new Event(type, {bubbles: true}));
        }
      }
      do await frame(); while (!figure.rests);
    }
    results.push({
      name, hit: element.contains(top), cover: top?.outerHTML.slice(0, 99), focused,
      frames: count() - frames,
    });
  }
  return results;
}"""
"""Move each control until a frame is painted, and return for each whether it can be clicked and
focused, and how many frames it made. Scripts move controls alike in all browsers."""

AWAIT_PULLS = """async () => {
  const {internals} = await customElements.whenDefined('simulation-figure');
  const runtime = internals.sharedRuntime();
  for (let pull = 0; pull < 3; pull += 1) await runtime.call('forget', {figure: ''}, () => 3);
}"""
"""Wait until all requests of a drag are answered: the one under way, the one that waits for it, and
the final one. Requests of equal priority are answered in order."""

READ_HANDLE = """async (grip) => {
  const figure = grip.closest('simulation-figure');
  await (PULLED)();
  while (!figure.rests) await new Promise(requestAnimationFrame);
  grip.scrollIntoView({block: 'center', behavior: 'instant'});
  const {x, y, width, height} = grip.getBoundingClientRect();
  const driven = grip.dataset.drives.split(' ').map((name) => {
    const control = figure.querySelector(`.control [name="${name}"]`);
    const box = control.closest('.control');
    if (box.matches('.points')) {
      const share = (axis) => Math.round(parseFloat(grip.style.getPropertyValue(axis)));
      const words = `${box.ariaLabel} x ${share('--x')}, y ${share('--y')}`;
      return {value: control.value, words};
    }
    const value = control.selectedOptions
      ? control.selectedOptions[0].text.trim()
      : box.querySelector('.control-value').textContent;
    const label = box.querySelector('label').textContent.trim();
    return {value: control.value, words: `${label} ${value}`};
  });
  return {
    visible: grip.checkVisibility() && width > 0,
    x: x + width / 2,
    y: y + height / 2,
    values: driven.map(({value}) => value).join(' '),
    words: driven.map(({words}) => words).join(', '),
    announced: grip.getAttribute('aria-valuetext'),
    frames: Number(figure.dataset.frames),
  };
}""".replace("PULLED", AWAIT_PULLS)
"""Read a handle at rest in the middle of the window: its place, the text announced for it, and the
values and texts of the controls that it moves."""
