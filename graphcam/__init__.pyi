# The public names.  Each stands here once: type checkers read this file, and so does graphcam when a name is used.
from .drafting.ink import Construction as Construction
from .drafting.ink import Reading as Reading
from .drafting.ink import Step as Step
from .drafting.pencil import Pencil as Pencil
from .drafting.scale import Scale as Scale
from .errors import DesignError as DesignError
from .errors import GraphcamError as GraphcamError
from .errors import TaskError as TaskError
from .given.follower import FlatFaced as FlatFaced
from .given.follower import Oscillating as Oscillating
from .given.follower import Translating as Translating
from .given.guide import Guide as Guide
from .given.laws import LAWS as LAWS
from .given.laws import law as law
from .given.measured import (
    IntegratedMotion as IntegratedMotion,
)
from .given.measured import (
    MeasuredMotion as MeasuredMotion,
)
from .given.measured import (
    integrated_motion as integrated_motion,
)
from .given.measured import (
    measured_motion as measured_motion,
)
from .given.motion import Dwell as Dwell
from .given.motion import Motion as Motion
from .given.motion import Return as Return
from .given.motion import Rise as Rise
from .given.motion import cam_angle as cam_angle
from .given.spring_load import SpringLoad as SpringLoad
from .mechanism.arc_motion import ArcMotion as ArcMotion
from .mechanism.arcs import ThreeArcCam as ThreeArcCam
from .mechanism.arcs import three_arc_cam as three_arc_cam
from .mechanism.cam import Cam as Cam
from .mechanism.cam import largest_roller as largest_roller
from .mechanism.contact import Contact as Contact
from .mechanism.contact import SpringPreload as SpringPreload
from .mechanism.contact import spring_preload as spring_preload
from .mechanism.flat_faced import FaceWidth as FaceWidth
from .mechanism.flat_faced import face_width as face_width
from .mechanism.forces import CamForces as CamForces
from .mechanism.hertz import (
    ContactStress as ContactStress,
)
from .mechanism.hertz import (
    LineContact as LineContact,
)
from .mechanism.hertz import (
    RollerContact as RollerContact,
)
from .mechanism.hertz import (
    hertz_line_contact as hertz_line_contact,
)
from .mechanism.least_radius import (
    FlatMinimumRadius as FlatMinimumRadius,
)
from .mechanism.least_radius import (
    MinimumRadius as MinimumRadius,
)
from .mechanism.least_radius import (
    minimum_radius as minimum_radius,
)
from .mechanism.least_radius_arm import ArmMinimumRadius as ArmMinimumRadius
from .mechanism.sizing import SizedCam as SizedCam
from .mechanism.sizing import size_cam as size_cam
from .mechanism.spline import ProfileSpline as ProfileSpline
from .mechanism.spline import profile_spline as profile_spline
from .mechanism.three_points import circumradius as circumradius
from .mechanism.undercut import Undercut as Undercut
from .report.sizing_sheet import sizing_sheet as sizing_sheet
from .solving.arcs_solution import ArcsSolution as ArcsSolution
from .solving.solution import Solution as Solution
from .solving.solve import solve as solve
from .sweeps.designs import Designs as Designs
from .sweeps.sweep import sweep as sweep
from .tasks.arcs_task import ArcsTask as ArcsTask
from .tasks.task import Task as Task
from .tasks.task_file import (
    builtin_arcs_task as builtin_arcs_task,
)
from .tasks.task_file import (
    builtin_task as builtin_task,
)
from .tasks.task_file import (
    load_task as load_task,
)

__version__: str
