"""How far rounding may carry an algorithm's result: bounds derived from its arithmetic."""
