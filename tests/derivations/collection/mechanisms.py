"""The collection's mechanisms, from positions. θ is counted from the downward vertical, to the right, unless said."""

import sympy as sp
from sympy import cos, sin
from truth import Body, Mechanism, coordinate

g, M, m, m1, m2, m3, l, l1, l2, l3, r0 = sp.symbols("g M m m1 m2 m3 l l1 l2 l3 r0", positive=True)
g = sp.Symbol("g")
I, I1, I2, lc1, lc2, b, b1, b2, k, F, u, tau, tau1, tau2 = sp.symbols("I I1 I2 lc1 lc2 b b1 b2 k F u tau tau1 tau2")
th, w, al = coordinate("th")
th1, w1, a1 = coordinate("th1")
th2, w2, a2 = coordinate("th2")
th3, w3, a3 = coordinate("th3")
x, xd, xdd = coordinate("x")
r, rd, rdd = coordinate("r")
ph, phd, phdd = coordinate("ph")
ONE, TWO, THREE, CART, RADIUS, WHEEL, ANGLE = (
    (th1, w1, a1), (th2, w2, a2), (th3, w3, a3), (x, xd, xdd), (r, rd, rdd), (ph, phd, phdd), (th, w, al))  # fmt: skip


def chain(links, relative=False, up=False, horizontal=False, cart=None, forces=None, potential=0):
    """Links (length, mass, centre, inertia about the centre), the first on the world or on a cart of a mass."""
    coordinates = [ONE, TWO, THREE][: len(links)]
    px, py, bodies, turn = (x if cart is not None else sp.Integer(0)), sp.Integer(0), [], sp.Integer(0)
    if cart is not None:
        bodies.append(Body(cart, x, sp.Integer(0)))
    for (length, mass, centre, inertia), (q, _, _) in zip(links, coordinates, strict=True):
        turn = turn + q if relative else q
        ex, ey = (cos(turn), sin(turn)) if horizontal else (sin(turn), cos(turn) if up else -cos(turn))
        bodies.append(Body(mass, px + centre * ex, py + centre * ey, inertia, turn))
        px, py = px + length * ex, py + length * ey
    return Mechanism(([CART] if cart is not None else []) + coordinates, bodies, potential, forces or {})


def bobs(*pairs, **how):
    """Point masses at the ends of massless rods: (length, mass)."""
    return chain([(length, mass, length, 0) for length, mass in pairs], **how)


def rods(*pairs, **how):
    """Uniform rods: (length, mass)."""
    return chain([(length, mass, length / 2, mass * length**2 / 12) for length, mass in pairs], **how)


def links(pivot, **how):
    """Two general links, I1 and I2 about the pivot or about the centre."""
    return chain(
        [(l1, m1, lc1, I1 - (m1 * lc1**2 if pivot else 0)), (l2, m2, lc2, I2 - (m2 * lc2**2 if pivot else 0))], **how
    )


def cart_pole(inertia=0, up=False, left=False, forces=None, potential=0, mass=M, bob=m, arm=l):
    """A pole with its centre at the arm's end on a cart; to the left if the angle is counted so."""
    side = -1 if left else 1
    pole = Body(bob, x + side * arm * sin(th), (arm if up else -arm) * cos(th), inertia, th)
    return Mechanism([CART, ANGLE], [Body(mass, x, sp.Integer(0)), pole], potential, forces or {})


def pendulum(inertia=0, up=False, forces=None, arm=l):
    """One link on the world."""
    return Mechanism([ANGLE], [Body(m, arm * sin(th), (arm if up else -arm) * cos(th), inertia, th)], 0, forces or {})


def elastic(potential, length=r):
    """A bob on a spring of the length given."""
    return Mechanism([RADIUS, ANGLE], [Body(m, length * sin(th), -length * cos(th))], potential)


def wheel(inertia, spin, up=True, forces=None, arm=l):
    """A pendulum with the inertia of it about its pivot, and a wheel's about its own axle; ph relative to the arm."""
    arm_ = Body(m, arm * sin(th), (arm if up else -arm) * cos(th), inertia - m * arm**2, th)
    return Mechanism([ANGLE, WHEEL], [arm_, Body(0, arm * sin(th), 0, spin, th + ph)], 0, forces or {})
