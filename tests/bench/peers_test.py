#!/usr/bin/env python3
"""peers.py with a stand-in for the published program: a path whose measures are known, in the published program's format.

  tests/bench/peers_test.py BUILD
"""

import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

PEERS = pathlib.Path(__file__).resolve().parent / 'peers.py'
BUILD = pathlib.Path(sys.argv[1]).resolve()

# A loop of 8 by 4 mm, 0.5 mm wide, counted from the lower left corner of the page, and 100 MB of memory.
STAND_IN = '''
import struct, sys, zipfile
assert sys.argv[1:] == ['data/loop.json'], sys.argv
memory = bytearray(b'x') * (96 << 20)
points = [(2, 3), (10, 3), (10, 7), (2, 7), (float('nan'), float('nan'))]
def npy(shape, values):
    header = repr({'descr': '<f4', 'fortran_order': False, 'shape': shape}).encode() + b'\\n'
    return b'\\x93NUMPY\\x01\\x00' + struct.pack('<H', len(header)) + header + struct.pack(f'<{len(values)}f', *values)
with zipfile.ZipFile('data/np/loop_polyline_3d.npz', 'w') as file:
    file.writestr('point.npy', npy((1, 5, 2), [c for p in points for c in p]))
    file.writestr('point_data.npy', npy((1, 5), [0.25] * 5))
    file.writestr('data.npy', npy((1, 2), [4, 0.2]))
'''

SCENE = '''{ "nozzle_width": 0.5, "svg_path": "data/svg/loop.svg", "line_field_path": "data/png/level.png",
"line_mode_field_path": "data/png/constrained.png", "perimeter_count": 0, "alignment_iter_per_level": 32, "seed": 1,
"force_sdf_computation": true, "repulse_curves": true, "layer_height_rt_nozzle_width": 0.5 }'''

# 12 by 8 mm in the lower left of the page: a loop that is upside down would lie outside.
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="30mm" viewBox="0 0 30 30"><path d="M0 30H12V22H0Z"/></svg>'


def grey(level):
    """A PNG of one pixel."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 1, 1, 8, 0, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(bytes([0, level]))) + chunk(b'IEND', b''))


def peers(*arguments):
    return subprocess.run([sys.executable, str(PEERS), *map(str, arguments), '--build', str(BUILD)], capture_output=True, text=True,
                          check=False)


def near(text, value, bound):
    assert abs(float(text) - value) <= bound, f'{text} instead of {value}'


with tempfile.TemporaryDirectory() as folder:
    peer = pathlib.Path(folder)
    for name in ('tools', 'src', 'data/svg', 'data/png', 'data/np'):
        (peer / name).mkdir(parents=True)

    done = peers(peer / 'src')
    assert done.returncode == 2 and 'is no copy of the paper\'s repository' in done.stderr, done.stderr

    (peer / 'tools' / 'fill_2d_shape.py').write_text(STAND_IN)
    (peer / 'data' / 'loop.json').write_text(SCENE)
    (peer / 'data' / 'svg' / 'loop.svg').write_text(DRAWING)
    (peer / 'data' / 'png' / 'level.png').write_bytes(grey(128))
    (peer / 'data' / 'png' / 'constrained.png').write_bytes(grey(255))

    # Of this interpreter some package is missing; of one that pretends to have them, none is.
    pretending = peer / 'python'
    pretending.write_text(f'#!/bin/sh\nif [ "$1" = -c ]; then echo Python 0; else exec {sys.executable} "$@"; fi\n')
    pretending.chmod(0o755)
    lacking = peer / 'lacking'
    lacking.write_text('#!/bin/sh\necho missing jax\n')
    lacking.chmod(0o755)
    done = peers(peer, '--python', lacking)
    assert done.returncode == 2 and 'lacks jax' in done.stderr, done.stderr
    done = peers(peer, 'nowhere', '--python', pretending)
    assert done.returncode == 2 and 'has no scene nowhere; it has loop' in done.stderr, done.stderr

    done = peers(peer, 'loop', '--runs', 2, '--python', pretending)
    assert done.returncode == 0, done.stderr
    theirs, ours = ([cell.strip() for cell in line.strip('|').split('|')] for line in done.stdout.splitlines()[-2:])
    assert theirs[:2] == ['loop', 'published'] and ours[:2] == ['loop', 'Sillon'], done.stdout
    assert float(theirs[2]) > 0 and float(ours[2]) > 0
    assert 96 < float(theirs[3]) < 200, theirs
    # Of 24 mm two thirds lie along the directions, one third across them; 24 mm of 0.5 mm on 96 mm².
    near(theirs[4], -2 / 3, 0.02)
    near(theirs[5], 100 * 24 * 0.5 / 96, 0.1)
    assert theirs[6:8] == ['0.00', '0.000'] and theirs[10:] == ['0', '0.02'], theirs
    assert float(ours[4]) < -0.9 and float(ours[5]) > 95, ours
    assert not list((peer / 'data' / 'np').iterdir()), 'the copy of the repository has changed'

    (peer / 'tools' / 'fill_2d_shape.py').write_text('import sys\nsys.exit("no memory")\n')
    done = peers(peer, '--runs', 1, '--python', pretending)
    assert done.returncode == 0 and '| loop | published | failed: no memory |' in done.stdout, done.stdout
    assert '| loop | Sillon | ' in done.stdout.splitlines()[-1]

    done = peers(peer, '--minutes', 0, '--python', pretending)
    assert done.returncode == 0 and done.stdout.endswith('not begun after 0 minutes: loop\n'), done.stdout
print('peers: a known path has its measures')
