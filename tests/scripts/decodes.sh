# decodes.sh: compares the picture decoders with other programs: decodes.sh PROGRAM (of tests/decodes/main_decodes.c).
#
# PNG, PPM and PGM against Netpbm (pngtopam with libpng, pamdepth, pamtopam), JPEG against libjpeg-turbo's djpeg, PFM
# against libvips (bits) and Netpbm (orientation), HDR against libvips. Pictures are the sample data (LMB_SHARED,
# ../shared by default), images in GLB files of that data, and the fuzz corpus. Other programs also encode them again,
# in the variants of each format. All values must be equal; JPEG may differ by one code if djpeg is not libjpeg-turbo's,
# because other families compute differently. Prints a table.
#
# djpeg -dct int: libjpeg's exact integer transform, not the fastest on the host. Without -nosmooth: chroma is
# interpolated, as is usual, not repeated.
. tests/scripts/checks.sh
program=$1
shared=${LMB_SHARED:-../shared}
dir=$B/decodes.d
corpus=tests/fuzz/corpus

if ! lacking=$(sh tests/scripts/tools.sh need djpeg cjpeg pngtopam pnmtopng pamtopng pfmtopam vips 2>&1); then
    skip "$lacking"
    finish
fi
rm -rf "$dir"
mkdir -p "$dir"
: >"$dir/figures"
off_jpeg=1
djpeg -version 2>&1 </dev/null | grep -q turbo && off_jpeg=0

# judge KIND FILE LIMIT COMMAND...: checks that the largest difference is at most LIMIT. The command prints the number
# of pixels, the number of different values, and the largest difference.
judge() {
    kind=$1 file=$2 limit=$3
    shift 3
    if ! line=$("$@" 2>&1); then
        fail "$kind $file: $line"
    elif echo "$line" | awk -v limit="$limit" '{ exit !($3 + 0 <= limit && $3 !~ /nan/) }'; then
        pass
    else
        fail "$kind $file: pixels, differing values, largest difference: $line"
    fi
    echo "$kind $line" >>"$dir/figures"
}

# Readers: NAME KIND FILE.
png() { pngtopam -alphapam "$2" >"$dir/ref" 2>/dev/null && judge "$1" "$2" 0 "$program" codes "$2" "$dir/ref"; }

# pngtopam ignores a transparent colour (tRNS) of RGB, so the reference is libpng's, through libvips.
png_rgb_keyed() {
    size=$(vipsheader -f width "$2")x$(vipsheader -f height "$2")
    vips rawsave "$2" "$dir/ref.raw"
    printf 'P7\nWIDTH %s\nHEIGHT %s\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n' "${size%x*}" "${size#*x}" |
        cat - "$dir/ref.raw" >"$dir/ref"
    judge "$1" "$2" 0 "$program" codes "$2" "$dir/ref"
}

jpeg() { djpeg -dct int -pnm "$2" >"$dir/ref" && judge "$1" "$2" $off_jpeg "$program" codes "$2" "$dir/ref"; }

# The reference keeps all 16 bits; the program compares the high bytes.
pnm() {
    case $(pamfile -machine "$2" | awk '{ print $7 }') in
    65535) pamtopam <"$2" >"$dir/ref" ;;
    *) pamdepth 255 "$2" >"$dir/ref" 2>/dev/null ;;
    esac && judge "$1" "$2" 0 "$program" codes "$2" "$dir/ref"
}

pfm() {
    vips rawsave "$2" "$dir/ref.raw" && judge "$1" "$2" 0 "$program" light "$2" "$dir/ref.raw" &&
        pfmtopam -maxval=65535 "$2" >"$dir/ref" && judge "$1-up" "$2" 1 "$program" upright "$2" "$dir/ref"
}

hdr() {
    vips rawsave "$2" "$dir/rgbe.raw" && vips rad2float "$2" "$dir/ref.raw" &&
        judge "$1" "$2" 0 "$program" rgbe "$2" "$dir/ref.raw" "$dir/rgbe.raw"
}

# each READER KIND FILE...: fails if the reference program cannot read a file.
each() {
    reader=$1 group=$2
    shift 2
    for one in "$@"; do
        [ -f "$one" ] || continue
        before=$((passed + failed))
        $reader "$group" "$one"
        [ $((passed + failed)) -gt $before ] || fail "$group $one: the reference program does not read it"
    done
}

# --- pictures as they are ---

