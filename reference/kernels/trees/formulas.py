"""The articulated-body algorithm in pieces without branches: each goes on by one joint or one degree of freedom.

Vectors have components along the world's axes, and everything of a body is taken at *its own* joint's point, so that
nothing is far from what it belongs to. Accelerations are those of the points of bodies (not of spatial vectors), less
gravity: only angular velocities enter, and how fast a mechanism flies does not matter. With r from the parent's point
to the joint's, s the joint's unit axis,

    α = α_p + γ + s q̈          γ = ω_p × s q̇                  of a hinge
    a = a_p + α_p × r + δ       δ = ω_p × (ω_p × r)
    a = … + s q̈                 δ = … + 2 ω_p × s q̇            of a slide, which has α = α_p

and the moment n and the force f that a body and all that hangs on it need are

    n = A α + B a + n₀,     f = Bᵀ α + M a + f₀.

A freedom is eliminated with u = (A s, Bᵀ s) for a hinge, (B s, M s) for a slide, d = s·u + armature, e = τ − s·n₀ or
τ − s·f₀ by the share w = u/d and k = e/d: q̈ = k − w·(α, a), which takes u wᵀ from the inertias and adds u k to the
forces. R. Featherstone, Rigid Body Dynamics Algorithms (2008), chapter 7, has the algorithm.

Several freedoms of one joint, of a ball or a free body, are eliminated one after another at one point.

So are three hinges of one body at one point, s₁ the outermost, on links without weight and without armature. Where s₁
is nearly in line with s₃ (gimbal lock, by an angle φ), s₁·A s₁ is φ² of what A was, and with rounding of A of size ε
all its digits are gone at φ = √ε. But s₂ and s₃ have been eliminated: A s₂ = A s₃ = 0, Bᵀ s₂ = Bᵀ s₃ = 0, and what is
left of the forces along them is what acts in their joints, s₂·n₀ = τ₂, s₃·n₀ = τ₃. With c = s₂ × s₃ therefore

    s₁ = p + c₂ s₂ + c₃ s₃,   p = c (c·s₁)/c²,   c₂ = s₁·(s₃ × c)/c²,   c₃ = s₁·(c × s₂)/c²
    A s₁ = A p,   Bᵀ s₁ = Bᵀ p,   s₁·n₀ = p·n₀ + c₂ τ₂ + c₃ τ₃

hold exactly, and p is known to ε of 1, as the axes are: to ε/φ of itself.
"""

from __future__ import annotations

from typing import Any

from .vectors import add, cross, dot, full, plus_cross, plus_times, product, rotation_of, scaled, times, transposed

# What belongs to a degree of freedom, from its row of memory on. After its elimination k and the share w (6) stand in
# place of the rotation R (9), and when its acceleration is known α and a (6) stand there.
ROTATION, OMEGA, AXIS, ARM, TURN, SHIFT, FORCE, ROW = 0, 9, 12, 15, 18, 21, 24, 25
SHARE, MOTION = 0, 0
# What belongs to an inertia: A (6: xx xy xz yy yz zz), B (9, by rows), M (6), n₀, f₀
INERTIA = 27
# What all states share, of a degree of freedom: the joint's frame in its parent's (rotation 9, place 3), the body's
# inertia about the joint's point (6), first moment (3), mass; armature, damping, stiffness, and the coordinate at rest
FRAME, PLACE, TENSOR, MOMENT, MASS, ARMATURE, DAMPING, STIFFNESS, REST, REFERENCE, NUMBERS = (
    0, 9, 12, 18, 21, 22, 23, 24, 25, 26, 27,
)  # fmt: skip
# Signs that something is wrong: not 0 where a number is not finite, the largest angle, the largest negative pivot
FINITE, LARGEST, PIVOT, SIGNS = 0, 1, 2, 3


def observe(memory: Any, signs: Any, *numbers: Any) -> None:
    """Keep in mind whether a number was not finite: it times zero is not zero then."""
    total = numbers[0]
    for number in numbers[1:]:
        total = total + number
    (before,) = memory.read(signs, FINITE, 1)
    memory.write(signs, FINITE, [before + 0.0 * total])


def onto_joint(memory: Any, numbers: Any, parent: Any, constants: Any) -> tuple[Any, ...]:
    """The joint's frame where its parent leaves it: R, ω of the parent, r, ω × (ω × r)."""
    rotation = memory.read(parent, ROTATION, 9)
    omega = memory.read(parent, OMEGA, 3)
    arm = times(rotation, numbers.read(constants, PLACE, 3))
    return product(rotation, numbers.read(constants, FRAME, 9)), omega, arm


