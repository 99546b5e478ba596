#!/usr/bin/env python3
"""Makes a plate of every project in a folder on the nodes of a Ray cluster: docs/guide/many-plates.md.

  examples/many-plates/cluster.py PROJECTS PLATES

Run again, it does only what is missing or failed. RAY_ADDRESS names the cluster (default: one node, this machine). SILLON is the
program here and on every node (sillon), and PICTURE the width of the pictures in pixels (800).
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import ray

SILLON = os.environ.get("SILLON", "sillon")
SILLON = os.path.abspath(SILLON) if os.sep in SILLON else SILLON  # it runs in other folders than this
PICTURE = os.environ.get("PICTURE", "800")
REPORT = ".report.json"  # kept last: where it is, the plate is complete
OUTPUTS = {"--gcode": ".gcode", "--preview": ".png", "--report": REPORT}
WINDOW = 64  # plates under way: enough for every node, few enough to hold the files of all of them in memory


class Refused(Exception):
    """Why no plate is made of a project, in a sentence."""


def sillon(folder, *arguments, **environment):
    """What the program prints. Raises Refused with what it says is wrong."""
    try:
        run = subprocess.run([SILLON, *arguments], cwd=folder, capture_output=True, encoding="utf-8", errors="replace",
                             env=os.environ | environment)
    except OSError as error:
        raise Refused(f"{SILLON} does not start on {os.uname().nodename}: {error}") from error
    if run.returncode != 0:
        raise Refused(run.stderr.strip() or f"{SILLON} ended with {run.returncode}")
    return run.stdout


@ray.remote(num_cpus=1, max_retries=3)
def make(name, inputs, date):
    """Makes one plate in a folder of its own. Returns its files by suffix, or the sentence of what is wrong."""
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder, "in")
        for path, content in inputs.items():
            file = home / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        command = ["generate", f"{name}.json", "--threads", "1", "--quiet", "--preview-width", PICTURE]
        for option, suffix in OUTPUTS.items():
            command += [option, f"../out{suffix}"]
        try:
            sillon(home, *command, **date)
        except Refused as error:
            return str(error)
        return {suffix: pathlib.Path(folder, f"out{suffix}").read_bytes() for suffix in OUTPUTS.values()}


def inputs_of(project):
    """The project and the files that the program would read for it, by their paths from the project's folder. What is not
    there is left to the program, which says so. Raises Refused of a file that a node could not put where the project names it."""
    folder = project.parent
    if not project.is_file():
        raise Refused("it is no file")
    names = {project.name}
    for name in json.loads(sillon(folder, "generate", project.name, "--list-files")):
        if os.path.isabs(name) or os.path.normpath(name).split(os.sep)[0] == os.pardir:
            raise Refused(f'it names "{name}", which travels to no node; a file must lie in the folder of projects or below, '
                          "and be named from there")
        if (folder / name).is_file():
            names.add(name)
    return {name: (folder / name).read_bytes() for name in names}


def keep(plates, name, files):
    for suffix, content in files.items():
        part = plates / f"{name}{suffix}.part"
        part.write_bytes(content)
        part.replace(plates / f"{name}{suffix}")
    (plates / f"{name}.err").unlink(missing_ok=True)


def main(projects, plates):
    projects, plates = pathlib.Path(projects).resolve(), pathlib.Path(plates).resolve()
    if projects == plates:
        sys.exit(f"{plates} holds the projects; the plates need a folder of their own")
    wanted = sorted(projects.glob("*.json"))
    if not wanted:
        sys.exit(f"there is no project (*.json) in {projects}")
    plates.mkdir(parents=True, exist_ok=True)
    todo = [file for file in wanted if not (plates / f"{file.stem}{REPORT}").exists()]
    date = {key: os.environ[key] for key in ["SOURCE_DATE_EPOCH"] if key in os.environ}
    under_way, failed = {}, []

    def fail(name, error):
        failed.append(name)
        sentence = (str(error).strip() or repr(error)).splitlines()[0]
        (plates / f"{name}.err").write_text(f"{sentence}\n", encoding="utf-8", errors="backslashreplace")
        print(f"{name}: {sentence}", file=sys.stderr)

    # Whatever is wrong with one project, the others are made.
    while todo or under_way:
        while todo and len(under_way) < WINDOW:
            project = todo.pop(0)
            try:
                under_way[make.remote(project.stem, inputs_of(project), date)] = project.stem
            except Exception as error:
                fail(project.stem, error)
        if not under_way:
            break
        [done], _ = ray.wait(list(under_way), num_returns=1)
        name = under_way.pop(done)
        try:
            made = ray.get(done)  # tried on other nodes, three times, where its own was lost
            if isinstance(made, str):
                raise Refused(made)
            keep(plates, name, made)
        except Exception as error:
            fail(name, getattr(error, "cause", None) or error)  # Ray's own words of a fault begin with a list of calls
    made = sum((plates / f"{file.stem}{REPORT}").exists() for file in wanted)
    print(f"{made} plates made, {len(failed)} failed: {plates}")
    return 2 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 3 or not os.path.isdir(sys.argv[1]):
        sys.exit(f"usage: {sys.argv[0]} PROJECTS PLATES (two folders)")
    ray.init(address=os.environ.get("RAY_ADDRESS"), log_to_driver=False)
    sys.exit(main(*sys.argv[1:]))
