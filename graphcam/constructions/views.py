"""The drawings on the sheet, and which axes they share."""

from dataclasses import replace

from graphcam.drafting.ink import View, say
from graphcam.drafting.scale import Scale, ratio_text

ACCELERATION = View(
    "acceleration", say("Acceleration"), across="phi", up="a", scale=say("Acceleration a, μₐ = {mu:.4g} ({unit})/mm")
)
JERK = View("jerk", say("Jerk"), across="phi", up="j", scale=say("Jerk j, μⱼ = {mu:.4g} ({unit})/mm"))
VELOCITY = View("velocity", say("Velocity"), across="phi", up="v", scale=say("Velocity v, μᵥ = {mu:.4g} ({unit})/mm"))
DISPLACEMENT = View(
    "displacement", say("Displacement"), across="phi", up="s", scale=say("Displacement s, μₛ = {mu:.4g} {unit}/mm")
)
ANGLE = View(
    "angle", say("Pressure angle"), across="phi", up="alpha", scale=say("Pressure angle α, μ_α = {degrees:g}°/mm")
)
MINIMUM_RADIUS = say("Minimum radius")
"""The title of the combined diagram where it has a drawing scale of its own."""
COMBINED = View(
    "combined",
    say("Displacement and velocity: the minimum radius"),
    across="offset",
    up="s",
    # Blank as a whole, so that a worksheet does not tell whether the region is large enough for a scale of its own.
    blank=say("μₛ = {mu:.4g} {unit}/mm"),
    scale=say("Minimum radius, μₛ = {mu:.4g} {unit}/mm"),
)
PLAN = View("plan", say("Velocity plan"), across="plan", up="plan")
PROFILE = View(
    "profile", say("Cam profile by inversion"), across="cam x", up="cam y", scale=say("Cam profile, {ratio}"), main=True
)
ANALYSIS = View("analysis", say("Given cam"), across="analysis x", up="analysis y")
CURVATURE = View("curvature", say("Centre of curvature"), across="detail x", up="detail y")
SCHEME = View("scheme", say("Kinematic diagram"), across="scheme x", up="scheme y")
REGION = View("region", say("Arm positions: the minimum radius"), across="region x", up="region y")
ARM_ANGLES = View("arm angles", say("Pressure angles of the arm"), across="angles x", up="angles y")
CAM_CENTRE = View("cam centre", say("Cam centre"), across="cam centre x", up="cam centre y")
FORCES = View("forces", say("Force plan"), across="forces", up="forces")


def at_scale(view: View, scale: Scale) -> View:
    """A view whose title says its drawing scale.

    >>> import graphcam as gc
    >>> str(at_scale(PLAN, gc.Scale(2.0, "mm")).title)
    'Velocity plan, 1:2'
    """
    title = say("{title}, {ratio}", title=view.title, ratio=ratio_text(scale.per_mm))
    return replace(view, title=title, mu_l=scale.per_mm)
