# contracts.sh: checks that each public call has a description in the header with the statuses that it returns, that
# types.h defines these statuses, that each header states its stability, that other modules use each call, and that the
# README lists the stable headers. B in the environment.
. tests/scripts/checks.sh

dir=$B/contracts
mkdir -p "$dir"
for header in include/lambent/*.h; do
    awk -f tests/scripts/prototypes.awk "$header" | sed "s/^/$(basename "$header")|/"
done >"$dir/calls"
awk -f tests/scripts/contracts.awk "$dir/calls" include/lambent/*.h >"$dir/contracts"
check "few calls were found" test "$(grep -c '|lmb_' "$dir/contracts")" -ge 200

# A word of comments that is not declared in the headers.
grep '^unknown ' "$dir/contracts" >"$dir/unknown"
while read -r _ header name; do
    fail "$header: a comment names $name, which is in no header"
done <"$dir/unknown"
[ -s "$dir/unknown" ] || pass

# Statuses that a header names and types.h does not define.
sed -nE 's/^ +(LMB_ERR_[A-Z]+) = -[0-9].*/\1/p' include/lambent/types.h >"$dir/statuses"
grep -noE '\bLMB_ERR_[A-Z0-9_]+' include/lambent/*.h | grep -vwFf "$dir/statuses" >"$dir/unknown"
check "statuses that types.h does not define: $(tr '\n' ' ' <"$dir/unknown")" test ! -s "$dir/unknown"

# Uses of each call: a line "NAME FILE" for each file that names it.
grep -rhoHE '\blmb_[a-z0-9_]+' src tools platform tests --include='*.[ch]' --include='*.cpp' --include='*.inl' | sort -u |
    awk -F: '$1 !~ /^tests\/(unit|fuzz)\// { sub(/\/[^\/]*$/, "/", $1); print $2, $1 }' | sort -u >"$dir/uses"
grep -nE '^[a-z].*\blmb_[a-z0-9_]+\(' -r src --include='*.c' --include='*.inl' |
    sed -nE 's#^(src/[a-z]+/)[^:]*:[0-9]*:[^(]*\b(lmb_[a-z0-9_]+)\(.*#\2 \1#p' | sort -u >"$dir/homes"
awk 'FNR == NR { home[$1] = home[$1] " " $2 " "; next }
    index(home[$1], " " $2 " ") == 0 { used[$1] = 1 }
    END { for (name in used) print name }' "$dir/homes" "$dir/uses" | sort >"$dir/used"

while IFS='|' read -r header stability name returns statuses words; do
    case $header in unknown*) continue ;; esac
    wrong=
    case $stability in stable | experimental) ;; *) wrong="its header says no stability" ;; esac
    [ -n "$words" ] || wrong="no comment of $header describes it, as \"$name: ...\""
    [ "$returns" != lmb_status ] || [ -n "$statuses" ] || wrong="its comment says no status that it returns"
    grep -qx "$name" "$dir/used" || wrong="nothing outside its module uses it"
    if [ -n "$wrong" ]; then fail "$name: $wrong"; else pass; fi
done <"$dir/contracts"

# The lists in the README.
for stability in stable experimental; do
    cut -d'|' -f1,2 "$dir/contracts" | sed -n "s/|$stability\$//p" | sort -u >"$dir/$stability"
    sed -nE "s/^\*\*($stability)\*\*: (.*)/\2/Ip" include/README.md | grep -oE '[a-z_]+\.h' | sort -u |
        cmp -s - "$dir/$stability"
    check "include/README.md: its list of $stability headers is $(tr '\n' ' ' <"$dir/$stability")" test $? -eq 0
done
finish
