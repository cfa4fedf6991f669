"""Random cams under oscillating flat faces against envelopes at 50 digits.

``python tests/mechanism/swinging_faces.py --seed 1 --size 300`` compares so many cams and prints the worst error of
each quantity; the suite does a sample of them.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from mpmath import mpf
from reference import ReferenceSwingingFace

from graphcam.errors import DesignError
from graphcam.given.follower import OscillatingFlat
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam

TOLERANCE = 1e-10
"""By what part of its size, or of the centre distance, a value may miss that at 50 digits."""
PLACES = 4
"""Places of the turn at which a cam is compared."""


def random_cam(seed: int) -> Cam:
    """Laws, sense, sizes and angles are drawn; the face lies on either side of its pivot; some cams are undercut."""
    rng = np.random.default_rng([seed, 35])
    while True:
        angles = rng.uniform(0.3, 1.5, 4)
        angles *= FULL_TURN / angles.sum()
        swing, distance = float(rng.uniform(0.05, 0.6)), float(rng.uniform(60, 200))
        radius, offset = distance * float(rng.uniform(0.1, 0.7)), distance * float(rng.uniform(-0.3, 0.3))
        rise, back = (str(name) for name in rng.choice(LAWS, 2))
        phases = [Rise(swing, angles[0], rise), Dwell(angles[1]), Return(swing, angles[2], back), Dwell(angles[3])]
        try:
            follower = OscillatingFlat(distance, offset)
            return Cam(Motion(phases), follower, radius, "ccw" if rng.random() < 0.5 else "cw")
        except DesignError:
            continue


def errors_of(cam: Cam, phi: np.ndarray) -> dict[str, float]:
    """The relative errors of profile, contact and radius of curvature at cam angles."""
    exact, size = ReferenceSwingingFace(cam), cam.follower.distance
    angles = [mpf(float(x)) for x in phi]
    met = [exact.meeting(angle) for angle in angles]
    rho = np.array([float(exact.radius_of_curvature(angle)) for angle in angles])
    profile = np.array([[float(x) for x in point] for _, point in met])
    contact = np.array([float(along) for along, _ in met])
    radius = cam.kinematics.convex_radius(cam.motion(phi))
    return {
        "profile": float(np.abs(cam.profile(phi) - profile).max() / size),
        "contact": float(np.abs(cam.kinematics.contact(cam.motion(phi)) - contact).max() / size),
        "radius of curvature": float((np.abs(radius - rho) / np.maximum(np.abs(rho), size)).max()),
        "curvature": float(np.abs(1 - cam.pitch_curvature(phi) * radius).max()),
    }


def worst_errors(seed: int, count: int) -> dict[str, float]:
    """The worst errors of so many cams."""
    worst: dict[str, float] = {}
    for k in range(count):
        phi = np.random.default_rng([seed + k, 36]).random(PLACES) * FULL_TURN
        for name, error in errors_of(random_cam(seed + k), phi).items():
            worst[name] = max(worst.get(name, 0.0), error)
    return worst


def main() -> None:
    """Print the worst errors of random cams under oscillating flat faces."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, default=300)
    chosen = parser.parse_args()
    worst = worst_errors(chosen.seed * 10_000, chosen.size)
    for name, error in worst.items():
        sys.stdout.write(f"{name}: {error:.2e}\n")
    sys.exit(not all(error <= TOLERANCE for error in worst.values()))


if __name__ == "__main__":
    main()
