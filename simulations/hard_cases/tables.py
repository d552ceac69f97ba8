"""All tables of hard cases, in the order of the book."""

from simulations.hard_cases import (
    color,
    compression,
    demosaicing,
    distortion,
    lines_and_planes,
    optics,
    projection,
    raycasting,
    reflectance,
    resampling,
    rotations,
    sampling,
    sensor,
    transforms,
)

TABLES = (
    transforms.TABLE,
    lines_and_planes.TABLE,
    rotations.TABLE,
    projection.TABLE,
    distortion.TABLE,
    resampling.TABLE,
    reflectance.TABLE,
    optics.TABLE,
    raycasting.TABLE,
    sensor.TABLE,
    demosaicing.TABLE,
    sampling.TABLE,
    color.TABLE,
    compression.TABLE,
)
