import jax.numpy as jnp
from jax import jit


@jit
def cartpole_dynamics(x, u):
    """x = [p, theta, p_dot, theta_dot], theta = 0: pole hanging down."""
    params = {'mc': 1.0, 'mp': 0.2, 'l': 0.5}
    mc, mp, l = params['mc'], params['mp'], params['l']
    g = 9.81

    q = x[0:2].reshape(2, 1)
    q_d = x[2:4].reshape(2, 1)

    s = jnp.sin(q[1])[0]
    c = jnp.cos(q[1])[0]

    H = jnp.array([[mc+mp, mp*l*c], [mp*l*c, mp*l**2]])
    C = jnp.array([[0, -mp*q_d[1][0]*l*s], [0, 0]])
    G = jnp.array([[0], [mp*g*l*s]])
    B = jnp.array([[1], [0]])

    q_dd, _, _, _ = jnp.linalg.lstsq(-H, C@q_d + G - B*u[0], rcond=None)

    return jnp.vstack((q_d, q_dd)).reshape(4,)
