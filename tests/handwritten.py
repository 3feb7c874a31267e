"""Derivations as people write them, right and wrong, by hand: none comes from the catalogue that is tested with them.

Right ones are copied, symbol for symbol, from the two documents and from common textbooks; each wrong one was made from
a right one by the slip that stands beside it.
"""

SHIKI_1_9 = [
    r"(m_1 + m_2)l_1\ddot{\theta}_1 + m_2l_2\ddot{\theta}_2 \cos(\theta_1 - \theta_2) "
    r"= -m_1g \sin \theta_1 - m_2g \sin \theta_1 - m_2l_2\dot{\theta}_2^2 \sin(\theta_1 - \theta_2)",
    r"m_2l_2\ddot{\theta}_2 + m_2l_1\ddot{\theta}_1 \cos(\theta_1 - \theta_2) "
    r"= -m_2g \sin \theta_2 + m_2l_1\dot{\theta}_1^2 \sin(\theta_1 - \theta_2)",
]
SHIKI_1_8 = [
    r"&(m_1 + m_2)l_1^2\ddot{\theta}_1 + m_2l_1l_2\ddot{\theta}_2 \cos(\theta_1 - \theta_2) \\ &\quad "
    r"= -m_1gl_1 \sin \theta_1 - m_2gl_1 \sin \theta_1 - m_2l_1l_2\dot{\theta}_2^2 \sin(\theta_1 - \theta_2) \\",
    r"&m_2l_2^2\ddot{\theta}_2 + m_2l_1l_2\ddot{\theta}_1 \cos(\theta_1 - \theta_2) \\ &\quad "
    r"= -m_2gl_2 \sin \theta_2 + m_2l_1l_2\dot{\theta}_1^2 \sin(\theta_1 - \theta_2) \tag{1.8}",
]
SHIKI_2_10 = [
    r"(m_1 + m_2 + m_3)l_1\ddot{\theta}_1 + m_2l_2\ddot{\theta}_2 \cos(\theta_1 - \theta_2) "
    r"+ m_3l_3\ddot{\theta}_3 \cos(\theta_1 - \theta_3) = -m_1g \sin \theta_1 - m_2g \sin \theta_1 "
    r"- m_2l_2\dot{\theta}_2^2 \sin(\theta_1 - \theta_2) - m_3g \sin \theta_1 "
    r"- m_3l_3\dot{\theta}_3^2 \sin(\theta_1 - \theta_3)",
    r"m_2l_2\ddot{\theta}_2 + m_2l_1\ddot{\theta}_1 \cos(\theta_1 - \theta_2) "
    r"= -m_2g \sin \theta_2 + m_2l_1\dot{\theta}_1^2 \sin(\theta_1 - \theta_2)",
    r"m_3l_3\ddot{\theta}_3 + m_3l_1\ddot{\theta}_1 \cos(\theta_1 - \theta_3) "
    r"= -m_3g \sin \theta_3 + m_3l_1\dot{\theta}_1^2 \sin(\theta_1 - \theta_3)",
]
TAKENO_19 = [
    r"\frac{4\ddot{\theta}_1}{3} + \frac{1}{2} \{ \ddot{\theta}_2 \cos(\theta_1 - \theta_2) "
    r"+ (\dot{\theta}_2)^2 \sin(\theta_1 - \theta_2) \} + \frac{3g}{2l} \sin \theta_1 = 0",
    r"\frac{1}{2} \{ \ddot{\theta}_1 \cos(\theta_1 - \theta_2) - (\dot{\theta}_1)^2 \sin(\theta_1 - \theta_2) \} "
    r"+ \frac{\ddot{\theta}_2}{3} + \frac{g}{2l} \sin \theta_2 = 0",
]
# Takeno (18) for n = 3, the sums written out by hand: L1 = l1/2 + l2 + l3, L2 = l2/2 + l3, L3 = l3/2
TAKENO_18 = [
    "(l1/3 + l2 + l3)*l1*a1 + (l2/2 + l3)*l2*(a2*cos(t1-t2) + w2^2*sin(t1-t2))"
    " + l3/2*l3*(a3*cos(t1-t3) + w3^2*sin(t1-t3)) + (l1/2 + l2 + l3)*g*sin(t1) = 0",
    "(l2/2 + l3)*l1*(a1*cos(t2-t1) + w1^2*sin(t2-t1)) + (l2/3 + l3)*l2*a2"
    " + l3/2*l3*(a3*cos(t2-t3) + w3^2*sin(t2-t3)) + (l2/2 + l3)*g*sin(t2) = 0",
    "l3/2*l1*(a1*cos(t3-t1) + w1^2*sin(t3-t1)) + l3/2*l2*(a2*cos(t3-t2) + w2^2*sin(t3-t2))"
    " + l3/3*l3*a3 + l3/2*g*sin(t3) = 0",
]
# The double pendulum solved for the accelerations, as it stands on many web pages
SOLVED = [
    "a1 = (-g*(2*m1+m2)*sin(t1) - m2*g*sin(t1-2*t2) - 2*sin(t1-t2)*m2*(w2^2*l2 + w1^2*l1*cos(t1-t2)))"
    "/(l1*(2*m1 + m2 - m2*cos(2*t1-2*t2)))",
    "a2 = (2*sin(t1-t2)*(w1^2*l1*(m1+m2) + g*(m1+m2)*cos(t1) + w2^2*l2*m2*cos(t1-t2)))"
    "/(l2*(2*m1 + m2 - m2*cos(2*t1-2*t2)))",
]
# The acrobot's textbook form: angles measured from the link above (point masses)
RELATIVE = [
    "((m1+m2)*l1^2 + m2*l2^2 + 2*m2*l1*l2*cos(t2))*a1 + (m2*l2^2 + m2*l1*l2*cos(t2))*a2"
    " - m2*l1*l2*sin(t2)*(2*w1*w2 + w2^2) + (m1+m2)*g*l1*sin(t1) + m2*g*l2*sin(t1+t2) = 0",
    "(m2*l2^2 + m2*l1*l2*cos(t2))*a1 + m2*l2^2*a2 + m2*l1*l2*sin(t2)*w1^2 + m2*g*l2*sin(t1+t2) = 0",
]
SHIKI_1_4 = (
    r"\frac{1}{2}m_1l_1^2\dot{\theta}_1^2 + m_1gl_1 \cos \theta_1 + \frac{1}{2}m_2(l_1^2\dot{\theta}_1^2 "
    r"+ l_2^2\dot{\theta}_2^2 + 2l_1l_2\dot{\theta}_1\dot{\theta}_2 \cos(\theta_1 - \theta_2)) "
    r"+ m_2g(l_1 \cos \theta_1 + l_2 \cos \theta_2)"
)
SHIKI_2_5 = (
    SHIKI_1_4
    + r" + \frac{1}{2}m_3(l_1^2\dot{\theta}_1^2 + l_3^2\dot{\theta}_3^2 + 2l_1l_3\dot{\theta}_1\dot{\theta}_3 "
    r"\cos(\theta_1 - \theta_3)) + m_3g(l_1 \cos \theta_1 + l_3 \cos \theta_3)"
)


