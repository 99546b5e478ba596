#!/usr/bin/env python3
"""Runs the paper's published program beside Sillon on the same scenes, and prints one table for docs/internals/performance.md.

  tests/bench/peers.py PATH [SCENE ...] [--runs N] [--minutes M] [--python PYTHON] [--build build/release]

PATH is a copy of the paper's repository; SCENE is a name in its data folder, or all of them. The two programs run in turns.
Time is that of processors, the compiler of JAX included, the median of the runs; memory is the largest peak. Both paths are
measured by `sillon_bench measure`. The published program runs on a copy of its data, so nothing in PATH changes. PYTHON is an
interpreter with its packages (PATH/.venv/bin/python, or python3). After M minutes (60) no further scene begins.
"""

import argparse
import array
import ast
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = {'jax': 'jax', 'jaxlib': 'jaxlib', 'numpy': 'numpy', 'pyvista': 'pyvista', 'svgpathtools': 'svgpathtools', 'PIL': 'Pillow'}
OUTPUTS = ('np', 'vtk', 'log', 'paths', 'gcode')  # folders of its data that it writes to, and does not make itself


def stop(sentence):
    print(f'peers: {sentence}', file=sys.stderr)
    sys.exit(2)


def output(*command):
    """What a program prints, or nothing where it fails."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ''


def versions(python):
    """The packages of the published program in this interpreter, as text; ends where one is missing."""
    program = (
        'import importlib.util, importlib.metadata, platform\n'
        f'packages = {PACKAGES!r}\n'
        'missing = [name for module, name in packages.items() if importlib.util.find_spec(module) is None]\n'
        'print("missing " + " ".join(missing) if missing else ", ".join(["Python " + platform.python_version()] +'
        ' [f"{name} {importlib.metadata.version(name)}" for name in packages.values()]))\n')
    said = output(python, '-c', program)
    if not said:
        stop(f'{python} does not run; --python names an interpreter')
    if said.startswith('missing '):
        stop(f'{python} lacks {said[8:]}; install the packages that PATH/pyproject.toml names, or name another with --python')
    return said


def run(command, folder, environment, log):
    """Runs a program: its processor seconds and peak bytes, or None where it failed. What it says goes to the file `log`."""
    with open(log, 'wb') as file:
        child = subprocess.Popen(command, cwd=folder, env={**os.environ, **environment}, stdout=file, stderr=file)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    unit = 1 if sys.platform == 'darwin' else 1024
    return (usage.ru_utime + usage.ru_stime, usage.ru_maxrss * unit) if child.returncode == 0 else None


def numbers(archive, name):
    """An array of a NumPy archive (.npz): its shape and its numbers, row by row."""
    data = archive.read(f'{name}.npy')
    if data[:6] != b'\x93NUMPY' or data[6] != 1:
        raise ValueError(f'{name} is not an array of NumPy, version 1')
    end = 10 + int.from_bytes(data[8:10], 'little')
    header = ast.literal_eval(data[10:end].decode('latin-1'))
    if header['fortran_order'] or header['descr'] not in ('<f4', '<f8'):
        raise ValueError(f'{name} has the layout {header}')
    values = array.array('f' if header['descr'] == '<f4' else 'd')
    values.frombytes(data[end:])
    return header['shape'], values


def convert(archive, paths):
    """The published program's polylines as lines of x, y and width: `point` (n, m, 2) in mm from the lower left corner,
    `point_data` (n, m) with radii; NaN fills what is beyond a polyline's end. They are closed without a repeated point."""
    with zipfile.ZipFile(archive) as file:
        shape, points = numbers(file, 'point')
        _, radii = numbers(file, 'point_data')
    lines = []
    for polyline in range(shape[0]):
        for k in range(polyline * shape[1], (polyline + 1) * shape[1]):
            x, y = points[2 * k], points[2 * k + 1]
            if x == x and y == y:
                lines.append(f'{x!r} {y!r} {2 * radii[k]!r}')
        lines.append('')
    paths.write_text('\n'.join(lines), encoding='utf-8')


def measure(arguments):
    """The measures of a path, or the sentence that says why there are none."""
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else (done.stdout or done.stderr).strip()


