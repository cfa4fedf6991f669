"""The profile of an oscillating follower by inversion: the pivot goes round the cam, against the cam's rotation."""

import math
from dataclasses import dataclass

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.arm_positions import arc_through, cam_centre, example_station, turning_angle
from graphcam.constructions.axes import number_labels, station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import RIGHT, UP, circle_crossing, unit
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import Construction, Part, Step, Words, say
from graphcam.drafting.marks import Role
from graphcam.drafting.meaning import ARM, DISTANCE, PSI0, RADIUS, Formula, Meaning, S, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, Scale
from graphcam.drafting.telling import STATION, circle_caption, no_setting, run
from graphcam.given.follower import Rotation
from graphcam.words import say_in


@dataclass(frozen=True, eq=False)
class ArmInversionGivens(profile_view.InvertedGivens):
    """What lies on the board; see :func:`arm_inversion`."""

    arm: float
    distance: float


ArmInverted = Construction[ArmInversionGivens]


def _worked_values(inverted: ArmInverted) -> Values:
    """The formula's values: the polar radius at the worked station."""
    givens, stations = inverted.givens, inverted.givens.integrated.givens.stations
    k, arm, c = profile_view.worked_station(stations), givens.arm, givens.distance
    s, psi0 = float(givens.integrated.value("s")[k]), float(np.angle(-cam_centre(arm, c, givens.prime_radius)))
    radius = math.sqrt(arm**2 + c**2 - 2 * arm * c * math.cos(psi0 + s))
    angles = {"psi0": math.degrees(psi0), "s": math.degrees(s)}
    yield {"k": station_names(stations)[k], "l": arm, "c": c, **angles, "radius": radius}


FORMULAS = (
    Formula(
        r"R = \sqrt{l^2 + c^2 - 2lc\cos(\psi_0 + s)}",
        r"R_{<k>} = \sqrt{<l:.6g>^2 + <c:.6g>^2 - 2 \cdot <l:.6g> \cdot <c:.6g>\cos(<psi0:.3f>^\circ + <s:.3f>^\circ)}"
        r" = <radius:.2f>\ \text{<mm>}",
        _worked_values,
        (RADIUS, ARM, DISTANCE, PSI0, S),
        of="radius",
    ),
)


MEANING = Meaning(
    "inversion",
    say("Pitch curve by inversion"),
    say(
        "The cam is held still and the frame is turned about it, against the cam's rotation. From each position "
        "of the pivot the arm is turned by its displacement: the positions of its end give the cam."
    ),
    profile_view.CURVE_MEANINGS,
    FORMULAS,
    scales={"profile": "x"},
)


def arm_inversion(
    integrated: Integrated,
    rotation: Rotation,
    prime_radius: float,
    arm: float,
    distance: float,
    mu_l: Scale,
    pencil: Pencil,
) -> ArmInverted:
    """Step the pivot off on its circle, swing the arm to the prime circle, and turn it by the displacement.

    integrated : of an angle s [rad];  mu_l : drawing scale of the profile [mm/mm]
    """
    hand, s = Hand(pencil, MEANING), integrated.readings["s"]
    prime = profile_view.prime_circle(hand, prime_radius, mu_l)
    circle = hand.circle("pivot circle", hand.given("cam centre"), distance / mu_l.per_mm)
    pivots = hand.cross("pivots", profile_view.inverted_positions(hand, integrated, rotation, RIGHT), circle)
    arcs = hand.circle("arcs of the arm", pivots, arm / mu_l.per_mm)
    # To the left of the way from the cam centre to the pivot: above the line of centres.
    # Where a triangle has these sides, circles that miss one another by a hand's errors are taken to touch.
    closes = bool(np.isfinite(circle_crossing(np.asarray(0j), prime_radius, np.asarray(distance + 0j), arm)))
    starts = hand.cross("starts", prime, arcs, flat=closes)
    swung = hand.protractor("swung", pivots, hand.join("arms at rest", pivots, starts), hand.carry(s, -s.scale))
    pitch = hand.cross("pitch", swung, arcs)
    motion = hand.perpendicular("motion", hand.join("arms", pivots, pitch).turned(-1), pitch)
    profile_view.curve_readings(hand, pitch, mu_l)
    givens = ArmInversionGivens(integrated, rotation, prime_radius, mu_l, arm, distance)
    places = {"pivots": pivots, "starts": starts, "pitch": pitch, "motion": unit(motion.directions)}
    return hand.finished(givens, _draw, places)


# --- the steps -------------------------------------------------------------------------------------------------------

ARC_OVERHANG = 0.012
"""How far the arcs of the arm are drawn beyond what is found on them [rad]."""


