"""mix_rooms.py: `lambent mix` in rendered photos whose truth is known.

    python3 tests/measure/mix_rooms.py TOOL rooms FIRST PAST    rooms by numbers, lit as nobody told
    python3 tests/measure/mix_rooms.py TOOL glow                things that glow and stand on a floor

A photo is the room without the object, its truth the room with it, both by `lambent render`. Rooms have depth with a
Kinect's noise and holes, and a photo with noise; mix gets no --light. Errors are those of real surfaces, relative to
their mean, beside those of the photo as it is. Pixels that are clipped to white do not count.
"""
import array
import base64
import json
import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile

WIDTH, HEIGHT = 160, 120


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def text(a):
    return ",".join("%.6g" % x for x in a)


class Scene:
    """Triangles by material."""

    def __init__(self):
        self.materials, self.triangles = [], {}

    def material(self, colour, emits=None):
        self.materials.append((colour, emits))
        return len(self.materials) - 1

    def triangle(self, m, a, b, c):
        self.triangles.setdefault(m, []).append((a, b, c))

    def quad(self, m, a, b, c, d):
        self.triangle(m, a, b, c)
        self.triangle(m, a, c, d)

    def room(self, floor, wall, ceiling, w, h, d):
        self.quad(floor, (0, 0, 0), (0, 0, d), (w, 0, d), (w, 0, 0))
        self.quad(ceiling, (0, h, 0), (w, h, 0), (w, h, d), (0, h, d))
        self.quad(wall, (0, 0, 0), (w, 0, 0), (w, h, 0), (0, h, 0))
        self.quad(wall, (0, 0, d), (0, h, d), (w, h, d), (w, 0, d))
        self.quad(wall, (0, 0, 0), (0, h, 0), (0, h, d), (0, 0, d))
        self.quad(wall, (w, 0, 0), (w, 0, d), (w, h, d), (w, h, 0))

    def box(self, m, low, high, turn=0):
        x_mid, z_mid = (low[0] + high[0]) / 2, (low[2] + high[2]) / 2
        cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))

        def turned(x, y, z):
            x, z = x - x_mid, z - z_mid
            return (x_mid + cosine * x + sine * z, y, z_mid - sine * x + cosine * z)

        (x0, y0, z0), (x1, y1, z1) = low, high
        for side in (((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
                     ((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)),
                     ((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)),
                     ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)),
                     ((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)),
                     ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1))):
            self.quad(m, *[turned(*p) for p in side])

    def lathe(self, m, centre, profile, parts=32):
        """profile: radius and height, from the bottom up."""
        def at(radius, y, angle):
            return (centre[0] + radius * math.cos(angle), centre[1] + y, centre[2] - radius * math.sin(angle))

        for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
            for k in range(parts):
                a, b = 2 * math.pi * k / parts, 2 * math.pi * (k + 1) / parts
                if r0 > 0:
                    self.triangle(m, at(r0, y0, a), at(r0, y0, b), at(r1, y1, b))
                if r1 > 0:
                    self.triangle(m, at(r0, y0, a), at(r1, y1, b), at(r1, y1, a))

    def ball(self, m, centre, radius, rings=24):
        inner = [(radius * math.sin(math.pi * i / rings), -radius * math.cos(math.pi * i / rings))
                 for i in range(1, rings)]
        self.lathe(m, centre, [(0, -radius)] + inner + [(0, radius)], 2 * rings)

    def write(self, path, only=None, without=()):
        data, accessors, views, primitives = b"", [], [], []
        for m, triangles in self.triangles.items():
            if m in without or (only is not None and m not in only):
                continue
            points = [p for t in triangles for p in t]
            part = b"".join(struct.pack("<3f", *p) for p in points)
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
            accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": len(points), "type": "VEC3",
                              "min": [min(p[i] for p in points) for i in range(3)],
                              "max": [max(p[i] for p in points) for i in range(3)]})
            primitives.append({"attributes": {"POSITION": len(accessors) - 1}, "material": m})
            data += part
        materials = []
        for colour, emits in self.materials:
            m = {"pbrMetallicRoughness": {"baseColorFactor": list(colour) + [1], "metallicFactor": 0}}
            if emits:
                m["emissiveFactor"] = [x / max(emits) for x in emits]
                m["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": max(emits)}}
            materials.append(m)
        uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        with open(path, "w") as f:
            json.dump({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_emissive_strength"], "scene": 0,
                       "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": primitives}],
                       "materials": materials, "accessors": accessors, "bufferViews": views,
                       "buffers": [{"byteLength": len(data), "uri": uri}]}, f)


