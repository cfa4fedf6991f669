"""The main job: from a task to a solution, and from a solution to its files."""

from graphcam.main_job.arcs import ArcsSolution
from graphcam.main_job.kinds import sheet_of, solve, worksheet
from graphcam.main_job.output import check_papers, write
from graphcam.main_job.solution import Solution

__all__ = ["ArcsSolution", "Solution", "check_papers", "sheet_of", "solve", "worksheet", "write"]
