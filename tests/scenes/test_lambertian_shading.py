"""The Lambertian figure shows what its formula says."""

from functools import partial

from support.frames import frame_of, pixels_of

from simulations.scenes.lambertian_shading.scene import SCENE

frame = partial(frame_of, SCENE)


def test_the_pixel_at_the_probed_point_has_the_value_read_out() -> None:
    raster = pixels_of(frame())
    height, width = raster.shape[:2]
    assert abs(int(raster[height // 2, width // 2, 0]) - 217) <= 1


def test_a_light_behind_leaves_the_disc_black() -> None:
    raster = pixels_of(frame(light_angle=180))
    height, width = raster.shape[:2]
    assert not raster[height // 2, width // 2 - 120 : width // 2 + 120, :3].any()
