"""A pendulum whose pivot goes up and down.

Physics:
    θ̈ + (g/L)sin(θ) = (a/L)Ω²cos(Ωt)sin(θ)

y of the pivot is a cos(Ωt), θ is from the downward vertical.
"""
