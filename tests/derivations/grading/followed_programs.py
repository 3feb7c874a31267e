# ruff: noqa: E501 -- programs stand as people write them
"""Programs as people write them in Python and MATLAB, with single slips of each: data of a test.

The equations are those of textbooks; each slip changes one sign, factor, index or name.
"""

ARM = """system = 'mechanism'
angles = 'relative'
[[bodies]]
coordinate = 'q1'
mass = 'm1'
length = 'l1'
centre = 'lc1'
inertia = 'I1'
drive = 'tau1'
[[bodies]]
coordinate = 'q2'
mass = 'm2'
length = 'l2'
centre = 'lc2'
inertia = 'I2'
drive = 'tau2'
"""

DP = """system = 'mechanism'
angles = 'absolute'
from = 'down'
[[bodies]]
coordinate = 'theta1'
mass = 'm1'
length = 'l1'
[[bodies]]
coordinate = 'theta2'
mass = 'm2'
length = 'l2'
"""

CP = """system = 'mechanism'
[[bodies]]
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'F'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
"""

ONE = """system = 'mechanism'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
damping = 'b'
"""

EL = """system = 'mechanism'
[[bodies]]
coordinate = 'theta'
mass = '0'
length = '0'
[[bodies]]
coordinate = 'r'
joint = 'slide'
mass = 'm'
along = 'link'
spring = 'k'
rest = 'l0'
"""

# name: (file without its program, program, slips as (what stands there, what is put for it))
PROGRAMS = {}

PROGRAMS["class_mcg"] = (
    ARM,
    """
import numpy as np

class TwoLink:
    def __init__(self, m1=1.0, m2=1.0, l1=1.0, l2=1.0, lc1=0.5, lc2=0.5, I1=0.1, I2=0.1, g=9.81):
        self.m1 = m1
        self.m2 = m2
        self.l1 = l1
        self.lc1 = lc1
        self.lc2 = lc2
        self.I1 = I1
        self.I2 = I2
        self.g = g

    def mass_matrix(self, q):
        c2 = np.cos(q[1])
        m11 = self.I1 + self.I2 + self.m1 * self.lc1**2 + self.m2 * (self.l1**2 + self.lc2**2 + 2 * self.l1 * self.lc2 * c2)
        m12 = self.I2 + self.m2 * (self.lc2**2 + self.l1 * self.lc2 * c2)
        m22 = self.I2 + self.m2 * self.lc2**2
        return np.array([[m11, m12], [m12, m22]])

    def coriolis_matrix(self, q, dq):
        h = -self.m2 * self.l1 * self.lc2 * np.sin(q[1])
        return np.array([[h * dq[1], h * (dq[0] + dq[1])], [-h * dq[0], 0.0]])

    def gravity_vector(self, q):
        g1 = (self.m1 * self.lc1 + self.m2 * self.l1) * self.g * np.sin(q[0]) + self.m2 * self.lc2 * self.g * np.sin(q[0] + q[1])
        g2 = self.m2 * self.lc2 * self.g * np.sin(q[0] + q[1])
        return np.array([g1, g2])

    def dynamics(self, t, state, tau):
        q = state[:2]
        dq = state[2:]
        M = self.mass_matrix(q)
        C = self.coriolis_matrix(q, dq)
        G = self.gravity_vector(q)
        ddq = np.linalg.solve(M, tau - C @ dq - G)
        return np.concatenate([dq, ddq])
""",
    [
        ("-h * dq[0], 0.0", "h * dq[0], 0.0"),
        ("h * (dq[0] + dq[1])", "h * (dq[0] - dq[1])"),
        ("self.lc2 * self.g * np.sin(q[0] + q[1])\n        return", "self.lc2 * self.g * np.sin(q[1])\n        return"),
        ("[m12, m22]", "[m12, m11]"),
        ("- C @ dq", "+ C @ dq"),
    ],
)

PROGRAMS["mcg_by_name"] = (
    ARM,
    """
def manipulator(q, qd):
    q1, q2 = q
    q1d, q2d = qd
    M = np.zeros((2, 2))
    M[0, 0] = m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*np.cos(q2)) + I1 + I2
    M[0, 1] = m2*(lc2**2 + l1*lc2*np.cos(q2)) + I2
    M[1, 0] = M[0, 1]
    M[1, 1] = m2*lc2**2 + I2
    h = m2*l1*lc2*np.sin(q2)
    C = np.array([[-h*q2d, -h*(q1d + q2d)], [h*q1d, 0]])
    G = np.array([(m1*lc1 + m2*l1)*g*np.sin(q1) + m2*g*lc2*np.sin(q1 + q2), m2*g*lc2*np.sin(q1 + q2)])
    return M, C, G
""",
    [
        ("[h*q1d, 0]", "[h*q2d, 0]"),
        ("M[1, 0] = M[0, 1]", "M[1, 0] = M[1, 1]"),
        ("2*l1*lc2*np.cos(q2)", "l1*lc2*np.cos(q2)"),
        ("-h*q2d, -h*(", "-h*q2d, h*("),
    ],
)

