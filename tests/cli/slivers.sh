# slivers.sh: bake: checks that slivers and buried corners do not take elements and light from other surfaces.
. tests/cli/common.sh

box

# Long slivers: narrow strips over a floor, with splinters beside them as in real meshes.
strips() { # strips STRIPS SPLINTERS ELEMENTS: how many elements they get, in `elements`.
    awk -v strips=$1 -v splinters=$2 'BEGIN {
        print "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\nf -4 -3 -2 -1"
        for (i = 0; i < strips; ++i) {
            z = -1.9 + 3.8 * i / strips
            printf "v -1.5 0.5 %.5f\nv 1.5 0.5 %.5f\nv 1.5 0.5 %.5f\nv -1.5 0.5 %.5f\nf -4 -3 -2 -1\n", z + 0.002, z + 0.002, z, z
        }
        for (i = 0; i < splinters; ++i) {
            x = -1.95 + 0.0003 * i
            printf "v %.5f 1 1.9\nv %.5f 1 1.9\nv %.5f 1 1.86\nf -3 -2 -1\n", x, x + 0.0002, x
        }
    }' >strips.obj
    status 0 bake strips.obj -o strips.lmt --elements $3 --cluster 5 --division 1 --error 1 --once
    elements=$(sed -n 's/.*: \([0-9]*\) elements.*/\1/p' out.txt)
}
if [ -z "$SHORT" ]; then
    strips 8 0 1024
    alone=$elements
    strips 8 600 1024
    check "a mesh's splinters leave strips their elements: $elements, $alone without" test "$elements" -le $((alone + 16))
    strips 300 0 1024
    check "many strips share elements, and the floor has some: $elements" test "$elements" -gt 512
    strips 255 0 4096
    check "strips that crowd nothing out keep their elements: $elements" test "$elements" -gt 3300
fi
# Slivers in a room, many of them through a block: other surfaces keep their elements there too.
awk 'function block(x0, y0, z0, x1, y1, z1,  i) {
         for (i = 0; i < 8; ++i) print "v", i % 2 ? x1 : x0, int(i / 2) % 2 ? y1 : y0, (i > 3 ? z1 : z0)
         print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }
     BEGIN { block(0, 0, 0, 4, 3, 4); block(1, 0, 1, 2, 1, 2)
             for (i = 0; i < 600; ++i) {
                 x = 0.2 + 0.006 * i
                 printf "v %.5f 0.5 0.2\nv %.5f 0.5 0.2\nv %.5f 0.5 3.8\nf -3 -1 -2\n", x, x + 0.003, x + 0.003
             } }' >through.obj
if [ -z "$SHORT" ]; then
    status 0 bake through.obj -o through.lmt --elements 256 --cluster 5 --division 1 --error 1 --once
    elements=$(sed -n 's/.*: \([0-9]*\) elements.*/\1/p' out.txt)
    check "slivers through a block leave the room its elements: $elements" test "$elements" -gt 128
fi
# Pillars of many facets on plinths: the facets count by their area, and the hall keeps small elements.
awk 'function block(x0, y0, z0, x1, y1, z1,  i) {
         for (i = 0; i < 8; ++i) print "v", i % 2 ? x1 : x0, int(i / 2) % 2 ? y1 : y0, (i > 3 ? z1 : z0)
         print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }
     BEGIN { block(0, 0, 0, 6, 4, 9)
             for (p = 0; p < 8; ++p) {
                 x = p % 2 ? 4 : 2
                 z = 1 + 2.2 * int(p / 2)
                 block(x - 0.3, 0, z - 0.3, x + 0.3, 0.2, z + 0.3)
                 for (i = 0; i < 16; ++i) {
                     a = 6.2831853 * i / 16
                     b = 6.2831853 * (i + 1) / 16
                     printf "v %.5f 0 %.5f\nv %.5f 0 %.5f\nv %.5f 4 %.5f\nv %.5f 4 %.5f\nf -4 -3 -2 -1\n", \
                         x + 0.2 * cos(a), z + 0.2 * sin(a), x + 0.2 * cos(b), z + 0.2 * sin(b), \
                         x + 0.2 * cos(b), z + 0.2 * sin(b), x + 0.2 * cos(a), z + 0.2 * sin(a)
                 }
             } }' >pillars.obj
status 0 bake pillars.obj -o pillars.lmt --elements 1024 --receivers 2000 --division 1 --error 1 --once --eye 3,1.5,4.5
elements=$(sed -n 's/.*: \([0-9]*\) elements.*/\1/p' out.txt)
check "pillars leave a hall its elements: $elements" test "$elements" -gt 512
# A panel with corners, and the middle of the longest edge, inside blocks: the rest of the panel is lit.
awk 'function block(x, z,  i) {
         for (i = 0; i < 8; ++i) print "v", x + (i % 2 ? 0.12 : -0.12), int(i / 2) % 2 ? -0.3 : -0.7, z + (i > 3 ? 0.12 : -0.12)
         print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }
     { print }
     END { print "v -0.7 -0.5 -0.6\nv 0.7 -0.5 -0.6\nv 0 -0.5 0.7\nf -1 -2 -3"
           block(-0.7, -0.6); block(0.7, -0.6); block(0, 0.7); block(0, -0.6) }' box.obj >buried.obj
above="--eye 0,0.4,-0.1 --target 0.01,-0.5,-0.1 --fov 30 --size 32x32 --light point:0.2,0.8,0:0,-1,0:5,4,3 --show indirect"
status 0 bake buried.obj -o buried.lmt --elements 1024 --division 1
status 0 render buried.obj $above --quality draft -o buried-draft.pfm
status 0 render buried.obj $above --transfer buried.lmt -o buried.pfm
status 0 compare buried.pfm buried-draft.pfm --max lo=0.7,hi=1.3

# Books on boards: the nearest lit surfaces are hidden from some of them by a board, which are lit all the same.
awk 'function block(x0, y0, z0, x1, y1, z1,  i) {
         for (i = 0; i < 8; ++i) print "v", i % 2 ? x1 : x0, int(i / 2) % 2 ? y1 : y0, (i > 3 ? z1 : z0)
         print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }
     BEGIN { block(0, 0, 0, 3, 2.6, 3)
             for (k = 0; k < 4; ++k) {
                 y = 0.1 + 0.35 * k
                 block(0.1, y - 0.03, 0.02, 2.9, y, 0.32)
                 for (i = 0; i < 40 && k < 3; ++i) {
                     x = 0.15 + 0.068 * i
                     block(x, y, 0.03, x + 0.03 + 0.03 * (i * 5 % 3) / 2, y + 0.2 + 0.07 * (i * 7 % 5) / 4, \
                           0.2 + 0.08 * (i * 11 % 7) / 6)
                 }
             } }' >books.obj
above="--eye 1.5,0.8,1.5 --target 1.5,0.6,0 --fov 70 --size 48x48 --light point:0.4,2.4,1.8:0,-1,0:5,4,3 --show indirect"
status 0 bake books.obj -o books.lmt --elements 256 --receivers 4000 --division 1 --eye 1.5,1.5,2.5
status 0 render books.obj $above --transfer books.lmt -o books.pfm
black=$(tail -c 27648 books.pfm | od -An -v -tf4 -w12 | awk '$1 + $2 + $3 == 0 { ++n } END { print n + 0 }')
check "books are lit, except for $black of 2304 pixels" test "$black" -le 3

finish
