"""A mass m on a spring (natural length L0, constant k) that also swings under gravity g.

State: [r, r_dot, theta, theta_dot], theta = angle from vertical.

Equations of motion (Lagrangian):
    r_ddot = r * theta_dot^2 + g * cos(theta) - (k/m) * (r - L0)
    theta_ddot = -(2 * r_dot * theta_dot + g * sin(theta)) / r
"""
