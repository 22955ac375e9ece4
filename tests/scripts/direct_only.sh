# direct_only.sh: checks a build with only direct light (LMB_BOUNCE 0), in plain C without optimisation, so that each call that such
# a build lacks would stay undefined: it draws the direct light of the usual build, and nothing more if you ask for all
# light: CC FLAGS LIB LDLIBS B in the environment.
. tests/scripts/checks.sh

dir=$B/direct-only
rm -rf "$dir"
mkdir -p "$dir"
plain="-DLMB_HAVE_AVX512=0 -DLMB_HAVE_AVX2=0 -DLMB_HAVE_SSE2=0" # all kernels have the same source
check "a program with the library" $CC $FLAGS -o "$dir/usual" tests/scripts/direct_only.c "$LIB" $LDLIBS
check "all of src without bounced light" $CC $FLAGS -O0 -Wno-error -DLMB_BOUNCE=0 $plain -o "$dir/direct" tests/scripts/direct_only.c src/*/*.c $LDLIBS
wanted=$("$dir/usual")
check "direct light: $("$dir/direct") is not $wanted" test "$("$dir/direct")" = "$wanted"
check "all light: $("$dir/direct" full) is not $wanted" test "$("$dir/direct" full)" = "$wanted"
check "the usual build adds bounced light" test "$("$dir/usual" full)" != "$wanted"
check "trees without bounced light are refused" sh -c '! "$@" 2>/dev/null' sh $CC $FLAGS -DLMB_BOUNCE=0 -DLMB_TREES=1 -c \
    -o "$dir/refused.o" src/base/status.c
finish
