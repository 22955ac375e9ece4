# links.sh: checks that every program of the tree links, that the one of `make demo` has no more than it needs, and that
# the sources of `make prove` compile: MAKE B CC NM TOOL and PROGRAMS, the programs' paths, in the environment.
#
# The measure programs lie in $B/links, where their own sources are compiled at -O0.
. tests/scripts/checks.sh

# If make inherits these variables, it rebuilds everything and links the libraries twice.
tool=$TOOL
unset LDLIBS FLAGS LIB TOOL
mkdir -p "$B/links"
log=$B/links/log
for program in $PROGRAMS; do
    case $program in */links/*) rm -f "$program" ;; esac
done
$MAKE -k $PROGRAMS >"$log" 2>&1
status=$?
for program in $PROGRAMS; do
    check "$program does not link" test -x "$program"
done
check "make ends with status $status: $(grep -E 'undefined reference|error|\*\*\*' "$log" | head -n 5)" test $status -eq 0

# Compiling the other backends and the readers of files would double the time of `make demo`.
has=$($NM "$B/demo-picture" | awk '{ print $NF }')
case $has in *lmb_kernels_sse2*) more='lmb_kernels_(avx2|avx512|scalar)|' ;; *) more= ;; esac
more=$(printf '%s\n' "$has" | grep -xE "${more}gltf_load|picture_read|lmb_draw_list|lmb_fixed_.*|lmb_plan_.*" | tr '\n' ' ')
check "demo-picture has what it does not need: $more" test -z "$more"
check "demo-picture fails" "$B/demo-picture" "$B/links/demo.png"
check "the README's picture is not the one of demo-picture" cmp "$B/links/demo.png" tests/results/demo.png
check "lambent doctor expects another hash of the built-in room" "$tool" doctor
if [ "${LMB_LONG:-0}" -ge 2 ]; then
    check "lambent render demo fails" "$tool" render demo -q -o "$B/links/rendered.png"
    check "lambent render demo draws another picture" cmp "$B/links/rendered.png" tests/results/demo.png
fi

# Frama-C reads these without __GNUC__.
for source in tests/static/*.c; do
    check "$source" $CC -fsyntax-only -std=c99 -Iinclude -U__GNUC__ -Wall -Wno-unused -Werror "$source"
done
check "tests/fuzz/main_fuzz.c" $CC -fsyntax-only -std=c99 -Iinclude -Wall -Werror tests/fuzz/main_fuzz.c
finish
