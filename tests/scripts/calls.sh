# calls.sh: prints the maximum stack of each call of a build, the largest first: calls.sh BUILD BYTES
#   ok|over BYTES CALL HOW     nothing if the compiler has no call graph (gcc 10 and later has)
find "$1" -name places -prune -o -path '*/obj/src/*' -name '*.ci' -print0 2>/dev/null | xargs -0 -r awk -f tests/scripts/calls.awk | sort -rn |
    awk -v budget="$2" '{ print ($1 > budget ? "over" : "ok"), $0 }'
