"""Tanglebin: simulate, scan, model and score tubes in bins.

SI units everywhere: metres, kilograms, seconds, radians. World frame: z up, origin at the centre of the bin's floor, x
along its length. Camera frame: x right, y down, z along the view. Labels: 0 is the bin, 1 to n are the tubes, -1 is
null. Poses are 4 x 4 matrices, points n x 3, images h x w.
"""

from tanglebin._core import *  # noqa: F403
from tanglebin._core import __version__ as __version__
from tanglebin._dataset import Case as Case
from tanglebin._dataset import Dataset as Dataset
