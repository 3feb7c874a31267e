"""Imports run one way, between the rooms, inside them and file by file; engines are imported only by their adapters."""

import ast

import pytest
from package_rooms import MODULES, ROOT, circles, folder, imports, parsed, picture, room

# The files beside the folders of dialects, which these build on
DIALECTS = (
    "blocks", "bracketed", "functions", "given_names", "lines", "names", "pasted", "programs", "rates", "short_waves",
    "srepr", "statements", "sums", "table", "times", "vectors",
)  # fmt: skip
# A room, the rooms it may import, and its folders from the lowest to the highest: a file may import from its own
# folder and from those before it. Folders in one tuple do not see each other; "." is the room's own files.
ROOMS = {
    "records": (set(), [(".",)]),
    "models": (
        set(),
        [
            ("errors",),
            ("readers.bounded_file",),
            ("readers.toml_text", "readers.toml_fields", "writers.whole_file"),
            ("trees.scene", "trees.own", "trees.system"),
            (".",),
            (
                "readers.xml_file",
                "readers.attributes",
                "readers.aligned",
                "readers.meshes",
                "readers.rules",
                "readers.placement",
                "readers.folders",
                "readers.named_folders",
                "readers.packages",
                "readers.shapes",
            ),
            ("readers.mjcf",),
            ("readers.urdf",),
            ("readers", "writers"),
            ("trees",),
        ],
    ),
    "reference": (
        {"models"},
        [
            ("arithmetic", "limits"),
            ("documents",),
            ("kernels.sine", "kernels.sizes", "kernels.instructions", "kernels.threads", "kernels.native"),
            ("kernels.ahead", "kernels.trees"),
            ("kernels",),
            ("integration",),
            (".",),
            ("rounding.bounds",),
            ("rounding.spatial",),
            ("truth", "rounding"),
            ("spatial_spread",),
            ("proved",),
            ("chain",),
        ],
    ),
    "engines": (
        {"models", "records"},
        [("workers",), ("info", "protocol", "releases"), ("known",), ("places",), (".",), ("model_files",), ("trees",)],
    ),
    "diagnosis": (
        {"models", "records", "reference", "engines"},
        [("finding", "explanation", "measurement", "question"), ("fits",), (".",), ("model_files",)],
    ),
    "checks": (
        {"models", "records", "reference", "engines", "diagnosis", "derivations"},
        [(".",), ("motions",), ("comparisons",), ("trees",), ("conformance",)],
    ),
    "studies": (
        {"models", "records", "reference", "engines", "diagnosis", "checks"},
        [
            (".",),
            ("stress.axes", "stress.accelerations", "stress.case", "stress.failures", "stress.over_bound"),
            ("stress.trees",),
            ("bench", "maps", "stress", "sweep", "versions"),
        ],
    ),
    "derivations": (
        {"models", "reference"},
        [
            (".",),
            ("algebra",),
            tuple(f"dialects.{name}" for name in DIALECTS),
            ("dialects.letters",),
            ("dialects.markup.around",),
            ("dialects.markup",),
            ("dialects.worksheets",),
            ("dialects.code", "dialects.languages"),
            ("dialects.followed",),
            ("dialects.traced",),
            ("dialects.grammars.languages",),
            ("dialects.grammars",),
            ("dialects.parsers",),
            ("dialects.notes",),
            ("dialects",),
            ("steps",),
            ("reading.motion",),
            ("reading.submission",),
            ("reading.forms",),
            ("reading",),
            ("mistakes",),
            ("grading.differences", "grading.grade_record", "grading.hypotheses", "grading.judge"),
            ("grading.forms",),
            ("grading",),
            ("robot",),
            ("audit", "lesson", "classroom"),
        ],
    ),
    "reports": ({"models", "records"}, [(".",), ("pages", "terminal", "ci"), ("history", "maps")]),
    "furiko": ({"*"}, [(".",), ("ci", "cli")]),
}
# Where a file of a room must import from a folder above it: what the room's front door (its __init__) names, and
# renderings that are loaded when they are asked for.
FRONT_DOORS = {
    "models",
    "reference",
    "engines",
    "reports",
    "furiko",
    "models.readers",
    "diagnosis",
    "checks",
    "furiko.__main__",
}
LAZY = {
    "reports.write": "the renderings are imported when a report is written",
    "engines.registry": "adapters are found by name",
    "models.scene": "the tables of a tree are fitted where there are some",
    "models.trees.system": "arrays are made where they are asked for",
    "checks.jobs": "what trees need is imported where a tree is",
}
ENGINES = {"mujoco", "pinocchio", "exudyn", "pydrake", "dartpy", "pybullet", "jax", "warp", "mujoco_warp"}


def place(module):
    """Number of the layer that a module of a room is in."""
    inside = module.partition(".")[2]
    layers = ROOMS[room(module)][1]
    for number, names in enumerate(layers):
        for name in names:
            if name != "." and (inside == name or inside.startswith(f"{name}.")):
                return number
    return next(number for number, names in enumerate(layers) if "." in names)


@pytest.mark.parametrize("module", sorted(MODULES))
def test_imports_run_one_way(module):
    allowed, _ = ROOMS[room(module)]
    for other in imports(MODULES[module]):
        if room(other) != room(module):
            assert "*" in allowed or room(other) in allowed, f"{module} imports {other}"
        elif folder(other) != folder(module) and module not in FRONT_DOORS and module not in LAZY:
            assert other in FRONT_DOORS or place(other) < place(module), f"{module} imports {other}, which is above it"


def test_no_file_imports_itself_by_way_of_others():
    graph = {module: set(imports(path)) for module, path in MODULES.items()}
    assert circles(graph) == []


@pytest.mark.parametrize("module", sorted(MODULES))
def test_inside_the_package_imports_are_relative_and_engines_are_adapters_alone(module):
    tree = parsed(MODULES[module])
    named = {
        name.split(".")[0]
        for node in ast.walk(tree)
        for name in (
            [alias.name for alias in node.names]
            if isinstance(node, ast.Import)
            else [node.module or ""]
            if isinstance(node, ast.ImportFrom) and not node.level
            else [argument.value for argument in node.args if isinstance(argument, ast.Constant)]
            if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module")
            else []
        )
        if isinstance(name, str)
    }
    assert "furiko" not in named
    if room(module) != "engines":
        assert not named & ENGINES


def test_every_folder_at_the_root_is_known():
    found = {path.name for path in ROOT.iterdir() if path.is_dir() and path.name[0] not in "._"}
    built = {"build", "dist", "furiko.egg-info", "furiko-report", "furiko-stress", "furiko-sweep"}
    assert found - built == {*ROOMS, "tests", "docs", "benchmarks"}
    assert len(found - built) <= 13


def test_the_picture_of_the_rooms_is_that_of_the_code():
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    assert f"<!-- rooms -->\n{picture()}\n<!-- /rooms -->" in text, "run: make architecture"