def applied(memory: Any, numbers: Any, constants: Any, torque: Any, k: int, rate: Any, q: Any = None) -> Any:
    """The generalised force of a joint's k-th freedom: what is applied, the damper's and the spring's."""
    damping, stiffness, rest = numbers.read(constants, k * NUMBERS + DAMPING, 3)
    force = memory.read(torque, k, 1)[0] - damping * rate
    return force - stiffness * (q - rest) if q is not None else force


def place_hinge(
    memory: Any, numbers: Any, own: Any, parent: Any, constants: Any, at_q: Any, at_v: Any, torque: Any, signs: Any
) -> None:
    """On through a hinge, which turns about the third axis of its frame."""
    frame, omega, arm = onto_joint(memory, numbers, parent, constants)
    (q,), (rate,) = memory.read(at_q, 0, 1), memory.read(at_v, 0, 1)
    force = applied(memory, numbers, constants, torque, 0, rate, q)
    (largest,) = memory.read(signs, LARGEST, 1)
    s, c = memory.sincos(q)
    x, y, axis = frame[0::3], frame[1::3], frame[2::3]
    turned = [[c * a + s * b for a, b in zip(x, y, strict=True)], [c * b - s * a for a, b in zip(x, y, strict=True)]]
    own_rate = scaled(rate, axis)
    memory.write(own, ROTATION, [turned[0][0], turned[1][0], axis[0], turned[0][1], turned[1][1], axis[1],
                                 turned[0][2], turned[1][2], axis[2]])  # fmt: skip
    memory.write(own, OMEGA, add(omega, own_rate))
    memory.write(own, AXIS, axis)
    memory.write(own, ARM, arm)
    memory.write(own, TURN, cross(omega, own_rate))
    memory.write(own, SHIFT, cross(omega, cross(omega, arm)))
    memory.write(own, FORCE, [force])
    memory.write(signs, LARGEST, [memory.larger_size(q, largest)])
    observe(memory, signs, q, rate, force)


def place_slide(
    memory: Any, numbers: Any, own: Any, parent: Any, constants: Any, at_q: Any, at_v: Any, torque: Any, signs: Any
) -> None:
    """On through a slide, which moves along the third axis of its frame."""
    frame, omega, arm = onto_joint(memory, numbers, parent, constants)
    (q,), (rate,) = memory.read(at_q, 0, 1), memory.read(at_v, 0, 1)
    force = applied(memory, numbers, constants, torque, 0, rate, q)
    axis = frame[2::3]
    (reference,) = numbers.read(constants, REFERENCE, 1)
    arm = add(arm, scaled(q - reference, axis))
    across = cross(omega, scaled(rate, axis))
    memory.write(own, ROTATION, frame)
    memory.write(own, OMEGA, omega)
    memory.write(own, AXIS, axis)
    memory.write(own, ARM, arm)
    memory.write(own, TURN, [0.0, 0.0, 0.0])
    memory.write(own, SHIFT, add(cross(omega, cross(omega, arm)), add(across, across)))
    memory.write(own, FORCE, [force])
    observe(memory, signs, q, rate, force)


def place_ball(
    memory: Any, numbers: Any, own: Any, parent: Any, constants: Any, at_q: Any, at_v: Any, torque: Any, signs: Any
) -> None:
    """On through a ball: three freedoms, about the axes of the body that it moves. The body is the last one's."""
    frame, omega, arm = onto_joint(memory, numbers, parent, constants)
    q, rates = memory.read(at_q, 0, 4), memory.read(at_v, 0, 3)
    rotation = product(frame, rotation_of(q))
    turning = add(omega, times(rotation, rates))
    memory.write(own, TURN, cross(omega, turning))
    memory.write(own, SHIFT, cross(omega, cross(omega, arm)))
    memory.write(own, ARM, arm)
    turn_about_axes(memory, numbers, (own, constants, torque, signs), 0, rotation, turning, q, rates)


def place_free(
    memory: Any, numbers: Any, own: Any, parent: Any, constants: Any, at_q: Any, at_v: Any, torque: Any, signs: Any
) -> None:
    """A free body: three freedoms along the world's axes, three about its own. Where it is makes no difference."""
    q, rates = memory.read(at_q, 0, 7), memory.read(at_v, 0, 6)
    rotation = rotation_of(q[3:])
    for k in range(3):
        force = applied(memory, numbers, constants, torque, k, rates[k])
        memory.write(own, k * ROW + AXIS, [1.0 if i == k else 0.0 for i in range(3)])
        memory.write(own, k * ROW + ARM, [0.0] * 9)
        memory.write(own, k * ROW + FORCE, [force])
        observe(memory, signs, q[k], rates[k], force)
    memory.write(own, 3 * ROW + ARM, [0.0] * 9)
    turning = times(rotation, rates[3:])
    turn_about_axes(memory, numbers, (own, constants, torque, signs), 3, rotation, turning, q[3:], rates[3:])


