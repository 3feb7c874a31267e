# ruff: noqa: E501 -- formulas stand on one line, as in their programs
"""Conditions on whole numbers within loops, lists by a rule, Scilab's remarks, pointers of C, exact numbers of sympy."""

import pytest
from mechanisms import F, M, a1, a2, a3, al, bobs, cart_pole, g, l, m, th, th1, th2, th3, w, w1, w2, w3, x, xdd
from sympy import cos, sin
from truth import compare

from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

BOB = "[[bodies]]\ncoordinate = 'theta{0}'\nmass = 'm{1}'\nlength = 'l{1}'\n"
THREE = "system = 'mechanism'\n" + "".join(BOB.format(k, "") for k in (1, 2, 3))
TWO = "system = 'mechanism'\n" + "".join(BOB.format(k, k) for k in (1, 2))
CART = """system = 'mechanism'
from = 'up'
sense = 'clockwise'
[[bodies]]
name = 'cart'
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'F'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
"""

CONTINUED = """
n = 3
def rhs(t, y):
    th, w = y[:n], y[n:]
    A = np.zeros((n, n))
    b = np.zeros(n)
    for i in range(n):
        b[i] = -(n - i)*g*np.sin(th[i])
        for j in range(n):
            c = n - j if j > i else n - i
            if i == j:
                A[i, j] = c*l
                continue
            A[i, j] = c*l*np.cos(th[i] - th[j])
            b[i] -= c*l*np.sin(th[i] - th[j])*w[j]**2
    a = np.linalg.solve(A, b)
    return np.concatenate([w, a])
"""
BY_RULE = """
def rhs(t, y, m, l, g):
    n = 3
    th, w = y[:n], y[n:]
    def c(i, j):
        if i < j:
            return n - j
        return n - i
    A = [[c(i, j)*l*np.cos(th[i] - th[j]) for j in range(n)] for i in range(n)]
    b = [-c(i, i)*g*np.sin(th[i]) - sum(c(i, j)*l*np.sin(th[i] - th[j])*w[j]**2 for j in range(n) if j != i)
         for i in range(n)]
    return np.concatenate((w, np.linalg.solve(np.array(A), np.array(b))))
"""
MATLAB = """
function dx = pendulum(t, x)
  th = [x(1) x(2)]; w = [x(3) x(4)];
  theta1 = x(1); theta2 = x(2);
  m = [m1 m2]; l = [l1 l2];
  A = zeros(2,2); f = zeros(2,1);
  for i = 1:2
    s = 0;
    for k = i:2
      s = s + m(k);
    end
    f(i) = -s*g*l(i)*sin(th(i));
    for j = 1:2
      if i == j
        A(i,j) = s*l(i)^2;
        continue
      elseif i < j
        A(i,j) = m2*l(i)*l(j)*cos(th(i)-th(j));
      else
        A(i,j) = m2*l(j)*l(i)*cos(th(j)-th(i));
      end
      f(i) = f(i) - m2*l(i)*l(j)*sin(th(i)-th(j))*w(j)^2;
    end
  end
  a = A\\f;
  dx = [w(1); w(2); a(1); a(2)];
end
"""
SCILAB = """
// two bobs
/* rates are thetaNdot */
quarter = %pi/2 // a right angle
u = -(m1+m2)*g*l1*sin(theta1) - m2*l1*l2*theta2dot^2*sin(theta1-theta2);
v = -m2*g*l2*cos(theta2-quarter) + m2*l1*l2*theta1dot^2*sin(theta1-theta2); // of the second
A = (m1+m2)*l1^2;  B = m2*l1*l2*cos(theta1-theta2);  C = m2*l2^2;
theta2ddot = (v - B*u/A)/(C - B^2/A);
theta1ddot = (u - B*theta2ddot)/A;
"""
POINTERS = """
const double s = sin(state->theta), c = cos(state->theta);
const double all = (*p).M + p->m;
double xacc = (state->F + p->m*p->l*state->theta_dot*state->theta_dot*s - p->m*p->g*s*c)/(all - p->m*c*c);
double thetaacc = (p->g*s - xacc*c)/p->l;
"""
PROGRAMS = {
    "continued": (THREE, CONTINUED, [
        ("j > i", "j < i"), ("i == j", "i != j"), ("continue", "break"), ("c*l\n", "l\n"), ("- th[j])*w", "+ th[j])*w"),
        ("n - j if", "n if"), ("b[i] -=", "b[i] +="), ("i == j:", "i <= j:"),
    ]),
    "by rule": (THREE, BY_RULE, [
        ("i < j", "i > j"), ("if j != i", "if j > i"), ("n - i", "n"), ("w[j]**2", "w[i]**2"), ("- sum", "+ sum"),
    ]),
    "matlab": (TWO, MATLAB, [
        ("i == j", "i ~= j"), ("m2*l(j)*l(i)*cos", "m2*l(j)*l(i)*sin"), ("for k = i:2", "for k = 1:2"),
        ("elseif i < j", "elseif i > j & 0 == 1"), ("w(j)^2", "w(i)^2"),
    ]),
    "scilab": (TWO, SCILAB, [("%pi/2", "%pi"), ("u - B*", "u + B*"), ("C = m2", "C = m1")]),
    "pointers": (CART, POINTERS, [
        ("- p->m*p->g*s*c", "+ p->m*p->g*s*c"), ("(*p).M + p->m", "(*p).M - p->m"), ("/p->l;", "/p->m;"),
    ]),
}  # fmt: skip
SAME = {("matlab", "elseif i < j"): "correct"}  # what the other branch says is the same
SLIPS = [(name, was, now) for name, (_, _, slips) in PROGRAMS.items() for was, now in slips]
REFUSED = [
    ("continued", "i == j:", "w[i] > 0:", r"if w\[i\] > 0"),
    ("continued", "continue", "if t > 1: continue", "if t > 1"),
    ("continued", "j > i", "t > 1", "t > 1"),
    ("by rule", "if i < j", "if t < 3", "if t < 3"),
    ("matlab", "if i == j", "if w(i) > 0", r"if w\(i\) > 0"),
    ("pointers", "p->l;", "q->l;", "two things"),
    ("pointers", "p->m*p->l*", "1/2*p->m*p->l*", None),
    ("pointers", "(p->g*s", "1/2*(p->g*s", "whole numbers"),
    ("scilab", "%pi/2", "%e/2", None),
]


