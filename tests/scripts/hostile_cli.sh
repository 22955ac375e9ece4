# hostile_cli.sh: runs the whole tool on absurd and hostile files that it makes: TOOL and B in the environment.
#
# Cases of cli.sh are not repeated. An empty, truncated, endless or inconsistent file must be refused with one line, and
# an earlier output picture must stay. Files that are only unusual must be drawn.
. tests/scripts/checks.sh

dir=$B/hostile_cli
rm -rf "$dir"
mkdir -p "$dir"
small="--size 32x24 --shadow-map 64 --exposure 0"

# refused NAMED ARGUMENT...: exit status 1 or 2, nothing on stdout, one line on stderr that names the file.
refused() {
    named=$1
    shift
    "$TOOL" "$@" >"$dir/out.txt" 2>"$dir/err.txt"
    got=$?
    said=$(head -n 1 "$dir/err.txt")
    [ $got -eq 1 ] || [ $got -eq 2 ] && pass || fail "lambent $*: exit status $got, not 1 or 2: $said"
    [ "$(wc -l <"$dir/err.txt")" -eq 1 ] && pass || fail "lambent $*: not one line on stderr: $said"
    case $said in
    *"$named"*) pass ;;
    *) fail "lambent $*: does not name $named: $said" ;;
    esac
    [ ! -s "$dir/out.txt" ] && pass || fail "lambent $*: an error, yet output on stdout"
}

# no_scene FILE: checks that rendering fails, and that the earlier picture stays.
no_scene() {
    echo before >"$dir/kept.png"
    refused "$1" render "$dir/$1" $small -o "$dir/kept.png"
    [ "$(cat "$dir/kept.png")" = before ] && pass || fail "$1: overwrote a picture that it could not replace"
}

# no_picture FILE: checks that info and compare refuse the file.
no_picture() {
    refused "$1" info "$dir/$1"
    refused "$1" compare "$dir/$1" "$dir/$1"
}

# drawn FILE: checks that the file renders, with or without notes.
drawn() {
    check "lambent render $1" "$TOOL" render "$dir/$1" $small -o "$dir/drawn.png"
    check "lambent render $1 writes a picture" test -s "$dir/drawn.png"
    rm -f "$dir/drawn.png"
}

zeros() { dd if=/dev/zero bs="$1" count=1 2>/dev/null; }

# gltf NODES BUFFER_BYTES COUNT: prints a triangle of three vertices with one bufferView; COUNT is the accessor's count.
gltf() {
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[%s],' "$1"
    printf '"buffers":[{"byteLength":%s,"uri":"data:;base64,' "$2"
    printf 'AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],'
    printf '"bufferViews":[{"buffer":0,"byteLength":%s}],' "$2"
    printf '"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],'
    printf '"accessors":[{"bufferView":0,"componentType":5126,"count":%s,"type":"VEC3"}]}' "$3"
}

# Nodes that contain themselves, and a chain that is long but valid.
gltf '{"mesh":0,"children":[0]}' 36 3 >"$dir/own_child.gltf"
gltf '{"mesh":0,"children":[1]},{"children":[2]},{"children":[0]}' 36 3 >"$dir/cycle.gltf"
gltf "$(i=0; while [ $i -lt 200 ]; do i=$((i + 1)); printf '{"children":[%d]},' $i; done)"'{"mesh":0}' 36 3 \
    >"$dir/chain.gltf"
no_scene own_child.gltf
no_scene cycle.gltf
drawn chain.gltf

# Counts of 2^31 and more.
gltf '{"mesh":0}' 36 2147483648 >"$dir/accessor.gltf"
gltf '{"mesh":0}' 4294967294 3 >"$dir/buffer.gltf"
gltf '{"mesh":2147483648}' 36 3 >"$dir/index.gltf"
gltf '{"mesh":0}' 36 3 | sed 's/"bufferView":0,//; s/"count":3/"count":2147483648/' >"$dir/no_view.gltf"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2147483648\n' >"$dir/index.obj"
printf 'ply\nformat ascii 1.0\nelement vertex 2147483648\nproperty float x\nproperty float y\nproperty float z\n' \
    >"$dir/vertices.ply"
printf 'element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n' >>"$dir/vertices.ply"
printf 'ply\nformat binary_little_endian 1.0\nelement vertex 1\n' >"$dir/corners.ply"
printf 'property uchar x\nproperty uchar y\nproperty uchar z\n' >>"$dir/corners.ply"
printf 'element face 1\nproperty list uint uchar vertex_indices\nend_header\n\0\0\0\0\0\0\200' >>"$dir/corners.ply"
printf 'glTF\002\0\0\0\0\0\0\200\0\0\0\200JSON{}' >"$dir/length.glb"
for file in accessor.gltf buffer.gltf index.gltf no_view.gltf index.obj vertices.ply corners.ply length.glb; do
    no_scene $file
done
printf 'PF\n2147483648 2147483648\n-1.0\n0000' >"$dir/sides.pfm"
printf 'P6\n2147483648 1\n255\n000' >"$dir/sides.ppm"
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2147483648 +X 2147483648\n0000' >"$dir/sides.hdr"
no_picture sides.pfm
no_picture sides.ppm
no_picture sides.hdr

