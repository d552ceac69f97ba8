"""The lights and surfaces that the two figures on spectra offer."""

LIGHTS = {
    "planck": "Incandescent",
    "daylight": "Daylight",
    "fluorescent": "Fluorescent tube",
    "diode": "White LED",
}
SURFACES = {
    "cloth": "Dyed cloth (band and width)",
    "dark-skin": "Dark skin",
    "light-skin": "Light skin",
    "sky": "Blue sky",
    "foliage": "Foliage",
    "orange": "Orange",
    "purple": "Purple",
    "blue": "Blue",
    "green": "Green",
    "red": "Red",
    "yellow": "Yellow",
    "white": "White",
}
NAMES = tuple(SURFACES)
"""Names of the surfaces: the cloth, then the measured patches."""
NARROWEST_NM, WIDEST_NM = 10, 100
"""Ends of the slider of the cloth's width."""
COOLEST_K, HOTTEST_K, STEP_K = 2000, 12000, 50
"""Ends and step of the slider of temperature."""
