# places.sh: runs `make`, `make demo` and `make check` in different working environments: places.sh [CASE...]
#
#     rootless     by a user without root
#     spaces       in a path with blanks and an apostrophe
#     umask        with umask 077: nobody else may read the files
#     read-only    from a read-only clone, with BUILD elsewhere
#
# Each runs in a clean copy; without a CASE all four. MAKE CC B in the environment; PLACES_CHECKS selects checks;
# PLACES_CFLAGS replaces the quick flags. The check fails if the source tree changed.
. tests/scripts/checks.sh

case $B in /*) dir=$B/places ;; *) dir=$PWD/$B/places ;; esac
[ ! -d "$dir" ] || chmod -R u+w "$dir"
rm -rf "$dir"
mkdir -p "$dir"
flags=${PLACES_CFLAGS:--O1 -DLMB_HAVE_AVX512=0}
jobs=$(nproc 2>/dev/null || echo 2)
other=65534 # nobody, by number, because the user need not exist

# Root may read and write everything, so root's checks run as another user.
as_user() {
    if [ "$(id -u)" -eq 0 ]; then
        setpriv --reuid=$other --regid=$other --clear-groups "$@"
    else
        "$@"
    fi
}

# place_for_user CASE: sets `place` to a folder that the user can reach and BUILD can name: $B, or else a temporary one.
temporary=
trap '[ -z "$temporary" ] || rm -rf "$temporary"' EXIT
place_for_user() {
    as_user true 2>/dev/null || { skip "$1: root cannot become another user here (setpriv)" && return 1; }
    at=$dir
    case $dir in *[[:space:]\'\":]*) at=$temporary ;; esac
    as_user test -r "$at" -a -x "$at" || at=$temporary
    if [ -z "$at" ]; then
        temporary=$(mktemp -d "${TMPDIR:-/tmp}/lambent-places.XXXXXX") || exit 1
        chmod 755 "$temporary"
        at=$temporary
    fi
    place=$at/$1
    mkdir -p "$place"
}

# make_there ARGUMENT...: runs make in the copy as $who, with BUILD=$build if that is set.
make_there() {
    (cd "$tree" && $who env -i PATH="$PATH" HOME="$place/home" CC="${CC:-cc}" CFLAGS="$flags" ${build:+BUILD="$build"} \
        "${MAKE:-make}" -j"$jobs" "$@")
}

# listed: prints all files of the tree except those of the build.
listed() {
    (cd "$tree" && find . ! -path './build*' ! -path . -exec ls -ld {} + &&
        find . -type f ! -path './build/*' -exec cksum {} +)
}

# checked: succeeds if the last line of `make check` has no failure; keeps the log.
checked() {
    make_there check ${PLACES_CHECKS:+CHECKS="$PLACES_CHECKS"} >"$log" 2>&1 &&
        tail -n 1 "$log" | grep -q '^[1-9][0-9]* passed, 0 failed, ' && return
    grep -e '^FAIL' -e '[1-9][0-9]* failed' -e '\*\*\*' "$log" || tail -n 10 "$log"
    return 1
}

# works CASE: checks `make`, `make demo` and `make check` in $tree, run by $who.
works() {
    log=$dir/$1.log
    built=${build:-$tree/build}
    listed >"$dir/$1.before"
    check "$1: make" make_there
    check "$1: make demo" make_there demo
    check "$1: demo.png is whole" $who "$built/lambent" info "$built/demo.png"
    check "$1: make check" checked
    [ ! -f "$log" ] || echo "$1: $(tail -n 1 "$log")"
    listed >"$dir/$1.after"
    check "$1: the source tree changed" diff "$dir/$1.before" "$dir/$1.after"
}

copied() { # copied TREE: makes a clean copy there, and a home beside it
    tree=$1
    mkdir -p "$tree" "$place/home"
    check "a clean copy" clean_copy "$tree"
}

rootless() {
    place_for_user rootless || return
    copied "$place/lambent"
    [ "$(id -u)" -ne 0 ] || chown -R $other:$other "$place"
    who=as_user
    works rootless
}

spaces() {
    place="$dir/it's a"
    copied "$place/lam bent"
    works spaces
}

umask_077() {
    place=$dir/umask
    umask 077
    copied "$place/lambent"
    works umask
}

read_only() {
    place_for_user read-only || return
    copied "$place/lambent"
    build=$place/out
    mkdir "$build"
    [ "$(id -u)" -ne 0 ] || chown $other:$other "$build" "$place/home"
    chmod -R a-w,a+rX "$tree"
    who=as_user
    works read-only
    chmod -R u+w "$tree"
}

umask=$(umask)
[ $# -gt 0 ] || set -- rootless spaces umask read-only
for name in "$@"; do
    who= build=
    umask "$umask"
    case $name in
    rootless | spaces) $name ;;
    umask) umask_077 ;;
    read-only) read_only ;;
    *) fail "there is no case $name: rootless, spaces, umask, read-only" ;;
    esac
done
finish
