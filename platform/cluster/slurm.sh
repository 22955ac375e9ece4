#!/bin/sh
# slurm.sh: computes one picture, sequence, bake or sweep as a Slurm job array, and joins it in a last job.
#
#   sh slurm.sh N render SCENE -o OUT [options]     or play, bake; bench is lambent-bench
#
# N: number of slices; Slurm runs them as machines become free. The machines must share this folder. LAMBENT: the
# command on all of them (default lambent). SBATCH: options for each job, such as "--partition=long --cpus-per-task=8".
# A slice that fails is tried three times; if its machine is lost, it runs again. The command waits for the end and
# returns the status of the merge.
set -eu
lambent=${LAMBENT:-lambent}
if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then # a slice
    count=$1
    shift
    [ "$1" != bench ] || { lambent=$lambent-bench && shift; }
    for try in 1 2 3; do
        # shellcheck disable=SC2086 # one word or none
        "$lambent" "$@" ${QUIET-} --slice "$SLURM_ARRAY_TASK_ID/$count" && exit 0
        echo "slurm.sh: slice $SLURM_ARRAY_TASK_ID/$count failed at try $try" >&2
    done
    exit 1
fi
if [ -n "${MERGE:-}" ]; then # the last job
    if [ "$3" != bench ]; then
        "$lambent" merge "$2".*of"$1" -o "$2"
        [ "$3" != bake ] || rm -rf "$2.shared"
        exit
    fi
    for end in csv json html; do
        "$lambent-bench" merge "$2".*of"$1" -o "$2.$end"
    done
    exit
fi
[ $# -ge 4 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 2; }
count=$1 out= previous= QUIET=--quiet
for word in "$@"; do
    [ "$previous" != -o ] || out=$word
    case $word in -q | --quiet | -v | --verbose) QUIET= ;; esac
    previous=$word
done
[ -n "$out" ] || { echo "slurm.sh: no -o OUT" >&2; exit 2; }
export QUIET
rm -f "$out".*of"$count"
[ "$2" != bake ] || rm -rf "$out.shared"
# shellcheck disable=SC2086 # words of SBATCH are words
array=$(sbatch --parsable --requeue --array="1-$count" ${SBATCH:-} "$0" "$@")
# shellcheck disable=SC2086
MERGE=1 sbatch --wait --dependency="afterany:${array%%;*}" ${SBATCH:-} "$0" "$count" "$out" "$2"
