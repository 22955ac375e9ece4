"""defaults.py: pictures of shapes and models without camera and light: do they fill the frame, and have they tones?

    defaults.py TOOL FOLDER [MODEL...]

Draws 38 shapes of its own and each MODEL, at most 128x96 large, in the shape that the tool chooses without --size. The
air around shapes, the shapes of pictures and from where flat things are seen were chosen by them. A line each: the
share of the frame that shows the model itself, whether it touches a border, the median luminance of its pixels (of the
picture's codes, and linear), the share of them that is white in all channels; what is the file's own; what is missed.
FOLDER gets the shapes, own.png with all of them side by side, and sheet.png with the models too.
"""
import math
import os
import random
import struct
import subprocess
import sys
import zlib

WIDTH, HEIGHT, ACROSS = 128, 96, 8


class Mesh:
    def __init__(self, grey=None):
        self.corners, self.faces, self.grey = [], [], grey

    def box(self, at, half):
        first = len(self.corners)
        for i in range(8):
            self.corners.append([at[c] + half[c] * (1 if i >> c & 1 else -1) for c in range(3)])
        for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            self.faces.append([first + i for i in face])
        return self

    def grid(self, place, across, down):
        first = len(self.corners)
        for i in range(across + 1):
            self.corners += [place(i / across, j / down) for j in range(down + 1)]
        for i in range(across):
            for j in range(down):
                a = first + i * (down + 1) + j
                self.faces.append([a, a + 1, a + down + 2, a + down + 1])
        return self

    def sphere(self, at, r):
        return self.grid(lambda u, v: (at[0] + r * math.sin(math.pi * u) * math.sin(2 * math.pi * v),
                                       at[1] + r * math.cos(math.pi * u),
                                       at[2] + r * math.sin(math.pi * u) * math.cos(2 * math.pi * v)), 24, 32)

    def torus(self, wide, thin, is_upright):
        def place(u, v):
            a, b = 2 * math.pi * u, 2 * math.pi * v
            r = wide + thin * math.cos(b)
            p = (r * math.cos(a), thin * math.sin(b), r * math.sin(a))
            return (p[0], p[2], p[1]) if is_upright else p
        return self.grid(place, 48, 16)

    def write(self, path):
        with open(path, 'w') as out:
            if self.grey is not None:
                with open(path[:-3] + 'mtl', 'w') as library:
                    library.write('newmtl m\nKd %g %g %g\n' % self.grey)
                out.write('mtllib %s\nusemtl m\n' % os.path.basename(path[:-3] + 'mtl'))
            out.writelines('v %.7g %.7g %.7g\n' % tuple(p) for p in self.corners)
            out.writelines('f %s\n' % ' '.join(str(i + 1) for i in face) for face in self.faces)


def room(missing):
    made = Mesh().box((0, 0, 0), (2, 1.5, 2))
    del made.faces[missing]
    return made


def many(boxes):
    made = Mesh()
    for at, half in boxes:
        made.box(at, half)
    return made


