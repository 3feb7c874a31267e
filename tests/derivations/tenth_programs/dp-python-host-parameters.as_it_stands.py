import numpy as np
from scipy.integrate import solve_ivp

g = hou.pwd().parm("g").eval()
L1 = hou.pwd().parm("l1").eval()
L2 = hou.pwd().parm("l2").eval()
m1 = hou.pwd().parm("m1").eval()
m2 = hou.pwd().parm("m2").eval()

def double_pendulum(t, y):
    theta1, z1, theta2, z2 = y
    c, s = np.cos(theta1-theta2), np.sin(theta1-theta2)

    theta1_dot = z1
    z1_dot = (m2*g*np.sin(theta2)*c - m2*s*(L1*z1**2*c + L2*z2**2) -
              (m1+m2)*g*np.sin(theta1)) / L1 / (m1 + m2*s**2)

    theta2_dot = z2
    z2_dot = ((m1+m2)*(L1*z1**2*s - g*np.sin(theta2) + g*np.sin(theta1)*c) +
              m2*L2*z2**2*s*c) / L2 / (m1 + m2*s**2)

    return [theta1_dot, z1_dot, theta2_dot, z2_dot]
