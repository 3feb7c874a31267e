import casadi as ca

mc = 1.0  # 小车质量 (kg)
mp = 0.1  # 摆杆质量 (kg)
l = 0.2
g = 9.81

def cartpole_dynamics(x, u):
    p, theta, v, omega = x[0], x[1], x[2], x[3]
    sin_theta = ca.sin(theta)
    cos_theta = ca.cos(theta)

    denom = mc + mp * sin_theta**2
    dv_dt = (u + mp*sin_theta*(l*omega**2 + g*cos_theta)) / denom
    domega_dt = -(g * sin_theta * (mc + mp) + (u * cos_theta + mp * l * omega**2 * sin_theta * cos_theta)) / (l * denom)
    return ca.vertcat(v, omega, dv_dt, domega_dt)
