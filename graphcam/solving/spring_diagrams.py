"""What a spring does over the turn, as diagrams: the contact function, and the forces at the cam with their torque."""

from collections.abc import Callable
from functools import partial
from typing import Literal

from graphcam.drafting.ink import Caption, say
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.scale import unit
from graphcam.given.laws import Floats
from graphcam.given.spring_load import ArmLoad, SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.contact import Contact
from graphcam.mechanism.forces import CamForces, jamming_margin
from graphcam.mechanism.turn_extremes import Places, TurnCurve, ValueAt, over_turn
from graphcam.solving.turn_diagrams import TurnDiagram

CONTACT_MEANING = Meaning(
    "contact",
    say("Contact force"),
    say("A spring presses the follower onto the cam. A cam cannot pull: where it would have to, contact is lost."),
)
FORCES_MEANING = Meaning(
    "turn_forces",
    say("Forces over the turn"),
    say(
        "The cam pushes along the normal, so the contact force is larger than the force that moves the follower; "
        "its lever arm about the cam centre makes the torque on the shaft."
    ),
)
CONTACT_CAPTIONS = {
    (True, "lost"): say(
        "{formula} is the force with which the cam pushes the follower, at {mu:g} N/mm. Where it is negative, as "
        "marked on the axis, the cam would have to pull: contact is lost."
    ),
    (True, "kept"): say(
        "{formula} is the force with which the cam pushes the follower, at {mu:g} N/mm. It is nowhere negative: "
        "contact is kept."
    ),
    (False, "lost"): say(
        "{formula} is the torque about the pivot with which the cam pushes the arm, at {mu:g} N·mm/mm. Where it "
        "is negative, as marked on the axis, the cam would have to pull: contact is lost."
    ),
    (False, "kept"): say(
        "{formula} is the torque about the pivot with which the cam pushes the arm, at {mu:g} N·mm/mm. It is "
        "nowhere negative: contact is kept."
    ),
    (True, "idle"): say(
        "{formula} is the force with which the cam pushes the follower, at {mu:g} N/mm. It is nowhere negative, but "
        "with F₀ = 0 it is zero during the whole lower dwell: in practice choose a preload greater than zero."
    ),
    (False, "idle"): say(
        "{formula} is the torque about the pivot with which the cam pushes the arm, at {mu:g} N·mm/mm. It is nowhere "
        "negative, but with F₀ = 0 it is zero during the whole lower dwell: in practice choose a preload greater than "
        "zero."
    ),
}
"""What is said of the contact function, of a force or a torque, where contact is lost, kept, or kept by nothing."""
IDLE_CAPTION = say(
    "With F₀ = 0 the contact force is zero during the whole lower dwell; in practice choose a preload greater than "
    "zero."
)
TRANSMISSION_CAPTIONS = {
    "stem": say(
        "τ = cos α − f₁ sin α, with f₁ = {friction:g} at the cam, is the part of the normal force that moves the "
        "follower, at {mu:g}/mm. Where it falls to zero the follower jams."
    ),
    "arm": say(
        "τ, the lever of the normal force with its friction f₁ = {friction:g} about the pivot, in lengths of the arm, "
        "is the part of it that moves the arm, at {mu:g}/mm. Where it falls to zero the arm jams."
    ),
    "swinging face": say(
        "τ, the lever of the normal force with its friction f₁ = {friction:g} about the pivot, in distances of the "
        "contact from there, is the part of it that moves the face, at {mu:g}/mm. Where it falls to zero the face jams."
    ),
}
"""What is said of the transmission coefficient, by what the normal force moves."""


NORMAL_FORMULAS = {
    ("stem", False): "ξ/cos α",
    ("stem", True): "ξ/(cos α − f₁ sin α)",
    ("arm", False): "ξ/(l cos α)",
    ("arm", True): "ξ/(l cos α − σf₁(l sin α − r))",
    ("swinging face", False): "ξ/q",
    ("swinging face", True): "ξ/(q + σf₁f)",
}
"""The normal force by what it moves, and whether there is friction at the cam."""


def _pressing(load: SpringLoad | ArmLoad) -> str:
    outer, damped = bool(load.load), " + dvω" if load.damping else ""
    if isinstance(load, SpringLoad):
        return f"m(aω² + vε) + F₀ + cs{damped}" + (" + P" if outer else "")
    spring = "F₀ + cs" if load.at is None else "(F₀ + cx)·dx/ds"
    return f"J(aω² + vε) + {spring}{damped}" + (" + lP" if outer else "")


