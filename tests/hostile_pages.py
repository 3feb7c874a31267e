"""Texts that a page must show as text, and a run in which one stands everywhere."""

HOSTILE = [
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "' onmouseover='alert(1)",
    "</style></title></svg></script><script>1</script>",
    "]]>--><!--<script>",
    "{{ 7*7 }}{% raw %}",
    "javascript:alert(1)",
    "\x00\x1b[2J\u202e\ud800\uffff\u2028",
    "<" * 5000,
]


def everywhere(make, text, outcome):
    """A run in which this text stands in every place that a stream has for text."""
    scene = make.scene(text, text, description=text, equations=[text, f"{text}: {text}"], tags=[text], source=text)
    engine = make.engine(text, formulation=text, package=text, version=text)
    named = {"scene": text, "engine": text}
    results = [
        make.result(
            outcome, check=text, unit=text, cause=text, reason=text, details={text: text, "l": [text]}, **named
        ),
        make.result("error", check=f"{text}!", reason=f"a\n{text}", details={"traceback": text}, **named),
    ]
    facts = {"command": text, "profile": text, "seed": text, "started": text, "furiko": text}
    tables = {"machine": {text: text}, "versions": {text: text}}
    return make.report(*results, scenes=[scene], engines=[engine], **facts, **tables)
