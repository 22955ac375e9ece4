# colours.sh: checks how vertex colours are interpreted, and the option for that.
. tests/cli/common.sh

# Vertex colours are sRGB codes, or linear light if the user sets that. In glTF they are always linear.
printf 'v -1 -1 0 .5 .5 .5\nv 1 -1 0 .5 .5 .5\nv 0 1 0 .5 .5 .5\nf 1 2 3\n' >grey.obj
for colours in srgb linear; do
    status 0 render grey.obj --size 32x24 --show albedo --vertex-colours $colours -o "$colours.pfm"
done
status 0 render grey.obj --size 32x24 --show albedo -o usual.pfm
check "colours are codes by default" cmp usual.pfm srgb.pfm
check "linear colours differ" sh -c '! cmp -s srgb.pfm linear.pfm'
status 0 info srgb.pfm
check "half a code is 0.2157 of light, as a byte" holds ' 0.215686 ' out.txt
status 0 info linear.pfm
check "and 0.501961 without decoding" holds ' 0.501961 ' out.txt
for verb in bake capture info mix pack plan play relight render 'relief bake' 'relief render'; do
    "$TOOL" $verb --help >help.txt
    check "$verb has --vertex-colours" holds '--vertex-colours srgb|linear' help.txt
done

finish
