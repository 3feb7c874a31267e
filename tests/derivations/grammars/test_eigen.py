# ruff: noqa: E501 -- programs stand on one line
"""Vectors and matrices of C++ that braces fill, and vectors of a size. The right one is correct, each slip wrong.

A cart of mass M that a force f drives, with a point m on a rod l, theta from down, by first principles:
[M + m, m l c; m l c, m l^2] [x'', theta''] = [f + m l s theta'^2, -m g l s], c and s of theta.
"""

import pytest

from furiko.derivations.grading.grade import grade_text

FILE = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'f'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[define]
'z[0]' = 'x'
'z[1]' = 'theta'
'z[2]' = "x'"
'z[3]' = "theta'"
[equations]
1 = '''
{}
'''
"""
BRACES = """Eigen::Vector4d rhs(const Eigen::Vector4d& z, double f) {
  const double c = std::cos(z[1]), s = std::sin(z[1]), w = z[3];
  Eigen::Matrix2d D{{M + m, m*l*c}, {m*l*c, m*l*l}};
  Eigen::Vector2d b{{f + m*l*s*w*w}, {-m*g*l*s}};
  Eigen::Vector4d d{z.size()};
  d.segment(0, 2) = z.segment(2, 2);
  d.segment(2, 2) = D.ldlt().solve(b);
  return d;
}"""
COLUMN = """Eigen::Vector4d rhs(const Eigen::Vector4d& z, double f) {
  auto qdot = z.tail(2);
  Eigen::Matrix<double, 2, 2> D{{M + m, m*l*cos(z[1])}, {m*l*cos(z[1]), m*l*l}};
  Eigen::Matrix<double, 2, 2> C{{0, -m*l*z[3]*sin(z[1])}, {0, 0}};
  Eigen::Matrix<double, 2, 1> G{{0}, {m*g*l*sin(z[1])}};
  Eigen::Matrix<double, 2, 1> B{{1}, {0}};
  Eigen::Vector2d a = D.inverse()*(B*f - C*qdot - G);
  Eigen::Vector4d d;
  d << z[2], z[3], a[0], a[1];
  return d;
}"""
SIZED = """Vector<double> rhs(double t, const Vector<double>& z, double f) {
  Vector<double> d(4);
  double s = sin(z[1]), c = cos(z[1]), w = z[3];
  d[0] = z[2];
  d[1] = z[3];
  d[2] = (f + m*l*s*w*w + m*g*s*c)/(M + m*s*s);
  d[3] = -(d[2]*c + g*s)/l;
  return d;
}"""
PROGRAMS = {
    "braces within braces": (BRACES, [("m*l*c}, {m*l*c", "m*l*s}, {m*l*s"), ("-m*g", "m*g"), ("s*w*w", "s*w"), ("M + m,", "M,")]),
    "columns": (COLUMN, [("- C*qdot", "+ C*qdot"), ("- G", "+ G"), ("{0, -m*l", "{0, m*l"), ("B{{1}, {0}}", "B{{0}, {1}}")]),
    "a vector of four": (SIZED, [("w*w", "w"), ("+ m*g", "- m*g"), ("d[2]*c + g*s", "d[2]*c - g*s")]),
}  # fmt: skip
SLIPS = [(text, *slip) for text, slips in PROGRAMS.values() for slip in slips]


@pytest.mark.parametrize("text", [p[0] for p in PROGRAMS.values()], ids=PROGRAMS)
def test_it_is_read(text):
    assert grade_text(FILE.format(text)).verdict == "correct"


@pytest.mark.parametrize(("text", "old", "new"), SLIPS)
def test_each_slip_is_wrong(text, old, new):
    assert old in text
    assert grade_text(FILE.format(text.replace(old, new, 1))).verdict == "wrong"
