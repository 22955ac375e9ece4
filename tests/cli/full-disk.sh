# full-disk.sh: a full disk, and a closed stdout.
. tests/cli/common.sh

box
pit
photo
printf '0,0,0\n' >path.txt
status 0 render demo $few -o demo.png
status 0 relief bake pit.obj --size 16 --triangles 20 --views 6 -o pit.lmr

if [ -e /dev/full ]; then
    full() {
        tool "$@" >/dev/full 2>err.txt
        got=$?
        check "lambent $* >/dev/full: exit status $got" test $got -eq 1
        cause=": No space left on device"
        [ "$1" != lambent-bench ] || cause= # it writes each line at once, so at its end the cause is no longer known
        check "lambent $* >/dev/full: one line" test "$(grep -c "cannot be written$cause" err.txt)" -eq 1
    }
    full --version
    full --help
    full help render
    full help --man
    full render --help
    [ "${LMB_LONG:-0}" -le 1 ] || full doctor # nightly: this and --calibrate take seconds
    full render demo $few -o x.png
    full render demo $few -q -o -
    full render demo $few -q -o x.png --stats -
    full plan demo --size 32x24
    full plan demo --size 32x24 --json
    full bake box.obj --elements 64 --receivers 64 -o x.lmt
    full bake box.obj --elements 64 --receivers 64 -q -o -
    full pack box.obj -o x.lmp
    full pack box.obj -q -o -
    full play box.obj --size 16x16 --quality draft --frames 2
    full relief bake pit.obj --size 16 --triangles 20 --views 6 -o x.lmr
    full relief render pit.lmr --size 32x24 -o x.png
    full relight --world demo --object demo --size 16x8 --path path.txt -o x.ppm
    printf "0 camera 0,0,9 0,0,0\n" >keys.txt
    full relief render pit.lmr --size 16x8 --path keys.txt -o x.ppm
    full mix $seen $tent -q -o -
    full info demo.png
    full compare demo.png demo.png
    full lambent-bench raster fill-depth-pass --seconds 0.01
    full lambent-bench gather --backend scalar --seconds 0.01
    full lambent-bench hard mixed
    [ "${LMB_LONG:-0}" -le 1 ] || full lambent-bench --calibrate --threads 1
    full lambent-bench box.obj --size 16x16 --shadow-map 64 --runs 1 --sweep tree=8 --breakdown 0 --cache kept
else
    skip "a full disk: no /dev/full"
fi
"$TOOL" help >&- 2>err.txt
check "a closed stdout is exit status 1" test $? -eq 1
sh -c '"$1" render demo --size 16x16 --shadow-map 64 -o "$2" >&- 2>/dev/null' sh "$TOOL" closed.png
check "no words land in a file instead" sh -c '"$1" info "$2" >/dev/null && ! grep -aq triangles "$2"' sh "$TOOL" closed.png

finish
