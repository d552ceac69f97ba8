"""Files of the camera of a picture: all numbers, and the camera for fSpy."""

import json
import math

import numpy as np

from simulations.engine.reading import UnfitError
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.projection.vanishing_lines import pixel_of
from simulations.scenes.single_view.lines import Lines, Settings
from simulations.scenes.single_view.measuring import Found, Lengths, Pair, bend_in_words


def as_json(settings: Settings, outputs: Outputs) -> str:
    """Camera, vanishing points, lines and lengths with standard errors; null for the unknown."""
    lines: Lines = outputs["lines"]
    lengths: Lengths = outputs["lengths"]
    photograph = outputs["photograph"]
    return json.dumps(
        {
            "photograph": photograph.name if photograph else "",
            "width_px": lines.size[0],
            "height_px": lines.size[1],
            "sigma_px": outputs["view"].sigma,
            "camera": _camera(outputs["view"]),
            "lens": bend_in_words(outputs["view"].view, outputs["lens"]),
            "lines_px": {
                name: np.round(lines.counted(axis), 2).tolist()
                for axis, name in enumerate(("across", "along", "upright"))
            },
            "known_m": settings.known,
            "plane": settings.plane,
            "camera_above_plane_m": _pair(lengths.distance),
            "lengths_m": [_pair(pair) for pair in lengths.floor],
            "heights_m": [_pair(pair) for pair in lengths.height],
        },
        indent=1,
    )


def as_fspy(_settings: Settings, outputs: Outputs) -> str:
    """The camera as fSpy exports it: y up, the longer side from −1 to 1, a camera that looks along
    −z, and the world of `lines.AXES` with the origin on the plane below the camera."""
    found: Found = outputs["view"]
    if found.view is None:
        raise UnfitError(found.problem)
    view, (width, height) = found.view, outputs["lines"].size
    half = max(width, height) / 2.0

    def on_plane(pixel: Floats) -> dict[str, float]:
        x, y = (pixel + 0.5 - np.array([width, height]) / 2.0) / half
        return {"x": float(x), "y": -float(y)}

    distance = outputs["lengths"].distance[0]
    to_world = np.eye(4)
    to_world[:3, :3] = view.R.T @ np.diag((1.0, -1.0, -1.0))
    to_world[2, 3] = distance if math.isfinite(distance) else 1.0
    points = view.vanishing[:, :2] / np.where(
        view.vanishing[:, 2:] == 0, 1e-12, view.vanishing[:, 2:]
    )
    parameters = {
        "principalPoint": on_plane(np.array(view.centre)),
        "viewTransform": {"rows": np.linalg.inv(to_world).tolist()},
        "cameraTransform": {"rows": to_world.tolist()},
        "horizontalFieldOfView": 2.0 * math.atan(0.5 * width / view.focal_px),
        "verticalFieldOfView": 2.0 * math.atan(0.5 * height / view.focal_px),
        "vanishingPoints": [on_plane(point) for point in points],
        "vanishingPointAxes": ["xPositive", "yPositive", "zPositive"],
        "relativeFocalLength": view.focal_px / half,
        "imageWidth": width,
        "imageHeight": height,
    }
    return json.dumps(parameters, indent=1)


def _camera(found: Found) -> object:
    view = found.view
    if view is None:
        return None
    errors = view.spread(lambda view: np.array([view.pitch, view.roll]))
    points = []
    for point, covariance in zip(view.vanishing, view.vanishing_covariances, strict=True):
        pixel, spread, finite = pixel_of(point, covariance)
        points.append({"pixel": pixel.tolist(), "covariance": spread.tolist()} if finite else None)
    f = view.focal_px
    return {
        "focal_px": _pair((f, f * found.focal_error)) if found.knows_focal else None,
        "principal_point_px": list(view.centre),
        "pitch_rad": _pair((view.pitch, float(errors[0]))),
        "roll_rad": _pair((view.roll, float(errors[1]))),
        "vanishing_points": points,
    }


def _pair(pair: Pair) -> object:
    value, error = pair
    return {"value": value, "standard_error": error} if math.isfinite(value + error) else None