PROGRAMS["jax_stack"] = (
    """system = 'mechanism'
angles = 'absolute'
from = 'down'
[[bodies]]
coordinate = 'theta1'
mass = 'm'
length = 'l1'
[[bodies]]
coordinate = 'theta2'
mass = 'm'
length = 'l2'
""",
    """
@jax.jit
def f_analytical(state, t=0, m1=1, m2=1, l1=1, l2=1, g=9.8):
    theta1, theta2, w1, w2 = state
    a1 = (l2 / l1) * (m / (m + m)) * jnp.cos(theta1 - theta2)
    a2 = (l1 / l2) * jnp.cos(theta1 - theta2)
    f1 = -(l2 / l1) * (m / (m + m)) * (w2**2) * jnp.sin(theta1 - theta2) - (g / l1) * jnp.sin(theta1)
    f2 = (l1 / l2) * (w1**2) * jnp.sin(theta1 - theta2) - (g / l2) * jnp.sin(theta2)
    g1 = (f1 - a1 * f2) / (1 - a1 * a2)
    g2 = (f2 - a2 * f1) / (1 - a1 * a2)
    return jnp.stack([w1, w2, g1, g2])
""",
    [("(f2 - a2 * f1)", "(f2 - a1 * f1)"), ("(w2**2)", "(w1**2)"), ("- (g / l2)", "- (g / l1)")],
)

PROGRAMS["torch_columns"] = (
    CP,
    """
class CartPole(nn.Module):
    def forward(self, t, state):
        x, x_dot, theta, theta_dot = state[..., 0], state[..., 1], state[..., 2], state[..., 3]
        s, c = torch.sin(theta), torch.cos(theta)
        den = self.M + self.m * s ** 2
        x_acc = (self.F + self.m * s * (self.l * theta_dot.pow(2) + self.g * c)) / den
        theta_acc = (-self.F * c - self.m * self.l * theta_dot.pow(2) * c * s - (self.M + self.m) * self.g * s) / (self.l * den)
        return torch.stack([x_dot, x_acc, theta_dot, theta_acc], dim=-1)
""",
    [
        ("-self.F * c", "self.F * c"),
        ("state[..., 2], state[..., 3]", "state[..., 3], state[..., 2]"),
        ("self.m * s ** 2", "self.m * c ** 2"),
        (".pow(2) * c * s", ".pow(2) * s * s"),
    ],
)

PROGRAMS["matlab_many"] = (
    CP,
    """
function dz = cartPoleDynamics(z,u,p)
% z = [4,n]
m1 = p.m1; m2 = p.m2; g = p.g; l = p.l;
x = z(1,:);
theta = z(2,:);
dx = z(3,:);
dtheta = z(4,:);
F = u;
ddx = (l*m.*sin(theta).*dtheta.^2 + F + m*g.*cos(theta).*sin(theta))./(M + m.*(1-cos(theta).^2));
ddtheta = -(l*m.*cos(theta).*sin(theta).*dtheta.^2 + F.*cos(theta) + (M+m).*g.*sin(theta))./(l*M + l*m.*(1-cos(theta).^2));
dz = [dx;dtheta;ddx;ddtheta];
end
""",
    [
        ("1-cos(theta).^2", "1+cos(theta).^2"),
        ("(M+m).*g", "M.*g"),
        ("[dx;dtheta;ddx;ddtheta]", "[dx;dtheta;ddtheta;ddx]"),
        ("z(3,:)", "z(4,:)"),
    ],
)

PROGRAMS["matlab_outputs"] = (
    CP,
    """
function [ddx, ddth] = autoGen_cartPole(th, dth, F, M, m, g, l)
%AUTOGEN
t2 = cos(th);
t3 = sin(th);
t4 = t2.^2;
t5 = m.*t4;
t6 = dth.^2;
t7 = M + m - t5;
ddx = (F + m.*g.*t2.*t3 + l.*m.*t3.*t6)./t7;
ddth = -(t2.*F + (M+m).*g.*t3 + l.*m.*t2.*t3.*t6)./(l.*t7);
end
""",
    [("t5 = m.*t4", "t5 = M.*t4"), ("dth.^2", "dth"), ("(l.*t7)", "t7")],
)

PROGRAMS["matlab_inv"] = (
    ARM,
    """
function dx = two_link(t, x, tau, param)
q = x(1:2);
dq = x(3:4);
m1 = param.m1; m2 = param.m2; l1 = param.l1; lc1 = param.lc1; lc2 = param.lc2; I1 = param.I1; I2 = param.I2; g = param.g;
D = [m1*lc1^2+m2*(l1^2+lc2^2+2*l1*lc2*cos(q(2)))+I1+I2, m2*(lc2^2+l1*lc2*cos(q(2)))+I2;
     m2*(lc2^2+l1*lc2*cos(q(2)))+I2, m2*lc2^2+I2];
h = -m2*l1*lc2*sin(q(2));
C = [h*dq(2) h*dq(2)+h*dq(1);
    -h*dq(1) 0];
G = [(m1*lc1+m2*l1)*g*sin(q(1))+m2*lc2*g*sin(q(1)+q(2)); m2*lc2*g*sin(q(1)+q(2))];
ddq = inv(D)*(tau - C*dq - G);
dx = [dq; ddq];
end
""",
    [
        ("h*dq(2)+h*dq(1)", "h*dq(2)-h*dq(1)"),
        ("h*dq(2)+h*dq(1)", "h*dq(2) +h*dq(1)"),
        ("x(3:4)", "x(2:3)"),
        ("-h*dq(1) 0", "h*dq(1) 0"),
        ("inv(D)*", "D*"),
        ("+I1+I2, m2", "+I1-I2, m2"),
    ],
)

PROGRAMS["lambda_ivp"] = (
    """system = 'mechanism'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
""",
    """
import numpy as np
from scipy.integrate import solve_ivp
g = 9.81
l = 1.0
sol = solve_ivp(lambda t, y: [y[1], -g/l*np.sin(y[0])], [0, 10], [0.1, 0], max_step=0.01)
plt.plot(sol.t, sol.y[0])
""",
    [("-g/l*np.sin", "-g*l*np.sin"), ("-g/l*np.sin", "g/l*np.sin"), ("np.sin(y[0])", "np.sin(y[1])")],
)