def read_pfm(path):
    with open(path, "rb") as f:
        channels = 3 if f.readline().strip() == b"PF" else 1
        width, height = map(int, f.readline().split())
        f.readline()
        values = array.array("f", f.read())
    row, out = width * channels, array.array("f")
    for y in range(height - 1, -1, -1):
        out.extend(values[y * row:(y + 1) * row])
    return out


def write_pfm(path, width, height, channels, values):
    with open(path, "wb") as f:
        f.write(b"%s\n%d %d\n-1.0\n" % (b"PF" if channels == 3 else b"Pf", width, height))
        for y in range(height - 1, -1, -1):
            f.write(array.array("f", values[y * width * channels:(y + 1) * width * channels]).tobytes())


def write_camera(path, fov, eye, target):
    focal = 0.5 * HEIGHT / math.tan(math.radians(fov) / 2)
    ahead = unit(minus(target, eye))
    right = unit(cross(ahead, (0, 1, 0)))
    down = cross(ahead, right)
    pose = [[right[i], down[i], ahead[i], eye[i]] for i in range(3)] + [[0, 0, 0, 1]]
    with open(path, "w") as f:
        json.dump({"fx": focal, "fy": focal, "cx": (WIDTH - 1) / 2, "cy": (HEIGHT - 1) / 2, "depth_unit_mm": 1000,
                   "camera_to_world": pose}, f)


def run(tool, *words):
    done = subprocess.run([tool] + [str(w) for w in words], capture_output=True, text=True)
    if done.returncode:
        sys.exit("%s\n%s" % (" ".join(map(str, words)), done.stderr))
    return done.stderr


def draw(tool, base, scene, things, camera, light, quality):
    """base.bare, base.truth, and their depths."""
    fov, eye, target = camera
    view = ["--eye", text(eye), "--target", text(target), "--fov", fov, "--size", "%dx%d" % (WIDTH, HEIGHT)]
    scene.write(base + ".truth.gltf")
    scene.write(base + ".bare.gltf", without=things)
    scene.write(base + ".object.gltf", only=things)
    for name in ("bare", "truth"):
        file = "%s.%s" % (base, name)
        run(tool, "render", file + ".gltf", *view, *light, "--bounces", 3, "--quality", quality, "-o", file + ".pfm")
        run(tool, "render", file + ".gltf", *view, *light, "--show", "depth", "-o", file + ".depth.pfm")
    write_camera(base + ".json", fov, eye, target)


def real_pixels(base, photo):
    """Those that show the same surface with the object and without, two pixels off its outline, and are not white."""
    pairs = zip(read_pfm(base + ".bare.depth.pfm"), read_pfm(base + ".truth.depth.pfm"))
    same = [abs(a - b) < 2e-3 for a, b in pairs]
    same = [s and max(photo[3 * i:3 * i + 3]) < .98 for i, s in enumerate(same)]
    count = WIDTH * HEIGHT
    return [same[i] and all(same[j] for j in (i - 1, i + 1, i - WIDTH, i + WIDTH) if 0 <= j < count)
            for i in range(count)]


def error(a, b, pixels):
    squares = total = n = 0
    for i, counts in enumerate(pixels):
        for c in range(3 * i, 3 * i + 3):
            if counts:
                x, y = min(a[c], 1), min(b[c], 1)
                squares, total, n = squares + (x - y) ** 2, total + y, n + 1
    return math.sqrt(squares / n) / (total / n)


# --- rooms by numbers ---------------------------------------------------------------------------------------------


