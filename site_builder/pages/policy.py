"""What a page may run and load: its content security policy (W3C, level 3).

Everything comes from the book itself, and nothing is embedded. An inline script or style is known
by the hash of its text; only attributes may hold any style, as the sizes of panels and the columns
of formulae do. WebKit reports directives that it does not know, such as `manifest-src`: what
`default-src` says goes for the manifest. A worker whose address is a blob's inherits the policy of
its page: so does the one that runs a reader's Python.
"""

import json
from collections.abc import Sequence

from markupsafe import Markup

from site_builder.files.folders import integrity

ALWAYS = {
    "default-src": "'self'",
    "object-src": "'none'",
    "frame-src": "'none'",
    "style-src-attr": "'unsafe-inline'",
    "img-src": "'self' data: blob:",
    "connect-src": "'self' blob:",
    "worker-src": "'self' blob:",
    "base-uri": "'none'",
    "form-action": "'none'",
}
ANYTHING_INLINE = "'unsafe-inline'"
"""A hash beside it would take it back."""


FOR_TOOLS = "'unsafe-eval'"
"""Playwright and other drivers of browsers evaluate text in a page and add styles to it."""


def page_policy(
    scripts: Sequence[str] = (),
    styles: Sequence[str] = (),
    *,
    raw_html: bool = False,
    published: bool = True,
) -> str:
    """The policy of a page that holds these inline ``scripts`` and ``styles``, and no others unless
    its author may write ``raw_html``. Python runs as WebAssembly, which must be allowed.
    In one that is not ``published`` tools of its author's own may evaluate text and add styles.
    """
    script_src = ["'self'", "'wasm-unsafe-eval'", *_inline(scripts, raw_html)]
    if not published:
        script_src.append(FOR_TOOLS)
    style_src = ["'self'", *_inline(styles, raw_html or not published)]
    rules = {**ALWAYS, "script-src": " ".join(script_src), "style-src": " ".join(style_src)}
    return "; ".join(f"{name} {value}" for name, value in rules.items())


def _inline(texts: Sequence[str], raw_html: bool) -> list[str]:
    return [ANYTHING_INLINE] if raw_html else [f"'{integrity(text.encode())}'" for text in texts]


def json_for_html(data: object) -> Markup:
    """JSON that cannot end the script element it stands in."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    return Markup(text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026"))
