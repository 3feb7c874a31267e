import scipy.linalg
import numpy as np

def acrobot_dynamics(states, control, m1 = 1, m2 = 0.5, L1 = 1, L2 = 2, g = 9.81):
    theta1, theta2, dtheta1, dtheta2 = states
    u = control
    alpha1 = (m1 + m2) * L1**2
    alpha2 = m2 * L2**2
    alpha3 = m2 * L1 * L2
    beta1 = (m1 + m2) * g * L1
    beta2 = m2 * g * L2

    m11 = alpha1 + alpha2 + 2 * alpha3 * np.cos(theta2)
    m12 = alpha3 * np.cos(theta2) + alpha2
    m21 = m12
    m22 = alpha2

    h1 = - 2 * alpha3 * dtheta1 * dtheta2 * np.sin(theta2) - alpha3 * dtheta2**2 * np.sin(theta2)
    h2 = alpha3 * dtheta1**2 * np.sin(theta2)

    g1 = -beta1 * np.sin(theta1) - beta2 * np.sin(theta1 + theta2)
    g2 = -beta2 * np.sin(theta1 + theta2)

    M = np.array([[m11, m12], [m21, m22]])
    H = np.array([[h1], [h2]])
    G = np.array([[g1], [g2]])
    B = np.array([[0], [1]])

    ddthetas = - np.dot(scipy.linalg.pinv2(M), ( (H + G) - B * u))
    return np.vstack((np.array([[dtheta1], [dtheta2]]), ddthetas))