def graded(head, text):
    return grade_text(f"{head}[equations]\n1 = '''{text}'''\n").verdict


def test_the_formulas_of_the_programs_are_right():
    t, rates, accelerations = (th1, th2, th3), (w1, w2, w3), (a1, a2, a3)
    rows = [
        (3 - i) * g * sin(t[i]) + sum((3 - max(i, j)) * l * (cos(t[i] - t[j]) * accelerations[j]
        + sin(t[i] - t[j]) * rates[j] ** 2) for j in range(3)) for i in range(3)
    ]  # fmt: skip
    assert compare(rows, bobs((l, m), (l, m), (l, m))) is None


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_right_program_is_right(name):
    head, text, _ = PROGRAMS[name]
    assert graded(head, text) == "correct"


@pytest.mark.parametrize(("name", "was", "now"), SLIPS)
def test_a_slip_is_wrong(name, was, now):
    head, text, _ = PROGRAMS[name]
    assert was in text
    assert graded(head, text.replace(was, now, 1)) == SAME.get((name, was), "wrong")


@pytest.mark.parametrize(("name", "was", "now", "says"), REFUSED)
def test_what_is_not_known_is_refused(name, was, now, says):
    head, text, _ = PROGRAMS[name]
    assert was in text
    with pytest.raises(InvalidInput, match=says):
        graded(head, text.replace(was, now, 1))


