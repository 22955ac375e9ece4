# layout.sh: a program built with other capacities than the library must fail to link. CC FLAGS LIB LDLIBS B in the
# environment.
. tests/build/checks.sh

mkdir -p "$B/layout"
for call in lmb_group_points lmb_gather_tile lmb_gather_cut lmb_many_direct_tile lmb_render_begin lmb_build_check; do
    source=$B/layout/$call.c
    printf '#include <lambent/lambent.h>\ntypedef void (*any)(void);\nint main(void)\n{\n    volatile any p = (any)%s;\n    return p == 0;\n}\n' $call >"$source"
    check "$call links with the library's capacities" $CC $FLAGS -o "$B/layout/same" "$source" "$LIB" $LDLIBS
    for other in LMB_MAX_GROUPS LMB_MAX_LIGHTS LMB_MAX_CUT LMB_MANY_CUT; do
        if $CC $FLAGS -D$other=17 -o "$B/layout/other" "$source" "$LIB" $LDLIBS >/dev/null 2>&1; then
            fail "$call links although the program's $other is another"
        else
            pass
        fi
    done
done
finish
