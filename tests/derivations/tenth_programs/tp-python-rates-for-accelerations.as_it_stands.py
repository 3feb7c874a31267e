import numpy as np

def triple_pendulum_ode_dimensionless(tau, y):
    theta1, omega1, theta2, omega2, theta3, omega3 = y
    eq1 = omega1
    eq1_dot = -(1/3) * np.sin(theta1) \
              - (2/3) * omega2 * np.cos(theta1 - theta2) \
              - (2/3) * omega2**2 * np.sin(theta1 - theta2) \
              - (1/3) * omega3 * np.cos(theta1 - theta3) \
              - (1/3) * omega3**2 * np.sin(theta1 - theta3)

    eq2 = omega2
    eq2_dot = -np.sin(theta2) \
              - omega1 * np.cos(theta1 - theta2) \
              + omega1**2 * np.sin(theta1 - theta2) \
              - (1/2) * omega3 * np.cos(theta2 - theta3) \
              - (1/2) * omega3**2 * np.sin(theta2 - theta3)

    eq3 = omega3
    eq3_dot = -np.sin(theta3) \
              - omega1 * np.cos(theta1 - theta3) \
              + omega1**2 * np.sin(theta1 - theta3) \
              - omega2 * np.cos(theta2 - theta3) \
              + omega2**2 * np.sin(theta2 - theta3)

    return [eq1, eq1_dot, eq2, eq2_dot, eq3, eq3_dot]