def turn_about_axes(
    memory: Any, numbers: Any, places: tuple[Any, ...], first: int, rotation: Any, omega: Any, q: Any, rates: Any
) -> None:
    """Three freedoms about a body's own axes, of a joint's the first-th to the last."""
    own, constants, torque, signs = places
    for k in range(3):
        force = applied(memory, numbers, constants, torque, first + k, rates[k])
        memory.write(own, (first + k) * ROW + AXIS, rotation[k::3])
        memory.write(own, (first + k) * ROW + FORCE, [force])
        if k > 0:
            memory.write(own, (first + k) * ROW + ARM, [0.0] * 9)
        observe(memory, signs, rates[k], force)
    memory.write(own, (first + 2) * ROW + ROTATION, rotation)
    memory.write(own, (first + 2) * ROW + OMEGA, omega)
    observe(memory, signs, *q)


def carried(memory: Any, numbers: Any, own: Any, constants: Any) -> tuple[Any, ...]:
    """A body's rotation, angular velocity, tensor in its own axes, first moment in the world's, and mass."""
    rotation = memory.read(own, ROTATION, 9)
    moment = times(rotation, numbers.read(constants, MOMENT, 3))
    return (
        rotation,
        memory.read(own, OMEGA, 3),
        numbers.read(constants, TENSOR, 6),
        moment,
        numbers.read(constants, MASS, 1),
    )


def begin(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any) -> None:
    """The inertia of a body alone."""
    memory.write(inertia, 0, with_body(memory, numbers, [0.0] * INERTIA, own, constants))


def eliminated(
    memory: Any, numbers: Any, places: tuple[Any, ...], k: int, u: tuple[Any, Any], along: Any, bias: Any
) -> tuple[Any, Any, Any]:
    """w and k of a joint's k-th freedom, which are kept; ``along``: s·u, ``bias``: s·n₀ or s·f₀."""
    own, constants, signs = places
    (force,) = memory.read(own, k * ROW + FORCE, 1)
    pivot = along + numbers.read(constants, k * NUMBERS + ARMATURE, 1)[0]
    inverse = 1.0 / pivot
    share = scaled(inverse, u[0]), scaled(inverse, u[1])
    found = (force - bias) * inverse
    (least,) = memory.read(signs, PIVOT, 1)
    memory.write(own, k * ROW + SHARE, [found, *share[0], *share[1]])
    memory.write(signs, PIVOT, [memory.larger(-pivot, least)])
    return (*share, found)


def turned_out(memory: Any, numbers: Any, before: tuple[Any, ...], places: tuple[Any, ...], k: int = 0) -> Any:
    """A, B, M, n₀, f₀ before a freedom to turn is eliminated, u, and w with k: what :func:`reduced` takes."""
    A, B, _, n, _ = before
    axis = memory.read(places[0], k * ROW + AXIS, 3)
    u = times(full(A), axis), times(transposed(B), axis)
    return before, u, eliminated(memory, numbers, places, k, u, dot(axis, u[0]), dot(axis, n))


def turned_out_of_three(memory: Any, numbers: Any, before: tuple[Any, ...], places: tuple[Any, ...]) -> Any:
    """The same of the outermost of three hinges at one point, whose others have the next two rows."""
    A, B, _, n, _ = before
    outer, second, third = (memory.read(places[0], k * ROW + AXIS, 3) for k in range(3))
    forces = [memory.read(places[0], k * ROW + FORCE, 1)[0] for k in (1, 2)]
    normal = cross(second, third)
    inverse = 1.0 / dot(normal, normal)
    across = scaled(dot(normal, outer) * inverse, normal)
    of_second = dot(outer, cross(third, normal)) * inverse
    of_third = dot(outer, cross(normal, second)) * inverse
    u = times(full(A), across), times(transposed(B), across)
    bias = dot(across, n) + of_second * forces[0] + of_third * forces[1]
    return before, u, eliminated(memory, numbers, places, 0, u, dot(across, u[0]), bias)


def slid_out(memory: Any, numbers: Any, before: tuple[Any, ...], places: tuple[Any, ...]) -> Any:
    """The same of a freedom to slide."""
    _, B, M, _, f = before
    axis = memory.read(places[0], AXIS, 3)
    u = times(B, axis), times(full(M), axis)
    return before, u, eliminated(memory, numbers, places, 0, u, dot(axis, u[1]), dot(axis, f))