def toml(system, rows, **fields):
    """A file with these rows."""
    lines = [f"system = '{system}'", f"links = {fields.pop('links', len(rows))}"]
    lines += [f"{name} = '{value}'" for name, value in fields.items()]
    lines += ["[equations]", *(f"{i} = '''{row}'''" for i, row in enumerate(rows, 1))]
    return "\n".join(lines)


def lagrangian(system, links, formula):
    """A file with a Lagrangian."""
    return f"system = '{system}'\nlinks = {links}\nlagrangian = '''{formula}'''"


ROW_1 = "(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) + m2*l2*w2^2*sin(t1-t2) + (m1+m2)*g*sin(t1) = 0"
ROW_2 = "m2*l2*a2 + m2*l1*a1*cos(t1-t2) - m2*l1*w1^2*sin(t1-t2) + m2*g*sin(t2) = 0"

# (what was done, system, rows, names one of which must be told first, terms that must be found)
WRONG = [
    ("sin for cos in A21", "n-leg", [ROW_1, ROW_2.replace("a1*cos", "a1*sin")], {"sin-for-cos"}, {"A[2,1]"}),
    ("sign of the centrifugal term", "n-leg", [ROW_1, ROW_2.replace("- m2*l1*w1", "+ m2*l1*w1")], {"sign"}, {"B[2,1]"}),
    ("gravity of mass 2 left out of row 1", "n-leg", [ROW_1.replace("(m1+m2)*g", "m1*g"), ROW_2],
     {"height-incomplete", "sum-incomplete"}, {"B[1,1]"}),
    ("gravity on mass 1 only", "n-leg", [ROW_1.replace("(m1+m2)*g", "m1*g"), ROW_2.replace(" + m2*g*sin(t2)", "")],
     {"gravity-on-one-mass-only", "potential-energy-missing"}, {"B[1,1]", "B[2,2]"}),
    ("cross term of the squared speed forgotten", "n-leg",
     ["(m1+m2)*l1*a1 + (m1+m2)*g*sin(t1) = 0", "m2*l2*a2 + m2*g*sin(t2) = 0"],
     {"cross-term-missing", "binomial-without-middle"}, {"A[1,2]", "A[2,1]", "B[1,2]", "B[2,1]"}),
    ("cos(θ1-θ2) differentiated as if θ2 were constant", "n-leg",
     [ROW_1.replace(" + m2*l2*w2^2*sin(t1-t2)", ""), ROW_2],
     {"other-angles-held"}, {"B[1,2]"}),
    ("Coriolis forgotten in both rows", "n-leg",
     [ROW_1.replace("w2^2", "w1*w2"), ROW_2.replace("w1^2", "w1*w2")], {"velocity-terms-forgotten"},
     {"B[1,2]", "B[2,1]"}),
    ("half of T2 forgotten", "n-leg",
     ["(m1+2*m2)*l1*a1 + 2*m2*l2*a2*cos(t1-t2) + 2*m2*l2*w2^2*sin(t1-t2) + (m1+m2)*g*sin(t1) = 0",
      "2*m2*l2*a2 + 2*m2*l1*a1*cos(t1-t2) - 2*m2*l1*w1^2*sin(t1-t2) + m2*g*sin(t2) = 0"], {"half-missing"}, {"A[1,1]"}),
    ("l for l² in the undivided row", "n-leg",
     [ROW_1, "m2*l2*a2 + m2*l1*l2*a1*cos(t1-t2) - m2*l1*l2*w1^2*sin(t1-t2) + m2*g*l2*sin(t2) = 0"],
     {"length-not-squared", "length-missing"}, {"A[2,2]"}),
    ("row 1 divided by l1 on the left only", "n-leg",
     ["(m1+m2)*l1*a1 + m2*l2*a2*cos(t1-t2) = -(m1+m2)*g*l1*sin(t1) - m2*l1*l2*w2^2*sin(t1-t2)", ROW_2],
     {"divided-on-the-left-only"}, {"B[1,1]", "B[1,2]"}),
    ("index: θ1 for θ2 in the gravity of row 2", "n-leg", [ROW_1, ROW_2.replace("sin(t2)", "sin(t1)")],
     {"wrong-angle", "wrong-angle-in-height"}, {"B[2,2]"}),
    ("rods without their own inertia", "rod-chain",
     [TAKENO_19[0].replace(r"\frac{4\ddot{\theta}_1}{3}", r"\frac{5}{4}\ddot{\theta}_1"),
      TAKENO_19[1].replace(r"\frac{\ddot{\theta}_2}{3}", r"\frac{\ddot{\theta}_2}{4}")],
     {"inertia-missing"}, {"A[1,1]", "A[2,2]"}),
    ("inertia about the end with the speed of the centre", "rod-chain",
     [TAKENO_18[0].replace("(l1/3 +", "(l1/3 + l1/4 +"), TAKENO_18[1].replace("(l2/3 +", "(l2/3 + l2/4 +"),
      TAKENO_18[2].replace("l3/3*", "(l3/3 + l3/4)*")], {"inertia-about-end"}, {"A[1,1]", "A[2,2]", "A[3,3]"}),
    ("l2 for l3 in the position of mass 3, as (2.1) prints", "n-leg",
     [SHIKI_2_10[0].replace(r"m_3l_3\ddot", r"m_3l_2\ddot").replace(r"m_3l_3\dot", r"m_3l_2\dot"), SHIKI_2_10[1],
      SHIKI_2_10[2].replace(r"m_3l_3\ddot", r"m_3l_2\ddot")], {"wrong-length-in-position"},
     {"A[1,3]", "B[1,3]", "A[3,3]"}),
    ("a leg hung in the wrong row: m2 for m3", "n-leg",
     [SHIKI_2_10[0].replace(r"m_3l_3\ddot", r"m_2l_3\ddot"), *SHIKI_2_10[1:]], {"wrong-mass"}, {"A[1,3]"}),
    ("L with the smaller index", "rod-chain",
     [TAKENO_18[0].replace("(l2/2 + l3)*l2*(a2", "(l1/2 + l2 + l3)*l2*(a2")
      .replace("l3/2*l3*(a3", "(l1/2 + l2 + l3)*l3*(a3"),
      TAKENO_18[1].replace("(l2/2 + l3)*l1*(a1", "(l1/2 + l2 + l3)*l1*(a1")
      .replace("l3/2*l3*(a3", "(l2/2 + l3)*l3*(a3"),
      TAKENO_18[2].replace("l3/2*l1*", "(l1/2 + l2 + l3)*l1*").replace("l3/2*l2*", "(l2/2 + l3)*l2*")],
     {"smaller-for-larger-index"}, {"A[1,2]", "A[2,1]", "A[3,1]", "B[1,3]"}),
]  # fmt: skip
