# paths.sh: play: paths and patterns that are refused; the message names the line.
. tests/cli/common.sh

box
block
printf '%s\n' "0 light 0.2,0.5,0" "0 camera -0.8,0.6,-0.8 0.3,-0.6,0.3" "1 light 0.3,0.5,0.1" "1 camera -0.7,0.6,-0.8 0.2,-0.6,0.3" >keys.txt
status 0 bake box.obj -o box.lmt --elements 64 --receivers 64

line() { # line NUMBER TEXT KEYS: checks that the path file is refused at this line
    printf "$3" >bad.txt
    status 1 play block.obj $inside --path bad.txt --frames 2 -o bad%02d.pfm
    said "bad.txt: line $1: $2"
}
long=$(printf '%0200d' 0)
line 1 "begins with no time" 'camera 0,0,0\n'
line 1 "begins with no time" '\000\001\002'
line 2 "begins with no time" '0 light 0,0,0\n-1 light 0,0,0\n'
line 1 "begins with no time" 'nan light 0,0,0\n'
line 1 "begins with no time" '1e7 light 0,0,0\n'
line 3 "a time alone" '# none\n\n0\n'
line 1 "\`lamp\` moves nothing" '0 lamp 0,0,0\n'
line 1 "\`object\`: write camera, light, light:N or object:N" '0 object 0,0,0\n'
line 1 "\`camera:0\`: write" '0 camera:0 0,0,0\n'
line 1 "\`light:-1\`: write" '0 light:-1 0,0,0\n'
line 1 "\`light:\`: write" '0 light: 0,0,0\n'
line 1 "no position" '0 light\n'
line 1 "\`0,0\` is not X,Y,Z" '0 light 0,0\n'
line 1 "\`0,0,2e6\` is not X,Y,Z within 1,000,000 m" '0 light 0,0,2e6\n'
line 1 "\`nan,0,0\` is not" '0 light nan,0,0\n'
line 1 "more than TIME WHAT" '0 light 0,0,0 1,1,1 2\n'
line 1 "position and target are the same" '0 light 0,0,0 0,0,0\n'
line 2 "not later than the key before it" '1 light 0,0,0\n1 light 0,0,1\n'
line 1 "no light:1; the scene has 1, numbered from 0" '0 light:1 0,0,0\n'
line 1 "no object:7; the scene has" '0 object:7 0,0,0\n'
line 1 "\`00000000" "0 light 0$long,0,0\\n"
line 1 "\`1,1,100000000" "0 camera 0,0,0 1,1,1$long\\n"
awk 'BEGIN { for (i = 0; i < 10001; ++i) print i, "camera 0,0,0" }' >bad.txt
status 1 play block.obj $inside --path bad.txt --frames 2
said "bad.txt: line 10001: over 10000 keys"
awk 'BEGIN { for (i = 0; i < 70; ++i) print "0 light:" i, "0,0,0" }' >bad.txt
status 1 play block.obj $inside --path bad.txt --frames 2
said "bad.txt: line 65: over 64 things that move"
printf '# nothing\n' >bad.txt
status 1 play block.obj $inside --path bad.txt --frames 2
said "bad.txt: no keys in it"
status 1 play block.obj $inside --path keys.txt --move object --frames 2
said "keys.txt: nothing in it that --move lets move"
printf '0 camera 0,0,0 0,1,0\n' >bad.txt
status 1 play block.obj $inside --path bad.txt --frames 2
said "at frame 0 the camera looks along what is up"
status 1 play block.obj $inside --path nowhere.txt --frames 2
status 1 play nowhere.obj --frames 2
status 1 play block.obj $inside --frames 2 -o nowhere/bad%02d.pfm
status 1 play block.obj $inside --frames 2 --transfer box.lmt -o bad%02d.pfm
said "box.lmt: baked from another scene than"
status 2 play
status 1 play block.obj --move object
said "nothing in block.obj moves objects; give --path FILE"
for pattern in bad.png bad%d.png bad%4d.png bad%00d.png bad%s.png bad%04d%04d.png bad%04d%%.png bad%04d bad%04d.gif bad%010d.png bad%04n.png; do
    status 2 play block.obj -o "$pattern"
done
for option in "--frames 0" "--frames 1e3" "--from -1" "--fps 0" "--check 0" "--move lamp" "--show depth" "--stereo 0.1"; do
    status 2 play block.obj $option
done
status 2 play block.obj --check 1 --show direct
check "nothing bad was played" none bad*.p*
status 0 play --help
check "play --help has under 100 columns" awk 'length($0) > 99 { exit 1 }' out.txt
status 0 play -V

finish
