"""Mechanisms as a file declares them, with textbooks' equations, entered by hand, and the documents' own as printed."""

from handwritten import SHIKI_2_10, TAKENO_19


def body(**fields):
    return "[[bodies]]\n" + "\n".join(f"{name} = '{value}'" for name, value in fields.items())


def mechanism(bodies, rows, **fields):
    lines = ["system = 'mechanism'", *(f"{name} = '{value}'" for name, value in fields.items()), *bodies, "[equations]"]
    return "\n".join([*lines, *(f"{i} = '''{row}'''" for i, row in enumerate(rows, 1))])


def preset(name, rows):
    return "\n".join([f"system = '{name}'", "[equations]", *(f"{i} = '''{row}'''" for i, row in enumerate(rows, 1))])


# Angle from the downward vertical, counter-clockwise; the cart to the right
CART_POLE = [
    r"(M+m) \ddot{x} + m l \ddot\theta \cos\theta - m l \dot\theta^2 \sin\theta = 0",
    "ml^2 θ̈ + ml ẍ cos θ + mgl sin θ = 0",
]
# Kinetic energy of the bob: ½ m (ṙ² + r² θ̇²); spring of natural length l0
ELASTIC = ["r θ'' + 2 r' θ' + g sin θ = 0", "m r'' - m r θ'^2 + k (r - l0) - m g cos θ = 0"]
# Two links with the inertia about the joints, driven and damped (the acrobot's textbook form)
TWO_LINKS = [
    body(coordinate="q1", mass="m1", length="l1", centre="lc1", inertia="I1", about="pivot", drive="u1", damping="b1"),
    body(coordinate="q2", mass="m2", length="l2", centre="lc2", inertia="I2", about="pivot", drive="u2", damping="b2"),
]
ACROBOT = [
    "(I1 + I2 + m2*l1^2 + 2*m2*l1*lc2*cos(q2))*q1'' + (I2 + m2*l1*lc2*cos(q2))*q2'' - 2*m2*l1*lc2*sin(q2)*q1'*q2'"
    " - m2*l1*lc2*sin(q2)*q2'^2 + m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1+q2)) = u1 - b1*q1'",
    r"(I_2 + m_2 l_1 l_{c2} \cos q_2) \ddot{q}_1 + I_2 \ddot q_2 + m_2 l_1 l_{c2} \sin(q_2) \dot q_1^2"
    r" + m_2 g l_{c2} \sin(q_1+q_2) = u2 - b2 \dot{q}_2",
]
# A mass that slides on a fixed vertical spring, and the same hung on a cart that is driven
SPRING = [body(coordinate="y", joint="slide", along="down", mass="m", spring="k", rest="y0", damping="c")]
RIGHT = {
    "cart and pole": preset("cart-pole", CART_POLE),
    "cart and pole, solved": preset("cart-pole", [
        "x'' = (m l θ'^2 sin θ + m g sin θ cos θ)/(M + m sin^2 θ)",
        "θ'' = (-m l θ'^2 sin θ cos θ - (M+m) g sin θ)/(l (M + m sin^2 θ))"]),
    "cart and rod, half its length l": preset("cart-rod", [
        "(M+m) x'' + m l θ'' cos θ - m l θ'^2 sin θ = 0", "(I + m l^2) θ'' + m l x'' cos θ + m g l sin θ = 0"]),
    "cart and two bobs": preset("cart-double-pole", [
        "(M+m1+m2) x'' + (m1+m2) l1 (θ1'' cos θ1 - θ1'^2 sin θ1) + m2 l2 (θ2'' cos θ2 - θ2'^2 sin θ2) = 0",
        "(m1+m2) l1 θ1'' + m2 l2 θ2'' cos(θ1-θ2) + m2 l2 θ2'^2 sin(θ1-θ2) + (m1+m2) (x'' cos θ1 + g sin θ1) = 0",
        "l2 θ2'' + l1 θ1'' cos(θ1-θ2) - l1 θ1'^2 sin(θ1-θ2) + x'' cos θ2 + g sin θ2 = 0"]),
    "elastic pendulum": preset("elastic-pendulum", ELASTIC),
    "elastic pendulum, its Lagrangian":
        "system = 'elastic-pendulum'\nlagrangian = \"m/2*(r'^2 + r^2 θ'^2) + m g r cos θ - k/2 (r-l0)^2\"",
    "acrobot": mechanism(TWO_LINKS, ACROBOT, angles="relative"),
    "a spring": mechanism(SPRING, ["m y'' + c y' + k (y - y0) = m g"]),
    "three legs, as Shiki prints (2.10)": mechanism([
        body(name="one", coordinate="theta1", mass="m1", length="l1"),
        body(on="one", coordinate="theta2", mass="m2", length="l2"),
        body(on="one", coordinate="theta3", mass="m3", length="l3")], SHIKI_2_10),
    "two equal rods, as Takeno prints (19)": mechanism([
        body(coordinate="theta1", mass="m", length="l", centre="l/2", inertia="m l^2/12"),
        body(coordinate="theta2", mass="m", length="l", centre="l/2", inertia="m l^2/12")], TAKENO_19),
    "springs and dampers between absolute angles": mechanism([
        body(coordinate="theta1", mass="m", length="l", spring="k", damping="b"),
        body(coordinate="theta2", mass="m", length="l", spring="k", damping="b")], [
        "2 m l^2 θ1'' + m l^2 θ2'' cos(θ1-θ2) + m l^2 θ2'^2 sin(θ1-θ2) + 2 m g l sin θ1"
        " = -k θ1 + k (θ2 - θ1) - b θ1' + b (θ2' - θ1')",
        "m l^2 θ2'' + m l^2 θ1'' cos(θ1-θ2) - m l^2 θ1'^2 sin(θ1-θ2) + m g l sin θ2 = -k (θ2-θ1) - b (θ2'-θ1')"]),
    "a bob half-way down a rod": mechanism([
        body(name="rod", coordinate="theta", mass="M", length="l", centre="l/2", inertia="M l^2/12"),
        body(on="rod", at="l/2", coordinate="phi", mass="m", length="a")], [
        "(M/3 + m/4) l^2 θ'' + m a l/2 (φ'' cos(θ-φ) + φ'^2 sin(θ-φ)) + (M+m) g l/2 sin θ = 0",
        "a φ'' + l/2 (θ'' cos(θ-φ) - θ'^2 sin(θ-φ)) + g sin φ = 0"]),
}  # fmt: skip
