"""The W3C Web Application Manifest, with which a device installs the book."""

import json

MANIFEST = "manifest.webmanifest"


def manifest(title: str, subtitle: str, assets: str, language: str = "en") -> bytes:
    """The manifest, all addresses relative to the book's root."""
    icon = {"src": f"{assets}images/favicon.svg", "sizes": "any", "type": "image/svg+xml"}
    data = {
        "lang": language,
        "name": title,
        "short_name": title,
        "description": subtitle,
        "start_url": "./",
        "scope": "./",
        "display": "minimal-ui",
        "icons": [icon],
    }
    return json.dumps(data, ensure_ascii=False, indent=1).encode()
