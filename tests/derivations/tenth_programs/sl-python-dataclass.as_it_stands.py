from dataclasses import dataclass
import numpy as np

@dataclass
class SLIPParams:
    m: float = 1.0
    g: float = 9.81
    k: float = 500.0
    r0: float = 0.5   # rest length

def stance_dynamics(t, X, P: SLIPParams):
    # X = [r, th, rdot, thdot]
    r, th, rdot, thdot = X

    rdd  = r*thdot**2 - P.g*np.sin(th) - (P.k/P.m)*(r-P.r0)
    thdd = -(2/r)*rdot*thdot - (P.g/r)*np.cos(th)

    return np.array([rdot, thdot, rdd, thdd])