def _draw(inverted: ArmInverted) -> list[Step]:
    return [
        _circles(inverted),
        pivots_step(inverted),
        _starts(inverted),
        *profile_view.pitch_steps(inverted, _turned_arms_step(inverted)),
    ]


def _circles(inverted: ArmInverted) -> Step:
    mu_l, c = inverted.givens.mu_l.per_mm, inverted.givens.distance
    start, circle = profile_view.start_of_turn(inverted), inverted.acts["pivot circle"]
    pivots = circle_caption(say_in("drawn", "the circle of the pivot about A"), "c", c, mu_l)
    title, circles = say("Prime circle and pivot circle"), (circle.drawn_circle(Role.CONSTRUCTION),)
    why = say("The pivot stays at the centre distance from A, and the lift starts at the prime circle.")
    return profile_view.prime_step(inverted, title, start, circles, why=why, parts=(Part(pivots, (circle,)),))


def pivots_step(inverted: profile_view.Inverted) -> Step:
    """The step that steps the pivot off on its circle."""
    pivots, positions = (inverted.acts[name] for name in ("pivots", "inverted positions"))
    stations = inverted.givens.integrated.givens.stations
    said = say(
        "The cam turns {rotation}; hold it still and step the pivot round A the other way, {against}. Set the "
        "protractor on A and count {against} from the horizontal to the right of A, from station to station {steps}, "
        "so station {name} at {angle}; mark and number the pivots on their circle."
    ).with_values(**profile_view.position_words(inverted))
    first = pivots.first[0]
    marks = (
        *(pivots.dots(Role.CONSTRUCTION), first.label("C", UP * first.place)),
        *number_labels(pivots, stations, pivots.shown),
    )
    why = say("The frame, seen from the cam, turns against the cam's rotation, and the pivot turns with it.")
    stepped = run(said, STATION, station_names(stations), positions, pivots)
    return Step(say("Inverted positions of the pivot"), (stepped,), PROFILE, marks, why=why)


def _starts(inverted: ArmInverted) -> Step:
    integrated, starts, arcs = inverted.givens.integrated, inverted.acts["starts"], inverted.acts["arcs of the arm"]
    names, k = station_names(integrated.givens.stations), example_station(integrated, inverted.acts["pivots"])
    arm, pitch = inverted.givens.mu_l.paper(inverted.givens.arm), inverted.acts["pitch"]
    said = say(
        "Set the compass to the arm, {arm:.1f} mm. From every pivot strike an arc across the prime circle, always at "
        "the crossing on the left as seen from A towards the pivot, and continue a little outside: from C{name} to "
        "B₀{name}."
    ).with_values(arm=arm, name=names[k])
    found = np.stack([starts.shown, pitch.shown], axis=-1)
    drawn = [arc_through(arcs[n], found[n], ARC_OVERHANG) for n in range(len(names))]
    struck = run(said, STATION, names, arcs, starts, settings=no_setting)
    marks = (*drawn, starts.dots(Role.CONSTRUCTION))
    why = say("At the start of the lift the end of the arm lies on the prime circle, in every position of the frame.")
    return Step(say("Arcs of the arm"), (struck,), PROFILE, marks, why=why)


def _turned_arms_step(inverted: ArmInverted) -> Step:
    integrated, arms, pitch = inverted.givens.integrated, inverted.acts["arms"], inverted.acts["pitch"]
    names, k = station_names(integrated.givens.stations), example_station(integrated, inverted.acts["pivots"])
    s, factor = integrated.first("s"), np.degrees(integrated.readings["s"].per_mm)
    chords = 2 * inverted.givens.mu_l.paper(inverted.givens.arm) * np.sin(np.abs(np.radians(s * factor)) / 2)

    def turn(n: int) -> Words:
        """The angle of station n, and its chord on paper."""
        angle = turning_angle(s[n], factor)
        return (
            say("{angle}, a chord of {chord:.2f} mm", angle=angle, chord=chords[n])
            if chords[n] > NEGLIGIBLE_SIZE
            else angle
        )

    said = say(
        "Turn every arm about its pivot from the prime circle by the displacement, away from A (clockwise on the "
        "paper), with the protractor or, with dividers, by the chord of its arc. Station {name}: from B₀{name} along "
        "the arc about C{name} {turn}; mark the end {name} and draw the arm. The ends are points of the pitch curve."
    ).with_values(name=names[k], turn=turn(k))
    swung = run(said, STATION, names, arms, pitch, settings=turn)
    why = say("The displacement of an arm is the angle through which it has turned from its lowest position.")
    title, marks = say("Arms turned by the displacement"), (arms.segments(Role.CONSTRUCTION),)
    return Step(title, (swung,), PROFILE, marks, profile_view.CURVE_READINGS, why=why)
