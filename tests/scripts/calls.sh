# calls.sh: the stack that each of a build's calls takes at most, the hungriest first: calls.sh BUILD BYTES
#   ok|over BYTES CALL HOW     nothing where the compiler does not tell (gcc since 10 does)
graphs=$(find "$1" -path '*/obj/src/*' -name '*.ci' 2>/dev/null)
[ -z "$graphs" ] || awk -f tests/scripts/calls.awk $graphs | sort -rn | awk -v budget="$2" '
    { print ($1 > budget ? "over" : "ok"), $0 }'
