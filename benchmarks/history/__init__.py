"""furiko's own speed from commit to commit, as multiples of what numpy takes in the same process.

A figure here is a time divided by another taken in turn with it, so that it means the same on another machine and on a
busy one; what grows by a tenth or more from one commit to the next is a slower commit. Runs on airspeed velocity, from
the folder above, where its configuration is:

    pip install -e '..[bench]'
    asv continuous HEAD~1 HEAD      # builds both commits, runs both, and fails where one figure is a tenth worse
    asv run v0.1.0..main            # every commit in turn; `asv publish` and `asv preview` draw the history
    asv run --python=same --quick   # this checkout as it is installed here, once, in seconds

No part of `make test`: a test says right or wrong, these say how much. What furiko takes beside the engines, and how
exact it is then, is `furiko bench`.
"""
