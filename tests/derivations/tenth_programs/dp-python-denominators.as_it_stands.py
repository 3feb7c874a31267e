import numpy as np
from scipy.integrate import solve_ivp

g = 9.8
L1 = 1.0
L2 = 1.0
m1 = 1.0
m2 = 1.0


def double_pendulum(t, y):
    theta1, z1, theta2, z2 = y
    delta = theta2 - theta1

    denominator1 = (m1 + m2) * L1 - m2 * L1 * np.cos(delta)**2
    denominator2 = (L2 / L1) * denominator1

    theta1_dot = z1
    theta2_dot = z2

    z1_dot = (
        m2 * L1 * z1**2 * np.sin(delta) * np.cos(delta)
        + m2 * g * np.sin(theta2) * np.cos(delta)
        + m2 * L2 * z2**2 * np.sin(delta)
        - (m1 + m2) * g * np.sin(theta1)
    ) / denominator1

    z2_dot = (
        -m2 * L2 * z2**2 * np.sin(delta) * np.cos(delta)
        + (m1 + m2) * g * np.sin(theta1) * np.cos(delta)
        - (m1 + m2) * L1 * z1**2 * np.sin(delta)
        - (m1 + m2) * g * np.sin(theta2)
    ) / denominator2

    return [theta1_dot, z1_dot, theta2_dot, z2_dot]


sol = solve_ivp(double_pendulum, (0, 10), [np.pi / 2, 0.0, np.pi / 4, 0.0])
