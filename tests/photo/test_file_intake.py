"""Files made pictures: what cameras and scanners write, and what strangers do."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hostile_pictures import fill, heic, png, sample
from PIL import Image

from graphcam.photo.file_intake import Photograph, UnopenedFile, pictures_in
from graphcam.photo.pictures import MAX_KEPT_PIXELS

pytestmark = pytest.mark.slow

RED, BLUE, WHITE = (10, 10, 250), (250, 10, 10), (240, 240, 240)


def one(path) -> Photograph:
    (picture,) = pictures_in([path])
    assert isinstance(picture, Photograph), picture
    assert picture.pixels.dtype == np.uint8
    assert picture.pixels.flags.c_contiguous
    return picture


def assert_sample(pixels, tolerance=12):
    assert pixels.shape == (300, 400, 3)
    for place, colour in {(20, 20): RED, (280, 20): BLUE, (20, 300): WHITE, (280, 300): WHITE}.items():
        assert np.abs(pixels[place].astype(int) - colour).max() <= tolerance, place


def test_every_common_format_is_opened_whatever_its_ending(tmp_path):
    image = sample()
    image.save(tmp_path / "jpeg.png", "JPEG", quality=95)
    image.save(tmp_path / "png.jpg", "PNG")
    image.save(tmp_path / "tiff", "TIFF", compression="tiff_lzw")
    (tmp_path / "heic.pdf").write_bytes(heic(image))
    image.save(tmp_path / "pdf.heic", "PDF", quality=95)
    for name in ("jpeg.png", "png.jpg", "tiff", "heic.pdf", "pdf.heic"):
        picture = one(tmp_path / name)
        assert picture.name == name
        assert_sample(picture.pixels, 16)
        assert picture.focal is None


@pytest.mark.parametrize("orientation", range(1, 9))
def test_pictures_are_turned_as_the_camera_was_held(tmp_path, orientation):
    # What the camera stores so that the turn makes it upright.
    stored = {
        1: lambda image: image,
        2: lambda image: image.transpose(Image.Transpose.FLIP_LEFT_RIGHT),
        3: lambda image: image.transpose(Image.Transpose.ROTATE_180),
        4: lambda image: image.transpose(Image.Transpose.FLIP_TOP_BOTTOM),
        5: lambda image: image.transpose(Image.Transpose.TRANSPOSE),
        6: lambda image: image.transpose(Image.Transpose.ROTATE_90),
        7: lambda image: image.transpose(Image.Transpose.TRANSVERSE),
        8: lambda image: image.transpose(Image.Transpose.ROTATE_270),
    }
    exif = Image.Exif()
    exif[0x0112] = orientation
    for ending in ("jpg", "png"):
        stored[orientation](sample()).save(tmp_path / f"turned.{ending}", exif=exif)
        assert_sample(one(tmp_path / f"turned.{ending}").pixels)


def test_a_colour_is_a_colour_in_every_mode(tmp_path):
    image = sample()
    image.convert("CMYK").save(tmp_path / "cmyk.jpg", quality=95)
    image.quantize(8).save(tmp_path / "palette.png")
    see_through = image.convert("RGBA")
    see_through.putalpha(Image.fromarray(np.where(np.arange(400) < 350, 255, 0).astype(np.uint8)[None].repeat(300, 0)))
    see_through.save(tmp_path / "alpha.png")
    see_through.save(tmp_path / "alpha.tif")
    image.save(tmp_path / "animated.png", save_all=True, append_images=[image.rotate(180)] * 3)
    for name in ("cmyk.jpg", "palette.png", "alpha.png", "alpha.tif", "animated.png"):
        assert_sample(one(tmp_path / name).pixels, 25)
    # What nothing covers is paper.
    assert one(tmp_path / "alpha.png").pixels[150, 390].tolist() == [255, 255, 255]


def test_grey_becomes_grey(tmp_path):
    grey = np.tile(np.arange(0, 250, 10, dtype=np.uint8), (30, 1))
    Image.fromarray(grey).save(tmp_path / "grey.jpg", quality=100)
    Image.fromarray(grey.astype(np.uint16) * 257).save(tmp_path / "sixteen.png")
    Image.fromarray(grey.astype(np.uint16) * 257).save(tmp_path / "sixteen.tif")
    (tmp_path / "sixteen-colours.png").write_bytes(
        png(25, 30, b"".join(b"\0" + np.repeat(row.astype(">u2") * 257, 3).tobytes() for row in grey), bits=16)
    )
    for name in ("grey.jpg", "sixteen.png", "sixteen.tif", "sixteen-colours.png"):
        pixels = one(tmp_path / name).pixels
        assert pixels.shape == (30, 25, 3)
        assert np.abs(pixels.astype(int) - grey[..., None]).max() <= 2, name
    Image.fromarray(grey > 100).save(tmp_path / "two.tif", compression="group4")
    assert np.array_equal(one(tmp_path / "two.tif").pixels[..., 0] == 255, grey > 100)


def test_the_focal_length_is_what_the_camera_says(tmp_path):
    def focal_of(**said):
        exif = Image.Exif()
        numbers = {"equivalent": 0xA405, "length": 0x920A, "resolution": 0xA20E, "unit": 0xA210}
        exif.get_ifd(0x8769).update({numbers[name]: value for name, value in said.items()})
        sample().save(tmp_path / "said.jpg", exif=exif)
        return one(tmp_path / "said.jpg").focal

    assert focal_of(equivalent=26) == pytest.approx(26 / 43.27 * 500)
    assert focal_of(length=4.2, resolution=100.0, unit=4) == pytest.approx(420)
    assert focal_of(length=4.2, resolution=2540.0, unit=2) == pytest.approx(420)
    assert focal_of(equivalent=2000) is focal_of(equivalent=0) is focal_of(length=4.2) is focal_of() is None
    assert focal_of(length=4.2, resolution=0.0, unit=4) is None


def test_large_pictures_are_reduced(tmp_path):
    exif = Image.Exif()
    exif.get_ifd(0x8769)[0xA405] = 26
    for width, height in ((6400, 4800), (8200, 6100)):
        sample(width, height).save(tmp_path / "large.jpg", exif=exif)
        picture = one(tmp_path / "large.jpg")
        rows, columns = picture.pixels.shape[:2]
        assert MAX_KEPT_PIXELS / 2 < rows * columns <= MAX_KEPT_PIXELS
        assert columns / rows == pytest.approx(width / height, abs=1e-3)
        assert picture.focal == pytest.approx(26 / 43.27 * np.hypot(columns, rows), rel=1e-3)
        assert picture.pixels[rows // 6, columns // 8].tolist() == pytest.approx(list(RED), abs=12)


def test_pages_of_scans_come_one_after_another(tmp_path):
    pages = [sample().convert("L") if k % 2 else sample() for k in range(50)]
    pages[0].save(tmp_path / "scan.pdf", save_all=True, append_images=pages[1:], resolution=200)
    sample().save(tmp_path / "scan.tif", save_all=True, append_images=[sample() for _ in range(4)])
    found = list(pictures_in([tmp_path / "scan.pdf"]))
    assert [picture.name for picture in found] == [f"scan.pdf, {k}" for k in range(1, 51)]
    # At the scan's own resolution, though the page is far smaller than 300 dpi would make it.
    assert all(picture.pixels.shape == (300, 400, 3) for picture in found)
    assert [picture.name for picture in pictures_in([tmp_path / "scan.tif"])] == [
        "scan.tif", *(f"scan.tif, {k}" for k in range(2, 6)),
    ]  # fmt: skip
    # Who stops after a page has had no other one made.
    assert next(pictures_in([tmp_path / "scan.pdf"])).name == "scan.pdf, 1"


def test_a_page_that_is_no_scan_is_made_at_300_dpi(tmp_path):
    from hostile_pictures import pdf_of

    paint = b"1 0 0 rg 0 0 72 72 re f"
    parts = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 144 72] /Contents 4 0 R >>",
        b"<< /Length %d >>\nstream\n" % len(paint) + paint + b"\nendstream",
    ]
    (tmp_path / "drawn.pdf").write_bytes(pdf_of(parts))
    pixels = one(tmp_path / "drawn.pdf").pixels
    assert pixels.shape == (300, 600, 3)
    assert pixels[150, 100].tolist() == [0, 0, 255]
    assert pixels[150, 500].tolist() == [255, 255, 255]
    parts[2] = parts[2].replace(b"144 72", b"14400 14400")
    (tmp_path / "huge.pdf").write_bytes(pdf_of(parts))
    rows, columns = one(tmp_path / "huge.pdf").pixels.shape[:2]
    assert rows * columns <= MAX_KEPT_PIXELS * 1.01


def test_folders_are_looked_through_by_name_and_one_deep(tmp_path):
    for name in ("b.jpg", "a.jpg", "sub/c.jpg", "sub/deeper/d.jpg", ".hidden.jpg"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        sample().save(tmp_path / name)
    (tmp_path / "readme.txt").write_text("not a picture")
    sample().save(tmp_path / "picture.dat", "JPEG")
    names = [picture.name for picture in pictures_in([tmp_path])]
    folder = tmp_path.name
    assert names == [f"{folder}/a.jpg", f"{folder}/b.jpg", f"{folder}/picture.dat", f"{folder}/sub/c.jpg"]


def test_what_is_named_and_is_none_is_told(tmp_path):
    (tmp_path / "readme.txt").write_text("not a picture")
    told = list(pictures_in([tmp_path / "readme.txt", tmp_path / "missing.jpg", Path("/dev/null")]))
    assert all(isinstance(found, UnopenedFile) for found in told)
    assert [(found.name, str(found.why)) for found in told] == [
        ("readme.txt", "it is neither JPEG, PNG, HEIC, TIFF nor PDF"),
        ("missing.jpg", "there is no such file"),
        ("null", "it is not a file"),
    ]
    assert all(str(found.remedy) for found in told)


TOLD = {
    "half.jpg": "damaged",
    "head.jpg": "damaged",
    "empty.jpg": "empty",
    "text.jpg": "neither",
    "bomb.png": "too large",
    "large bomb.png": "too large",
    "bomb.tif": "too large",
    "junk.pdf": "damaged",
    "locked.pdf": "password",
    "bomb.pdf": "too large",
    "half.heic": "damaged",
    "float.tif": "colour",
    "pipe.jpg": "not a file",
    "loop.jpg": "link",
    "device.jpg": "not a file",
    "long.jpg": "larger than 200 MB",
}


def test_hostile_files_cost_a_sentence_each(tmp_path):
    fill(tmp_path)
    found = {picture.name.partition("/")[2]: picture for picture in pictures_in([tmp_path])}
    assert {name for name, picture in found.items() if isinstance(picture, Photograph)} == {"a good.jpg", "z good.png"}
    assert found.keys() - TOLD.keys() == {"a good.jpg", "z good.png"}
    for name, words in TOLD.items():
        assert words in str(found[name].why), name


MEASURED = """
import resource, sys
from pathlib import Path
from graphcam.photo.file_intake import Photograph, pictures_in

