"""Kinds that the tenth collection showed: names that are no accelerations though they could be, rows where nothing
moves."""

import pytest

from furiko.derivations.grading.grade import grade_fields
from furiko.models.errors import InvalidInput

ARM = {
    "system": "mechanism",
    "bodies": [
        {"coordinate": "theta1", "mass": "m1", "length": "L1"},
        {"coordinate": "theta2", "mass": "m2", "length": "L2", "drive": "u"},
    ],
}
NOT_FOLLOWED = {  # alpha1 and alpha2 are parts of the inertias; how the accelerations come about is not followed
    "python": """
def rhs(t, y):
    theta1, theta2, w1, w2 = y
    alpha1 = (m1 + m2)*L1**2
    alpha2 = m2*L2**2
    m11 = alpha1 + alpha2 + 2*m2*L1*L2*np.cos(theta2)
    dd = odd.backsolve(np.array([[m11, alpha2], [alpha2, alpha2]]), y)
    return np.vstack((w1, w2, dd))
""",
    "handed over": """
def rhs(t, y):
    theta1, theta2, w1, w2 = y
    alpha1 = (m1 + m2)*L1**2
    alpha2 = m2*L2**2
    dd = backsolve(alpha1, alpha2, y)
    return np.vstack((w1, w2, dd))
""",
    "c": """
void deriv(const double x[4], double u, double dx[4]) {
  double theta1 = x[0], theta2 = x[1], w1 = x[2], w2 = x[3];
  double alpha1 = (m1 + m2)*L1*L1;
  double alpha2 = m2*L2*L2;
  double m11 = alpha1 + alpha2 + 2*m2*L1*L2*cos(theta2);
  solve_somehow(m11, alpha2, w1, w2, u, dx);
}""",
    "javascript": """
function step(s, u) {
  const { theta1, theta2, omega1, omega2 } = s;
  const alpha1 = (m1 + m2)*L1*L1;
  const alpha2 = m2*L2*L2;
  const m11 = alpha1 + alpha2 + 2*m2*L1*L2*Math.cos(theta2);
  const dd = math.lusolve([[m11, alpha2],[alpha2, alpha2]], [u, omega1]);
  return rk(dd);
}""",
    "julia": """
function rhs!(du, u, p, t)
    theta1, theta2, w1, w2 = u
    alpha1 = (m1 + m2)*L1^2
    alpha2 = m2*L2^2
    M = [alpha1 + alpha2 alpha2; alpha2 alpha2]
    dd = special_solve(M, [w1, w2])
    du .= vcat([w1, w2], dd)
end""",
    "matlab": """
function dx = rhs(t, x)
  theta1 = x(1); theta2 = x(2); w1 = x(3); w2 = x(4);
  alpha1 = (m1 + m2)*L1^2;
  alpha2 = m2*L2^2;
  M = [alpha1 + alpha2, alpha2; alpha2, alpha2];
  dd = mysolve(M, [w1; w2]);
  dx = [w1; w2; dd];
end""",
}


@pytest.mark.parametrize("language", NOT_FOLLOWED)
def test_parts_of_an_inertia_are_no_accelerations_whatever_they_are_called(language):
    with pytest.raises(InvalidInput):
        grade_fields({"equations": NOT_FOLLOWED[language], **ARM})


@pytest.mark.parametrize("inverse", ["inv", "pinv", "pinv2", "pinvh"])
def test_accelerations_by_a_pseudo_inverse_are_followed_beside_such_names(inverse):
    text = f"""
def rhs(t, y):
    theta1, theta2, w1, w2 = y
    alpha1 = (m1 + m2)*L1**2
    alpha2 = m2*L2**2
    alpha3 = m2*L1*L2*np.cos(theta1 - theta2)
    M = np.array([[alpha1, alpha3], [alpha3, alpha2]])
    h = np.array([[m2*L1*L2*w2**2*np.sin(theta1 - theta2) + (m1 + m2)*g*L1*np.sin(theta1) + u],
                  [-m2*L1*L2*w1**2*np.sin(theta1 - theta2) + m2*g*L2*np.sin(theta2) - u]])
    dd = -np.dot(scipy.linalg.{inverse}(M), h)
    return np.vstack((np.array([[w1], [w2]]), dd))
"""
    assert grade_fields({"equations": text, **ARM, "angles": "absolute"}).verdict == "correct"


@pytest.mark.parametrize("row", ["m = 0.2", "0 = 1", "l^2 = 4 m/g"])
def test_a_row_in_which_nothing_moves_is_no_wrong_equation_of_motion(row):
    with pytest.raises(InvalidInput, match=r"equations\.1: nothing that moves is in it"):
        grade_fields({"system": "simple-pendulum", "equations": {"1": row}})
    with pytest.raises(InvalidInput, match="nothing that moves is in it"):
        grade_fields({"system": "simple-pendulum", "equations": [f"{row};"]})
