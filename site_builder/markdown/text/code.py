"""Code blocks, coloured by classes."""

from html import escape

from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import unknown

LANGUAGES = ("python", "console", "text", "bash", "javascript", "json", "toml", "markdown")
PARTS = ("starter", "check", "solution", "wrong", "adapter")
"""Blocks of an exercise, which are Python."""


def code_html(code: str, language: str) -> str:
    """``code`` as a ``<pre>``; plain where ``language`` is empty."""
    if not language:
        return f'<pre class="code"><code>{escape(code)}</code></pre>\n'
    language = "python" if language in PARTS else language
    opening = f'<pre class="code highlight"><code class="language-{escape(language)}">'
    body = "\n".join(highlighted_lines(code, language))
    return f"{opening}{body}\n</code></pre>\n"


@cached
def highlighted_lines(code: str, language: str) -> list[str]:
    """Each line of ``code`` as HTML of its own. Raises `ValueError` for an unknown language."""
    # Imported only where something is not cached.
    from pygments import highlight
    from pygments.formatters import HtmlFormatter
    from pygments.lexers import get_lexer_by_name
    from pygments.util import ClassNotFound

    try:
        lexer = get_lexer_by_name(language)
    except ClassNotFound:
        raise ValueError(unknown("language", language, LANGUAGES)) from None
    # Pygments closes its spans at the end of each line.
    lines: list[str] = highlight(code, lexer, HtmlFormatter(nowrap=True)).rstrip("\n").split("\n")
    return lines
