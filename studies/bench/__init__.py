"""Time against error: of engines, of integrators and of furiko itself.

May import models, records, reference, engines and checks.
"""
