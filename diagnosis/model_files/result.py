"""The result of ``furiko diagnose``: verdict, findings and what each engine compiled, as JSON and as text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...models.mechanism import Hinge, Mechanism
from ..finding import CAUSES, Finding

MOST_LEFT_OUT = 3  # named in the headline
HINGE_NUMBERS = ("armature", "damping", "friction", "stiffness", "rest", "limits")


@dataclass(frozen=True)
class Written:
    """A file that ``--fix`` wrote to ``path``; ``why``: why not all engines that were asked read it alike, empty where
    they do. ``status``: its exit status: 0 they do, 1 they do not, 3 where no engine could be compared."""

    path: str
    why: tuple[str, ...]
    status: int

    def text(self) -> str:
        """What the answer says of it: a line, and one for each reason."""
        alike = ("", ", which not all engines read alike", "", ", which is not judged")[self.status]
        return "\n".join([f"  written: {self.path}{alike}", *(f"      {reason}" for reason in self.why)])

    def to_json(self) -> dict[str, Any]:
        """As ``furiko diagnose --json`` prints it."""
        return {"path": self.path, "agrees": self.status == 0, "why": list(self.why)}


@dataclass(frozen=True)
class Diagnosis:
    """``verdict``: ``agrees``, ``differs``, ``unexplained`` or ``incomplete``; ``findings``: the likeliest cause first.

    ``engines``: for each engine what it compiled, or why it did not; ``notes``: what was assumed; ``without``: what
    acts in the file and is left out of the comparison; ``against``: the name of what the file was compared with;
    ``mechanism``: the planar tree that was read, as :func:`mechanism_to_json` gives it, None where it is none;
    ``spatial``: the bodies and joints that were read; ``simulation``: what a simulation of the file would add;
    ``written``: the file that ``--fix`` wrote.
    """

    model: str
    verdict: str
    findings: tuple[Finding, ...]
    engines: Mapping[str, Mapping[str, Any]]
    notes: tuple[str, ...] = ()
    against: str = ""
    mechanism: Mapping[str, Any] | None = None
    spatial: Mapping[str, Any] = field(default_factory=dict)
    without: tuple[str, ...] = ()
    simulation: tuple[Finding, ...] = ()
    written: Written | None = None

    @property
    def exit_status(self) -> int:
        """0 agrees, 1 differs, 3 where an engine that was asked for, or every engine, could not be compared.

        A file that was written counts as well.
        """
        own = {"agrees": 0, "incomplete": 3}.get(self.verdict, 1)
        written = self.written.status if self.written is not None else 0
        return 1 if 1 in (own, written) else max(own, written)

    @property
    def headline(self) -> str:
        """The answer in one sentence."""
        by_status: dict[str, list[str]] = {}
        for name, engine in self.engines.items():
            by_status.setdefault(engine["status"], []).append(name)
        parts = []
        if agree := by_status.get("agrees"):
            parts.append(f"{_listed(agree)} {'does' if len(agree) == 1 else 'do'} what the file says{self._but()}")
        if differ := by_status.get("differs"):
            parts.append(f"{_listed(differ)} {'does' if len(differ) == 1 else 'do'} something else than the file says")
        for status, one, several in (
            ("refused", "refuses the file", "refuse the file"),
            ("failed", "fails with the file", "fail with the file"),
            ("missing", "was not asked, for it cannot be imported", "were not asked, for they cannot be imported"),
        ):
            if names := by_status.get(status):
                parts.append(f"{_listed(names)} {one if len(names) == 1 else several}")
        if self._of_file():
            parts.append(f"the file is not {self.against or 'a mechanism of ideal hinges'}")
        if self.written is not None and self.written.status == 1:
            parts.append(f"not all engines read {self.written.path}, which was written, alike")
        if not parts:
            return "no engine was compared"
        return "; ".join(parts)

    def _but(self) -> str:
        """What was left out, in a few words each: the first of them, and how many more there are."""
        if not self.without:
            return ""
        named = [line.partition(",")[0].partition(" (")[0] for line in self.without]
        more = len(named) - MOST_LEFT_OUT
        return f" (left out: {', '.join(named[:MOST_LEFT_OUT])}{f' and {more} more' if more > 0 else ''})"

    def _of_file(self) -> bool:
        return any(finding.says.startswith("the file") for finding in self.findings)

    def to_json(self) -> dict[str, Any]:
        """The document that ``furiko diagnose --json`` prints."""
        return {
            "verdict": self.verdict,
            "headline": self.headline,
            "without": list(self.without),
            "findings": [finding.to_json() for finding in self.findings],
            "simulation": [finding.to_json() for finding in self.simulation],
            "engines": {name: dict(engine) for name, engine in self.engines.items()},
            "model": self.model,
            "against": self.against or None,
            "mechanism": dict(self.mechanism) if self.mechanism is not None else None,
            "spatial": dict(self.spatial),
            "notes": list(self.notes),
            "fix": self.written.to_json() if self.written is not None else None,
        }

    def text(self) -> str:
        """The text that ``furiko diagnose`` prints."""
        lines = [f"{self.model}: {self.verdict}" + (f" (against {self.against})" if self.against else "")]
        lines += [f"  {self.headline}", f"  {self.described()}"]
        for name, engine in self.engines.items():
            says = engine.get("says", "")
            lines.append(f"  {name:16} {engine['status']}" + (f": {says}" if says else ""))
        for finding in self.findings:
            lines.append(f"  {finding.cause} at {finding.where}")
            lines.append(f"      {finding.says}")
            if not _said(finding):
                lines.append(f"      {finding.cause}: {CAUSES[finding.cause]}")
        for found in (found for engine in self.engines.values() for found in engine.get("motion", ())):
            lines.append(f"  in its time steps: {found['cause']} at {found['where']}")
            lines.append(f"      {found['says']}")
            lines.append(f"      {found['cause']}: {CAUSES[found['cause']]}")
        lines += [f"  in a simulation: {found.says}" for found in self.simulation]
        lines += [f"  without: {line}" for line in self.without]
        lines += [f"  note: {note}" for note in self.notes]
        if self.written is not None:
            lines.append(self.written.text())
        return "\n".join(lines)

    def brief(self) -> str:
        """Verdict and headline, what was found and what was left out in a line each: one file of several."""
        lines = [f"{self.model}: {self.verdict}: {self.headline}"]
        lines += [f"  {finding.cause}: {finding.says}" for finding in self.findings]
        return "\n".join(lines + [f"  without: {line}" for line in self.without])

    def described(self) -> str:
        """The mechanism that was read, in a few words."""
        if self.mechanism is not None:
            links = len(self.mechanism["links"])
            return f"a planar tree of {links} link{'s' * (links != 1)}"
        bodies = self.spatial.get("bodies", [])
        kinds = [joint["kind"] for body in bodies for joint in body["joints"]]
        joints = ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds)) or "none"
        return f"{len(bodies)} bod{'ies' if len(bodies) != 1 else 'y'}; joints: {joints}"


def _said(finding: Finding) -> bool:
    """Whether a finding's own sentence has what its cause means."""
    return CAUSES[finding.cause].removeprefix("an engine that ").removeprefix("the engine ") in finding.says


def _listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def mechanism_to_json(mechanism: Mechanism) -> dict[str, Any]:
    """A mechanism for a report, SI units: gravity in the file's world; points (along, across) in the links' frames."""
    ideal = Hinge()
    links = []
    for i, (link, hinge) in enumerate(zip(mechanism.links, mechanism.hinges, strict=True)):
        not_ideal = {
            "stops" if name == "limits" else name: getattr(hinge, name)
            for name in HINGE_NUMBERS
            if getattr(hinge, name) != getattr(ideal, name)
        }
        links.append(
            {
                "name": mechanism.link_names[i],
                "joint": hinge.name,
                "on": mechanism.link_names[link.parent] if link.parent >= 0 else None,
                "hinge": list(link.hinge),
                "centre of mass": list(link.com),
                "mass": float(link.mass),
                "inertia": float(link.inertia),
                **not_ideal,
            }
        )
    return {"gravity": list(mechanism.gravity_vector), "links": links}
