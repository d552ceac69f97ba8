"""Names of a surface and its light, for descriptions."""

from simulations.scenes._spectra.settings import LitSurface
from simulations.scenes._spectra.spectra import daylight_temperature

LIGHTS = {
    "planck": "an incandescent body of {:.0f} K",
    "daylight": "daylight of {:.0f} K",
    "fluorescent": "a fluorescent tube",
    "diode": "a white LED",
}
SURFACES = {"cloth": "A dyed cloth", "sky": "A patch like blue sky", "white": "A white patch"}


def lit_surface(settings: LitSurface) -> str:
    """``A dyed cloth … in the light of daylight of 6500 K``."""
    kelvin = settings.temperature
    if settings.light == "daylight":
        kelvin = daylight_temperature(kelvin)
    name = settings.surface.replace("-", " ")
    surface = SURFACES.get(settings.surface, f"A patch of the colour {name}")
    if settings.surface == "cloth":
        surface += f" that sends back light about {settings.band:.0f} nm"
    return f"{surface} in the light of {LIGHTS[settings.light].format(kelvin)}"
