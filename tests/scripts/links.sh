# links.sh: checks that every program of the tree links, and that the sources of `make prove` compile: MAKE B CC and
# PROGRAMS, the programs' paths, in the environment.
#
# The measure programs lie in $B/links, where their own sources are compiled at -O0.
. tests/scripts/checks.sh

# If make inherits these variables, it rebuilds everything and links the libraries twice.
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

# Frama-C reads these without __GNUC__.
for source in tests/static/*.c; do
    check "$source" $CC -fsyntax-only -std=c99 -Iinclude -U__GNUC__ -Wall -Wno-unused -Werror "$source"
done
check "tests/fuzz/main_fuzz.c" $CC -fsyntax-only -std=c99 -Iinclude -Wall -Werror tests/fuzz/main_fuzz.c
finish