def row(scene, program, runs, measures):
    if None in runs or not runs:
        return f'| {scene} | {program} | {measures} |'
    m = measures
    seconds, peak = statistics.median(r[0] for r in runs), max(r[1] for r in runs)
    return (f'| {scene} | {program} | {seconds:.2f} | {peak / 1e6:.0f} | {m["alignment"]:.4f} | {m["coverage"]:.2f} | '
            f'{m["overlap"]:.2f} | {m["spill"]:.3f} | {m["uTurns"]} | {m["kinks"]} | {m["crossings"]} | {m["lengthMm"] / 1000:.2f} |')


def last_line(log):
    lines = log.read_text(errors='replace').strip().splitlines()
    return lines[-1] if lines else 'it says nothing'


def compare(scene, peer, python, build, runs, work):
    """The two rows of a scene."""
    theirs, ours = [], []
    log, archive = work / 'log', work / 'data' / 'np' / f'{scene}_polyline_3d.npz'
    archive.unlink(missing_ok=True)
    environment = {'PYTHONPATH': str(peer / 'src'), 'JAX_PLATFORMS': 'cpu'}
    for _ in range(runs):
        if None not in theirs:
            theirs.append(run([python, str(peer / 'tools' / 'fill_2d_shape.py'), f'data/{scene}.json'], work, environment, log))
        ours.append(run([str(build / 'sillon'), 'generate', f'data/{scene}.json', '--quiet', '--svg', 'own.svg', '--report', 'own.json'],
                        work, {}, work / 'own.log'))
    meter = [build / 'sillon_bench', 'measure', work / 'data' / f'{scene}.json']
    measured = f'failed: {last_line(log)}'
    if None not in theirs:
        convert(archive, work / 'paths.txt')
        measured = measure([*meter, work / 'paths.txt'])
    own = f'failed: {last_line(work / "own.log")}'
    if None not in ours:
        own = measure(meter)
        digest = json.loads((work / 'own.json').read_text())['digest']
        if own['digest'] != digest:
            stop(f'{scene}: sillon made the plate {digest}, sillon_bench {own["digest"]}; build both anew')
    return row(scene, 'published', theirs if isinstance(measured, dict) else [], measured), row(scene, 'Sillon', ours, own)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('path', type=pathlib.Path)
    parser.add_argument('scenes', nargs='*')
    parser.add_argument('--runs', type=int, default=3)
    parser.add_argument('--minutes', type=float, default=60)
    parser.add_argument('--python')
    parser.add_argument('--build', type=pathlib.Path, default=ROOT / 'build' / 'release')
    asked = parser.parse_args()
    peer = asked.path.resolve()
    if not (peer / 'tools' / 'fill_2d_shape.py').is_file() or not (peer / 'data').is_dir():
        stop(f'{asked.path} is no copy of the paper\'s repository: it lacks tools/fill_2d_shape.py or data')
    own = peer / '.venv' / 'bin' / 'python'
    python = asked.python or (str(own) if own.exists() else 'python3')
    known = sorted(file.stem for file in (peer / 'data').glob('*.json'))
    for scene in asked.scenes:
        if scene not in known:
            stop(f'{asked.path}/data has no scene {scene}; it has {", ".join(known)}')
    if asked.runs < 1:
        stop('--runs must be at least 1')
    end = time.monotonic() + 60 * asked.minutes
    packages = versions(python)
    commit = output('git', '-C', str(peer), 'rev-parse', 'HEAD') or 'of unknown commit'
    print(f'published: {commit}, {packages}; Sillon: {output(str(asked.build / "sillon"), "--version")}')
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        shutil.copytree(peer / 'data', work / 'data', ignore=lambda where, _: OUTPUTS if where == str(peer / 'data') else ())
        for name in OUTPUTS:
            (work / 'data' / name).mkdir()
        print('\n| scene | program | processor s | peak MB | alignment | coverage % | overlap % | spill % | U-turns | kinks | '
              'crossings | length m |\n' + '|---' * 12 + '|')
        scenes = asked.scenes or known
        for k, scene in enumerate(scenes):
            if time.monotonic() > end:
                print(f'\nnot begun after {asked.minutes:g} minutes: {", ".join(scenes[k:])}')
                break
            print('\n'.join(compare(scene, peer, python, asked.build.resolve(), asked.runs, work)), flush=True)


if __name__ == '__main__':
    main()
