"""Energies of a chain of two."""


class Two:
    """The Lagrangian of the double pendulum, given by

      L = 1/2*(m_0+m_1)*L_0^2*dot(theta_0)^2
          + 1/2*m_1*L_1^2*dot(theta_1)^2
          + m_1*L_0*L_1*dot(theta_0)*dot(theta_1)*cos(theta_0-theta_1)
          - (m_0+m_1)*g*L_0*(1-cos(theta_0))
          - m_1*g*L_1*(1-cos(theta_1))

    Here theta_0 and theta_1 are the angles relative to the vertical.
    """
