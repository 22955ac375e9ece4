# layout.sh: checks that a program built with other capacities than the library cannot link, with any call: CC FLAGS LIB
# LDLIBS NM B in the environment. layout.awk finds capacities and calls in the headers.
. tests/scripts/checks.sh

dir=$B/layout
mkdir -p "$dir"
awk -f tests/scripts/prototypes.awk include/lambent/*.h >"$dir/calls"
awk -f tests/scripts/layout.awk include/lambent/config.h $(ls include/lambent/*.h | grep -v config.h) "$dir/calls" >"$dir/found"
capacities=$(sed -n 's/^capacity //p' "$dir/found" | sort)
calls=$(sed -n 's/^call //p' "$dir/found" | sort)
check "no capacities, or few calls were found" test "$(echo $capacities | wc -w)" -ge 12 -a "$(echo $calls | wc -w)" -ge 60

# A program that uses all these calls.
{
    echo '#include <lambent/lambent.h>'
    echo 'typedef void (*any)(void);'
    echo 'volatile any p;'
    echo 'int main(void)'
    echo '{'
    for call in $calls lmb_build_check; do
        echo "    p = (any)$call;"
    done
    echo '    return p == 0;'
    echo '}'
} >"$dir/all.c"
check "a program with the library's capacities links" $CC $FLAGS -o "$dir/same" "$dir/all.c" "$LIB" $LDLIBS
${NM:-nm} "$LIB" 2>/dev/null | awk '$2 == "T" { print $3 }' | sort -u >"$dir/defined"
check "nm does not find the calls in $LIB" test "$(grep -c '^lmb_' "$dir/defined")" -ge 60

# differs TEXT FLAGS...: checks that the library has none of the calls of a program built with FLAGS.
differs() {
    what=$1
    shift
    if ! $CC "$@" -c "$dir/all.c" -o "$dir/other.o" >"$dir/said" 2>&1; then
        fail "$what: does not compile"
        cat "$dir/said"
        return
    fi
    ${NM:-nm} "$dir/other.o" | awk '$1 == "U" { print $2 }' | sort -u | comm -12 - "$dir/defined" >"$dir/shared"
    for name in $(sed 's/_g[0-9]*_l[0-9].*//' "$dir/shared"); do
        fail "$name links although the program's $what"
    done
    [ -s "$dir/shared" ] || pass
    if $CC "$@" -o "$dir/other" "$dir/all.c" "$LIB" $LDLIBS >/dev/null 2>&1; then
        fail "a program links although its $what"
    else
        pass
    fi
}

# Each capacity increased by one, for every definition in config.h.
rm -rf "$dir/include"
mkdir -p "$dir/include"
cp -r include/lambent "$dir/include"
chmod -R u+w "$dir/include" # the tree may be read-only
for capacity in $capacities; do
    awk -v name="$capacity" '$1 == "#define" && $2 == name { $3 += 1 } { print }' include/lambent/config.h \
        >"$dir/include/lambent/config.h"
    differs "$capacity is another" -I"$dir/include" $FLAGS
done

# README's example in the other configuration.
case " $FLAGS " in
*" -DLMB_CONFIG_TINY "*) other=-ULMB_CONFIG_TINY ;;
*) other=-DLMB_CONFIG_TINY ;;
esac
differs "configuration is the other one" $FLAGS $other
finish