def make_room(seed, white):
    """By turns a point light, a spot, a window beside the camera, outdoors.

    Returns the scene, the object's materials, the camera, options of lights, the way to the light, the generator, and
    whether the object is inside a box or a ball, as no real one can be.
    """
    r = random.Random(seed)
    u, scene, kind = r.uniform, Scene(), seed % 4
    floor = scene.material((u(.2, .6), u(.2, .55), u(.15, .5)))
    wall, ceiling = scene.material(tuple(u(.4, .75) for _ in range(3))), scene.material((.75, .75, .73))
    w, h, d = u(3.2, 4.6), u(2.3, 2.8), u(3.6, 5)
    if kind == 3:
        scene.quad(floor, (-30, 0, -30), (-30, 0, 30), (30, 0, 30), (30, 0, -30))
        scene.box(wall, (-1, 0, -1.3), (w + 1, u(1, 2.5), -.9))
    else:
        scene.room(floor, wall, ceiling, w, h, d)
    taken = []  # x, z and radius of things
    for _ in range(r.randint(2, 5)):
        m, x, z = scene.material(tuple(u(.08, .65) for _ in range(3))), u(.5, w - .6), u(.4, .55 * d)
        if u(0, 1) < .3:
            radius = u(.12, .28)
            scene.ball(m, (x, radius, z), radius, 12)
            taken.append((x, z, radius))
        else:
            a, b, c = u(.2, .6), u(.2, .8), u(.2, .6)
            taken.append((x, z, .5 * math.hypot(a, c)))
            scene.box(m, (x - a / 2, 0, z - c / 2), (x + a / 2, b, z + c / 2), u(0, 90))
    if u(0, 1) < .4:  # a rug
        m, x, z = scene.material(tuple(u(.1, .6) for _ in range(3))), u(.6, w - 1.5), u(.8, .5 * d)
        scene.quad(m, (x, .002, z), (x, .002, z + u(.5, 1)), (x + 1, .002, z + 1), (x + u(.6, 1), .002, z))
    eye, target = (u(.6, .85) * w, u(1.2, 1.7), u(.85, .95) * d), (u(.35, .55) * w, .35, .35 * d)
    fov, thing, x, z = u(46, 58), scene.material((.5, .45, .4)), u(.4, .6) * w, u(.45, .6) * d
    inside = any(math.hypot(x - p[0], z - p[1]) < p[2] + .1 for p in taken)
    shape = r.randint(0, 2)
    if shape == 0:
        scene.box(thing, (x - .12, 0, z - .1), (x + .12, u(.2, .35), z + .1), u(0, 90))
    elif shape == 1:
        radius = u(.1, .17)
        scene.ball(thing, (x, radius, z), radius, 12)
    else:
        scene.lathe(thing, (x, 0, z), [(0, 0), (.07, 0), (.05, .15), (.1, .3), (0, .34)], 20)
    light, at = [], None
    if kind == 0:
        watts = u(6, 12)
        at = (u(.15, .85) * w, u(.7, .88) * h, u(.2, .9) * d)
        light = ["--light", "point:%s:0,-1,0:%g,%g,%g:%g" % (text(at), watts, watts * .95, watts * .85, u(.02, .25))]
    elif kind == 1:
        watts = u(14, 26)
        at = (u(.1, .9) * w, .95 * h, u(.2, .9) * d)
        way = unit(minus((x + u(-.4, .4), 0, z + u(-.4, .4)), at))
        light = ["--light", "spot:%s:%s:%g,%g,%g:40,65:%g" % (text(at), text(way), watts, watts, watts * .9,
                                                              u(.02, .15))]
    elif kind == 2:
        glow = u(4, 9)
        pane, side, b, z0 = scene.material((0, 0, 0), (glow,) * 3), r.randint(0, 2), u(1, 1.6), u(.4, .7) * d
        if side == 0:
            scene.quad(pane, (.01, .9, z0), (.01, 2.1, z0), (.01, 2.1, z0 + b), (.01, .9, z0 + b))
            at = (0, 1.5, z0 + b / 2)
        elif side == 1:
            scene.quad(pane, (w - .01, .9, z0), (w - .01, .9, z0 + b), (w - .01, 2.1, z0 + b), (w - .01, 2.1, z0))
            at = (w, 1.5, z0 + b / 2)
        else:
            scene.quad(pane, (.4, .9, d - .01), (.4, 2.1, d - .01), (.4 + b, 2.1, d - .01), (.4 + b, .9, d - .01))
            at = (.4 + b / 2, 1.5, d)
    else:
        way, watts = unit((u(-1, 1), -u(.6, 1.3), u(-1, 1))), u(2, 9)
        light = ["--light", "sun:0,0,0:%s:%g,%g,%g:%g" % (text(way), watts, watts * .97, watts * .9, u(.5, 4)),
                 "--world", white, "--ground", "none"]
    to = unit(minus(at, (x, .1, z))) if at else tuple(-v for v in way)
    return scene, [thing], (fov, eye, target), light, to, r, inside