def with_unit(value: float, of: str) -> Caption:
    """A force or a torque with its unit."""
    # No powers of ten: four digits, and zeros.
    return say("{value:.12g} {unit}", value=float(f"{value:.4g}"), unit=unit(of))


def contact_diagram(contact: Contact, load: SpringLoad | ArmLoad, *, idle: bool) -> TurnDiagram:
    """The contact function xi(phi) of Voloder, Cohodar and Karic, with its least value and where it is negative.

    idle : whether nothing presses in the lower dwell, though contact is kept
    """
    along = "N" if isinstance(load, SpringLoad) else "N·mm"
    curve, least, lost = contact.curve(), contact.min_force(), tuple(contact.lost())
    said = CONTACT_CAPTIONS[along == "N", "lost" if lost else "idle" if idle else "kept"]
    return TurnDiagram(
        "contact",
        say("The contact function"),
        say("Contact force ξ, μ_ξ = {mu:g} N/mm") if along == "N" else say("Contact torque ξ, μ_ξ = {mu:g} N·mm/mm"),
        say("ξ, {unit}", unit=unit(along)),
        along,
        contact.motion,
        TurnCurve(curve.phi, curve.force),
        said.with_values(formula=f"ξ = {_pressing(load)}"),
        marked=((least, with_unit(without_rounding(least.value), along)),),
        wrong=lost,
    )


def force_diagrams(
    forces: CamForces, max_normal: ValueAt, torques: tuple[float, ValueAt, ValueAt]
) -> list[TurnDiagram]:
    """The transmission coefficient, where there is a pressure angle, the normal force and the torque over the turn.

    max_normal : the greatest force along the normal [N]
    torques : the mean torque on the cam [N mm], the greatest and the least
    """
    cam, friction, moved = forces.cam, forces.friction, moved_part(forces.cam)
    motion, (mean, most_torque, min_torque) = cam.motion, torques
    margin = jamming_margin(cam, friction)

    def drawn(quantity: Callable[[Places], Floats]) -> TurnCurve:
        """The curve of a quantity over the turn."""
        return over_turn(motion, quantity, forces.pressing.knots)

    make = partial(TurnDiagram, motion=motion)
    sliding = make(
        "transmission",
        say("The transmission coefficient"),
        say("Transmission coefficient τ, μ_τ = {mu:g}/mm"),
        say("τ"),
        "",
        curve=drawn(lambda places: forces.of(places).transmission),
        caption=TRANSMISSION_CAPTIONS[moved].with_values(friction=friction),
        why=say("The normal makes the angle α with the motion, and friction acts along the profile."),
        marked=((margin, say("{value:.3f}", value=margin.value)),),
    )
    normal = make(
        "normal_force",
        say("The normal force"),
        say("Normal force N, μ_N = {mu:g} N/mm"),
        say("N, {unit}", unit=unit("N")),
        "N",
        curve=drawn(forces.normal),
        caption=say(
            "N = {formula} is the force along the normal, at {mu:g} N/mm. Its maximum is {greatest}.",
            formula=NORMAL_FORMULAS[moved, bool(friction)],
            greatest=with_unit(max_normal.value, "N"),
        ),
        why=say("Along the motion only a part of the normal force acts."),
        marked=((max_normal, with_unit(max_normal.value, "N")),),
    )
    peak = max(most_torque, min_torque, key=lambda found: abs(found.value))
    torque = make(
        "torque",
        say("The torque on the cam"),
        say("Torque M, μ_M = {mu:g} N·mm/mm"),
        say("M, {unit}", unit=unit("N·mm")),
        "N·mm",
        curve=drawn(forces.torque),
        caption=say(
            "M is the torque that drives the cam, at {mu:g} N·mm/mm; where it is negative the follower drives the "
            "cam. Its peak is {peak} and its mean {mean}.",
            peak=with_unit(peak.value, "N·mm"),
            mean=with_unit(without_rounding(mean), "N·mm"),
        ),
        why=say("The power of the shaft equals that of the follower and of friction."),
        marked=((peak, with_unit(peak.value, "N·mm")),),
    )
    return [sliding, normal, torque] if cam.kinematics.has_pressure_angle else [normal, torque]


def moved_part(cam: Cam) -> Literal["stem", "arm", "swinging face"]:
    """What the normal force moves: it has a lever of its own there."""
    kin = cam.kinematics
    return "stem" if not kin.swings else "arm" if kin.takes_roller else "swinging face"


def without_rounding(force: float) -> float:
    """A force without the rounding that is left where it is zero."""
    return round(force, 9) + 0.0
