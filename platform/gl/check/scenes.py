"""Draw a dozen scenes with PyOpenGL on the libOSMesa that LD_LIBRARY_PATH names: scenes.py OUT.rgba

OUT holds the pictures one after another, 160x120 RGBA each. scenes.py --names lists them."""
import math, sys
W, H = 160, 120

def look(gl, glu, angle=45.0):
    gl.glMatrixMode(gl.GL_PROJECTION); gl.glLoadIdentity(); glu.gluPerspective(angle, W / H, 1, 30)
    gl.glMatrixMode(gl.GL_MODELVIEW); gl.glLoadIdentity(); glu.gluLookAt(3, 2, 5, 0, 0, 0, 0, 1, 0)

def flat(gl):
    gl.glMatrixMode(gl.GL_PROJECTION); gl.glLoadIdentity(); gl.glOrtho(0, W, 0, H, -1, 1)
    gl.glMatrixMode(gl.GL_MODELVIEW); gl.glLoadIdentity()

def quad(gl, x, y, w, h, z=0.0, uv=1.0):
    gl.glBegin(gl.GL_QUADS)
    for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)):
        gl.glTexCoord2f(uv * i, uv * j); gl.glVertex3f(x + w * i, y + h * j, z)
    gl.glEnd()

def checks(n=16):
    return bytes(v for y in range(n) for x in range(n) for v in ((230, 90 + 8 * x, 40, 255) if (x ^ y) & 2 else (30, 60, 200 - 5 * y, 128)))

def texture(gl, how):
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, how)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, how)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 16, 16, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, checks())
    gl.glEnable(gl.GL_TEXTURE_2D)

def lamp(gl):
    gl.glEnable(gl.GL_LIGHTING); gl.glEnable(gl.GL_LIGHT0); gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, (2, 4, 3, 1))
    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_SPECULAR, (0.6, 0.6, 0.6, 1)); gl.glMaterialf(gl.GL_FRONT_AND_BACK, gl.GL_SHININESS, 20)

def triangles(gl, glu):
    flat(gl)
    gl.glBegin(gl.GL_TRIANGLES)
    for i in range(60):
        a = i * 0.7
        for k in range(3):
            gl.glColor3f((i * 37 % 60) / 60, k / 2, 1 - i / 60)
            gl.glVertex2f(80.3 + (20 + i) * math.cos(a + 2.1 * k), 60.1 + (15 + i * 0.7) * math.sin(a + 2.1 * k))
    gl.glEnd()

def depth(gl, glu):
    look(gl, glu); gl.glEnable(gl.GL_DEPTH_TEST)
    for i in range(6):
        gl.glPushMatrix(); gl.glRotatef(30 * i, 0.3, 1, 0.2); gl.glColor3f(i / 6, 0.5, 1 - i / 6); quad(gl, -1.5, -1, 3, 2); gl.glPopMatrix()

def fog(gl, glu):
    look(gl, glu); gl.glEnable(gl.GL_DEPTH_TEST); gl.glEnable(gl.GL_FOG)
    gl.glFogi(gl.GL_FOG_MODE, gl.GL_LINEAR); gl.glFogf(gl.GL_FOG_START, 3); gl.glFogf(gl.GL_FOG_END, 9); gl.glFogfv(gl.GL_FOG_COLOR, (0.8, 0.8, 0.9, 1))
    gl.glColor3f(0.2, 0.5, 0.1); gl.glRotatef(-80, 1, 0, 0); quad(gl, -3, -4, 6, 8)

def stencil(gl, glu):
    flat(gl); gl.glEnable(gl.GL_STENCIL_TEST); gl.glStencilFunc(gl.GL_ALWAYS, 1, 255); gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
    gl.glColorMask(0, 0, 0, 0); quad(gl, 20, 20, 80, 60); quad(gl, 60, 40, 80, 60); gl.glColorMask(1, 1, 1, 1)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    for v, c in ((1, (1, 0.5, 0)), (2, (0, 0.5, 1))):
        gl.glStencilFunc(gl.GL_EQUAL, v, 255); gl.glColor3fv(c); quad(gl, 0, 0, W, H)

def lights(gl, glu):
    look(gl, glu); lamp(gl); gl.glEnable(gl.GL_LIGHT1); gl.glEnable(gl.GL_NORMALIZE)
    gl.glLightfv(gl.GL_LIGHT1, gl.GL_POSITION, (-2, 2, 2, 1)); gl.glLightfv(gl.GL_LIGHT1, gl.GL_DIFFUSE, (0.9, 0.2, 0.1, 1))
    gl.glLightfv(gl.GL_LIGHT1, gl.GL_SPOT_DIRECTION, (1, -1, -1)); gl.glLightf(gl.GL_LIGHT1, gl.GL_SPOT_CUTOFF, 40); gl.glLightf(gl.GL_LIGHT1, gl.GL_SPOT_EXPONENT, 3)
    gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1); gl.glMaterialfv(gl.GL_BACK, gl.GL_DIFFUSE, (0.1, 0.7, 0.2, 1))
    q = glu.gluNewQuadric(); gl.glScalef(1.2, 0.9, 1.0); glu.gluCylinder(q, 1, 0.7, 1.4, 20, 6)

