"""The theory of mechanisms in space from positions alone: power series of where bodies are, in balls.

No formula for a velocity, an acceleration or a Jacobian: the pose of each body is a series in time along a motion, or
in a small displacement, to the second order, and d'Alembert's principle is a sum over the body's matter,
Σ dm δX·(Ẍ − g) with X = H (r, 1), which its second moments J = Σ dm (r, 1)(r, 1)ᵀ make tr(δH J Ḧᵀ).
"""

import numpy as np
from flint import arb, arb_mat, arb_series, ctx

ORDERS = 3  # of each series: t⁰, t¹, t²


def times(a, b):
    """The product of two series of matrices."""
    return [sum((a[i] * b[k - i] for i in range(k + 1)), arb_mat(a[0].nrows(), b[0].ncols())) for k in range(ORDERS)]


def constant(matrix):
    return [matrix, *[arb_mat(matrix.nrows(), matrix.ncols())] * (ORDERS - 1)]


def homogeneous(rotation, place):
    rows = [[rotation[i, k] for k in range(3)] + [place[i]] for i in range(3)]
    return arb_mat([*rows, [0, 0, 0, 1]])


def skew(v):
    return arb_mat([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


ONE = arb_mat([[1, 0, 0], [0, 1, 0], [0, 0, 1]])
NOWHERE = [arb(0)] * 3


def of_quaternion(q):
    w, *r = map(arb, q)
    k = skew(r)
    return ONE + 2 * (k * w + k * k) / (w * w + sum((x * x for x in r), arb(0)))


def shifted(way):
    """The series of a translation, from three lists of coefficients."""
    middle = [homogeneous(ONE, [w[0] for w in way])]
    return middle + [homogeneous(arb_mat(3, 3), [w[k] for w in way]) - zero_corner() for k in (1, 2)]


def zero_corner():
    return arb_mat([[0] * 4] * 3 + [[0, 0, 0, 1]])


def turned(rotation):
    """The series of a rotation about the origin, from that of its matrix."""
    rest = [homogeneous(part, NOWHERE) - zero_corner() for part in rotation[1:]]
    return [homogeneous(rotation[0], NOWHERE), *rest]


def exponential(v, a):
    """exp [v t + a t²/2]×, to the second order."""
    first, second = skew(v), skew(a) / 2
    return [ONE, first, second + first * first / 2]


def joint_series(joint, q, v, a):
    """Where the joint takes a body's frame, q running with these rates and accelerations."""
    if joint.kind == "free":
        way = [[arb(x), w, b / 2] for x, w, b in zip(q[:3], v[:3], a[:3], strict=True)]
        spin = times(constant(of_quaternion(q[3:])), exponential(v[3:], a[3:]))
        return times(shifted(way), turned(spin))
    axis = list(map(arb, joint.axis.tolist()))
    length = sum((x * x for x in axis), arb(0)).sqrt()
    if joint.kind == "slide":
        here = arb(q[0]) - arb(joint.ref)
        return shifted([[x / length * part for part in (here, v[0], a[0] / 2)] for x in axis])
    if joint.kind == "ball":
        spin = times(constant(of_quaternion(q)), exponential(v, a))
    else:
        ctx.cap = ORDERS
        angle = arb_series([arb(q[0]) - arb(joint.ref), v[0], a[0] / 2])
        sine, cosine = angle.sin(), angle.cos()
        k = skew([x / length for x in axis])
        spin = [
            k * sine[i] + k * k * ((1 if i == 0 else 0) - cosine[i]) + (ONE if i == 0 else ONE * 0) for i in (0, 1, 2)
        ]
    anchor = joint.anchor.tolist()
    there, back = homogeneous(ONE, anchor), homogeneous(ONE, [-x for x in anchor])
    return times(times(constant(there), turned(spin)), constant(back))


def pose_series(mechanism, q, v, a):
    """H(t) of each body, (4, 4) series."""
    found = []
    at = {}
    for placed in mechanism.joints:
        at.setdefault(placed.body, []).append(placed)
    for index, body in enumerate(mechanism.bodies):
        parent = constant(homogeneous(ONE, NOWHERE)) if body.parent < 0 else found[body.parent]
        pose = homogeneous(of_quaternion(body.quaternion.tolist()), body.position.tolist())
        here = times(parent, constant(pose))
        for placed in at.get(index, []):
            moved = joint_series(placed.joint, q[placed.columns_q], v[placed.columns_v], a[placed.columns_v])
            here = moved if placed.joint.kind == "free" else times(here, moved)
        found.append(here)
    return found


def second_moments(inertial):
    tensor = arb_mat(inertial.tensor.tolist())
    tensor = (tensor + tensor.transpose()) / 2
    m, c = arb(inertial.mass), arb_mat(3, 1, inertial.centre.tolist())
    spread = ONE * (tensor.trace() / 2) - tensor + c * c.transpose() * m
    moment = c * m
    return arb_mat([[spread[i, k] for k in range(3)] + [moment[i, 0]] for i in range(3)] + [[*moment.entries(), m]])


class Positions:
    """Mass matrix, bias and passive forces of one state, at the precision that is set."""

    def __init__(self, mechanism, q, v):
        self.mechanism, self.q, self.v = mechanism, q.tolist(), list(map(arb, v.tolist()))
        n = mechanism.nv
        self.rest = [arb(0)] * n
        units = [[arb(int(i == j)) for i in range(n)] for j in range(n)]
        self.moments = [second_moments(body.inertial) for body in mechanism.bodies]
        self.shifts = [[h[1] for h in pose_series(mechanism, self.q, unit, self.rest)] for unit in units]
        self.units = units

    def forces(self, v, a, gravity):
        """Σ dm δX·(Ẍ − g) for each freedom's displacement."""
        poses = [h[2] * 2 for h in pose_series(self.mechanism, self.q, v, a)]
        fall = arb_mat([[0, 0, 0, x] for x in gravity] + [[0] * 4])  # g of every point of matter
        rows = []
        for shift in self.shifts:
            each = zip(shift, self.moments, poses, strict=True)
            rows.append(sum(((d * j * (h - fall).transpose()).trace() for d, j, h in each), arb(0)))
        return rows

    def mass_matrix(self):
        armature = self.mechanism.per_freedom("armature").tolist()
        columns = [self.forces(self.rest, unit, [0, 0, 0]) for unit in self.units]
        n = len(columns)
        return [[columns[j][i] + (armature[i] if i == j else 0) for j in range(n)] for i in range(n)]

    def bias(self):
        return self.forces(self.v, self.rest, self.mechanism.gravity.tolist())

    def gravity(self):
        return self.forces(self.rest, self.rest, self.mechanism.gravity.tolist())

    def passive(self):
        """Damping, and the springs' potential ½ k (distance² or angle²) derived along each freedom."""
        damping = self.mechanism.per_freedom("damping").tolist()
        return [-d * v - self._spring(unit) for d, v, unit in zip(damping, self.v, self.units, strict=True)]

    def _spring(self, unit):
        """dU/dt where the rates are ``unit``."""
        total = arb(0)
        for placed in self.mechanism.joints:
            joint, q, v = placed.joint, self.q[placed.columns_q], unit[placed.columns_v]
            if joint.kind in ("hinge", "slide"):
                total += arb(joint.stiffness) * (arb(q[0]) - arb(joint.springref)) * v[0]
                continue
            rest = [1.0, 0.0, 0.0, 0.0]
            if joint.kind == "free":
                body = self.mechanism.bodies[placed.body]
                rest = body.quaternion.tolist()
                for x, x0, w in zip(q[:3], body.position.tolist(), v[:3], strict=True):
                    total += arb(joint.stiffness) * (arb(x) - arb(x0)) * w
            relative = of_quaternion(rest).transpose() * of_quaternion(q[-4:])
            spin = times(constant(relative), exponential(v[-3:], [arb(0)] * 3))
            ctx.cap = 2
            cosine = (arb_series([part.trace() for part in spin[:2]]) - 1) / 2
            angle = cosine.acos()
            total += arb(joint.stiffness) * (angle * angle)[1] / 2
        return total


def entries(rows):
    return np.array(rows, dtype=object)
