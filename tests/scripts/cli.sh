# cli.sh: checks files, messages and exit statuses of the tool: cli.sh [NAME...] runs these parts of tests/cli, or all.
#
# In the environment: TOOL and B, and CC FLAGS LIB LDLIBS for help and pack.
#
# Prints a line for each part with counts and seconds, the output of a part that fails, and the sum last. JOBS=N runs N
# parts at once. SHORT=1 leaves out renders that take minutes and that other checks run; slow builds use it. Logs are
# in $B/cli/logs.
names=$(for file in tests/cli/*.sh; do
    name=${file##*/}
    [ "$name" = common.sh ] || echo "${name%.sh}"
done)
for name in "$@"; do
    case " $(echo $names) " in
    *" $name "*) ;;
    *)
        echo "cli.sh: there is no part $name of these:" $names >&2
        exit 2
        ;;
    esac
done
[ $# -gt 0 ] || set -- $names

# Each worker takes the next free part. mkdir succeeds for only one worker, so it claims the part.
LOGS=$B/cli/logs
rm -rf "$LOGS"
mkdir -p "$LOGS/taken"
worker() {
    for name in "$@"; do
        if mkdir "$LOGS/taken/$name" 2>/dev/null; then
            LOGS=$LOGS NEEDS= sh tests/scripts/part.sh "$name" sh "tests/cli/$name.sh"
        fi
    done
}
# A command in the background ignores SIGINT, and so do its children. `progress` sends it, so it runs here, and first.
first= behind=
for name in "$@"; do
    [ "$name" = progress ] && first=progress || behind="$behind $name"
done
workers=1
while [ "$workers" -lt "${JOBS:-1}" ]; do
    worker $behind &
    workers=$((workers + 1))
done
worker $first $behind
wait

logs=$LOGS
for name in "$@"; do
    shift
    set -- "$@" "$logs/$name.log"
done
sh tests/scripts/sum.sh "$@"
