# floors.sh: every #include "..." in src/ goes to its own room or to a floor below; include/ knows nothing of src/.
. tests/build/checks.sh

# Rooms with their floors. Siblings share a number and never meet; isa is a roof that nobody stands on.
floors='base 1 lane 2 raster 3 map 4 occlusion 4 light 5 voxel 5 bounce 6 probe 6 relief 6 mixed 6 compose 7 plan 8 isa 9'

# FILE:LINE:#include "TARGET" -> FILE:LINE TARGET
includes=$(grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' src include/lambent |
    sed -E 's/^([^:]+):([0-9]+):[^"]*"([^"]*)".*/\1 \2 \3/')

wrong=$(printf '%s\n' "$includes" | awk -v floors="$floors" '
    function room(path, part) { split(path, part, "/"); return part[2] }
    # dir/../x -> x, one step at a time
    function clean(path) { while (sub(/[^\/.]+\/\.\.\//, "", path)) ; return path }
    function folder(path) { sub(/\/[^\/]*$/, "", path); return path }
    BEGIN { n = split(floors, word, " "); for (i = 1; i < n; i += 2) floor[word[i]] = word[i + 1] + 0 }
    {
        to = clean(folder($1) "/" $3); from = room($1); into = room(to); where = $1 ":" $2 ": "
        if ($1 ~ /^include\//) { if (to !~ /^include\/lambent\/[^\/]*$/) print where "a public header includes " $3 }
        else if (to !~ /^src\//) print where "\"" $3 "\" leaves src/; public headers are <lambent/...>"
        else if (!(from in floor)) print where "room " from " has no floor"
        else if (!(into in floor)) print where "room " into " has no floor"
        else if (from != into && floor[into] >= floor[from])
            print where from " (floor " floor[from] ") includes " $3 " (floor " floor[into] ")"
    }')

# Each include, and each room's name, is one check.
count=$(printf '%s\n' "$includes" | grep -c .)
[ -z "$wrong" ] || printf '%s\n' "$wrong" | sed 's/^/FAIL /'
failed=$(printf '%s' "$wrong" | grep -c .)
passed=$((count - failed))

for folder in src/*/; do
    room=$(basename "$folder")
    case " $floors " in
    *" $room "[0-9]*) pass ;;
    *) fail "$folder: the house has no such room" ;;
    esac
done
finish
