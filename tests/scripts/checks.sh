# checks.sh: functions for the shell checks that source it: pass, fail TEXT, skip REASON, bare, clean_copy; call
# `finish` last.
passed=0 failed=0 skipped=0

# Removes the suffixes that layout.h adds to names.
bare() { sed -E 's/_g[0-9]+_l[0-9]+(_[a-z][0-9]+)+//g'; }

pass() { passed=$((passed + 1)); }

fail() {
    failed=$((failed + 1))
    echo "FAIL $*"
}

skip() {
    skipped=$((skipped + 1))
    echo "skipped: $*"
}

# check TEXT COMMAND...: passes if the command succeeds; otherwise prints TEXT and the command's output.
check() {
    what=$1
    shift
    if said=$("$@" 2>&1); then
        pass
    else
        fail "$what"
        [ -z "$said" ] || printf '%s\n' "$said" | head -n 20
    fi
}

# clean_copy FOLDER: copies the tree as a new clone would have it, with uncommitted files; of a release all but build/.
clean_copy() {
    { git ls-files -co --exclude-standard 2>/dev/null || find . -type f ! -path './build/*' ! -path './.git/*'; } |
        while read -r f; do [ ! -f "$f" ] || echo "$f"; done | tar cf - -T - |
        (cd "$1" && tar xf - --no-same-owner --no-same-permissions)
}

finish() {
    echo "$passed passed, $failed failed, $skipped skipped"
    [ $failed -eq 0 ]
    exit
}
