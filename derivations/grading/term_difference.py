"""Describes the difference of one coefficient from the right one, where no mistake of the catalogue explains it."""

from __future__ import annotations

from math import pi

from flint import fmpq

from ..algebra.multiples import divided
from ..algebra.notation import motion_text, pretty, text
from ..algebra.symbols import Symbols
from ..algebra.trig import COS, Formula, Space

Description = tuple[str, str, str]  # code, English, Japanese


def describe(m: Symbols, i: int, q: int, found: Formula, expected: Formula, name: str) -> Description:
    """Code and sentences for the term ``name``, which multiplies the motion ``q`` in row i."""
    what = "gravity" if not q else pretty(motion_text(m.space, q))
    code, english, japanese = difference(found, expected, m.space)
    where = f"Row {i + 1}, the {what} term ({name})"
    wo = f"第{i + 1}式の {'重力' if not q else what} の項 ({name})"
    return code, f"{where}: {english}.", f"{wo}：{japanese}。"


def difference(found: Formula, expected: Formula, space: Space) -> Description:
    """Code and sentences for a coefficient that differs from the right one."""
    if not found:
        return "term-missing", "it is missing", "抜けています"
    if not expected:
        return "term-extra", "no such term is expected", "このような項はありません"
    factor = divided(found, expected)
    if factor is not None:
        return _factor(space, factor)
    if found in (_swapped(expected), -_swapped(expected)):
        return "sine-and-cosine-swapped", "sin and cos are swapped", "sin と cos が逆です"
    return _part(space, found, expected)


def _factor(space: Space, factor: Formula) -> Description:
    if factor.is_number():
        size = factor.number()
        if size == -1:
            return "sign", "the sign is wrong", "符号が逆です"
        if abs(size.p) == 1 and size > 0 and not _is_degrees(size):
            lost = "factor-half" if size.q == 2 else "factor-wrong"
            return lost, f"it lacks its factor {size.q}", f"{size.q} が足りません"
        if _is_degrees(size):
            return (
                "degrees",
                "degrees stand for radians: a factor of 180/π or π/180",
                "度とラジアンが混ざっています（180/π）",
            )
        known = {"2": "factor-two"}.get(str(size), "factor-wrong")
        return known, f"it has an extra factor {size}", f"余分な {size} が掛かっています"
    if factor.is_monomial() and all(power <= 0 for power in next(space.monomials(factor))[0]):
        lost = pretty(text(space, factor.inverse_monomial()))
        return "factor-missing", f"it lacks the factor {lost}", f"{lost} が足りません"
    shown = pretty(text(space, factor))
    return "factor-wrong", f"it has an extra factor {shown}", f"余分な {shown} が掛かっています"


def _is_degrees(size: fmpq) -> bool:
    """Whether a factor is 180/π or its inverse, as far as people write them out."""
    value = abs(int(size.p) / int(size.q))
    return any(abs(value / degrees - 1) < 2e-3 for degrees in (180 / pi, pi / 180))


def _part(space: Space, found: Formula, expected: Formula) -> Description:
    """One part of a sum: missing, with the wrong sign, or one too many."""
    difference = found - expected
    for key, c in difference.terms.items():
        if len(difference) > 1:
            break
        part = pretty(text(space, Formula({key: abs(c)})))
        right = expected.terms.get(key)
        if right is None:
            return "part-extra", f"{part} is not expected there", f"{part} は不要です"
        if c == -right:
            return "part-missing", f"the part {part} is missing", f"{part} が抜けています"
        shown = pretty(text(space, Formula({key: right})))
        if c == -2 * right:
            return "part-sign", f"the part {shown} has the wrong sign", f"{shown} の符号が逆です"
        return "part-factor", f"the part {shown} has the wrong factor", f"{shown} の係数が違います"
    return "term-wrong", "it is wrong", "正しくありません"


def _swapped(f: Formula) -> Formula:
    """cos for sin and sin for cos, of differences written with the first angle positive."""
    return Formula({(e, h, 1 - phase if h else COS): c for (e, h, phase), c in f.terms.items()})
