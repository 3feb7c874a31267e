"""Both documents' equations, symbol by symbol, and their final form put together for a mechanism.

Imports models and the arithmetic.
"""
