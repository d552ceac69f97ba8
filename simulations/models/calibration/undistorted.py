"""A whole photograph made anew as a pinhole with the same intrinsic matrix would have taken it.

For each pixel the forward model of the lens says where its light is in the photograph, and the
colour there is interpolated between four pixels. Rows are done in bands, so that a photograph of
24 megapixels needs little more memory than itself.
"""

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.calibration.camera import Camera
from simulations.models.distortion.lens import distorted, fold_radius

type Codes = NDArray[np.uint8]

BAND = 1 << 16
"""Pixels that are done at once."""
UNSEEN = 128
"""Code of pixels whose light the photograph does not have."""


def undistorted(codes: Codes, camera: Camera) -> Codes:
    """The photograph (H, W, 3) without the distortion of the camera's lens; the same size."""
    if camera.lens.neutral:
        return codes
    height, width = codes.shape[:2]
    flat = np.ascontiguousarray(codes).reshape(-1, codes.shape[2])
    made = np.empty_like(codes)
    rows = max(BAND // width, 1)
    for top in range(0, height, rows):
        band = slice(top, min(top + rows, height))
        made[band] = _gathered(flat, (height, width), *_places(camera, width, band))
    return made


def _places(camera: Camera, width: int, rows: slice) -> tuple[Floats, Floats]:
    """Columns and rows (h, W) of the photograph for the pixels of a band; −2 past a fold."""
    x = (np.arange(width) - camera.cx) / camera.fx
    y = (np.arange(rows.start, rows.stop) - camera.cy) / camera.fy
    ideal = np.stack(np.meshgrid(x, y), axis=-1)
    places = distorted(ideal, camera.lens)
    folded = (ideal * ideal).sum(axis=-1) >= fold_radius(camera.lens) ** 2
    places[folded] = np.nan
    return places[..., 0] * camera.fx + camera.cx, places[..., 1] * camera.fy + camera.cy


def _gathered(flat: Codes, size: tuple[int, int], x: Floats, y: Floats) -> Codes:
    """Colours (h, W, 3) at places of a photograph of size (H, W), whose pixels are ``flat``."""
    height, width = size
    inside = (x > -0.5) & (x < width - 0.5) & (y > -0.5) & (y < height - 0.5)  # false for NaN
    x = np.clip(np.where(inside, x, 0.0), 0.0, width - 1.0).astype(np.float32)
    y = np.clip(np.where(inside, y, 0.0), 0.0, height - 1.0).astype(np.float32)
    column = np.minimum(x.astype(np.int32), max(width - 2, 0))
    row = np.minimum(y.astype(np.int32), max(height - 2, 0))
    right, below = (x - column)[..., None], (y - row)[..., None]
    first = row.astype(np.intp) * width + column
    across, down = (1 if width > 1 else 0), (width if height > 1 else 0)
    upper = flat[first] * (1 - right) + flat[first + across] * right
    lower = flat[first + down] * (1 - right) + flat[first + down + across] * right
    colours = upper * (1 - below) + lower * below
    return np.where(inside[..., None], np.rint(colours), UNSEEN).astype(np.uint8)