def shapes():
    rng = random.Random(3)
    table = [((0, .75, 0), (.8, .03, .5))]
    table += [((x * .7, .36, z * .4), (.03, .36, .03)) for x in (-1, 1) for z in (-1, 1)]
    city = [((3 * x, h / 2, 3 * z), (1, h / 2, 1)) for x in range(-4, 5) for z in range(-4, 5)
            for h in [2 + (7 * x + 13 * z) % 9]]
    def hills():
        return Mesh().grid(lambda u, v: (40 * u - 20, 2 * math.sin(5 * u) * math.cos(4 * v), 40 * v - 20), 60, 60)
    def spring(u, v):
        a, b = 8 * math.pi * u, 2 * math.pi * v
        return ((1 + .2 * math.cos(b)) * math.cos(a), 3 * u + .2 * math.sin(b), (1 + .2 * math.cos(b)) * math.sin(a))
    arch = [((3 * math.cos(a), 3 * math.sin(a), 0), (.4, .4, .4)) for a in [math.pi * i / 16 for i in range(17)]]
    gear = [((2 * math.cos(a), 2 * math.sin(a), 0), (.3, .3, .3)) for a in [2 * math.pi * i / 12 for i in range(12)]]
    tree = Mesh().sphere((0, 4, 0), 1.5)
    return {
        'sphere': Mesh().sphere((0, 1, 0), 1), 'tiny': Mesh().sphere((0, 0, 0), 1e-4),
        'huge': Mesh().sphere((0, 0, 0), 5e3), 'far': Mesh().sphere((1000, 50, -3000), 2),
        'dark': Mesh((.03, .03, .03)).sphere((0, 0, 0), 1), 'white': Mesh((.95, .95, .95)).sphere((0, 0, 0), 1),
        'red': Mesh((.7, .02, .02)).sphere((0, 0, 0), 1), 'blue': Mesh((.02, .02, .7)).sphere((0, 0, 0), 1),
        'ring lies': Mesh().torus(1, .3, 0), 'ring stands': Mesh().torus(1, .3, 1),
        'wire ring': Mesh().torus(1, .02, 1),
        'cube': many([((0, 0, 0), (1, 1, 1))]), 'tower': many([((0, 10, 0), (.5, 10, .5))]),
        'mast': many([((0, 5, 0), (.1, 5, .1))]), 'plate': many([((0, 0, 0), (5, .05, 5))]),
        'coin': many([((0, 0, 0), (1, .02, 1))]), 'beam': many([((0, 0, 0), (8, .4, .4))]),
        'beam ahead': many([((0, 0, 0), (.4, .4, 8))]), 'wall': many([((0, 2, 0), (6, 2, .1))]),
        'wall ahead': many([((0, 2, 0), (.1, 2, 6))]), 'table': many(table), 'city': many(city),
        'stairs': many([((0, .1 * i, -.3 * i), (1, .1, .15)) for i in range(12)]),
        'two boxes': many([((-4, .5, 0), (.5, .5, .5)), ((4, 1, 0), (.5, 1, .5))]),
        'open front': room(1), 'open back': room(0), 'open left': room(4), 'open right': room(5), 'open above': room(3),
        'hills': hills(), 'hills and ball': hills().sphere((0, 5, 0), 2),
        'swarm': many([([rng.gauss(0, 1) for _ in range(3)], (.12, .12, .12)) for _ in range(300)]),
        'sheet': Mesh().grid(lambda u, v: (2 * u - 1, 0, 1 - 2 * v), 1, 1),
        'spring': Mesh().grid(spring, 160, 12), 'arch': many(arch), 'gear': many(gear + [((0, 0, 0), (1.8, 1.8, .2))]),
        'tree': tree.box((0, 1.5, 0), (.2, 1.5, .2)),
        'screen': Mesh().grid(lambda u, v: (2 * v - 1, 2 * u - 1, 0), 1, 1),
    }


def pfm_of(path):
    """Width, height, and the rows of a grey PFM as one list, the lowest row first."""
    with open(path, 'rb') as f:
        kind, size, _ = f.readline(), f.readline(), f.readline()
        assert kind == b'Pf\n', kind
        width, height = map(int, size.split())
        return width, height, [v[0] for v in struct.iter_unpack('<f', f.read())]


def ppm_of(path, count):
    with open(path, 'rb') as f:
        return f.read()[-3 * count:]


def linear(code):
    v = code / 255
    return v / 12.92 if v <= .04045 else ((v + .055) / 1.055) ** 2.4


def luminance(rgb):
    return .2126 * rgb[0] + .7152 * rgb[1] + .0722 * rgb[2]


def framed(width, height, rgb):
    """The picture in the middle of a black cell of the sheet."""
    wide, high = (WIDTH - width) // 2, (HEIGHT - height) // 2
    rows = [bytes(3 * wide) + rgb[3 * width * y:3 * width * (y + 1)] + bytes(3 * (WIDTH - width - wide))
            for y in range(height)]
    return bytes(3 * WIDTH * high) + b''.join(rows) + bytes(3 * WIDTH * (HEIGHT - height - high))