def test_a_helper_that_a_condition_decides_is_refused():
    text = """
def side(v):
    if v > 0:
        return l1
    return l2
def f(t, y):
    theta1, theta2, w1, w2 = y
    d = theta1 - theta2
    A = np.array([[(m1+m2)*l1, m2*l2*np.cos(d)], [l1*np.cos(d), side(w1)]])
    b = np.array([-m2*l2*w2**2*np.sin(d) - (m1+m2)*g*np.sin(theta1), l1*w1**2*np.sin(d) - g*np.sin(theta2)])
    return np.hstack((w1, w2, np.linalg.solve(A, b)))
"""
    assert graded(TWO, text.replace("side(w1)", "l2")) == "correct"
    with pytest.raises(InvalidInput, match="if v > 0"):
        graded(TWO, text)


KINETIC = "Rational(1, 2)*(M + m)*Derivative(x(t), t)**2 + m*l*cos(theta(t))*Derivative(x(t), t)*Derivative(theta(t), t) + S(1)/2*m*l**2*Derivative(theta(t), t)**2"


@pytest.mark.parametrize(
    ("was", "now", "verdict"),
    [
        ("S(1)/2", "S.Half", "correct"), ("S(1)/2", "sp.S('1/2')", "correct"), ("S(1)/2", "Integer(1)/2", "correct"),
        ("S(1)/2", "Fraction(1, 2)", "correct"), ("S(1)/2", "S(1)", "wrong"), ("Rational(1, 2)", "Rational(1, 3)", "wrong"),
        ("Rational(1, 2)", "sympy.Rational(2, 4)", "correct"),
    ],
)  # fmt: skip
def test_exact_numbers_of_sympy(was, now, verdict):
    kinetic = KINETIC.replace(was, now)
    head, bodies = CART.split("[[bodies]]", 1)
    assert (
        grade_text(f'{head}kinetic = """{kinetic}"""\npotential = "m*g*l*cos(theta)"\n[[bodies]]{bodies}').verdict
        == verdict
    )


ROWS = [
    "(M + m)*ddx + m*l*ddtheta*cos(theta) - m*l*dtheta^2*sin(theta) = F",
    "l*ddtheta + ddx*cos(theta) - g*sin(theta) = 0",
]


def rows(*texts):
    return grade_text(CART + "[equations]\n" + "".join(f'{k} = "{text}"\n' for k, text in enumerate(texts, 1))).verdict


def test_dx_is_a_rate_where_all_rates_are_written_so():
    printed = [(M + m) * xdd + m * l * al * cos(th) - m * l * w**2 * sin(th) - F, l * al + xdd * cos(th) - g * sin(th)]
    assert compare(printed, cart_pole(up=True, forces={x: F})) is None
    assert rows(*ROWS) == "correct"
    assert rows(ROWS[0].replace("dtheta^2*sin", "dtheta^2*cos"), ROWS[1]) == "wrong"
    with pytest.raises(InvalidInput, match="dx"):  # the rate of the cart is written otherwise
        rows(ROWS[0].replace("ddx", "x''").replace("= F", "= F + m*dx"), ROWS[1].replace("ddx", "x''"))


ELL = "system = 'mechanism'\n[[bodies]]\ncoordinate = 'theta'\nmass = 'm'\nlength = 'ell'\n"


def test_ell_is_a_name_in_programs():
    text = "def f(t, y):\n    theta, w = y\n    return w, -m*g*ell*np.sin(theta)/(m*ell**2)\n"
    assert graded(ELL, text) == "correct"
    assert graded(ELL, text.replace("-m*g*ell", "-m*g*ell**2")) == "wrong"
    with pytest.raises(InvalidInput, match="l and ell"):
        graded(ELL, text.replace("g*ell", "g*l"))


