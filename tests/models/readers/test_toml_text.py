"""TOML from outside is bounded before it is parsed, and means what tomllib says."""

import time
import tomllib

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from furiko.models import InvalidInput
from furiko.models.readers.toml_text import DEEPEST, MOST_DOTS, parse_toml

SOUND = """
title = "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t.u.v.w.x.y.z [[[[ {{{{ # = "
multi = \"\"\"
[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[ "quoted" ""two"" \\\" a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a
\"\"\"\"
literal = '''
]]]]]] 'x' ''y'' '''
numbers = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 1.0, 2.0] # a.a.a
"quoted.key"."another"  .  third = { a.b.c = 1, d = [[1], [2]] }
[[table.of.tables]]
x = 1979-05-27T07:32:00.5Z
"""


def test_what_is_sound_is_parsed_as_before():
    assert parse_toml(SOUND) == tomllib.loads(SOUND)
    assert parse_toml("a" + ".a" * MOST_DOTS + " = 1")
    assert parse_toml("a = " + "[" * DEEPEST + "]" * DEEPEST)
    numbers = ", ".join(["1.25"] * 20_000)
    assert len(parse_toml(f"lengths = [{numbers}]")["lengths"]) == 20_000


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a" + ".a" * 20_000 + " = 1", "more than 16 dots"),
        ("[" + '"a" . ' * 20_000 + "a]", "more than 16 dots"),
        ("x = { " + "a." * 20_000 + "a = 1 }", "more than 16 dots"),
        ("\n\na = " + "[" * 50, r"nested too deeply, more than 32 brackets \(at line 3, column 37\)"),
        ("a = " + "{ a = " * 50, "nested too deeply"),
        ("".join(f"k{i}" + ".a" * 15 + " = 1\n" for i in range(10_000)), "more than 100000 keys"),
        ("a = 0x" + "f" * 2000, "more than 1000 characters"),
        ("a = " + "1" * 5000, "more than 1000 characters"),
        ('a = """' + '""' * 100_000, "not TOML"),
        ("a = '''" + "''" * 100_000, "not TOML"),
        ('a = "' + "\\\\" * 100_000, "not TOML"),
    ],
)
def test_what_costs_more_than_its_length_is_refused_at_once(text, says):
    begun = time.process_time()
    with pytest.raises(InvalidInput, match=says):
        parse_toml(text)
    assert time.process_time() - begun < 1


@example('""""')
@example("a = ''''''\n[b]")
@given(st.text(alphabet="a.'\"[]{}=#\n\\, 1", max_size=60))
def test_it_is_tomllib_for_what_is_small(text):
    try:
        expected = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        with pytest.raises(InvalidInput):
            parse_toml(text)
    else:
        assert parse_toml(text) == expected