def slid_along(memory: Any, numbers: Any, before: tuple[Any, ...], places: tuple[Any, ...], k: int) -> Any:
    """The same of a freedom to slide along the world's k-th axis, a free joint's."""
    _, B, M, _, f = before
    u = B[k::3], full(M)[k::3]
    return before, u, eliminated(memory, numbers, places, k, u, u[1][k], f[k])


def parts(memory: Any, inertia: Any) -> tuple[Any, ...]:
    """A, B, M, n₀, f₀."""
    numbers = memory.read(inertia, 0, INERTIA)
    return numbers[:6], numbers[6:15], numbers[15:21], numbers[21:24], numbers[24:]


def reduced(before: tuple[Any, ...], u: tuple[Any, Any], w: tuple[Any, Any, Any]) -> tuple[Any, ...]:
    """A, B, M, n₀, f₀ less those of the freedom that was eliminated."""
    A, B, M, n, f = before
    turn, push, k = w
    pairs = [(i, j) for i in range(3) for j in range(i, 3)]
    return (
        [a - u[0][i] * turn[j] for a, (i, j) in zip(A, pairs, strict=True)],
        [b - u[0][i] * push[j] for b, (i, j) in zip(B, [(i, j) for i in range(3) for j in range(3)], strict=True)],
        [m - u[1][i] * push[j] for m, (i, j) in zip(M, pairs, strict=True)],
        [a + b * k for a, b in zip(n, u[0], strict=True)],
        [a + b * k for a, b in zip(f, u[1], strict=True)],
    )


def moved(memory: Any, own: Any, inertia: tuple[Any, ...]) -> list[Any]:
    """The same of the parent's motion, at its point: a = a_p + α_p × r + δ, α = α_p + γ. As 27 numbers."""
    A, B, M, n, f = inertia
    arm = memory.read(own, ARM, 3)
    turn, shift = memory.read(own, TURN, 3), memory.read(own, SHIFT, 3)
    n = plus_times(plus_times(n, full(A), turn), B, shift)
    f = plus_times(plus_times(f, transposed(B), turn), full(M), shift)
    # B_p = B + [r] M;  A_p = A − B [r] + [r] B_pᵀ, where [r] a = r × a
    m = full(M)
    raised = [number for column in range(3) for number in plus_cross(B[column::3], arm, m[column::3])]
    raised = transposed(raised)
    both = [plus_cross(A_row, arm, B[3 * i : 3 * i + 3]) for i, A_row in enumerate(rows(full(A)))]
    both = [plus_cross([both[i][j] for i in range(3)], arm, raised[3 * j : 3 * j + 3]) for j in range(3)]
    A = [both[j][i] for i in range(3) for j in range(i, 3)]
    return [*A, *raised, *M, *plus_cross(n, arm, f), *f]


def rows(matrix: Any) -> list[Any]:
    """The rows of a matrix (9)."""
    return [matrix[0:3], matrix[3:6], matrix[6:9]]


def with_body(memory: Any, numbers: Any, total: Any, parent: Any, of_parent: Any) -> list[Any]:
    """The parent body's own numbers added."""
    rotation, omega, tensor, moment, (mass,) = carried(memory, numbers, parent, of_parent)
    turned = product(rotation, full(tensor))
    pairs = [(i, k) for i in range(3) for k in range(i, 3)]
    own = [dot(turned[3 * i : 3 * i + 3], rotation[3 * k : 3 * k + 3]) for i, k in pairs]
    x, y, z = moment
    b, c = total[6:15], total[15:21]
    B = [b[0], b[1] - z, b[2] + y, b[3] + z, b[4], b[5] - x, b[6] - y, b[7] + x, b[8]]
    M = [c[0] + mass, c[1], c[2], c[3] + mass, c[4], c[5] + mass]
    n = plus_cross(total[21:24], omega, times(full(own), omega))
    f = plus_cross(total[24:], omega, cross(omega, moment))
    return [*add(total[:6], own), *B, *M, *n, *f]


def hinge_first(
    memory: Any,
    numbers: Any,
    inertia: Any,
    own: Any,
    constants: Any,
    signs: Any,
    target: Any,
    parent: Any,
    of_parent: Any,
) -> None:
    """Eliminate a hinge and begin its parent's inertia with what it leaves and the parent's body."""
    total = moved(memory, own, reduced(*turned_out(memory, numbers, parts(memory, inertia), (own, constants, signs))))
    memory.write(target, 0, with_body(memory, numbers, total, parent, of_parent))