PROGRAMS["sympy_matrix"] = (
    DP,
    """
import sympy as sp
t = sp.symbols('t')
m1, m2, l1, l2, g = sp.symbols('m1 m2 l1 l2 g')
theta1, theta2, omega1, omega2 = sp.symbols('theta1 theta2 omega1 omega2')
M = sp.Matrix([[(m1 + m2)*l1, m2*l2*sp.cos(theta1 - theta2)],
               [l1*sp.cos(theta1 - theta2), l2]])
F = sp.Matrix([-m2*l2*omega2**2*sp.sin(theta1 - theta2) - (m1 + m2)*g*sp.sin(theta1),
               l1*omega1**2*sp.sin(theta1 - theta2) - g*sp.sin(theta2)])
acc = sp.simplify(M.inv()*F)
alpha1 = acc[0]
alpha2 = acc[1]
""",
    [
        ("[l1*sp.cos", "[l2*sp.cos"),
        ("l1*omega1**2", "l1*omega2**2"),
        ("alpha1 = acc[0]\nalpha2 = acc[1]", "alpha1 = acc[1]\nalpha2 = acc[0]"),
    ],
)

PROGRAMS["casadi_py"] = (
    CP,
    """
x = ca.SX.sym('x')
theta = ca.SX.sym('theta')
v = ca.SX.sym('v')
dtheta = ca.SX.sym('dtheta')
F = ca.SX.sym('F')
state = ca.vertcat(x, theta, v, dtheta)
denominator = M + m - m*ca.cos(theta)*ca.cos(theta)
f_expl = ca.vertcat(v,
                 dtheta,
                 (m*l*ca.sin(theta)*dtheta*dtheta + m*g*ca.cos(theta)*ca.sin(theta)+F)/denominator,
                 (-m*l*ca.cos(theta)*ca.sin(theta)*dtheta*dtheta - F*ca.cos(theta)-(M+m)*g*ca.sin(theta))/(l*denominator)
                 )
f = ca.Function('f', [state, F], [f_expl])
""",
    [
        ("m*g*ca.cos(theta)*ca.sin(theta)+F", "m*g*ca.cos(theta)*ca.sin(theta)-F"),
        ("-(M+m)*g*ca", "-(M-m)*g*ca"),
        ("(l*denominator)", "denominator"),
    ],
)

PROGRAMS["in_place"] = (
    DP,
    """
def rhs(t, y, p):
    theta1, theta2, w1, w2 = y
    d = theta1 - theta2
    b = np.zeros(2)
    b[1] += p["l1"] * w1**2 * np.sin(d)
    b[1] -= p["g"] * np.sin(theta2)
    b[0] -= p["m2"] * p["l2"] * w2**2 * np.sin(d)
    b[0] -= (p["m1"] + p["m2"]) * p["g"] * np.sin(theta1)
    A = np.array([[(p["m1"] + p["m2"]) * p["l1"], p["m2"] * p["l2"] * np.cos(d)], [p["l1"] * np.cos(d), p["l2"]]])
    det = A[0][0] * A[1][1] - A[0][1] * A[1][0]
    acc = np.array([A[1][1] * b[0] - A[0][1] * b[1], A[0][0] * b[1] - A[1][0] * b[0]])
    acc /= det
    out = np.empty(4)
    out[2:] = acc
    out[:2] = y[2:]
    return out
""",
    [
        ("b[1] -= p", "b[1] += p"),
        ("- A[1][0] * b[0]", "- A[0][1] * b[0]"),
        ("acc /= det", "acc *= det"),
        ("out[:2] = y[2:]", "out[:2] = y[:2]"),
    ],
)

PROGRAMS["gym_step"] = (
    """system = 'mechanism'
[[bodies]]
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'F'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = '2*l'
centre = 'l'
inertia = 'm*l^2/3'
""",
    """
class CartPoleEnv(gym.Env):
    def __init__(self):
        self.gravity = 9.8
        self.M = 1.0
        self.m = 0.1
        self.total_mass = self.m + self.M
        self.l = 0.5  # actually half the pole's length
        self.polemass_length = self.m * self.l
        self.force_mag = 10.0
        self.tau = 0.02

    def step(self, action):
        x, x_dot, theta, theta_dot = self.state
        F = self.force_mag if action == 1 else -self.force_mag
        costheta = math.cos(theta)
        sintheta = math.sin(theta)
        temp = (F + self.polemass_length * theta_dot**2 * sintheta) / self.total_mass
        thetaacc = (self.gravity * sintheta - costheta * temp) / (
            self.l * (4.0 / 3.0 - self.m * costheta**2 / self.total_mass)
        )
        xacc = temp - self.polemass_length * thetaacc * costheta / self.total_mass
        x = x + self.tau * x_dot
        x_dot = x_dot + self.tau * xacc
        theta = theta + self.tau * theta_dot
        theta_dot = theta_dot + self.tau * thetaacc
        self.state = (x, x_dot, theta, theta_dot)
        return np.array(self.state), reward, done, {}
""",
    [
        ("self.gravity * sintheta - costheta", "self.gravity * sintheta + costheta"),
        ("4.0 / 3.0", "4.0 / 6.0"),
        ("theta_dot**2 * sintheta", "theta_dot * sintheta"),
        ("temp - self", "temp + self"),
    ],
)

