#!/bin/sh
# parallel.sh: computes one picture, sequence, bake or sweep on many machines, with GNU parallel over ssh.
#
#   sh parallel.sh N HOSTS render SCENE -o OUT [options]     or play, bake; bench is lambent-bench
#
# N: number of slices; choose two or more a machine, so that fast machines do more. HOSTS: as for parallel's --sshlogin:
# host1,host2; `:` is this machine, and 2/host1 runs two at once. LAMBENT: the command on all machines (default
# lambent). SEND: files to copy to the machines first, by relative names: the scene and its neighbours. If you leave
# SEND out, the machines must share this folder at the same path. Slices of a bake must share the folder to save any
# work. A slice that fails is tried three times, if possible on other machines; existing slices are computed again.
set -eu
[ $# -ge 5 ] || { sed -n '2,11s/^# \{0,1\}//p' "$0"; exit 2; }
count=$1 hosts=$2
shift 2
out= previous= quiet=--quiet
for word in "$@"; do
    [ "$previous" != -o ] || out=$word
    case $word in -q | --quiet | -v | --verbose) quiet= ;; esac
    previous=$word
done
[ -n "$out" ] || { echo "parallel.sh: no -o OUT" >&2; exit 2; }
lambent=${LAMBENT:-lambent} is_bench=0
if [ "$1" = bench ]; then
    lambent=$lambent-bench is_bench=1
    shift
fi
there="--workdir $PWD"
[ -z "${SEND:-}" ] || there="--workdir ... --cleanup --return $out.{}of$count"
for file in ${SEND:-}; do
    there="$there --basefile $file"
done
rm -f "$out".*of"$count"
[ "$1" != bake ] || rm -rf "$out.shared"
# shellcheck disable=SC2086 # words of `there` are words, and quiet is one or none
seq "$count" | parallel --quote --sshlogin "$hosts" --retries 3 $there "$lambent" "$@" $quiet --slice "{}/$count" || true
if [ "$is_bench" = 0 ]; then
    "$lambent" merge "$out".*of"$count" -o "$out"
    [ "$1" != bake ] || rm -rf "$out.shared"
    exit
fi
for end in csv json html; do
    "$lambent" merge "$out".*of"$count" -o "$out.$end"
done
