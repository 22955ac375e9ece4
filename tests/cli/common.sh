# common.sh: functions shared by the tests of the tool. Each test sources common.sh first, from the root of
# the tree, with TOOL and B in the environment. After that the test runs in the folder $B/cli/PART and
# names files without a folder.
#
# SHORT=1 leaves out renders that take minutes and that other checks run; slow builds use it.
. tests/scripts/checks.sh

root=$PWD
whole() { case $1 in /* | '') whole=$1 ;; *) whole=$root/$1 ;; esac }
whole "$TOOL" && TOOL=$whole
whole "$B" && B=$whole
whole "$LIB" && LIB=$whole
export TOOL B
part=${0##*/} part=${part%.sh}
rm -rf "$B/cli/$part"
mkdir -p "$B/cli/$part"
cd "$B/cli/$part" || exit 1

small="--size 32x24 --shadow-map 64 --exposure 0"
few="--size 32x24 --shadow-map 64 --quality draft"

# check NAME COMMAND...: as in checks.sh, but without a subshell, because that takes as long as the command.
check() {
    what=$1
    shift
    if "$@" >checked.txt 2>&1; then
        pass
    else
        fail "$what"
        head -n 20 checked.txt
    fi
}

# tool ARGUMENT...: runs lambent with these arguments, or lambent-bench if this is the first one.
tool() {
    case $1 in
    lambent-bench) shift && "$TOOL-bench" "$@" ;;
    *) "$TOOL" "$@" ;;
    esac
}

# status WANTED ARGUMENT...: checks the exit status; a failure must print one line on stderr and nothing on stdout.
status() {
    wanted=$1
    shift
    tool "$@" >out.txt 2>err.txt
    got=$?
    [ $got -eq "$wanted" ] && pass || fail "lambent $*: exit status $got, not $wanted: $(head -n 1 err.txt)"
    if [ "$wanted" -eq 1 ]; then
        one_line err.txt && pass || fail "lambent $*: $(grep -c . err.txt) lines on stderr instead of one"
        [ ! -s out.txt ] && pass || fail "lambent $*: an error, yet output on stdout"
    elif [ "$wanted" -eq 2 ]; then
        [ -s err.txt ] && pass || fail "lambent $*: bad usage and not a word on stderr"
    fi
}

# The next functions read lines in the shell, because starting grep takes longer for short output.

# one_line FILE: checks that exactly one line is not empty.
one_line() {
    lines=0
    while IFS= read -r text || [ -n "$text" ]; do
        [ -z "$text" ] || lines=$((lines + 1))
    done <"$1"
    [ $lines -eq 1 ]
}

# holds WORDS FILE: checks that a line contains these words, unchanged.
holds() {
    while IFS= read -r text || [ -n "$text" ]; do
        case $text in *"$1"*) return 0 ;; esac
    done <"$2"
    return 1
}

# said WORDS: checks that the last `status` command printed these words.
said() {
    if holds "$1" err.txt; then
        pass
    else
        fail "lambent says: $1"
        head -n 20 err.txt
    fi
}

# lacks PATTERN FILE: checks that the file exists and no line matches.
lacks() { [ -f "$2" ] && ! grep -q -e "$1" "$2"; }

# differ FILE FILE: checks that both exist and differ.
differ() {
    cmp -s "$1" "$2"
    [ $? -eq 1 ]
}

# empty FILE...: checks that each exists and is empty.
empty() {
    for each in "$@"; do
        [ -f "$each" ] && [ ! -s "$each" ] || return 1
    done
}

# none FILE...: passes if no such file exists. The shell leaves a pattern unchanged if it matches nothing.
none() {
    for each in "$@"; do
        if [ -e "$each" ] || [ -L "$each" ]; then
            echo "$each is there"
            return 1
        fi
    done
}

absent() { [ ! -e "$1" ] && pass || fail "$1 should not be there"; }

# count FILE NAME: prints a number of the statistics.
count() { sed -n "/seconds/!s/.*\"$2\": \([0-9]*\).*/\1/p" "$1"; }

# bit FILE AT OUT: copies the file and flips the lowest bit of the byte at AT.
bit() {
    value=$(od -An -tu1 -j"$2" -N1 "$1" | tr -d ' ')
    # shellcheck disable=SC2059
    { head -c "$2" "$1"; printf "\\$(printf %03o $((value / 2 * 2 + 1 - value % 2)))"; tail -c +$(($2 + 2)) "$1"; } >"$3"
}

# repeated COUNT BYTES_IN_OCTAL: prints the bytes COUNT times.
repeated() {
    # shellcheck disable=SC2059
    printf "$2%.0s" $(seq "$1")
}

# compile ARGUMENT...: runs the build's compiler and flags from the root, because the flags have relative folders.
compile() { (cd "$root" && $CC $FLAGS "$@"); }

# pasted VERB...: checks that the examples of each verb's help work when pasted, with smaller numbers. Examples are all
# lines below `examples` that begin with two blanks and do not end in a colon. Output goes to paste/said-WORD.txt; WORD
# is the verb's last word.
cheap='s/320x240/32x24/; s/160x120/32x24/; s/64x48/32x24/; s/24x16/6x4/; s/--voxels [56]/--voxels 4/
    s/80x60/40x30/; s/72.43,72.43,39.5,29.5/36.2,36.2,19.5,14.5/
    /lambent pla/s/32x24/16x12/; s/--receivers [0-9]*/--receivers 200/
    s/--elements [0-9]*/--elements 256 --cluster 0.6/; s/--faces 32/--faces 8/; s/--seconds 0.1/--seconds 0.01/; s/--size 64 /--size 16 /
    s/--frames 4/--frames 2/; s/tree=16,32,64/tree=16,32/; s/voxels=4,5/voxels=4/; s/fill-depth /fill-depth-pass /; s/lambent doctor/& -v/
    s/lambent\(-bench\| render\| play\| capture\| plan\) demo/& --shadow-map 64/'
