"""A folder of runs as one page, engine version by engine version, with badges. May import the rest of reports."""
