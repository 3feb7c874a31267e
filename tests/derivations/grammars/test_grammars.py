# ruff: noqa: E501 -- programs stand on one line
"""Programs by their languages' grammars: what each sign means there, what is refused, and what a grammar gets wrong.

A pendulum's acceleration is -g/l sin(theta), by first principles; each text computes it, a multiple of it, or what is
not certain.
"""

import subprocess
import sys
import time

import pytest

from furiko.derivations.dialects.grammars.parsed import parsed
from furiko.derivations.grading.grade import grade_text
from furiko.models.errors import InvalidInput

FILE = """system = 'mechanism'
from = 'down'
[[bodies]]
coordinate = 'theta'
mass = 'm'
length = 'l'
[equations]
1 = '''
{}
'''
"""
C = "double acc(double theta, double w) {{ {} }}"
SAID = {
    "a loop with break": ("correct", C.format("double s = 0; for (int i = 0; i < 2; i++) { if (i == 1) break; s += 1; } return -s*g/l*sin(theta);")),
    "a loop with continue": ("correct", C.format("double s = 0; for (int i = 0; i < 3; i++) { if (i == 1) continue; s += 0.5; } return -s*g/l*sin(theta);")),
    "4/2 of whole numbers": ("correct", C.format("int n = 4; return -(n/2)*g/l*sin(theta)/2.0;")),
    "3/3 with a double": ("correct", C.format("double n = 3; return -(n/3)*g/l*sin(theta);")),
    "a struct by value": ("correct", "struct P { double l; };\ndouble len(struct P p) { p.l = 2*p.l; return p.l; }\ndouble acc(struct P p, double theta) { double a = len(p); return -g/p.l*sin(theta); }"),
    "a pointer": ("wrong", "void twice(double *x) { *x = 2*(*x); }\ndouble acc(double theta, double w) { double a = -g/l*sin(theta); twice(&a); return a; }"),
    "a value": ("correct", "void twice(double x) { x = 2*x; }\ndouble acc(double theta, double w) { double a = -g/l*sin(theta); twice(a); return a; }"),
    "overloads": ("correct", "double f(double a) { return a; }\ndouble f(double a, double b) { return 2*a; }\ndouble acc(double theta, double w) { return f(-g/l*sin(theta)); }"),
    "two names at once": ("correct", C.format("double a, b; a = b = -g/l*sin(theta); return a;")),
    "forEach and a closure": ("wrong", "function acc(theta, w) { let a = -g/l*Math.sin(theta); [1,2].forEach(x => { a *= x; }); return a; }"),
    "one array, two names": ("wrong", "function acc(theta, w) { const a = [1,2].map(x => x); a[0] = -g/l*Math.sin(theta); const b = a; b[0] *= 2; return a[0]; }"),
    "1/2 of JavaScript": ("correct", "function acc(theta, w) { return -1/2*g/l*Math.sin(theta)*2; }"),
    "let twice in Rust": ("wrong", "fn acc(theta: f64, w: f64) -> f64 { let a = -g/l*theta.sin(); let a = 2.0*a; a }"),
    "-2.powi(2) of Rust": ("correct", "fn acc(theta: f64, w: f64) -> f64 { -2.0_f64.powi(2)*g/l*theta.sin()/4.0 }"),
    "1/2.0 of Go": ("correct", "func acc(theta, w float64) float64 {\n\tx := 1/2.0\n\treturn -g/l*math.Sin(theta)*x*2\n}"),
    "one line of Julia": ("correct", "acc(theta, w) = -g/l*sin(theta)"),
    "2x^2 of Julia is 2*(x^2)": ("correct", "function acc(theta, w)\n x = 2\n return -g/l*sin(theta)*2x^2/8\nend"),
    "2*(a)*b of Julia": ("correct", "function acc(theta, w)\n return -2*(g/l)*sin(theta)/2\nend"),
    "1-(a)*b of Julia": ("correct", "function acc(theta, w)\n x = 1-(2)*3\n return x*g/l*sin(theta)/5\nend"),
    "[a -b] of Julia": ("correct", "function acc(theta, w)\n a = [1 -g/l*sin(theta)]\n theta_acc = a[1, 2]\n return theta_acc\nend"),
}  # fmt: skip
REFUSED = {
    "a return that a condition decides": C.format("if (theta > 1) return 0.0; return -g/l*sin(theta);"),
    "a value that a condition decides": C.format("double k = 1.0; if (w > 1) { k = 2.0; } return -k*g/l*sin(theta);"),
    "a loop that the state ends": C.format("double k = 1.0; while (w > 1) { k *= 2.0; } return -k*g/l*sin(theta);"),
    "3/2 of whole numbers": C.format("int n = 3; return -(n/2)*g/l*sin(theta);"),
    "1/2": C.format("return -g/l*sin(theta)*(1/2)*2;"),
    "(int)": C.format("return -g/l*sin(theta)*(int)(1.5);"),
    "an address that is given away": C.format("double a = -g/l*sin(theta); unknown(&a); return a;"),
    "an array that is given away": C.format("double a[2] = {1, 2}; a[0] = -g/l*sin(theta); memset(a, 0, 8); return a[0];"),
    "static": C.format("static int n = 0; n++; return -n*g/l*sin(theta);"),
    "goto": C.format("double a = -g/l*sin(theta); goto end; a = 2; end: return a;"),
    "a block of its own": C.format("double k = 1.0; { double k = 2.0; } return -k*g/l*sin(theta);"),
    "an entry that is not filled": C.format("double a[2]; a[0] = 1; return -a[1]*g/l*sin(theta);"),
    "a class's array that others fill": "class A { double[] k = new double[2]; double acc(double theta) { return -(1 + k[0])*g/l*Math.sin(theta); } }",
    "defer": "func acc(theta, w float64) float64 {\n\tx := -g/l*math.Sin(theta)\n\tdefer func() { x = 0 }()\n\treturn x\n}",
    "a sign behind the end of a line": "fun acc(theta: Double, w: Double): Double {\n val a = -g/l*sin(theta)\n  - w\n return a\n}",
    "two parameters of one name": "function acc(theta, theta) { return -g/l*Math.sin(theta); }",
    "one mass for another": "class A { double l; A(double l, double m) { this.l = m; } double acc(double theta) { return -g/l*Math.sin(theta); } }",
}  # fmt: skip


