# own.sh: checks make run-NAME for user programs on this machine: a new program in its own folder, the messages if a
# name or a file is missing, and platform/cortex-m/main_scene.c with valid and refused scenes. MAKE BUILD TOOL B in the
# environment.
. tests/scripts/checks.sh

dir=$B/own-check
rm -rf "$dir"
mkdir -p "$dir/a" "$dir/b"

# runs TEXT STATUS LINE WORDS...: checks that make with these words exits with this status and prints a line that
# matches the regular expression LINE.
runs() {
    what=$1 status=$2 line=$3
    shift 3
    $MAKE "$@" BUILD="$BUILD" >"$dir/said" 2>&1
    ended=$?
    check "$what: exit status $ended" test $ended -eq "$status"
    check "$what: $(tail -n 2 "$dir/said")" grep -q "$line" "$dir/said"
}

hello() { # hello FOLDER WORD
    printf '#include <lambent/lambent.h>\n#include "port.h"\nint main(void)\n{\n    port_put("%s\\n");\n' "$2"
    echo '    return lmb_build_check() != LMB_OK;'
    echo '}'
}
hello a hello >"$dir/a/hello.c"
hello b another >"$dir/b/hello.c"
touch -t 200001010000 "$dir/b/hello.c"
runs "a program" 0 '^hello$' run-hello PROGRAM="$dir/a/hello.c"
runs "an older file of the same name" 0 '^another$' run-hello PROGRAM="$dir/b/hello.c"
runs "no such program" 2 'there is no program nobody; there are: baked demo .*scene .*PROGRAM=FILE\.c' run-nobody
runs "no such source" 2 'PROGRAM=nowhere\.c: there is no file nowhere\.c' run-hello PROGRAM=nowhere.c
runs "a name that is lambent's" 2 'run-demo: lambent has this program' run-demo PROGRAM="$dir/a/hello.c"
runs "no packed scene" 2 'PACKED=nowhere\.c: there is no file nowhere\.c' run-scene PACKED=nowhere.c

# A frame of the default configuration needs more than 384 KiB, the size for the tiny configuration.
sized() { printf '#define MEMORY_KIB %s\n#include "cortex-m/main_scene.c"\n' "$1"; }
sized 8 >"$dir/small.c"
check "a scene" "$TOOL" pack demo -o "$dir/scene.c" --name scene_words -q
runs "a frame that does not fit" 2 '^MEMORY_KIB is 8; this scene needs [1-9][0-9]*$' run-small PROGRAM="$dir/small.c $dir/scene.c"
needs=$(sed -n 's/^MEMORY_KIB is .* needs //p' "$dir/said")
sized "${needs:-8}" >"$dir/sized.c"
runs "a frame that fits" 0 '^scene-160x120-rgb565 [0-9a-f]\{16\}$' run-sized PROGRAM="$dir/sized.c $dir/scene.c"
check "its memory: $(grep frame "$dir/said")" grep -q '^frame [0-9]* bytes ([0-9]* KiB), with the scene.s structs [0-9]* of [0-9]*$' "$dir/said"

# refused TEXT LINE MODEL OPTION...: packs a model and checks the line that the program prints.
refused() {
    what=$1 line=$2 model=$3
    shift 3
    check "$what is packed" "$TOOL" pack "$model" -o "$dir/refused.c" --name scene_words -q "$@"
    runs "$what" 2 "^$line\$" run-sized PROGRAM="$dir/sized.c $dir/refused.c"
}
printf 'v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n' >"$dir/dark.obj"
cat >"$dir/unseen.gltf" <<'GLTF'
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":30}]}},
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/"}]}
GLTF
refused "a scene without a light" "the scene has no light" "$dir/dark.obj"
refused "a scene without a camera" "the scene has no camera" "$dir/unseen.gltf"
case $(printf '\1\0' | od -An -tx2) in *0001) other=big ;; *) other=little ;; esac
refused "the other byte order" "scene_words is no packed scene of this byte order: LMB_ERR_FORMAT" demo --endian $other
finish
