"""What a device is told that keeps the book among its programs (W3C Web Application Manifest)."""

import json

MANIFEST = "manifest.webmanifest"


def manifest(title: str, subtitle: str, assets: str, language: str = "en") -> bytes:
    """The manifest, all addresses relative to the book's root."""
    icon = {"src": f"{assets}images/favicon.svg", "sizes": "any", "type": "image/svg+xml"}
    told = {
        "lang": language,
        "name": title,
        "short_name": title,
        "description": subtitle,
        "start_url": "./",
        "scope": "./",
        "display": "minimal-ui",
        "icons": [icon],
    }
    return json.dumps(told, ensure_ascii=False, indent=1).encode()
