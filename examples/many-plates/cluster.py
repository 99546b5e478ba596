#!/usr/bin/env python3
"""Makes a plate of every project in a folder on the nodes of a Ray cluster: docs/guide/many-plates.md.

  examples/many-plates/cluster.py PROJECTS PLATES

Run again, it does only what is missing or failed. RAY_ADDRESS names the cluster (default: one node, this machine). SILLON is the
program on every node (sillon), and PICTURE the width of the pictures in pixels (800).
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import ray

SILLON = os.environ.get("SILLON", "sillon")
PICTURE = os.environ.get("PICTURE", "800")
OUTPUTS = {"--gcode": ".gcode", "--preview": ".png", "--report": ".json"}  # the report last: where it is, the plate is complete
WINDOW = 64  # plates under way: enough for every node, few enough to hold the files of all of them in memory


@ray.remote(num_cpus=1, max_retries=3)
def make(name, inputs, date):
    """Makes one plate in a folder of its own. Returns its name, its files by suffix, and the error's sentence or None."""
    with tempfile.TemporaryDirectory() as folder:
        for path, content in inputs.items():
            file = pathlib.Path(folder, "in", path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        command = [SILLON, "generate", f"in/{name}.json", "--threads", "1", "--quiet", "--preview-width", PICTURE]
        for option, suffix in OUTPUTS.items():
            command += [option, f"out{suffix}"]
        try:
            run = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=os.environ | date)
        except OSError as error:
            return name, {}, f"{SILLON} does not start on {os.uname().nodename}: {error}"
        if run.returncode != 0:
            return name, {}, run.stderr.strip() or f"{SILLON} ended with {run.returncode}"
        return name, {suffix: pathlib.Path(folder, f"out{suffix}").read_bytes() for suffix in OUTPUTS.values()}, None


def named_files(value, folder):
    """The files of the folder that a project names, by their paths in it."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return set().union(*(named_files(part, folder) for part in value))
    if not isinstance(value, str) or value == "" or "\0" in value:
        return set()
    file = (folder / value).resolve()
    return {value} if file.is_relative_to(folder) and file.is_file() else set()


def inputs_of(project):
    """The project and the files that it names. What cannot be read is left to the program, which says why."""
    content = project.read_bytes()
    try:
        names = named_files(json.loads(content), project.parent)
    except (ValueError, OSError):
        names = set()
    return {name: (project.parent / name).read_bytes() for name in names} | {project.name: content}


def keep(plates, name, files):
    for suffix, content in files.items():
        part = plates / f"{name}{suffix}.part"
        part.write_bytes(content)
        part.replace(plates / f"{name}{suffix}")


def main(projects, plates):
    projects, plates = pathlib.Path(projects).resolve(), pathlib.Path(plates)
    plates.mkdir(parents=True, exist_ok=True)
    todo = [file for file in sorted(projects.glob("*.json")) if not (plates / file.name).exists()]
    date = {key: os.environ[key] for key in ["SOURCE_DATE_EPOCH"] if key in os.environ}
    under_way, failed = {}, 0
    while todo or under_way:
        while todo and len(under_way) < WINDOW:
            project = todo.pop(0)
            under_way[make.remote(project.stem, inputs_of(project), date)] = project.stem
        [done], _ = ray.wait(list(under_way), num_returns=1)
        name = under_way.pop(done)
        try:
            _, files, error = ray.get(done)
        except ray.exceptions.RayError as lost:  # tried on other nodes, three times
            files, error = {}, str(lost).strip().splitlines()[0]
        if error is None:
            keep(plates, name, files)
            (plates / f"{name}.err").unlink(missing_ok=True)
        else:
            failed += 1
            (plates / f"{name}.err").write_text(f"{error}\n")
            print(f"{name}: {error}", file=sys.stderr)
    print(f"{len(list(plates.glob('*.gcode')))} plates made, {failed} failed: {plates}")
    return 2 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 3 or not os.path.isdir(sys.argv[1]):
        sys.exit(f"usage: {sys.argv[0]} PROJECTS PLATES (two folders)")
    ray.init(address=os.environ.get("RAY_ADDRESS"), log_to_driver=False)
    sys.exit(main(*sys.argv[1:]))
