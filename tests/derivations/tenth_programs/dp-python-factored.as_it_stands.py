import numpy as np

m1 = 1.0       # mass of pendulum 1 (kg)
m2 = 1.0
L1 = 1.0
L2 = 1.0
g = 9.81


def double_pendulum(t, y):
    """
    y = [theta1, omega1, theta2, omega2]
    """

    theta1, omega1, theta2, omega2 = y

    delta = theta2 - theta1

    denominator1 = (m1 + m2) * L1 - m2 * L1 * np.cos(delta)**2

    denominator2 = (L2 / L1) * denominator1

    alpha1 = (
        m2 * L1 * omega1**2 * np.sin(delta) * np.cos(delta)
        + m2 * g * np.sin(theta2) * np.cos(delta)
        + m2 * L2 * omega2**2 * np.sin(delta)
        - (m1 + m2) * g * np.sin(theta1)
    ) / denominator1

    alpha2 = (
        -m2 * L2 * omega2**2 * np.sin(delta) * np.cos(delta)
        + (m1 + m2) * (
            g * np.sin(theta1) * np.cos(delta)
            - L1 * omega1**2 * np.sin(delta)
            - g * np.sin(theta2)
        )
    ) / denominator2

    return [omega1, alpha1, omega2, alpha2]
