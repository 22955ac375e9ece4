# pipes.sh: standard output and input instead of files.
. tests/cli/common.sh

box
pit
photo
moving

# piped NAME FILE ARGUMENT...: checks that `-o -` writes the same bytes to stdout as `-o FILE`, and messages to stderr.
piped() {
    what=$1 file=$2
    shift 2
    status 0 "$@" -o "$file"
    "$TOOL" "$@" -o "${pipe:--}" >pipe 2>err.txt
    check "$what -o ${pipe:--}: the bytes of the file" cmp "$file" pipe
}
piped "render demo" demo.png render demo $few
for format in ppm pfm hdr; do
    pipe=$format:-
    piped "render demo" demo.$format render demo $few
done
pipe=-
piped bake box.lmt bake box.obj --elements 64 --receivers 64
piped pack box.lmp pack box.obj
piped "relief bake" pit.lmr relief bake pit.obj --size 16 --triangles 20 --views 6
piped "relief render" pit.png relief render pit.lmr --size 32x24
piped mix mixed.png mix $seen $tent
piped relight field.png relight --world demo --object demo --size 32x16
"$TOOL" relight --world demo --cube pfm:- 2>/dev/null >pipe
check "relight --cube pfm:-" sh -c '"$1" info - <"$2" | grep -q "^size  *8x48$"' sh "$TOOL" pipe
"$TOOL" render demo $few -q -o quiet.png --stats - >pipe
check "--stats -" grep -q '^  "width": 32, "height": 24' pipe
status 0 render demo --size 16x12 --shadow-map 64 --quality draft -o half.pfm
"$TOOL" compare demo.pfm half.pfm --heat - >pipe 2>err.txt
check "sizes that differ leave stdout empty" test ! -s pipe
"$TOOL" compare demo.png demo.pfm --heat - >pipe 2>err.txt
check "the heat picture alone is on stdout" sh -c '"$1" info - <"$2" | grep -q PNG && grep -q "^trim" "$3"' sh "$TOOL" pipe err.txt

# fed FILE ARGUMENT...: checks that the output is the same if FILE comes from stdin, with `-` in its place.
fed() {
    file=$1
    shift
    "$TOOL" "$@" -q -o fed.ppm <"$file" >out.txt 2>&1 || fail "lambent $*: $(head -n 1 out.txt)"
    check "lambent $*: as of $file" cmp fed.ppm file.ppm
}
printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property float x' 'property float y' 'property float z' \
    'element face 1' 'property list uchar int vertex_indices' end_header '0 0 0' '1 0 0' '0 1 0' '3 0 1 2' >one.ply
for scene in box.obj one.ply odd.gltf; do
    status 0 render "$scene" $few -q -o file.ppm
    fed "$scene" render - $few
done
status 0 relief render pit.lmr --size 32x24 -q -o file.ppm
fed pit.lmr relief render - --size 32x24
status 0 bake box.obj -o box-1.lmt --elements 64 --receivers 64
status 0 render box.obj $inside --transfer box-1.lmt -q -o file.ppm
fed box-1.lmt render box.obj $inside --transfer -
status 0 mix $seen $tent -q -o file.ppm
fed photo.pfm mix --photo - --depth wall.pfm --intrinsics 30,30,11.5,11.5 $tent
fed wall.pfm mix --photo photo.pfm --depth - --intrinsics 30,30,11.5,11.5 $tent
check "compare takes - for one" sh -c '"$1" compare - "$2" <"$2" | grep -q "exact 768 of 768"' sh "$TOOL" demo.png
check "bake, plan and info take -" sh -c '"$1" bake - --elements 64 --receivers 64 -o - <"$2" | cmp - "$3" && "$1" plan - --size 32x24 <"$2" |
    grep -q "^bounced light" && "$1" info - <"$2" | grep -q "^triangles"' sh "$TOOL" box.obj box.lmt
status 2 compare - - <demo.png
said "-: standard input has been read; give one of both as a file"
status 1 render - -o bad.png </dev/null
status 2 mix --photo - --depth - --intrinsics 30,30,11.5,11.5 $tent -o bad.png <photo.pfm
said "-: standard input has been read; give one of both as a file"
printf '0,0,0\n' >path.txt
status 2 relight --world demo --object demo --path path.txt -o -
status 2 render demo -o xyz:-
said "png:-, ppm:-, pfm:- or hdr:- for standard output"
for verb in render mix relight "relief render"; do
    status 0 $verb --help
    check "$verb --help: -o to standard output" sh -c 'tr -s "\n " " " <"$1" | grep -qF -e "-, ppm:-, pfm:-, hdr:- are standard output"' sh out.txt
done
status 2 render demo -o /dev/stdout

finish
