"""Where what belongs to a step stands in arrays: for those who make them, and for the compiled code."""

from __future__ import annotations

DONE, MORE, BROKEN = 0, 1, 2  # what a run says: at its end, out of budget, too fast ever to get there
# columns of the state, one row a link: angle and rate as sums of two numbers, and whole turns taken off the angle
ANGLE, ANGLE_LOW, RATE, RATE_LOW, TURNS, STATE = range(6)
# columns of the factors of a step, one row a link; gravity stands in the first row
MASS, LENGTH, INVERSE, GRAVITY, SIN, COS, A, B, KAPPA, KC = range(10)
KB, KM, M12, M22, UP_W, ACROSS_W, ACROSS_R, WP_R, FACTORS = range(10, 19)
# Of trajectories in lanes
IDLE = -1
TRAJECTORY, WRITTEN, DUE, NEXT, LANE_ROWS = range(5)  # rows of lanes; in NEXT: the next start, a broken trajectory
TIME, TIME_LOW, STEP, AHEAD, CLOCK = range(5)  # rows of the clock
TURNED, SPED, DIFFERENCE = range(3)  # rows of a difference: δθ [rad], δω [rad/s]
RATE_SCALE, TAKEN_OUT, SIZE, SCALES = range(4)  # rows of the scales: the unit of δω [rad/s], ln of sizes, the last size
