"""Prints the worst errors of ``reference/measured.md`` from a report: ``python docs/worst_errors.py [FOLDER]``."""

import sys

import furiko

SCENES = ("double-pendulum", "n-leg-3", "n-leg-32", "rods-5", "rods-20", "rods-50", "rods-100")


def main(folder: str = "furiko-report") -> None:
    """Largest norm-wise error over all states of some scenes, each side against the proven accelerations."""
    report = furiko.read_stream(folder)
    found = {(result.scene, result.engine): result for result in report.results if result.check == "accelerations"}
    print(f"| scene | document's formula | {' | '.join(report.engines)} |")
    print("|---" * (len(report.engines) + 2) + "|")
    for scene in SCENES:
        cells = [found[scene, engine].details for engine in report.engines]
        formula = cells[0]["forward error of the document's formula"]
        print(f"| {scene} | {formula:.0e} | {' | '.join(format(cell['forward error'], '.0e') for cell in cells)} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
