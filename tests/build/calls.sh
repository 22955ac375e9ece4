# calls.sh: the stack that each of a build's calls takes at most, the hungriest first: calls.sh BUILD BYTES
#   ok|over BYTES CALL HOW     nothing where the compiler does not tell (gcc since 10 does)
#
# lmb_render_* hold a room's call within their own, lmb_relief_* sixteen pixels' way by AVX-512 (4.4 KiB; 2.9 by AVX2): they
# may take a KiB more.
graphs=$(find "$1" -path '*/obj/src/*' -name '*.ci' 2>/dev/null)
[ -z "$graphs" ] || awk -f tests/build/calls.awk $graphs | sort -rn | awk -v budget="$2" '
    { print ($1 > budget + ($2 ~ /^lmb_re(nder|lief)_/ ? 1024 : 0) ? "over" : "ok"), $0 }'
