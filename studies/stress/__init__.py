"""Up to which length, ratio, speed and step an engine can be trusted."""
