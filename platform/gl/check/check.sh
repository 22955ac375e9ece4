#!/bin/sh
# Runs foreign programs on our libOSMesa: check.sh GL_FOLDER. A client is skipped if its packages are missing.
#
# GL_CLIENTS names the clients; `fast` leaves piglit out. GL_HASHES=print prints the hashes of our own program.
set -u
gl=$(cd "$1" && pwd) || exit 1
here=platform/gl/check
out=$gl/check
mkdir -p "$out"
passed=0 failed=0 skipped=0
good() { passed=$((passed + 1)); }
bad() { failed=$((failed + 1)); echo "FAILED: $*"; }
skip() { skipped=$((skipped + 1)); echo "skipped: $*"; }

# Our own pictures against pinned hashes: the same on every machine.
own() {
    if ! ${CC:-cc} -std=c99 -O1 -Iplatform/gl/include -o "$out/own" $here/own.c "$gl/libGL.a" -lm; then
        bad "own.c does not compile"
        return
    fi
    "$out/own" > "$out/own.txt" || bad "own"
    [ "${GL_HASHES:-}" = print ] && cat "$out/own.txt"
    if cmp -s "$out/own.txt" $here/own.txt; then good; else bad "own: $out/own.txt is not $here/own.txt"; fi
}

# Hostile arguments, batches at the edges of the picture, two contexts in two threads, lit vertices, random draws by
# every back end, lists that fill the memory, and draws that wait in one batch. CFLAGS are those of the library, as a
# sanitizer needs.
program() {
    if ! ${CC:-cc} ${CFLAGS:-} -std=gnu99 -O1 -Iplatform/gl/include -o "$out/$1" "$2" "$gl/libGL.a" -lm -lpthread; then
        bad "$2 does not compile"
        return
    fi
    if "$out/$1" > "$out/$1.out" 2> "$out/$1.txt"; then good; else bad "$1: see $out/$1.txt"; fi
}
hostile() { program hostile tests/fuzz/main_gl.c; }
outside() { program outside $here/outside.c; }
threads() { program threads $here/threads.c; }
full() { program full $here/full.c; }
fours() { program fours $here/fours.c; }
alike() { program alike $here/alike.c; }
batches() { program batches $here/batches.c; }

# Meshes by every primitive and every way to send them: the same pictures, and pinned hashes.
meshes() {
    program meshes $here/meshes.c
    "$out/meshes" pin > "$out/meshes.hash"
    if cmp -s "$out/meshes.hash" $here/meshes.txt; then good; else bad "meshes: $out/meshes.hash is not $here/meshes.txt"; fi
}

# Bounced light: the checks of bounced.c, and the same pictures by every back end.
bounced() {
    program bounced $here/bounced.c
    if ${CC:-cc} -std=c99 -O1 -Iplatform/gl/include -o "$out/room" platform/gl/examples/bounced.c "$gl/libGL.a" -lm &&
        "$out/room" "$out/room.ppm"; then good; else bad "examples/bounced.c"; fi
    for kernels in none scalar sse2 avx2 neon; do
        LAMBENT_GL_KERNELS=$kernels "$out/bounced" hash > "$out/bounced.hash"
        if cmp -s "$out/bounced.hash" $here/bounced.txt; then good; else bad "bounced by $kernels: $out/bounced.hash"; fi
    done
}

# A C program with GLU: quadrics and tessellation by Debian's libGLU, which draws through our libOpenGL.
glu() {
    [ -f /usr/include/GL/glu.h ] || { skip "glu: libglu1-mesa-dev is missing"; return; }
    if ! ${CC:-cc} -std=c99 -O1 -Iplatform/gl/include -idirafter /usr/include -o "$out/glu" $here/glu.c -L"$gl" -l:libOSMesa.so.8 -lGLU \
        -Wl,-rpath,"$gl"; then
        bad "glu.c does not link"
        return
    fi
    if LD_LIBRARY_PATH=$gl "$out/glu"; then good; else bad "glu"; fi
}

# GLFW 3.3 with an OSMesa context, on a display in memory.
glfw() {
    [ -f /usr/include/GLFW/glfw3.h ] || { skip "glfw: libglfw3-dev is missing"; return; }
    for need in xvfb-run xkbcomp; do
        command -v $need > /dev/null || { skip "glfw: xvfb or x11-xkb-utils is missing"; return; }
    done
    if ! ${CC:-cc} -std=c99 -O1 -Iplatform/gl/include -idirafter /usr/include -o "$out/glfw" $here/glfw.c -lglfw; then
        bad "glfw.c does not compile"
        return
    fi
    if LD_LIBRARY_PATH=$gl xvfb-run -a "$out/glfw"; then good; else bad "glfw"; fi
}

pyopengl() {
    python=/usr/bin/python3
    $python -c 'import OpenGL' 2>/dev/null || { skip "pyopengl: python3-opengl is missing"; return; }
    if ! PYOPENGL_PLATFORM=osmesa LD_LIBRARY_PATH=$gl $python $here/scenes.py "$out/ours.rgba"; then
        bad "pyopengl: a scene"
        return
    fi
    if ! PYOPENGL_PLATFORM=osmesa $python $here/scenes.py "$out/theirs.rgba" 2>/dev/null; then
        skip "pyopengl: libosmesa6 is missing, nothing to compare with"
        return
    fi
    if $python $here/scenes.py --compare "$out/ours.rgba" "$out/theirs.rgba"; then good; else bad "pyopengl"; fi
}

# piglit, with stand-ins for a window system that are beside the repository.
piglit() {
    [ -f ../shared/gl/piglit.py ] || { skip "piglit: ../shared/gl is missing"; return; }
    [ -d /usr/lib/x86_64-linux-gnu/piglit ] || { skip "piglit: the package is missing"; return; }
    python3 ../shared/gl/piglit.py "$gl/liblambentgl.so" "$out/piglit.tsv" > "$out/piglit.txt" || { bad "piglit"; return; }
    cat "$out/piglit.txt"
    # A test that passed once must pass; the list has the reasons for the others.
    missing=$(awk -F '\t' 'NR == FNR { if ($2 == "pass") ok[$1] = 1; next } /^spec/ && !($1 in ok) { print $1 }' "$out/piglit.tsv" $here/piglit_pass.txt)
    if [ -z "$missing" ]; then good; else bad "piglit: $missing"; fi
}

clients=${GL_CLIENTS:-own hostile outside threads full fours alike batches meshes bounced glu glfw pyopengl piglit}
[ "$clients" = fast ] && clients="own hostile outside threads full fours alike batches meshes bounced glu glfw pyopengl"
for client in $clients; do
    $client
done
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