def judge(tool, model, stem):
    def draw(out, *more):
        command = [tool, 'render', model, '-o', stem + out, *more]
        return subprocess.run(command, check=True, capture_output=True, text=True).stderr

    alone = ['--show', 'depth', '--ground', 'none', '--world', 'none']
    said = draw('.pfm', *alone)
    width, height, _ = pfm_of(stem + '.pfm')  # default size, without --size
    scale = max(width / WIDTH, height / HEIGHT)
    width, height = round(width / scale), round(height / scale)
    size = ['--size', '%dx%d' % (width, height)]
    draw('.pfm', *alone, *size)
    said += draw('.ppm', *size)
    depth, rgb = pfm_of(stem + '.pfm')[2], ppm_of(stem + '.ppm', width * height)
    own = [(i % width, height - 1 - i // width) for i, d in enumerate(depth) if d > 0]
    if not own:
        return 'nothing of it is seen', framed(width, height, rgb)
    pixels = [rgb[3 * (y * width + x):][:3] for x, y in own]
    share = len(own) / (width * height)
    at_border = any(x in (0, width - 1) or y in (0, height - 1) for x, y in own)
    coded = sorted(luminance(p) / 255 for p in pixels)[len(pixels) // 2]
    light = sorted(luminance([linear(c) for c in p]) for p in pixels)[len(pixels) // 2]
    white = sum(min(p) == 255 for p in pixels) / len(pixels)
    missed = ['share'] * (not .15 <= share <= .8) + ['border'] * at_border + ['median'] * (not .15 <= coded <= .7) + \
             ['white'] * (white > .01)
    own_view = ['its camera'] * ('no camera in' not in said) + ['its light'] * ('no light in' not in said)
    return '%5.2f %6s %9.2f %7.2f %6.3f  %-22s %s' % (share, 'yes' if at_border else 'no', coded, light, white,
                                                     ', '.join(own_view), ' '.join(missed)), framed(width, height, rgb)


def write_png(path, width, height, rgb):
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + rgb[3 * width * y:3 * width * (y + 1)] for y in range(height))
    with open(path, 'wb') as out:
        out.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 2, 0, 0, 0)) +
                  chunk(b'IDAT', zlib.compress(rows, 9)) + chunk(b'IEND', b''))


def write_sheet(path, pictures):
    pictures = pictures + [bytes(3 * WIDTH * HEIGHT)] * (-len(pictures) % ACROSS)
    rows = b''.join(b''.join(pictures[r + i][3 * WIDTH * y:3 * WIDTH * (y + 1)] for i in range(ACROSS))
                    for r in range(0, len(pictures), ACROSS) for y in range(HEIGHT))
    write_png(path, ACROSS * WIDTH, HEIGHT * len(pictures) // ACROSS, rows)


def main():
    tool, folder = sys.argv[1], sys.argv[2]
    os.makedirs(folder, exist_ok=True)
    models = []
    for name, mesh in shapes().items():
        models.append((name, os.path.join(folder, name.replace(' ', '_') + '.obj')))
        mesh.write(models[-1][1])
    own = len(models)
    models += [(os.path.basename(p), p) for p in sys.argv[3:]]
    pictures = []
    print('%-26s %5s %6s %9s %7s %6s  %-22s %s' % ('', 'share', 'border', 'median', 'linear', 'white', '', 'missed'))
    for name, path in models:
        line, rgb = judge(tool, path, os.path.join(folder, 'drawn'))
        pictures.append(rgb)
        print('%-26s %s' % (name[:26], line), flush=True)
    write_sheet(os.path.join(folder, 'own.png'), pictures[:own])
    write_sheet(os.path.join(folder, 'sheet.png'), pictures)


if __name__ == '__main__':
    main()