if [ -d "$shared/data" ]; then
    each png png-samples $(find "$shared/data" -name '*.png' | sort)
    each jpeg jpeg-samples $(find "$shared" -name '*.jpg' | sort)
    each pfm pfm-samples "$shared"/data/env/*.pfm "$shared"/truth/cornell/*.pfm "$shared"/truth/env_relight/*.pfm
    each hdr hdr-samples "$shared"/data/env/*.hdr
    for glb in "$shared"/data/gltf/*.glb "$shared"/data/scenes/*.glb; do
        [ ! -f "$glb" ] || check "$glb: images" "$program" extract "$glb" "$dir/$(basename "$glb" .glb)-"
    done
    each png png-in-glb "$dir"/*-[0-9]*.png
    each jpeg jpeg-in-glb "$dir"/*-[0-9]*.jpg
else
    skip "$shared/data is not there; the pictures are the corpus and what is encoded from it"
fi
each png png-corpus $corpus/png/*.png tests/results/demo.png
each jpeg jpeg-corpus $corpus/jpeg/*.jpg
each pfm pfm-corpus $corpus/pfm/*.pfm
# libvips does not divide by EXPOSURE and COLORCORR or rotate pictures, so the copies have neither.
for picture in $corpus/hdr/*.hdr; do
    LC_ALL=C sed -e '/^EXPOSURE=/d' -e '/^COLORCORR=/d' -e 's/^+X \([0-9]*\) -Y \([0-9]*\)$/-Y \1 +X \2/' \
        "$picture" >"$dir/plain-${picture##*/}"
