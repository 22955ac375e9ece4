# cov.sh: prints the lines and branches of src/ or tools/ that the checks run: cov.sh FOLDER src|tools, as `make cov`
# built it.
#
# Threads count with atomic additions. Otherwise counts get lost, and gcov, which computes some counts from others,
# reports wrong or negative ones.
#
# A line counts as run if any copy of it ran (kernels are compiled for each backend; backends that this processor lacks
# are left out). gcov reads one object at a time: with several it may print that a line did not run although a copy
# did. Each branch counts twice, once for each way. Lines that did not run are in FOLDER/uncovered. Limits for src/:
# 98 % of lines, 92 % of branches, and a reason in uncovered.txt for each line that did not run. For tools/: 85 % of
# lines. `make faults` provokes failed allocations and writes, but does not count here.
folder=$1
tree=$2
b=$folder/default
case $tree in
src | tools) ;;
*)
    echo "cov.sh: COV is src or tools, not $tree" >&2
    exit 2
    ;;
esac
find "$folder" -name '*.gcda' -exec rm -f {} +
case $tree in
src)
    lines=98 branches=92
    LMB_LONG=1 "$b/tests" unit slow analytic lanes # truth adds nothing, and takes minutes
    "$b/golden"
    "$b/golden-orders"
    "$b/reference" hard
    "$b/hard"
    "$b/replay" tests/fuzz/corpus/*/*
    sh tests/scripts/hostile.sh "$b/hostile" 5 40
    ;;
tools)
    lines=85 branches=0
    "$b/tests" unit slow
    "$b/replay" tests/fuzz/corpus/*/*
    B=$b LIB=$b/liblambent.a TOOL=$folder/lambent CC=$CC FLAGS=$FLAGS LDLIBS=$LDLIBS sh tests/scripts/cli.sh
    B=$b TOOL=$folder/lambent sh tests/scripts/hostile_cli.sh
    ;;
esac >"$folder/run.log" 2>&1

find "$b/obj/$tree" -name '*.gcda' | grep -v -e neon -e simd128 | sed 's/gcda$/o/' >"$folder/objects"
rm -f "$folder/uncovered"
reasons=tests/scripts/uncovered.txt
xargs -n 1 gcov -b -c -t <"$folder/objects" 2>/dev/null | awk -v out="$folder/uncovered" -v reasons="$reasons" \
    -v tree="$tree" -v least_lines=$lines -v least_branches=$branches '
    # FILE | part of the line | reason; each for one line.
    function read_reasons(    row, part) {
        while ((getline row < reasons) > 0) {
            if (row ~ /^#/ || split(row, part, / *[|] */) < 3) continue
            ++rows; at_file[rows] = part[1]; at_text[rows] = part[2]; why[rows] = part[3]
        }
    }
    function reason_of(file, text,    i) {
        for (i = 1; i <= rows; ++i)
            if (!told[i] && at_file[i] == file && index(text, at_text[i]) > 0) return told[i] = 1
        return 0
    }
    /^ *-: *0:Source:/ {
        file = $0
        sub(/.*Source:/, "", file)
        sub(".*/" tree "/", tree "/", file)
        mine = index(file, tree "/") == 1
        next
    }
    !mine { next }
    /^ *[^ ]+: *[0-9]+:/ {
        split($0, part, ":")
        count = part[1] + 0; line = part[2] + 0; way = 0
        if (part[1] !~ /-$/ && line > 0) {
            key = file ":" line
            there[key] = 1; text[key] = substr($0, index($0, part[2] ":") + length(part[2]) + 1)
            if (part[1] !~ /#|=/) run[key] = 1
        }
        next
    }
    /^branch/ {
        k = file ":" line ":" way++
        branch[k] = 1
        if ($0 ~ /taken [1-9]/) taken[k] = 1
    }
    END {
        for (k in there) {
            split(k, p, ":"); ++lines[p[1]]; ++all
            if (k in run) { ++hit[p[1]]; ++seen } else print k ":" text[k] | "sort -t: -k1,1 -k2,2n >" out
        }
        for (k in branch) { split(k, p, ":"); ++ways[p[1]]; ++all_ways; if (k in taken) { ++went[p[1]]; ++seen_ways } }
        for (f in lines)
            printf "%-28s lines %4d of %4d, %5.1f %%   branches %4d of %4d, %5.1f %%\n", f, hit[f], lines[f],
                100 * hit[f] / lines[f], went[f], ways[f], ways[f] ? 100 * went[f] / ways[f] : 100 | "sort -t, -k2 -n"
        close("sort -t, -k2 -n")
        if (tree == "src") {
            read_reasons()
            for (k in there) {
                split(k, p, ":")
                if (!(k in run) && !reason_of(p[1], text[k])) { print "no reason: " k ":" text[k]; ++open }
            }
        }
        for (i = 1; i <= rows; ++i)
            print at_file[i] ": " at_text[i] ": " why[i] (told[i] ? "" : " (here it was run)")
        line_share = all ? 100 * seen / all : 0
        way_share = all_ways ? 100 * seen_ways / all_ways : 0
        printf "%s/: lines %d of %d, %.2f %%; branches %d of %d, %.2f %%\n", tree, seen, all, line_share,
            seen_ways, all_ways, way_share
        passed = (line_share >= least_lines) + (way_share >= least_branches) + !open
        printf "%d passed, %d failed, 0 skipped\n", passed, 3 - passed
        exit passed < 3
    }'