SQUARE = """
def f(s, F):
    x, theta, v, w = s
    d = M + m*np.sin(theta)**2
    a = (F + m*np.sin(theta)*(l*w**2 - g*np.cos(theta)))/d
    b = ((M + m)*g*np.sin(theta) - np.cos(theta)*(F + m*l*w**2*np.sin(theta)))/(l*d)
    return np.array([v, w, a, b])
"""


def test_the_cosine_of_a_square_is_wrong_unless_it_cancels():
    assert graded(CART, SQUARE) == "correct"
    assert graded(CART, SQUARE.replace("np.sin(theta)**2", "np.sin(theta**2)", 1)) == "wrong"
    assert graded(CART, SQUARE.replace("d = M", "d = np.cos(theta**2) - np.cos(theta**2) + M")) == "correct"
    both = "d = np.cos(theta**2)**2 + np.sin(theta**2)**2 - 1 + M"
    with pytest.raises(InvalidInput, match="a sum or difference of angles is expected"):
        graded(CART, SQUARE.replace("d = M", both))


RUST = """
fn deriv(y: &[f64; 4], F: f64, p: &Params) -> [f64; 4] {
    let (x, theta, v, w) = (y[0], y[1], y[2], y[3]);
    let (st, ct) = theta.sin_cos();
    let den = p.M + p.m * st.powi(2);
    let a = (F + p.m * st * (p.l * w * w - p.g * ct)) / den;
    [v, w, a, (p.g * st - a * ct) / p.l]
}
"""
GO = """
func deriv(y []float64, F float64) []float64 {
	x, theta, v, w := y[0], y[1], y[2], y[3]
	st, ct := math.Sincos(theta)
	a := (F + m*st*(l*w*w - g*ct)) / (M + m*st*st)
	return []float64{v, w, a, (g*st - a*ct) / l}
}
"""
SPLIT = """
def dynamics(state, t, params):
    q, qd = jnp.split(state, 2)
    m1, m2, l1, l2, g = params
    d = q[0] - q[1]
    A = jnp.array([[(m1+m2)*l1, m2*l2*jnp.cos(d)], [l1*jnp.cos(d), l2]])
    b = jnp.array([-m2*l2*qd[1]**2*jnp.sin(d) - (m1+m2)*g*jnp.sin(q[0]), l1*qd[0]**2*jnp.sin(d) - g*jnp.sin(q[1])])
    return jnp.concatenate([qd, jnp.linalg.solve(A, b)])
"""
PROPERTY = """
class CartPole:
    @property
    def total(self):
        return self.M + self.m
    def rates(self, t, y, F):
        x, theta, v, w = y
        s, c = np.sin(theta), np.cos(theta)
        a = (F + self.m*s*(self.l*w**2 - self.g*c))/(self.total - self.m*c**2)
        return [v, w, a, (self.g*s - a*c)/self.l]
"""
SHAPES = {
    "rust": (CART, RUST, [("(st, ct)", "(ct, st)"), ("powi(2)", "powi(3)"), ("- a * ct", "+ a * ct")]),
    "go": (CART, GO, [("st, ct :=", "ct, st :="), ("M + m*st*st", "M + m*ct*ct"), ("w*w - g", "w*w + g")]),
    "split": (TWO, SPLIT, [("l1*qd[0]**2", "l1*qd[1]**2"), ("[l1*jnp", "[l2*jnp"), ("qd[1]**2", "q[1]**2")]),
    "property": (CART, PROPERTY, [("self.M + self.m", "self.M - self.m"), ("/(self.total -", "/(self.total +")]),
}  # fmt: skip


@pytest.mark.parametrize("name", SHAPES)
def test_shapes_of_languages_are_read_and_their_slips_are_wrong(name):
    head, text, slips = SHAPES[name]
    assert graded(head, text) == "correct"
    for was, now in slips:
        assert was in text
        assert graded(head, text.replace(was, now, 1)) == "wrong"


def test_parts_that_are_no_halves_are_refused():
    with pytest.raises(InvalidInput, match="halves"):
        graded(TWO, SPLIT.replace("(state, 2)", "(state, 4)"))
