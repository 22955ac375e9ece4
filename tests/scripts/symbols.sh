# symbols.sh: checks the functions that the library calls and exports, and that it has no writable data: CC NM LIB in
# the environment.
. tests/scripts/checks.sh

allowed='^(memcpy|memset|memmove|memcmp|sqrtf|floorf|__.*|_GLOBAL_OFFSET_TABLE_)$'
symbols=$(${NM:-nm} -f sysv "$LIB" | awk -F '|' 'NF >= 7 { gsub(/ /, ""); print $3, $1, $7 }')

defined=$(printf '%s\n' "$symbols" | awk '$1 ~ /[A-TV-Z]/ { print $2 }' | sort -u)
called=$(printf '%s\n' "$symbols" | awk '$1 == "U" { print $2 }' | sort -u)

for name in $called; do
    case "
$defined
" in
    *"
$name
"*) ;;
    *) if printf '%s\n' "$name" | grep -qE "$allowed"; then pass; else fail "src/ calls $name"; fi ;;
    esac
done

for name in $defined; do
    case $name in
    lmb_* | __*) pass ;;
    *) fail "$name is exported without lmb_" ;;
    esac
done

# Constants that contain addresses (.data.rel.ro) are read-only after loading.
writable=$(printf '%s\n' "$symbols" | awk '$1 ~ /[BbCDd]/ && $3 !~ /^\.data\.rel\.ro/ { print $2 }')
for name in $writable; do
    fail "$name is data that changes"
done
[ -n "$writable" ] || pass
finish
