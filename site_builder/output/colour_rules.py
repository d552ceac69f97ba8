"""Rules of the style sheet for the colours of a book's own ideas."""

from site_builder.document.book import Colours

LIT_OTHERWISE = ".handle, .readout"
"""Selects what a lit idea marks in another way than by its ground."""


def colour_rules(colours: Colours) -> str:
    """What ``tokens.css``, ``overlay.css``, ``readouts.css`` and ``tools.css`` say of a role."""
    return "".join(
        f"""
:root {{ --idea-{name}: light-dark({light}, {dark}); }}
.overlay .{name}, .role-{name} {{ color: var(--idea-{name}); }}
.readout.role-{name} {{ --mark: var(--idea-{name}); }}
simulation-figure[data-lit="{name}"] .overlay > :not(.{name}, :has(.{name})) {{ opacity: 0.25; }}
[data-lit="{name}"] .role-{name}:not({LIT_OTHERWISE}) {{
  border-radius: var(--radius);
  background: color-mix(in srgb, currentColor 14%, transparent);
}}
[data-lit="{name}"] .readout.role-{name} {{ border-top-color: var(--mark); }}
"""
        for name, (light, dark) in colours.items()
    )


def paper_rules(colours: Colours) -> str:
    """The same without variables and themes, for e-books and notebooks."""
    return "".join(
        f".overlay .{name}, .role-{name} {{ color: {light}; }}\n"
        for name, (light, _) in colours.items()
    )