def said(name):
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(name)) * 1024

if len(sys.argv) > 2:
    limit = said("VmSize") + int(sys.argv[2])
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
for picture in pictures_in([Path(sys.argv[1])]):
    print(picture.name if isinstance(picture, Photograph) else picture.why)
    del picture
print(said("VmHWM") // 1_000_000)
"""


def measured(folder, *limit):
    """What comes out of a folder, and the most memory that it took [MB]; ``limit`` is what may be taken [bytes]."""
    command = [sys.executable, "-c", MEASURED, str(folder), *map(str, limit)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    *found, megabytes = done.stdout.splitlines()
    return found, int(megabytes)


def test_hostile_files_take_little_memory(tmp_path):
    fill(tmp_path)
    found, megabytes = measured(tmp_path)
    assert len(found) == len(TOLD) + 2
    assert megabytes < 300


def test_the_largest_pictures_stay_within_600_mb(tmp_path):
    sample(12_000, 9_900).save(tmp_path / "a.jpg")
    sample(8_000, 5_900).save(tmp_path / "b.jpg")
    sample(10_000, 7_900).save(tmp_path / "c.png")
    (tmp_path / "d.heic").write_bytes(heic(sample(8_000, 6_000)))
    found, megabytes = measured(tmp_path)
    assert [name[-5:] for name in found] == ["a.jpg", "b.jpg", "c.png", ".heic"]
    assert megabytes < 600


def test_where_memory_ends_the_rest_goes_on(tmp_path):
    sample(10_000, 7_900).save(tmp_path / "a.png")
    sample(6_000, 4_000).save(tmp_path / "b.jpg")
    sample().save(tmp_path / "c.jpg")
    found, _ = measured(tmp_path, 60_000_000)
    assert found[:2] == ["the picture does not fit into memory"] * 2
    assert found[2].endswith("c.jpg")
