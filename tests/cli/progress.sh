# progress.sh: progress lines, Ctrl-C during them, and equal bytes for any threads.
. tests/cli/common.sh

pit
floor
photo

# If stderr is no terminal, bake prints a line every ten seconds, also during a long part of a step. Two bakes start,
# stand still from half a second to nine seconds, and end a second after their first line. Their first receivers are
# one part of eight seconds of processor time. The line must come in the first half of it, but slow builds (SHORT)
# take longer for all. The bakes run in the background during the other tests.
awk 'BEGIN {
    n = 90
    for (i = 0; i <= n; ++i) for (k = 0; k <= n; ++k) print "v", i / n, (i * 7 + k * 5) % 11 / 400, k / n
    for (i = 0; i < n; ++i) for (k = 1; k <= n; ++k) { a = i * (n + 1) + k; print "f", a, a + 1, a + n + 2, a + n + 1 }
}' >field.obj
begun=$(date +%s%N)
for name in log quiet; do
    quietly= && [ $name = log ] || quietly=-q
    timeout --preserve-status -s TERM 600 sh -c 'echo $$ >$0.pid && exec "$@"' $name "$TOOL" bake field.obj --elements 1024 \
        --receivers 50000 --cluster 0.001 --threads 1 $quietly -o $name.lmt >$name-out.txt 2>$name-err.txt &
done
# passed TENTHS: checks that so many tenths of a second have passed.
passed() { [ $((($(date +%s%N) - begun) / 100000000)) -ge "$1" ]; }
{
    until passed 5 && [ -s log.pid ] && [ -s quiet.pid ]; do sleep 0.1; done
    kill -s STOP $(cat log.pid quiet.pid)
    until passed 90; do sleep 0.1; done
    kill -s CONT $(cat log.pid quiet.pid)
    until passed 98; do sleep 0.1; done
    [ ! -s log-err.txt ] || passed 100 || echo "a line before ten seconds" >early.txt
    for tenth in $(seq 600); do [ -s log-err.txt ] || sleep 0.1; done
    spent=$(awk '{ print $14 + $15 }' "/proc/$(cat log.pid)/stat" 2>/dev/null)
    [ ! -d /proc/self ] || [ -n "$SHORT" ] || [ "${spent:-1000000}" -lt $((4 * $(getconf CLK_TCK))) ] ||
        echo "after ${spent:-all its} ticks" >late.txt
    sleep 1
    kill -s TERM $(cat log.pid quiet.pid)
} &

# watched WANTED SIGNAL ARGUMENT...: runs the tool on a terminal until WANTED is on the screen, at most a minute, then
# sends the signal. If WANTED is `nothing`, waits 2 s. The screen is in screen.txt, and the status is that of the tool.
# A tool that is still running 30 s later is killed. The tool runs in the foreground, because background jobs of a shell
# ignore Ctrl-C.
watched() {
    wanted=$1 sent=$2
    shift 2
    rm -f pid screen.txt
    {
        for tenth in $(seq 600); do
            sleep 0.1
            case $wanted/$tenth in
            nothing/20) break ;;
            nothing/*) ;;
            *) ! grep -aqE "$wanted" screen.txt 2>/dev/null || break ;;
            esac
        done
        kill -s "$sent" "$(cat pid)"
        for tenth in $(seq 300); do
            kill -s 0 "$(cat pid)" 2>/dev/null && sleep 0.1 || break
        done
        kill -s KILL "$(cat pid)" 2>/dev/null
    } &
    killer=$!
    script -qefc "echo \$\$ >pid; exec \"\$TOOL\" $*" screen.txt >/dev/null 2>&1 </dev/null
    ended=$?
    wait $killer
    return $ended
}
if command -v script >/dev/null && script -qec true /dev/null >/dev/null 2>&1; then
    watched "[0-9] %" INT render demo --size 2048x2048 --quality best --threads 1 -o long.png
    check "Ctrl-C is exit status 130" test $? -eq 130
    check "progress has percent" grep -aqE 'lambent render: [a-zA-Z ]* [0-9]+ %' screen.txt
    check "Ctrl-C wipes the line" sh -c 'tail -n 2 "$1" | tr "\r" "\n" | grep -av Script | grep -a . | tail -n 1 | grep -aqv "%"' sh screen.txt
    watched "bake: [a-z ]* [0-9]+ %" TERM bake demo --threads 1 -o long.lmt
    check "TERM is exit status 143" test $? -eq 143
    check "bake tells percent" grep -aqE 'lambent bake: [a-z ]* [0-9]+ %' screen.txt
    hang_up=HUP wanted_status=129
    # Below nohup, programs ignore it.
    [ -z "$(sh -c 'kill -s HUP $$; echo ignored')" ] || hang_up=TERM wanted_status=143
    watched "frames [0-9]+ %" $hang_up play demo --size 16x16 --quality draft --frames 100000
    check "$hang_up is exit status $wanted_status" test $? -eq $wanted_status
    check "play tells percent and seconds" grep -aqE 'lambent play: frames [0-9]+ %' screen.txt
    watched nothing INT render demo --size 2048x2048 --quality best --threads 1 -q -o long.png
    check "no progress with -q" sh -c '! grep -aq "%" "$1"' sh screen.txt
    timeout --preserve-status -s INT 2 "$TOOL" render demo --size 2048x2048 --quality best --threads 1 -o long.png >out.txt 2>err.txt
    check "no progress where stderr is no terminal" lacks '%' err.txt
    watched "(s|min) left" INT play demo --size 16x16 --quality draft --threads 1 --frames 20000
    check "seconds left are told" grep -aqE 'frames [0-9]+ %, [0-9]+ (s|min) left' screen.txt
    left=$(ls -A | grep -e long -e '\.tmp$')
    check "left behind: $left" test -z "$left"
else
    skip "progress: no script(1)"
fi

status 0 relief bake pit.obj --size 16 --triangles 20 --views 6 -o pit.lmr
# any FILE ARGUMENT...: checks for the same bytes with one thread and with three.
any() {
    file=$1
    shift
    status 0 "$@" --threads 1 -o "one-$file"
    status 0 "$@" --threads 3 -o "three-$file"
    check "threads change lambent $*" cmp "one-$file" "three-$file"
}
any e.pfm capture demo --at 0.6,1.1,0.2 --faces 8 --shadow-map 128 --quality draft
any a.pfm relight --world demo --object demo --size 64x48
any b.pfm relief render pit.lmr --with floor.obj --bounce --size 64x48
any c.lmr relief bake pit.obj --size 32 --triangles 20
any d.pfm mix $seen $tent --roughness 0.2,0.5

wait
check "bake prints a line before ten seconds" none early.txt
check "bake prints a line after ten seconds $(cat late.txt 2>/dev/null)" none late.txt
check "bake has a line every ten seconds" grep -qE '^lambent bake: [a-z ]* [0-9]+ %(, [0-9]+ (s|min) left)?$' log-err.txt
check "lines of a log end as lines do" lacks "$(printf '\r')" log-err.txt
check "lines are ten seconds apart" test "$(grep -c '%' log-err.txt)" -eq 1
check "no line with -q" lacks % quiet-err.txt
check "lines are on stderr" lacks % log-out.txt

finish