PROGRAMS["momenta_py"] = (
    DP,
    """
def hamilton(t, y):
    theta1, theta2, p1, p2 = y
    d = theta1 - theta2
    den = m1 + m2*np.sin(d)**2
    dtheta1 = (l2*p1 - l1*p2*np.cos(d))/(l1**2*l2*den)
    dtheta2 = (l1*(m1 + m2)*p2 - l2*m2*p1*np.cos(d))/(l1*l2**2*m2*den)
    C1 = p1*p2*np.sin(d)/(l1*l2*den)
    C2 = (l2**2*m2*p1**2 + l1**2*(m1 + m2)*p2**2 - 2*l1*l2*m2*p1*p2*np.cos(d))*np.sin(2*d)/(2*l1**2*l2**2*den**2)
    dp1 = -(m1 + m2)*g*l1*np.sin(theta1) - C1 + C2
    dp2 = -m2*g*l2*np.sin(theta2) + C1 - C2
    return [dtheta1, dtheta2, dp1, dp2]
""",
    [
        ("- 2*l1*l2", "- l1*l2"),
        ("- C1 + C2", "+ C1 + C2"),
        ("np.sin(2*d)/", "np.sin(d)/"),
        ("l2*m2*p1*np.cos", "l2*m1*p1*np.cos"),
    ],
)

PROGRAMS["momentum_one"] = (
    """system = 'mechanism'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
""",
    """
def f(y, t):
    theta = y[0]
    p_theta = y[1]
    dy = np.zeros_like(y)
    dy[1] = -m*g*l*np.sin(theta)
    dy[0] = p_theta/(m*l**2)
    return dy
""",
    [("(m*l**2)", "(m*l)"), ("-m*g*l", "m*g*l")],
)

PROGRAMS["matlab_row"] = (
    ONE,
    """
function dydt = pendulum(t,y)
global m l b g
theta = y(1); omega = y(2);
dydt = [omega, -(b/(m*l^2))*omega - (g/l)*sin(theta)]';
""",
    [("(m*l^2)", "(m*l)"), ("- (g/l)", "+ (g/l)"), ("[omega, -(b", "[omega, (b")],
)

PROGRAMS["matlab_handle"] = (
    ONE,
    """
m = 1; l = 0.5; b = 0.1; g = 9.81;
f = @(t, x) [x(2); -g/l*sin(x(1)) - b/(m*l^2)*x(2)];
[t, x] = ode45(f, [0 10], [pi/4; 0]);
plot(t, x(:,1));
""",
    [("sin(x(1))", "sin(x(2))"), ("- b/", "+ b/"), ("-g/l", "-g*l")],
)

PROGRAMS["octave"] = (
    ONE,
    """
1;
function xdot = f (x, t)
  # pendulum
  global g l b m;
  xdot = zeros (2, 1);
  xdot(2) = -g / l * sin (x(1)) ...
     - b / (m * l^2) * x(2);
  xdot(1) = x(2);
endfunction
x = lsode ("f", [1; 0], linspace (0, 10, 100));
""",
    [("- b /", "+ b /"), ("xdot(1) = x(2)", "xdot(1) = x(1)"), ("-g / l", "g / l")],
)

PROGRAMS["fill_any"] = (
    EL,
    """
def spring_pendulum(t, state, params):
    r, theta, rdot, thetadot = state
    m, k, l0, g = params
    d = [0, 0, 0, 0]
    d[3] = -(g*np.sin(theta) + 2*rdot*thetadot)/r
    d[0] = rdot
    d[2] = r*thetadot**2 + g*np.cos(theta) - (k/m)*(r - l0)
    d[1] = thetadot
    return d
""",
    [("2*rdot*thetadot", "rdot*thetadot"), ("(r - l0)", "(r + l0)"), ("g*np.cos", "-g*np.cos")],
)

PROGRAMS["scalars"] = (
    DP,
    """
def accelerations(theta1, theta2, omega1, omega2):
    delta = theta2 - theta1
    den1 = (m1 + m2) * l1 - m2 * l1 * math.cos(delta) * math.cos(delta)
    alpha1 = (m2 * l1 * omega1 * omega1 * math.sin(delta) * math.cos(delta)
              + m2 * g * math.sin(theta2) * math.cos(delta)
              + m2 * l2 * omega2 * omega2 * math.sin(delta)
              - (m1 + m2) * g * math.sin(theta1)) / den1
    den2 = (l2 / l1) * den1
    alpha2 = (-m2 * l2 * omega2 * omega2 * math.sin(delta) * math.cos(delta)
              + (m1 + m2) * g * math.sin(theta1) * math.cos(delta)
              - (m1 + m2) * l1 * omega1 * omega1 * math.sin(delta)
              - (m1 + m2) * g * math.sin(theta2)) / den2
    return alpha1, alpha2
""",
    [
        ("(l2 / l1)", "(l1 / l2)"),
        ("(-m2 * l2", "(m2 * l2"),
        ("return alpha1, alpha2", "return alpha2, alpha1"),
        (
            "omega1 * omega1 * math.sin(delta)\n              - (m1",
            "omega1 * omega2 * math.sin(delta)\n              - (m1",
        ),
    ],
)

PROGRAMS["helpers"] = (
    DP,
    """
def delta(y):
    return y[0] - y[2]

def denominator(y):
    return 2*m1 + m2 - m2*np.cos(2*delta(y))

def a1(y):
    theta1, w1, theta2, w2 = y
    return (-g*(2*m1 + m2)*np.sin(theta1) - m2*g*np.sin(theta1 - 2*theta2)
            - 2*np.sin(delta(y))*m2*(w2**2*l2 + w1**2*l1*np.cos(delta(y))))/(l1*denominator(y))

def a2(y):
    theta1, w1, theta2, w2 = y
    return (2*np.sin(delta(y))*(w1**2*l1*(m1 + m2) + g*(m1 + m2)*np.cos(theta1)
            + w2**2*l2*m2*np.cos(delta(y))))/(l2*denominator(y))

def derivs(y, t):
    return np.array([y[1], a1(y), y[3], a2(y)])
""",
    [
        ("y[0] - y[2]", "y[0] + y[2]"),
        ("2*m1 + m2 - m2*np", "2*m1 + m2 + m2*np"),
        ("[y[1], a1(y), y[3], a2(y)]", "[y[1], a2(y), y[3], a1(y)]"),
        ("theta1 - 2*theta2", "theta1 - theta2"),
    ],
)

