# words.sh: checks that src, include, tools, platform and documents have no name, option, file or phrase of words.txt;
# that links of documents exist; that files and names in src/EXACT.md and src/RECIPES.md exist; the sizes of README.md and
# src/README.md; the rates of some words (rates.awk); and that it finds a made-up fault of each kind.
#
# words.txt has one entry a line: `name WORD` (a whole identifier), `code WORD` (the same, but not in comments and
# strings, because it is also an English word), `option --WORD`, `file BASENAME`, `phrase WORDS` (exact, in comments and
# documents, across line breaks).
dir=${0%/*}
. "$dir/checks.sh"
list=${LIST:-$dir/words.txt}
tmp=${B:-build/default}/words
rm -rf "$tmp"
mkdir -p "$tmp"

for kind in name code option file phrase; do
    sed -n "s/^$kind //p" "$list" > "$tmp/$kind"
    [ "$kind" != code ] || mv "$tmp/code" "$tmp/code-name"
    [ "$kind" = code ] || [ -s "$tmp/$kind" ] || fail "$list has no line of $kind"
done
find src include tools platform -type f \( -name '*.[ch]' -o -name '*.inl' -o -name '*.inc' \) | sort > "$tmp/code"
built=${tmp%/*/*}
find . -name '*.md' ! -path './build/*' ! -path "./${built#"$PWD"/}/*" ! -path './.git/*' | sed 's,^\./,,' | sort > "$tmp/documents"

# texts LIST PROGRAM: writes the text of all files in LIST to one file, with an awk program that prints lines, and the
# source of each line to `where`. One process per file would take minutes.
texts() {
    : > "$tmp/where"
    tr '\n' '\0' < "$1" | xargs -0 awk -v where="$tmp/where" "$2" > "$tmp/text"
}
# found KIND PATTERNS OPTION...: lines of the text that match one of the patterns, with their sources.
found() {
    kind=$1 patterns=$2
    shift 2
    grep -n "$@" -F -e NOTHING-LIKE-THIS -f "$patterns" "$tmp/text" |
        awk -v where="$tmp/where" '
            { at = $0 + 0; sub(/^[0-9]*:/, "") }
            { while (line < at && (getline place < where) > 0) ++line; print place ":" $0 }' >> "$tmp/found-$kind"
}
cat "$tmp/code" "$tmp/documents" > "$tmp/all"
texts "$tmp/all" '{ print; print FILENAME ":" FNR > where }'
found name "$tmp/name" -w
found option "$tmp/option" -w
# One line per file, without comment marks, so that a phrase is found across line breaks.
: > "$tmp/lines"
awk -v where="$tmp/where" -v lines="$tmp/lines" '
    { getline place < where; sub(/:[0-9]*$/, "", place) }
    place != file { if (NR > 1) print ""; file = place; print file > lines }
    { sub(/^ *(\/\*|\*|\/\/) /, ""); sub(/^ */, ""); gsub(/ +/, " "); printf "%s ", $0 }
    END { print "" }' "$tmp/text" > "$tmp/line"
