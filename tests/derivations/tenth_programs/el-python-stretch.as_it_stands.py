from pylab import array, zeros
from numpy import linspace, cos, sin
from scipy.integrate import odeint

L_o = 1.0
k = 3.5
m = 0.2
gravity = 9.8


def spring_pendulum(y, time):
    g0 = y[1]
    g1 = (L_o + y[0]) * y[3] * y[3] - k / m * y[0] + gravity * cos(y[2])
    g2 = y[3]
    g3 = -(gravity * sin(y[2]) + 2.0 * y[1] * y[3]) / (L_o + y[0])
    return array([g0, g1, g2, g3])

answer = odeint(spring_pendulum, [1.0, 0.0, 0.3, 0.0], linspace(0, 25, 1000))
