#!/usr/bin/env python3
"""Changes one line of the core at a time, runs the tests that should notice, and prints the changes that none noticed.

  tests/mutation/mutate.py [--build build/release] [--sample N] [--seed S] [--jobs J] [--list] [ROOM ...]

Rooms: stitch, relaxation, width, writer, motion (all of them by default). Tests that compare with recorded digests are
left out: a change must break a known truth. Sources stay as they are: each mutant is compiled into a folder of its own
and linked before the library. Exit code 1 where fewer than 80 % are noticed.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import re
import resource
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOAL = 0.8
CPU_SECONDS = 120  # of one test program; more is a hang, and that is noticed

# The sources of a room, and the programs that guard it: quick ones first.
ROOMS = {
    'stitch': (
        ['toolpath/stitch.cpp', 'toolpath/joining.cpp', 'toolpath/facing_points.cpp'],
        ['toolpath_facing_points_test', 'toolpath_joining_test', 'toolpath_stitch_test', 'pipeline_pipeline_test', 'pipeline_random_plates_test'],
    ),
    'relaxation': (
        ['toolpath/relaxation.cpp', 'toolpath/damping.cpp'],
        ['toolpath_damping_test', 'toolpath_relaxation_test', 'toolpath_turn_to_lines_test', 'pipeline_pipeline_test', 'pipeline_random_plates_test'],
    ),
    'width': (
        ['toolpath/bead_width.cpp'],
        ['toolpath_bead_width_test', 'toolpath_relaxation_test', 'pipeline_pipeline_test', 'pipeline_random_plates_test'],
    ),
    'writer': (
        ['gcode/writer.cpp', 'gcode/layer_writer.cpp', 'gcode/nozzle.cpp', 'gcode/start_and_end.cpp'],
        [
            'gcode_whole_file_test',
            'gcode_told_time_test',
            'gcode_patches_test',
            'gcode_writer_test',
            'gcode_dialect_test',
            'gcode_layout_test',
            'gcode_blocks_test',
            'gcode_base_layers_test',
            'gcode_reader_check_test',
        ],
    ),
    'motion': (['gcode/motion.cpp'], ['gcode_motion_test', 'gcode_told_time_test', 'gcode_writer_test', 'gcode_reader_check_test']),
}

# Cases that compare with a record instead of a truth.
RECORDS = '*it is the one on record*'

# Lines that no test of results can notice: they decide about speed, memory and progress, or say what a person reads.
SPEED = re.compile(
    r'parallelFor|kGrain|rowGrain|reserve\(|release\(|cancelled|run\.report|^\s*//|#include|^\s*\*|namespace|template|'
    r'static_assert|^\s*[{}]|\[\[nodiscard\]\]|using |CAPTURE|Error\{|" \+|return ".*"'
)

# A change of -1, which says "none", changes nothing. Each: a name, a pattern, and what stands there instead (a function of the match, or None for no mutant).
NUMBER = r'(?<![\w.])(?<!-)(\d+(?:\.\d*)?(?:e-?\d+)?)(f?)(?![\w.])'


def scaled(factor):
    def change(match):
        if float(match.group(1)) == 0 and factor != 1:
            return None
        value = float(match.group(1)) * factor
        if '.' in match.group(1) or 'e' in match.group(1) or match.group(2):
            return f'{value!r}{match.group(2)}'
        return str(int(value)) if value == int(value) else None

    return change


PATTERNS = [
    ('constant x 2', NUMBER, scaled(2)),
    ('constant x 0', NUMBER, lambda m: None if float(m.group(1)) == 0 else ('0.0' + m.group(2) if '.' in m.group(1) else '0')),
    ('0 becomes 1', r'(?<![\w.\[])0(?![\w.])', lambda m: '1'),
    ('< becomes >=', r' < ', lambda m: ' >= '),
    ('> becomes <=', r' > ', lambda m: ' <= '),
    ('<= becomes <', r' <= ', lambda m: ' < '),
    ('>= becomes >', r' >= ', lambda m: ' > '),
    ('== becomes !=', r' == ', lambda m: ' != '),
    ('!= becomes ==', r' != ', lambda m: ' == '),
    ('&& becomes ||', r' && ', lambda m: ' || '),
    ('|| becomes &&', r' \|\| ', lambda m: ' && '),
    ('+ becomes -', r' \+ ', lambda m: ' - '),
    ('- becomes +', r' - ', lambda m: ' + '),
    ('* becomes /', r' \* ', lambda m: ' / '),
    ('term dropped', r' [+-] (?:[\w.:]+(?:\([^()]*\)|\[[^\[\]]*\])*)(?=[;,)\s])', lambda m: ''),
    ('min becomes max', r'std::min\(', lambda m: 'std::max('),
    ('max becomes min', r'std::max\(', lambda m: 'std::min('),
    ('condition never holds', r'\bif \((?=.*\) (?:return|continue|break|\{))', lambda m: 'if (false && ('),
    ('true becomes false', r'\btrue\b', lambda m: 'false'),
    ('false becomes true', r'\bfalse\b', lambda m: 'true'),
    ('call dropped', r'^\s+[a-z]\w*(?:[.]\w+)?\([^=]*\);$', lambda m: ';'),
]


def mutants_of(source):
    """(line number, name, old line, new line) for every pattern and place in the file."""
    found = []
    lines = (ROOT / 'core/src' / source).read_text().split('\n')
    for number, line in enumerate(lines, 1):
        code, comment = (line.split('//', 1) + [''])[:2]
        if not code.strip() or SPEED.search(line) or '"' in code:
            continue
        for name, pattern, change in PATTERNS:
            for match in re.finditer(pattern, code):
                new = change(match)
                if new is None:
                    continue
                mutated = code[: match.start()] + new + code[match.end() :]
                if name == 'condition never holds':
                    mutated = closed_condition(mutated, match.start() + len('if (false && ('))
                    if mutated is None:
                        continue
                if mutated.strip() != code.strip():
                    found.append((source, number, name, line, mutated + ('//' + comment if comment else '')))
    return found


def closed_condition(line, start):
    """Closes the bracket that `if (false && (` opened; None where the condition goes on in the next line."""
    depth = 1
    for k in range(start, len(line)):
        depth += {'(': 1, ')': -1}.get(line[k], 0)
        if depth == 0:
            return line[: k + 1] + ')' + line[k + 1 :]
    return None


class Builder:
    def __init__(self, build):
        self.build = build
        self.compile = {}
        for entry in json.loads((build / 'compile_commands.json').read_text()):
            file = pathlib.Path(entry['file']).resolve()
            core = ROOT / 'core/src'
            if core in file.parents:
                self.compile[str(file.relative_to(core))] = shlex.split(entry['command'])
        self.links = {}

    def link_command(self, program):
        if program not in self.links:
            commands = subprocess.run(
                ['ninja', '-t', 'commands', '-s', f'tests/{program}'], cwd=self.build, check=True, text=True, capture_output=True
            ).stdout.strip()
            command = commands.split('\n')[-1]
            self.links[program] = shlex.split(re.sub(r'^: && (.*) && :$', r'\1', command))
        return list(self.links[program])

    def object_of(self, source, text, folder):
        """\return the compiled mutant, or None if it does not compile."""
        path = folder / pathlib.Path(source).name
        path.write_text(text)
        command = list(self.compile[source])
        if 'ccache' in command[0]:
            command = command[1:]
        out = folder / 'mutant.o'
        command[command.index('-o') + 1] = str(out)
        command[command.index('-c') + 1] = str(path)
        command += ['-w', '-O1']  # what is mutated is rarely what takes long
        done = subprocess.run(command, cwd=self.build, capture_output=True)
        return out if done.returncode == 0 else None

    def program_of(self, program, mutant, folder):
        command = self.link_command(program)
        if 'ccache' in command[0]:
            command = command[1:]
        out = folder / program
        command[command.index('-o') + 1] = str(out)
        library = next(k for k, word in enumerate(command) if word.endswith('libsillon.a'))
        command.insert(library, str(mutant))
        subprocess.run(command, cwd=self.build, check=True, capture_output=True)
        return out


def passes(program, folder):
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    command = [str(program), f'--test-case-exclude={RECORDS}', '--abort-after=1', '--no-colors']
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, preexec_fn=limit, timeout=20 * CPU_SECONDS)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def judge(builder, mutant, programs):
    """\return 'invalid', the program that noticed, or None: survived."""
    source, number, _, _, new = mutant
    lines = (ROOT / 'core/src' / source).read_text().split('\n')
    lines[number - 1] = new
    with tempfile.TemporaryDirectory(prefix='mutant-') as name:
        folder = pathlib.Path(name)
        compiled = builder.object_of(source, '\n'.join(lines), folder)
        if compiled is None:
            return 'invalid'
        for program in programs:
            linked = builder.program_of(program, compiled, folder)
            if not passes(linked, folder):
                return program
            linked.unlink()
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('rooms', nargs='*', default=list(ROOMS), metavar='ROOM')
    parser.add_argument('--build', default='build/release')
    parser.add_argument('--sample', type=int, default=60, help='mutants per room, drawn by the seed [60]; 0: all')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--list', action='store_true', help='print the mutants and run nothing')
    options = parser.parse_args()
    unknown = [room for room in options.rooms if room not in ROOMS]
    if unknown:
        parser.error(f'unknown room {unknown[0]}; known are {", ".join(ROOMS)}')

    plan = []
    for room in options.rooms:
        sources, programs = ROOMS[room]
        mutants = [m for source in sources for m in mutants_of(source)]
        if options.sample and options.sample < len(mutants):
            mutants = sorted(random.Random(options.seed).sample(mutants, options.sample))
        plan += [(room, m, programs) for m in mutants]
    if options.list:
        for room, (source, number, name, old, new), _ in plan:
            print(f'{source}:{number}: {name}\n  - {old.strip()}\n  + {new.strip()}')
        print(f'{len(plan)} mutants')
        return 0

    build = (ROOT / options.build).resolve()
    programs = sorted({program for _, _, some in plan for program in some})
    subprocess.run(['cmake', '--build', str(build), '--target', *programs], check=True, stdout=subprocess.DEVNULL)
    builder = Builder(build)
    for program in programs:
        builder.link_command(program)
        if not passes(build / 'tests' / program, build):
            sys.exit(f'{program} fails without any change')

    noticed, counted = {}, {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        verdicts = pool.map(lambda task: judge(builder, task[1], task[2]), plan)
        for (room, (source, number, name, old, new), _), verdict in zip(plan, verdicts):
            if verdict == 'invalid':
                continue
            counted[room] = counted.get(room, 0) + 1
            noticed[room] = noticed.get(room, 0) + (verdict is not None)
            if verdict is None:
                print(f'survived  {source}:{number}: {name}\n          - {old.strip()}\n          + {new.strip()}', flush=True)
    for room in counted:
        print(f'{room:11} {noticed[room]:4} of {counted[room]:4} noticed, {100 * noticed[room] / counted[room]:.0f} %')
    total = sum(counted.values())
    share = sum(noticed.values()) / max(1, total)
    print(f'{"all":11} {sum(noticed.values()):4} of {total:4} noticed, {100 * share:.0f} %')
    return 0 if share >= GOAL else 1


if __name__ == '__main__':
    sys.exit(main())
