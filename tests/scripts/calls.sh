# calls.sh: prints the maximum stack of each call of a build, the largest first: calls.sh BUILD BYTES
#   ok|over BYTES CALL HOW     nothing if the compiler has no call graph (gcc 10 and later has)
graphs=$(find "$1" -path '*/obj/src/*' -name '*.ci' 2>/dev/null)
[ -z "$graphs" ] || awk -f tests/scripts/calls.awk $graphs | sort -rn | awk -v budget="$2" '
    { print ($1 > budget ? "over" : "ok"), $0 }'
