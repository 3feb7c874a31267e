"""Kinds that the ninth collection of programs showed: numbers of declared letters, a step that lost its dt."""

import pytest

from furiko.derivations.grading.grade import grade
from furiko.models.errors import InvalidInput

ONE_BODY = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'th'
mass = 'm'
length = 'l'
inertia = 'I'
[define]
w = "th'"
[equations]
1 = '''
"""
IN_EACH_LANGUAGE = {
    "python": (
        "def f(t, y):\n    th, w = y\n    m = 2\n    I = NUM\n    a = -m*g*l*sin(th)/(I + m*l**2)\n    return [w, a]\n"
    ),
    "matlab": (
        "function dy = f(t, y)\nm = 2;\nI = NUM;\nth = y(1);\nw = y(2);\ndy = [w; -m*g*l*sin(th)/(I + m*l^2)];\nend\n"
    ),
    "c": (
        "void f(double t, double y[], double dy[]) {\n double m = 2;\n double I = NUM;\n double th = y[0];\n"
        " double w = y[1];\n dy[0] = w;\n dy[1] = -m*g*l*sin(th)/(I + m*l*l);\n}\n"
    ),
    "javascript": (
        "function f(t, y) {\n const m = 2;\n const I = NUM;\n const [th, w] = y;\n"
        " return [w, -m*g*l*Math.sin(th)/(I + m*l*l)];\n}\n"
    ),
    "julia": (
        "function f(du, u, p, t)\n m = 2\n I = NUM\n th, w = u\n du[1] = w\n du[2] = -m*g*l*sin(th)/(I + m*l^2)\nend\n"
    ),
    "rust": (
        "fn f(t: f64, y: [f64; 2]) -> [f64; 2] {\n let m = 2.0;\n let I = NUM;\n let th = y[0];\n let w = y[1];\n"
        " [w, -m*g*l*th.sin()/(I + m*l*l)]\n}\n"
    ),
    "go": (
        "func f(t float64, y []float64) []float64 {\n m := 2.0\n I := NUM\n th := y[0]\n w := y[1]\n"
        " return []float64{w, -m*g*l*math.Sin(th)/(I + m*l*l)}\n}\n"
    ),
    "r": (
        "f <- function(t, y, parms) {\n m <- 2\n I <- NUM\n th <- y[1]\n w <- y[2]\n"
        " list(c(w, -m*g*l*sin(th)/(I + m*l^2)))\n}\n"
    ),
    "lua": (
        "function f(t, y)\n local m = 2\n local I = NUM\n local th = y[1]\n local w = y[2]\n"
        " return {w, -m*g*l*math.sin(th)/(I + m*l^2)}\nend\n"
    ),
    "macros": (
        "#define m 2\n#define I (NUM)\nvoid f(double t, double y[], double dy[]) {\n double th = y[0];\n"
        " double w = y[1];\n dy[0] = w;\n dy[1] = -m*g*l*sin(th)/(I + m*l*l);\n}\n"
    ),
}
TWO_BODIES = """system = 'mechanism'
angles = 'absolute'
from = 'down'
[[bodies]]
coordinate = 'th1'
mass = 'm1'
length = 'l1'
[[bodies]]
coordinate = 'th2'
mass = 'm2'
length = 'l2'
[define]
w1 = "th1'"
w2 = "th2'"
a1 = "th1''"
a2 = "th2''"
[equations]
1 = '''
"""
D = "th1-th2"
E = "(2*m1+m2-m2*cos(2*th1-2*th2))"
A1 = (
    f"(-g*(2*m1+m2)*sin(th1)-m2*g*sin(th1-2*th2)-2*sin({D})*m2*(w2*w2*l2+w1*w1*l1*cos({D})))/(l1*{E})",
    f"2*sin({D})*(w1*w1*l1*(m1+m2)+g*(m1+m2)*cos(th1)+w2*w2*l2*m2*cos({D}))/(l2*{E})",
)
STEPS = ("w1 += a1*dt", "w2 += a2*dt", "th1 += w1*dt", "th2 += w2*dt")


def verdict(folder, text):
    path = folder / "sheet.toml"
    path.write_text(text + "'''\n", encoding="utf-8")
    return grade(path).verdict


@pytest.mark.parametrize("number", ["0.5", "7.0/12.0", "2*0.25"])
@pytest.mark.parametrize("language", IN_EACH_LANGUAGE)
def test_a_declared_letter_stays_a_letter_whatever_number_the_program_gives_it(tmp_path, language, number):
    assert verdict(tmp_path, ONE_BODY + IN_EACH_LANGUAGE[language].replace("NUM", number)) == "correct"


@pytest.mark.parametrize("lost", [*STEPS, ""])
def test_a_step_that_lost_its_dt_is_refused_where_a_function_gives_accelerations(tmp_path, lost):
    steps = "".join(f"    {step.replace('*dt', '') if step == lost else step}\n" for step in STEPS)
    program = (
        f"def accel(th1, th2, w1, w2):\n    a1 = {A1[0]}\n    a2 = {A1[1]}\n    return a1, a2\n\n"
        f"for k in range(1000):\n    a1, a2 = accel(th1, th2, w1, w2)\n{steps}"
    )
    if not lost:
        assert verdict(tmp_path, TWO_BODIES + program) == "correct"
        return
    with pytest.raises(InvalidInput, match="dt"):
        verdict(tmp_path, TWO_BODIES + program)


def test_two_parameters_of_one_name_are_refused(tmp_path):
    program = "def f(t, y, l=1.0, l=9.81):\n    th, w = y\n    return [w, -m*g*l*np.sin(th)/(I + m*l**2)]\n"
    with pytest.raises(InvalidInput, match="two parameters"):
        verdict(tmp_path, ONE_BODY + program)


def test_calls_of_a_cpp_vector_count_from_nought(tmp_path):
    program = (
        "VectorXd f(const VectorXd &y) {\n VectorXd dy(2);\n double th = y(0);\n double w = y(1);\n dy(0) = w;\n"
        " dy(1) = -m*g*l*sin(th)/(I + m*l*l);\n return dy;\n}\n"
    )
    assert verdict(tmp_path, ONE_BODY + program) == "correct"


CART = """system = 'mechanism'
from = 'up'
[[bodies]]
name = 'cart'
coordinate = 'x'
joint = 'slide'
mass = 'm_c'
drive = 'f'
[[bodies]]
coordinate = 'theta'
mass = 'm_p'
length = 'l'
[define]
'q[0]' = 'x'
'q[1]' = 'theta'
'q_dot[0]' = "x'"
'q_dot[1]' = "theta'"
'u[0]' = 'f'
[equations]
1 = '''
"""


@pytest.mark.parametrize(
    ("column", "right"), [("[[1], [0]]", "correct"), ("[[0], [1]]", "wrong"), ("[[1], [1]]", "wrong")]
)
def test_a_column_times_an_input_drives_what_it_says(tmp_path, column, right):
    program = (
        "def f(q, q_dot, u):\n    _, theta = q\n    _, theta_dot = q_dot\n"
        "    D = np.array([[m_c + m_p, m_p*l*np.cos(theta)], [m_p*l*np.cos(theta), m_p*l**2]])\n"
        "    C = np.array([-m_p*l*theta_dot**2*np.sin(theta), 0])\n    G = np.array([0, -m_p*g*l*np.sin(theta)])\n"
        f"    B = np.array({column})\n    return np.concatenate([q_dot, np.linalg.solve(D, B @ u - C - G)])\n"
    )
    assert verdict(tmp_path, CART + program) == right


PENDULUM_STEP = (
    "def step(state, action):\n    th = state[0]\n    w = state[1]\n    dt = 0.05\n"
    "    new_w = w + (-m*g*l*np.sin(th)/(I + m*l**2)) * dt\n    new_th = th + new_w * dt\n"
    "    return np.array([new_th, new_w])\n"
)
WITH_STATE = ONE_BODY.replace("[define]\n", "[define]\n'state[0]' = 'th'\n'state[1]' = \"th'\"\n")


def test_a_step_that_gives_a_new_state_back_is_read(tmp_path):
    assert verdict(tmp_path, WITH_STATE + PENDULUM_STEP) == "correct"
    assert verdict(tmp_path, WITH_STATE + PENDULUM_STEP.replace("(-m", "(m")) == "wrong"


@pytest.mark.parametrize(
    ("was", "now"), [("[new_th, new_w]", "[new_w, new_th]"), ("th + new_w", "th + l"), ("2)) * dt", "2))")]
)
def test_a_new_state_that_is_no_step_of_the_old_one_is_refused(tmp_path, was, now):
    with pytest.raises(InvalidInput, match=r"state|step"):
        verdict(tmp_path, WITH_STATE + PENDULUM_STEP.replace(was, now))


@pytest.mark.parametrize(("sign", "right"), [("-", "correct"), ("+", "wrong")])
def test_a_rate_of_a_momentum_that_is_called_ddt_is_no_acceleration(tmp_path, sign, right):
    script = (
        "syms m l g t th(t) q_d\nT = m*l^2*diff(th,t)^2/2;\nV = -m*g*l*cos(th);\nL = T - V;\n"
        "L = subs(L, diff(th,t), q_d);\ndLdqd = diff(L, q_d);\n"
        f"ddt = diff(subs(dLdqd, q_d, diff(th,t)), t);\ndLdq = diff(L, th);\neq1 = ddt {sign} dLdq == 0;\n"
    )
    text = ONE_BODY.replace("inertia = 'I'\n", "").replace('[define]\nw = "th\'"\n', "")
    assert verdict(tmp_path, text + script) == right


AFTER = "void step() { omega += alpha*dt; theta += omega*dt; ALPHA }"
ONE_POINT = ONE_BODY.replace("inertia = 'I'\n", "").replace("coordinate = 'th'", "coordinate = 'theta'").replace(
    "w = \"th'\"", "omega = \"theta'\""
)  # fmt: skip


def test_an_acceleration_for_the_next_step_is_what_the_program_computes_last(tmp_path):
    assert verdict(tmp_path, ONE_POINT + AFTER.replace("ALPHA", "alpha = -g/l*sin(theta);")) == "correct"
    assert verdict(tmp_path, ONE_POINT + AFTER.replace("ALPHA", "alpha = g/l*sin(theta);")) == "wrong"
    with pytest.raises(InvalidInput, match="not said"):
        verdict(tmp_path, ONE_POINT + AFTER.replace("ALPHA", ""))
