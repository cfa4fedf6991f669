"""What a sensor and the program of a telephone make of light: blur, cells of one colour each, noise, JPEG."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import cv2
import numpy as np
from camera import NDFloat32
from numpy.typing import NDArray

Photograph = NDArray[np.uint8]
LEVELS = 4096
"""Of linear light that the sensor tells apart."""
CELLS = ((0, 0, 2), (0, 1, 1), (1, 0, 1), (1, 1, 0))
"""Row and column in a square of four cells, and the colour that the cell sees: red, green, green, blue."""
WHITE = 0.8
"""Of the range is the exposure for the paper."""


@dataclass(frozen=True)
class Sensor:
    """How a picture is taken and developed.

    blur : standard deviation of what the lens and the focus smear [pixels]
    moved : how far the picture moved while it was taken, and whither [pixels]
    noise : of full light; reading : of none
    white : factors of blue, green and red by which the balance is wrong
    colourful : 0 as it is, 1 twice so
    smoothed : standard deviation over which colour is smeared [pixels]; sharpened : part that is added of the details
    quality : of the JPEG, to 100
    """

    blur: float = 0.9
    moved: complex = 0j
    noise: float = 0.02
    reading: float = 0.004
    white: tuple[float, float, float] = (1.0, 1.0, 1.0)
    colourful: float = 0.1
    smoothed: float = 1.2
    sharpened: float = 0.4
    quality: int = 85


def developed(light: NDFloat32, sensor: Sensor, rng: np.random.Generator) -> Photograph:
    """The picture (rows, columns, 3) that a telephone makes of linear light (rows, columns, 3), which is used up."""
    light = _smeared(light, sensor)
    light *= WHITE / max(float(np.percentile(light[::16, ::16, 1], 95)), 1e-3)
    raw = _noisy(_mosaic(light), sensor, rng)
    colours = cv2.demosaicing(raw, cv2.COLOR_BayerRGGB2BGR).astype(np.float32)
    some = colours[::16, ::16].reshape(-1, 3)
    bright = some[some[:, 1] > 0.5 * np.percentile(some[:, 1], 95)]
    balance = np.median(bright[:, 1]) / np.median(bright, axis=0) * np.array(sensor.white)
    matrix = (1 + sensor.colourful) * np.eye(3) - sensor.colourful / 3
    colours = cv2.transform(colours, (matrix * balance / 65535 * LEVELS / 0.5).astype(np.float32))
    coded = _codes()[np.clip(colours, 0, LEVELS).astype(np.uint16)]
    return _finished(coded, sensor)


def scanned(light: NDFloat32, rng: np.random.Generator, *, grey: bool, blur: float, noise: float) -> Photograph:
    """The picture that a scanner makes: three lines of cells, and every cell a little wrong all the way down."""
    light = cv2.GaussianBlur(light, (0, 0), blur)
    if grey:
        light = np.repeat((light @ np.array([0.11, 0.59, 0.30], np.float32))[..., None], 3, axis=-1)
    light *= 0.9 / float(np.percentile(light[::16, ::16, 1], 90))
    light *= 1 + 0.006 * rng.standard_normal((1, light.shape[1], 1 if grey else 3), np.float32)
    grain = rng.standard_normal((*light.shape[:2], 1 if grey else 3), np.float32)
    light += grain * np.sqrt(np.maximum(light, 0)) * np.float32(noise)
    return _codes()[np.clip(light * LEVELS, 0, LEVELS).astype(np.uint16)]


def as_jpeg(picture: Photograph, quality: int) -> bytes:
    """The file, its colours at half the size as telephones keep them."""
    good, data = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])
    assert good
    return data.tobytes()


def _smeared(light: NDFloat32, sensor: Sensor) -> NDFloat32:
    if sensor.blur > 0.2:
        light = cv2.GaussianBlur(light, (0, 0), sensor.blur)
    if abs(sensor.moved) > 0.3:
        light = cv2.filter2D(light, -1, _way(sensor.moved))
    return light


def _way(moved: complex) -> NDFloat32:
    """How long the light falls on each pixel (n, n) about the middle of a movement."""
    half = int(np.ceil(abs(moved) / 2)) + 1
    pixels = np.arange(-half, half + 1)
    places = moved * np.linspace(-0.5, 0.5, 65)
    rows, columns = (np.maximum(0, 1 - np.abs(part[:, None] - pixels)) for part in (places.imag, places.real))
    return (rows.T @ columns / places.size).astype(np.float32)


def _mosaic(light: NDFloat32) -> NDFloat32:
    raw = np.empty(light.shape[:2], np.float32)
    for row, column, colour in CELLS:
        raw[row::2, column::2] = light[row::2, column::2, colour]
    return raw


def _noisy(raw: NDFloat32, sensor: Sensor, rng: np.random.Generator) -> NDArray[np.uint16]:
    grain = rng.standard_normal(raw.shape, np.float32)
    grain *= np.sqrt(np.maximum(raw, 0)) * np.float32(sensor.noise) + np.float32(sensor.reading)
    raw += grain
    # Twice the range of the picture: what is brighter than white is cut off later.
    return np.clip(raw * np.float32(0.5 * 65535), 0, 65535).astype(np.uint16)


@cache
def _codes() -> Photograph:
    """sRGB of linear light (LEVELS + 1,), its brightest part rolled off as telephones do."""
    linear = np.arange(LEVELS + 1) / LEVELS
    rolled = np.where(linear < 0.75, linear, 0.75 + 0.25 * np.tanh((linear - 0.75) / 0.25))
    coded = np.where(rolled <= 0.0031308, 12.92 * rolled, 1.055 * np.maximum(rolled, 1e-9) ** (1 / 2.4) - 0.055)
    return np.clip(np.round(255 * coded), 0, 255).astype(np.uint8)


def _finished(coded: Photograph, sensor: Sensor) -> Photograph:
    parts = cv2.cvtColor(coded, cv2.COLOR_BGR2YCrCb)
    bright, *hues = cv2.split(parts)
    if sensor.sharpened:
        soft = cv2.GaussianBlur(bright, (0, 0), 1.2)
        bright = cv2.addWeighted(bright, 1 + sensor.sharpened, soft, -sensor.sharpened, 0)
    if sensor.smoothed:
        hues = [cv2.GaussianBlur(hue, (0, 0), sensor.smoothed) for hue in hues]
    return cv2.cvtColor(cv2.merge([bright, *hues]), cv2.COLOR_YCrCb2BGR)