def lists(gl, glu):
    look(gl, glu); lamp(gl); name = gl.glGenLists(1); q = glu.gluNewQuadric()
    gl.glNewList(name, gl.GL_COMPILE); glu.gluSphere(q, 0.5, 16, 12); gl.glEndList()
    for i in range(9):
        gl.glPushMatrix(); gl.glTranslatef(i % 3 - 1, i // 3 - 1, 0); gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, (i / 9, 0.6, 1 - i / 9, 1)); gl.glCallList(name); gl.glPopMatrix()

def nearest(gl, glu):
    flat(gl); texture(gl, gl.GL_NEAREST); gl.glColor3f(1, 0.9, 0.8); quad(gl, 7.3, 5.4, 140, 100, 0, 2.3)

def linear(gl, glu):
    look(gl, glu); texture(gl, gl.GL_LINEAR); gl.glRotatef(-60, 1, 0, 0); quad(gl, -2, -2, 4, 4, 0, 3)

def blend(gl, glu):
    flat(gl); texture(gl, gl.GL_NEAREST); gl.glEnable(gl.GL_BLEND); gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glEnable(gl.GL_ALPHA_TEST); gl.glAlphaFunc(gl.GL_GREATER, 0.2)
    for i in range(5):
        gl.glColor4f(1, 0.3 * i, 1 - 0.2 * i, 1 - 0.2 * i); quad(gl, 10 + 20 * i, 10 + 9 * i, 64, 48)

def quadrics(gl, glu):
    look(gl, glu); lamp(gl); q = glu.gluNewQuadric()
    glu.gluSphere(q, 0.8, 24, 18); gl.glTranslatef(1.2, -0.5, 0); gl.glRotatef(-90, 1, 0, 0); glu.gluCylinder(q, 0.5, 0, 1.2, 20, 4)
    gl.glTranslatef(-2, 0, 0); glu.gluPartialDisk(q, 0.2, 0.8, 16, 3, 30, 250)

def tessellation(gl, glu):
    flat(gl); t = glu.gluNewTess()
    glu.gluTessCallback(t, glu.GLU_TESS_BEGIN, gl.glBegin); glu.gluTessCallback(t, glu.GLU_TESS_VERTEX, lambda v: gl.glVertex3dv(v)); glu.gluTessCallback(t, glu.GLU_TESS_END, gl.glEnd)
    glu.gluTessCallback(t, glu.GLU_TESS_COMBINE, lambda c, v, w: c)
    gl.glColor3f(0.9, 0.8, 0.1); star = [(80.2 + 55 * math.sin(i * 4 * math.pi / 5), 60.3 + 55 * math.cos(i * 4 * math.pi / 5), 0.0) for i in range(5)]
    glu.gluTessBeginPolygon(t, None); glu.gluTessBeginContour(t)
    for p in star: glu.gluTessVertex(t, p, p)
    glu.gluTessEndContour(t); glu.gluTessEndPolygon(t)

def readback(gl, glu):
    triangles(gl, glu)
    data = gl.glReadPixels(20, 20, 60, 50, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT); gl.glRasterPos2i(10, 10); gl.glDrawPixels(60, 50, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, data)
    gl.glPixelZoom(1, -1); gl.glRasterPos2i(85, 100); gl.glDrawPixels(60, 50, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, data)
    gl.glPixelZoom(1, 1); gl.glRasterPos2i(90, 5); gl.glCopyPixels(10, 10, 40, 30, gl.GL_COLOR)

# A scene, the tolerance of a colour in 1/255, and the number of pixels that may exceed the tolerance: pixels with an
# edge through the centre, or with a value between two codes, texels or facets.
SCENES = [(triangles, 1, 2), (depth, 1, 2), (fog, 1, 2), (stencil, 1, 0), (lights, 1, 2), (lists, 1, 2), (nearest, 1, 2),
          (linear, 3, 2), (blend, 1, 2), (quadrics, 1, 2), (tessellation, 1, 0), (readback, 1, 2)]

def main():
    import ctypes, OpenGL.GL as gl, OpenGL.GLU as glu
    from OpenGL import osmesa
    with open(sys.argv[1], 'wb') as out:
        for scene, _, _ in SCENES:
            c = osmesa.OSMesaCreateContextExt(gl.GL_RGBA, 24, 8, 0, None)
            memory = (ctypes.c_ubyte * (4 * W * H))()
            if not osmesa.OSMesaMakeCurrent(c, memory, gl.GL_UNSIGNED_BYTE, W, H): sys.exit('no context')
            gl.glDisable(gl.GL_DITHER)
            gl.glClearColor(0.1, 0.15, 0.2, 1); gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
            scene(gl, glu)
            gl.glFinish()
            if gl.glGetError() != 0: sys.exit(scene.__name__ + ': glGetError')
            out.write(bytes(memory))
            osmesa.OSMesaDestroyContext(c)

def compare(ours, theirs):
    """The table of both pictures; the number of scenes that differ by more than they may."""
    a, b, bad = open(ours, 'rb').read(), open(theirs, 'rb').read(), 0
    print('%-14s %9s %9s %9s %9s' % ('scene', 'differ', 'largest', 'beyond', 'may'))
    for n, (scene, tolerance, may) in enumerate(SCENES):
        p, q = a[n * 4 * W * H:(n + 1) * 4 * W * H], b[n * 4 * W * H:(n + 1) * 4 * W * H]
        worst = [max(abs(p[4 * i + k] - q[4 * i + k]) for k in range(3)) for i in range(W * H)]
        beyond = sum(w > tolerance for w in worst)
        bad += beyond > may
        print('%-14s %9d %9d %9d %9d%s' % (scene.__name__, sum(w > 0 for w in worst), max(worst), beyond, may, '' if beyond <= may else '  FAILED'))
    print('%d passed, %d failed, 0 skipped' % (len(SCENES) - bad, bad))
    return bad

if __name__ == '__main__':
    if sys.argv[1] == '--compare': sys.exit(1 if compare(sys.argv[2], sys.argv[3]) else 0)
    if sys.argv[1] == '--names': print('\n'.join(s.__name__ for s, _, _ in SCENES))
    else: main()
