# Reaction wheel pendulum: theta from the upward vertical, psi the wheel's angle from the body.
# (I_p) * theta_ddot = m*g*l*sin(theta) - T
# I_w * (psi_ddot + theta_ddot) = T  => psi_ddot = T/I_w - theta_ddot