done
each hdr hdr-corpus "$dir"/plain-*.hdr
each pnm pnm-corpus $corpus/ppm/*

# --- encoded again ---

# crop FILE LEFT TOP WIDTH HEIGHT: crops to odd sizes, so that blocks and interlaced passes are cut.
crop() { pngtopam "$1" 2>/dev/null | pamcut -left "$2" -top "$3" -width "$4" -height "$5" | pamdepth 255; }

count=0
for picture in tests/results/demo.png "$shared"/data/textures/football_field_top.png "$shared"/data/meshes/spot.png \
    "$shared"/data/env/meadow_cube512_px.png "$shared"/data/rgbd/tum_fr2_desk_1.color.png; do
    [ ! -f "$picture" ] || crop "$picture" 31 17 197 133 >"$dir/source$count.ppm" 2>/dev/null && count=$((count + 1))
done

# jpeg_variant NAME OPTION...: encodes each source.
jpeg_variant() {
    variant=$1
    shift
    for source in "$dir"/source*.ppm; do
        again=$dir/$(basename "$source" .ppm)-$variant.jpg
        cjpeg "$@" "$source" >"$again" 2>/dev/null
        case $variant in
        *progressive*) each jpeg jpeg-progressive "$again" ;;
        *) each jpeg jpeg-baseline "$again" ;;
        esac
    done
}

for quality in 5 30 75 95 100; do
    for sample in 1x1 2x1 1x2 2x2 4x1 4x2; do
        jpeg_variant $sample-$quality -sample $sample -quality $quality
        jpeg_variant $sample-$quality-progressive -sample $sample -quality $quality -progressive
    done
    jpeg_variant grey-$quality -grayscale -quality $quality
    jpeg_variant grey-$quality-progressive -grayscale -quality $quality -progressive
done
jpeg_variant chroma -sample 2x2,1x2,2x1
jpeg_variant restart -restart 3B -quality 80
jpeg_variant restart-rows -restart 1 -sample 2x1
jpeg_variant restart-progressive -restart 5B -progressive
jpeg_variant optimised -optimize -quality 60
jpeg_variant rgb -rgb -quality 90
jpeg_variant rgb-progressive -rgb -quality 90 -progressive
jpeg_variant smoothed -smooth 20 -dct float

# png_variant NAME PNM OPTION...: encodes plain and interlaced.
png_variant() {
    variant=$dir/$1 from=$2
    shift 2
    case $variant in
    *-rgb-keyed) by=png_rgb_keyed ;;
    *) by=png ;;
    esac
    pnmtopng -quiet "$@" "$from" >"$variant.png" 2>/dev/null
    pnmtopng -quiet -interlace "$@" "$from" >"$variant-interlaced.png" 2>/dev/null
    each $by png-encoded "$variant.png" "$variant-interlaced.png"
}

# pnm_variant NAME PNM: writes bytes and text.
pnm_variant() {
    pamtopnm "$2" >"$dir/$1.pnm"
    pnmtoplainpnm "$2" >"$dir/$1-text.pnm"
    each pnm pnm-encoded "$dir/$1.pnm" "$dir/$1-text.pnm"
}

for source in "$dir"/source*.ppm; do
    name=$(basename "$source" .ppm)
    ppmtopgm "$source" >"$dir/grey.pgm"
    pamscale -width 197 -height 133 -nomix "$dir/grey.pgm" | pamdepth 255 >"$dir/alpha.pgm" 2>/dev/null
    for most in 1 3 15 255 65535; do
        # Gamma makes the samples of 65535 use all 16 bits.
        pamdepth $most "$dir/grey.pgm" >"$dir/grey$most.pgm" 2>/dev/null
        [ $most -ne 65535 ] || pamdepth 65535 "$dir/grey.pgm" 2>/dev/null | pnmgamma 1.7 >"$dir/grey$most.pgm"
        png_variant "$name-grey$most" "$dir/grey$most.pgm" -force
        png_variant "$name-grey$most-keyed" "$dir/grey$most.pgm" -force -transparent '#000'
    done
    pamdepth 65535 "$source" 2>/dev/null | pnmgamma 1.7 >"$dir/deep.ppm"
    pamdepth 65535 "$dir/alpha.pgm" 2>/dev/null | pnmgamma 2 >"$dir/deep_alpha.pgm"
    png_variant "$name-rgb" "$source" -force
    png_variant "$name-rgb-deep" "$dir/deep.ppm" -force
    png_variant "$name-rgb-keyed" "$source" -force -transparent "$(ppmhist -noheader "$source" | awk 'NR == 1 {
        printf "#%02x%02x%02x", $1, $2, $3 }')"
    png_variant "$name-alpha" "$source" -force -alpha "$dir/alpha.pgm"
    png_variant "$name-alpha-deep" "$dir/deep.ppm" -force -alpha "$dir/deep_alpha.pgm"
    png_variant "$name-grey-alpha" "$dir/grey.pgm" -force -alpha "$dir/alpha.pgm"
    png_variant "$name-grey-alpha-deep" "$dir/grey65535.pgm" -force -alpha "$dir/deep_alpha.pgm"
    for colours in 2 4 16 256; do
        pnmquant $colours "$source" >"$dir/few.ppm" 2>/dev/null
        png_variant "$name-palette$colours" "$dir/few.ppm"
        png_variant "$name-palette$colours-alpha" "$dir/few.ppm" -transparent "$(ppmhist -noheader "$dir/few.ppm" |
            awk 'NR == 2 { printf "#%02x%02x%02x", $1, $2, $3 }')"
    done
    for filter in sub up avg paeth; do
        png_variant "$name-$filter" "$source" -force -$filter
    done
    png_variant "$name-stored" "$source" -force -compression 0
    for most in 1 2 5 7 15 100 254 255 256 1000 1023 4095 65534 65535; do
        pamdepth $most "$dir/deep.ppm" >"$dir/of_most.ppm" 2>/dev/null
        pnm_variant "$name-$most" "$dir/of_most.ppm"
        pamdepth $most "$dir/grey65535.pgm" >"$dir/of_most.pgm" 2>/dev/null
        [ $most -eq 1 ] || pnm_variant "$name-grey-$most" "$dir/of_most.pgm" # for 1 Netpbm makes a PBM
    done
    vips cast "$source" "$dir/light.v" float && vips linear "$dir/light.v" "$dir/light.pfm" 0.0037 0.001
    LC_ALL=C sed '/^#vips2ppm/d' "$dir/light.pfm" >"$dir/$name.pfm" # a comment that Netpbm cannot read
    vips float2rad "$dir/light.v" "$dir/rad.v" && vips radsave "$dir/rad.v" "$dir/$name.hdr"
    each pfm pfm-encoded "$dir/$name.pfm"
    each hdr hdr-encoded "$dir/$name.hdr"
done

echo "kind                 files     pixels  differing values  largest difference"
awk 'NF == 4 { files[$1]++; pixels[$1] += $2; values[$1] += $3; if ($4 + 0 > most[$1] + 0) most[$1] = $4 }
    END { for (k in files) printf "%-18s %7d %10d  %16d  %18g\n", k, files[k], pixels[k], values[k], most[k] }' \
    "$dir/figures" | sort
finish
