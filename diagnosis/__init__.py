"""Why an engine or a model file differs from the theory: hypotheses, each tested by measurement."""
