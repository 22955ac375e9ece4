# one_command.sh: checks that `cc src/*/*.c`, with no flags except the include folder, builds lambent with the same
# golden pictures. It draws every 36th, because such a build takes ten times as long; cross-all draws all at -O0.
. tests/scripts/checks.sh

mkdir -p "$B"
check "$CC src/*/*.c" $CC -Iinclude -DGOLDEN_EACH=36 -o "$B/one-command" src/*/*.c \
    tests/golden/golden*.c tools/demo/demo_scene.c tests/golden/main_golden.c platform/host/port_host.c $LDLIBS
if [ $failed -eq 0 ]; then
    check "golden pictures of a build without flags" "$B/one-command"
fi
finish
