"""Mechanisms are drawn to scale, inside their box."""

import pytest

from furiko.reports.pages.mechanism_drawing import MOST_LINKS, draw_mechanism


@pytest.mark.parametrize("n", [1, 2, 3, 33, 100, 5000])
@pytest.mark.parametrize("system", ["n-leg", "rod-chain", "another"])
def test_a_mechanism_is_drawn_to_scale_inside_its_box(make, system, n):
    lengths = [1.0 + 0.5 * (i % 3) for i in range(n)]
    drawing = draw_mechanism(make.scene("s", system, n, lengths=lengths))
    assert len(drawing.lines) == min(n, MOST_LINKS)
    assert drawing.left_out == max(n - MOST_LINKS, 0)
    drawn = [((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5 for x1, y1, x2, y2 in drawing.lines]
    scale = drawn[0] / lengths[0]
    assert drawn == pytest.approx([scale * length for length in lengths[:MOST_LINKS]])
    for x1, y1, x2, y2 in drawing.lines:
        assert all(0 <= x <= drawing.width + 1e-9 for x in (x1, x2))
        assert all(0 <= y <= drawing.height + 1e-9 for y in (y1, y2))
    assert drawing.lines[0][:2] == drawing.support
    carriers = (
        [0] * n if system == "n-leg" else range(n)
    )  # a leg hangs from the first rod, a rod from the one before it
    for line, carrier in zip(drawing.lines[1:], carriers, strict=False):
        assert line[:2] == drawing.lines[carrier][2:]