PROGRAMS["greek"] = (
    DP,
    """
def système(t, Y):
    θ1, θ2, ω1, ω2 = Y
    Δ = θ1 - θ2
    M = np.array([[(m1 + m2)*l1, m2*l2*np.cos(Δ)], [l1*np.cos(Δ), l2]])
    F = np.array([[-m2*l2*ω2**2*np.sin(Δ) - (m1 + m2)*g*np.sin(θ1)], [l1*ω1**2*np.sin(Δ) - g*np.sin(θ2)]])
    α = np.linalg.inv(M).dot(F)
    return [ω1, ω2, α[0, 0], α[1, 0]]
""",
    [("α[0, 0], α[1, 0]", "α[1, 0], α[0, 0]"), ("[l1*np.cos(Δ), l2]", "[l1*np.sin(Δ), l2]"), ("np.linalg.inv(M)", "M")],
)

PROGRAMS["nargin"] = (
    """system = 'mechanism'
[[bodies]]
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'F'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[define]
'x(1)' = 'x'
'x(3)' = 'theta'
""",
    """
function xdot = cartpend(t, x, F, P)
% x(3) angle
if nargin < 3
    F = 0;
end
M = P.M; m = P.m; l = P.l; g = P.g;
Sx = sin(x(3));
Cx = cos(x(3));
D = m*l*l*(M+m*(1-Cx^2));
xdot(1,1) = x(2);
xdot(2,1) = (1/D)*(m^2*l^2*g*Cx*Sx + m*l^2*(m*l*x(4)^2*Sx)) + m*l*l*(1/D)*F;
xdot(3,1) = x(4);
xdot(4,1) = (1/D)*(-(m+M)*m*g*l*Sx - m*l*Cx*(m*l*x(4)^2*Sx)) - m*l*Cx*(1/D)*F;
""",
    [("- m*l*Cx*(1/D)*F", "+ m*l*Cx*(1/D)*F"), ("m^2*l^2*g", "m^2*l*g"), ("x(4)^2*Sx)) +", "x(2)^2*Sx)) +")],
)

PROGRAMS["tau_row"] = (
    """system = 'mechanism'
angles = 'relative'
[[bodies]]
coordinate = 'q1'
mass = 'm1'
length = 'l1'
centre = 'lc1'
inertia = 'I1'
drive = 'tau1'
[[bodies]]
coordinate = 'q2'
mass = 'm2'
length = 'l2'
centre = 'lc2'
inertia = 'I2'
drive = 'tau2'
[define]
tau = '[tau1; tau2]'
""",
    """
q = [q1; q2];
dq = [dq1; dq2];
ddq = [ddq1; ddq2];
a1 = I1 + I2 + m1*lc1^2 + m2*(l1^2 + lc2^2);
a2 = m2*l1*lc2;
a3 = I2 + m2*lc2^2;
M = [a1 + 2*a2*cos(q2), a3 + a2*cos(q2); a3 + a2*cos(q2), a3];
V = a2*sin(q2)*[-(2*dq1*dq2 + dq2^2); dq1^2];
G = g*[(m1*lc1 + m2*l1)*sin(q1) + m2*lc2*sin(q1+q2); m2*lc2*sin(q1+q2)];
tau = M*ddq + V + G;
""",
    [("-(2*dq1*dq2", "-(dq1*dq2"), ("+ V + G", "- V + G"), ("a3 + a2*cos(q2), a3]", "a3 - a2*cos(q2), a3]")],
)

PROGRAMS["scipy_nested"] = (
    CP,
    """
def make_dynamics(M, m, l, g):
    def dynamics(t, y, F):
        x, v, theta, omega = y
        A = [[M + m, m*l*cos(theta)], [cos(theta), l]]
        b = [F + m*l*omega**2*sin(theta), -g*sin(theta)]
        xdd, thdd = np.linalg.solve(A, b)
        return [v, xdd, omega, thdd]
    return dynamics
""",
    [("-g*sin", "g*sin"), ("[cos(theta), l]", "[cos(theta), 1]"), ("omega**2*sin", "omega**2*cos")],
)

PROGRAMS["matlab_tutorial"] = (
    """system = 'mechanism'
[[bodies]]
coordinate = 'x'
joint = 'slide'
mass = 'M'
drive = 'u'
damping = 'b'
[[bodies]]
coordinate = 'phi'
mass = 'm'
length = '2*l'
centre = 'l'
inertia = 'I'
""",
    """
function xdot = pend(t, x, u)
M = .5; m = 0.2; b = 0.1; I = 0.006; g = 9.8; l = 0.3;
phi = x(3); xd = x(2); phid = x(4);
A = [M+m, m*l*cos(phi); m*l*cos(phi), I+m*l^2];
B = [u - b*xd + m*l*phid^2*sin(phi); -m*g*l*sin(phi)];
acc = A\\B;
xdot = [xd; acc(1); phid; acc(2)];
""",
    [("u - b*xd", "u + b*xd"), ("I+m*l^2", "m*l^2"), ("-m*g*l", "-m*g"), ("acc(2)", "acc(1)"), ("A\\B", "B\\A")],
)

