# floors.sh: every #include "..." in src/ goes to its own room or to a floor below; include/ knows nothing of src/.
. tests/scripts/checks.sh

# Rooms with their floors. Siblings share a number and never meet; isa is a roof that nobody stands on.
floors='base 1 lane 2 raster 3 map 4 occlusion 4 light 5 voxel 5 manylights 6 bounce 6 probe 6 relief 6 mixed 6 lightcut 7 radiosity 8 compose 9 frame 10 plan 11 isa 12'
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
