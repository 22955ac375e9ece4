# zeros.awk: prints the table of all public calls for tests/unit/test_zeros.c and tests/fuzz/fuzz_calls.c, from the
# lines of prototypes.awk. For each call it prints a function that makes the call, with pointers from `pointer` and
# other arguments from `whole`, `number` and `vector`.
BEGIN { FS = "|" }
{
    n = $3 == "void" ? 0 : split($3, parameter, ";")
    args = kinds = ""
    for (i = 1; i <= n; ++i) {
        match(parameter[i], /[a-z_][A-Za-z0-9_]*(\[[A-Za-z0-9_]*\])*$/)
        name = substr(parameter[i], RSTART)
        type = substr(parameter[i], 1, RSTART - 1)
        many = 1
        for (rest = name; match(rest, /\[[A-Za-z0-9_]*\]/); rest = substr(rest, RSTART + RLENGTH))
            many = (many == 1 ? "" : many " * ") substr(rest, RSTART + 1, RLENGTH - 2)
        is_pointer = type ~ /\*/ || name ~ /\[/
        sub(/\[.*/, "", name)
        gsub(/const |[ *]*$/, "", type)
        at = "&a[" (i - 1) "]"
        # Size 0 if unknown, or if the library makes the object; `pointer` then chooses one.
        size = many != 1 || type ~ /^lmb_/ && type != "lmb_kernels" && (type != "lmb_vec3" || many > 1) ? many " * sizeof(" type ")" : "0"
        arg = is_pointer ? "pointer(" at ", " size ")" : type == "lmb_vec3" ? "vector(" at ")" : "(" type ")" (type ~ /float|double/ ? "number(" : "whole(") at ")"
        args = args (i > 1 ? ", " : "") arg
        kinds = kinds (i > 1 ? ", " : "") "{\"" type "\", \"" name "\", " is_pointer "}"
    }
    status = $2 == "lmb_status"
    printf "static int do_%s(argument *a)\n{\n    (void)a;\n    %s%s(%s);\n%s}\n", $1, status ? "return " : "(void)", $1,
        args, status ? "" : "    return 0;\n"
    table = table sprintf("    {\"%s\", do_%s, %d, %d, {%s}},\n", $1, $1, status, n, n ? kinds : "{\"\", \"\", 0}")
}
END { printf "static const call calls[] = {\n%s};\n", table }
