import numpy as np

m1, m2 = 6.4, 6.4
l1, l2 = 1, 1
g = 9.81


def double_pendulum(t, y):
    theta1, theta2, omega1, omega2 = y

    dtheta1_dt = omega1
    dtheta2_dt = omega2

    #domega1_dt = (-g*(2*m1 + m2)*np.sin(theta1) - m2*g*np.sin(theta1 - 2*theta2)) / (l1*(2*m1 + m2))
    domega1_dt = ( -g/l1*(2*np.sin(theta1)-np.cos(theta1-theta2)*np.sin(theta2)) - np.sin(theta1-theta2)*(omega2**2 + np.cos(theta1-theta2)*omega1**2)  )/(2 - (np.cos(theta1-theta2))**2)
    domega2_dt = ( -g/l1*(np.sin(theta2)-2*np.cos(theta1-theta2)*np.sin(theta1)) + np.sin(theta1-theta2)*(omega1**2 + np.cos(theta1-theta2)*omega2**2)  )/(2 - (np.cos(theta1-theta2))**2)

    return [dtheta1_dt, dtheta2_dt, domega1_dt, domega2_dt]