pasted() {
    mkdir -p paste
    for verb in "$@"; do
        tool $verb -h >help.txt
        {
            printf 'set -e\nPATH=${TOOL%%/*}:$PATH\n'
            sed -n '/^examples$/,/^exit status/{/^  .*[^:]$/p;}' help.txt | sed "$cheap"
        } >paste/run.sh
        check "$verb --help has an example" test "$(grep -c . paste/run.sh)" -gt 2
        [ -n "$SHORT" ] || check "$verb --help's example works when pasted" sh -c '
            cd paste && XDG_CACHE_HOME=. sh ./run.sh >"said-$1.txt" 2>&1 || { cat "said-$1.txt"; exit 1; }' sh "${verb##* }"
    done
}

# --- shared scenes and pictures ---

one='\000\000\200\077'  # 1, 0.5 and 2 as binary32
half='\000\000\000\077'
two='\000\000\000\100'

# white.pfm: a world of radiance 1; facepx.pfm: one pixel of it.
white() {
    { printf 'PF\n1 6\n-1.0\n'; repeated 18 "$one"; } >white.pfm
    { printf 'PF\n1 1\n-1.0\n'; printf "$one$one$one"; } >facepx.pfm
}

# series: tone_03.pfm, tone_04.pfm: worlds of radiance 1 and 2; between.pfm: of 1.5.
series() {
    { printf 'PF\n1 6\n-1.0\n'; repeated 18 "$one"; } >tone_03.pfm
    { printf 'PF\n1 6\n-1.0\n'; repeated 18 "$two"; } >tone_04.pfm
    { printf 'PF\n1 6\n-1.0\n'; repeated 18 '\000\000\300\077'; } >between.pfm
}

# box.obj, of twelve triangles.
box() {
    printf 'v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\n' >box.obj
}

# block.obj: the box with a block in it. `inside`: a view into both.
inside="--eye -0.8,0.6,-0.8 --target 0.3,-0.6,0.3 --size 32x24 --light point:0.2,0.5,0:0,-1,0:5,4,3 --show indirect"
block() {
    awk '/^v/ { v[++n] = $0; print } /^f/ { f[++m] = $0; print }
        END { for (i = 1; i <= n; ++i) { split(v[i], p, " "); print "v", 0.3 * p[2] + 0.3, 0.3 * p[3] - 0.69, 0.3 * p[4] + 0.2 }
              for (i = 1; i <= m; ++i) { split(f[i], p, " "); print "f", p[2] + n, p[3] + n, p[4] + n, p[5] + n } }' box.obj >block.obj
}

# pit.obj: a box with a pit, with six triangles more than a cube.
pit() {
    printf 'v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv 0 0 0.3\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n' >pit.obj
}

# floor.obj: a floor below the pit.
floor() { printf 'v -4 -1 4\nv 4 -1 4\nv 4 -1 -4\nv -4 -1 -4\nf 1 2 3 4\n' >floor.obj; }

# A grey photo of a wall, 24 x 24, 2 m away, and an object for it.
seen="--photo photo.pfm --depth wall.pfm --intrinsics 30,30,11.5,11.5"
tent="--object tent.obj --scale 0.2 --at 8,12 --shadow-map 64 --voxels 4"
photo() {
    { printf 'PF\n24 24\n-1.0\n'; repeated 1728 "$half"; } >photo.pfm
    { printf 'Pf\n24 24\n-1.0\n'; repeated 576 "$two"; } >wall.pfm
    printf 'v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n' >tent.obj
}

# moving.gltf: an animation moves light, camera and a triangle; odd.gltf: one that cannot be played.
moving() {
cat >moving.gltf <<'GLTF'
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"nodes":[{"mesh":0},{"mesh":1},
{"translation":[0,2,0],"extensions":{"KHR_lights_punctual":{"light":0}}},{"translation":[0,1.5,4],"camera":0}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":4}]}},
"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1,"aspectRatio":1.333}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":4}}]},{"primitives":[{"attributes":{"POSITION":5}}]}],
"animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}},
{"sampler":1,"target":{"node":2,"path":"translation"}},{"sampler":2,"target":{"node":3,"path":"translation"}}],
"samplers":[{"input":0,"output":1},{"input":0,"output":2},{"input":0,"output":3}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":0,"byteOffset":8,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":0,"byteOffset":32,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":0,"byteOffset":56,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":0,"byteOffset":80,"componentType":5126,"count":6,"type":"VEC3"},
{"bufferView":0,"byteOffset":152,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":188}],
"buffers":[{"byteLength":188,"uri":"data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAACamRk/AAAAAJqZmT4AAAAAAAAAQAAAAAAAAAA/AAAAQM3MzD4AAAAAAACAPwAAgEAAAAA/mpmZPwAAgEAAAEDAAAAAAAAAQMAAAEBAAAAAAAAAQEAAAEBAAAAAAAAAQMAAAEDAAAAAAAAAQMAAAEDAAAAAAAAAQEAAAEBAAAAAAAAAQEAAAAC/mpmZPgAAAAAAAAA/mpmZPgAAAAAAAAAAAACAPwAAAAA="}]}
GLTF
    sed 's/"input":0,"output":2/"input":0,"output":3,"interpolation":"CUBICSPLINE"/' moving.gltf >odd.gltf
}
