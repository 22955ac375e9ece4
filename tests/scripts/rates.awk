# rates.awk: counts words in comments and documents, and prints each rate per 1,000 words that misses the limit:
#   awk -f tests/scripts/rates.awk LIST      LIST: names of files, one a line
#
# Reads the comments of .c, .h and .inl; the # comments of shell scripts, .mk, Makefile and .ci, and the faults in
# .ci/jobs; and .md without code blocks. After a rate it prints five files: those with the highest counts or, if the
# rate is too low, those that need most more. Only include/ and .md count for `you`, because they address readers.
function count(text, file,    i, n, word) {
    n = split(tolower(text), word, /[^a-z']+/)
    for (i = 1; i <= n; ++i)
        if (word[i] != "") {
            ++words; ++words_of[file]
            if (word[i] in used) { ++used[word[i]]; ++used_of[word[i], file] }
            if (reader) { ++reader_words; ++reader_words_of[file]; if (word[i] == "you") ++reader_you }
        }
}

function read_c(file,    line, at) {
    inside = 0
    while ((getline line < file) > 0) {
        if (!inside && line !~ /\/[*\/]/) continue
        if (!inside && line ~ /"/) gsub(/"([^"\\]|\\.)*"/, "", line)
        while (line != "") {
            if (inside) {
                at = index(line, "*/")
                count(at ? substr(line, 1, at - 1) : line, file)
                if (!at) break
                inside = 0
                line = substr(line, at + 2)
            } else if (match(line, /\/[*\/]/)) {
                inside = substr(line, RSTART, 2) == "/*"
                line = substr(line, RSTART + 2)
                if (!inside) { count(line, file); break }
            } else break
        }
    }
}

function read_script(file,    line, part) {
    while ((getline line < file) > 0) {
        if (line ~ /^[ \t]*#/) { if (line !~ /^#!/) count(line, file) }
        else if (match(line, / ##? /)) count(substr(line, RSTART + RLENGTH), file)
        else if (file ~ /\/jobs$/ && split(line, part, "|") > 4) count(part[5], file)
    }
}

function read_document(file,    line, code) {
    while ((getline line < file) > 0) {
        if (line ~ /^ *```/) { code = !code; continue }
        if (!code) count(line, file)
    }
}

# worst WORD LIMIT: five files with counts: with the highest counts or, if LIMIT is not 0, furthest below LIMIT.
function worst(word, limit,    file, k, best, at, found, text, done) {
    for (k = 1; k <= 5; ++k) {
        best = found = ""
        for (file in words_of) {
            if (file in done || word == "you" && !(file in reader_words_of)) continue
            at = limit ? limit * words_of[file] / 1000 - used_of[word, file] : used_of[word, file] + 0
            if (found == "" && (at > 0 || limit) || found != "" && at > best) { best = at; found = file }
        }
        if (found == "") break
        done[found] = 1
        text = text (k > 1 ? ", " : "") found " " used_of[word, found] + 0
    }
    return text
}

function rate(word) {
    if (word == "you") return reader_words ? 1000 * reader_you / reader_words : 0
    return words ? 1000 * used[word] / words : 0
}

function most(word, limit) {
    if (rate(word) >= limit) printf "%s %.2f, must be under %s: %s\n", word, rate(word), limit, worst(word, 0)
}

function least(word, limit) {
    if (rate(word) <= limit) printf "%s %.2f, must be over %s: %s\n", word, rate(word), limit, worst(word, limit)
}

BEGIN {
    split("what alone its if where you", list, " ")
    for (i in list) used[list[i]] = 0
    while ((getline file < ARGV[1]) > 0) {
        reader = file ~ /^include\// || file ~ /\.md$/
        if (file ~ /\.(c|h|inl)$/) read_c(file)
        else if (file ~ /\.md$/) read_document(file)
        else read_script(file)
        close(file)
    }
    most("what", 3)
    most("alone", 0.1)
    most("its", 4)
    least("if", 3)
    if (used["where"] >= used["if"])
        printf "where %.2f, must be under if, %.2f: %s\n", rate("where"), rate("if"), worst("where", 0)
    least("you", 1.5)
}