mv "$tmp/line" "$tmp/text"
mv "$tmp/lines" "$tmp/where"
found phrase "$tmp/phrase" -o
texts "$tmp/code" "FNR == 1 { inside = 0 }
    $(cat "$dir/bare_code.awk")
    { print FILENAME \":\" FNR > where }"
found code "$tmp/code-name" -w

cat "$tmp/code" "$tmp/documents" | sed 's,.*/,,' | grep -xF -f "$tmp/file" > "$tmp/found-file"
for kind in name code option file phrase; do
    if [ -s "$tmp/found-$kind" ]; then
        fail "words that words.txt lists, by $kind: $(wc -l < "$tmp/found-$kind")"
        head -n 20 "$tmp/found-$kind"
    else
        pass
    fi
done

# Relative links of documents.
while read -r f; do
    grep -oE '\]\([^)#: ]+(#[^)]*)?\)' "$f" | sed -e 's,^](,,' -e 's,[#)].*,,' | sort -u | while read -r to; do
        case $f in */*) from=${f%/*}/ ;; *) from= ;; esac
        [ -e "$from$to" ] || echo "$f: $to"
    done
done < "$tmp/documents" > "$tmp/links"
check "links of documents exist: $(tr '\n' ' ' < "$tmp/links")" test ! -s "$tmp/links"

# Files and names of the code in EXACT.md and RECIPES.md. A path is relative to the root or to src/; NAME is a
# placeholder.
find src include tools platform tests Makefile -type f \( -name '*.[ch]' -o -name '*.inl' -o -name '*.sh' -o -name Makefile \) \
    2>/dev/null > "$tmp/sources"
for f in src/EXACT.md src/RECIPES.md; do
    [ -f "$f" ] || continue
    grep -oE '`[A-Za-z0-9_./]+`' "$f" | tr -d '`' | grep -v NAME | sort -u > "$tmp/mentioned"
    grep / "$tmp/mentioned" | while read -r path; do
        [ -e "$path" ] || [ -e "src/$path" ] || echo "$f: $path"
    done
    grep -E '^[A-Za-z0-9]*_[A-Za-z0-9_]*$' "$tmp/mentioned" > "$tmp/mentioned-names"
    tr '\n' '\0' < "$tmp/sources" | xargs -0 grep -ohwFf "$tmp/mentioned-names" | sort -u > "$tmp/found-names"
    comm -23 "$tmp/mentioned-names" "$tmp/found-names" | sed "s,^,$f: ,"
done > "$tmp/stale"
check "files and names in EXACT.md and RECIPES.md exist: $(tr '\n' ' ' < "$tmp/stale")" test ! -s "$tmp/stale"

# README.md: 150 lines, and 60 numbers outside code.
lines=$(wc -l < README.md)
numbers=$(awk '/^```/ { code = !code } !code' README.md | sed 's/`[^`]*`//g; s/([^)]*)//g' \
    | grep -oE '(^|[^A-Za-z0-9_.-])[0-9][0-9.,]*' | wc -l)
if [ "$lines" -le 150 ] && [ "$numbers" -le 60 ]; then
    pass
elif [ "${README_BOUNDS:-1}" = 0 ]; then
    skip "README.md has $lines lines and $numbers numbers; 150 and 60 are its bounds"
else
    fail "README.md has $lines lines and $numbers numbers; 150 and 60 are its bounds"
fi

words=$(cat src/README.md 2>/dev/null | wc -w)
check "src/README.md has $words words; the plan is one page, 1200" test "$words" -le 1200

# Lines of src/, include/ and tools/ have at most 120 characters; tables that programs write are left out.
find src include tools -type f \( -name '*.[ch]' -o -name '*.inl' \) -exec env LC_ALL=C awk '
    { gsub(/[\200-\277]/, "") }
    length > 120 { print FILENAME ":" FNR }' {} + >"$tmp/long"
check "lines over 120 characters: $(head -n 5 "$tmp/long" | tr '\n' ' ')" test ! -s "$tmp/long"

# The rest is left out for the made-up tree.
[ -z "$MADE" ] || finish

# The rates of some words in all comments and documents.
find . -type f \( -name '*.[ch]' -o -name '*.inl' -o -name '*.md' -o -name '*.sh' -o -name '*.mk' -o -name Makefile \
    -o -path './.ci/*' \) ! -path './build/*' ! -path "./${built#"$PWD"/}/*" ! -path './.git/*' |
    sed 's,^\./,,' | sort >"$tmp/texts"
rates() { awk -f "$dir/rates.awk" "$1" 2>&1; }
wrong=$(rates "$tmp/texts")
check "words per 1,000 in comments and documents: $wrong" test -z "$wrong"

# repeat N WORD: writes the word N times.
repeat() { awk -v n="$1" -v word="$2" 'BEGIN { while (n-- > 0) print word }'; }

# made_rates WHAT ALONE ITS IF WHERE YOU: rates of a made-up document of 20,000 words with so many of each word.
made_rates() {
    repeat $((20000 - $1 - $2 - $3 - $4 - $5 - $6)) filler >"$tmp/rates.md"
    for word in what alone its if where you; do
        repeat "$1" $word >>"$tmp/rates.md"
        shift
    done
    echo "$tmp/rates.md" >"$tmp/rates"
    rates "$tmp/rates"
}
# made_limit WORD COUNT...: checks that made_rates COUNT... reports only this word.
made_limit() {
    limited=$1
    shift
    wrong=$(made_rates "$@")
    case $wrong in
    "$limited "*"rates.md "[0-9]*)
        check "a made-up text misses other limits than $limited: $wrong" test "$(echo "$wrong" | wc -l)" -eq 1
        ;;
    *) fail "a made-up text that misses the limit of $limited is not found: $wrong" ;;
    esac
}
wrong=$(made_rates 59 1 79 61 60 31)
check "a made-up text within all limits is refused: $wrong" test -z "$wrong"
made_limit what 60 1 79 61 60 31
made_limit alone 59 2 79 61 60 31
made_limit its 59 1 80 61 60 31
made_limit if 59 1 79 60 59 31
made_limit where 59 1 79 61 61 31
made_limit you 59 1 79 61 60 30

# Checks that it finds a leftover of each kind, in a made-up tree that has one of each.
made=$tmp/made
mkdir -p "$made/src" "$made/include" "$made/tools" "$made/platform"
here=$(pwd)
case $list in /*) ;; *) list=$here/$list ;; esac
case $dir in /*) ;; *) dir=$here/$dir ;; esac

made_words() (cd "$made" && MADE=1 B=out LIST="$list" sh "$dir/words.sh")

# leftover FILE TEXT: writes the text to a file of the made-up tree.
leftover() {
    mkdir -p "$made/${1%/*}"
    printf '%s\n' "$2" > "$made/$1"
}

printf 'See [the code](src).\n' > "$made/README.md"
check "a made-up tree without leftovers is refused" made_words
leftover src/one.c 'int x = lmb_light_map_bytes;'
leftover src/two.c 'int shine; /* a word of English in comments */'
leftover tools/one.c 'puts("--light-map");'
leftover src/gloss.c 'int x;'
leftover src/three.c '/* what a surface gives
 * off by itself */'
leftover docs/one.md 'See [nothing](nowhere.md).'
leftover src/EXACT.md 'See `one.c`, `src/one.c`, `base/gone.c`, `lmb_gone`, `isa/isa_NAME.c`.'
leftover tools/long.c "/* $(awk 'BEGIN { while (n++ < 115) printf "x" }') */"
leftover tools/full.c "/* $(awk 'BEGIN { while (n++ < 114) printf "x" }') */"
found=$(made_words)
for kind in name code option file phrase; do
    case $found in
    *"by $kind: 1"*) pass ;;
    *) fail "a made-up leftover by $kind is not found once: $found" ;;
    esac
done
case $found in
*"lines over 120 characters: tools/long.c:1 "*) pass ;;
*) fail "a made-up long line is not found once: $found" ;;
esac
case $found in
*"links of documents exist: docs/one.md: nowhere.md"*) pass ;;
*) fail "a made-up dead link is not found: $found" ;;
esac
case $found in
*"EXACT.md and RECIPES.md exist: src/EXACT.md: base/gone.c src/EXACT.md: lmb_gone "*) pass ;;
*) fail "a made-up stale file and name are not found once each: $found" ;;
esac
finish
