import casadi as ca

# [x, theta, x_dot, theta_dot], 0 = upright, pi = down
def cartpole_dynamics(x_state, u, M, m, L, g):
    x, th, x_d, th_d = x_state[0], x_state[1], x_state[2], x_state[3]
    force = u

    sina = ca.sin(th)
    cosa = ca.cos(th)
    denom = M + m * sina**2

    x_dd = (force - m * L * th_d**2 * sina + m * g * sina * cosa) / denom

    th_dd = (force * cosa - m * L * th_d**2 * sina * cosa + (M + m) * g * sina) / (L * denom)

    return ca.vertcat(x_d, th_d, x_dd, th_dd)