def hinge_next(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any, signs: Any, target: Any) -> None:
    """Eliminate a hinge and add what it leaves to its parent's inertia."""
    total = moved(memory, own, reduced(*turned_out(memory, numbers, parts(memory, inertia), (own, constants, signs))))
    memory.write(target, 0, add(memory.read(target, 0, INERTIA), total))


def turn_within(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any, signs: Any) -> None:
    """Eliminate a freedom to turn; the inertia stays at its point."""
    left = reduced(*turned_out(memory, numbers, parts(memory, inertia), (own, constants, signs)))
    memory.write(inertia, 0, [number for part in left for number in part])


def outer_within(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any, signs: Any) -> None:
    """Eliminate the outermost of three hinges at one point; the inertia stays there."""
    left = reduced(*turned_out_of_three(memory, numbers, parts(memory, inertia), (own, constants, signs)))
    memory.write(inertia, 0, [number for part in left for number in part])


def slide_within(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any, signs: Any) -> None:
    """Eliminate a freedom to slide; the inertia stays at its point."""
    left = reduced(*slid_out(memory, numbers, parts(memory, inertia), (own, constants, signs)))
    memory.write(inertia, 0, [number for part in left for number in part])


def hand_first(memory: Any, numbers: Any, inertia: Any, own: Any, target: Any, parent: Any, of_parent: Any) -> None:
    """Begin the parent's inertia with this one and the parent's body."""
    total = moved(memory, own, parts(memory, inertia))
    memory.write(target, 0, with_body(memory, numbers, total, parent, of_parent))


def hand_next(memory: Any, numbers: Any, inertia: Any, own: Any, target: Any) -> None:
    """Add this inertia to the parent's."""
    total = moved(memory, own, parts(memory, inertia))
    memory.write(target, 0, add(memory.read(target, 0, INERTIA), total))


def turn_last(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any, signs: Any) -> None:
    """Eliminate a freedom to turn that hangs in the world."""
    turned_out(memory, numbers, parts(memory, inertia), (own, constants, signs))


def slide_last(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any, signs: Any) -> None:
    """Eliminate a freedom to slide that hangs in the world."""
    slid_out(memory, numbers, parts(memory, inertia), (own, constants, signs))


def free_last(memory: Any, numbers: Any, inertia: Any, own: Any, constants: Any, signs: Any) -> None:
    """Eliminate the six freedoms of a free body: its turns, then what it does along the world's axes."""
    places, left = (own, constants, signs), parts(memory, inertia)
    for k in (5, 4, 3):
        left = reduced(*turned_out(memory, numbers, left, places, k))
    for k in (2, 1):
        left = reduced(*slid_along(memory, numbers, left, places, k))
    slid_along(memory, numbers, left, places, 0)


def arrive(memory: Any, own: Any, parent: Any) -> tuple[Any, Any, Any]:
    """α and a before the freedom's own acceleration, and that acceleration."""
    motion = memory.read(parent, MOTION, 6)
    arm, turn, shift = (memory.read(own, place, 3) for place in (ARM, TURN, SHIFT))
    turning = add(motion[:3], turn)
    moving = plus_cross(add(motion[3:], shift), motion[:3], arm)
    found, *share = memory.read(own, SHARE, 7)
    for number, part in zip(share, [*turning, *moving], strict=True):
        found = found - number * part
    return turning, moving, found


def turn(memory: Any, numbers: Any, own: Any, parent: Any, result: Any, signs: Any) -> None:
    """The acceleration of a freedom to turn."""
    turning, moving, found = arrive(memory, own, parent)
    memory.write(own, MOTION, [*add(turning, scaled(found, memory.read(own, AXIS, 3))), *moving])
    memory.write(result, 0, [found])
    observe(memory, signs, found)


def slide(memory: Any, numbers: Any, own: Any, parent: Any, result: Any, signs: Any) -> None:
    """The acceleration of a freedom to slide."""
    turning, moving, found = arrive(memory, own, parent)
    memory.write(own, MOTION, [*turning, *add(moving, scaled(found, memory.read(own, AXIS, 3)))])
    memory.write(result, 0, [found])
    observe(memory, signs, found)


def world_at_rest(memory: Any, numbers: Any, own: Any) -> None:
    """The world's frame, before anything is placed."""
    memory.write(own, ROTATION, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])
    memory.write(own, OMEGA, [0.0, 0.0, 0.0])


def world_falls(memory: Any, numbers: Any, own: Any, gravity: Any) -> None:
    """Its acceleration less gravity."""
    memory.write(own, MOTION, [0.0, 0.0, 0.0, *[-g for g in numbers.read(gravity, 0, 3)]])