PROGRAMS["acrobot_mat"] = (
    """system = 'mechanism'
angles = 'relative'
[[bodies]]
coordinate = 'q1'
mass = 'm1'
length = 'l1'
centre = 'lc1'
inertia = 'I1'
[[bodies]]
coordinate = 'q2'
mass = 'm2'
length = 'l2'
centre = 'lc2'
inertia = 'I2'
drive = 'tau2'
""",
    """
classdef Acrobot
  properties
    m1 = 1; m2 = 1;
    l1 = 1; l2 = 1;
    g = 9.81;
  end
  methods
    function [H,C,B] = manipulatorEquations(obj,q,qd)
      % keep it readable:
      m1=obj.m1; m2=obj.m2; l1=obj.l1; g=obj.g; lc1=obj.lc1; lc2=obj.lc2; b1=obj.b1; b2=obj.b2;
      I1 = obj.I1; I2 = obj.I2;
      m2l1lc2 = m2*l1*lc2;  % occurs often!
      c = cos(q(1:2,:));  s = sin(q(1:2,:));  s12 = sin(q(1,:)+q(2,:));
      h12 = I2 + m2*lc2^2 + m2l1lc2*c(2);
      H = [ I1 + m1*lc1^2 + I2 + m2*lc2^2 + m2*l1^2 + 2*m2l1lc2*c(2), h12; h12, I2 + m2*lc2^2 ];
      C = [ -2*m2l1lc2*s(2)*qd(2), -m2l1lc2*s(2)*qd(2); m2l1lc2*s(2)*qd(1), 0 ];
      G = g*[ m1*lc1*s(1) + m2*(l1*s(1)+lc2*s12); m2*lc2*s12 ];
      C = C*qd + G;
      B = [0; 1];
    end
  end
end
""",
    [
        ("-2*m2l1lc2*s(2)*qd(2)", "-m2l1lc2*s(2)*qd(2)"),
        ("I2 + m2*lc2^2 ]", "I2 + m1*lc2^2 ]"),
        ("B = [0; 1]", "B = [1; 0]"),
    ],
)

PROGRAMS["drake_py"] = (
    ARM,
    """
def MassMatrix(self, q):
    c2 = cos(q[1])
    return np.array([[self.I1 + self.I2 + self.m1*self.lc1**2 + self.m2*(self.l1**2 + self.lc2**2) + 2*self.m2*self.l1*self.lc2*c2,
                      self.I2 + self.m2*self.lc2**2 + self.m2*self.l1*self.lc2*c2],
                     [self.I2 + self.m2*self.lc2**2 + self.m2*self.l1*self.lc2*c2, self.I2 + self.m2*self.lc2**2]])

def CoriolisTerm(self, q, qd):
    s2 = sin(q[1])
    return np.array([-2*self.m2*self.l1*self.lc2*s2*qd[0]*qd[1] - self.m2*self.l1*self.lc2*s2*qd[1]**2,
                     self.m2*self.l1*self.lc2*s2*qd[0]**2])

def GravityTerm(self, q):
    return np.array([self.m1*self.g*self.lc1*sin(q[0]) + self.m2*self.g*(self.l1*sin(q[0]) + self.lc2*sin(q[0] + q[1])),
                     self.m2*self.g*self.lc2*sin(q[0] + q[1])])

def forward_dynamics(self, q, qd, tau):
    return np.linalg.inv(self.MassMatrix(q)) @ (tau - self.CoriolisTerm(q, qd) - self.GravityTerm(q))
""",
    [("qd[0]*qd[1] -", "qd[0]*qd[1] +"), ("@ (tau -", "@ (tau +"), ("self.l1*sin(q[0])", "self.l1*sin(q[1])")],
)

PROGRAMS["loop_matlab"] = (
    DP,
    """
function dy = dp(t, y, m1, m2, l1, l2, g)
th = y(1:2); w = y(3:4);
M = zeros(2);
M(1,1) = (m1+m2)*l1^2;
M(1,2) = m2*l1*l2*cos(th(1)-th(2));
M(2,1) = M(1,2);
M(2,2) = m2*l2^2;
f = zeros(2,1);
f(1) = -m2*l1*l2*w(2)^2*sin(th(1)-th(2)) - (m1+m2)*g*l1*sin(th(1));
f(2) = m2*l1*l2*w(1)^2*sin(th(1)-th(2)) - m2*g*l2*sin(th(2));
dy = zeros(4,1);
for i = 1:2
    dy(i) = w(i);
end
dy(3:4) = M\\f;
end
""",
    [
        ("w(1)^2", "w(2)^2"),
        ("M(2,1) = M(1,2)", "M(2,1) = M(2,2)"),
        ("dy(i) = w(i)", "dy(i) = th(i)"),
        ("zeros(2,1)", "zeros(1,2)"),
        ("f(2) = m2", "f(1) = m2"),
    ],
)

PROGRAMS["spring_self"] = (
    EL,
    """
class Spring:
    def __init__(self, params):
        self.k = params['k']
        self.m = params['m']
        self.l0 = params['l0']
        self.g = params.get('g', 9.81)
        self.w2 = self.k / self.m

    def __call__(self, t, s):
        r, rd, theta, td = s
        rdd = r * td**2 - self.w2 * (r - self.l0) + self.g * np.cos(theta)
        tdd = -(2 * rd * td + self.g * np.sin(theta)) / r
        return rd, rdd, td, tdd
""",
    [
        ("self.k / self.m", "self.m / self.k"),
        ("2 * rd * td", "rd * td"),
        ("- self.w2", "+ self.w2"),
        ("return rd, rdd, td, tdd", "return td, rdd, rd, tdd"),
    ],
)

