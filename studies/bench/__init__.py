"""Time against error: of engines, of integrators and of furiko itself."""
