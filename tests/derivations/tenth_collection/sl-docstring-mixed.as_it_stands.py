"""The spring loaded inverted pendulum in stance: r is the leg's length, θ its angle with the vertical, the foot at rest.

r̈ = rθ_dot²-gcosθ+k(l₀-r)/m
θ_ddot = g/r*sinθ-2ṙθ_dot/r
"""
