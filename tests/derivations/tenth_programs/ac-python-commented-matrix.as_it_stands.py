import numpy as np

g = 9.81
m1 = 1.0
m2 = 1.0
l1 = 1.0
l2 = 1.0
lc1 = l1 / 2
lc2 = l2 / 2
I1 = m1 * l1**2 / 3  # moment of inertia of first link
I2 = m2 * l2**2 / 3
u_const = 0


def acrobot_dynamics(t, state):
    theta1, theta2, omega1, omega2 = state

    c1 = np.cos(theta1)
    s1 = np.sin(theta1)
    c2 = np.cos(theta2)
    s2 = np.sin(theta2)
    c12 = np.cos(theta1 + theta2)
    s12 = np.sin(theta1 + theta2)

    # Inertia matrix
    # M11 = I1 + I2 + m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * c2)
    # M12 = I2 + m2 * (lc2**2 + l1 * lc2 * c2)

    M11 = I1 + I2 + m2 * lc1**2 + m2 * (l1**2 + 2 * l1 * lc2 * c2)
    M12 = I2 + m2 * (l1 * lc2 * c2)
    M21 = M12
    M22 = I2
    M = np.array([[M11, M12], [M21, M22]])

    C1 = -m2 * l1 * lc2 * s2 * (2 * omega1 * omega2 + omega2**2)
    C2 = m2 * l1 * lc2 * s2 * omega1**2
    G1 = (m1 * lc1 + m2 * l1) * g * s1 + m2 * lc2 * g * s12
    G2 = m2 * lc2 * g * s12

    tau = np.array([0, u_const])

    rhs = np.array([-C1 - G1, -C2 - G2]) + tau
    alpha = np.linalg.solve(M, rhs)

    return [omega1, omega2, alpha[0], alpha[1]]