PROGRAMS["fortranish"] = (
    DP,
    """
def DP(y, t, *args):
    g, l1, l2, m1, m2 = args
    theta1 = y[0]; theta2 = y[1]; w1 = y[2]; w2 = y[3]
    cd = np.cos(theta1-theta2); sd = np.sin(theta1-theta2)
    mu = 1 + m1/m2
    dydt = [w1, w2, None, None]
    dydt[2] = (g*(np.sin(theta2)*cd - mu*np.sin(theta1)) - (l2*w2**2 + l1*w1**2*cd)*sd)/(l1*(mu - cd**2))
    dydt[3] = (g*mu*(np.sin(theta1)*cd - np.sin(theta2)) + (mu*l1*w1**2 + l2*w2**2*cd)*sd)/(l2*(mu - cd**2))
    return dydt
""",
    [
        ("1 + m1/m2", "1 + m2/m1"),
        ("- mu*np", "+ mu*np"),
        ("mu*l1*w1**2", "l1*w1**2"),
        ("l2*(mu - cd**2)", "l1*(mu - cd**2)"),
    ],
)

PROGRAMS["int_names"] = (
    """system = 'mechanism'
angles = 'absolute'
from = 'down'
[[bodies]]
coordinate = 'phi1'
mass = 'm1'
length = 'l1'
[[bodies]]
coordinate = 'phi2'
mass = 'm2'
length = 'l2'
""",
    """
function ydot = doppelpendel(t, y)
global m1 m2 l1 l2 g
phi1 = y(1); dphi1 = y(2); phi2 = y(3); dphi2 = y(4);
dphi = phi1 - phi2;
N = m1 + m2*sin(dphi)^2;
ydot = zeros(size(y));
ydot(1) = dphi1;
ydot(2) = (-m2*l1*dphi1^2*sin(dphi)*cos(dphi) + m2*g*sin(phi2)*cos(dphi) ...
    - m2*l2*dphi2^2*sin(dphi) - (m1+m2)*g*sin(phi1)) / (l1*N);
ydot(3) = dphi2;
ydot(4) = (m2*l2*dphi2^2*sin(dphi)*cos(dphi) + (m1+m2)*(g*sin(phi1)*cos(dphi) ...
    + l1*dphi1^2*sin(dphi) - g*sin(phi2))) / (l2*N);
""",
    [
        ("ydot(3) = dphi2", "ydot(3) = dphi1"),
        ("(l2*N)", "(l1*N)"),
        ("- m2*l2*dphi2^2", "+ m2*l2*dphi2^2"),
        ("sin(phi1)*cos(dphi) ...\n    + l1", "sin(phi1)*sin(dphi) ...\n    + l1"),
    ],
)

PROGRAMS["sympy_lambdified"] = (
    CP,
    """
from sympy import symbols, cos, sin, Matrix
x, xd, theta, thetad, M, m, l, g, F = symbols("x xd theta thetad M m l g F")
mass = Matrix([[M + m, m*l*cos(theta)], [m*l*cos(theta), m*l**2]])
rhs = Matrix([[F + m*l*thetad**2*sin(theta)], [-m*g*l*sin(theta)]])
qdd = mass.LUsolve(rhs)
xdd, thetadd = qdd
""",
    [("m*l**2]]", "m*l]]"), ("thetad**2*sin", "thetad**2*cos"), ("xdd, thetadd = qdd", "thetadd, xdd = qdd")],
)

PROGRAMS["casadi_mat"] = (
    CP,
    """
import casadi.*
x1 = SX.sym('x'); theta = SX.sym('theta'); v = SX.sym('v'); omega = SX.sym('omega'); F = SX.sym('F');
x = [x1; theta; v; omega];
den = M + m - m*cos(theta)^2;
f_expl = [ v; ...
           omega; ...
           (m*l*sin(theta)*omega^2 + m*g*cos(theta)*sin(theta)+F)/den; ...
           (-m*l*cos(theta)*sin(theta)*omega^2 - F*cos(theta)-(M+m)*g*sin(theta))/(l*den)];
""",
    [("(l*den)", "den"), ("- F*cos", "+ F*cos"), ("omega^2 + m", "omega + m")],
)

PROGRAMS["with_energy"] = (
    DP,
    """
def delta(y):
    return y[0] - y[2]

def denominator(y):
    return 2*m1 + m2 - m2*np.cos(2*delta(y))

def a1(y):
    theta1, w1, theta2, w2 = y
    return (-g*(2*m1 + m2)*np.sin(theta1) - m2*g*np.sin(theta1 - 2*theta2)
            - 2*np.sin(delta(y))*m2*(w2**2*l2 + w1**2*l1*np.cos(delta(y))))/(l1*denominator(y))

def a2(y):
    theta1, w1, theta2, w2 = y
    return (2*np.sin(delta(y))*(w1**2*l1*(m1 + m2) + g*(m1 + m2)*np.cos(theta1)
            + w2**2*l2*m2*np.cos(delta(y))))/(l2*denominator(y))

def derivs(y, t):
    return np.array([y[1], a1(y), y[3], a2(y)])

def energy(y):
    theta1, w1, theta2, w2 = y
    T = 0.5*m1*(l1*w1)**2 + 0.5*m2*((l1*w1)**2 + (l2*w2)**2 + 2*l1*l2*w1*w2*np.cos(theta1-theta2))
    V = -(m1+m2)*l1*g*np.cos(theta1) - m2*l2*g*np.cos(theta2)
    return T, V
""",
    [("w2**2*l2*m2", "w1**2*l2*m2")],
)