@pytest.mark.parametrize(("verdict", "text"), SAID.values(), ids=SAID)
def test_what_a_program_comes_to(verdict, text):
    assert grade_text(FILE.format(text)).verdict == verdict


@pytest.mark.parametrize("text", REFUSED.values(), ids=REFUSED)
def test_what_is_not_certain_is_refused(text):
    with pytest.raises(InvalidInput):
        grade_text(FILE.format(text))


HOSTILE = {
    "brackets": C.format("return " + "(" * 3000 + "theta" + ")" * 3000 + ";"),
    "blocks": C.format("{" * 3000 + "}" * 3000 + "return 1;"),
    "types": C.format("a" + "<a" * 5000 + "; return 1;"),
    "signs": C.format("return " + "-" * 9000 + "theta;"),
    "a long sum": C.format("return " + "theta + " * 2000 + "theta;"),
    "a loop": C.format("double s = 0; for (int i = 0; i < 1000000; i++) s += 1; return -s*g/l*sin(theta);"),
    "loops in loops": C.format("double s = 0;" + "".join(f"for (int i{k} = 0; i{k} < 90; i{k}++) " for k in range(6)) + "s += 1; return -s*g/l*sin(theta);"),
    "itself": "double f(double x) { return f(x); }\ndouble acc(double theta, double w) { return f(theta); }",
}  # fmt: skip


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_hostile_texts_are_refused_soon(text):
    begun = time.process_time()
    with pytest.raises(InvalidInput):
        grade_text(FILE.format(text))
    assert time.process_time() - begun < 2  # s


def test_a_formula_needs_no_grammar():
    code = (
        "import sys; from furiko.derivations.grading.grade import grade_text;"
        "grade_text(\"system = 'n-leg'\\nlinks = 1\\n[equations]\\n1 = 'l1*a1 = -g*sin(t1)'\");"
        "sys.exit(any(name.startswith('tree_sitter') for name in sys.modules))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_text_of_no_such_language_is_none():
    assert parsed("function dx = f(t, x)\n dx = [x(2); -x(1)];\nend") is None
    assert parsed("def f(t, y):\n    return [y[1], -y[0]]") is None
