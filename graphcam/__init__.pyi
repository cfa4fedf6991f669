# The public names.  Each stands here once: type checkers read this file, and so does graphcam when a name is used.
from .comparison.contact_elements import ElementContact as ElementContact, contact_by_elements as contact_by_elements
from .drafting.ink import Construction as Construction, Reading as Reading, Step as Step
from .drafting.pencil import Pencil as Pencil
from .drafting.scale import Scale as Scale
from .errors import DesignError as DesignError, GraphcamError as GraphcamError, TaskError as TaskError
from .given.boundary_motion import BoundaryMotion as BoundaryMotion, boundary_motion as boundary_motion
from .given.boundary_parts import MotionPoint as MotionPoint, PolynomialPart as PolynomialPart, SplinePart as SplinePart
from .given.cam_by_radii import ArcOutline as ArcOutline, cam_by_radii as cam_by_radii
from .given.follower import (
    FlatFaced as FlatFaced,
    Limits as Limits,
    Oscillating as Oscillating,
    OscillatingFlat as OscillatingFlat,
    Translating as Translating,
)
from .given.laws import LAWS as LAWS, law as law
from .given.making_errors import Deviations as Deviations, MakingErrors as MakingErrors
from .given.measured import (
    IntegratedMotion as IntegratedMotion,
    MeasuredMotion as MeasuredMotion,
    integrated_motion as integrated_motion,
    measured_motion as measured_motion,
)
from .given.monotone_spline import sampled_law as sampled_law
from .given.motion import (
    DegreesWarning as DegreesWarning,
    Dwell as Dwell,
    Motion as Motion,
    Return as Return,
    Rise as Rise,
    cam_angle as cam_angle,
)
from .given.motion_law import Law as Law
from .given.outline_motion import OutlineMotion as OutlineMotion, outline_motion as outline_motion
from .given.point_outline import (
    PointOutline as PointOutline,
    TracedMotion as TracedMotion,
    cam_through_points as cam_through_points,
)
from .given.polynomial_law import boundary_law as boundary_law, constant_velocity_law as constant_velocity_law
from .given.roller_contact import RollerContact as RollerContact
from .given.spring_load import (
    ArmLoad as ArmLoad,
    ArmSpring as ArmSpring,
    Guide as Guide,
    LoadCurve as LoadCurve,
    SpringLoad as SpringLoad,
)
from .mechanism.arc_motion import ArcMotion as ArcMotion
from .mechanism.cam import Cam as Cam, largest_roller as largest_roller
from .mechanism.conjugate_cam import ConjugateCam as ConjugateCam
from .mechanism.contact import (
    Contact as Contact,
    SpringPreload as SpringPreload,
    spring_preload as spring_preload,
)
from .mechanism.flat_faced import FaceWidth as FaceWidth, face_width as face_width
from .mechanism.follower_train import (
    FollowerTrain as FollowerTrain,
    TrainMotion as TrainMotion,
    VibratingFollower as VibratingFollower,
)
from .mechanism.forces import CamForces as CamForces, jamming_margin as jamming_margin, mean_torque as mean_torque
from .mechanism.hertz import (
    ContactStress as ContactStress,
    LineContact as LineContact,
    hertz_line_contact as hertz_line_contact,
)
from .mechanism.least_radius import (
    FlatMinimumRadius as FlatMinimumRadius,
    MinimumRadius as MinimumRadius,
    minimum_radius as minimum_radius,
)
from .mechanism.least_radius_lines import ArmMinimumRadius as ArmMinimumRadius
from .mechanism.made_cam import MadeCam as MadeCam
from .mechanism.motion_bands import MotionBands as MotionBands, motion_bands as motion_bands
from .mechanism.oscillating_flat import FaceReach as FaceReach, face_reach as face_reach
from .mechanism.profile_spline import ProfileSpline as ProfileSpline, profile_spline as profile_spline
from .mechanism.shock_response import (
    FollowerResponse as FollowerResponse,
    ShockSpectrum as ShockSpectrum,
    follower_response as follower_response,
    shock_spectrum as shock_spectrum,
)
from .mechanism.size_sensitivity import (
    Sensitivities as Sensitivities,
    radius_sensitivity as radius_sensitivity,
    sensitivities as sensitivities,
)
from .mechanism.sizing import SizedCam as SizedCam, size_cam as size_cam
from .mechanism.three_arc_cam import ThreeArcCam as ThreeArcCam, three_arc_cam as three_arc_cam
from .mechanism.three_point_circle import circumradius as circumradius
from .mechanism.undercut import Undercut as Undercut
from .report.sizing_sheet import sizing_sheet as sizing_sheet
from .solving.arcs_solution import ArcsSolution as ArcsSolution
from .solving.sizing_design import Sizing as Sizing, size_task as size_task
from .solving.solution import Solution as Solution
from .solving.solve import solve as solve
from .studio import studio as studio
from .sweeps.design_space import grid as grid
from .sweeps.designs import Designs as Designs
from .sweeps.sweep import Swept as Swept, sweep as sweep
from .tasks.arcs_task import ArcsTask as ArcsTask
from .tasks.task import Task as Task
from .tasks.task_file import (
    builtin_arcs_task as builtin_arcs_task,
    builtin_task as builtin_task,
    load_task as load_task,
)
from .workshop.written_profile import write_profile as write_profile

__version__: str