PROGRAMS["kwargs"] = (
    ONE,
    """
def pend(t, y, **kw):
    th, om = y
    dth = om
    dom = -(kw["g"] / kw["l"]) * np.sin(th) - kw["b"] * om / (kw["m"] * kw["l"] ** 2)
    return np.array((dth, dom), dtype=float)
""",
    [('kw["l"] ** 2', 'kw["l"]'), ("- kw", "+ kw")],
)

PROGRAMS["numba"] = (
    DP,
    """
@njit(cache=True)
def deriv(y, out, m1, m2, l1, l2, g):
    theta1 = y[0]
    theta2 = y[1]
    w1 = y[2]
    w2 = y[3]
    s = np.sin(theta1 - theta2)
    c = np.cos(theta1 - theta2)
    f1 = -m2*l2*w2*w2*s - (m1+m2)*g*np.sin(theta1)
    f2 = m2*l1*w1*w1*s - m2*g*np.sin(theta2)
    det = l1*l2*(m1 + m2*s*s)
    out[0] = w1
    out[1] = w2
    out[2] = (l2*f1 - l2*c*f2)/det
    out[3] = ((m1+m2)*l1*f2/m2 - l1*c*f1)/det
""",
    [
        ("out[2] = (l2*f1", "out[2] = (l1*f1"),
        ("s*s)", "c*c)"),
        ("out[0] = w1\n    out[1] = w2", "out[0] = w2\n    out[1] = w1"),
    ],
)

PROGRAMS["sum_torque"] = (
    ARM,
    """
function qdd = FDab(q, qd, tau, p)
  H = [p.I1+p.I2+p.m1*p.lc1^2+p.m2*(p.l1^2+p.lc2^2+2*p.l1*p.lc2*cos(q(2))) , p.I2+p.m2*(p.lc2^2+p.l1*p.lc2*cos(q(2))) ; p.I2+p.m2*(p.lc2^2+p.l1*p.lc2*cos(q(2))) , p.I2+p.m2*p.lc2^2];
  h = p.m2*p.l1*p.lc2*sin(q(2));
  C(1,1) = -h*(2*qd(1)*qd(2)+qd(2)^2) + (p.m1*p.lc1+p.m2*p.l1)*p.g*sin(q(1)) + p.m2*p.lc2*p.g*sin(q(1)+q(2));
  C(2,1) = h*qd(1)^2 + p.m2*p.lc2*p.g*sin(q(1)+q(2));
  qdd = H \\ (tau - C);
end
""",
    [("2*qd(1)*qd(2)", "qd(1)*qd(2)"), ("(tau - C)", "(tau + C)"), ("C(2,1) = h", "C(2,1) = -h")],
)

PROGRAMS["wheel"] = (
    """system = 'mechanism'
angles = 'absolute'
[[bodies]]
coordinate = 'theta'
mass = 'm1'
length = 'l1'
centre = 'lc1'
inertia = 'I1'
[[bodies]]
coordinate = 'phi'
mass = 'm2'
length = '0'
inertia = 'I2'
drive = 'tau'
""",
    """
def rwp(x, u):
    theta, phi, thetadot, phidot = x
    tau = u[0]
    ml = self.m1*self.lc1 + self.m2*self.l1
    J = self.I1 + self.m1*self.lc1**2 + self.m2*self.l1**2
    thetaddot = (-ml*self.g*np.sin(theta) - tau)/J
    phiddot = tau/self.I2
    return np.asarray([thetadot, phidot, thetaddot, phiddot])
""",
    [("- tau)/J", "+ tau)/J"), ("self.m2*self.l1**2", "self.m2*self.lc1**2"), ("tau/self.I2", "tau/self.I1")],
)

PROGRAMS["lists"] = (
    DP,
    """
def eqs(t, z, m, L, g):
    theta1, w1, theta2, w2 = z
    D = theta1 - theta2
    a11, a12 = (m[0]+m[1])*L[0], m[1]*L[1]*np.cos(D)
    a21, a22 = L[0]*np.cos(D), L[1]
    b1 = -m[1]*L[1]*w2**2*np.sin(D) - (m[0]+m[1])*g*np.sin(theta1)
    b2 = L[0]*w1**2*np.sin(D) - g*np.sin(theta2)
    det = a11*a22 - a12*a21
    return [w1, (a22*b1 - a12*b2)/det, w2, (a11*b2 - a21*b1)/det]
""",
    [("m[1]*L[1]*np", "m[0]*L[1]*np"), ("a11*b2 - a21*b1", "a11*b2 + a21*b1"), ("L[0]*w1**2", "L[1]*w1**2")],
)

REFUSED = {}

REFUSED["if_else"] = (
    ONE,
    """
def f(t, y):
    theta, omega = y
    if theta > 3:
        omega = 0
    return [omega, -g/l*np.sin(theta) - b/(m*l**2)*omega]
""",
)

REFUSED["mutation"] = (
    ONE,
    """
def f(t, y):
    y[1] = y[1]*2
    return [y[1], -g/l*np.sin(y[0]) - b/(m*l**2)*y[1]]
""",
)

REFUSED["energy_only"] = (
    DP,
    """
def energy(theta1, theta2, w1, w2):
    T = 0.5*(m1+m2)*l1**2*w1**2
    V = -m1*g*l1*np.cos(theta1)
    return T, V
""",
)

REFUSED["two_fns"] = (
    ONE,
    """
def damped(t, y):
    theta, omega = y
    return [omega, -g/l*np.sin(theta) - b/(m*l**2)*omega]

def undamped(t, y):
    theta, omega = y
    return [omega, -g/l*np.sin(theta)]
""",
)