def add_noise(base, r):
    """base.color and base.depth: what a camera takes. Returns the photo without noise."""
    bare, truth = read_pfm(base + ".bare.pfm"), read_pfm(base + ".truth.pfm")
    scale = .9 / max(sorted(bare[1::3])[int(.97 * (len(bare) // 3))], 1e-6)
    clean = array.array("f", [min(v * scale, 1) for v in bare])
    write_pfm(base + ".truth.pfm", WIDTH, HEIGHT, 3, [min(v * scale, 1) for v in truth])
    write_pfm(base + ".color.pfm", WIDTH, HEIGHT, 3,
              [max(0, min(1, v + r.gauss(0, .004 + .012 * v))) for v in clean])
    depth, out = read_pfm(base + ".bare.depth.pfm"), []
    for i, z in enumerate(depth):
        beside = [depth[j] for j in (i - 1, i + 1, i - WIDTH, i + WIDTH) if 0 <= j < len(depth)]
        if not 0 < z <= 8 or (max(beside) > z * 1.08 and r.random() < .5):
            out.append(0)
            continue
        z += r.gauss(0, 1.2e-3 * z * z)
        step = z * z * 2.85e-3
        out.append(round(z / step) * step)
    write_pfm(base + ".depth.pfm", WIDTH, HEIGHT, 1, out)
    return clean


def rooms(tool, folder, first, past):
    ratios = []
    white = os.path.join(folder, "white.pfm")
    write_pfm(white, 8, 4, 3, [.6, .7, .9] * 32)
    for seed in range(first, past):
        base = os.path.join(folder, str(seed))
        scene, things, camera, light, to, r, inside = make_room(seed, white)
        if inside:
            print("%d: left out, the object is inside a thing" % seed, flush=True)
            continue
        draw(tool, base, scene, things, camera, light, "best")  # less leaves 0.01 to 0.13 of noise in the truth
        clean = add_noise(base, r)
        said = run(tool, "mix", "--frame", base, "--object", base + ".object.gltf", "--at", "world", "--voxels", 6,
                   "-o", base + ".mixed.pfm")
        sun = re.search(r"sun:0,0,0:([-.0-9,]+):", said)
        photo, truth = read_pfm(base + ".color.pfm"), read_pfm(base + ".truth.pfm")
        mixed = [m - p + c for m, p, c in zip(read_pfm(base + ".mixed.pfm"), photo, clean)]  # less the photo's noise
        pixels = real_pixels(base, photo)
        ours, theirs = error(mixed, truth, pixels), error(clean, truth, pixels)
        off = "none"
        if sun:
            way = unit([-float(v) for v in sun.group(1).split(",")])
            off = "%.0f" % math.degrees(math.acos(max(-1, min(1, sum(a * b for a, b in zip(way, to))))))
        ratios.append(ours / theirs)
        print("%d: %.4f, photo %.4f, ratio %.2f; sun off by %s degrees" % (seed, ours, theirs, ratios[-1], off), flush=True)
    print("mean ratio %.3f; %d of %d worse than the photo" %
          (sum(ratios) / len(ratios), sum(x > 1 for x in ratios), len(ratios)))


# --- things that glow ---------------------------------------------------------------------------------------------


def glow(tool, folder):
    camera = (46, (2.6, 1.3, 3.4), (1.5, .2, 1.6))
    light = ["--light", "spot:2.4,2.4,2.9:-0.25,-1,-0.35:24,24,24:40,70"]
    shapes = {"ball": .2, "box": .35, "cone": .25, "ring": .3}
    for name, albedo in shapes.items():
        scene, base = Scene(), os.path.join(folder, name)
        floor, wall = scene.material((albedo,) * 3), scene.material((.6, .6, .58))
        scene.room(floor, wall, wall, 3.6, 2.5, 4)
        shining = scene.material((0, 0, 0), (6, 5.5, 4.5))
        if name == "ball":
            scene.ball(shining, (1.6, .2, 1.7), .2)
        elif name == "box":
            scene.box(shining, (1.35, 0, 1.55), (1.7, .15, 1.8), 35)
        elif name == "cone":
            scene.lathe(shining, (1.6, 0, 1.7), [(0, 0), (.04, 0), (.22, .35), (0, .35)])
        else:
            turn = [t * math.pi / 6 - math.pi for t in range(13)]
            scene.lathe(shining, (1.6, .1, 1.7), [(.25 + .06 * math.cos(t), .06 * math.sin(t)) for t in turn])
        draw(tool, base, scene, [shining], camera, light, "best")
        os.rename(base + ".bare.pfm", base + ".color.pfm")
        write_pfm(base + ".depth.pfm", WIDTH, HEIGHT, 1, read_pfm(base + ".bare.depth.pfm"))
        run(tool, "mix", "--frame", base, "--object", base + ".object.gltf", "--at", "world", *light, "-o",
            base + ".mixed.pfm")
        photo, truth = read_pfm(base + ".color.pfm"), read_pfm(base + ".truth.pfm")
        pixels = real_pixels(base, array.array("f", [0]) * len(photo))
        print("%s: %.4f, photo %.4f" % (name, error(read_pfm(base + ".mixed.pfm"), truth, pixels),
                                        error(photo, truth, pixels)), flush=True)


def main():
    if len(sys.argv) not in (3, 5) or (sys.argv[2] == "rooms") != (len(sys.argv) == 5):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        if sys.argv[2] == "rooms":
            rooms(sys.argv[1], folder, int(sys.argv[3]), int(sys.argv[4]))
        else:
            glow(sys.argv[1], folder)


if __name__ == "__main__":
    main()