# A GLB cut in the header, in the first chunk and before the last byte.
gltf '{"mesh":0}' 36 3 >"$dir/whole.json"
while [ $(($(wc -c <"$dir/whole.json") % 4)) -ne 0 ]; do printf ' ' >>"$dir/whole.json"; done
bytes=$(wc -c <"$dir/whole.json")
octal() { printf '\\%03o\\%03o\\0\\0' $(($1 % 256)) $(($1 / 256)); }
{
    printf 'glTF\002\0\0\0'"$(octal $((bytes + 20)))$(octal $((bytes)))JSON"
    cat "$dir/whole.json"
} >"$dir/whole.glb"
drawn whole.glb
for size in 0 3 11 12 19 20 100 $((bytes + 19)); do
    dd if="$dir/whole.glb" of="$dir/cut.glb" bs=$((size > 0 ? size : 1)) count=$((size > 0)) 2>/dev/null
    no_scene cut.glb
done

# Vertices that are not numbers, triangles without area and triangles a million times as long as wide.
printf 'v nan nan nan\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 3 4\n' >"$dir/some_nan.obj"
printf 'v nan inf -inf\nv 1e999 0 0\nv 0 nan 0\nf 1 2 3\n' >"$dir/all_nan.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 1\nf 1 2 2\nf 1 2 1 2\nf 1 2 3\n' >"$dir/no_area.obj"
printf 'v 0 0 0\nv 1000 0 0\nv 0 0.001 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 4 5\n' >"$dir/needle.obj"
drawn some_nan.obj
no_scene all_nan.obj
drawn no_area.obj
drawn needle.obj

# PNG: no pixels, too few bytes, and 8192 x 8192 or more in a small file.
signature='\211PNG\r\n\032\n\0\0\0\015IHDR'
end='\0\0\0\0IEND\256B`\202'
nine='\0\0\0\013IDATx\234c`\200\002\0\0\011\0\001\373R\270\251' # nine zeros, compressed by zlib
printf "$signature"'\0\0\0\0\0\0\0\0\010\002\0\0\0\264\351\353E'"$nine$end" >"$dir/no_pixels.png"
printf "$signature"'\0\0\040\0\0\0\040\0\010\002\0\0\0\375\310\135\016'"$nine$end" >"$dir/few_bytes.png"
{
    printf "$signature"'\0\0\040\0\0\0\040\0\001\0\0\0\0\132\321\367\364\0\0\037\354IDAT'
    printf '\170\332\354\301\001\001\0\0\0\200\220\376\257\356\010\012'
    zeros 4094
    printf '\200\333\203\003\022\0\0\0\0A\377_\267#P\001'
    zeros 4040
    printf '\316\002\047\200\0\001\344\210\132\017'"$end"
} >"$dir/bomb.png"
{
    printf "$signature"'\0\0\100\0\0\0\100\0\001\0\0\0\0\201\263-)'
    printf '\0\0\0\013IDATx\234c`\200\002\0\0\011\0\001\373R\270\251'"$end"
} >"$dir/too_many.png"
no_picture no_pixels.png
no_picture few_bytes.png
no_picture too_many.png
check "bomb.png is a picture" "$TOOL" info "$dir/bomb.png"
for map in no_pixels few_bytes bomb; do
    printf 'mtllib %s.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' $map >"$dir/$map.obj"
    printf 'newmtl a\nmap_Kd %s.png\n' $map >"$dir/$map.mtl"
    drawn $map.obj
done
# Needs 256 MiB of texels and a third more for mip levels. Sanitizers need terabytes of address space.
if (ulimit -v 450000 && exec "$TOOL" info "$dir/no_pixels.obj") >"$dir/out" 2>&1; then
    (ulimit -v 450000 && exec "$TOOL" info "$dir/bomb.obj") >"$dir/out" 2>&1 && grep -q '^notes  *0' "$dir/out" && pass ||
        fail "bomb.obj: its picture takes more than 450 MB: $(tail -1 "$dir/out")"
else
    skip "a limit of memory: not to be had here"
fi

# Outputs that cannot be written: a full disk, a file in place of a folder, statistics in a missing folder.
if [ -c /dev/full ]; then
    for extension in png pfm ppm hdr; do
        ln -s /dev/full "$dir/full.$extension"
        refused full.$extension render demo $small -o "$dir/full.$extension"
    done
    refused /dev/full render demo $small -o "$dir/good.png" --stats /dev/full
    rm -f "$dir"/full.* "$dir/good.png"
else
    skip "a full disk: no /dev/full here"
fi
echo file >"$dir/file"
refused file/x.png render demo $small -o "$dir/file/x.png"
refused file/x.json render demo $small -o "$dir/good.png" --stats "$dir/file/x.json"
refused nowhere/x.json render demo $small -o "$dir/good.png" --stats "$dir/nowhere/x.json"
refused "$dir" render demo $small -o "$dir"
[ "$(cat "$dir/file")" = file ] && pass || fail "a file used as a folder changed"
[ ! -e "$dir/good.png" ] && pass || fail "a picture whose statistics have no place was written"
rm -f "$dir/good.png"

# `make hostile` must report if its list of files shrinks.
mkdir -p "$dir/corpus/png"
echo png >"$dir/corpus/png/one"
CORPUS=$dir/corpus LMB_SHARED=$dir/nothing sh tests/scripts/hostile.sh false 1 1 >"$dir/out.txt" 2>&1
check "a list that has shrunk fails" test $? -eq 1
check "and says so" grep -q '^FAIL the corpus: 1 files, [0-9]* are expected: the list has shrunk' "$dir/out.txt"
check "the repository's own is whole" sh -c 'LMB_SHARED="$1" sh tests/scripts/hostile.sh echo 1 1 | grep -q "^1 1 tests/fuzz/corpus/"' sh "$dir/nothing"

left=$(find "$dir" -name '*tmp*' -o -name 'x.*' -o -name 'nowhere' -o -name 'drawn*' -o -name 'good*')
check "left behind: $left" test -z "$left"
finish
